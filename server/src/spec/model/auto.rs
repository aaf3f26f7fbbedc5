//! The dimension that a contact requires: plane strain where its sections wear alike, a point where the contact of a crown stays within the
//! width, else a line of sections (`solver::effects::extent`).

use api::spec::{Dimension, Spec};
use solver::effects::extent::{self, Choice, Extent};
use solver::scene::Scene;

use super::line::Line;
use super::{point, section_only};
use crate::spec::diagnostics::Diagnostics;
use crate::words;

/// A scene of the dimension that was chosen.
pub(super) struct Chosen {
    pub(super) scene: Scene,
    pub(super) dimension: Dimension,
    pub(super) reason: String,
}

/// Chooses the dimension of a contact of a width, from its section under the load of the specification.
pub(super) fn choose(
    section: Scene,
    line: Line,
    is_force: bool,
    spec: &Spec,
    diagnostics: &mut Diagnostics,
) -> Chosen {
    let Extent {
        width_mm,
        crown_radius_mm,
        ..
    } = line.extent();
    let plane = line.section(section.clone(), is_force);
    let force_n = plane.load_n_per_mm * width_mm;
    let whole = Scene {
        spring_n_per_mm2: plane.spring_n_per_mm2 * width_mm,
        ..section.clone()
    };
    let as_point = crown_radius_mm.map(|crown| {
        let mut of_candidate = Diagnostics::default();
        point::with_dimension(whole.clone(), Some(crown), force_n, spec, &mut of_candidate)
    });
    let choice = extent::choose(&plane, as_point.as_ref(), line.extent());
    let reason = words::extent::reason(choice);
    let (dimension, reason) = match choice {
        Choice::Straight | Choice::Recedes { .. } => (Dimension::PlaneStrain, reason),
        Choice::Tilt { .. } | Choice::TiltedCrown | Choice::CrownToEnds { .. } => {
            (Dimension::Line, reason)
        }
        Choice::Crown { .. } if section.output.fields => {
            let detail = "a line of sections is simulated for the fields inside the bodies, which a point does not have";
            (Dimension::Line, format!("{reason}; {detail}"))
        }
        Choice::Crown { .. } => (Dimension::Point, reason),
    };
    if let Some(reason) = lacks(&plane, dimension, spec) {
        return Chosen {
            scene: plane,
            dimension: Dimension::PlaneStrain,
            reason,
        };
    }
    let scene = match (dimension, crown_radius_mm) {
        (Dimension::Line, _) => line.with_dimension(section, is_force, spec, diagnostics),
        (Dimension::Point, Some(crown)) => {
            point::with_dimension(whole, Some(crown), force_n, spec, diagnostics)
        }
        _ => plane,
    };
    Chosen {
        scene,
        dimension,
        reason,
    }
}

/// Why the contact cannot be simulated in a dimension but plane strain.
fn lacks(plane: &Scene, dimension: Dimension, spec: &Spec) -> Option<String> {
    if dimension == Dimension::PlaneStrain {
        return None;
    }
    let mut of_candidate = Diagnostics::default();
    let (name, mission) = (dimension.as_str(), plane.mission.as_ref());
    section_only::check(spec, name, plane.motion, mission, &mut of_candidate);
    section_only::check_laws(plane, "contact of finite width", &mut of_candidate);
    let fault = of_candidate.into_faults().into_iter().next()?;
    Some(format!("{}: {}", fault.pointer, fault.detail))
}
