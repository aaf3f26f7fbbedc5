//! Comparison of two answers.

use std::fmt;

use solver::record::{ErrorParts, Errors, Summary};
use solver::scene::PRESSURE_TOLERANCES;
use solver::sides::Side;

/// Relative difference of a quantity in two answers, and the largest one that the relation allows.
#[derive(Debug, Clone)]
pub(super) struct Deviation {
    pub(super) quantity: String,
    pub(super) found: f64,
    pub(super) allowed: f64,
}

impl Deviation {
    /// The deviation of one value from another.
    pub(super) fn of(quantity: impl Into<String>, (one, other): (f64, f64), allowed: f64) -> Self {
        let larger = one.abs().max(other.abs());
        Self {
            quantity: quantity.into(),
            found: if larger > 0.0 {
                (one - other).abs() / larger
            } else {
                0.0
            },
            allowed,
        }
    }

    pub(super) fn is_allowed(&self) -> bool {
        self.found <= self.allowed
    }
}

impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            quantity,
            found,
            allowed,
        } = self;
        write!(f, "{quantity} {found:.1e} (allowed {allowed:.1e})")
    }
}

/// Replaces the stored deviations of each quantity by larger ones.
pub(super) fn keep_worst(worst: &mut Vec<Deviation>, deviations: Vec<Deviation>) {
    let share = |deviation: &Deviation| deviation.found / deviation.allowed.max(f64::MIN_POSITIVE);
    for deviation in deviations {
        match worst.iter_mut().find(|w| w.quantity == deviation.quantity) {
            Some(kept) if share(kept) >= share(&deviation) => {}
            Some(kept) => *kept = deviation,
            None => worst.push(deviation),
        }
    }
}

/// Largest deviation of each quantity that a relation allows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    pub(super) depth: f64,
    pub(super) width: f64,
    pub(super) area: f64,
    pub(super) peak: f64,
}

impl Allowed {
    /// Or both answers within the errors that they state themselves, if they do.
    pub(super) fn or_stated(self, answers: [&Summary; 2]) -> Self {
        let sum = |part: fn(&Errors) -> ErrorParts| {
            let stated = answers.map(|answer| answer.errors.as_ref().map(part));
            match stated {
                [Some(one), Some(other)] => one.relative + other.relative,
                _ => 0.0,
            }
        };
        Self {
            depth: self.depth.max(sum(|errors| errors.worn_depth)),
            width: self.width.max(sum(|errors| errors.scar_half_width)),
            area: self.area.max(sum(|errors| errors.worn_area)),
            peak: self.peak.max(sum(|errors| errors.peak_pressure)),
        }
    }

    /// Both answers within their tolerances, pressures within three times these.
    pub(super) fn within(tolerances: f64) -> Self {
        Self {
            depth: tolerances,
            width: tolerances,
            area: tolerances,
            peak: PRESSURE_TOLERANCES * tolerances,
        }
    }
}

/// Deviations of the wear of every wearing side, and of the peak pressure.
pub(super) fn compare(one: &Summary, other: &Summary, allowed: Allowed) -> Vec<Deviation> {
    let mut deviations = vec![Deviation::of(
        "peak pressure",
        (one.last.peak_pressure_mpa, other.last.peak_pressure_mpa),
        allowed.peak,
    )];
    for side in Side::BOTH {
        let [one, other] = [one, other].map(|summary| match side {
            Side::Slider => summary.last.slider,
            Side::Receptacle => summary.last.receptacle,
        });
        let mut add = |quantity: &str, values, allowed| {
            let quantity = format!("{quantity} of the {}", side.name());
            deviations.push(Deviation::of(quantity, values, allowed));
        };
        add(
            "depth",
            (one.max_depth_mm, other.max_depth_mm),
            allowed.depth,
        );
        add(
            "scar width",
            (one.scar_half_width_mm, other.scar_half_width_mm),
            allowed.width,
        );
        add(
            "worn area",
            (one.worn_area_mm2, other.worn_area_mm2),
            allowed.area,
        );
    }
    deviations
}
