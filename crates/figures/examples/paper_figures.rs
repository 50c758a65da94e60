//! Draws both figures of this crate from made-up data: a delta robot and its trajectory.
//!
//! `cargo run -p hyperstat-figures --example paper_figures -- FOLDER` leaves
//! `trajectory.svg`, `trajectory.png`, `deformed.svg` and `deformed.png` in FOLDER (default: the
//! system's folder for temporary files).

use std::error::Error;
use std::path::PathBuf;

use hyperstat_figures::{
    Axis, Curve, DeformedFigure, Notes, RigidBody, Scale, SecondMethod, SecondPoints, Shown,
    TrajectoryFigure, Viewpoint,
};

type Vector = [f64; 3];

/// Half the distance of the two rods of a limb [m].
const HALF_SPACING: f64 = 0.06;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(std::env::temp_dir, PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let trajectory = trajectory();
    std::fs::write(folder.join("trajectory.svg"), trajectory.svg()?)?;
    std::fs::write(folder.join("trajectory.png"), trajectory.png()?)?;
    let deformed = deformed();
    std::fs::write(folder.join("deformed.svg"), deformed.svg()?)?;
    std::fs::write(folder.join("deformed.png"), deformed.png()?)?;
    println!(
        "trajectory.svg, trajectory.png, deformed.svg, deformed.png in {}",
        folder.display()
    );
    Ok(())
}

/// Up, across and down again; softer away from the middle.
fn trajectory() -> TrajectoryFigure {
    let commanded: Vec<Vector> = (0..=60)
        .map(|k| match f64::from(k) / 20.0 {
            t if t < 1.0 => [-0.2, -0.2, 0.45 + 0.1 * t],
            t if t < 2.0 => [-0.2 + 0.4 * (t - 1.0), -0.2, 0.55],
            t => [0.2, -0.2, 0.55 - 0.1 * (t - 2.0)],
        })
        .collect();
    let deflection = |[x, _, z]: Vector| [-7e-5 - 1.5e-4 * x, 7e-5, (4e-4 + 3e-3 * x * x) * z];
    let displacement: Vec<_> = commanded.iter().map(|point| deflection(*point)).collect();
    TrajectoryFigure {
        title: "Pick and place".into(),
        second: Some(SecondMethod {
            name: "finite elements".into(),
            at: (0..commanded.len()).collect(),
            displacement: displacement.iter().map(|u| u.map(|c| 1.01 * c)).collect(),
            difference: 0.01,
        }),
        commanded,
        displacement,
        scale: Scale::Auto,
        view: Viewpoint::default(),
        axis_names: None,
    }
}

/// Three limbs at 120° with an arm and a parallelogram each, and a platform.
fn deformed() -> DeformedFigure {
    let mut figure = DeformedFigure {
        shown: Shown::Deflection,
        title: "Delta robot".into(),
        curves: Vec::new(),
        rigid: Vec::new(),
        axes: Vec::new(),
        ground: Vec::new(),
        second: None,
        scale: Scale::Auto,
        notes: Notes::default(),
        view: Viewpoint::default(),
        axis_names: None,
        pose: None,
    };
    let mut platform = vec![[0.0, 0.0, 0.5]];
    for limb in 0..3 {
        let (sin, cos) = (f64::from(limb) * 120_f64.to_radians()).sin_cos();
        // The limb over +y, turned about z.
        let turned = |[x, y, z]: Vector| [cos * x - sin * y, sin * x + cos * y, z];
        let [shoulder, elbow, wrist] = [[0.0, 0.25, 0.0], [0.0, 0.45, 0.22], [0.0, 0.06, 0.5]];
        let aside = |point: Vector, side: f64| turned([side * HALF_SPACING, point[1], point[2]]);

        figure.curves.push(link(turned(shoulder), turned(elbow)));
        for joint in [elbow, wrist] {
            figure.curves.push(link(aside(joint, -1.0), turned(joint)));
            figure.curves.push(link(turned(joint), aside(joint, 1.0)));
        }
        let along_bars = turned([1.0, 0.0, 0.0]);
        let across_rods = turned([0.0, 0.28, 0.39]);
        for joint in [shoulder, elbow, wrist] {
            figure.axes.push(Axis {
                at: turned(joint),
                direction: along_bars,
            });
        }
        for side in [-1.0, 1.0] {
            figure
                .curves
                .push(link(aside(elbow, side), aside(wrist, side)));
            for joint in [elbow, wrist] {
                figure.axes.push(Axis {
                    at: aside(joint, side),
                    direction: across_rods,
                });
            }
        }
        figure.ground.push(turned(shoulder));
        platform.push(turned(wrist));
    }
    let ends = |curve: &Curve| [curve.points[0], curve.points[curve.points.len() - 1]];
    let ends: Vec<Vector> = figure.curves.iter().flat_map(ends).collect();
    figure.second = Some(SecondPoints {
        name: "finite elements".into(),
        displacement: ends.iter().map(|point| displacement(*point)).collect(),
        points: ends,
        difference: 0.0094,
    });
    figure.rigid.push(RigidBody {
        displacement: platform.iter().map(|point| displacement(*point)).collect(),
        points: platform,
    });
    figure
}

/// A straight link, sampled.
fn link(from: Vector, to: Vector) -> Curve {
    const SAMPLES: u32 = 25;
    let at = |k: u32| {
        let part = f64::from(k) / f64::from(SAMPLES - 1);
        std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
    };
    let points: Vec<Vector> = (0..SAMPLES).map(at).collect();
    Curve {
        displacement: points.iter().map(|point| displacement(*point)).collect(),
        points,
    }
}

/// A smooth displacement that grows with the height.
fn displacement([x, y, z]: Vector) -> Vector {
    let bend = 8e-4 * z * z;
    [
        bend - 2e-4 * z * y,
        0.4 * bend + 2e-4 * z * x,
        -3e-4 * z * z,
    ]
}
