//! Wear of a groove in the cycles of a jump, from that of one cycle.
//!
//! In gross reciprocating sliding each pass of the contact wears the depth k P off every point that it crosses, whatever the
//! shape of the pressure. A rigid arc of radius R touches a receptacle of slope t where the arc has that slope, at the
//! displacement
//!   s = x - R t/sqrt(1 + t^2),
//! so that a cycle wears the depth h ds/dx, h = 2 k P, where s is within the stroke. With s limited to -A..A and averaged over
//! the width 2 b of the contact this is a surrogate for the wear rate of a groove of any depth d,
//!   r(d) = h d/dx S(x, d'),  d' = dd/dx:
//! a diffusion, of diffusivity h R where the groove is flat and none beyond its ends, which move as the slope there grows. The
//! flux h S is that at the ends of the body too: a contact on its edge wears the edge. Where a pass wears by time, S is the part of
//! the pass that has been done by then instead.
//!
//! The wear of a computed cycle, times n, would amplify each of its waves. With the change of the surrogate's rate by all of
//! the wear w of n cycles (implicit Euler; the computed cycle is the explicit part, as in the IMEX methods of Ascher, Ruuth and
//! Wetton 1995)
//!   w - n [r(d + w) - r(d)] = n w_1
//! waves fade, the worn area is n times that of the computed cycle, and where the computed wear changes as the surrogate's
//! does, w is exact to the first order in n for contacts of any shape. S increases with d', so this is the gradient of a convex
//! function, whose minimum Newton's method with a line search finds. By dose w - n w_1 is that of the equivalent depths,
//! and the rest that of the depths: E(d + w) - E(d) increases with w, so the function stays convex, with a kink in its derivative
//! at each interface of a plating. A base that does not wear bounds w (projected Newton method, Bertsekas 1982).

use crate::law::dose::DoseCurve;
use crate::linear::tridiagonal::solve_tridiagonal;
use crate::model::Profile;
use crate::scene::Spread;

/// Change of a Newton step over the largest wear at which the iteration ends: far below any tolerance.
const PRECISION: f64 = 1e-7;
/// Most Newton steps; 4 to 25 are needed, more where a jump wears many times a layer's thickness.
const MOST_STEPS: usize = 100;
/// Most bisections of a Newton step.
const MOST_BISECTIONS: usize = 12;
/// A whole step is taken where the derivative along it is at most this part of its decrease: it then has not passed the minimum by
/// much. Arbitrary.
const PASSED: f64 = 0.1;
/// A part of a step ends where the derivative has fallen to this part, before the minimum. Arbitrary.
const SLOPE_LEFT: f64 = 0.5;

/// Equivalent per wear of a node that does not move.
const HELD: f64 = 1e150;

/// The receptacle of a scene, and the slider's stroke over it. Lengths in mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Groove<'a> {
    /// Places of the contact nodes, and the widths that belong to them.
    pub(super) x: &'a [f64],
    pub(super) widths: &'a [f64],
    /// The unworn surface.
    pub(super) profile: Profile,
    /// Radius R of the slider.
    pub(super) radius: f64,
    /// Amplitude A of the stroke.
    pub(super) amplitude: f64,
    /// Half-width b of the contact.
    pub(super) half_width: f64,
    /// How the wear of a pass is spread over the stroke.
    pub(super) spread: Spread,
    /// The curve of its depth over the dose, if it wears by dose.
    pub(super) curve: Option<&'a DoseCurve>,
    /// Wear h of the unworn surface in a cycle, mm; of a surface that wears at every depth the mean of the computed cycle counts.
    pub(super) floor: f64,
}

