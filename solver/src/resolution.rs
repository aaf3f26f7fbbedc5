//! Characteristic lengths of the contact, and the mesh spacing that follows from them.
//!
//! * Hertz' half-width of the unworn contact (`unworn_contact`);
//! * leading-edge step of one pass, where a rigid round slider wears the floor in gross sliding: the section k P equals
//!   b^2 / (2 R), so b = sqrt(2 R k P);
//! * scar of a short stroke: the circular segment that was worn off, b = (3 R W / 2)^(1/3) with the worn area
//!   W = (k_s + k_r) P s (parabola of height b^2/(2R) over 2 b);
//! * flat of a slider in a long stroke: the circular segment that it has lost, by the same formula with W = k_s P s; strokes of many
//!   half-widths resolve that of the first cycles instead of the unworn contact (`first_flat`);
//! * ends of the groove of a long stroke 2 A, W/(2 A) deep: the slider's arc reaches b = sqrt(R W / A) up them.

mod constraint_side;
mod first_flat;

use crate::closed_form::expected_wear::{expected_cycles, wear_rates};
use crate::closed_form::unworn_contact::{hertz_half_width, radius, sticks};
use crate::mesh::grading::Spacing;
use crate::number::real_cycles;
use crate::scene::{Accuracy, Refinement, Scene};
use crate::sides::{Side, Sides};

pub use first_flat::{FIRST_FLAT, first_flat};

/// Largest element given by the user or chosen for a coarse companion, over the narrower body's half-length: each half of a
/// body has at least two. Arbitrary.
const FEWEST_SHARE: f64 = 0.5;

/// Tolerance beyond which the elements of gross sliding, and their growth, are those of this one: on steep walls and in the
/// corners of worn flats coarser ones let the pressure alternate (`cargo test --release -p tests hard`).
const COARSEST: f64 = 0.02;

/// Cycles that a mesh is made for over those in which a depth is expected: the estimate takes each body to wear alone. Arbitrary: a
/// contact that outgrows its zones gets wider ones.
const EXPECTED_MARGIN: u64 = 2;

/// Characteristic lengths of the contact and the mesh, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes {
    /// Hertz half-width of the unworn contact.
    pub hertz_half_width: f64,
    /// Estimated half-width of the contact at the end.
    pub final_half_width: f64,
    /// True if part of the contact may stick through the whole stroke.
    pub sticks: bool,
    /// The body whose nodes carry the contact constraints.
    pub slave: Side,
    /// Surface element size under the contact.
    pub contact_element: f64,
    /// Growth of the layers away from the surface.
    pub layer_growth: f64,
    /// Spacing along each surface.
    pub spacing: Sides<Spacing>,
}

/// Travel of the contact over the slider per displacement of the slider, R / (R + R_crown): the gap of two parabolas a
/// displacement d apart, (x - d)^2 / (2 R) + x^2 / (2 R_crown), is least at x = d R_crown / (R + R_crown). On a flat
/// receptacle the contact moves with the slider; wear flattens a crown, so that the receptacle is meshed for all of d.
fn travel_over_slider(slider: f64, crown: Option<f64>) -> f64 {
    crown.map_or(0.0, |crown| slider / (slider + crown))
}

/// Chooses the spacing of a scene's meshes: of a mission the finest and widest that one of its blocks needs.
pub fn choose(scene: &Scene) -> Sizes {
    let hertz = hertz_half_width(scene);
    let rates = wear_rates(scene, hertz);
    let expected = expected_cycles(scene, hertz).saturating_mul(EXPECTED_MARGIN);
    let expected = expected.min(scene.cycles);
    let of_block = |block: &Scene| {
        let cycles = if block.cycles == scene.cycles {
            real_cycles(expected)
        } else {
            real_cycles(expected) * (real_cycles(block.cycles) / real_cycles(scene.cycles))
        };
        let sliding = block.motion.distance_per_cycle_mm() * cycles;
        (sliding, of_motion(block, hertz, rates, sliding))
    };
    let mut blocks = scene.blocks();
    // A block without any motion wears nothing and needs no mesh, if another one moves.
    if blocks.iter().any(|block| moves(block)) {
        blocks.retain(|block| moves(block));
    }
    let blocks = blocks.iter().map(|block| of_block(block));
    let both = |(one_path, one): (f64, Sizes), (other_path, other): (f64, Sizes)| {
        let slave = if other_path > one_path {
            other.slave
        } else {
            one.slave
        };
        let path = one_path.max(other_path);
        (
            path,
            Sizes {
                slave,
                ..one.for_both(other)
            },
        )
    };
    let sizes = blocks.reduce(both).map(|(_, sizes)| sizes);
    sizes.unwrap_or_else(|| of_motion(scene, hertz, rates, 0.0))
}

/// Returns `true` if anything moves in a scene.
fn moves(scene: &Scene) -> bool {
    scene.motion.distance_per_cycle_mm() > 0.0
}

impl Sizes {
    /// Sizes that serve both of two blocks.
    fn for_both(self, other: Self) -> Self {
        Self {
            hertz_half_width: self.hertz_half_width,
            final_half_width: self.final_half_width.max(other.final_half_width),
            sticks: self.sticks || other.sticks,
            slave: self.slave,
            contact_element: self.contact_element.min(other.contact_element),
            layer_growth: self.layer_growth.min(other.layer_growth),
            spacing: self
                .spacing
                .zip(other.spacing)
                .map(|(one, other)| one.for_both(other)),
        }
    }
}

