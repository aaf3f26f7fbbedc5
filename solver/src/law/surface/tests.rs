//! Surfaces with and without a plating, and between two states.

use super::*;

#[test]
fn a_surface_without_a_plating_has_its_depth_as_equivalent() {
    let law = WearLaw::Archard {
        k_over_h_per_mpa: 2e-8,
    };
    let bare = SurfaceWear::new(&[], Some(law));
    let depth = [0.0, 1e-3];
    assert!(matches!(equivalents(bare, &depth), Cow::Borrowed(_)));
    assert_eq!(SurfaceWear::new(&[], None), None);
    assert_eq!(bare.and_then(SurfaceWear::uniform), Some(2e-8));
}

#[test]
fn between_two_states_the_dose_grows_evenly_and_ends_with_the_wear() {
    let layer = Layer {
        thickness_mm: 1e-3,
        rate_per_mpa: 1e-8,
    };
    let base = WearLaw::Archard {
        k_over_h_per_mpa: 4e-8,
    };
    let at = |base, (before, after): (f64, f64), pace: f64, part| {
        let wear = SurfaceWear::new(&[layer], base);
        between(wear, &[before], &[after], std::iter::once(pace), part)[0]
    };
    let is = |found: f64, expected: f64| (found - expected).abs() < 1e-17;
    // 0.5 um of the layer take as long as 2 um of the base.
    let way = (0.5e-3, 3e-3);
    assert!(is(at(Some(base), way, 0.0, 0.0), 0.5e-3));
    assert!(is(at(Some(base), way, 9.0, 0.5), 1e-3));
    assert!(is(at(Some(base), way, 9.0, 0.75), 2e-3));
    assert_eq!(at(Some(base), way, 0.0, 1.0).to_bits(), 3e-3_f64.to_bits());
    // Wear that ends at the layer's bottom: at the pace of 2 um half of the way is there after an eighth.
    let way = (0.75e-3, 1e-3);
    assert!(is(at(None, way, 2e-3, 0.0625), 0.875e-3));
    assert_eq!(at(None, way, 2e-3, 0.126).to_bits(), 1e-3_f64.to_bits());
    assert!(is(at(None, way, 0.0, 0.5), 0.875e-3));
    // An unworn surface without a law.
    let bare = between(None, &[0.0; 2], &[0.0; 2], std::iter::empty(), 0.5);
    assert_eq!(bare, [0.0, 0.0]);
}

#[test]
fn a_plated_surface_wears_by_the_mean_rate_of_its_layers() {
    let layer = Layer {
        thickness_mm: 1e-3,
        rate_per_mpa: 1e-8,
    };
    let base = WearLaw::Archard {
        k_over_h_per_mpa: 4e-8,
    };
    let plated = SurfaceWear::new(&[layer], Some(base));
    let at = LocalState::default();
    let rate = |depth| plated.map_or(0.0, |wear| wear.mean_rate(depth, at));
    // 1 um at 1e-8 takes as long as 4 um at 4e-8: 5 um at 2.5e-8.
    assert!((rate(5e-3) - 2.5e-8).abs() < 1e-20, "{}", rate(5e-3));
    assert!((rate(0.0) - 1e-8).abs() < 1e-22);
    let depth = [0.5e-3, 5e-3];
    let equivalent = equivalents(plated, &depth).into_owned();
    assert!((equivalent[1] - 2e-3).abs() < 1e-17, "{}", equivalent[1]);
    assert!((depths(plated, equivalent)[1] - 5e-3).abs() < 1e-17);
    assert_eq!(
        at_relative_rates(plated, &[1.0, 1.0], &depth)[..],
        [1.0, 4.0]
    );
}
