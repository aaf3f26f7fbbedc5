//! Characteristic lengths of the contact, and the mesh spacing that follows from them.
//!
//! * Hertz half-width a = sqrt(4 P R / (pi E*)) with 1/R = 1/R_slider + 1/R_crown (Johnson 1985, eq. 4.43);
//! * leading-edge step of one pass, where a rigid round slider wears the floor in gross sliding: the section k P equals
//!   b^2 / (2 R), so b = sqrt(2 R k P);
//! * scar of a short stroke: the circular segment that was worn off, b = (3 R W / 2)^(1/3) with the worn area
//!   W = (k_s + k_r) P s (parabola of height b^2/(2R) over 2 b);
//! * flat of a slider in a long stroke: the circular segment that it has lost, by the same formula with W = k_s P s;
//! * ends of the groove of a long stroke 2 A, W/(2 A) deep: the slider's arc reaches b = sqrt(R W / A) up them.

use super::line_contact;
use super::worn_cap::WornCap;
use super::{constraint_side, worn_depth};
use crate::effects::Effect;
use crate::law::elastic::contact_modulus;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::mesh::grading::Spacing;
use crate::number::real_cycles;
use crate::point::{PointScene, SlipRegime};
use crate::scene::{Accuracy, Drive, Elastic, LineShape, Motion, Refinement, Scene, SliderShape};
use crate::sides::{Side, Sides};
use std::f64::consts::PI;

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
    /// Whether part of the contact may stick through the whole stroke.
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

/// Approach of the bodies under the load, mm:  P / (pi E*) (2 ln(4 H/a) - 1)  with the lower body height H (Johnson
/// 1985, section 5.6, for a strip under a line load).
pub(crate) fn approach(scene: &Scene, half_width: f64, modulus: f64) -> f64 {
    let height = scene
        .slider
        .shape
        .height_mm
        .min(scene.receptacle.shape.height_mm);
    scene.load_n_per_mm / (PI * modulus) * strip(height, half_width)
}

/// 2 ln(4 H/a) - 1, or 0 where the strip is no higher than the contact is wide.
fn strip(height: f64, half_width: f64) -> f64 {
    (2.0 * (4.0 * height / half_width).ln() - 1.0).max(0.0)
}

/// Imposed displacement at which all of the contact slips, mm: the largest mu P of the run times the compliance of both bodies
/// to a tangential force on their surfaces. Near the contact it is the normal one, of a strip; a body of height H and half-width w
/// besides shears and bends like a beam that is held at its far face (Timoshenko), with G = E/(2 (1 + nu)) and E' =
/// E/(1 - nu^2):
///   E' delta / Q = (2 ln(4 min(H, w)/a) - 1) / pi + H^3 / (2 w^3) + 1.2 H / (w (1 - nu)).
/// A slider whose nodes are all displaced does not deform along x.
pub(crate) fn gross_slip(scene: &Scene, half_width: f64) -> f64 {
    let compliance = |elastic: Elastic, height: f64, half: f64| {
        let Elastic {
            youngs_modulus_mpa,
            poisson_ratio,
        } = elastic;
        let slender = height / half;
        let beam = 0.5 * slender.powi(3) + 1.2 * slender / (1.0 - poisson_ratio);
        (1.0 - poisson_ratio * poisson_ratio) / youngs_modulus_mpa
            * (strip(height.min(half), half_width) / PI + beam)
    };
    let (slider, block) = (&scene.slider, &scene.receptacle);
    let upper = match scene.drive {
        Drive::Handle => {
            let SliderShape {
                half_width_mm,
                height_mm,
                ..
            } = slider.shape;
            compliance(slider.elastic, height_mm, half_width_mm)
        }
        Drive::WholeBody => 0.0,
    };
    let half_block = 0.5 * block.shape.length_mm;
    let lower = compliance(block.elastic, block.shape.height_mm, half_block);
    scene.largest_friction() * scene.load_n_per_mm * (upper + lower)
}

