//! Fourier series: u(t) = sum over i of s_i sin(n_i w t) + c_i cos(n_i w t), w = 2 pi/T.
//!
//! Quasi-static contact does not depend on how fast the slider moves, only on where it turns. A series that turns twice in a
//! period is a reciprocating motion between both turning points, about their middle; one that also turns between them is refused,
//! because blocks of a mission state more clearly what it does.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use api::spec::{FourierTerm, Motion, MotionKind, Provenance};

use super::contact::Demand;
use super::imposed::{AMPLITUDE_MM, ImposedMotion, drive, period};
use crate::number::real;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::system::Preset;

/// Most terms.
pub(in crate::spec) const TERM_LIMIT: usize = 32;
/// Orders of terms.
pub(in crate::spec) const ORDER: RangeInclusive<u64> = 1..=64;
/// Times in a period of the highest order at which the series is evaluated: a turning point between two of them is off by at most
/// 1 - cos(pi/256), 8e-5 of that term.
const TIMES: u64 = 256;
/// Part of the whole range that a motion may turn back without being another turning point: round-off of a flat maximum.
const FLAT: f64 = 1e-9;

pub(super) fn resolve(
    given: &Motion,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> ImposedMotion {
    let fields = ["kind", "terms", "frequency_hz", "period_s", "drive"];
    diagnostics.check_fields("/motion", given, &fields, "fourier");
    let terms = terms(given, diagnostics);
    let drive = drive(given, preset, diagnostics);
    let mut spec = Motion {
        kind: MotionKind::Fourier.into(),
        terms: Some(terms.to_vec()),
        drive: Some(drive.into()),
        ..Motion::default()
    };
    let period_s = period(given, preset.period_s, &mut spec, diagnostics);
    let turns = turning_points(terms);
    let (low, high) = range(&turns);
    if turns.len() > 2 {
        let inner = turns.len() - 2;
        let detail = format!(
            "the motion turns {inner} more times between {low:.3e} and {high:.3e} mm; give each stroke as a block of a `mission`"
        );
        diagnostics.fault("/motion/terms", detail);
    }
    let middle = 0.5 * (low + high);
    let how = if middle.abs() > FLAT * (high - low) {
        format!(
            "the neutral position is at {:.3} um of the series",
            1e3 * middle
        )
    } else {
        "half of the range of the series".to_owned()
    };
    let demand = Demand::beyond(0.5 * (high - low), 0.0, 1.0 / period_s);
    demand.imposed(spec, drive, (None, &how), diagnostics)
}

/// The terms, with faults for those outside their limits.
fn terms<'a>(given: &'a Motion, diagnostics: &mut Diagnostics) -> &'a [FourierTerm] {
    const POINTER: &str = "/motion/terms";
    let terms = given.terms.as_deref().unwrap_or_default();
    if terms.is_empty() {
        diagnostics.missing(POINTER, "`fourier` needs at least one term");
    }
    diagnostics.provenance(POINTER, Provenance::Given);
    diagnostics.check_length(POINTER, terms.len(), TERM_LIMIT);
    let terms = &terms[..terms.len().min(TERM_LIMIT)];
    for (index, term) in terms.iter().enumerate() {
        diagnostics.check_count(&format!("{POINTER}/{index}/order"), term.order, &ORDER);
        let most = *AMPLITUDE_MM.end();
        for (field, value) in [("sine_mm", term.sine_mm), ("cosine_mm", term.cosine_mm)] {
            let value = value.unwrap_or_default();
            diagnostics.check_range(
                &format!("{POINTER}/{index}/{field}"),
                value,
                &(-most..=most),
            );
        }
        if term.sine_mm.or(term.cosine_mm).is_none() {
            let needs = "a term needs `sine_mm` or `cosine_mm`";
            diagnostics.missing(&format!("{POINTER}/{index}"), needs);
        }
    }
    terms
}

/// Displacement at a part of the period, mm.
fn displacement(terms: &[FourierTerm], part: f64) -> f64 {
    terms.iter().fold(0.0, |sum, term| {
        let (sine, cosine) = (TAU * real(term.order) * part).sin_cos();
        sum + term.sine_mm.unwrap_or_default() * sine + term.cosine_mm.unwrap_or_default() * cosine
    })
}

