//! Rows of tables: they do not depend on the order of the poses, and what is not known is empty.

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};

use crate::support::{Bench, Table, assert_near, delta_batch};

const STEEL: &str = "material: (young: 2.1e11, poisson: 0.3, density: 0.0)";

/// A hexapod whose legs have no mass; `rest` are more fields of the job.
fn hexapod(name: &str, poses: &[&str], rest: &str) -> String {
    let list = poses.join(", ");
    format!(
        r#"(name: "{name}", mechanism: Hexapod(
            base_radius: 0.5, base_angle: 0.125, platform_radius: 0.3, platform_angle: 0.9,
            leg: (
                cylinder: (section: Tube(outer: 0.06, inner: 0.045), {STEEL}),
                piston: (section: Circle(diameter: 0.04), {STEEL}),
                cylinder_length: 0.45, lengths: (0.55, 1.0),
            ),
            drive_stiffness: 5e7,
        ), poses: List([{list}]), {rest})"#
    )
}

/// A platform of 20 kg whose inertia is not alike about all axes.
const HEAVY: &str =
    r#"masses: [(on: ("platform", "P"), mass: 20.0, inertia: (4.0, 4.0, 0.2))], modes: 3,"#;

const LEVEL: &str = "(0.0, 0.0, 0.6, 0.0, 0.0, 0.0)";
const TILTED: &str = "(0.0, 0.0, 0.6, 0.4, 0.0, 0.0)";
const ASKEW: &str = "(0.05, -0.02, 0.62, 0.1, -0.2, 0.3)";

