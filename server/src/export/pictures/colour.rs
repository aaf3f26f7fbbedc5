//! Colours.

/// A colour: red, green, blue.
pub type Colour = [u8; 3];

/// Qualitative palette that colour-blind readers can distinguish (M. Okabe and K. Ito, *Color Universal Design*).
pub const COLOURS: [Colour; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [230, 159, 0],
    [90, 90, 90],
];

/// Sequential colour map from light to dark: colour `index` of `count`.
pub fn ramp(index: usize, count: usize) -> Colour {
    const STOPS: [Colour; 5] = [
        [253, 179, 66],
        [233, 97, 84],
        [176, 42, 121],
        [92, 22, 132],
        [13, 8, 80],
    ];
    let last = count.saturating_sub(1).max(1);
    let scaled = index * (STOPS.len() - 1);
    let (stop, rest) = (scaled / last, scaled % last);
    let next = (stop + 1).min(STOPS.len() - 1);
    std::array::from_fn(|channel| {
        let (from, to) = (
            usize::from(STOPS[stop][channel]),
            usize::from(STOPS[next][channel]),
        );
        u8::try_from((from * (last - rest) + to * rest) / last).unwrap_or(u8::MAX)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_runs_from_light_to_dark() {
        let lightness = |colour: Colour| colour.map(u32::from).iter().sum::<u32>();
        let ramp: Vec<_> = (0..9).map(|index| lightness(ramp(index, 9))).collect();
        assert!(ramp.is_sorted_by(|a, b| a > b), "{ramp:?}");
    }

    #[test]
    fn a_single_curve_has_a_colour() {
        assert_eq!(ramp(0, 1), [253, 179, 66]);
    }
}
