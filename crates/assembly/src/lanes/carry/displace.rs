//! The displacements of all coordinates, from those of the output on.

use pulp::Simd;

use super::State;
use crate::lanes::pass::blocks::pair;
use crate::lanes::pass::lane::{Lane, cross};
use crate::lanes::program::fronts::Hang;

impl<S: Simd> State<'_, S> {
    /// Finds them.
    #[inline(always)]
    pub(super) fn displace(&mut self) {
        let simd = self.simd;
        let (fronts, coordinates) = (&self.program.fronts, self.program.coordinates);
        let zero = simd.splat_f64s(0.0);
        self.moved.fill(zero);
        let output = self.program.output;
        for k in 0..6 {
            self.moved[output + k] = self.asked[k];
        }
        for k in 0..self.moved.len() {
            self.relative[k] = self.moved[k];
        }
        for f in (0..fronts.list.len()).rev() {
            let front = &fronts.list[f];
            let size = front.variables.len();
            let columns = size - front.rows;
            // The panel holds −l, and what acts over the pivots.
            let panel = &self.kept[self.recovery.panels[f]..][..front.pivots * size];
            for k in (0..front.pivots).rev() {
                let own = &panel[k * size..(k + 1) * size];
                let mut sum = zero;
                for i in k + 1..columns {
                    sum = simd.mul_add_e_f64s(own[i], self.moved[front.variables[i]], sum);
                }
                for i in columns..size {
                    if self.rows[front.variables[i] - coordinates] {
                        sum = simd.sub_f64s(sum, own[i]);
                    }
                }
                self.moved[front.variables[k]] = sum;
            }
            for variable in &front.variables[..front.pivots] {
                self.relative[*variable] = self.moved[*variable];
            }
            for k in (0..front.hangs.len()).rev() {
                self.make_absolute(&front.hangs[k], &front.variables);
            }
        }
    }

    /// `u = v + T w` of a component that hangs on its neighbour.
    #[inline(always)]
    fn make_absolute(&mut self, hang: &Hang, variables: &[usize]) {
        let arm = self.arm(hang.arm);
        let mut linear = [self.zero(); 3];
        let mut angular = [self.zero(); 3];
        for k in 0..3 {
            linear[k] = Lane::new(self.simd, self.moved[variables[hang.root[k]]]);
            angular[k] = Lane::new(self.simd, self.moved[variables[hang.root[3 + k]]]);
        }
        for (screw, place) in &hang.screws {
            let (along, about) = pair(self.simd, self.screws, *screw);
            let by = Lane::new(self.simd, self.moved[variables[*place]]);
            for k in 0..3 {
                linear[k] = along[k].mul_add(by, linear[k]);
                angular[k] = about[k].mul_add(by, angular[k]);
            }
        }
        let carried = cross(&angular, &arm);
        for k in 0..3 {
            let places = [hang.places[k], hang.places[3 + k]].map(|place| variables[place]);
            let own = Lane::new(self.simd, self.moved[places[0]]);
            self.moved[places[0]] = (own + linear[k] + carried[k]).value;
            let own = Lane::new(self.simd, self.moved[places[1]]);
            self.moved[places[1]] = (own + angular[k]).value;
        }
    }
}
