//! The conformance test finds what is wrong with a joint: each test breaks one rule.

use std::sync::atomic::{AtomicUsize, Ordering};

use hyperstat_joints::testing::assert_conforms;
use hyperstat_joints::{Dof, DofSet, Joint, JointError, Mapping, Revolute};
use nalgebra::{Matrix6, Rotation3, Vector6};

/// A revolute joint with one fault.
#[derive(Debug)]
struct Broken {
    fault: Fault,
    calls: AtomicUsize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    AnotherAxis,
    SmallestMinor,
    MovingIgnored,
    TranslationForRotation,
    Forgetful,
    FreeInTheCloneOnly,
    SingularBasis,
    NegativeCompliance,
    CrookedCompliance,
}

impl Broken {
    fn new(fault: Fault) -> Self {
        Self {
            fault,
            calls: AtomicUsize::new(0),
        }
    }
}

impl Joint for Broken {
    fn kind(&self) -> &str {
        "Broken"
    }

    fn free(&self) -> DofSet {
        if self.fault == Fault::FreeInTheCloneOnly && self.calls.load(Ordering::Relaxed) == 0 {
            return DofSet::EMPTY;
        }
        Revolute.free()
    }

    fn basis(&self) -> Matrix6<f64> {
        let mut basis = Matrix6::identity();
        match self.fault {
            Fault::SingularBasis => basis[(5, 5)] = 0.0,
            Fault::TranslationForRotation => basis[(1, 4)] = 0.01,
            _ => {}
        }
        basis
    }

    fn compliance(&self) -> Option<Matrix6<f64>> {
        let mut compliance = Matrix6::identity() * 1e-8;
        match self.fault {
            Fault::NegativeCompliance => compliance[(2, 2)] = -1e-9,
            Fault::CrookedCompliance => compliance[(0, 1)] = 1e-9,
            _ => return None,
        }
        Some(compliance)
    }

    fn mapping(&self, frame: &Rotation3<f64>, moving: DofSet) -> Result<Mapping, JointError> {
        let called = self.calls.fetch_add(1, Ordering::Relaxed);
        let y = frame.matrix().column(1).into_owned();
        let is_hinge = moving == DofSet::new(&[Dof::V]);
        match self.fault {
            Fault::AnotherAxis if is_hinge => {
                Mapping::of(&self.basis(), frame, DofSet::new(&[Dof::W]))
            }
            Fault::Forgetful if is_hinge && called % 2 == 1 => {
                Mapping::of(&self.basis(), frame, DofSet::new(&[Dof::W]))
            }
            Fault::MovingIgnored => Mapping::of(&self.basis(), frame, Revolute.free()),
            // Takes the rotation about the global axis farthest from y that still is not normal
            // to it, where the nearest one is wanted.
            Fault::SmallestMinor if is_hinge => {
                let far = |k: &usize| y[*k].abs() > 1e-2;
                let k = (0..3)
                    .filter(far)
                    .min_by(|a, b| y[*a].abs().total_cmp(&y[*b].abs()))
                    .unwrap_or(0);
                let mut column = Vector6::zeros();
                column.fixed_rows_mut::<3>(3).copy_from(&(y / y[k]));
                let mut n_j = Matrix6::identity();
                let mut n_jk = n_j.column_mut(3 + k);
                n_jk -= column;
                Mapping::new(DofSet::new(&[Dof::ALL[3 + k]]), &[column], n_j)
            }
            // The travel of a screw as its IDC.
            Fault::TranslationForRotation if is_hinge => {
                let k = y.iamax();
                let mut column = Vector6::zeros();
                column.fixed_rows_mut::<3>(0).copy_from(&(y / y[k]));
                column.fixed_rows_mut::<3>(3).copy_from(&(y / y[k] / 0.01));
                let mut n_j = Matrix6::identity();
                let mut n_jk = n_j.column_mut(k);
                n_jk -= column;
                Mapping::new(DofSet::new(&[Dof::ALL[k]]), &[column], n_j)
            }
            _ => Mapping::of(&self.basis(), frame, moving),
        }
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        let clone = Self::new(self.fault);
        clone.calls.fetch_add(1, Ordering::Relaxed);
        Box::new(clone)
    }
}

#[test]
#[should_panic = "N misses u_i"]
fn n_of_another_axis() {
    assert_conforms(&Broken::new(Fault::AnotherAxis));
}

#[test]
#[should_panic = "above 1.0"]
fn entries_without_bound() {
    assert_conforms(&Broken::new(Fault::SmallestMinor));
}

#[test]
#[should_panic = "1 IDCs, not one a moving direction"]
fn locks_ignored() {
    assert_conforms(&Broken::new(Fault::MovingIgnored));
}

#[test]
#[should_panic = "0 rotations among the IDCs, not 1"]
fn the_travel_of_a_screw_as_its_idc() {
    assert_conforms(&Broken::new(Fault::TranslationForRotation));
}

#[test]
#[should_panic = "asked twice, N differs"]
fn another_answer_at_each_call() {
    assert_conforms(&Broken::new(Fault::Forgetful));
}

#[test]
#[should_panic = "the clone is another joint"]
fn a_clone_that_differs() {
    assert_conforms(&Broken::new(Fault::FreeInTheCloneOnly));
}

#[test]
#[should_panic = "the basis is not invertible"]
fn a_basis_with_a_zero_column() {
    assert_conforms(&Broken::new(Fault::SingularBasis));
}

#[test]
#[should_panic = "the compliance is not positive semidefinite"]
fn a_negative_compliance() {
    assert_conforms(&Broken::new(Fault::NegativeCompliance));
}

#[test]
#[should_panic = "the compliance is not symmetric"]
fn a_compliance_that_is_not_symmetric() {
    assert_conforms(&Broken::new(Fault::CrookedCompliance));
}