/// Whether part of the contact may stick through the whole stroke: the amplitude is below twice the displacement of
/// gross slip.
pub(crate) fn sticks(scene: &Scene, half_width: f64) -> bool {
    let amplitude_mm = match scene.motion {
        Motion::Reciprocating { amplitude_mm, .. } => amplitude_mm,
        Motion::Periodic { turns, .. } => 0.5 * turns.shortest_mm(),
        Motion::Continuous { .. } => return false,
    };
    let is_off = |effect| scene.effects.of(effect) == Some(false);
    if is_off(Effect::Friction) || is_off(Effect::StickMemory) {
        return false;
    }
    amplitude_mm < 2.0 * gross_slip(scene, half_width)
}

/// Radius R of the relative curvature of both bodies, mm.
pub(crate) fn radius(scene: &Scene) -> f64 {
    let crown = scene.receptacle.shape.crown_radius_mm;
    1.0 / (1.0 / scene.slider.shape.radius_mm + crown.map_or(0.0, |crown| 1.0 / crown))
}

/// Travel of the contact over the slider per displacement of the slider, R / (R + R_crown): the gap of two parabolas a
/// displacement d apart, (x - d)^2 / (2 R) + x^2 / (2 R_crown), is least at x = d R_crown / (R + R_crown). On a flat
/// receptacle the contact moves with the slider; wear flattens a crown, so that the receptacle is meshed for all of d.
fn travel_over_slider(slider: f64, crown: Option<f64>) -> f64 {
    crown.map_or(0.0, |crown| slider / (slider + crown))
}

/// Specific wear rates in a contact of a half-width, 1/MPa; of laws whose rate depends on the depth the mean rate down to the estimated depth at the
/// end.
pub(crate) fn wear_rates(scene: &Scene, half_width: f64) -> Sides<f64> {
    let wear = scene.surface_wear();
    let at = LocalState::mean(scene.load_n_per_mm, half_width, scene.timed_motion().mean());
    let by_depth = |wear: Option<SurfaceWear>| wear.is_some_and(SurfaceWear::depends_on_depth);
    let depth = if by_depth(wear.slider) || by_depth(wear.receptacle) {
        let cycles = expected_cycles(scene, half_width);
        worn_depth_after(scene, (half_width, &wear), cycles)
    } else {
        Sides::default()
    };
    wear.zip(depth)
        .map(|(wear, depth)| wear.map_or(0.0, |wear| wear.mean_rate(depth, at)))
}

/// Estimated cycles until the end of a run: all of them, or fewer where it stops at a criterion.
pub fn expected_end(scene: &Scene) -> u64 {
    expected_cycles(scene, choose(scene).hertz_half_width)
}

/// The same for a Hertz half-width, mm.
pub(crate) fn expected_cycles(scene: &Scene, half_width: f64) -> u64 {
    let of_cap = WornCap::of_scene(scene).map(|cap| cap.expected_cycles());
    if let (Some(cycles), Some(_)) = (of_cap, scene.dimension.point()) {
        return cycles;
    }
    let at = LocalState::mean(scene.load_n_per_mm, half_width, scene.timed_motion().mean());
    let of_section = worn_depth::expected_cycles(scene, (radius(scene), at), &scene.surface_wear());
    of_cap.map_or(of_section, |cycles| cycles.min(of_section))
}

/// Estimated largest worn depths after so many cycles, mm, in a contact of a half-width with this wear of both surfaces.
pub(crate) fn worn_depth_after(
    scene: &Scene,
    (half_width, wear): (f64, &Sides<Option<SurfaceWear>>),
    cycles: u64,
) -> Sides<f64> {
    let of_cap = WornCap::of_scene(scene).map(|cap| cap.depth_after(cycles));
    if let (Some(depth), Some(_)) = (of_cap, scene.dimension.point()) {
        return depth;
    }
    let at = LocalState::mean(scene.load_n_per_mm, half_width, scene.timed_motion().mean());
    let of_section = worn_depth::after(scene, (radius(scene), at), wear, cycles);
    // A cap is deeper until it reaches the ends of the width.
    of_cap.map_or(of_section, |depth| {
        depth
            .zip(of_section)
            .map(|(of_cap, of_section)| of_cap.max(of_section))
    })
}

