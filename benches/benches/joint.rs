//! One joint: the choice of its independent coordinates and its mapping N, for every kind.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_joints::{
    Cylindrical, Fixed, Joint, Planar, Prismatic, Revolute, Screw, Spherical, Universal,
};
use nalgebra::Rotation3;

fn mapping(c: &mut Criterion) {
    let screw = Screw::new(0.005).expect("a finite pitch");
    let joints: [Box<dyn Joint>; 8] = [
        Box::new(Fixed),
        Box::new(Revolute),
        Box::new(Prismatic),
        Box::new(Cylindrical),
        Box::new(screw),
        Box::new(Universal),
        Box::new(Spherical),
        Box::new(Planar),
    ];
    let frame = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
    let mut group = c.benchmark_group("joint/mapping");
    for joint in &joints {
        group.bench_function(joint.kind(), |b| {
            b.iter(|| joint.mapping(black_box(&frame), joint.free()));
        });
    }
    group.finish();
}

criterion_group!(benches, mapping);
criterion_main!(benches);
