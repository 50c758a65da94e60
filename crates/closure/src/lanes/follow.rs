//! The way from home to eight targets, in parts that keep the branch: what `path.rs` does with one.

use hyperstat_model::LANES;
use nalgebra::{UnitQuaternion, Vector3};

use crate::equations::{Goal, System};
use crate::lanes::lane::{Lane, largest, norm};
use crate::lanes::pass::{Numbers, Wanted};
use crate::lanes::program::{Asked, Program};
use crate::lanes::solve::Factor;
use crate::newton::CLOSED;
use crate::path::{LONGEST, OFF, SAME_SIDE};

/// Parts of a way that are tried at most.
const ATTEMPTS: usize = 32;
/// Shortest part that is tried.
const SHORTEST: f64 = 1.0 / 512.0;
/// Most that a coordinate moves in one part by its prediction at home, where parts are chosen.
const PLANNED: f64 = 0.4;
/// Newton steps of a part at most.
const STEPS: usize = 8;
/// A step is the last where the next is no more than this: at the end of the way, and before it, where
/// the next part mends what is left.
const SETTLED: [f64; 2] = [1e-14, 1e-4];
/// Every step must be shorter than this share of the one before.
const SHRINKS: f64 = 0.5;
/// Least share of a column of the Jacobian that is across the others: squared.
const REGULAR: f64 = 1e-7;
/// What the lanes vouch for is inside what is judged by this factor.
const INSIDE: f64 = 0.9;
/// Largest rotation of the output from home (rad) that is known for its rotation vector.
const LARGEST_TURN: f64 = 3.0;

/// The coordinates of eight poses with all that follows from them.
#[derive(Debug, Clone)]
struct State {
    x: Vec<Lane>,
    numbers: Numbers,
    factor: Factor,
}

impl State {
    fn new(program: &Program) -> Self {
        Self {
            x: vec![Lane::ZERO; program.columns],
            numbers: Numbers::new(program),
            factor: Factor::new(program),
        }
    }

    #[inline(always)]
    fn evaluate(&mut self, program: &Program, wanted: &Wanted) {
        self.numbers.pose(program, &self.x);
        self.numbers.miss(program, &self.x, wanted);
        self.numbers.differentiate(program);
        self.factor.factor(program, &self.numbers.jacobian);
    }

    /// Newton's step.
    #[inline(always)]
    fn step(&self, program: &Program, work: &mut [Lane], step: &mut [Lane]) {
        let Numbers {
            jacobian, misfits, ..
        } = &self.numbers;
        self.factor.solve(program, jacobian, misfits, work, step);
    }
}

/// A mechanism, what is asked of it, and room for eight poses.
#[derive(Debug, Clone)]
pub(super) struct Follower {
    pub program: Program,
    home: State,
    here: State,
    trial: State,
    /// Coordinates of the output at home: position from the centre (sizes), rotation vector.
    from: [f64; 6],
    /// What is asked at the end of the way.
    end: Wanted,
    wanted: Wanted,
    /// Lengths that positions and columns are over (m; 1 for angles).
    size: f64,
    units: Vec<f64>,
    first: Vec<Lane>,
    moved: Vec<Lane>,
    step: Vec<Lane>,
    back: Vec<Lane>,
    work: Vec<Lane>,
    lower: Vec<Lane>,
    upper: Vec<Lane>,
}

impl Follower {
    /// `None` where the lanes do not take the mechanism: home is not regular, or it has coordinates
    /// that are idle, whose values are those of the way.
    pub fn new(system: &System, asked: &Asked) -> Option<Self> {
        let program = Program::new(system, asked)?;
        let size = system.size;
        let mut from = system.coordinates(&system.linkage.home());
        for position in &mut from[..3] {
            *position /= size;
        }
        let state = State::new(&program);
        let numbers = vec![Lane::ZERO; program.columns];
        let triangle = vec![Lane::ZERO; program.pattern.entries.len()];
        let wanted = Wanted {
            drives: vec![Lane::ZERO; program.drives.len()],
            ..Wanted::default()
        };
        let mut follower = Self {
            home: state.clone(),
            here: state.clone(),
            trial: state,
            from,
            end: wanted.clone(),
            wanted,
            size,
            units: system.linkage.columns.iter().map(|c| c.unit).collect(),
            first: numbers.clone(),
            moved: numbers.clone(),
            step: numbers.clone(),
            back: numbers.clone(),
            work: numbers,
            lower: triangle.clone(),
            upper: triangle,
            program,
        };
        follower.aim(&[const { None }; LANES]);
        follower.want([0.0; LANES]);
        follower.home.evaluate(&follower.program, &follower.wanted);
        let least = follower.home.factor.least.0[0];
        (least >= REGULAR).then_some(follower)
    }

