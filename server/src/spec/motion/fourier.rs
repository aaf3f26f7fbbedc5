//! Fourier series: u(t) = sum over i of s_i sin(n_i w t) + c_i cos(n_i w t), w = 2 pi/T.
//!
//! Quasi-static contact does not depend on how fast the slider moves, only on where it turns. A series that turns twice in a
//! period is a reciprocating motion between both turning points, about their middle; one that also turns between them is a periodic
//! motion with these turning points, in the course of time of the series.

use std::ops::RangeInclusive;
use std::sync::Arc;

use api::spec::{FourierTerm, Motion, MotionKind, Provenance};
use solver::scene::{self, HIGHEST_ORDER, MOST_TURNS, Series, Term};

use super::contact::{Demand, Limits};
use super::imposed::{AMPLITUDE_MM, ImposedMotion, drive, period};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::system::Preset;

/// Most terms.
pub(in crate::spec) const TERM_LIMIT: usize = 32;
/// Orders of terms.
pub(in crate::spec) const ORDER: RangeInclusive<u64> = 1..=HIGHEST_ORDER;
/// Part of the whole range that its middle may be off without being named: round-off.
const CENTRED: f64 = 1e-9;

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
    let series = series(terms);
    let (low, high) = series.range_mm();
    let middle = 0.5 * (low + high);
    let mut how = if middle.abs() > CENTRED * (high - low) {
        format!(
            "the neutral position is at {:.3} um of the series",
            1e3 * middle
        )
    } else {
        "half of the range of the series".to_owned()
    };
    let inner = series.count().saturating_sub(2);
    if inner > 0 {
        how = format!("{how}, which turns {inner} more times inside it");
    }
    let demand = Demand::beyond(0.5 * (high - low), Limits::NONE, 1.0 / period_s);
    let outer = demand.imposed(spec, drive, &how, diagnostics);
    if inner == 0 {
        return outer;
    }
    let Some(turns) = series.turning_points() else {
        let detail = format!(
            "the motion turns {} times in a period, at most {MOST_TURNS} are allowed; give its strokes as blocks of a `mission`",
            series.count()
        );
        diagnostics.fault("/motion/terms", detail);
        return outer;
    };
    ImposedMotion {
        scene: scene::Motion::Periodic { turns, period_s },
        timing: scene::Timing::Series(Arc::new(series)),
        ..outer
    }
}

fn series(terms: &[FourierTerm]) -> Series {
    let term = |term: &FourierTerm| Term {
        order: term.order,
        sine_mm: term.sine_mm.unwrap_or_default(),
        cosine_mm: term.cosine_mm.unwrap_or_default(),
    };
    Series::new(terms.iter().map(term).collect())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::tests::{accepted, faults};

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
    fn a_series_that_turns_inside_is_a_periodic_motion_in_its_own_time() {
        let text = r#"{"system":{"kind":"sd_card"},"motion":{"kind":"fourier","period_s":2,
            "terms":[{"order":1,"sine_mm":0.01},{"order":3,"sine_mm":0.01}]}}"#;
        let resolved = accepted(text);
        let scene::Motion::Periodic { turns, period_s } = resolved.scene.motion else {
            panic!("a periodic motion");
        };
        assert_eq!((turns.as_slice().len(), period_s), (6, 2.0));
        // (8/27)^0.5 of the sum of the amplitudes.
        let amplitude = 0.02 * (16.0_f64 / 27.0).sqrt();
        assert!((resolved.scene.motion.amplitude_mm() - amplitude).abs() < 1e-6);
        // The fastest moment is the passage of the neutral position, 4 w s.
        let fastest = 4.0 * 0.01 * std::f64::consts::PI;
        assert!((resolved.scene.fastest_speed_mm_s() - fastest).abs() < 1e-12);
        let again = serde_json::to_string(&resolved.spec).expect("JSON");
        assert_eq!(accepted(&again).scene, resolved.scene);
        let derived = resolved.motion.expect("it is derived").reason;
        assert!(derived.contains("turns 4 more times"), "{derived}");
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
            r#"[{"order":1,"sine_mm":0.01},{"order":32,"sine_mm":0.01}]"#,
            "/motion/terms",
        );
    }
}
