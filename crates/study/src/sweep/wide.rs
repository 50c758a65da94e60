//! Loop closure with the instruction set of the machine.

use hyperstat_mechanisms::{Placing, Work};
use pulp::{Arch, Simd, WithSimd};

struct Wide<'w>(Work<'w>);

impl WithSimd for Wide<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.0.run();
    }
}

/// A thread's room for placing poses, whose arithmetic uses what instructions the machine has.
pub fn placing() -> Placing {
    Placing::new(|work| Arch::new().dispatch(Wide(work)))
}