    /// Value of a column in a pose that was reached (m or rad).
    pub fn value(&self, column: usize, lane: usize) -> f64 {
        self.here.x[column].0[lane] * self.units[column]
    }

    /// Where all bodies are in the poses that were reached.
    pub fn numbers(&self) -> &Numbers {
        &self.here.numbers
    }

    /// Sets the ends of the ways; home where there is no target.
    fn aim(&mut self, goals: &[Option<&Goal>; LANES]) {
        for (lane, goal) in goals.iter().enumerate() {
            for k in 0..6 {
                let unit = if k < 3 { self.size } else { 1.0 };
                let asked = goal.and_then(|goal| goal.output[k]);
                self.end.output[k].0[lane] = asked.map_or(self.from[k], |value| value / unit);
            }
            for (row, wanted) in self.end.drives.iter_mut().enumerate() {
                let unit = self.units[self.program.drives[row]];
                wanted.0[lane] = goal.map_or(0.0, |goal| goal.drives[row].1 / unit);
            }
        }
    }

    /// What is asked at these parts of the ways.
    fn want(&mut self, parts: [f64; LANES]) {
        for (lane, part) in parts.into_iter().enumerate() {
            let at = |from: f64, to: f64| {
                if part >= 1.0 {
                    to
                } else {
                    from + (to - from) * part
                }
            };
            for k in 0..6 {
                self.wanted.output[k].0[lane] = at(self.from[k], self.end.output[k].0[lane]);
            }
            for (wanted, end) in self.wanted.drives.iter_mut().zip(&self.end.drives) {
                wanted.0[lane] = at(0.0, end.0[lane]);
            }
            if self.program.output.whole {
                let turn = Vector3::from_fn(|k, _| self.wanted.output[3 + k].0[lane]);
                let turn = UnitQuaternion::from_scaled_axis(turn).to_rotation_matrix();
                for (c, column) in self.wanted.turn.iter_mut().enumerate() {
                    for (r, number) in column.iter_mut().enumerate() {
                        number.0[lane] = turn[(r, c)];
                    }
                }
            }
        }
    }

    /// Follows the ways to these goals, all of the kind that is asked; says which of them it vouches
    /// for. No way depends on the others.
    #[inline(always)]
    pub fn follow(&mut self, goals: &[Option<&Goal>; LANES]) -> [bool; LANES] {
        self.aim(goals);
        let mut open = goals.map(|goal| goal.is_some());
        let mut reached = [false; LANES];
        let mut done = [0.0; LANES];
        let mut parts = self.plan();
        let mut turns = [Vector3::zeros(); LANES];
        self.here.x.copy_from_slice(&self.home.x);
        for attempt in 0..ATTEMPTS {
            if !open.contains(&true) {
                break;
            }
            if attempt > 0 {
                self.want(done);
                self.here.evaluate(&self.program, &self.wanted);
            }
            let mut next = done;
            for lane in (0..LANES).filter(|lane| open[*lane]) {
                let sum = done[lane] + parts[lane];
                next[lane] = if sum > 1.0 - 1e-9 { 1.0 } else { sum };
            }
            let settled = self.solve(attempt == 0, open, next);
            let kept = self.keeps_branch(attempt == 0, settled, done);
            for (x, (from, step)) in
                (self.here.x.iter_mut()).zip(self.trial.x.iter().zip(&self.step))
            {
                *x = (*from + *step).or(kept, *x);
            }
            let tried = open;
            for lane in (0..LANES).filter(|lane| tried[*lane]) {
                let [.., rx, ry, rz] = self.trial.numbers.output(&self.program, lane);
                let turn = Vector3::new(rx, ry, rz);
                let known = turn.norm() < LARGEST_TURN && (turn - turns[lane]).norm() < 2.0;
                if kept[lane] && known {
                    done[lane] = next[lane];
                    turns[lane] = turn;
                    reached[lane] = done[lane] >= 1.0;
                    open[lane] = !reached[lane];
                } else {
                    parts[lane] *= 0.5;
                    open[lane] = !kept[lane] && parts[lane] >= SHORTEST;
                }
            }
        }
        if !reached.contains(&true) {
            return reached;
        }
        self.want([1.0; LANES]);
        let Self {
            here,
            program,
            wanted,
            ..
        } = self;
        here.numbers.pose(program, &here.x);
        here.numbers.miss(program, &here.x, wanted);
        let misfit = here.numbers.largest_misfit();
        std::array::from_fn(|lane| reached[lane] && misfit.0[lane] <= INSIDE * CLOSED)
    }

