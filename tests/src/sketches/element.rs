//! The subassembly element (the paper's Fig. 3) and the way of the method (Fig. 2).

use nalgebra::{Point3, Rotation3};

use super::canvas::{FIRST, INK, MOTION, Sketch, WHITE, rgb};

/// What holds an element.
#[derive(Clone, Copy, PartialEq)]
enum Held {
    Nowhere,
    First,
    Second,
}

/// The element free, held at node 1 and held at node 2.
pub fn subassembly() -> String {
    let mut sketch = Sketch::new("The subassembly element", [900.0, 500.0], -72.0, 22.0);
    let rows = [
        (
            "(a) free: u₁ and u₂ follow from W₁ and W₂ (Eq. 1)",
            Held::Nowhere,
        ),
        ("(b) node 1 held: W₂ moves node 2 (Eqs. 2–7)", Held::First),
        ("(c) node 2 held: W₁ moves node 1 (Eqs. 8–12)", Held::Second),
    ];
    for (k, (words, held)) in rows.into_iter().enumerate() {
        let middle = 92.0 + 160.0 * k as f64;
        sketch.at([450.0, middle], 100.0);
        element(&mut sketch, held);
        sketch.words([450.0, middle + 66.0], words, 15.0, INK);
    }
    sketch.svg()
}

/// A beam with an elastic joint at either end.
fn element(sketch: &mut Sketch, held: Held) {
    let p = |x: f64| Point3::new(x, 0.0, 0.0);
    sketch.rod(&p(-1.9), &p(1.9), 0.09, FIRST);
    sketch.words_at(&p(0.7), [0.0, -18.0], "beam");
    for (k, side) in [-1.0, 1.0].into_iter().enumerate() {
        let (inner, outer) = (p(1.9 * side), p(2.75 * side));
        sketch.spring(&inner, &outer, 11.0);
        sketch.ball(&outer, 0.07, WHITE);
        let name = ["J₁", "J₂"][k];
        sketch.words_at(&p(2.45 * side), [0.0, -22.0], name);
        let node = ["node 1", "node 2"][k];
        let is_held = held == [Held::First, Held::Second][k];
        let inwards = if is_held { -24.0 } else { -8.0 };
        sketch.words_at(&outer, [inwards * side, 30.0], node);
        if is_held {
            sketch.ground(&p(2.85 * side), [0.0, -side], 60.0);
        } else {
            sketch.arrow(&p(2.9 * side), &p(3.5 * side), MOTION);
            sketch.words_at(&p(3.75 * side), [0.0, 5.0], ["W₁, u₁", "W₂, u₂"][k]);
        }
    }
    let tilted = Rotation3::from_euler_angles(0.0, 0.0, 0.45);
    sketch.frame(&p(-0.2), &Rotation3::identity(), 0.5);
    sketch.words_at(&p(-0.45), [0.0, 26.0], "{s}");
    if held == Held::Nowhere {
        sketch.frame(&p(-1.9), &tilted, 0.42);
        sketch.frame(&p(1.9), &tilted.inverse(), 0.42);
    }
}

/// The way from a mechanism to the stiffness of its output.
pub fn method() -> String {
    let mut sketch = Sketch::new("The way of the method", [900.0, 330.0], 0.0, 0.0);
    let links = rgb(0xe6ebf2);
    let joints = rgb(0xf7ead2);
    let whole = rgb(0xe4f1ea);
    sketch.panel(
        [20.0, 125.0],
        [130.0, 80.0],
        WHITE,
        &["mechanism", "with closed", "loops"],
    );
    sketch.panel(
        [210.0, 30.0],
        [210.0, 100.0],
        links,
        &[
            "cut the joints:",
            "a link and its elastic",
            "joints are one element",
            "K_s (Eqs. 1–12)",
        ],
    );
    sketch.panel(
        [210.0, 200.0],
        [210.0, 100.0],
        joints,
        &[
            "at every joint:",
            "independent coordinates",
            "u_i = N [q; u_j]",
            "(Eqs. 13–37)",
        ],
    );
    sketch.panel(
        [480.0, 115.0],
        [180.0, 100.0],
        whole,
        &[
            "close the loops:",
            "u_s = H U",
            "K = Σ Hᵀ K_s H",
            "(Eqs. 39–43)",
        ],
    );
    sketch.panel(
        [720.0, 30.0],
        [160.0, 100.0],
        whole,
        &[
            "output:",
            "Schur complement",
            "K_o u_o = W_o",
            "(Eqs. 44–45)",
        ],
    );
    sketch.panel(
        [720.0, 200.0],
        [160.0, 100.0],
        whole,
        &[
            "all else:",
            "displacements,",
            "wrenches, strains,",
            "stresses (46–47)",
        ],
    );
    sketch.flow([152.0, 150.0], [206.0, 95.0]);
    sketch.flow([152.0, 180.0], [206.0, 240.0]);
    sketch.flow([422.0, 90.0], [476.0, 145.0]);
    sketch.flow([422.0, 245.0], [476.0, 185.0]);
    sketch.flow([662.0, 145.0], [716.0, 90.0]);
    sketch.flow([800.0, 132.0], [800.0, 196.0]);
    sketch.svg()
}
