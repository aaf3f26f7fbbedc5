//! Contacts along a line, a ring or a straight one: their shape, and what they need of the rest of a specification.

use api::problem::Fault;
use api::spec::{Dimension, Model, RingMotion, Spec, SystemKind, Top};
use solver::closed_form::expected_wear::crown_half_lengths_mm;
use solver::closed_form::unworn_contact::{hertz_half_width, largest_half_width};
use solver::effects::extent::Extent;
use solver::scene::{self, Conduction, LineShape, Scene};
use solver::station::{StationError, StationScene};

use super::length::length;
use super::section_only;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::assumed;
use crate::spec::system::{LENGTH_MM, Shapes};
use crate::spec::unit;
use crate::words::errors;

/// Outer diameter of a fuzz button's ring, mm: its circumference is the source's length of 3.192 mm. The source gives the ring itself no
/// dimensions.
const FUZZ_BUTTON_MM: f64 = 1.016;
/// mrad.
const TILT_MRAD: std::ops::RangeInclusive<f64> = -100.0..=100.0;
/// Fewest and most sections.
const STATIONS: std::ops::RangeInclusive<u64> = 3..=257;
/// Crown of a contact spring, mm.
const TYPICAL_CROWN_MM: f64 = 10.0;
/// Width of a straight line over that of its contact, below which its ends count: sections have none.
const WIDE: f64 = 5.0;
/// Half-length of a crown's contact over its half-width below which sections rate its unworn pressure too low: by 2 % at 2.8, 6 % at 1.8 and
/// 16 % at 1 (`sections_rate_the_pressure_of_a_round_contact_too_low` of the solver's tests).
const LONG: f64 = 3.0;

/// A line without its force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::spec) struct Line {
    shape: LineShape,
    top: scene::Top,
}

/// Fields of a model of a dimension.
pub(super) fn fields(dimension: Dimension) -> &'static [&'static str] {
    const AUTO: [&str; 6] = [
        "dimension",
        "width_mm",
        "crown_radius_mm",
        "tilt_mrad",
        "top",
        "chosen",
    ];
    match dimension {
        Dimension::Ring => &["preset", "dimension", "outer_diameter_mm", "top", "motion"],
        Dimension::Auto => &AUTO,
        _ => &AUTO[..5],
    }
}

/// Resolves the line of a model.
pub(super) fn resolve(
    dimension: Dimension,
    given: &Model,
    shapes: &Shapes,
    kind: SystemKind,
    diagnostics: &mut Diagnostics,
) -> (Model, Line) {
    let named = given.top.as_ref();
    let named = named.and_then(|top| diagnostics.enum_member("/model/top", top));
    let top = diagnostics.or_default("/model/top", named, assumed(Top::Rigid));
    let filled = Model {
        top: Some(top.into()),
        ..Model::default()
    };
    let top = match top {
        Top::Rigid => scene::Top::Rigid,
        Top::Even => scene::Top::Even,
        Top::Pressure => {
            if dimension != Dimension::Ring {
                let detail = format!(
                    "`pressure` bends a wire: a `{}` has a `rigid` or an `even` top",
                    dimension.as_str()
                );
                diagnostics.fault("/model/top", detail);
            }
            scene::Top::Pressure
        }
    };
    let (filled, shape) = if dimension == Dimension::Ring {
        ring(given, filled, shapes, kind, diagnostics)
    } else {
        straight(dimension, given, filled, diagnostics)
    };
    (filled, Line { shape, top })
}