impl Groove<'_> {
    /// Further wear of a groove of this depth in so many cycles, if one cycle has worn `single` there, as equivalent depth; `None`
    /// if Newton's method does not converge.
    pub(super) fn wear(&self, depth: &[f64], single: &[f64], cycles: f64) -> Option<Vec<f64>> {
        let area = single.iter().zip(self.widths).map(|(d, width)| d * width);
        let floor = if self.curve.is_some_and(|curve| curve.deepest().is_finite()) {
            self.floor
        } else {
            area.sum::<f64>() / (2.0 * self.amplitude)
        };
        let flux = cycles * floor;
        let explicit: Vec<f64> = single.iter().map(|wear| cycles * wear).collect();
        let mut equation = Equation {
            groove: self,
            depth,
            flux,
            before: Vec::new(),
            explicit: &explicit,
        };
        equation.before = equation.touching(&vec![0.0; depth.len()]);
        equation.solve()
    }

    /// Equivalent of a further wear of a depth, mm.
    fn equivalent(&self, depth: f64, wear: f64) -> f64 {
        self.curve.map_or(wear, |curve| {
            curve.equivalent(depth + wear) - curve.equivalent(depth)
        })
    }

    /// Further wear of a depth whose equivalent is this, mm.
    fn wear_of(&self, depth: f64, equivalent: f64) -> f64 {
        self.curve.map_or(equivalent, |curve| {
            curve.recession(depth, equivalent / curve.initial_rate()).0
        })
    }

    /// Derivative of the equivalent by the wear at a depth, -; none where the surface does not wear any further.
    fn equivalent_per_wear(&self, depth: f64) -> Option<f64> {
        self.curve.map_or(Some(1.0), |curve| {
            let rate = curve.rate(depth);
            (rate > 0.0).then(|| curve.initial_rate() / rate)
        })
    }

    /// Most further wear of a depth, mm.
    fn room(&self, depth: f64) -> f64 {
        let deepest = self.curve.map_or(f64::INFINITY, DoseCurve::deepest);
        (deepest - depth).max(0.0)
    }

    /// Mean displacement S at which the slider touches the surface with this slope of the depth, and its derivative by that,
    /// mm.
    fn displacement(&self, x: f64, depth_slope: f64) -> (f64, f64) {
        let slope = self.profile.slope(x) - depth_slope;
        let secant = (1.0 + slope * slope).sqrt();
        let s = x - self.radius * slope / secant;
        let (first, last) = (s - self.half_width, s + self.half_width);
        let width = last - first;
        let swept = |s: f64| self.spread.swept(s, self.amplitude);
        let ((last, above), (first, below)) = (swept(last), swept(first));
        let mean = (above - below) / width;
        let share = (last - first) / width;
        (mean, share * self.radius / secant.powi(3))
    }
}

/// The equation for the wear w of the cycles of a jump.
struct Equation<'a> {
    groove: &'a Groove<'a>,
    depth: &'a [f64],
    /// n h, mm.
    flux: f64,
    /// S between the nodes before, mm.
    before: Vec<(f64, f64)>,
    /// n times the wear of the computed cycle, mm.
    explicit: &'a [f64],
}

/// A step of Newton's method.
struct Step {
    /// Change of the wear, mm.
    wear: Vec<f64>,
    /// The largest change of an equivalent depth, mm.
    largest: f64,
}

