//! Plating: wear of a surface through layers over its base.
//!
//! The dose D = int p |ds| of a point, MPa mm, wears it by dh = k_i dD in layer i, with the specific wear rate k_i in 1/MPa, so
//! that h = G(D) is continuous, piecewise linear, and depends on the dose alone. The dose of a worn depth, its inverse, is
//! therefore no state of its own. An increment takes what is left of a layer by its rate and the rest of the dose by the rates
//! below: exact at the interfaces, whatever the increment. Limiting case: layers of one rate are Archard's law.
//!
//! Range: rates that are the same in every local state; a layer's is positive, the base's may be zero. Layers wear as if they
//! were ideally flat and bonded; mixed debris and cracks at their edges are not part of it.

use std::ops::Range;

/// Most layers of a surface. Arbitrary: usual platings have one to four.
pub const MOST_LAYERS: usize = 8;

/// A layer of a plating.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Thickness, mm.
    pub thickness_mm: f64,
    /// Specific wear rate k, 1/MPa; positive.
    pub rate_per_mpa: f64,
}

/// Depth of the lower end of each layer, mm.
pub fn bottoms(plating: &[Layer]) -> impl Iterator<Item = f64> {
    plating.iter().scan(0.0, |depth, layer| {
        *depth += layer.thickness_mm;
        Some(*depth)
    })
}

/// Layers over a base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    count: usize,
    /// Depth of the lower end of each layer, mm.
    bottom: [f64; MOST_LAYERS],
    /// Specific wear rate of each layer, and of the base below them, 1/MPa.
    rate: [f64; MOST_LAYERS + 1],
}

impl Layers {
    /// The layers of a plating, of which there is at least one and at most [`MOST_LAYERS`], from the surface down, over a base
    /// of a specific wear rate in 1/MPa.
    pub fn new(plating: &[Layer], base: f64) -> Self {
        debug_assert!(
            (1..=MOST_LAYERS).contains(&plating.len()),
            "a plating has layers"
        );
        let mut layers = Self {
            count: plating.len(),
            bottom: [0.0; MOST_LAYERS],
            rate: [base; MOST_LAYERS + 1],
        };
        for (i, (layer, bottom)) in plating.iter().zip(bottoms(plating)).enumerate() {
            layers.bottom[i] = bottom;
            layers.rate[i] = layer.rate_per_mpa;
        }
        layers
    }

    /// The layers with each rate divided by the ratio of its hardness.
    #[must_use]
    pub(crate) fn softened(mut self, ratio: impl Fn(usize) -> f64) -> Self {
        for (layer, rate) in self.rate[..=self.count].iter_mut().enumerate() {
            *rate /= ratio(layer);
        }
        self
    }

    /// Number of layers over the base.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The layer of a depth, the upper one at an interface; the number of layers in the base.
    fn at(&self, depth: f64) -> usize {
        let bottoms = self.bottom[..self.count].iter();
        bottoms.take_while(|bottom| depth >= **bottom).count()
    }

    /// Depths around one between which no layer wears faster than the one above it, mm; the base has no end.
    pub(crate) fn without_faster(&self, depth: f64) -> Range<f64> {
        let at = self.at(depth);
        let quickens = |bottom: &usize| self.rate[bottom + 1] > self.rate[*bottom];
        let start = (0..at).rev().find(quickens);
        let end = (at..self.count).find(quickens);
        let bottom = |found: usize| self.bottom[found];
        start.map_or(0.0, bottom)..end.map_or(f64::INFINITY, bottom)
    }

    /// Specific wear rate at a depth in mm, 1/MPa.
    pub fn rate(&self, depth: f64) -> f64 {
        self.rate[self.at(depth)]
    }

    /// Specific wear rate of the outermost layer, 1/MPa.
    pub fn outer_rate(&self) -> f64 {
        self.rate[0]
    }

    /// Largest specific wear rate from the surface down to a depth in mm, 1/MPa.
    pub(crate) fn largest_rate(&self, depth: f64) -> f64 {
        self.rate[..=self.at(depth)]
            .iter()
            .fold(0.0, |most, rate| rate.max(most))
    }

    /// Depth by which a dose in MPa mm recedes a surface that is worn to a depth, mm, and the rate that it ends with, 1/MPa.
    pub(crate) fn recession(&self, depth: f64, dose: f64) -> (f64, f64) {
        let first = self.at(depth);
        let (mut worn, mut left) = (0.0, dose);
        for i in first..self.count {
            let (rate, room) = (self.rate[i], self.bottom[i] - depth - worn);
            if rate * left < room {
                return (worn + rate * left, rate);
            }
            worn += room;
            left -= room / rate;
        }
        let rate = self.rate[self.count];
        (worn + rate * left.max(0.0), rate)
    }

