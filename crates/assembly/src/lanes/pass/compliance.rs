//! The compliance of a chain at a pose: that of its links, added up in the axes and about the centre
//! of the softest one.

use pulp::Simd;

use super::blocks::{both, element_axes, spectral, vector};
use super::lane::{
    Lane, Mat3, TRIANGLE, Vec3, add, apply, cross, dot, product, product_transposed, scaled, sub,
    three, transposed,
};
use crate::lanes::program::chain::{
    BeamLink, Chain, ComplianceBlock, JointLink, LinkKind, Release,
};

/// Six numbers: rotations about the chain's x, y, z, times its size, then translations along
/// y, z, x, the direction along the softest beam last; or the wrench that works on them.
pub(crate) type Six<S> = [Lane<S>; 6];

/// Places of the translations along x, y, z among six numbers.
pub(crate) const LINEAR: [usize; 3] = [5, 3, 4];

/// The axes (as rows) and the point that a chain's compliance is added up in.
pub(crate) struct Frame<S: Simd> {
    pub axes: Mat3<S>,
    pub origin: Vec3<S>,
    /// Over the chain's size.
    pub per_size: Lane<S>,
    /// Its square, for rotations per moments.
    square: Lane<S>,
}

impl<S: Simd> Frame<S> {
    #[inline(always)]
    pub fn new(simd: S, chain: &Chain, inputs: &[S::f64s]) -> Self {
        let (axes, origin) = match &chain.links[0].kind {
            LinkKind::Beam(beam) => {
                let [from, to] = both(simd, inputs, beam.ends);
                let span = sub(&to, &from);
                let x = scaled(&span, dot(&span, &span).sqrt().recip());
                let axes = match beam.y_axis {
                    Some(y_axis) => element_axes(&x, &vector(simd, inputs, y_axis)),
                    None => any_axes(&x),
                };
                let centre = Lane::splat(simd, beam.planes[0].centre);
                (axes, three!(k => span[k].mul_add(centre, from[k])))
            }
            LinkKind::Joint(joint) => (
                three!(k => vector(simd, inputs, joint.columns[k])),
                vector(simd, inputs, joint.point),
            ),
            LinkKind::Spring { along, .. } => {
                let zero = Lane::splat(simd, 0.0);
                let one = Lane::splat(simd, 1.0);
                let axes = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
                (axes, vector(simd, inputs, along.point))
            }
        };
        Self {
            axes,
            origin,
            per_size: Lane::splat(simd, 1.0 / chain.size),
            square: Lane::splat(simd, chain.size * chain.size),
        }
    }

    /// From the origin to a point, in the chain's axes, over its size.
    #[inline(always)]
    pub fn arm_to(&self, point: &Vec3<S>) -> Vec3<S> {
        scaled(&apply(&self.axes, &sub(point, &self.origin)), self.per_size)
    }

    /// A free motion.
    #[inline(always)]
    pub fn twist(&self, simd: S, release: &Release, inputs: &[S::f64s]) -> Six<S> {
        let zero = Lane::splat(simd, 0.0);
        let (mut linear, mut angular): (Vec3<S>, Vec3<S>) = ([zero; 3], [zero; 3]);
        for (column, along, about) in &release.axes {
            let axis = apply(&self.axes, &vector(simd, inputs, *column));
            if *along != 0.0 {
                linear = add(&linear, &scaled(&axis, Lane::splat(simd, *along)));
            }
            if *about != 0.0 {
                angular = add(&angular, &scaled(&axis, Lane::splat(simd, *about)));
            }
        }
        let point = vector(simd, inputs, release.point);
        let back = apply(&self.axes, &sub(&self.origin, &point));
        let moved = cross(&angular, &back);
        let linear = scaled(&add(&linear, &moved), self.per_size);
        [
            angular[0], angular[1], angular[2], linear[1], linear[2], linear[0],
        ]
    }

    /// The work of a wrench on a free motion, and the sum of its terms' squares.
    #[inline(always)]
    pub fn work(
        &self,
        simd: S,
        release: &Release,
        wrench: &Six<S>,
        inputs: &[S::f64s],
    ) -> [Lane<S>; 2] {
        let twist = self.twist(simd, release, inputs);
        let zero = Lane::splat(simd, 0.0);
        let (mut work, mut terms) = (zero, zero);
        for k in 0..6 {
            let term = twist[k] * wrench[k];
            work += term;
            terms = term.mul_add(term, terms);
        }
        [work, terms]
    }
}

