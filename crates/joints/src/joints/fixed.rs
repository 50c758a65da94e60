//! The fixed joint: a weld or, with a stiffness, a bushing.

use crate::dof::DofSet;
use crate::joint::Joint;

/// No free direction: a weld. With elastic directions, a bushing.
///
/// `u_i = u_j`: no IDC of body i, `N = E` (6×6). Body to ground: `u_i = 0`, N has no column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fixed;

impl Joint for Fixed {
    fn kind(&self) -> &str {
        "Fixed"
    }

    fn free(&self) -> DofSet {
        DofSet::EMPTY
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix6;

    use super::*;
    use crate::joints::oracle::assert_closed_form;

    #[test]
    fn both_bodies_move_as_one() {
        let choices = assert_closed_form(&Fixed, |_, _| (Vec::new(), Matrix6::identity()));
        assert_eq!(choices, [DofSet::EMPTY]);
    }
}