fn ring(
    given: &Model,
    filled: Model,
    shapes: &Shapes,
    kind: SystemKind,
    diagnostics: &mut Diagnostics,
) -> (Model, LineShape) {
    const POINTER: &str = "/model/outer_diameter_mm";
    let radius = shapes.slider.radius_mm;
    let is_known = kind == SystemKind::FuzzButton || given.outer_diameter_mm.is_some();
    let diameter = if is_known {
        let default = assumed(FUZZ_BUTTON_MM);
        length(POINTER, given.outer_diameter_mm, default, diagnostics)
    } else {
        diagnostics.missing(POINTER, "`ring` needs it");
        FUZZ_BUTTON_MM
    };
    let radius_mm = 0.5 * diameter - radius;
    if is_known && radius_mm <= radius {
        let detail = format!(
            "{diameter} is the outer diameter of a ring of wire whose section has a radius of {radius} mm: it must exceed four times that"
        );
        diagnostics.fault(POINTER, detail);
    }
    let named = given.motion.as_ref();
    let named = named.and_then(|motion| diagnostics.enum_member("/model/motion", motion));
    let motion = diagnostics.or_default("/model/motion", named, assumed(RingMotion::InPlane));
    let filled = Model {
        outer_diameter_mm: Some(diameter),
        motion: Some(motion.into()),
        ..filled
    };
    let motion = match motion {
        RingMotion::InPlane => scene::RingMotion::InPlane,
        RingMotion::Torsion => scene::RingMotion::Torsion,
    };
    (filled, LineShape::Ring { radius_mm, motion })
}

fn straight(
    dimension: Dimension,
    given: &Model,
    filled: Model,
    diagnostics: &mut Diagnostics,
) -> (Model, LineShape) {
    let mut width_mm = 1.0;
    match given.width_mm {
        None if dimension == Dimension::Auto => diagnostics.missing(
            "/model/width_mm",
            "`auto` needs it, or `radius_z_mm` of a slider that is round across the sliding direction",
        ),
        None => diagnostics.missing(
            "/model/width_mm",
            &format!("`{}` needs it", dimension.as_str()),
        ),
        Some(_) => {
            width_mm = length("/model/width_mm", given.width_mm, assumed(1.0), diagnostics);
        }
    }
    let crown = given.crown_radius_mm.map(|crown| {
        const POINTER: &str = "/model/crown_radius_mm";
        diagnostics.check_unit(POINTER, Some(crown), &unit::length_mm(TYPICAL_CROWN_MM));
        diagnostics.provenance(POINTER, api::spec::Provenance::Given);
        diagnostics.check_range(POINTER, crown, &LENGTH_MM)
    });
    let tilt = diagnostics.or_default("/model/tilt_mrad", given.tilt_mrad, assumed(0.0));
    let tilt_mrad = diagnostics.check_range("/model/tilt_mrad", tilt, &TILT_MRAD);
    let filled = Model {
        width_mm: Some(width_mm),
        crown_radius_mm: crown,
        tilt_mrad: Some(tilt_mrad),
        ..filled
    };
    let shape = LineShape::Straight {
        width_mm,
        crown_radius_mm: crown,
        tilt_mrad,
    };
    (filled, shape)
}

/// Refuses a number of sections in a dimension that has none along a line.
pub(super) fn check_overrides_of_others(filled: &Spec, diagnostics: &mut Diagnostics) {
    let overrides = filled.accuracy.overrides.as_ref();
    if overrides.is_some_and(|overrides| overrides.stations.is_some()) {
        diagnostics.fault(
            "/accuracy/overrides/stations",
            "a `line` or a `ring` has sections along it, no other dimension",
        );
    }
}

impl Line {
    /// Extent across the motion.
    pub(super) fn extent(&self) -> Extent {
        let width_mm = self.shape.length_mm();
        match self.shape {
            LineShape::Ring { .. } => Extent {
                width_mm,
                crown_radius_mm: None,
                tilt_mrad: 0.0,
            },
            LineShape::Straight {
                crown_radius_mm,
                tilt_mrad,
                ..
            } => Extent {
                width_mm,
                crown_radius_mm,
                tilt_mrad,
            },
        }
    }

