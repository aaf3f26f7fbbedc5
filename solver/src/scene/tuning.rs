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
    /// The same across the estimated half-width of the scar at the end of a short stroke: the scar's edge lies there, and its
    /// width is off by a third of an element. Of the random scenes of `tolerance_table` whose scar is hardly wider than the
    /// unworn contact seven leave 2.0 to 4.8 % in width at 2 % without this, at most 0.7 % with 16.
    pub scar_elements: Power,
    /// The same in gross reciprocating sliding, where the contact rests on the floor that it wears: there the increments
    /// decide, not the elements. On `zif` for 500 cycles at 2 %, 8 elements with steps of 0.5 half-widths leave the peak
    /// pressure up to 32 % off, 8 with 0.25 up to 10 %, 4 with 0.25 up to 5 % in 0.65 times the time of the first; depth
    /// and width are within 0.4 % with each.
    pub gross_elements: Power,
    /// Factor on the same where the slider wears: its scar is hardly wider than the contact. Of 32 random scenes in long
    /// grooves at 2 % (`tolerance_table`), 5 scar widths are off by more than the tolerance without, 2 with 1.5; those with a
    /// worn slider take 1.3 times as long.
    pub gross_slider_refinement: f64,
    /// Growth of elements from one to the next outside the core. Errors are the same with 0.03, 0.06 and 0.1; where both
    /// bodies wear, the corner of the slider's flat stands on these elements, and the pressure there alternates by 0.03
    /// and 0.23 of its peak with 0.03 and 0.06 (draw 477 of the random specifications at 2 %).
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
    /// first order in it; see `sticking_steps_per_quarter`.
    pub sticking_layer_growth: Power,
    /// Factor on the number of elements in partial slip: wear is confined to a slip zone that is narrower than the
    /// contact, with steep walls beside the stick zone. With 6 and 12 no random scene's depth or area is more exact
    /// at 2 %; the width of McColl's at 0.5 % is 0.65 % off with 4, 0.2 % with 5.3. Above 2 % it is that
    /// of 2 %.
    pub sticking_refinement: Power,
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
    /// Fewest contact nodes of such a zone: with fewer, most spines of its mesh are coarse ones outside of it. Arbitrary.
    pub fewest_zone_nodes: f64,
    /// Largest element under the contact that is chosen from the tolerance, over the narrower body's half-length: also
    /// soft or heavily loaded bodies have some elements. Not enough for them: a contact half as wide as the bodies, at
    /// a hundredth of its width of stroke, is 7.6 % off in depth at 2 %; 0.05 leaves 0.3 %.
    pub largest_element: f64,
    /// In gross sliding the slider carries the contact constraints if it wears at least so many times as fast as the
    /// receptacle: its flat widens over ever coarser elements, and constraints on the receptacle's finer nodes make its
    /// pressure a comb. `solver/tests/verify_worn_slider.rs` prints both: with the constraints on the receptacle and on
    /// the slider the pressure bends by 0.22 and 0.03 of its peak at a ratio of 0.01, by 0.24 and 0.06 at 0.05, by 0.29
    /// and 0.04 at 0.1, by 0.99 and 0.03 at 1.
    pub slider_constraints_gross: f64,
    /// The same in shorter strokes, where both surfaces have like elements: the slider if it wears more than so many
    /// times as fast.
    pub slider_constraints: f64,
    /// Modulus of the other body over that of a nearly rigid one. A pressure that alternates from element to element deforms
    /// only the other body, and lasts on the rigid one's nodes until its wear in an increment is of the size of that
    /// deformation. With a slider of 80 times the receptacle's modulus its nodes give a smooth pressure from the first
    /// cycle on; of the random specifications (`FRETWEAR_SEED=1`, 2 and 34) six beyond 800 times alternate on them.
    pub rigid_body: f64,
    /// Largest displacement of an increment over the contact's half-width. Longer ones leave waves of some nanometres in
    /// the floor, against an indentation of ten, and the pressure follows them: on `zif` it is up to 32 % off with 0.5, 5 %
    /// with 0.25. A contact widened by a jump is resolved like that of a single cycle: with steps for 1.75 and 1.2 times
    /// that width the pressure is up to 20 and 9 % off after 1 000 cycles, 6 % with steps for itself.
    pub step: Power,
    /// The same above 2 %: loose tolerances allow longer increments. At 10 % powers of -0.3, -0.55 and -0.8 leave the
    /// profile of the groove 3.3, 4.5 and 7.3 % off.
    pub loose_step: Power,
    /// The same over `step` in strokes that are shorter than the contact, up to twice the fewest increments a quarter: where
    /// a scar is hardly wider than the unworn contact, its middle is -3.5 to 1.0 % off with 5 increments a quarter, and within
    /// 0.3 % with 10.
    pub short_step: f64,
    /// Fewest increments a quarter of a cycle: 2, 5 and 10 leave the scar's profile 2.0, 0.9 and 0.7 % off at 2 %.
    pub steps_per_quarter: Power,
    /// The same in partial slip, where most of the displacement is elastic: five random scenes (`tolerance_table`, 13, 14,
    /// 51, 60, 63) are off by 5 to 9 % in the worn area with 5 increments, layers that grow by 0.12 and 6 times the elements,
    /// by 0.5 to 1.1 % with 10 to 14, 0.06 and 4 times, in 0.8 times the time.
    pub sticking_steps_per_quarter: Power,
    /// Increments in which the load is applied where a contact may stick. In one of them two random scenes of unlike bodies in partial slip (24 and 36
    /// of `tolerance_table`) are 8 and 9 % off in the worn area against 64; in 16 of them 0.1 and 0.5 %.
    pub load_steps: Power,
    /// Part of its length that a spine may lose before the stiffness is rebuilt. The condensed response depends on the
    /// height through the logarithm of height over contact width, and a rigid lowering costs nothing because the slider's
    /// height is free. On `fuzz_button.json`, whose block loses three quarters of its height, 0.05 (20 rebuilds) and 0.5 (1)
    /// differ at 2 % by 0.02 % at the deepest place and 0.05 % anywhere, and at 0.5 % exponents of 0, -0.5 and -1 leave the
    /// profile 0.47, 0.50, 0.50 % off.
    pub drift: Power,
    /// Bounds of the same.
    pub drift_bounds: (f64, f64),
    /// Bounds of the change of a jump from one computed cycle to the next. Arbitrary below 0.5 and from 2 on; 0.8 and
    /// 1.2 disturb the peak pressure of the sprung contact.
    pub jump_change: (f64, f64),
    /// Allowed estimated error of a jump over the tolerance, at least 1. On `mccoll.json` at 0.5 %, with exponents of 0, 0.5
    /// and 1: 411, 332 and 305 computed cycles; depth, width, profile and peak pressure differ by 0.01 % at most.
    pub jump_error: Power,
    /// Factor on it where a short stroke wears a scar without sticking: its contact conforms, so that later cycles remove the
    /// errors of earlier ones. At 2 % and 0.5 %, with 1, 1.5, 2 and 3: 46, 33, 28, 24 and 81, 57, 45, 35 cycles, with the same errors
    /// within 0.07 %; a scar in partial slip is 1.85, 1.93, 2.04, 2.04 % off in area at 2 %.
    pub scar_jump_error: f64,
    /// Largest jump over the cycles done, so that the first cycles are resolved. Arbitrary: 0.25 takes 13 % more cycles
    /// than 1 on the scar, with the same errors.
    pub jump_of_done: f64,
    /// The same in gross reciprocating sliding, over the tolerance, where the contact wears the whole jump. Arbitrary for a
    /// slider that wears alone: other limits are narrower.
    pub gross_jump_of_done: f64,
    /// The largest of these jumps over the last one before a cycle that is hit exactly, where the slider wears: one side of its
    /// flat has worn last, by the whole jump. The peak pressures of two random scenes at 2 % (`tolerance_table`, 59 and 95)
    /// are off by 1.7 and 13.6 % without, by 0.1 and 1.1 % with 8.
    pub gross_taper: f64,
    /// The same where only the receptacle wears, in a groove. On `fuzz_button.json` at 2 000 cycles and 2 %, with 3, 6, 12, 24
    /// and 48: the area off by 0.05, 0.11, 0.20, 0.34, 0.43 %, the wall by 0.1, 0.3, 0.5, 0.8, 1.0 % of the depth, with 93, 54,
    /// 32, 22, 19 computed cycles.
    pub groove_jump_of_done: f64,
    /// The same where both bodies wear: the slider's edge wears on the leading-edge step of the whole jump. With 2, 1 and
    /// 0.5 the receptacle's depth is off by 3.0, 1.1 and 0.2 %, the peak pressure by up to 32, 13 and 6 % after 300 cycles
    /// at 2 %.
    pub gross_jump_of_both: f64,
    /// A stroke is gross reciprocating sliding where its amplitude exceeds so many half-widths of the contact. 1 and 2
    /// are the same for the sprung contact; with 4 it takes twice the cycles for the same errors.
    pub gross_from: f64,
    /// Largest pressure skew k jump s E*/b of a jump. At 2 %, with 0.2, 0.4 and 0.8: 141, 120, 74 cycles of the long scar, with the same
    /// errors within 0.2 %; pressures at the neutral position of `mccoll.json` are up to 2, 2 and 3 % of the peak off after 3 000
    /// cycles, 3, 4 and 6 % at a turning point after 18 000.
    pub skew: Power,
    /// The least of it. At 0.3 %, with 0.15, 0.3, 0.4 and 0.6: 304, 182, 152 and 126 cycles of `mccoll.json`, its peak pressure after
    /// 18 000 of them 0.3, 0.5, 0.7, 1.0 % off, within the contact 1.0, 1.3, 1.6, 1.8 % of it.
    pub least_skew: f64,
    /// Largest pressure skew of a single cycle, k s E*/b, at which contacts are reported without the skew of the jump: beyond
    /// it a pass reshapes the contact. On `pin` with a worn slider, 1 500 cycles at 2 %, where it falls from 1.2 to 0.14, with 0.1,
    /// 0.2 and 0.4: peak pressures up to 0.14, 0.71, 0.75 off those of single cycles, 0.07, 0.12, 0.19 in the root mean square.
    pub unskewed_to: f64,
    /// Number of computed cycles, times the tolerance, that suffices where even single cycles are skewed. Arbitrary: 1
    /// and 10 change nothing on the sprung contact.
    pub sufficient_cycles: f64,
    /// Repetitions of a mission that are taken together over those done. On a sprung contact with 30 cycles of 0.02 mm and 2 of 0.15 mm in
    /// each of 60 repetitions, with 0.1, 0.2, 0.5 and 1 against 0: the depth 0.15, 0.36, 0.85, 1.5 % off, the profile 1.1, 1.9, 3.8, 5.4 %
    /// (first order), with 236, 192, 134, 111 computed cycles (278).
    pub repetitions_of_done: Power,
    /// Length of the lead-in of a replay over the mean half-width of the contact: twice the contact's width. A length
    /// of 8 changes the peak pressure of the long groove by 0.01 %, of 2 by 2 %.
    pub lead_in: f64,
    /// Most half-widths of the contact of a single cycle that increments are chosen for. On `fuzz_button.json` at 500 cycles
    /// and 2 %, with 1, 3 and 6: 50 100, 21 800, 16 500 increments, depth off by 0.2 %, the wall by 3.6 %, the peak pressure by
    /// 2.3 % with each.
    pub widest_followed: f64,
    /// Longest step D of increments whose waves the next pass wears off, over the half-width b of the contact of a single
    /// cycle and k E*: over a half-plane they fade by exp(-2 pi k E* b/D) in a pass, with 0.5 by exp(-12). On
    /// `fuzz_button.json` at 240 cycles and 2 %, with 0, 0.25, 0.5 and 1: 32 700, 24 000, 14 300, 11 800 increments, the wall
    /// off by 3.2, 3.2, 3.3, 3.7 %, depth and peak pressure alike. With 1 the coarse companions would take steps that are
    /// wider than the contact. At 0.5 %, with exponents of 0, -0.25 and -0.5: the wall off by 0.52, 0.48, 0.41 % after 25 cycles.
    pub smoothed_step: Power,
    /// Half-widths of the contact of a single cycle that such increments are chosen for at most, over the root of the cycles
    /// done: the waves of the first cycles are not yet small against the depth. After 3 cycles at 2 %, with 1, 2 and 4: the
    /// profile off by 1.7, 2.5 and 3.3 % at its worst place, with 3 500, 2 200, 1 600 increments.
    pub smoothed_early: f64,
    /// Length over which a replay passes the floor there and back on either side of its place, where increments are longer
    /// than the contact of a single cycle needs, over the half-width of that. Longer increments leave waves in the floor;
    /// one pass wears them off. The ends of a short pass are as deep as it has worn, and the contact would touch them: on
    /// `fuzz_button.json` at 500 cycles the peak pressure is off by 4.6, 2.9, 2.3, 2.2 % with 3, 5, 8, 16.
    pub smoothing_pass: Power,
    /// Part of that pass next to its place whose increments are those of the contact of a single cycle, over the half-width of
    /// that; farther away they are those of the cycle. With 2, 4 and 8 the peak pressure of `fuzz_button.json` at cycle 2 000
    /// and 0.3 % is 575.1, 571.1 and 571.2 MPa.
    pub fine_pass: f64,
    /// The forecast's a over the Hertz half-width: elastic pressures change more slowly than those of a rigid segment.
    /// On `mccoll.json` and `cylinder_on_flat` the error of a jump agrees within a fifth from the 50th cycle on with
    /// 1.3, and is two and a half times too large at first with 1.
    pub surrogate_half_width: f64,
    /// Share of the squared leading-edge step in the squared half-width of a contact in gross sliding: 0.27 to 0.47 on
    /// all systems at tolerances of 10 and 2 %, with jumps of 1 to 300 cycles.
    pub step_share: f64,
    /// True if jumps are implicit in the worn shapes where they can be (`cycle/implicit.rs`, `point/integrator/implicit.rs`):
    /// `verify_implicit_jumps.rs` and `verify_implicit_points.rs` state what that saves. No specification sets it.
    pub implicit_jumps: bool,
}

