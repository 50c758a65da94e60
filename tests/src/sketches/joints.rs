//! Every kind of joint with its frame (the paper's Fig. 4, and the kinds it has not).

use std::f64::consts::{PI, TAU};

use hyperstat_figures::Rgb;
use nalgebra::{Point3, Rotation3, Vector3};

use super::canvas::{FIRST, INK, MOTION, OUTLINE, SECOND, Sketch, WHITE};

/// Of the page for one joint, in pixels.
const CELL: [f64; 2] = [240.0, 262.0];
/// Pixels a unit of length.
const SCALE: f64 = 62.0;

/// A joint: its name, what is free, and how it is drawn about the origin.
type Drawn = (&'static str, &'static str, fn(&mut Sketch));

const JOINTS: [Drawn; 8] = [
    ("Fixed", "free: none", fixed),
    ("Revolute", "free: v", revolute),
    ("Prismatic", "free: y", prismatic),
    ("Cylindrical", "free: y, v", cylindrical),
    ("Screw", "free: v, and y = pitch · v", screw),
    ("Universal", "free: u, v", universal),
    ("Spherical", "free: u, v, w", spherical),
    ("Planar", "free: x, z, v", planar),
];

/// All kinds on one page.
pub fn joints() -> String {
    let [width, height] = CELL;
    let mut sketch = Sketch::new(
        "Kinds of joints",
        [4.0 * width, 2.0 * height + 40.0],
        30.0,
        24.0,
    );
    for (k, (name, free, draw)) in JOINTS.into_iter().enumerate() {
        let corner = [(k % 4) as f64 * width, (k / 4) as f64 * height];
        let middle = corner[0] + width / 2.0;
        // Depths are those of the place on the page alone: joints do not hide each other.
        sketch.at([middle, corner[1] + 122.0], SCALE);
        draw(&mut sketch);
        sketch.frame(&Point3::origin(), &Rotation3::identity(), 1.25);
        sketch.words([middle, corner[1] + height - 22.0], name, 16.0, INK);
        sketch.words([middle, corner[1] + height - 4.0], free, 14.0, MOTION);
    }
    let key = "grey: first body of `between`, node i; sand: second body, node j";
    sketch.words([2.0 * width, 2.0 * height + 28.0], key, 14.0, INK);
    sketch.svg()
}

fn p(x: f64, y: f64, z: f64) -> Point3<f64> {
    Point3::new(x, y, z)
}

fn block(sketch: &mut Sketch, center: [f64; 3], half: [f64; 3], fill: Rgb) {
    sketch.cuboid(&center.into(), &Rotation3::identity(), half, fill);
}

/// The second body's arm, downwards from the sleeve.
fn arm(sketch: &mut Sketch, from: f64) {
    let half = (1.15 - from) / 2.0;
    block(sketch, [0.0, 0.0, -from - half], [0.14, 0.14, half], SECOND);
}

/// A slide along y, and a turn about it.
fn slide(sketch: &mut Sketch) {
    let z = -0.62;
    sketch.arrow(&p(0.0, 0.25, z), &p(0.0, 1.0, z), MOTION);
    sketch.arrow(&p(0.0, -0.25, z), &p(0.0, -1.0, z), MOTION);
}

fn turn(sketch: &mut Sketch, at: [f64; 3], axis: Vector3<f64>) {
    sketch.turn(&at.into(), &axis, 0.36, MOTION);
}

fn fixed(sketch: &mut Sketch) {
    block(sketch, [0.0, -0.5, 0.0], [0.28, 0.5, 0.28], FIRST);
    block(sketch, [0.0, 0.5, 0.0], [0.28, 0.5, 0.28], SECOND);
}

fn revolute(sketch: &mut Sketch) {
    sketch.rod(&p(0.0, -0.75, 0.0), &p(0.0, -0.35, 0.0), 0.13, FIRST);
    sketch.rod(&p(0.0, -0.35, 0.0), &p(0.0, 0.35, 0.0), 0.28, SECOND);
    sketch.rod(&p(0.0, 0.35, 0.0), &p(0.0, 0.75, 0.0), 0.13, FIRST);
    for y in [-0.66, 0.66] {
        block(sketch, [0.0, y, 0.36], [0.14, 0.07, 0.5], FIRST);
    }
    block(sketch, [0.0, 0.0, 0.93], [0.14, 0.73, 0.07], FIRST);
    arm(sketch, 0.28);
    turn(sketch, [0.0, 0.95, 0.0], Vector3::y());
}

