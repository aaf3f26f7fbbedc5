//! Fitted constants that turn a tolerance into a mesh, increments and jumps.
//!
//! `cargo run --release -p solver --example calibration` varies each of them, and prints the errors and the work that
//! the values here were chosen by, for scenes named below: a scar and a long scar (`mccoll.json` for 1 500 and 18 000
//! cycles), a groove and a long groove (`fuzz_button.json` for 25 and 240 cycles), a sprung contact that outgrows its
//! stroke, partial slip, and a contact half as wide as the bodies. A constant whose variation changes little there is
//! said to be arbitrary.

/// A power of the tolerance, fitted at 2 %: `value` (0.02/tolerance)^`exponent`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Power {
    /// Value at a tolerance of 2 %.
    pub value: f64,
    /// Exponent of 0.02/tolerance.
    pub exponent: f64,
}

impl Power {
    /// Value at a tolerance.
    pub fn at(self, tolerance: f64) -> f64 {
        self.value * (0.02 / tolerance).powf(self.exponent)
    }
}

/// Constants of mesh, increments, jumps, replays and forecast.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// Elements across the narrowest half-width of the contact. The error of a worn profile falls with the element's
    /// size at an order of 1.3 to 2.1 (`solver/tests/converge_scars.rs`), which alone would allow powers of 0.5 to 0.8;
    /// depth and width are less sensitive than the profile's worst place, so 0.4 holds the tolerance
    /// (`solver/tests/converge_tolerance.rs`).
    pub elements: Power,
    /// Growth of elements from one to the next outside the core.
    pub zone_growth: Power,
    /// The same below 2 % where a short stroke wears a scar: its worst place is the edge, far out in the zone, where
    /// the error is of first order. On `mccoll.json` at 1, 0.5 and 0.3 % the power -0.35 left 1.5, 1.3 and 1.0 % there,
    /// -1.5 1.0, 0.4 and 0.4 %. At 0.5 % the worse side of the scar, the slider, is 0.59, 0.45 and 0.38 % off with
    /// -0.35, -1.5 and -2.2.
    pub scar_zone_growth: Power,
    /// Growth of the layers away from the surface, less 1. Arbitrary: 0.12 to 0.5, and powers of 0 to -0.6, change no
    /// error of the scar and the groove by more than 0.05 % of the depth.
    pub layer_growth: Power,
    /// The same in partial slip, where the slip depends on the tangential compliance of the bodies, whose error is of
    /// first order in it. Of ten random scenes five differ from twice the accuracy by up to 13 % of the worn area with
    /// 0.25, three by up to 4 % with 0.12 (`solver/tests/metamorphic/refined_tolerance.rs`).
    pub sticking_layer_growth: Power,
    /// Factor on the number of elements in partial slip: wear is confined to a slip zone that is narrower than the
    /// contact, with steep walls beside the stick zone. At 2 % the profile of the worse side is off by 2.7 % of the
    /// worn area with 3.5, by 1.4 % with 5 and 0.9 % with 6.
    pub sticking_refinement: f64,
    /// Width of the finely meshed zone over that of the expected scar. Arbitrary: with 1 and with 2 no scene's errors
    /// are larger than its tolerance.
    pub scar_margin: f64,
    /// Half-width of the core of smallest elements over that of the narrowest contact: with 1, 2 and 4 the scar's width
    /// is off by 1.1, 0.6 and 0.6 % at 2 %.
    pub core: f64,
    /// Growth of elements outside the zone. Arbitrary: 0.12 and 0.5 give the same errors of the scar and the groove
    /// within 0.3 % of the depth.
    pub outer_growth: f64,
    /// Largest element outside the zone, over half of the surface. Arbitrary: 0.05 and 0.2 give the same errors within
    /// 0.1 %.
    pub outer_element: f64,
    /// Contact nodes of a finely meshed zone over those of the widest expected contact, where a travel is so long that
    /// the surface is divided into zones. The work of all of them is proportional to m^3/(m - 1), least at 1.5; the
    /// rest is for a contact that is wider than expected. `solver/tests/verify_long_wipe.rs` prints how far zones and a
    /// single mesh differ.
    pub zone_width: f64,
    /// Largest element under the contact that is chosen from the tolerance, over the narrower body's half-length: also
    /// soft or heavily loaded bodies have some elements. Not enough for them: a contact half as wide as the bodies, at
    /// a hundredth of its width of stroke, is 7.6 % off in depth at 2 %; 0.05 leaves 0.3 %.
    pub largest_element: f64,
    /// In gross sliding the slider carries the contact constraints if it wears at least so many times as fast as the
    /// receptacle: its flat widens over ever coarser elements, and constraints on the receptacle's finer nodes make its
    /// pressure a comb. `solver/tests/verify_worn_slider.rs` prints both: with the constraints on the receptacle and on
    /// the slider the pressure bends by 0.15 and 0.24 of its peak at a ratio of 0.05, by 0.20 and 0.16 at 0.1, by 0.45
    /// and 0.10 at 0.5, by 0.66 and 0.02 at 5.
    pub slider_constraints_gross: f64,
    /// The same in shorter strokes, where both surfaces have like elements: the slider if it wears more than so many
    /// times as fast.
    pub slider_constraints: f64,
    /// Modulus of the receptacle over the slider's below which the slider is nearly rigid: a pressure that alternates
    /// from element to element then deforms only the receptacle, and lasts on the slider's nodes until its wear in an
    /// increment is of the size of that deformation. With 1/80 the slider's nodes give a smooth pressure from the first
    /// cycle on; of the random specifications (`FRETWEAR_SEED=1`, 2 and 34) five below 1/800 alternate on them.
    pub rigid_slider: f64,
    /// Largest displacement of an increment over the contact's half-width. In the groove 0.25, 0.5 and 1 leave the peak
    /// pressure 0.4, 0.6 and 8.6 % off at 2 %, the profile 0.3, 0.5 and 1.3 %.
    pub step: Power,
    /// The same above 2 %: loose tolerances allow longer increments. At 10 % powers of -0.3, -0.55 and -0.8 leave the
    /// profile of the groove 3.3, 4.5 and 7.3 % off.
    pub loose_step: Power,
    /// Fewest increments a quarter of a cycle: 2, 5 and 10 leave the scar's profile 2.0, 0.9 and 0.7 % off at 2 %.
    pub steps_per_quarter: Power,
    /// A contact widened by a jump is resolved as if it were at most so many times as wide as that of a single cycle:
    /// each increment leaves an imprint of the slider's shape, and longer ones leave scallops that disturb the next
    /// pass. On `fuzz_button.json` at 2 % after 2 000 cycles they are 2 um long and 18 nm high without this, and the
    /// peak pressure is 30 % off; it is 12 % with 2, 6 % with 1.75 and 5 % with 1.5, in 1.25, 1.35 and 1.5 times the
    /// time.
    pub widest: f64,
    /// Part of its length that a spine may lose before the stiffness is rebuilt, over the tolerance. The
    /// condensed response depends on the height through the logarithm of height over contact width, and a rigid
    /// lowering costs nothing because the slider's height is free. On `fuzz_button.json`, whose block loses three
    /// quarters of its height, shares of 0.05, 0.1, 0.2 and 0.3 (20, 11, 5 and 3 rebuilds) agree at the deepest place
    /// to 0.02 %, and everywhere to 0.25 % of it; 0.3 and 0.5 (1 rebuild) to 0.001 % at the deepest place.
    pub drift: f64,
    /// Bounds of the same.
    pub drift_bounds: (f64, f64),
    /// Bounds of the change of a jump from one computed cycle to the next. Arbitrary below 0.5 and from 2 on; 0.8 and
    /// 1.2 disturb the peak pressure of the sprung contact.
    pub jump_change: (f64, f64),
    /// Largest jump over the cycles done, so that the first cycles are resolved. Arbitrary: 0.25 takes 13 % more cycles
    /// than 1 on the scar, with the same errors.
    pub jump_of_done: f64,
    /// The same in gross reciprocating sliding, over the tolerance: each pass of a jump wears the whole jump at once,
    /// and the ends of the stroke wear too early. On `fuzz_button.json` at 240 cycles and 0.04 mm, relative to the
    /// deepest place: 8 % with jumps of 0.16 of the cycles done, 4 % with 0.08, 2 % with 0.04.
    pub gross_jump_of_done: f64,
    /// A stroke is gross reciprocating sliding where its amplitude exceeds so many half-widths of the contact. 1 and 2
    /// are the same for the sprung contact; with 4 it takes twice the cycles for the same errors.
    pub gross_from: f64,
    /// Largest pressure skew k jump s E*/b by a jump, over the tolerance: 48 leaves the long scar 0.1 % more off at its
    /// worst place, in 57 % of the cycles.
    pub skew: f64,
    /// The least of it. On `mccoll.json` at 18 000 cycles, 0.1 mm to either side of the middle, pressures are 27 %
    /// apart with jumps of 700 and 2 % with 100, where they are 5 % apart without jumps, while no depth changes by more
    /// than 0.15 %.
    pub least_skew: f64,
    /// Number of computed cycles, times the tolerance, that suffices where even single cycles are skewed. Arbitrary: 1
    /// and 10 change nothing on the sprung contact.
    pub sufficient_cycles: f64,
    /// Length of the lead-in of a replay over the mean half-width of the contact: twice the contact's width. A length
    /// of 8 changes the peak pressure of the long groove by less than 0.01 %, of 2 by 4 %.
    pub lead_in: f64,
    /// Last part of the lead-in, over the half-width of the contact of a single cycle, whose increments are chosen for
    /// that contact; in those of the wider one the pressure is 6 % low. From 1 to 8 the peak pressure of the long
    /// groove changes by 0.5 %.
    pub fine_lead_in: f64,
    /// The forecast's a over the Hertz half-width: elastic pressures change more slowly than those of a rigid segment.
    /// On `mccoll.json` and `cylinder_on_flat` the error of a jump agrees within a fifth from the 50th cycle on with
    /// 1.3, and is two and a half times too large at first with 1.
    pub surrogate_half_width: f64,
    /// Share of the squared leading-edge step in the squared half-width of a contact in gross sliding: 0.27 to 0.47 on
    /// all systems at tolerances of 10 and 2 %, with jumps of 1 to 300 cycles.
    pub step_share: f64,
}