/// The compliance of all links of a chain, its lower triangle.
#[inline(always)]
pub(crate) fn compliance<S: Simd>(
    simd: S,
    chain: &Chain,
    frame: &Frame<S>,
    inputs: &[S::f64s],
) -> [Six<S>; 6] {
    let mut sum = Compliance::zero(simd);
    for k in 0..chain.links.len() {
        sum.add_link(simd, chain, k, frame, inputs);
    }
    sum.entries
}

/// The same, where the compliance of each link is kept too: its lower triangle by rows, one after the
/// other.
#[inline(always)]
pub(crate) fn compliances<S: Simd>(
    simd: S,
    chain: &Chain,
    frame: &Frame<S>,
    inputs: &[S::f64s],
    links: &mut [S::f64s],
) -> [Six<S>; 6] {
    let mut sum = Compliance::zero(simd);
    for (k, kept) in (0..chain.links.len()).zip(links.chunks_exact_mut(TRIANGLE)) {
        let mut own = Compliance::zero(simd);
        own.add_link(simd, chain, k, frame, inputs);
        let mut next = 0;
        for i in 0..6 {
            for j in 0..=i {
                kept[next] = own.entries[i][j].value;
                sum.entries[i][j] += own.entries[i][j];
                next += 1;
            }
        }
    }
    sum.entries
}

/// Unit vectors normal to a unit vector and to each other, as rows, the given one first (Duff et
/// al., Building an orthonormal basis, revisited, 2017).
#[inline(always)]
fn any_axes<S: Simd>(x: &Vec3<S>) -> Mat3<S> {
    let (zero, one) = (x[0].constant(0.0), x[0].constant(1.0));
    let sign = x[2].if_above(zero, one, -one);
    let a = -(sign + x[2]).recip();
    let b = x[0] * x[1] * a;
    let y = [
        (sign * x[0] * x[0]).mul_add(a, one),
        sign * b,
        -(sign * x[0]),
    ];
    let z = [b, (x[1] * x[1]).mul_add(a, sign), -x[1]];
    [*x, y, z]
}

/// A symmetric 6×6 compliance, its lower triangle.
struct Compliance<S: Simd> {
    entries: [Six<S>; 6],
}

impl<S: Simd> Compliance<S> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        let zero = Lane::splat(simd, 0.0);
        Self {
            entries: [[zero; 6]; 6],
        }
    }

    /// Adds a link; the first one is the softest.
    #[inline(always)]
    fn add_link(&mut self, simd: S, chain: &Chain, k: usize, frame: &Frame<S>, inputs: &[S::f64s]) {
        match &chain.links[k].kind {
            LinkKind::Beam(beam) if k == 0 => add_own(simd, beam, inputs, frame, self),
            LinkKind::Beam(beam) => add_beam(simd, beam, inputs, frame, self),
            LinkKind::Joint(joint) => add_joint(simd, joint, inputs, frame, self),
            LinkKind::Spring { along, compliance } => {
                let twist = frame.twist(simd, along, inputs);
                self.add_springs([(twist, Lane::splat(simd, *compliance) * frame.square)]);
            }
        }
    }

    /// Adds springs, each of which gives way along a motion.
    #[inline(always)]
    fn add_springs<const N: usize>(&mut self, springs: [(Six<S>, Lane<S>); N]) {
        for i in 0..6 {
            let mut by = [springs[0].1; N];
            for k in 0..N {
                by[k] = springs[k].0[i] * springs[k].1;
            }
            for j in 0..=i {
                // Read and written once, whatever their number.
                let mut entry = self.entries[i][j];
                for k in 0..N {
                    entry = by[k].mul_add(springs[k].0[j], entry);
                }
                self.entries[i][j] = entry;
            }
        }
    }

    #[inline(always)]
    fn add(&mut self, i: usize, j: usize, value: Lane<S>) {
        if i >= j {
            self.entries[i][j] += value;
        } else {
            self.entries[j][i] += value;
        }
    }

    /// Adds a compliance about a point at `arm` from the origin: translations per forces,
    /// rotations per moments, and translations per moments where there are any.
    #[inline(always)]
    fn add_part(
        &mut self,
        translation: Option<&Mat3<S>>,
        rotation: &Mat3<S>,
        coupling: Option<&Mat3<S>>,
        arm: &Vec3<S>,
    ) {
        // Translation at the origin by a moment: that at the point, and the rotation's `arm × φ`.
        let by_columns = three!(j => cross(arm, &three!(i => rotation[i][j])));
        let mut moved = transposed(&by_columns);
        if let Some(coupling) = coupling {
            moved = three!(i => add(&moved[i], &coupling[i]));
        }
        let turned: Mat3<S> = three!(i => cross(arm, &moved[i]));
        for i in 0..3 {
            for j in 0..=i {
                self.add(i, j, rotation[i][j]);
                let mut sum = turned[i][j];
                if let Some(translation) = translation {
                    sum += translation[i][j];
                }
                if let Some(coupling) = coupling {
                    sum += cross(arm, &coupling[j])[i];
                }
                self.add(LINEAR[i], LINEAR[j], sum);
            }
            for j in 0..3 {
                self.add(LINEAR[i], j, moved[i][j]);
            }
        }
    }
}