/// Natural frequencies of a rigid body on massless springs: of the row's own stiffness and the mass
/// matrix with the inertia turned by its rotation vector, det (K − (2π f)² M) = 0.
fn expected(table: &Table, row: usize) -> Vec<f64> {
    let mut k = Matrix6::zeros();
    for r in 0..6 {
        for c in r..6 {
            let value = table.number(row, &format!("k{}{}", r + 1, c + 1));
            (k[(r, c)], k[(c, r)]) = (value, value);
        }
    }
    let turn = ["rx", "ry", "rz"].map(|name| table.number(row, name));
    let turn = Rotation3::new(Vector3::from(turn));
    let inertia = Matrix3::from_diagonal(&Vector3::new(4.0, 4.0, 0.2));
    let mut m = Matrix6::from_diagonal_element(20.0);
    let turned = turn.matrix() * inertia * turn.matrix().transpose();
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(&turned);
    let root = m.symmetric_eigen();
    let scale = root.eigenvalues.map(|value| 1.0 / value.sqrt());
    let root = root.eigenvectors * Matrix6::from_diagonal(&scale) * root.eigenvectors.transpose();
    let mut found: Vec<f64> = ((root * k * root).symmetric_eigenvalues().iter())
        .map(|value| value.sqrt() / std::f64::consts::TAU)
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn inertia_is_stated_at_home_whichever_pose_is_first() {
    let bench = Bench::new("rows-inertia");
    let orders = [
        [LEVEL, TILTED, ASKEW],
        [TILTED, ASKEW, LEVEL],
        [ASKEW, LEVEL, TILTED],
    ];
    let jobs: Vec<String> = (orders.iter().enumerate())
        .map(|(k, order)| hexapod(&format!("h{k}"), order, HEAVY))
        .collect();
    bench.file("h.ron", &format!("(jobs: [{}])", jobs.join(",\n")));
    bench
        .hyperstat(&["run", "h.ron", "--out", "out"])
        .ends_with(0);
    for job in 0..orders.len() {
        let table = Table::read(&bench, &format!("out/h{job}.csv"));
        for row in 0..3 {
            let expected = expected(&table, row);
            for (mode, expected) in expected[..3].iter().enumerate() {
                // The table's stiffness is that of the lanes: 1e-11 of it is promised.
                let found = table.number(row, &format!("f{}", mode + 1));
                assert_near(found, *expected, 1e-9, *expected);
            }
        }
    }
    // So is what `solve` and an exported file have.
    for pose in ["0", "1", "2"] {
        let one = ["--job", "h1", "--pose", pose];
        let export = [&["export", "h.ron", "--out", "one.ron"][..], &one].concat();
        bench.hyperstat(&export).ends_with(0);
        let table = Table::read(&bench, "out/h1.csv");
        for arguments in [
            [&["solve", "h.ron", "--format", "json"][..], &one].concat(),
            vec!["solve", "one.ron", "--format", "json", "--modes", "3"],
        ] {
            let solved = bench.hyperstat(&arguments).ends_with(0).json();
            for (mode, expected) in expected(&table, pose.parse().unwrap())[..3]
                .iter()
                .enumerate()
            {
                let found = solved["modes"][mode]["frequency"].as_f64().unwrap();
                assert_near(found, *expected, 1e-9, *expected);
            }
        }
    }
}

/// Of a prebuilt mechanism the output's body has a home orientation, and what joints keep from turning
/// against it or the ground: nothing else, but for an inertia that is the same about all axes.
#[test]
fn inertia_of_a_body_without_a_home_is_refused() {
    let bench = Bench::new("rows-home");
    let mass = |body: &str, inertia: &str| {
        format!("masses: [(on: {body}, mass: 1.0, inertia: {inertia})], modes: 2,")
    };
    let run = |rest: &str| {
        bench.file(
            "h.ron",
            &format!("(jobs: [{}])", hexapod("h", &[TILTED, LEVEL], rest)),
        );
        bench.hyperstat(&["run", "h.ron", "--out", "out"])
    };
    run(&mass(r#"("piston1", "S1")"#, "(1e-3, 1e-3, 2e-3)"))
        .ends_with(2)
        .says(&[
            "body `piston1` has no home orientation",
            "of a prebuilt mechanism only the output's body has one",
            "the same about all axes, `(J, J, J)`, needs none",
        ]);
    run(&mass(r#"("piston1", "S1")"#, "(1e-3, 1e-3, 1e-3)")).ends_with(0);
    // A carriage does not turn: its inertia is the same whichever pose is first.
    let rails = |poses: &str| {
        format!(
            r#"(jobs: [(name: "rails", mechanism: LinearDelta(
                rails: (radius: 0.3, travel: 0.8), platform_radius: 0.05, rod_length: 0.45,
                rod_spacing: 0.08,
                rod: (section: Tube(outer: 0.016, inner: 0.012), {STEEL}),
                joint_stiffness: (x: 1e8, y: 1e8, z: 1e8), drive_stiffness: 2e7,
            ), poses: List([{poses}]), {}
            )])"#,
            r#"masses: [
                (on: ("platform", "P"), mass: 2.0),
                (on: ("carriage1", "A1"), mass: 1.0, inertia: (1e-2, 2e-2, 3e-2)),
            ], modes: 4,"#
        )
    };
    let (near, far) = ("(0.0, 0.0, 0.6)", "(0.05, 0.08, 0.65)");
    let mut tables = Vec::new();
    for poses in [format!("{near}, {far}"), format!("{far}, {near}")] {
        bench.file("r.ron", &rails(&poses));
        bench
            .hyperstat(&["run", "r.ron", "--out", "out"])
            .ends_with(0);
        tables.push(Table::read(&bench, "out/rails.csv"));
    }
    for mode in ["f1", "f2", "f3", "f4"] {
        for row in 0..2 {
            let [one, other] = [tables[0].number(row, mode), tables[1].number(1 - row, mode)];
            assert_near(one, other, 1e-10, one);
        }
    }
}

