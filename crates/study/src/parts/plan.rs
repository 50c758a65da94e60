//! What of a job's rows is there, and what is left to compute.

use std::ops::Range;

/// A step of the way through rows, in their order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Step {
    /// These rows are there: the piece of this number.
    Taken(usize),
    /// These are to be computed.
    Computed(Range<usize>),
}

/// The way through `rows` with the fewest to compute, given the rows of pieces that are there.
pub(super) fn plan(rows: &Range<usize>, pieces: &[Range<usize>]) -> Vec<Step> {
    let within = |piece: &Range<usize>| {
        !piece.is_empty() && rows.start <= piece.start && piece.end <= rows.end
    };
    let pieces = pieces.iter().enumerate().filter(|(_, piece)| within(piece));
    let pieces: Vec<(usize, &Range<usize>)> = pieces.collect();
    let ends = pieces
        .iter()
        .flat_map(|(_, piece)| [piece.start, piece.end]);
    let mut bounds: Vec<usize> = ends.chain([rows.start, rows.end]).collect();
    bounds.sort_unstable();
    bounds.dedup();
    // To each bound: rows to compute on the best way there, and its last step.
    let mut best: Vec<(usize, Option<Step>)> = vec![(0, None)];
    for (place, &bound) in bounds.iter().enumerate().skip(1) {
        let before = bounds[place - 1];
        let computed = best[place - 1].0 + (bound - before);
        let mut found = (computed, Some(Step::Computed(before..bound)));
        for (number, piece) in pieces.iter().filter(|(_, piece)| piece.end == bound) {
            let start = bounds.binary_search(&piece.start).unwrap_or(0);
            if best[start].0 < found.0 {
                found = (best[start].0, Some(Step::Taken(*number)));
            }
        }
        best.push(found);
    }
    let mut steps: Vec<Step> = Vec::new();
    let mut place = bounds.len() - 1;
    while let Some(step) = best[place].1.clone() {
        let start = match &step {
            Step::Taken(number) => {
                let piece = pieces.iter().find(|(own, _)| own == number);
                piece.map_or(0, |(_, piece)| piece.start)
            }
            Step::Computed(rows) => rows.start,
        };
        place = bounds.binary_search(&start).unwrap_or(0);
        // What is computed in one go.
        match (steps.last_mut(), &step) {
            (Some(Step::Computed(later)), Step::Computed(rows)) => later.start = rows.start,
            _ => steps.push(step),
        }
    }
    steps.reverse();
    steps
}

/// The rows that are to be computed.
pub(super) fn computed(steps: &[Step]) -> impl Iterator<Item = &Range<usize>> {
    steps.iter().filter_map(|step| match step {
        Step::Computed(rows) => Some(rows),
        Step::Taken(_) => None,
    })
}

#[cfg(test)]
mod tests {
    use super::{Step, plan};

    #[test]
    fn what_is_there_is_taken() {
        use Step::{Computed, Taken};
        let all = 0..10;
        for (pieces, expected) in [
            (vec![], vec![Computed(0..10)]),
            // As is one beside it that is empty.
            (vec![0..10, 3..3], vec![Taken(0)]),
            (vec![5..10, 0..5], vec![Taken(1), Taken(0)]),
            (
                vec![3..5, 5..5],
                vec![Computed(0..3), Taken(0), Computed(5..10)],
            ),
            // The longest first would miss three rows.
            (vec![0..7, 0..5, 5..10], vec![Taken(1), Taken(2)]),
            // One that is larger than what is asked for, and an empty one.
            (vec![0..11, 4..4], vec![Computed(0..10)]),
            (vec![0..6, 4..10], vec![Taken(0), Computed(6..10)]),
        ] {
            assert_eq!(plan(&all, &pieces), expected, "{pieces:?}");
        }
        assert_eq!(plan(&(4..8), &[0..10, 4..8]), [Taken(1)]);
        assert_eq!(plan(&(3..3), &[0..10, 3..3]), []);
    }
}