/// The spacing for one motion, by which the surfaces slide so far on each other, mm.
fn of_motion(scene: &Scene, hertz: f64, rates: Sides<f64>, sliding: f64) -> Sizes {
    let slider_radius = scene.slider.shape.radius_mm;
    let crown = scene.receptacle.shape.crown_radius_mm;
    let radius = radius(scene);
    let load = scene.load_n_per_mm;
    let amplitude = scene.motion.amplitude_mm();
    let wear = rates.receptacle + rates.slider;
    let worn = wear * load * sliding;
    let edge_step = edge_step(radius, wear, load);
    let narrowest = hertz.max(edge_step);
    let segment = |worn: f64| (1.5 * radius * worn).cbrt().min(radius);
    // Gross reciprocating sliding wears a groove, at whose ends the contact climbs the walls; a shorter stroke wears a
    // scar around the contact. A slider that wears has a flat, as wide as the segment that it has lost.
    let gross = scene.accuracy.tuning.is_gross(amplitude, narrowest);
    let last = if gross {
        let ends = (radius * worn / amplitude).sqrt().min(radius);
        let flat = segment(rates.slider / wear.max(f64::MIN_POSITIVE) * worn);
        ends.max(edge_step).max(flat)
    } else {
        segment(worn)
    }
    .max(hertz);
    // A stroke shorter than the leading-edge step does not develop it.
    let narrowest = if gross { narrowest } else { hertz };
    let resolved = scene.accuracy.narrowest_contact_mm;
    let resolved = resolved.map_or(narrowest, |resolved| resolved.max(narrowest));

    let Accuracy {
        tolerance,
        tuning,
        refinement: Refinement { mesh: finer, .. },
        ..
    } = &scene.accuracy;
    let sticks = sticks(scene, hertz);
    let elements = elements(&scene.accuracy, gross, sticks, rates.slider > 0.0);
    let layer_growth = if sticks {
        tuning.sticking_layer_growth
    } else {
        tuning.layer_growth
    };
    let zone_growth = if gross || *tolerance > 0.02 {
        tuning.zone_growth
    } else {
        tuning.scar_zone_growth
    };
    let given = scene.accuracy.contact_element_mm;
    let half_block = 0.5 * scene.receptacle.shape.length_mm;
    let narrower = half_block.min(scene.slider.shape.half_width_mm);
    // The edge of a short stroke's scar lies where the contact ends.
    let at_edge = if gross || sticks {
        f64::INFINITY
    } else {
        last / tuning.scar_elements.at(*tolerance)
    };
    let largest = tuning.largest_element * narrower;
    let element = match given {
        Some(element) => element,
        None => (resolved / elements).min(at_edge).min(largest),
    };
    let element = (element / finer).min(FEWEST_SHARE * narrower);
    let slip = scene
        .accuracy
        .largest_step(hertz)
        .min(amplitude / tuning.steps_per_quarter.at(*tolerance));
    let zone = tuning.scar_margin * last + element;
    // The edges of a flat that grows far beyond the first one are as fine as that: with a core about the first one, a draft wipe of 0.5 mm that is through
    // to the base ends with a pressure that alternates by 0.39 of its peak.
    let core = if given.is_some() || scene.accuracy.narrowest_contact_mm.is_some() {
        zone
    } else {
        tuning.core * resolved
    };
    let spacing = |travel: f64, half: f64| Spacing {
        core: element,
        core_half: (core + travel).min(half),
        zone_growth: zone_growth.at(tolerance.min(COARSEST)) / finer,
        zone_half: zone + travel,
        outer_growth: tuning.outer_growth / finer,
        largest: (tuning.outer_element / finer * half).max(element),
    };
    let arc = |radius: f64, half: f64| radius * (half / radius).min(1.0).asin();
    let half_arc = arc(slider_radius, scene.slider.shape.half_width_mm);
    let half_top = crown.map_or(half_block, |crown| arc(crown, half_block));
    let slider_travel = amplitude * travel_over_slider(slider_radius, crown);
    Sizes {
        hertz_half_width: hertz,
        final_half_width: last,
        sticks,
        slave: constraint_side::choose(scene, rates, gross, element, slip, sliding),
        contact_element: element,
        layer_growth: 1.0 + layer_growth.at(*tolerance) / finer,
        spacing: Sides {
            slider: spacing(slider_travel, half_arc),
            receptacle: spacing(amplitude, half_top),
        },
    }
}

/// Half-width of the leading-edge step that a pass wears by a specific rate, 1/MPa, under a load, N/mm, in mm.
fn edge_step(radius: f64, rate: f64, load: f64) -> f64 {
    (2.0 * radius * rate * load).sqrt()
}

/// Elements across the narrowest half-width of the contact that is resolved.
fn elements(accuracy: &Accuracy, gross: bool, sticks: bool, slider_wears: bool) -> f64 {
    let (tolerance, tuning) = (accuracy.tolerance, &accuracy.tuning);
    let coarsest = tolerance.min(COARSEST);
    let elements = if gross {
        tuning.gross_elements.at(coarsest)
    } else {
        tuning.elements.at(tolerance)
    };
    let finer = match (sticks, gross && slider_wears) {
        (true, _) => tuning.sticking_refinement.at(coarsest),
        (false, true) => tuning.gross_slider_refinement,
        (false, false) => 1.0,
    };
    finer * elements
}