/// Jobs of every kind, each as text with its poses left open.
fn jobs() -> Vec<(&'static str, String, Vec<&'static str>)> {
    let tilts = vec![
        LEVEL,
        TILTED,
        ASKEW,
        "(0.02, 0.0, 0.65, -0.1, 0.3, -0.2)",
        "(9.0, 0.0, 0.0, 0.0, 0.0, 0.0)",
    ];
    let wrist = r#"loads: [(on: ("platform", "P"), force: (10.0, 20.0, 30.0), moment: (1.0, 2.0, 3.0), frame: Output)],
        cases: { "body": [(on: ("platform", "S1"), force: (5.0, 0.0, -7.0), frame: Body)] },
        gravity: (0.0, 0.0, -9.81), misfits: { "M1": (y: 1e-4) },"#;
    let places = vec![
        "(0.0, 0.0, 0.5)",
        "(0.1, -0.05, 0.45)",
        "(-0.2, 0.1, 0.55)",
        "(0.0, 0.0, 9.0)",
    ];
    let spherical = r#"SphericalThreeRrr(
        radius: 0.07, base_angle: 0.9553166181245093, platform_angle: 0.9553166181245093,
        proximal_angle: 1.5707963267948966, distal_angle: 1.5707963267948966,
        proximal: (section: Rectangle(width: 0.012, height: 0.010), material: (young: 7.0e10, poisson: 0.33, density: 2700.0)),
        distal: (section: Rectangle(width: 0.010, height: 0.008), material: (young: 7.0e10, poisson: 0.33, density: 2700.0)),
    )"#;
    let turns = vec![
        "(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)",
        "(0.0, 0.0, 0.0, 0.3, 0.0, 0.1)",
        "(0.0, 0.0, 0.0, -0.2, 0.2, -0.3)",
    ];
    let delta = delta_batch(
        "d",
        "List([POSES])",
        r#"preloads: {}, vary: { "rod.section.diameter": [0.012, 0.016] },"#,
    );
    let delta = delta.replace(
        "preloads: {},",
        r#"misfits: { "Ba1": (x: 1e-4) }, modes: 2,"#,
    );
    let whole = |job: String| format!("(jobs: [{job}])");
    vec![
        (
            "loads, a case, weight and a misfit",
            whole(hexapod("d", &["POSES"], wrist)),
            tilts.clone(),
        ),
        ("modes", whole(hexapod("d", &["POSES"], HEAVY)), tilts),
        ("designs", delta, places.clone()),
        (
            "a sphere",
            whole(format!(
                r#"(name: "d", mechanism: {spherical}, poses: List([POSES]), modes: 3,
                loads: [(on: ("platform", "P"), moment: (1.0, 2.0, 3.0), frame: Output)],
                masses: [(on: ("platform", "P"), mass: 0.2, inertia: (1e-4, 2e-4, 3e-4, 1e-5, 0.0, 0.0))])"#
            )),
            turns,
        ),
        (
            "a file",
            whole(r#"(name: "d", mechanism: File("five_bar.ron"), poses: List([POSES]))"#.into()),
            vec![
                "(0.0, 0.4, 0.0)",
                "(0.1, 0.3, 0.0)",
                "(-0.1, 0.35, 0.0)",
                "(3.0, 0.3, 0.0)",
            ],
        ),
    ]
}