fn prismatic(sketch: &mut Sketch) {
    block(sketch, [0.0, -0.72, 0.0], [0.15, 0.38, 0.15], FIRST);
    block(sketch, [0.0, 0.0, 0.0], [0.28, 0.34, 0.28], SECOND);
    block(sketch, [0.0, 0.72, 0.0], [0.15, 0.38, 0.15], FIRST);
    arm(sketch, 0.28);
    slide(sketch);
}

fn cylindrical(sketch: &mut Sketch) {
    shaft(sketch);
    sketch.rod(&p(0.0, -0.34, 0.0), &p(0.0, 0.34, 0.0), 0.28, SECOND);
    arm(sketch, 0.28);
    slide(sketch);
    turn(sketch, [0.0, 0.78, 0.0], Vector3::y());
}

/// The first body of a cylindrical and of a screw joint, beside the second.
fn shaft(sketch: &mut Sketch) {
    sketch.rod(&p(0.0, -1.1, 0.0), &p(0.0, -0.34, 0.0), 0.15, FIRST);
    sketch.rod(&p(0.0, 0.34, 0.0), &p(0.0, 1.1, 0.0), 0.15, FIRST);
}

fn screw(sketch: &mut Sketch) {
    shaft(sketch);
    // Half a turn of the thread after the other, the half that is seen.
    for k in 0..14 {
        let first = -1.04 + 0.16 * f64::from(k);
        if (-0.5..0.3).contains(&first) {
            continue;
        }
        let points: Vec<_> = (0..=12)
            .map(|step| {
                let part = f64::from(step) / 12.0;
                let angle = 0.15 * TAU - PI * part;
                p(0.16 * angle.cos(), first + 0.08 * part, 0.16 * angle.sin())
            })
            .collect();
        sketch.line(&points, OUTLINE);
    }
    block(sketch, [0.0, 0.0, 0.0], [0.28, 0.34, 0.28], SECOND);
    arm(sketch, 0.28);
    slide(sketch);
    turn(sketch, [0.0, 0.78, 0.0], Vector3::y());
}

fn universal(sketch: &mut Sketch) {
    sketch.rod(&p(-0.62, 0.0, 0.0), &p(-0.1, 0.0, 0.0), 0.1, FIRST);
    sketch.rod(&p(0.1, 0.0, 0.0), &p(0.62, 0.0, 0.0), 0.1, FIRST);
    sketch.rod(&p(0.0, -0.62, 0.0), &p(0.0, -0.1, 0.0), 0.1, SECOND);
    sketch.rod(&p(0.0, 0.1, 0.0), &p(0.0, 0.62, 0.0), 0.1, SECOND);
    block(sketch, [0.0; 3], [0.13, 0.13, 0.13], WHITE);
    for side in [-0.6, 0.6] {
        block(sketch, [side, 0.0, 0.3], [0.06, 0.14, 0.42], FIRST);
        block(sketch, [0.0, side, -0.3], [0.14, 0.06, 0.42], SECOND);
    }
    block(sketch, [0.0, 0.0, 0.78], [0.66, 0.14, 0.06], FIRST);
    block(sketch, [0.0, 0.0, -0.78], [0.14, 0.66, 0.06], SECOND);
    turn(sketch, [0.95, 0.0, 0.0], Vector3::x());
    turn(sketch, [0.0, 0.95, 0.0], Vector3::y());
}

fn spherical(sketch: &mut Sketch) {
    block(sketch, [0.0, 0.0, -0.42], [0.36, 0.36, 0.3], SECOND);
    sketch.ball(&Point3::origin(), 0.32, FIRST);
    sketch.rod(&p(0.0, 0.0, 0.28), &p(0.0, 0.0, 1.0), 0.12, FIRST);
    turn(sketch, [0.85, 0.0, 0.0], Vector3::x());
    turn(sketch, [0.0, 0.85, 0.0], Vector3::y());
    turn(sketch, [0.0, 0.0, 0.75], Vector3::z());
}

fn planar(sketch: &mut Sketch) {
    block(sketch, [0.0, -0.1, 0.0], [0.95, 0.08, 0.8], SECOND);
    block(sketch, [0.0, 0.1, 0.0], [0.4, 0.1, 0.32], FIRST);
    sketch.arrow(&p(0.45, 0.2, -0.45), &p(1.0, 0.2, -0.45), MOTION);
    sketch.arrow(&p(-0.45, 0.2, 0.4), &p(-0.45, 0.2, 0.9), MOTION);
    turn(sketch, [0.0, 0.55, 0.0], Vector3::y());
}