impl Tuning {
    /// Largest displacement of an increment for a contact of a half-width, mm.
    pub(crate) fn largest_step(&self, tolerance: f64, half_width: f64) -> f64 {
        let step = if tolerance > 0.02 {
            self.loose_step
        } else {
            self.step
        };
        step.at(tolerance) * half_width
    }

    /// Whether a stroke is gross reciprocating sliding on a contact of a half-width, mm.
    pub(crate) fn is_gross(&self, amplitude: f64, half_width: f64) -> bool {
        amplitude > self.gross_from * half_width
    }

    /// The fitted values.
    pub const FITTED: Self = Self {
        elements: power(8.0, 0.4),
        zone_growth: power(0.06, -0.35),
        scar_zone_growth: power(0.06, -2.2),
        layer_growth: power(0.25, -0.3),
        sticking_layer_growth: power(0.12, -0.3),
        sticking_refinement: 6.0,
        scar_margin: 1.3,
        core: 2.0,
        outer_growth: 0.25,
        outer_element: 0.1,
        zone_width: 2.0,
        largest_element: 0.1,
        slider_constraints_gross: 0.1,
        slider_constraints: 1.0,
        rigid_slider: 0.005,
        step: power(0.5, -0.4),
        loose_step: power(0.5, -0.55),
        steps_per_quarter: power(5.0, 0.36),
        widest: 1.75,
        drift: 25.0,
        drift_bounds: (0.05, 0.5),
        jump_change: (0.5, 2.0),
        jump_of_done: 1.0,
        gross_jump_of_done: 2.0,
        gross_from: 2.0,
        skew: 12.0,
        least_skew: 0.15,
        sufficient_cycles: 2.5,
        lead_in: 4.0,
        fine_lead_in: 4.0,
        surrogate_half_width: 1.3,
        step_share: 0.42,
    };
}

const fn power(value: f64, exponent: f64) -> Power {
    Power { value, exponent }
}