#[test]
fn the_order_of_the_poses_is_that_of_the_rows_and_nothing_else() {
    let bench = Bench::new("rows-order");
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let five_bar = std::fs::read_to_string(examples.join("five_bar.ron")).unwrap();
    bench.file("five_bar.ron", &five_bar);
    for (what, job, poses) in jobs() {
        let run = |order: &[usize]| {
            let list: Vec<&str> = order.iter().map(|k| poses[*k]).collect();
            bench.file("d.ron", &job.replace("POSES", &list.join(", ")));
            assert!(
                bench.hyperstat(&["run", "d.ron", "--out", "out"]).status() < 2,
                "{what}"
            );
            Table::read(&bench, "out/d.csv")
        };
        let count = poses.len();
        let straight: Vec<usize> = (0..count).collect();
        let whole = run(&straight);
        let designs = whole.rows.len() / count;
        for first in 1..count {
            let order: Vec<usize> = straight
                .iter()
                .map(|k| (k * (count - 1) + first) % count)
                .collect();
            let shuffled = run(&order);
            for (row, cells) in shuffled.rows.iter().enumerate() {
                let same = row / count * count + order[row % count];
                assert!(row / count < designs);
                for (column, name) in whole.names.iter().enumerate().skip(1) {
                    let [cell, expected] = [&cells[column], &whole.rows[same][column]];
                    let numbers = [cell, expected].map(|cell| cell.parse::<f64>());
                    let [Ok(found), Ok(expected)] = numbers else {
                        assert_eq!(cell, expected, "{what}, {name}");
                        continue;
                    };
                    // Of the kind's own size in the row: entries of a symmetric mechanism are zero.
                    let kind = |other: &&String| other[..1] == name[..1];
                    let scale = (whole.names.iter().zip(&whole.rows[same]))
                        .filter(|(other, _)| kind(other))
                        .filter_map(|(_, cell)| cell.parse::<f64>().ok())
                        .fold(1e-9, |scale: f64, number| scale.max(number.abs()));
                    assert!(
                        (found - expected).abs() <= 1e-9 * scale,
                        "{what}, {name}: {found:e} {expected:e}"
                    );
                }
            }
        }
    }
}