impl Equation<'_> {
    fn solve(&self) -> Option<Vec<f64>> {
        // Where the floor does not wear any more, what a layer would have worn is the scale of round-off.
        let largest = self.explicit.iter().fold(self.flux, |a: f64, b| a.max(*b));
        let nodes = self.depth.iter().zip(self.explicit);
        let mut wear: Vec<f64> = nodes
            .map(|(depth, explicit)| self.groove.wear_of(*depth, *explicit))
            .collect();
        for _ in 0..MOST_STEPS {
            let step = self.newton_step(&wear);
            if step.largest <= PRECISION * largest {
                return Some(wear);
            }
            wear = self.line_search(&wear, &step.wear);
        }
        None
    }

    /// The wear after a step, or after the part of it that does not pass the minimum.
    fn line_search(&self, wear: &[f64], step: &[f64]) -> Vec<f64> {
        let moved = |part: f64| -> Vec<f64> {
            let nodes = wear.iter().zip(step).zip(self.depth);
            nodes
                .map(|((wear, step), depth)| (wear + part * step).min(self.groove.room(*depth)))
                .collect()
        };
        // Where a bound has stopped a node, it changes nothing any more.
        let slope = |moved: &[f64]| -> f64 {
            let touching = self.touching(moved);
            let residual = self.residual(moved, &touching);
            let nodes = residual.zip(step).zip(moved.iter().zip(self.depth));
            nodes
                .filter(|(_, (wear, depth))| **wear < self.groove.room(**depth))
                .map(|((residual, step), _)| residual * step)
                .sum()
        };
        let start = slope(wear).abs();
        let (mut low, mut high) = (0.0, 1.0);
        let mut whole = moved(1.0);
        if slope(&whole) <= PASSED * start {
            return whole;
        }
        for _ in 0..MOST_BISECTIONS {
            let middle = 0.5 * (low + high);
            whole = moved(middle);
            let slope = slope(&whole);
            if slope > 0.0 {
                high = middle;
            } else if slope < -SLOPE_LEFT * start {
                low = middle;
            } else {
                return whole;
            }
        }
        moved(if low > 0.0 { low } else { high })
    }

    /// S between the nodes with this wear, and its derivative by the slope there, mm.
    fn touching(&self, wear: &[f64]) -> Vec<(f64, f64)> {
        let Self { groove, depth, .. } = self;
        let x = groove.x;
        let between = |i: usize| {
            let difference = depth[i + 1] + wear[i + 1] - depth[i] - wear[i];
            groove.displacement(0.5 * (x[i] + x[i + 1]), difference / (x[i + 1] - x[i]))
        };
        (0..x.len() - 1).map(between).collect()
    }

    /// w - n w_1 - n [r(d + w) - r(d)] times the width of each node, mm^2.
    fn residual<'b>(
        &'b self,
        wear: &'b [f64],
        touching: &'b [(f64, f64)],
    ) -> impl Iterator<Item = f64> + 'b {
        let flux = |i: usize| self.flux * (touching[i].0 - self.before[i].0);
        (0..wear.len()).map(move |i| {
            let from_left = if i > 0 { flux(i - 1) } else { 0.0 };
            let to_right = if i + 1 < wear.len() { flux(i) } else { 0.0 };
            let worn = self.groove.equivalent(self.depth[i], wear[i]);
            self.groove.widths[i] * (worn - self.explicit[i]) + from_left - to_right
        })
    }

    /// Newton's step from this wear; nodes that their bound holds do not move.
    fn newton_step(&self, wear: &[f64]) -> Step {
        let (groove, x) = (self.groove, self.groove.x);
        let touching = self.touching(wear);
        let mut step: Vec<f64> = self.residual(wear, &touching).map(|r| -r).collect();
        let per_wear = self.depth.iter().zip(wear).zip(&step);
        let per_wear: Vec<f64> = per_wear
            .map(|((depth, wear), step)| {
                let is_held = *wear >= groove.room(*depth) && *step >= 0.0;
                let inside = depth + wear * (1.0 - f64::EPSILON);
                let per_wear = groove.equivalent_per_wear(depth + wear);
                let per_wear = per_wear.or_else(|| groove.equivalent_per_wear(inside));
                per_wear.filter(|_| !is_held).unwrap_or(HELD)
            })
            .collect();
        let beside = touching.iter().zip(x.windows(2));
        let beside: Vec<f64> = beside
            .map(|((_, by_slope), x)| -self.flux * by_slope / (x[1] - x[0]))
            .collect();
        let nodes = groove.widths.iter().zip(&per_wear);
        let mut diagonal: Vec<f64> = nodes.map(|(width, per_wear)| width * per_wear).collect();
        for (i, beside) in beside.iter().enumerate() {
            diagonal[i] -= beside;
            diagonal[i + 1] -= beside;
        }
        solve_tridiagonal(&mut diagonal, &beside, &mut step);
        let mut largest = 0.0;
        for (step, per_wear) in step.iter_mut().zip(&per_wear) {
            if *per_wear >= HELD {
                *step = 0.0;
            }
            largest = f64::max(largest, step.abs() * per_wear);
        }
        Step {
            wear: step,
            largest,
        }
    }
}

#[cfg(test)]
mod tests;
