//! What a topology and what is asked of it say of the arithmetic: which coordinate moves what, which
//! unknowns each condition has. Lengths are over the mechanism's size.

use nalgebra::{Isometry3, Vector3};

use crate::equations::{Goal, System};
use crate::lanes::pattern::Pattern;
use crate::twist::Twist;

/// Which conditions a target makes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Asked {
    /// Coordinates of the output that are followed.
    pub output: [bool; 6],
    /// Columns of the drives.
    pub drives: Vec<usize>,
}

impl Asked {
    pub fn by(goal: &Goal) -> Self {
        Self {
            output: goal.output.map(|value| value.is_some()),
            drives: goal.drives.iter().map(|(column, _)| *column).collect(),
        }
    }

    /// Whether a goal asks these.
    pub fn is_asked_by(&self, goal: &Goal) -> bool {
        let drives = goal.drives.iter().map(|(column, _)| column);
        self.output == goal.output.map(|value| value.is_some()) && drives.eq(&self.drives)
    }
}

/// One factor of a joint's motion, `exp(±x ξ)`: from the frame before it to that after it.
#[derive(Debug, Clone)]
pub(super) struct Move {
    pub column: usize,
    pub from: usize,
    pub to: usize,
    /// The motion ξ at home, of a coordinate of 1; as it is seen in the frame before and in that after.
    pub linear: [f64; 3],
    pub angular: [f64; 3],
    pub turn: Option<Turn>,
    /// 1, or −1 where the factor is gone through backwards.
    pub sign: f64,
}

/// A turn about an axis, perhaps with a travel: `R = E + s A + (1 − c) A²`, and the origin moves by
/// `−s u − (1 − c) v + θ t`.
#[derive(Debug, Clone)]
pub(super) struct Turn {
    /// Angle of a coordinate of 1 (rad), with the sign.
    pub rate: f64,
    /// A, the axis's cross product, by columns.
    pub once: [[f64; 3]; 3],
    /// A².
    pub twice: [[f64; 3]; 3],
    pub u: [f64; 3],
    pub v: [f64; 3],
    pub t: [f64; 3],
}

/// Numbers of the Jacobian of a condition's rows by a column: `rows` of them from `first` on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    pub column: usize,
    pub first: usize,
    pub sign: f64,
}

/// A joint that closes a loop.
#[derive(Debug, Clone)]
pub(super) struct Closing {
    /// Frames of its second body, and of its first body after the joint's own motion.
    pub second: usize,
    pub end: usize,
    /// Its point at home.
    pub place: [f64; 3],
    /// 3, or 6 where its rotation is a condition, too.
    pub rows: usize,
    /// Its first row.
    pub row: usize,
    pub blocks: Vec<Block>,
}

/// The conditions of the output.
#[derive(Debug, Clone)]
pub(super) struct Output {
    pub frame: usize,
    pub place: [f64; 3],
    /// Coordinates that are followed.
    pub coordinates: Vec<usize>,
    /// Whether all three of the rotation are.
    pub whole: bool,
    /// Whether some of the rotation are.
    pub turns: bool,
    pub row: usize,
    pub blocks: Vec<Block>,
}

/// The arithmetic of a pose.
#[derive(Debug, Clone)]
pub(super) struct Program {
    pub columns: usize,
    pub rows: usize,
    /// Numbers in the Jacobian, those of the drives apart, which are 1.
    pub entries: usize,
    /// Frames; the first is the ground's.
    pub frames: usize,
    pub moves: Vec<Move>,
    /// Frame of every body.
    pub bodies: Vec<usize>,
    pub closings: Vec<Closing>,
    pub output: Output,
    /// Columns of the drives that are asked; their rows are the last.
    pub drives: Vec<usize>,
    pub pattern: Pattern,
}

impl Program {
    /// `None` where a joint of the tree turns freely: its rotation is no column's value.
    pub fn new(system: &System, asked: &Asked) -> Option<Self> {
        let linkage = &system.linkage;
        let size = system.size;
        let in_tree = |joint: usize| !linkage.closings.contains(&joint);
        let free_turns =
            |(k, joint): (usize, &crate::motion::JointMotion)| joint.ball && in_tree(k);
        if linkage.joints.iter().enumerate().any(free_turns) {
            return None;
        }
        let mut program = Self {
            columns: linkage.columns.len(),
            rows: 0,
            entries: 0,
            frames: 1,
            moves: Vec::new(),
            bodies: vec![0; linkage.chains.len()],
            closings: Vec::new(),
            output: Output {
                frame: 0,
                place: (system.output.1.coords / size).into(),
                coordinates: (0..6).filter(|k| asked.output[*k]).collect(),
                whole: asked.output[3..] == [true; 3],
                turns: asked.output[3..].contains(&true),
                row: 0,
                blocks: Vec::new(),
            },
            drives: asked.drives.clone(),
            pattern: Pattern::default(),
        };
        for step in &linkage.steps {
            let [first, second] = linkage.joints[step.joint].bodies;
            let parent = if step.forward { first } else { second };
            let from = parent.map_or(0, |body| program.bodies[body]);
            let end = program.motion(system, step.joint, from, step.forward);
            program.bodies[step.child] = end;
        }
        for &joint in &linkage.closings {
            program.close(system, joint);
        }
        program.follow(system);
        program.rows += program.drives.len();
        program.pattern = Pattern::new(&program);
        Some(program)
    }