/// A beam's flexibilities at a length: along it, about it, and in its planes deflection and turn.
struct Give<S: Simd> {
    axial: Lane<S>,
    torsion: Lane<S>,
    deflections: [Lane<S>; 2],
    turns: [Lane<S>; 2],
}

#[inline(always)]
fn give<S: Simd>(beam: &BeamLink, length: Lane<S>, square: Lane<S>) -> Give<S> {
    let turning = length * square;
    let cube = length * length * length;
    let [y, z] = &beam.planes;
    let of = |value: f64| length.constant(value);
    let (mut in_y, mut in_z) = (of(y.bending) * cube, of(z.bending) * cube);
    if y.shear != 0.0 {
        in_y = of(y.shear).mul_add(length, in_y);
    }
    if z.shear != 0.0 {
        in_z = of(z.shear).mul_add(length, in_z);
    }
    Give {
        axial: of(beam.axial) * length,
        torsion: of(beam.torsional) * turning,
        deflections: [in_y, in_z],
        turns: [of(y.turn) * turning, of(z.turn) * turning],
    }
}

/// The softest beam, in its own axes about its own centre.
#[inline(always)]
fn add_own<S: Simd>(
    simd: S,
    beam: &BeamLink,
    inputs: &[S::f64s],
    frame: &Frame<S>,
    sum: &mut Compliance<S>,
) {
    let [from, to] = both(simd, inputs, beam.ends);
    let span = sub(&to, &from);
    let length = dot(&span, &span).sqrt();
    let give = give(beam, length, frame.square);
    sum.add(0, 0, give.torsion);
    sum.add(1, 1, give.turns[1]);
    sum.add(2, 2, give.turns[0]);
    sum.add(3, 3, give.deflections[0]);
    sum.add(4, 4, give.deflections[1]);
    sum.add(5, 5, give.axial);
    let apart = beam.planes[1].centre - beam.planes[0].centre;
    if apart != 0.0 {
        // A force along z turns about y too.
        let arm = length * frame.per_size * Lane::splat(simd, apart);
        let moved = arm * give.turns[1];
        sum.add(4, 1, moved);
        sum.add(4, 4, arm * moved);
    }
}

/// Any other beam.
#[inline(always)]
fn add_beam<S: Simd>(
    simd: S,
    beam: &BeamLink,
    inputs: &[S::f64s],
    frame: &Frame<S>,
    sum: &mut Compliance<S>,
) {
    let zero = Lane::splat(simd, 0.0);
    let [from, to] = both(simd, inputs, beam.ends);
    let span = sub(&to, &from);
    let length = dot(&span, &span).sqrt();
    let give = give(beam, length, frame.square);
    let x = scaled(&span, length.recip());
    let centre = |k: usize| Lane::splat(simd, beam.planes[k].centre);
    let first = centre(0);
    let first = frame.arm_to(&three!(k => span[k].mul_add(first, from[k])));
    let Some(y_axis) = beam.y_axis else {
        let x = apply(&frame.axes, &x);
        let translation = across_and_along(&x, give.deflections[0], give.axial);
        let rotation = across_and_along(&x, give.turns[0], give.torsion);
        sum.add_part(Some(&translation), &rotation, None, &first);
        return;
    };
    let axes = element_axes(&x, &vector(simd, inputs, y_axis));
    let axes = three!(k => apply(&frame.axes, &axes[k]));
    if beam.planes[0].centre == beam.planes[1].centre {
        let translation = spectral(
            &axes,
            [give.axial, give.deflections[0], give.deflections[1]],
        );
        let rotation = spectral(&axes, [give.torsion, give.turns[1], give.turns[0]]);
        sum.add_part(Some(&translation), &rotation, None, &first);
        return;
    }
    let translation = spectral(&axes, [give.axial, give.deflections[0], zero]);
    let rotation = spectral(&axes, [give.torsion, zero, give.turns[0]]);
    sum.add_part(Some(&translation), &rotation, None, &first);
    let second = centre(1);
    let second = frame.arm_to(&three!(k => span[k].mul_add(second, from[k])));
    let translation = spectral(&axes, [zero, zero, give.deflections[1]]);
    let rotation = spectral(&axes, [zero, give.turns[1], zero]);
    sum.add_part(Some(&translation), &rotation, None, &second);
}

