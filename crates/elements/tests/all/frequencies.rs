//! Natural frequencies of frames and bars, assembled here from the crate's element matrices.

use crate::support;

use std::f64::consts::{PI, TAU};

use hyperstat_elements::{
    Beam, Elasticity, LineMass, MassShape, Material, Matrix12, RotaryInertia, Section,
    SectionShape, Taper, TaperedBeam, element_frame, rotate_matrix12,
};
use nalgebra::{DMatrix, DVector, Vector3};

use support::random::{circle, rectangle};

/// Stiffness and mass of a frame, six unknowns a node.
struct Frame {
    stiffness: DMatrix<f64>,
    mass: DMatrix<f64>,
}

impl Frame {
    fn new(nodes: usize) -> Self {
        Self {
            stiffness: DMatrix::zeros(6 * nodes, 6 * nodes),
            mass: DMatrix::zeros(6 * nodes, 6 * nodes),
        }
    }

    fn add(&mut self, nodes: [usize; 2], stiffness: &Matrix12, mass: &Matrix12) {
        let place = |row: usize| 6 * nodes[row / 6] + row % 6;
        for row in 0..12 {
            for column in 0..12 {
                self.stiffness[(place(row), place(column))] += stiffness[(row, column)];
                self.mass[(place(row), place(column))] += mass[(row, column)];
            }
        }
    }

    /// Eigenvalues ω², lowest first, of the unknowns that `moving` names; unknowns of `still`
    /// have no mass and follow the others.
    fn eigenvalues(&self, moving: &[usize], still: &[usize]) -> DVector<f64> {
        let pick = |m: &DMatrix<f64>, rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |r, c| m[(rows[r], columns[c])])
        };
        let mut k = pick(&self.stiffness, moving, moving);
        if !still.is_empty() {
            let inner = pick(&self.stiffness, still, still).cholesky().unwrap();
            let across = pick(&self.stiffness, still, moving);
            k -= across.transpose() * inner.solve(&across);
        }
        // L⁻¹ K L⁻ᵀ with M = L Lᵀ.
        let l = pick(&self.mass, moving, moving)
            .cholesky()
            .unwrap()
            .unpack();
        let half = l.solve_lower_triangular(&k).unwrap();
        let whole = l.solve_lower_triangular(&half.transpose()).unwrap();
        let mut values: Vec<f64> = ((&whole + whole.transpose()) * 0.5)
            .symmetric_eigenvalues()
            .iter()
            .copied()
            .collect();
        values.sort_by(f64::total_cmp);
        DVector::from_vec(values)
    }
}

fn general(area: f64, inertia: f64, torsion: f64, shear: Option<f64>) -> Section {
    let shape = SectionShape::General {
        area,
        iy: inertia,
        iz: inertia,
        torsion,
        y_max: None,
        z_max: None,
        torsion_modulus: None,
    };
    Section::new(shape, shear, shear).unwrap()
}

/// Bathe and Wilson, Large eigenvalue problems in dynamic analysis (ASCE J. Eng. Mech. 98, 1972),
/// the plane frame of 10 bays and 9 storeys (kip, ft): bays 20, storeys 10, A 3, I 1, E 432000, mass
/// per length 3 lumped in translation only, bases fixed. Published: λ = 0.589541, 5.52695, 16.5878.
#[test]
fn plane_frame_of_bathe_and_wilson() {
    let (bays, storeys) = (10, 9);
    let section = general(3.0, 1.0, 1.0, None);
    let material = Material::new(432_000.0, Elasticity::Poisson(0.3), Some(1.0)).unwrap();
    let mass = LineMass::new(1.0, Taper::constant(section.clone())).unwrap();
    let node = |bay: usize, storey: usize| storey * (bays + 1) + bay;
    let mut frame = Frame::new((bays + 1) * (storeys + 1));
    let mut add = |nodes: [usize; 2], span: Vector3<f64>| {
        let turn = element_frame(&span, None).unwrap();
        let beam = Beam::new(&material, &section, span.norm()).unwrap();
        let stiffness = rotate_matrix12(&beam.stiffness(), &turn);
        frame.add(
            nodes,
            &stiffness,
            &rotate_matrix12(&mass.lumped(span.norm()), &turn),
        );
    };
    for storey in 1..=storeys {
        for bay in 0..=bays {
            add(
                [node(bay, storey - 1), node(bay, storey)],
                Vector3::new(0.0, 0.0, 10.0),
            );
            if bay > 0 {
                add(
                    [node(bay - 1, storey), node(bay, storey)],
                    Vector3::new(20.0, 0.0, 0.0),
                );
            }
        }
    }
    // In the plane x, z: two translations with mass and one turn, about y, without.
    let free = node(0, 1)..=node(bays, storeys);
    let moving: Vec<usize> = free.clone().flat_map(|n| [6 * n, 6 * n + 2]).collect();
    let still: Vec<usize> = free.map(|n| 6 * n + 4).collect();
    let found = frame.eigenvalues(&moving, &still);
    for (k, expected) in [(0, 0.589541), (1, 5.52695), (2, 16.5878)] {
        let error = (found[k] / expected - 1.0).abs();
        assert!(error < 5e-6, "{}: {} {expected}", k + 1, found[k]);
    }
}

