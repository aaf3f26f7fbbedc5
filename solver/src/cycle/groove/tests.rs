//! Grooves with and without platings, in jumps of several lengths.

use super::*;
use crate::law::plating::{Layer, Layers};
use crate::number::real;

const NODES: usize = 401;
/// Depth of a cycle in a flat floor, mm.
const FLOOR: f64 = 1e-5;

/// Nodes from -2 to 2 mm, half of the width of the middle ones at the ends.
fn surface() -> (Vec<f64>, Vec<f64>) {
    let x: Vec<f64> = (0..NODES).map(|i| real(i) / 100.0 - 2.0).collect();
    let mut widths = vec![0.01; NODES];
    (widths[0], widths[NODES - 1]) = (0.005, 0.005);
    (x, widths)
}

/// A slider of 1 mm that moves by 1 mm to both sides.
fn groove<'a>(x: &'a [f64], widths: &'a [f64]) -> Groove<'a> {
    Groove {
        x,
        widths,
        profile: Profile::Flat,
        radius: 1.0,
        amplitude: 1.0,
        half_width: 0.02,
        spread: Spread::Distance,
        curve: None,
        floor: FLOOR,
    }
}

/// Wear of one cycle by the surrogate's own rate.
fn rate(groove: &Groove<'_>, depth: &[f64]) -> Vec<f64> {
    let between = |i: usize| {
        let x = (groove.x[i], groove.x[i + 1]);
        let slope = (depth[i + 1] - depth[i]) / (x.1 - x.0);
        groove.displacement(0.5 * (x.0 + x.1), slope).0
    };
    let at = |i: usize| {
        let left = if i > 0 { between(i - 1) } else { -1.0 };
        let right = if i + 1 < depth.len() { between(i) } else { 1.0 };
        FLOOR * (right - left) / groove.widths[i]
    };
    (0..depth.len()).map(at).collect()
}

fn area(values: &[f64], widths: &[f64]) -> f64 {
    values.iter().zip(widths).map(|(d, width)| d * width).sum()
}

/// Depth after 4 096 cycles in jumps of a length.
fn worn(jump: usize) -> Vec<f64> {
    let (x, widths) = surface();
    let groove = groove(&x, &widths);
    let mut depth = vec![0.0; NODES];
    for _ in 0..4_096 / jump {
        let single = rate(&groove, &depth);
        let wear = groove.wear(&depth, &single, real(jump)).expect("converges");
        for (depth, wear) in depth.iter_mut().zip(wear) {
            *depth += wear;
        }
    }
    depth
}

#[test]
fn jumps_converge_with_the_first_order_and_keep_the_worn_area() {
    let (_, widths) = surface();
    let [fine, middle, coarse] = [16, 128, 256].map(worn);
    let deepest = fine[NODES / 2];
    let apart = |other: &[f64]| {
        let apart = other.iter().zip(&fine).map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max) / deepest
    };
    let ratio = apart(&coarse) / apart(&middle);
    assert!(apart(&coarse) < 0.02, "{}", apart(&coarse));
    assert!((1.6..2.8).contains(&ratio), "{ratio}");
    let ideal = 4_096.0 * FLOOR * 2.0;
    for depth in [&fine, &coarse] {
        assert!((area(depth, &widths) / ideal - 1.0).abs() < 1e-12);
    }
    // Mirrored.
    let mirrored = coarse.iter().rev().zip(&coarse);
    assert!(mirrored.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-9 * deepest);
}

#[test]
fn waves_of_the_computed_cycle_fade_and_its_area_stays() {
    let (x, widths) = surface();
    let groove = groove(&x, &widths);
    let depth = vec![0.0; NODES];
    // Every other node of the floor wears twice as much as on average, or not at all.
    let wave = |(i, x): (usize, &f64)| {
        let inside = f64::from(u8::from(x.abs() < 0.995));
        FLOOR * inside * 2.0 * f64::from(u8::from(i % 2 == 0))
    };
    let single: Vec<f64> = x.iter().enumerate().map(wave).collect();
    let cycles = 1_000.0;
    let wear = groove.wear(&depth, &single, cycles).expect("converges");
    let middle = &wear[NODES / 2 - 10..NODES / 2 + 10];
    let jumps = middle.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    // With the diffusivity h R it fades to 1/(1 + 4 n h R/dx^2) = 1/401 of 2 n h.
    let largest = jumps.fold(0.0, f64::max) / (2.0 * cycles * FLOOR);
    assert!(largest < 1.1 / 401.0, "{largest}");
    let ratio = area(&wear, &widths) / (cycles * area(&single, &widths));
    assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
}

