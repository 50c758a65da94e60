//! Mechanisms whose coordinates are rounded, and adjusted: every prebuilt one, beside itself as it is.

use std::path::Path;

use hyperstat_assembly::{Geometry, Model, Prepared};
use hyperstat_mechanisms::{
    Digits, Disk, Input, LoopClosure, Mechanism, MemoryFiles, NotAdjusted, Registry, Target,
    batch_from_str, begin, beginnings, load, mechanism_from_str, write,
};

/// Most roundings that a coordinate may move by.
const MOST: f64 = 5.0;

/// How far a place may be off, in roundings: [`MOST`] in each of three coordinates; elsewhere than at home, too, the
/// mechanisms have no long levers. It is 4.9 at most.
const PLACES: f64 = 9.0;
/// The same of the stiffness, relative, in roundings of a metre: [`MOST`] of a member of 6 cm, the shortest, to the
/// third power. It is 33 at most.
const STIFFNESS: f64 = 250.0;

fn read(text: &str) -> Mechanism {
    let registry = Registry::builtin();
    mechanism_from_str(text, Path::new("r.ron"), &MemoryFiles::new(), &registry)
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Prebuilt mechanisms at a pose of the jobs that one begins with, as files.
fn exported(pose: usize) -> Vec<(String, String)> {
    let registry = Registry::builtin();
    let mut files = Vec::new();
    for kind in beginnings().into_iter().filter(|kind| kind != "mechanism") {
        let text = begin(&kind).unwrap();
        let batch = batch_from_str(&text, Path::new("b.ron"), &MemoryFiles::new(), &registry);
        let job = &batch.unwrap().jobs[0];
        if pose < job.len() {
            let mut model = job.model().unwrap();
            let mut geometry = model.geometry().clone();
            job.place(pose, &mut geometry).unwrap();
            model.set_geometry(geometry).unwrap();
            files.push((
                format!("{kind}, pose {pose}"),
                write(&model, &registry).unwrap(),
            ));
        }
    }
    files
}

/// The same with the coordinates of points and axes rounded to so many decimals.
fn rounded(text: &str, decimals: usize) -> String {
    with_coordinates(text, |value| {
        format!(
            "{:?}",
            format!("{value:.decimals$}").parse::<f64>().unwrap()
        )
    })
}

/// The same with the coordinates of points and axes written in another way.
fn with_coordinates(text: &str, written: impl Fn(f64) -> String) -> String {
    let short = |number: &str| match number.trim().parse::<f64>() {
        Ok(value) => written(value),
        Err(_) => number.trim_start().to_owned(),
    };
    let mut lines = Vec::new();
    let mut in_points = false;
    for line in text.lines() {
        in_points = (in_points || line.contains("points: {")) && !line.trim().starts_with('}');
        let mut line = line.to_owned();
        let begins = if in_points {
            &[": ("][..]
        } else {
            &["axis: (", "axes: ((", "normal: ("]
        };
        let begins = if in_points || line.contains("kind:") {
            begins
        } else {
            &[]
        };
        for begin in begins {
            let Some(start) = line.find(begin).map(|at| at + begin.len()) else {
                continue;
            };
            let end = start
                + line[start..]
                    .find("))")
                    .or(line[start..].find(')'))
                    .unwrap();
            let parts = line[start..end].split_inclusive([',', '(', ')']);
            let parts = parts.map(|part| {
                let bare = part.trim_end_matches([',', '(', ')']);
                let blank = &bare[..bare.len() - bare.trim_start().len()];
                format!("{blank}{}{}", short(bare), &part[bare.len()..])
            });
            let parts: String = parts.collect();
            line.replace_range(start..end, &parts);
        }
        lines.push(line);
    }
    lines.join("\n") + "\n"
}

/// Mobility and over-constraint.
fn counts(model: &Model, geometry: &Geometry) -> (usize, usize) {
    let prepared = Prepared::new(model.clone());
    let at = prepared.at(geometry).unwrap();
    let kinematics = at.kinematics().unwrap();
    (kinematics.mobility, kinematics.overconstraint)
}

/// Poses near home that the output can take: along each of its coordinates, as far as it follows.
fn moved_poses(closure: &LoopClosure) -> Vec<[Option<f64>; 6]> {
    let home = closure.pose(&closure.home()).unwrap();
    let steps = [0.02, -0.03, 0.025, 0.08, -0.06, 0.07];
    let asked = (0..6).map(|k| {
        let mut asked = [None; 6];
        asked[k] = Some(home[k] + steps[k]);
        asked
    });
    asked
        .filter(|asked| closure.place_at(&Target::Output(*asked)).is_ok())
        .collect()
}

/// Stiffness of the output there; `None` where it is held rigidly.
fn stiffness(model: &Model, geometry: &Geometry) -> Option<Vec<f64>> {
    let prepared = Prepared::new(model.clone());
    let output = prepared.at(geometry).unwrap().solve().unwrap().output;
    output.stiffness.map(|k| k.iter().copied().collect())
}

#[test]
fn every_prebuilt_mechanism_gets_its_freedoms_back() {
    let adjusted = adjusted(1);
    assert!(adjusted > 20, "{adjusted}");
}

#[test]
fn every_prebuilt_mechanism_at_home_gets_its_freedoms_back() {
    let adjusted = adjusted(0);
    assert!(adjusted > 20, "{adjusted}");
}

/// How many of the prebuilt mechanisms at a pose, with 3 to 7 decimals, are adjusted; all of them are then
/// what they were.
fn adjusted(pose: usize) -> usize {
    let mut adjusted = 0;
    for (name, text) in exported(pose) {
        let exact = read(&text);
        assert_eq!(exact.adjusted().err(), Some(NotAdjusted::Exact), "{name}");
        let closure = LoopClosure::new(&exact.model).unwrap();
        let poses = moved_poses(&closure);
        for decimals in 3..=7 {
            let name = format!("{name}, {decimals} decimals");
            let mechanism = read(&rounded(&text, decimals));
            let before = counts(&mechanism.model, mechanism.model.geometry());
            let own = counts(&exact.model, exact.model.geometry());
            let again = match mechanism.adjusted() {
                Err(why) => {
                    assert_eq!(why, NotAdjusted::Exact, "{name}");
                    mechanism
                }
                Ok(found) => {
                    adjusted += 1;
                    assert_eq!(
                        (found.freedoms, found.rounded),
                        (own.0, Digits::Decimals(decimals))
                    );
                    let most = found.moved.iter().map(|m| m.roundings).fold(0.0, f64::max);
                    assert!(most <= MOST, "{name}: {most}");
                    let again = read(&found.text);
                    assert_eq!(again.adjusted().err(), Some(NotAdjusted::Exact), "{name}");
                    within(&mechanism, &again, decimals, &name);
                    again
                }
            };
            assert!(again.nearly_free().is_none(), "{name}");
            assert_eq!(
                counts(&again.model, again.model.geometry()),
                own,
                "{name}, {before:?}"
            );
            compare(
                &exact.model,
                &closure,
                &again.model,
                &poses,
                10f64.powi(-(decimals as i32)),
                &name,
            );
        }
    }
    adjusted
}

/// No coordinate of a point has moved by more than [`MOST`] of the decimals that it was rounded to.
fn within(rounded: &Mechanism, adjusted: &Mechanism, decimals: usize, name: &str) {
    let [from, to] = [rounded, adjusted].map(|m| &m.model.geometry().positions);
    let rounding = 10f64.powi(-(decimals as i32));
    for (from, to) in from.iter().zip(to) {
        let off = (to - from).amax();
        assert!(off <= MOST * rounding * (1.0 + 1e-9), "{name}: {off:e}");
    }
}

/// The adjusted mechanism moves as the one that was not rounded, and is as stiff.
fn compare(
    exact: &Model,
    closure: &LoopClosure,
    adjusted: &Model,
    poses: &[[Option<f64>; 6]],
    rounding: f64,
    name: &str,
) {
    let own = LoopClosure::new(adjusted).unwrap();
    assert_eq!(own.output_mobility(), closure.output_mobility(), "{name}");
    assert!(own.output_mobility() == 0 || !poses.is_empty(), "{name}");
    for asked in poses {
        let target = Target::Output(*asked);
        let expected = closure.place_at(&target).unwrap().geometry;
        let found = own
            .place_at(&target)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let found = found.geometry;
        for (one, other) in expected.positions.iter().zip(&found.positions) {
            let apart = (one - other).norm();
            assert!(apart <= PLACES * rounding, "{name}, {asked:?}: {apart:e}");
        }
        assert_eq!(
            counts(adjusted, &found),
            counts(exact, &expected),
            "{name}, {asked:?}"
        );
        let both = [stiffness(exact, &expected), stiffness(adjusted, &found)];
        assert_eq!(both[0].is_some(), both[1].is_some(), "{name}, {asked:?}");
        if let [Some(one), Some(other)] = both {
            for r in 0..6 {
                for c in 0..6 {
                    let scale = (one[7 * r] * one[7 * c]).abs().sqrt();
                    let off = (one[6 * r + c] - other[6 * r + c]).abs() / scale;
                    assert!(
                        off <= STIFFNESS * rounding,
                        "{name}, {asked:?}: {r} {c} {off:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn nothing_is_said_of_mechanisms_that_are_as_they_were_meant() {
    let registry = Registry::builtin();
    let mut seen = 0;
    for folder in ["../../examples", "../../tests/reference"] {
        for entry in Path::new(folder).read_dir().unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "ron") {
                continue;
            }
            let mut look = |mechanism: &Mechanism| {
                let near = mechanism.nearly_free();
                assert!(near.is_none(), "{}: {near:?}", path.display());
                seen += 1;
            };
            match load(&path, &Disk, &registry).unwrap() {
                Input::Mechanism(mechanism) => look(&mechanism),
                Input::Batch(batch) => {
                    batch
                        .jobs
                        .iter()
                        .filter_map(|job| job.mechanism())
                        .for_each(look);
                }
            }
        }
    }
    assert!(seen > 30, "{seen}");
}

/// The Exechon of the examples with three decimals.
fn exechon(decimals: usize) -> String {
    let text = std::fs::read_to_string("../../examples/exechon.ron").unwrap();
    rounded(&text, decimals)
}

#[test]
fn the_freedom_that_is_missed_is_known() {
    let near = read(&exechon(3)).nearly_free().unwrap();
    assert_eq!(near.freedoms, 3);
    let [first, second, third] = near.missed[..] else {
        panic!("{:?}", near.missed)
    };
    assert!(first < 1e-11 && second < 1e-11, "{first:e} {second:e}");
    assert!((1e-5..1e-3).contains(&third), "{third:e}");
    assert!(near.open > 1e-6, "{:e}", near.open);
}

#[test]
fn comments_units_and_layout_stay() {
    let text = exechon(4).replace(
        "\"A1\": (-0.45, 0.0, 0.0),",
        "\"A1\": (\"-45 cm\", /* left */ 0.0 , \"0 mm\"), // bolted",
    );
    let text = text.replace("\"M1\": (-0.2243, ", "\"M1\": ( \"-224.3 mm\", ");
    assert!(text.contains("-224.3 mm"));
    let found = read(&text).adjusted().unwrap();
    assert!(
        found.text.contains("/* left */ 0.0 , \"0 mm\"), // bolted"),
        "{}",
        found.text
    );
    assert!(found.text.contains(" mm\", -0.10"), "{}", found.text);
    // Numbers apart, the files are the same.
    let bare = |text: &str| {
        let kept = text
            .chars()
            .filter(|c| !c.is_ascii_digit() && !"-.e".contains(*c));
        kept.collect::<String>()
    };
    assert_eq!(bare(&found.text), bare(&text));
    assert_eq!(read(&found.text).adjusted().err(), Some(NotAdjusted::Exact));
}

#[test]
fn expressions_stay_and_others_move() {
    let text = exechon(4).replace(
        "\"B3\": (0.15, -0.0235, 1.0353)",
        "\"B3\": (0.15, \"= -0.0235\", \"= P.z + 0.0353\")",
    );
    let mechanism = read(&text);
    assert_eq!(mechanism.held_coordinates(), ["points.B3.1", "points.B3.2"]);
    let found = mechanism.adjusted().unwrap();
    assert!(found.text.contains("\"= -0.0235\", \"= P.z + 0.0353\""));
    assert!(
        found
            .moved
            .iter()
            .all(|m| m.roundings <= MOST && !m.path.contains("B3.1"))
    );
    assert_eq!(read(&found.text).adjusted().err(), Some(NotAdjusted::Exact));
    let all = with_coordinates(&exechon(4), |value| format!("\"= {value:?}\""));
    let mechanism = read(&all);
    assert_eq!(mechanism.adjusted().err(), Some(NotAdjusted::NoNumbers));
    assert_eq!(mechanism.held_coordinates().len(), 30 + 2 * 6 + 6 * 3);
}

#[test]
fn json_is_adjusted_as_ron_is() {
    let ron = exechon(4);
    let json = hyperstat_mechanisms::to_json(&ron, Path::new("r.ron")).unwrap();
    let [ron, json] = [&ron, &json].map(|text| read(text).adjusted().unwrap());
    let moves = |found: &hyperstat_mechanisms::Adjustment| -> Vec<_> {
        found.moved.iter().map(|m| (m.path.clone(), m.to)).collect()
    };
    assert_eq!(moves(&ron), moves(&json));
    assert_eq!(
        read(&json.text).model.geometry(),
        read(&ron.text).model.geometry()
    );
}

#[test]
fn a_point_of_a_group_moves_in_all_copies() {
    let text = std::fs::read_to_string("../../examples/delta_limbs.ron").unwrap();
    let exact = read(&text);
    let rounded = text.replace(
        "\"Cb\": (\"= half\", \"= C.y\", \"= C.z\")",
        "\"Cb\": (0.0601, \"60.0 mm\", 0.5001) /* as measured */",
    );
    assert_ne!(rounded, text);
    let mechanism = read(&rounded);
    let found = mechanism.adjusted().unwrap();
    let moved = found.moved.iter();
    assert!(
        moved
            .clone()
            .all(|m| m.path.starts_with("groups.limb.points.Cb."))
    );
    // Along the joint's axis the point may be anywhere: it moves across it alone.
    let moves: Vec<f64> = moved.map(|m| m.to - m.from).collect();
    assert_eq!(moves.len(), 3);
    let across = moves[1].hypot(moves[2]);
    assert!((moves[0] + 1e-4).abs() < 1e-9 && across < 1e-4, "{moves:?}");
    assert!(found.text.contains(" mm\", 0.5") && found.text.contains("/* as measured */"));
    let again = read(&found.text);
    let [one, other] = [&exact, &again].map(|m| counts(&m.model, m.model.geometry()));
    assert_eq!((one, one), (other, (3, 12)));
    let closure = LoopClosure::new(&exact.model).unwrap();
    compare(
        &exact.model,
        &closure,
        &again.model,
        &moved_poses(&closure),
        1e-4,
        "group",
    );
}

#[test]
fn digits_that_count_are_known_too() {
    let text = std::fs::read_to_string("../../examples/exechon.ron").unwrap();
    let text = with_coordinates(&text, |value| {
        format!("{:?}", format!("{value:.3e}").parse::<f64>().unwrap())
    });
    let found = read(&text).adjusted().unwrap();
    let own = read(&found.text);
    assert_eq!(counts(&own.model, own.model.geometry()), (3, 2));
    let most = found.moved.iter().map(|m| m.roundings).fold(0.0, f64::max);
    assert!(most <= MOST, "{most}");
}