/// `across (E − x xᵀ) + along x xᵀ` for a unit vector x, without a difference.
#[inline(always)]
fn across_and_along<S: Simd>(x: &Vec3<S>, across: Lane<S>, along: Lane<S>) -> Mat3<S> {
    let squares = three!(k => x[k] * x[k]);
    let minus = along - across;
    three!(i => three!(j => {
        if i == j {
            let others = squares[(i + 1) % 3] + squares[(i + 2) % 3];
            across.mul_add(others, along * squares[i])
        } else {
            minus * x[i] * x[j]
        }
    }))
}

/// A joint.
#[inline(always)]
fn add_joint<S: Simd>(
    simd: S,
    joint: &JointLink,
    inputs: &[S::f64s],
    frame: &Frame<S>,
    sum: &mut Compliance<S>,
) {
    let axes = three!(k => apply(&frame.axes, &vector(simd, inputs, joint.columns[k])));
    let arm = frame.arm_to(&vector(simd, inputs, joint.point));
    let one = Lane::splat(simd, 1.0);
    let translation = turned(simd, &joint.translation, &axes, one);
    if let (ComplianceBlock::Diagonal(values), None) = (&joint.rotation, &joint.coupling) {
        // Springs about its axes: where their arms' parts cancel, nothing of a soft one is left.
        for i in 0..3 {
            for j in 0..=i {
                sum.add(LINEAR[i], LINEAR[j], translation[i][j]);
            }
        }
        let gives = values.map(|value| value != 0.0);
        let about = About { axes, arm };
        match gives.iter().filter(|gives| **gives).count() {
            0 => {}
            1 => {
                let k = usize::from(gives[1]) + 2 * usize::from(gives[2]);
                sum.add_springs([about.spring(simd, k, values[k], frame.square)]);
            }
            2 => {
                // The one that is rigid is left out.
                let first = usize::from(!gives[0]);
                let second = 1 + usize::from(gives[2]);
                sum.add_springs([
                    about.spring(simd, first, values[first], frame.square),
                    about.spring(simd, second, values[second], frame.square),
                ]);
            }
            _ => sum.add_springs([
                about.spring(simd, 0, values[0], frame.square),
                about.spring(simd, 1, values[1], frame.square),
                about.spring(simd, 2, values[2], frame.square),
            ]),
        }
        return;
    }
    let rotation = turned(simd, &joint.rotation, &axes, frame.square);
    match &joint.coupling {
        None => sum.add_part(Some(&translation), &rotation, None, &arm),
        Some(own) => {
            let size = (frame.per_size * frame.square).value;
            let size = Lane::new(simd, size);
            let own: Mat3<S> = three!(r => three!(c => Lane::splat(simd, own[(r, c)]) * size));
            let columns = transposed(&axes);
            let coupling = product_transposed(&product(&columns, &own), &columns);
            sum.add_part(Some(&translation), &rotation, Some(&coupling), &arm);
        }
    }
}

/// The axes of a joint as rows, and the arm to it.
struct About<S: Simd> {
    axes: Mat3<S>,
    arm: [Lane<S>; 3],
}

impl<S: Simd> About<S> {
    /// The spring about one of the axes: its motion, and what it gives.
    #[inline(always)]
    fn spring(&self, simd: S, k: usize, compliance: f64, square: Lane<S>) -> (Six<S>, Lane<S>) {
        let (axis, moved) = (&self.axes[k], cross(&self.arm, &self.axes[k]));
        let along = [axis[0], axis[1], axis[2], moved[1], moved[2], moved[0]];
        (along, Lane::splat(simd, compliance) * square)
    }
}

/// A part of a joint's compliance in the chain's axes; `axes`: the joint's as rows.
#[inline(always)]
fn turned<S: Simd>(simd: S, part: &ComplianceBlock, axes: &Mat3<S>, by: Lane<S>) -> Mat3<S> {
    match part {
        ComplianceBlock::Diagonal(values) => {
            spectral(axes, three!(k => Lane::splat(simd, values[k]) * by))
        }
        ComplianceBlock::Full(own) => {
            let own: Mat3<S> = three!(r => three!(c => Lane::splat(simd, own[(r, c)]) * by));
            let columns = transposed(axes);
            product_transposed(&product(&columns, &own), &columns)
        }
    }
}