/// frame3dd's example B (Gavin, Duke University; N, mm, tonne), a pyramid of four beams: the figures
/// of that program without geometric stiffness, 0.1 t added at the top. It leaves the rotary
/// inertia of bending out.
#[test]
fn pyramid_of_frame3dd_example_b() {
    let section = general(36.0, 492.0, 1000.0, Some(20.0));
    let material = Material::new(200_000.0, Elasticity::Shear(79_300.0), Some(7.85e-9)).unwrap();
    let mass = LineMass::new(7.85e-9, Taper::constant(section.clone())).unwrap();
    let points = [
        Vector3::new(0.0, 0.0, 1000.0),
        Vector3::new(-1200.0, -900.0, 0.0),
        Vector3::new(1200.0, -900.0, 0.0),
        Vector3::new(1200.0, 900.0, 0.0),
        Vector3::new(-1200.0, 900.0, 0.0),
    ];
    let frequencies = |rotary: RotaryInertia| {
        let mut frame = Frame::new(points.len());
        for nodes in [[1, 0], [0, 2], [0, 3], [4, 0]] {
            let span: Vector3<f64> = points[nodes[1]] - points[nodes[0]];
            let turn = element_frame(&span, None).unwrap();
            let beam = Beam::new(&material, &section, span.norm()).unwrap();
            let consistent = mass.consistent(&beam, MassShape::Cubic, rotary);
            frame.add(
                nodes,
                &rotate_matrix12(&beam.stiffness(), &turn),
                &rotate_matrix12(&consistent, &turn),
            );
        }
        for d in 0..3 {
            frame.mass[(d, d)] += 0.1;
        }
        let values = frame.eigenvalues(&[0, 1, 2, 3, 4, 5], &[]);
        values.map(|value| value.sqrt() / TAU)
    };
    let published = [19.33742, 19.54486, 20.15552, 31.71370, 35.15949, 42.24975];
    let found = frequencies(RotaryInertia::Left);
    for (found, expected) in found.iter().zip(published) {
        assert!((found - expected).abs() <= 5e-6, "{found} {expected}");
    }
}

/// A cantilever of `count` elements along x, all unknowns of bending along y: (ω², lowest first).
fn cantilever(elements: &[(Matrix12, Matrix12)]) -> DVector<f64> {
    let mut frame = Frame::new(elements.len() + 1);
    for (k, (stiffness, mass)) in elements.iter().enumerate() {
        frame.add([k, k + 1], stiffness, mass);
    }
    let moving: Vec<usize> = (1..=elements.len())
        .flat_map(|n| [6 * n + 1, 6 * n + 5])
        .collect();
    frame.eigenvalues(&moving, &[])
}

/// Euler–Bernoulli cantilever (Blevins, Formulas for Natural Frequency and Mode Shape, Table 8-1):
/// λ = 1.87510407, 4.69409113, 7.85475744; consistent masses bound from above, ω² by
/// (λ h)⁴/720 of itself (Strang and Fix, An Analysis of the Finite Element Method, §6.2).
#[test]
fn cantilever_of_blevins() {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
    let section = rectangle(0.02, 0.03, None);
    let (length, density) = (0.8_f64, 7850.0);
    let mass = LineMass::new(density, Taper::constant(section.clone())).unwrap();
    let unit = material.young() * section.iz() / (density * section.area() * length.powi(4));
    for count in [8, 16] {
        let beam = Beam::new(&material, &section, length / count as f64).unwrap();
        let consistent = mass.consistent(&beam, MassShape::Exact, RotaryInertia::Left);
        let found = cantilever(&vec![(beam.stiffness(), consistent); count]);
        for (k, lambda) in [1.875_104_069, 4.694_091_133, 7.854_757_438_f64]
            .into_iter()
            .enumerate()
        {
            let error = found[k] / (unit * lambda.powi(4)) - 1.0;
            let expected = (lambda / count as f64).powi(4) / 720.0;
            assert!(
                (error - expected).abs() < 0.1 * expected + 1e-9,
                "{count}: {error:e} {expected:e}"
            );
        }
    }
}

