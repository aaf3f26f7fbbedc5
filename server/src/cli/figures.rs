//! Numbers and criteria as tables show them.

use api::spec::{Criterion, EnumValue};

/// A number with four digits or more, at any scale.
pub(super) fn number(value: f64) -> String {
    if value.fract() == 0.0 {
        format!("{value:.0}")
    } else if value.abs() >= 100.0 {
        format!("{value:.1}")
    } else if value.abs() >= 0.1 {
        format!("{value:.4}")
    } else {
        format!("{value:.3e}")
    }
}

/// A number with four digits, or all of those before its point.
pub(super) fn rounded(value: f64) -> String {
    const LEAST: [f64; 7] = [1_000.0, 100.0, 10.0, 1.0, 0.1, 0.01, 0.001];
    match LEAST.iter().position(|least| value.abs() >= *least) {
        _ if value.fract() == 0.0 => format!("{value:.0}"),
        Some(decimals) => format!("{value:.decimals$}"),
        None => format!("{value:.3e}"),
    }
}

pub(super) fn percent(share: f64) -> String {
    number(100.0 * share)
}

/// A criterion with its layer, part, depth or resistance.
pub(super) fn until(criterion: &Criterion) -> String {
    let kind = match &criterion.kind {
        EnumValue::Known(kind) => kind.as_str(),
        EnumValue::Unknown(text) => text,
    };
    let layer = criterion.layer.map(|layer| format!(", layer {layer}"));
    let fraction = criterion.fraction.map(|part| format!(", {part}"));
    let depth = criterion.mm.map(|mm| format!(", {mm} mm"));
    let limit = criterion.mohm.map(|mohm| format!(", {mohm} mOhm"));
    let details = [layer, fraction, depth, limit].into_iter().flatten();
    details.fold(kind.to_owned(), |text, detail| text + &detail)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_numbers_have_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (400.0, "400"),
            (92_141.3, "92141"),
            (271.23, "271.2"),
            (46.194, "46.19"),
            (-1.2345, "-1.234"),
            (0.123_46, "0.1235"),
            (0.026, "0.02600"),
            (2.6e-5, "2.600e-5"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(rounded(value), text);
        }
    }
}
