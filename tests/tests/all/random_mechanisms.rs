//! Random mechanisms of any topology against the independent solver: trees and loops of beams and
//! rigid bodies, several joints at a node, every kind, elastic, locked or free.

use hyperstat_tests::agreement::agrees_with_reference;
use hyperstat_tests::random::check_random_mechanisms;
use proptest::strategy::Just;

#[test]
fn any_topology_agrees_with_the_independent_solver() {
    check_random_mechanisms(Just(()), |model, ()| agrees_with_reference(model));
}