/// Pinned Timoshenko beam (Huang 1961; Blevins, §8.1). With v = V sin kx and φ = Φ cos kx, k = nπ/L:
/// κGA k (k V − Φ) = ρA ω² V and E I k² Φ + κGA (Φ − k V) = ρI ω² Φ. Consistent masses bound ω² from
/// above, as h²: what the inertia shears between the nodes is not in the shapes.
#[test]
fn pinned_timoshenko_beam() {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
    let section = rectangle(0.1, 0.1, Some(5.0 / 6.0));
    let (length, density) = (0.8_f64, 7850.0);
    let (area, inertia) = (density * section.area(), density * section.iz());
    let shear = material.shear() * section.shear_y().unwrap();
    let exact = |n: f64| {
        let k2 = (n * PI / length).powi(2);
        let bending = material.young() * section.iz() * k2;
        let b = area * (bending + shear) + inertia * shear * k2;
        let c = shear * k2 * bending;
        2.0 * c / (b + (b * b - 4.0 * area * inertia * c).sqrt())
    };
    let mass = LineMass::new(density, Taper::constant(section.clone())).unwrap();
    let eigenvalues = |count: usize| {
        let beam = Beam::new(&material, &section, length / count as f64).unwrap();
        let consistent = mass.consistent(&beam, MassShape::Exact, RotaryInertia::Included);
        let mut frame = Frame::new(count + 1);
        for k in 0..count {
            frame.add([k, k + 1], &beam.stiffness(), &consistent);
        }
        let bending = (0..=count).flat_map(|n| [6 * n + 1, 6 * n + 5]);
        let moving: Vec<usize> = bending
            .filter(|row| *row != 1 && *row != 6 * count + 1)
            .collect();
        frame.eigenvalues(&moving, &[])
    };
    let (coarse, fine) = (eigenvalues(24), eigenvalues(48));
    for n in 0..3 {
        let expected = exact(f64::from(n) + 1.0);
        let n = n as usize;
        let [coarse_error, error] = [coarse[n], fine[n]].map(|found| found / expected - 1.0);
        assert!(
            error > 0.0 && (3.9..4.1).contains(&(coarse_error / error)),
            "{error:e}"
        );
        let extrapolated = (4.0 * fine[n] - coarse[n]) / 3.0 / expected - 1.0;
        assert!(
            extrapolated.abs() < 1e-2 * error,
            "{n}: {extrapolated:e} {error:e}"
        );
    }
}

/// A clamped, stubby bar (steel, 20 mm round, 0.2 m, κA = 0.9 A) against the first three roots of
/// Timoshenko's frequency equation (Huang 1961), in Hz. Whatever the shapes of the masses they
/// converge to these, by h².
#[test]
fn clamped_timoshenko_beam() {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
    let (length, density) = (0.2, 7850.0);
    let area = PI * 1e-4;
    let shape = SectionShape::Circle { diameter: 0.02 };
    let section = Section::new(shape, Some(0.9 * area), Some(0.9 * area)).unwrap();
    let mass = LineMass::new(density, Taper::constant(section.clone())).unwrap();
    for (rotary, expected) in [
        (
            RotaryInertia::Included,
            [359.766_338_06, 2_183.222_522_92, 5_833.618_552_61],
        ),
        (
            RotaryInertia::Left,
            [360.279_866_67, 2_203.615_515_02, 5_947.237_695_29],
        ),
    ] {
        for shape in [MassShape::Cubic, MassShape::Exact] {
            let found = [16, 32, 64].map(|count| {
                let beam = Beam::new(&material, &section, length / count as f64).unwrap();
                let consistent = mass.consistent(&beam, shape, rotary);
                cantilever(&vec![(beam.stiffness(), consistent); count])
            });
            for (k, expected) in expected.into_iter().enumerate() {
                let square = (expected * TAU).powi(2);
                let errors = found.each_ref().map(|all| all[k] / square - 1.0);
                let once = [0, 1].map(|n| (4.0 * errors[n + 1] - errors[n]) / 3.0);
                let twice = (16.0 * once[1] - once[0]) / 15.0;
                let what = format!("{rotary:?} {shape:?} {k}: {errors:?}");
                // Eigenvalues are good to rounding of the largest of them.
                let rounding = f64::EPSILON * found[2].amax() / found[2][k];
                let near = |found: f64, expected: f64| {
                    (found - expected).abs() < 0.05 * expected + rounding
                };
                assert!(near(errors[1] / 4.0, errors[2]), "{what}");
                // Each extrapolation leaves a part of about (k l)² of the error before, l the coarser
                // of its two.
                let part = ([1.875_f64, 4.694, 7.855][k] / 32.0).powi(2);
                assert!(
                    twice.abs() < part * once[1].abs() + rounding,
                    "{what}: {twice:e}"
                );
                // What inertia shears between the nodes: (k l)²/12, k the wave number that shear
                // alone would have; /20 where the centre line is a cubic without shear.
                let shear = 0.9 * material.shear() / density;
                let wave = square / shear * (length / 64.0_f64).powi(2);
                let expected = match shape {
                    MassShape::Exact => wave / 12.0,
                    MassShape::Cubic => wave / 20.0,
                };
                assert!(near(errors[2], expected), "{what}: {expected:e}");
            }
        }
    }
}