impl Tuning {
    /// Returns `true` if a stroke is gross reciprocating sliding on a contact of a half-width, mm.
    pub(crate) fn is_gross(&self, amplitude: f64, half_width: f64) -> bool {
        amplitude > self.gross_from * half_width
    }

    /// The fitted values.
    pub const FITTED: Self = Self {
        elements: power(8.0, 0.4),
        scar_elements: power(16.0, 0.4),
        gross_elements: power(4.0, 0.4),
        gross_slider_refinement: 1.5,
        zone_growth: power(0.03, -0.35),
        scar_zone_growth: power(0.06, -2.2),
        layer_growth: power(0.25, -0.3),
        sticking_layer_growth: power(0.06, -0.3),
        sticking_refinement: power(4.0, 0.2),
        scar_margin: 1.3,
        core: 2.0,
        outer_growth: 0.25,
        outer_element: 0.1,
        zone_width: 2.0,
        fewest_zone_nodes: 240.0,
        largest_element: 0.1,
        slider_constraints_gross: 0.003,
        slider_constraints: 1.0,
        rigid_body: 0.005,
        step: power(0.2, -0.4),
        loose_step: power(0.2, -0.55),
        short_step: 0.3,
        steps_per_quarter: power(5.0, 0.36),
        sticking_steps_per_quarter: power(12.0, 0.36),
        load_steps: power(24.0, 0.7),
        drift: power(0.5, -0.5),
        drift_bounds: (0.05, 0.5),
        jump_change: (0.5, 2.0),
        jump_error: power(1.0, 0.5),
        scar_jump_error: 2.0,
        jump_of_done: 1.0,
        gross_jump_of_done: 6.0,
        gross_taper: 8.0,
        groove_jump_of_done: 12.0,
        gross_jump_of_both: 0.5,
        gross_from: 2.0,
        skew: power(0.4, -0.5),
        least_skew: 0.4,
        unskewed_to: 0.1,
        sufficient_cycles: 2.5,
        repetitions_of_done: power(0.1, -1.0),
        lead_in: 4.0,
        widest_followed: 6.0,
        smoothed_step: power(0.5, -0.25),
        smoothed_early: 2.0,
        smoothing_pass: power(8.0, 0.25),
        fine_pass: 4.0,
        surrogate_half_width: 1.3,
        step_share: 0.42,
        implicit_jumps: true,
    };
}

const fn power(value: f64, exponent: f64) -> Power {
    Power { value, exponent }
}