/// Of a mechanism of a file too a row depends on nothing but its pose: each alone is as it is among
/// the others, in any order, to the last digit. Many of them are of another branch or out of reach, and
/// more than one lot of poses that a thread takes.
#[test]
fn a_pose_of_a_file_is_reached_alike_alone_and_among_others() {
    let bench = Bench::new("rows-reached");
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let five_bar = std::fs::read_to_string(examples.join("five_bar.ron")).unwrap();
    bench.file("five_bar.ron", &five_bar);
    let run = |kind: &str, head: &str, rows: &[String]| {
        bench.file("p.csv", &format!("{head}\n{}\n", rows.join("\n")));
        let poses = match kind {
            "Drives" => "Drives(Csv(\"p.csv\"))",
            _ => "Csv(\"p.csv\")",
        };
        let job =
            format!(r#"(jobs: [(name: "d", mechanism: File("five_bar.ron"), poses: {poses})])"#);
        bench.file("d.ron", &job);
        let status = bench
            .hyperstat(&["run", "d.ron", "--out", "out", "--one-by-one"])
            .status();
        assert!(status < 2, "{kind}: {rows:?}");
        let rows = Table::read(&bench, "out/d.csv").rows;
        rows.into_iter().map(|row| row[1..].to_vec()).collect()
    };
    let cross = |xs: &[f64], ys: &[f64]| -> Vec<String> {
        let all = ys.iter().flat_map(|y| xs.iter().map(move |x| [x, y]));
        all.map(|[x, y]| format!("{x},{y}")).collect()
    };
    // The first is where the way from the second would lead, but not the way from the file's
    // configuration.
    let mut places = vec!["-0.25,-0.36875".to_string(), "0.0,-0.5".to_string()];
    places.extend(cross(
        &[-0.3, -0.1, 0.05, 0.2, 0.35],
        &[-0.5, -0.3, -0.1, 0.05, 0.2, 0.3, 0.45],
    ));
    let mut drives = vec!["-1.5,1.5".to_string(), "-1.5,-1.5".to_string()];
    let values = [-2.0, -1.0, -0.4, 0.0, 0.6, 1.2];
    drives.extend(cross(&values, &values));
    for (kind, head, rows) in [("Csv", "x,y", places), ("Drives", "A1.v,A2.v", drives)] {
        let count = rows.len();
        assert!(count > 36);
        let alone: Vec<Vec<String>> = (rows.iter().enumerate())
            .filter(|(k, _)| *k < 2 || k % 5 == 0)
            .flat_map(|(_, row)| -> Vec<Vec<String>> { run(kind, head, std::slice::from_ref(row)) })
            .collect();
        let whole: Vec<Vec<String>> = run(kind, head, &rows);
        let picked = |k: &usize| *k < 2 || k.is_multiple_of(5);
        for (k, alone) in (0..count).filter(picked).zip(&alone) {
            assert_eq!(*alone, whole[k], "{}", rows[k]);
        }
        // Steps that have no divisor in common with the number of poses, and the reverse.
        let steps = (2..count).filter(|step| (2..=*step).all(|d| step % d > 0 || count % d > 0));
        for step in steps.take(2).chain([count - 1]) {
            let order: Vec<usize> = (1..=count).map(|k| k * step % count).collect();
            let shuffled: Vec<String> = order.iter().map(|k| rows[*k].clone()).collect();
            let found: Vec<Vec<String>> = run(kind, head, &shuffled);
            for (found, k) in found.iter().zip(order) {
                assert_eq!(*found, whole[k], "{}", rows[k]);
            }
        }
    }
}

/// A planar 3-RRR at the rotation at which its three distal links meet in P: there nothing resists a
/// turn about z. That is told of the pose whether it is the first or not, as by `solve`.
#[test]
fn a_singular_pose_is_singular_wherever_it_stands() {
    let bench = Bench::new("rows-singular");
    // C1 − B1 along P − C1, in closed form: |B1| = 0.25 + 0.08 with P at the origin, |B1 − A1| = 0.22,
    // |A1| = 0.3, so that the angle at P between A1 and B1 is that of a triangle of these sides.
    let (a, b, c) = (0.30_f64, 0.25 + 0.08, 0.22_f64);
    let turn = ((a * a + b * b - c * c) / (2.0 * a * b)).acos();
    let loads =
        r#"loads: [(on: ("platform", "P"), force: (1.0, 2.0, 3.0), moment: (0.1, 0.2, 0.3))],"#;
    let regular = [
        "(0.02, 0.01, 0.0, 0.0, 0.0, 0.1)",
        "(-0.03, 0.02, 0.0, 0.0, 0.0, -0.2)",
    ];
    let mut found = 0;
    for (elbow, turn) in [
        ("Left", turn),
        ("Left", -turn),
        ("Right", turn),
        ("Right", -turn),
    ] {
        let singular = format!("(0.0, 0.0, 0.0, 0.0, 0.0, {turn:?})");
        let status = |poses: [&str; 3], more: &[&str]| {
            let job = format!(
                r#"(jobs: [(name: "d", mechanism: PlanarThreeRrr(
                    base_radius: 0.30, platform_radius: 0.08, proximal_length: 0.22,
                    distal_length: 0.25, elbow: {elbow},
                    proximal: (section: Rectangle(width: 0.04, height: 0.02), material: (young: 7.0e10, poisson: 0.33)),
                    distal: (section: Rectangle(width: 0.03, height: 0.02), material: (young: 7.0e10, poisson: 0.33)),
                    drive_stiffness: 2e4,
                ), poses: List([{}]), {loads})])"#,
                poses.join(", ")
            );
            bench.file("d.ron", &job);
            let arguments = [&["run", "d.ron", "--out", "out"][..], more].concat();
            assert!(bench.hyperstat(&arguments).status() < 2);
            let table = Table::read(&bench, "out/d.csv");
            [0, 1, 2].map(|row| table.cell(row, "status").to_string())
        };
        for more in [&[][..], &["--one-by-one"]] {
            let first = status([&singular, regular[0], regular[1]], more);
            let last = status([regular[0], regular[1], &singular], more);
            assert_eq!([&first[1], &first[2]], ["ok"; 2]);
            assert_eq!([&last[0], &last[1]], ["ok"; 2]);
            assert_eq!(first[0], last[2], "{elbow} {turn}");
        }
        let solved = bench.hyperstat(&["solve", "d.ron", "--pose", "2"]);
        let solved = solved.status() == 0;
        let last = status([regular[0], regular[1], &singular], &[]);
        assert_eq!(last[2], if solved { "ok" } else { "unrestrained" });
        found += usize::from(!solved);
    }
    // Each elbow is singular at one of the two rotations.
    assert_eq!(found, 2);
}