    /// Depth that the outermost layer alone would have lost by the dose of a depth, mm; from the upper end of a base that does
    /// not wear on the least dose that reaches it.
    pub fn equivalent(&self, depth: f64) -> f64 {
        let (mut equivalent, mut above) = (0.0, 0.0);
        for i in 0..=self.count {
            let bottom = if i < self.count {
                self.bottom[i]
            } else {
                f64::INFINITY
            };
            if self.rate[i] <= 0.0 {
                break;
            }
            equivalent += (depth.min(bottom) - above) * (self.rate[0] / self.rate[i]);
            if depth <= bottom {
                break;
            }
            above = bottom;
        }
        equivalent
    }

    /// Largest depth that wear reaches, mm.
    pub fn deepest(&self) -> f64 {
        if self.rate[self.count] > 0.0 {
            f64::INFINITY
        } else {
            self.bottom[self.count - 1]
        }
    }

    /// Depth whose equivalent is this, mm.
    pub fn depth(&self, equivalent: f64) -> f64 {
        self.recession(0.0, equivalent / self.rate[0]).0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.76 um at 1e-8 1/MPa over 1.27 um at 4e-8 over 2e-7.
    fn gold_nickel_copper() -> Layers {
        let layer = |thickness_mm, rate_per_mpa| Layer {
            thickness_mm,
            rate_per_mpa,
        };
        Layers::new(&[layer(0.76e-3, 1e-8), layer(1.27e-3, 4e-8)], 2e-7)
    }

    fn is_close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-14 * b.abs().max(1e-3)
    }

    #[test]
    fn layers_of_one_rate_have_no_interface() {
        let layer = |rate_per_mpa| Layer {
            thickness_mm: 1e-3,
            rate_per_mpa,
        };
        let rates = [2e-8, 2e-8, 1e-8, 3e-8];
        let layers = Layers::new(&rates.map(layer), 3e-8);
        assert_eq!(layers.without_faster(0.0), 0.0..3e-3);
        assert_eq!(layers.without_faster(2.5e-3), 0.0..3e-3);
        assert_eq!(layers.without_faster(3e-3), 3e-3..f64::INFINITY);
        assert_eq!(layers.without_faster(9e-3), 3e-3..f64::INFINITY);
    }

    #[test]
    fn depth_is_piecewise_linear_in_the_dose() {
        let layers = gold_nickel_copper();
        let depth = |dose| layers.recession(0.0, dose).0;
        assert!(is_close(depth(8e4), 9.2e-4), "{}", depth(8e4));
        assert!(is_close(depth(1.2e5), 4.48e-3), "{}", depth(1.2e5));
        // Across an interface: 2 MPa mm by the rate of gold, 4 by that of nickel.
        let (added, rate) = layers.recession(depth(75_998.0), 6.0);
        assert!((added - 1.8e-7).abs() < 1e-18, "{added}");
        assert!(is_close(rate, 4e-8));
    }

    #[test]
    fn many_increments_wear_as_one() {
        let layers = gold_nickel_copper();
        let mut depth = 0.0;
        for _ in 0..1_200 {
            depth += layers.recession(depth, 100.0).0;
        }
        assert!((depth - 4.48e-3).abs() < 1e-13, "{depth}");
    }

    #[test]
    fn the_equivalent_depth_is_the_outer_rate_times_the_dose() {
        let layers = gold_nickel_copper();
        for dose in [0.0, 100.0, 75_999.9, 76_000.0, 9e4, 107_750.0, 5e5] {
            let depth = layers.recession(0.0, dose).0;
            let equivalent = layers.equivalent(depth);
            assert!(is_close(equivalent, 1e-8 * dose), "{dose}: {equivalent}");
            assert!(is_close(layers.depth(equivalent), depth), "{dose}");
        }
    }

    #[test]
    fn a_base_that_does_not_wear_ends_the_recession() {
        let layer = Layer {
            thickness_mm: 1e-3,
            rate_per_mpa: 1e-8,
        };
        let layers = Layers::new(&[layer], 0.0);
        let (worn, rate) = layers.recession(0.5e-3, 1e9);
        assert!(is_close(worn, 0.5e-3) && rate <= 0.0);
        assert_eq!(layers.recession(1e-3, 10.0), (0.0, 0.0));
        assert!(is_close(layers.equivalent(1e-3), 1e-3));
    }

    #[test]
    fn rates_are_those_of_the_layer_at_a_depth() {
        let layers = gold_nickel_copper();
        for (depth, rate) in [
            (0.0, 1e-8),
            (0.76e-3, 4e-8),
            (2.02e-3, 4e-8),
            (2.04e-3, 2e-7),
        ] {
            assert!(is_close(layers.rate(depth), rate));
        }
        assert!(is_close(layers.largest_rate(1e-3), 4e-8) && is_close(layers.outer_rate(), 1e-8));
    }
}