    /// A section under the load of a mm. A force, and its spring, are those of the whole line; other loads act on each mm of it.
    pub(super) fn section(&self, mut scene: Scene, is_force: bool) -> Scene {
        let length = self.shape.length_mm();
        if is_force {
            scene.load_n_per_mm /= length;
            scene.spring_n_per_mm2 /= length;
        }
        if let Conduction::Known(electrical) = &mut scene.conduction {
            electrical.width_mm = length;
        }
        scene
    }

    /// Name of its dimension.
    pub(super) fn name(&self) -> &'static str {
        match self.shape {
            LineShape::Ring { .. } => "ring",
            LineShape::Straight { .. } => "line",
        }
    }

    /// Makes a scene with its section one along the line.
    pub(super) fn with_dimension(
        &self,
        section: Scene,
        is_force: bool,
        spec: &Spec,
        diagnostics: &mut Diagnostics,
    ) -> Scene {
        let mut scene = self.section(section, is_force);
        scene.dimension = scene::Dimension::Line(scene::Line {
            shape: self.shape,
            top: self.top,
            force_n: scene.load_n_per_mm * self.shape.length_mm(),
            stations: stations(spec, diagnostics),
        });
        if diagnostics.is_clean() {
            Self::check(&scene, spec, diagnostics);
        }
        scene
    }

    /// Checks what sections along a line cannot simulate.
    fn check(scene: &Scene, spec: &Spec, diagnostics: &mut Diagnostics) {
        let Some(line) = StationScene::of(scene) else {
            return;
        };
        let Err(error) = line.check_all() else {
            return;
        };
        let pointer = match &error {
            StationError::Sections(error) => section_only::pointer(error, spec),
            StationError::Amplitude { .. } => section_only::movement(spec),
            // Others are ranges of fields of their own.
            StationError::BeyondAxis { .. } => "/model/outer_diameter_mm",
            StationError::Spacing { .. } => "/accuracy/overrides/stations",
            StationError::Drive if spec.mission.is_empty() => "/motion/drive",
            StationError::Drive => "/mission",
            _ => "/model",
        };
        diagnostics.fault(pointer, errors::of_line(&error));
    }
}

/// The number of sections that is given.
fn stations(spec: &Spec, diagnostics: &mut Diagnostics) -> Option<usize> {
    const POINTER: &str = "/accuracy/overrides/stations";
    let overrides = spec.accuracy.overrides.as_ref()?;
    let count = overrides.stations?;
    diagnostics.provenance(POINTER, api::spec::Provenance::Given);
    let count = diagnostics.check_count(POINTER, count, &STATIONS);
    usize::try_from(count).ok()
}

/// Warnings of a straight line whose ends count, and of a crown whose contact is about round.
pub(super) fn warnings(scene: &Scene) -> Vec<Fault> {
    short(scene).into_iter().chain(round(scene)).collect()
}

/// A warning of a crown whose contact is about as long as wide.
fn round(scene: &Scene) -> Option<Fault> {
    let (half_length, _) = crown_half_lengths_mm(scene)?;
    let half_width = largest_half_width(scene);
    (half_length < LONG * half_width).then(|| {
        let detail = format!(
            "the contact of the crown, {half_length:.2e} mm to either side across the sliding direction and {half_width:.2e} mm along it, is less than \
             {LONG} times as long as wide: sections rate its unworn pressure 2 % and more too low; a `point` does not"
        );
        Fault::new("/model/crown_radius_mm", detail)
    })
}

/// A warning of a line that is short against its contact.
fn short(scene: &Scene) -> Option<Fault> {
    let LineShape::Straight { width_mm, .. } = scene.dimension.line()?.shape else {
        return None;
    };
    let contact = 2.0 * hertz_half_width(scene);
    (width_mm < WIDE * contact).then(|| {
        let detail = format!(
            "sections along a line have no ends, and {width_mm} mm are less than {WIDE} times the unworn contact of {contact:.2e} mm along the \
             sliding direction: such a contact is a `point`"
        );
        Fault::new("/model/width_mm", detail)
    })
}
