//! Nested dissection of a graph whose vertices have places in space: an order of elimination whose
//! fill stays low where minimum degree's does not, in structures that extend in two or three
//! directions (A. George, Nested dissection of a regular finite element mesh, 1973).

use nalgebra::Point3;

/// Sets of vertices up to this many are not divided.
const LEAF: usize = 4;
/// Each side of a cut has at least this share of the vertices.
const LEAST_SHARE: f64 = 0.3;

/// An undirected graph: the neighbours of every vertex.
pub(crate) type Graph = Vec<Vec<usize>>;

/// Vertices in the order of elimination: of every part first one side of a cut, then the other,
/// and last the vertices that separate them. A cut is a plane across one of the axes, at the place
/// where few vertices separate much.
pub(crate) fn nested_dissection(graph: &Graph, places: &[Point3<f64>]) -> Vec<usize> {
    dissected(graph, places).0
}

/// Of every vertex, its level: 0 in parts that are not divided, and the more the fewer cuts come before
/// the one that it lies along.
pub(crate) fn levels(graph: &Graph, places: &[Point3<f64>]) -> Vec<usize> {
    let (_, mut depths) = dissected(graph, places);
    let deepest = depths.iter().copied().max().unwrap_or(0);
    for depth in &mut depths {
        *depth = deepest - *depth;
    }
    depths
}

/// Vertices in the order of elimination, and the depth of each.
fn dissected(graph: &Graph, places: &[Point3<f64>]) -> (Vec<usize>, Vec<usize>) {
    let count = graph.len();
    let mut dissection = Dissection {
        graph,
        places,
        part_of: vec![0; count],
        parts: 0,
        beyond: vec![0; count],
    };
    // Parts to be ordered, the last one first: the order grows from its end.
    let mut parts = vec![(0, Region::Whole((0..count).collect()))];
    let mut reversed = Vec::with_capacity(count);
    let mut depths = vec![usize::MAX; count];
    let mut deepest = 0;
    while let Some((depth, part)) = parts.pop() {
        match part {
            Region::Whole(vertices) if vertices.len() > LEAF => {
                let [first, second, separator] = dissection.divide(vertices);
                deepest = deepest.max(depth + 1);
                for &vertex in &separator {
                    depths[vertex] = depth;
                }
                parts.extend([first, second].map(|part| (depth + 1, Region::Whole(part))));
                parts.push((depth, Region::Ordered(separator)));
            }
            Region::Whole(vertices) | Region::Ordered(vertices) => {
                reversed.extend(vertices.into_iter().rev());
            }
        }
    }
    reversed.reverse();
    for depth in &mut depths {
        *depth = deepest.min(*depth);
    }
    (reversed, depths)
}

/// Vertices of one part, to be divided or to be taken as they are.
enum Region {
    Whole(Vec<usize>),
    Ordered(Vec<usize>),
}

/// A cut: the first `first` vertices along an axis, of which `separator` have neighbours among
/// the others.
struct Cut {
    order: Vec<usize>,
    first: usize,
    /// Number of separating vertices over the product of the sides' numbers.
    cost: f64,
}

struct Dissection<'a> {
    graph: &'a Graph,
    places: &'a [Point3<f64>],
    /// The part that a vertex is in; neighbours in other parts do not count.
    part_of: Vec<usize>,
    parts: usize,
    /// Of a vertex, its neighbours beyond the cut.
    beyond: Vec<usize>,
}