/// What is not known before a pose is reached is empty where it is not: what was not asked for.
#[test]
fn what_is_not_known_of_a_row_is_empty() {
    let bench = Bench::new("rows-unknown");
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let five_bar = std::fs::read_to_string(examples.join("five_bar.ron")).unwrap();
    bench.file("five_bar.ron", &five_bar);
    bench.file("drives.csv", "A2.v,A1.v\n0,0\n0.0147,0.1236\n3.0,-3.0\n");
    bench.file(
        "d.ron",
        r#"(jobs: [
            (name: "map", mechanism: File("five_bar.ron"), poses: Grid(x: (0.0, 5.0, 2), y: (0.4, 0.4, 1))),
            (name: "motion", mechanism: File("five_bar.ron"), poses: Drives(Csv("drives.csv")),
                vary: { "sections.rod.outer": [0.025] }),
            (name: "tripod", mechanism: ThreeRps(
                base_radius: 0.4, platform_radius: 0.25,
                leg: (
                    cylinder: (section: Tube(outer: 0.06, inner: 0.045), material: (young: 2.1e11, poisson: 0.3)),
                    piston: (section: Circle(diameter: 0.04), material: (young: 2.1e11, poisson: 0.3)),
                    cylinder_length: 0.45, lengths: (0.55, 1.0),
                ),
            ), poses: List([(0.0, 0.0, 0.7, 0.1, 0.0, 0.0), (0.0, 0.0, 9.0, 0.1, -0.2, 0.0)])),
        ])"#,
    );
    for format in ["csv", "parquet"] {
        let arguments = ["run", "d.ron", "--out", "out", "--format", format];
        bench.hyperstat(&arguments).ends_with(1);
    }
    let coordinates = ["x", "y", "z", "rx", "ry", "rz"];
    let cells = |table: &Table, row| coordinates.map(|name| table.cell(row, name).to_string());
    let map = Table::read(&bench, "out/map.csv");
    assert_eq!(map.cell(0, "status"), "ok");
    assert!(cells(&map, 0).iter().all(|cell| !cell.is_empty()));
    assert_eq!(map.cell(1, "status"), "unreachable");
    assert_eq!(cells(&map, 1), ["5.0", "0.4", "", "", "", ""]);

    let motion = Table::read(&bench, "out/motion.csv");
    let last = &motion.names[motion.names.len() - 5..];
    assert_eq!(
        last,
        ["k66", "A2.v", "A1.v", "design", "sections.rod.outer"]
    );
    let drives = |row| ["A1.v", "A2.v"].map(|name| motion.number(row, name));
    assert_eq!(motion.cell(1, "status"), "ok");
    assert_eq!(drives(1), [0.1236, 0.0147]);
    assert_ne!(motion.cell(2, "status"), "ok");
    assert_eq!(cells(&motion, 2), [""; 6]);
    assert_eq!(drives(2), [-3.0, 3.0]);

    let tripod = Table::read(&bench, "out/tripod.csv");
    assert_eq!(tripod.cell(0, "status"), "ok");
    assert_eq!(tripod.cell(1, "status"), "unreachable");
    assert_eq!(cells(&tripod, 1), ["", "", "9.0", "0.1", "-0.2", ""]);
    // A map over what is known: the pose without a result has its place.
    let plot = ["plot", "out/map.csv", "--lines", "k11", "--over", "x"];
    bench.hyperstat(&plot).ends_with(0);
}