/// Turning points in one period, mm, in their order: none for a motion without amplitude.
fn turning_points(terms: &[FourierTerm]) -> Vec<f64> {
    let highest = terms.iter().map(|term| term.order.min(*ORDER.end())).max();
    let times = TIMES * highest.unwrap_or(1);
    let u: Vec<f64> = (0..times)
        .map(|time| displacement(terms, real(time) / real(times)))
        .collect();
    let (low, high) = range(&u);
    let flat = FLAT * (high - low);
    if flat <= 0.0 {
        return Vec::new();
    }
    // From the highest point on, each point that the motion goes back from by more than round-off.
    let start = u.iter().position(|u| *u >= high).unwrap_or_default();
    let (mut turns, mut turn, mut falling) = (vec![high], high, true);
    for u in u.iter().cycle().skip(start).take(u.len()) {
        let advances = if falling { *u < turn } else { *u > turn };
        if advances {
            turn = *u;
        } else if (*u - turn).abs() > flat {
            turns.push(turn);
            (turn, falling) = (*u, !falling);
        }
    }
    // The first falling stretch begins at the highest point itself.
    turns.dedup();
    turns
}

/// Least and largest of some values.
fn range(values: &[f64]) -> (f64, f64) {
    let low = values.iter().fold(f64::INFINITY, |low, u| low.min(*u));
    let high = values
        .iter()
        .fold(f64::NEG_INFINITY, |high, u| high.max(*u));
    if low > high { (0.0, 0.0) } else { (low, high) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::tests::{accepted, faults};

    fn term(order: u64, sine_mm: f64, cosine_mm: f64) -> FourierTerm {
        FourierTerm {
            order,
            sine_mm: Some(sine_mm),
            cosine_mm: Some(cosine_mm),
        }
    }

    #[test]
    fn a_series_that_turns_twice_is_a_motion_between_its_turning_points() {
        for (terms, (low, high)) in [
            (vec![term(1, 0.02, 0.0)], (-0.02, 0.02)),
            (vec![term(1, 0.03, 0.04)], (-0.05, 0.05)),
            // A triangle's first two terms.
            (vec![term(1, 0.9, 0.0), term(3, -0.1, 0.0)], (-1.0, 1.0)),
            // cos x + 0.2 cos 2x: 1.2 and -0.8.
            (vec![term(1, 0.0, 1.0), term(2, 0.0, 0.2)], (-0.8, 1.2)),
        ] {
            let turns = turning_points(&terms);
            let (found_low, found_high) = range(&turns);
            assert_eq!(turns.len(), 2, "{terms:?}: {turns:?}");
            assert!(
                (found_low - low).abs() < 1e-4 * (high - low),
                "{found_low} {low}"
            );
            assert!(
                (found_high - high).abs() < 1e-4 * (high - low),
                "{found_high} {high}"
            );
        }
        assert!(turning_points(&[term(2, 0.0, 0.0)]).is_empty());
    }

    #[test]
    fn inner_turning_points_are_counted() {
        // sin x + sin 3x turns six times.
        assert_eq!(
            turning_points(&[term(1, 1.0, 0.0), term(3, 1.0, 0.0)]).len(),
            6
        );
        // A second order alone is two periods of one reciprocating motion.
        assert_eq!(turning_points(&[term(2, 1.0, 0.0)]).len(), 4);
    }

    #[test]
    fn one_sine_is_the_reciprocating_motion_of_its_amplitude() {
        let text = |motion: &str| format!(r#"{{"system":{{"kind":"sd_card"}},"motion":{motion}}}"#);
        let series =
            text(r#"{"kind":"fourier","terms":[{"order":1,"sine_mm":0.02}],"period_s":2}"#);
        let sine = text(r#"{"kind":"reciprocating","amplitude_mm":0.02,"period_s":2}"#);
        let (series, sine) = (accepted(&series), accepted(&sine));
        let amplitude = |resolved: &crate::spec::Resolved| resolved.scene.motion.amplitude_mm();
        assert!((amplitude(&series) - amplitude(&sine)).abs() < 1e-9);
        assert_eq!(series.scene.motion.period_s(), sine.scene.motion.period_s());
        let again = serde_json::to_string(&series.spec).expect("JSON");
        assert_eq!(accepted(&again).scene, series.scene);
    }

    #[test]
    fn bad_terms_are_faults_at_their_fields() {
        let text = |terms: &str| {
            format!(
                r#"{{"system":{{"kind":"sd_card"}},"motion":{{"kind":"fourier","terms":{terms}}}}}"#
            )
        };
        let has = |terms: &str, pointer: &str| {
            let found = faults(&text(terms));
            assert!(
                found.iter().any(|fault| fault.pointer == pointer),
                "{pointer}: {found:?}"
            );
        };
        has("[]", "/motion/terms");
        has(r#"[{"order":0,"sine_mm":0.01}]"#, "/motion/terms/0/order");
        has(r#"[{"order":65,"sine_mm":0.01}]"#, "/motion/terms/0/order");
        has(r#"[{"order":1,"sine_mm":1e9}]"#, "/motion/terms/0/sine_mm");
        has(r#"[{"order":1}]"#, "/motion/terms/0");
        has(
            r#"[{"order":1,"sine_mm":0.01},{"order":3,"sine_mm":0.01}]"#,
            "/motion/terms",
        );
    }
}
