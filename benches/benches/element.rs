//! One element: a beam, a beam with two elastic joints, a cross link with three.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_elements::subassembly::{
    ChainSegment, ElasticJoint, JointFactor, StiffSegment, absorb_joints, absorption_workspace,
    add_joint_compliance, chain_flexibility, chain_stiffness, invert_flexibility,
    softened_stiffness, two_node_stiffness,
};
use hyperstat_elements::{Beam, Elasticity, Material, Section, SectionShape};
use nalgebra::{DMatrix, Matrix6, Rotation3, Vector3, Vector6};

/// Half of the delta's cross link: a round steel bar.
fn bar() -> Beam {
    let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel");
    let round = SectionShape::Circle { diameter: 0.02 };
    let section = Section::new(round, None, None).expect("a section");
    Beam::new(&steel, &section, 0.06).expect("a beam")
}

/// A revolute joint of 1e8 N/m and 1e5 N·m/rad, askew to the bar.
fn joint() -> ElasticJoint {
    let compliance = Vector6::new(1e-8, 1e-8, 1e-8, 1e-5, 0.0, 1e-5);
    ElasticJoint {
        compliance: Matrix6::from_diagonal(&compliance),
        frame: Rotation3::from_euler_angles(0.4, -0.7, 1.1),
    }
}

/// Equal bars in a line with an elastic joint at every node: what each form starts from.
struct Chain {
    bars: usize,
    arms: Vec<Vector3<f64>>,
    /// Compliance of every joint in the bars' axes.
    compliance: Matrix6<f64>,
    factors: Vec<JointFactor>,
}

impl Chain {
    fn new(bars: usize) -> Self {
        let factor = joint().factor();
        Self {
            bars,
            arms: (1..=bars).map(|k| bar().span() * k as f64).collect(),
            compliance: joint().turned_compliance(),
            factors: (0..=bars)
                .map(|node| JointFactor { node, factor })
                .collect(),
        }
    }

    /// By flexibilities added and inverted.
    fn by_flexibility(&self, beam: &Beam, out: &mut [f64]) {
        let segment = ChainSegment {
            compliance: beam.cantilever_compliance(),
            span: beam.span(),
        };
        chain_flexibility(&[segment; 2][..self.bars], out);
        for node in 0..=self.bars {
            add_joint_compliance(node, &self.compliance, &self.arms, out);
        }
        invert_flexibility(6 * self.bars, out).expect("a flexibility");
    }

    /// By joints absorbed into the stiffness.
    fn by_absorption(&self, beam: &Beam, out: &mut [f64], workspace: &mut [f64]) {
        let segment = StiffSegment {
            stiffness: beam.cantilever_stiffness(),
            span: beam.span(),
        };
        chain_stiffness(&[segment; 2][..self.bars], out);
        absorb_joints(&self.factors, &self.arms, out, workspace).expect("a stiffness");
    }

    /// The bars' stiffness over all nodes, and K (E + C K)⁻¹ from it.
    fn by_general_form(&self, beam: &Beam) -> DMatrix<f64> {
        let size = 6 * (self.bars + 1);
        let mut stiffness = DMatrix::zeros(size, size);
        for first in 0..self.bars {
            let mut block = stiffness.fixed_view_mut::<12, 12>(6 * first, 6 * first);
            block += beam.stiffness();
        }
        let compliances = [self.compliance; 3];
        softened_stiffness(&stiffness, &compliances[..=self.bars]).expect("a stiffness")
    }
}

fn beam(c: &mut Criterion) {
    let beam = bar();
    let mut group = c.benchmark_group("element/beam");
    group.bench_function("cantilever compliance, 6×6", |b| {
        b.iter(|| black_box(&beam).cantilever_compliance());
    });
    group.bench_function("stiffness, 12×12", |b| {
        b.iter(|| black_box(&beam).stiffness());
    });
    group.finish();
}

fn subassembly(c: &mut Criterion) {
    let beam = bar();
    for (name, bars) in [("two nodes", 1), ("three nodes", 2)] {
        let chain = Chain::new(bars);
        let mut out = vec![0.0; 36 * bars * bars];
        let mut workspace = vec![0.0; absorption_workspace(bars, bars + 1)];
        let mut group = c.benchmark_group(format!("element/subassembly of {name}"));
        group.bench_function("flexibilities, inverted", |b| {
            b.iter(|| chain.by_flexibility(black_box(&beam), &mut out));
        });
        group.bench_function("joints absorbed into the stiffness", |b| {
            b.iter(|| chain.by_absorption(black_box(&beam), &mut out, &mut workspace));
        });
        if bars == 1 {
            let joint = joint();
            group.bench_function("the paper's form, Eqs. 3–12", |b| {
                b.iter(|| two_node_stiffness(black_box(&beam), &joint, &joint));
            });
        }
        group.bench_function("the general form, K (E + C K)⁻¹", |b| {
            b.iter(|| chain.by_general_form(black_box(&beam)));
        });
        group.finish();
    }
}

criterion_group!(benches, beam, subassembly);
criterion_main!(benches);
