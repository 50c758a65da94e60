//! Gauss–Legendre integration.

/// Positive nodes and their weights of the 16-point Gauss–Legendre rule on −1 to 1. On the
/// intervals of a taper its error is far below rounding: the nearest pole lies an interval's
/// length away, so that the error falls by 5.8² with each point.
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

/// Calls `visit` with the places and weights of the 16-point rule on `first` to `last`; exact for
/// polynomials up to degree 31.
pub(crate) fn gauss(first: f64, last: f64, mut visit: impl FnMut(f64, f64)) {
    let (middle, half) = ((first + last) / 2.0, (last - first) / 2.0);
    for (node, weight) in GAUSS {
        for place in [middle - half * node, middle + half * node] {
            visit(place, weight * half);
        }
    }
}