    /// In what parts to go, by the tangent at home.
    #[inline(always)]
    fn plan(&mut self) -> [f64; LANES] {
        self.want([1.0; LANES]);
        let Self {
            home,
            program,
            wanted,
            work,
            first,
            ..
        } = self;
        home.numbers.miss_target(program, &home.x, wanted);
        home.step(program, work, first);
        largest(first).0.map(|largest| match largest <= LONGEST {
            true => 1.0,
            false => 1.0 / (largest / PLANNED).ceil(),
        })
    }

    /// Newton's method from here (or home) to the next parts of the ways, in full steps that must
    /// become shorter quadratically. What is settled stands in `trial`, its last step not yet taken.
    #[inline(always)]
    fn solve(&mut self, at_home: bool, open: [bool; LANES], next: [f64; LANES]) -> [bool; LANES] {
        self.want(next);
        let Self {
            home,
            here,
            trial,
            program,
            wanted,
            first,
            moved,
            step,
            work,
            ..
        } = self;
        let start = if at_home { home } else { here };
        start.numbers.miss_target(program, &start.x, wanted);
        start.step(program, work, first);
        for (k, x) in trial.x.iter_mut().enumerate() {
            *x = (start.x[k] + first[k]).or(open, start.x[k]);
        }
        moved.copy_from_slice(first);
        let mut settled = [false; LANES];
        let mut going = open;
        let mut before = norm(first);
        for _ in 0..STEPS {
            trial.evaluate(program, wanted);
            trial.step(program, work, step);
            let now = norm(step);
            let stepped = going;
            for lane in (0..LANES).filter(|lane| stepped[*lane]) {
                let (now, before) = (now.0[lane], before.0[lane]);
                let share = now / before;
                let enough = SETTLED[usize::from(next[lane] < 1.0)];
                settled[lane] = now <= 1e-9 || (now <= 1e-2 && now * share * share <= enough);
                going[lane] = !settled[lane] && now <= SHRINKS * before;
            }
            if !going.contains(&true) {
                break;
            }
            for (k, x) in trial.x.iter_mut().enumerate() {
                *x = (*x + step[k]).or(going, *x);
                moved[k] = (moved[k] + step[k]).or(going, moved[k]);
            }
            before = now;
        }
        settled
    }

    /// Of the parts that are settled, those that no branch can begin in: judged as `System::advance`
    /// does.
    #[inline(always)]
    fn keeps_branch(
        &mut self,
        at_home: bool,
        settled: [bool; LANES],
        done: [f64; LANES],
    ) -> [bool; LANES] {
        self.want(done);
        let Self {
            home,
            here,
            trial,
            program,
            wanted,
            first,
            moved,
            step,
            back,
            work,
            lower,
            upper,
            ..
        } = self;
        let start = if at_home { home } else { here };
        for (moved, step) in moved.iter_mut().zip(step.iter()) {
            *moved += *step;
        }
        trial.numbers.miss_target(program, &trial.x, wanted);
        trial.step(program, work, back);
        let jacobians = [&start.numbers.jacobian[..], &trial.numbers.jacobian[..]];
        let orientation = start.factor.orientation(program, jacobians, lower, upper);
        let length = norm(moved);
        let longest = largest(moved);
        let [ahead, behind] = [norm(first), norm(back)];
        let (off_ahead, off_behind) = (off(moved, 1.0, first), off(moved, -1.0, back));
        std::array::from_fn(|lane| {
            let regular =
                trial.factor.least.0[lane] >= REGULAR && start.factor.least.0[lane] >= REGULAR;
            let small = length.0[lane] <= 10.0 * CLOSED;
            let near = longest.0[lane] <= LONGEST
                && off_ahead.0[lane] <= INSIDE * OFF * ahead.0[lane]
                && off_behind.0[lane] <= INSIDE * OFF * behind.0[lane]
                && orientation.0[lane] * INSIDE >= SAME_SIDE;
            settled[lane] && regular && (small || near)
        })
    }
}

/// How far a movement, forwards or backwards, is off its prediction.
#[inline(always)]
fn off(moved: &[Lane], sign: f64, predicted: &[Lane]) -> Lane {
    let mut sum = Lane::ZERO;
    for (moved, predicted) in moved.iter().zip(predicted) {
        let difference = *moved * sign - *predicted;
        sum += difference * difference;
    }
    sum.sqrt()
}