impl Dissection<'_> {
    /// Two sides and the vertices that separate them.
    fn divide(&mut self, vertices: Vec<usize>) -> [Vec<usize>; 3] {
        self.parts += 1;
        for &vertex in &vertices {
            self.part_of[vertex] = self.parts;
        }
        let mut best = self.cut(&vertices, 0);
        for axis in 1..3 {
            let other = self.cut(&vertices, axis);
            if other.cost < best.cost {
                best = other;
            }
        }
        let (first, second) = best.order.split_at(best.first);
        self.parts += 1;
        for &vertex in second {
            self.part_of[vertex] = self.parts;
        }
        let separates =
            |vertex: &usize| (self.graph[*vertex].iter()).any(|n| self.part_of[*n] == self.parts);
        let (separator, first) = first.iter().partition(|vertex| separates(vertex));
        [first, second.to_vec(), separator]
    }

    /// The best cut across an axis.
    fn cut(&mut self, vertices: &[usize], axis: usize) -> Cut {
        let part = self.part_of[vertices[0]];
        let mut order = vertices.to_vec();
        let place = |vertex: usize| self.places[vertex][axis];
        order.sort_by(|a, b| place(*a).total_cmp(&place(*b)));
        for &vertex in &order {
            let inside = self.graph[vertex]
                .iter()
                .filter(|n| self.part_of[**n] == part);
            self.beyond[vertex] = inside.count();
        }
        let count = order.len();
        let least = ((count as f64 * LEAST_SHARE) as usize).max(1);
        let (mut best, mut cost) = (count / 2, f64::INFINITY);
        let mut separating = 0;
        // Vertices pass the cut one after the other; one that has passed separates while
        // neighbours of it are beyond.
        self.parts += 1;
        let passed = self.parts;
        for (k, &vertex) in order.iter().enumerate() {
            self.part_of[vertex] = passed;
            separating += usize::from(self.beyond[vertex] > 0);
            for &neighbour in &self.graph[vertex] {
                let has_passed = self.part_of[neighbour] == passed;
                if has_passed || self.part_of[neighbour] == part {
                    self.beyond[neighbour] -= 1;
                    separating -= usize::from(has_passed && self.beyond[neighbour] == 0);
                }
            }
            let (first, second) = (k + 1, count - k - 1);
            if first >= least && second >= least {
                let own = separating as f64 / (first as f64 * second as f64);
                if own < cost {
                    (best, cost) = (first, own);
                }
            }
        }
        Cut {
            order,
            first: best,
            cost,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of counts × counts × counts vertices, neighbours a unit apart.
    fn grid(counts: [usize; 3]) -> (Graph, Vec<Point3<f64>>) {
        let [nx, ny, nz] = counts;
        let count = nx * ny * nz;
        let at = |v: usize| [v % nx, v / nx % ny, v / (nx * ny)];
        let mut graph = vec![Vec::new(); count];
        for vertex in 0..count {
            for (axis, step) in [1, nx, nx * ny].into_iter().enumerate() {
                if at(vertex)[axis] + 1 < counts[axis] {
                    graph[vertex].push(vertex + step);
                    graph[vertex + step].push(vertex);
                }
            }
        }
        let place = |v| Point3::from(at(v).map(|k| k as f64));
        (graph, (0..count).map(place).collect())
    }

    /// Entries of the factor below its diagonal, by elimination of the graph.
    fn fill(graph: &Graph, order: &[usize]) -> usize {
        let mut place = vec![0; graph.len()];
        for (k, &vertex) in order.iter().enumerate() {
            place[vertex] = k;
        }
        let mut columns = vec![Vec::new(); order.len()];
        for (vertex, neighbours) in graph.iter().enumerate() {
            let (own, later) = (place[vertex], neighbours.iter().map(|n| place[*n]));
            columns[own].extend(later.filter(|p| *p > own));
        }
        let mut entries = 0;
        for k in 0..columns.len() {
            let mut own = std::mem::take(&mut columns[k]);
            own.sort_unstable();
            own.dedup();
            entries += own.len();
            if let Some((&parent, rest)) = own.split_first() {
                columns[parent].extend(rest);
            }
        }
        entries
    }

    #[test]
    fn every_vertex_is_ordered_once() {
        for counts in [[1, 1, 1], [5, 1, 1], [3, 4, 5], [1, 7, 2]] {
            let (graph, places) = grid(counts);
            let mut order = nested_dissection(&graph, &places);
            order.sort_unstable();
            assert!(order.into_iter().eq(0..graph.len()));
        }
        // Vertices at one place, and without neighbours.
        let order = nested_dissection(&vec![Vec::new(); 9], &[Point3::origin(); 9]);
        assert_eq!(order.len(), 9);
        assert!(nested_dissection(&Vec::new(), &[]).is_empty());
    }

    #[test]
    fn the_last_vertices_separate_a_bar_in_its_middle() {
        let (graph, places) = grid([3, 21, 3]);
        let order = nested_dissection(&graph, &places);
        let (others, last) = order.split_at(order.len() - 9);
        assert!(last.iter().all(|v| (9.0..=11.0).contains(&places[*v].y)));
        let side = |v: &usize| places[*v].y > 10.0;
        for vertex in others {
            let beside = graph[*vertex].iter().filter(|n| !last.contains(n));
            assert!(
                beside
                    .filter(|n| places[**n].y != 10.0)
                    .all(|n| { places[*vertex].y == 10.0 || side(n) == side(vertex) })
            );
        }
    }

    #[test]
    fn fill_grows_as_nested_dissection_promises() {
        // Entries of a plane grid's factor over count·log₂ count are bounded; row by row they grow
        // as the root of the count.
        for side in [16, 32, 64] {
            let (graph, places) = grid([side, side, 1]);
            let count = side * side;
            let entries = fill(&graph, &nested_dissection(&graph, &places)) as f64;
            assert!(
                entries < 4.0 * count as f64 * (count as f64).log2(),
                "{side}: {entries}"
            );
        }
        let (graph, places) = grid([64, 64, 1]);
        let by_rows: Vec<usize> = (0..64 * 64).collect();
        let ratio = fill(&graph, &by_rows) / fill(&graph, &nested_dissection(&graph, &places));
        assert!(ratio >= 2, "{ratio}");
    }
}