/// Half-width of the unworn contact, mm: Hertz' of a section, the half-length along the sliding direction of a point contact.
pub fn hertz_half_width(scene: &Scene) -> f64 {
    if let Some(contact) = PointScene::of(scene, SlipRegime::Gross) {
        return contact.half_lengths_mm().0;
    }
    let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
    (4.0 * scene.load_n_per_mm * radius(scene) / (PI * modulus)).sqrt()
}

/// Estimated half-length of a contact along the sliding direction at the end of its run, mm: the arc that has worn off, or Hertz'.
pub fn worn_contact_half_length_mm(scene: &Scene) -> f64 {
    let hertz = hertz_half_width(scene);
    let cycles = expected_cycles(scene, hertz);
    let depth = worn_depth_after(scene, (hertz, &scene.surface_wear()), cycles);
    let arc = 2.0 * radius(scene) * depth.slider.max(depth.receptacle);
    arc.sqrt().max(hertz)
}

/// Half-lengths of the contact of a crowned line, unworn and at the estimated end, mm: the arc that has worn off; `None` of another contact.
pub fn crown_half_lengths_mm(scene: &Scene) -> Option<(f64, f64)> {
    let line = scene.dimension.line()?;
    let LineShape::Straight {
        crown_radius_mm: Some(radius),
        ..
    } = line.shape
    else {
        return None;
    };
    let unworn = line_contact::touch_of(scene, line).length_mm;
    let hertz = hertz_half_width(scene);
    let cycles = expected_cycles(scene, hertz);
    let depth = worn_depth_after(scene, (hertz, &scene.surface_wear()), cycles);
    let arc = 2.0 * radius * (depth.slider + depth.receptacle);
    Some((unworn, (unworn * unworn + arc).sqrt()))
}

/// Hertz' half-width of the most loaded section along a line, mm.
pub fn largest_half_width(scene: &Scene) -> f64 {
    hertz_half_width(scene) * root_of_largest_load(scene)
}

/// Half-width and pressure of the most loaded section over those under the mean load: both go with the root of the load.
fn root_of_largest_load(scene: &Scene) -> f64 {
    (line_contact::largest_line_load(scene) / scene.load_n_per_mm).sqrt()
}

/// Hertz' peak pressure of the unworn contact, MPa: 2 P/(pi a) of a section, and of the most loaded one along a line; 3 F/(2 pi a b) of a
/// point contact.
pub fn hertz_peak_pressure(scene: &Scene) -> f64 {
    if let Some(contact) = PointScene::of(scene, SlipRegime::Gross) {
        let (along, across) = contact.half_lengths_mm();
        return 1.5 * contact.force_n / (PI * along * across);
    }
    let mean = 2.0 * scene.load_n_per_mm / (PI * hertz_half_width(scene));
    mean * root_of_largest_load(scene)
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

/// Whether anything moves in a scene.
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
    let edge_step = (2.0 * radius * wear * load).sqrt();
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
        None => (narrowest / elements).min(at_edge).min(largest),
    };
    let element = (element / finer).min(FEWEST_SHARE * narrower);
    let slip = scene
        .accuracy
        .largest_step(hertz)
        .min(amplitude / tuning.steps_per_quarter.at(*tolerance));
    let zone = tuning.scar_margin * last + element;
    let core = if given.is_some() {
        zone
    } else {
        tuning.core * narrowest
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
        slave: constraint_side::choose(scene, rates, gross, (element, slip, sliding)),
        contact_element: element,
        layer_growth: 1.0 + layer_growth.at(*tolerance) / finer,
        spacing: Sides {
            slider: spacing(slider_travel, half_arc),
            receptacle: spacing(amplitude, half_top),
        },
    }
}

/// Elements across the narrowest half-width of the contact.
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