    /// The factors of a joint from the frame of one of its bodies to that of the other.
    fn motion(&mut self, system: &System, joint: usize, from: usize, forward: bool) -> usize {
        let linkage = &system.linkage;
        let motion = &linkage.joints[joint];
        let home = Isometry3::from_parts(
            (motion.home.translation.vector / system.size).into(),
            motion.home.rotation,
        );
        let start = linkage.starts[joint];
        let mut factors: Vec<_> = motion.factors.iter().enumerate().collect();
        if !forward {
            factors.reverse();
        }
        let mut frame = from;
        for (place, (_, twist)) in factors {
            let column = start + place;
            // A travel is in sizes, and so is what a screw travels in a turn.
            let unit = linkage.columns[column].unit;
            let scaled = Twist {
                linear: twist.linear * (unit / system.size),
                angular: twist.angular * unit,
            };
            let seen = scaled.seen_through(&home);
            let sign = if forward { 1.0 } else { -1.0 };
            self.moves.push(Move {
                column,
                from: frame,
                to: self.frames,
                linear: seen.linear.into(),
                angular: seen.angular.into(),
                turn: Turn::of(&seen, sign),
                sign,
            });
            frame = self.frames;
            self.frames += 1;
        }
        frame
    }

    fn close(&mut self, system: &System, joint: usize) {
        let linkage = &system.linkage;
        let motion = &linkage.joints[joint];
        let [first, second] = motion.bodies;
        let frame = |body: Option<usize>| body.map_or(0, |body| self.bodies[body]);
        let (from, second_frame) = (frame(first), frame(second));
        let end = self.motion(system, joint, from, true);
        // What moves both sides alike opens no gap.
        let mut signs = vec![0.0; self.columns];
        let chain = |body: Option<usize>| body.map_or(&[][..], |body| &linkage.chains[body][..]);
        for (column, sign) in chain(second) {
            signs[*column] += sign;
        }
        for (column, sign) in chain(first) {
            signs[*column] -= sign;
        }
        for sign in &mut signs[linkage.starts[joint]..linkage.starts[joint + 1]] {
            *sign -= 1.0;
        }
        let rows = if motion.ball { 3 } else { 6 };
        let blocks = self.blocks(&signs, rows);
        self.closings.push(Closing {
            second: second_frame,
            end,
            place: (motion.home.translation.vector / system.size).into(),
            rows,
            row: self.rows,
            blocks,
        });
        self.rows += rows;
    }

    fn follow(&mut self, system: &System) {
        let mut signs = vec![0.0; self.columns];
        for (column, sign) in &system.linkage.chains[system.output.0] {
            signs[*column] += sign;
        }
        let rows = self.output.coordinates.len();
        self.output.frame = self.bodies[system.output.0];
        self.output.row = self.rows;
        self.output.blocks = self.blocks(&signs, rows);
        self.rows += rows;
    }

    fn blocks(&mut self, signs: &[f64], rows: usize) -> Vec<Block> {
        if rows == 0 {
            return Vec::new();
        }
        let moved = signs.iter().enumerate().filter(|(_, sign)| **sign != 0.0);
        moved
            .map(|(column, sign)| {
                let first = self.entries;
                self.entries += rows;
                Block {
                    column,
                    first,
                    sign: *sign,
                }
            })
            .collect()
    }

    /// All conditions that are no drive's: their columns, numbers of rows and first rows.
    pub fn conditions(&self) -> impl Iterator<Item = (&[Block], usize, usize)> {
        let closings = self.closings.iter();
        let closings = closings.map(|c| (&c.blocks[..], c.rows, c.row));
        let output = &self.output;
        closings.chain([(&output.blocks[..], output.coordinates.len(), output.row)])
    }
}

impl Turn {
    fn of(twist: &Twist, sign: f64) -> Option<Self> {
        let rate = twist.angular.norm();
        if rate == 0.0 {
            return None;
        }
        let axis = twist.angular / rate;
        let linear = twist.linear / rate;
        let once = axis.cross_matrix();
        let by_columns = |m: &nalgebra::Matrix3<f64>| {
            [0, 1, 2].map(|c| <[f64; 3]>::from(m.column(c).into_owned()))
        };
        let arm: Vector3<f64> = axis.cross(&linear);
        let u = axis.cross(&arm);
        Some(Self {
            rate: rate * sign,
            once: by_columns(&once),
            twice: by_columns(&(once * once)),
            u: u.into(),
            v: axis.cross(&u).into(),
            t: (axis * axis.dot(&linear)).into(),
        })
    }
}