/// Depth of 4 096 cycles through a layer of half that equivalent over a base of a rate, in jumps of a share of the cycles done,
/// and the worn area over that of the dose.
fn worn_through(base: f64, share: f64) -> (Vec<f64>, f64) {
    let layer = Layer {
        thickness_mm: 2_048.0 * FLOOR,
        rate_per_mpa: 1e-8,
    };
    let curve = DoseCurve::Layers(Layers::new(&[layer], base));
    let (x, widths) = surface();
    let groove = Groove {
        curve: Some(&curve),
        ..groove(&x, &widths)
    };
    let (mut depth, mut done) = (vec![0.0; NODES], 0.0);
    while done < 4_096.0 {
        let jump = (share * done).ceil().clamp(1.0, 4_096.0 - done);
        let mut single = rate(&groove, &depth);
        for (single, depth) in single.iter_mut().zip(&depth) {
            *single *= f64::from(u8::from(*depth < curve.deepest()));
        }
        let wear = groove.wear(&depth, &single, jump);
        let wear = wear.unwrap_or_else(|| panic!("{base}, {share}: not after {done} cycles"));
        for (depth, wear) in depth.iter_mut().zip(wear) {
            *depth += wear;
        }
        done += jump;
    }
    let equivalent: Vec<f64> = depth.iter().map(|d| curve.equivalent(*d)).collect();
    let ideal = 4_096.0 * FLOOR * 2.0;
    (depth, area(&equivalent, &widths) / ideal)
}

#[test]
fn jumps_through_a_layer_converge_over_any_base() {
    for base in [1e-10, 1e-9, 0.5e-8, 2e-8, 2e-7] {
        let [fine, coarse] = [0.01, 0.1].map(|share| worn_through(base, share));
        let [fine_deepest, deepest] = [&fine, &coarse].map(|(d, _)| d[NODES / 2]);
        assert!(
            (deepest / fine_deepest - 1.0).abs() < 0.02,
            "{base}: {deepest} {fine_deepest}"
        );
        for (_, area) in [fine, coarse] {
            assert!((area - 1.0).abs() < 1e-6, "{base}: {area}");
        }
    }
}

#[test]
fn a_base_that_does_not_wear_ends_the_wear_of_a_jump() {
    for share in [0.01, 0.1] {
        let (depth, area) = worn_through(0.0, share);
        let deepest = depth.iter().fold(0.0, |most: f64, d| most.max(*d));
        assert!(
            (deepest / (2_048.0 * FLOOR) - 1.0).abs() < 1e-12,
            "{deepest}"
        );
        let middle = &depth[NODES / 2 - 50..NODES / 2 + 50];
        assert!(middle.iter().all(|d| *d >= deepest), "{middle:?}");
        assert!((0.5..0.7).contains(&area), "{area}");
    }
}

#[test]
fn the_displacement_at_which_an_arc_touches_is_limited_by_the_stroke() {
    let (x, widths) = surface();
    let groove = groove(&x, &widths);
    // On a slope of 3/4 the arc touches 3/5 of its radius beside its lowest point.
    let (s, by_slope) = groove.displacement(0.2, -0.75);
    assert!((s + 0.4).abs() < 1e-12 && (by_slope - 0.512).abs() < 1e-12);
    assert_eq!(groove.displacement(1.5, 0.0), (1.0, 0.0));
    // The contact stands on the end of the stroke by half.
    let (s, by_slope) = groove.displacement(1.0, 0.0);
    assert!((s - 0.995).abs() < 1e-12 && (by_slope - 0.5).abs() < 1e-12);
}
