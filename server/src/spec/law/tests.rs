//! Definitions of wear laws say how the rates of the engine's laws depend on a state.

use api::spec::WearLawName;
use solver::closed_form::expected_wear::worn_contact_half_length_mm;
use solver::law::pace::Pace;
use solver::law::wear::LocalState;
use solver::scene::WearLaw;

use super::{ByFriction, State, check_plated, definition};
use crate::spec;
use crate::spec::diagnostics::Diagnostics;

/// A wearing receptacle with a law.
pub(in crate::spec) fn wearing(law: WearLawName, friction: f64) -> spec::Resolved {
    // Oxides melt at high speeds alone.
    let frequency_hz = match law {
        WearLawName::SevereOxidation | WearLawName::Oxidation => 50_000,
        _ => 50,
    };
    let text = format!(
        r#"{{"system":{{"kind":"cylinder_on_flat"}},"interface":{{"friction":{{"law":"coulomb","coefficient":{friction}}},
        "wear":{{"slider":null,"receptacle":{{"law":"{}",{}}}}}}},"cycles":20000,
        "motion":{{"kind":"reciprocating","amplitude_mm":0.02,"frequency_hz":{frequency_hz}}}}}"#,
        law.as_str(),
        definition(law).example
    );
    spec::read(text.as_bytes()).expect("accepted")
}

/// A law takes a hardness exactly if its rate depends on it.
#[test]
fn the_rates_of_these_laws_depend_on_hardness() {
    for law in WearLawName::ALL {
        let mut changed = wearing(law, 0.4);
        let before = worn_contact_half_length_mm(&changed.scene);
        let wear = &mut changed.spec.interface.wear.receptacle;
        let wear = wear.as_mut().and_then(Option::as_mut).expect("a law");
        wear.hardness_mpa = Some(3400.0);
        let resolved = spec::resolve(&changed.spec);
        let by_hardness = definition(law).takes_hardness();
        assert_eq!(resolved.is_ok(), by_hardness, "{law:?}");
        let after = resolved.map(|resolved| worn_contact_half_length_mm(&resolved.scene));
        let changes = after.is_ok_and(|after| (after / before - 1.0).abs() > 1e-6);
        assert_eq!(changes, by_hardness, "{law:?}");
    }
}

#[test]
fn the_rates_of_these_laws_depend_on_friction() {
    for law in WearLawName::ALL {
        let worn = |friction| worn_contact_half_length_mm(&wearing(law, friction).scene);
        let changes = (worn(0.5) / worn(0.4) - 1.0).abs() > 1e-6;
        let by_friction = definition(law).friction != ByFriction::Independent;
        assert_eq!(changes, by_friction, "{law:?}");
    }
}

/// The engine's law of the receptacle.
fn engine_law(resolved: &spec::Resolved) -> WearLaw {
    resolved.scene.receptacle.wear.expect("a law")
}

#[test]
fn layers_of_these_laws_do_not_wear_without_friction() {
    for law in WearLawName::ALL {
        if let Some(rate) = engine_law(&wearing(law, 0.0)).uniform() {
            let proportional = definition(law).friction == ByFriction::Proportional;
            assert_eq!(rate <= 0.0, proportional, "{law:?}");
        }
    }
}

#[test]
fn rates_depend_on_the_states_of_the_definition() {
    let at = LocalState {
        pressure: 300.0,
        slip: 0.01,
        depth: 1e-4,
        pace: Pace {
            s_per_mm: 2.5e-4,
            cycles_per_mm: 12.5,
        },
    };
    let mut deeper = at;
    deeper.depth *= 2.0;
    let mut faster = at;
    faster.pace.s_per_mm *= 0.5;
    let mut repeated = at;
    repeated.pace.cycles_per_mm *= 2.0;
    for law in WearLawName::ALL {
        let mut of = wearing(law, 0.4);
        let wear = of.spec.interface.wear.receptacle.as_mut();
        let wear = wear.and_then(Option::as_mut).expect("a law");
        wear.contact_temperature_c = None;
        let resolved = spec::resolve(&of.spec).expect("accepted");
        let of = engine_law(&resolved);
        let changes = |to| (of.rate(to).value / of.rate(at).value - 1.0).abs() > 1e-6;
        let states = definition(law).states;
        let has = |state| states.contains(&state);
        assert_eq!(changes(deeper), has(State::Depth), "{law:?}");
        let by_time = has(State::Speed) || has(State::Time);
        assert_eq!(changes(faster), by_time, "{law:?}");
        assert_eq!(changes(repeated), has(State::Repetitions), "{law:?}");
        assert_eq!(of.heated(10.0) != of, has(State::Temperature), "{law:?}");
        assert_eq!(of.uniform().is_some(), states.is_empty(), "{law:?}");
    }
}

#[test]
fn the_fault_of_a_plating_lists_the_laws_that_it_may_wear_by() {
    let law = Some(engine_law(&wearing(WearLawName::Rhee, 0.4)));
    let mut diagnostics = Diagnostics::default();
    check_plated("/plating/receptacle/0/wear", law, &mut diagnostics);
    let detail = "a plating and its base wear by laws whose rate is the same in every state: archard, sarkar, saracibar, \
                  dissipated_energy; a bare part, with the `plating` `[]`, wears by any";
    assert_eq!(diagnostics.into_faults()[0].detail, detail);
}
