//! One sentence of each kind, compared with `snapshots/`; after an intended change, run the tests with `INSTA_UPDATE=always`.

use solver::SolveError;
use solver::effects::extent::Choice;
use solver::effects::{
    Absence, AcrossWidth, Basis, Decision, Facts, Hardness, Indicator, Verdict, Yield,
};
use solver::observer::Restart;
use solver::point::PointError;
use solver::record::{Excess, Quantity, Warning};
use solver::scene::{Effect, MissingInput, MissingProperty};
use solver::sides::{Side, Sides};
use solver::station::StationError;

use super::{decisions, effects, errors, extent, restarts, warnings};

const INDICATOR: Indicator = Indicator {
    unworn: 0.001,
    worn: 0.03,
    threshold: 0.004,
};

fn decision(effect: Effect, verdict: Verdict, basis: Basis) -> Decision {
    Decision {
        effect,
        verdict,
        is_available: effect.is_available(),
        basis,
    }
}

fn reason(effect: Effect, verdict: Verdict, basis: Basis) -> String {
    decisions::reason(&decision(effect, verdict, basis))
}

#[test]
fn absences_and_missing_inputs_have_their_sentences() {
    let nothing = |effect, absence| reason(effect, Verdict::Skipped, Basis::Nothing(absence));
    let missing = |effect, input| reason(effect, Verdict::InputMissing, Basis::Missing(input));
    let melting = |slider, receptacle| {
        let sides = Sides { slider, receptacle };
        missing(
            Effect::ThermalSoftening,
            MissingInput::MeltingTemperature(sides),
        )
    };
    let found = [
        nothing(Effect::SliderWear, Absence::NoWear(Side::Slider)),
        nothing(Effect::Relocation, Absence::NothingWears),
        nothing(Effect::Fatigue, Absence::NeverSimulated),
        nothing(
            Effect::SkinEffect,
            Absence::Conductor(MissingProperty::Force),
        ),
        missing(Effect::FrictionalHeating, MissingInput::Conductivity),
        melting(true, true),
        melting(false, true),
    ];
    insta::assert_snapshot!(found.join("\n"));
}

#[test]
fn indicators_have_sentences_with_their_numbers() {
    let of = |effect, verdict, facts| reason(effect, verdict, Basis::Indicator(INDICATOR, facts));
    let unworn = Yield {
        peak_mpa: 600.0,
        side: Side::Receptacle,
        hardness: Hardness {
            outermost: 1_700.0,
            base: 427.0,
            carrying: 500.0,
        },
        depth_mm: 1e-4,
    };
    let plated = Facts::Yield {
        unworn,
        layer_mm: Some(1e-3),
        worn_mm: 0.0,
    };
    let change = Facts::Change {
        is_beyond_budget: true,
        is_stated_error: true,
    };
    let heat = Facts::FrictionalHeat {
        mean_k: 1.0,
        highest_k: 2.0,
        of_one_spot_k: Some(30.0),
    };
    let even = Facts::AcrossWidth(AcrossWidth::Even {
        depth_mm: 1e-3,
        life_over_ball: 12.3,
    });
    let deformation = Facts::Deformation {
        modulus_mpa: 72_345.6,
        half_width_mm: 0.012_34,
    };
    let depth = Facts::SkinDepth(Sides {
        slider: 0.01,
        receptacle: f64::INFINITY,
    });
    let found = [
        of(Effect::Elasticity, Verdict::ForcedOn, deformation),
        of(Effect::Resistance, Verdict::ForcedOn, Facts::KnownConductor),
        of(
            Effect::Resistance,
            Verdict::ForcedOff,
            Facts::KnownConductor,
        ),
        of(Effect::SkinEffect, Verdict::Skipped, depth),
        of(Effect::FrictionalHeating, Verdict::Simulated, heat),
        of(
            Effect::JouleHeating,
            Verdict::ForcedOff,
            Facts::JouleHeat(5.0),
        ),
        of(Effect::AcrossWidth, Verdict::Skipped, even),
        of(Effect::Plasticity, Verdict::Skipped, plated),
        of(
            Effect::SliderWear,
            Verdict::Simulated,
            Facts::FrictionByWear,
        ),
        of(Effect::Relocation, Verdict::Simulated, change),
    ];
    insta::assert_snapshot!(found.join("\n"));
}

#[test]
fn warnings_restarts_and_errors_have_their_sentences() {
    let excess = Excess {
        quantity: Quantity::ScarHalfWidth,
        relative: 0.031_4,
        allowed: 0.02,
    };
    let change = Facts::Change {
        is_beyond_budget: false,
        is_stated_error: false,
    };
    let missed = decision(
        Effect::Friction,
        Verdict::ForcedOff,
        Basis::Indicator(INDICATOR, change),
    );
    let error = SolveError::Point(PointError::ForceRange(0.0));
    let axis = StationError::BeyondAxis {
        half_block_mm: 0.5,
        radius_mm: 0.25,
    };
    let crown = Choice::Crown {
        aspect: 4.26,
        half_length_mm: 0.1,
        half_width_mm: 0.4,
    };
    let found = [
        warnings::warning(&Warning::Excess(excess)),
        warnings::warning(&Warning::Missed(missed)),
        restarts::restart(&Restart::Without(Effect::StickMemory, &error)),
        restarts::restart(&Restart::Finer(&[excess, excess])),
        errors::of_line(&axis),
        extent::reason(crown),
        effects::indicator(Effect::SpringFading).to_owned(),
    ];
    insta::assert_snapshot!(found.join("\n"));
}