/// Tension and torsion of a clamped round bar: ω = (n − ½) π c/L; linear shapes bound ω² from above
/// by (k l)²/12 of itself, k the wave number and l an element's length.
#[test]
fn tension_and_torsion_converge_by_squares() {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
    let (length, density, count) = (0.5, 7850.0, 32);
    let section = circle(0.02);
    let mass = LineMass::new(density, Taper::constant(section.clone())).unwrap();
    let beam = Beam::new(&material, &section, length / count as f64).unwrap();
    let consistent = mass.consistent(&beam, MassShape::Cubic, RotaryInertia::Left);
    let mut frame = Frame::new(count + 1);
    for k in 0..count {
        frame.add([k, k + 1], &beam.stiffness(), &consistent);
    }
    for (component, modulus) in [(0, material.young()), (3, material.shear())] {
        let moving: Vec<usize> = (1..=count).map(|n| 6 * n + component).collect();
        let found = frame.eigenvalues(&moving, &[]);
        for n in 0..3 {
            let wave = (n as f64 + 0.5) * PI / length;
            let exact = wave * wave * modulus / density;
            let expected = (wave * length / count as f64).powi(2) / 12.0;
            let error = found[n] / exact - 1.0;
            assert!(
                (error - expected).abs() < 0.02 * expected,
                "{component} {n}: {error:e} {expected:e}"
            );
        }
    }
}

/// Kirchhoff (1879; Blevins, Table 8-11): a wedge of constant width and a cone that end in a point
/// have ω = 5.315 and 8.719 √(E I / ρ A L⁴) of the clamped end.
#[test]
fn wedge_and_cone_of_kirchhoff() {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
    let (length, density, point, count) = (1.0, 7850.0, 1e-6, 24);
    let wedge = (
        rectangle(0.04, 0.02, None),
        rectangle(0.04 * point, 0.02, None),
    );
    for ((from, to), expected) in [
        (wedge, 5.315),
        ((circle(0.04), circle(0.04 * point)), 8.719),
    ] {
        let unit = material.young() * from.iz() / (density * from.area());
        let taper = Taper::new(from, to).unwrap();
        let mass = LineMass::new(density, taper.clone()).unwrap();
        let elements: Vec<_> = (0..count)
            .map(|k| {
                let (first, last) = (
                    f64::from(k) / f64::from(count),
                    f64::from(k + 1) / f64::from(count),
                );
                let beam =
                    TaperedBeam::new(&material, &taper.part(first, last), length * (last - first))
                        .unwrap();
                let mass =
                    mass.part(first, last)
                        .consistent(&beam, MassShape::Exact, RotaryInertia::Left);
                (two_nodes(&beam), mass)
            })
            .collect();
        let found = (cantilever(&elements)[0] / unit).sqrt();
        assert!((found / expected - 1.0).abs() < 2e-4, "{found} {expected}");
    }
}

/// Stiffness of both nodes from that of node 2, by equilibrium.
fn two_nodes(beam: &TaperedBeam) -> Matrix12 {
    let carry = hyperstat_elements::transport(&beam.span());
    let k = beam.cantilever_stiffness();
    let mut out = Matrix12::zeros();
    out.fixed_view_mut::<6, 6>(0, 0)
        .copy_from(&(carry.transpose() * k * carry));
    out.fixed_view_mut::<6, 6>(0, 6)
        .copy_from(&(-carry.transpose() * k));
    out.fixed_view_mut::<6, 6>(6, 0).copy_from(&(-k * carry));
    out.fixed_view_mut::<6, 6>(6, 6).copy_from(&k);
    out
}
