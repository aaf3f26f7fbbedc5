//! Vibrations, thermal cycles and insertions of specifications.

use api::spec::DerivedMotion;
use solver::scene::Motion;

use crate::spec::Resolved;
use crate::spec::tests::{accepted, faults};

/// An SD card (nine contacts of 0.5 N, friction 0.3, a bare pad that wears) with a motion.
fn sd_card(motion: &str) -> String {
    format!(
        r#"{{"system":{{"kind":"sd_card"}},"load":{{"kind":"force","n":0.5,"width_mm":1.0}},
        "interface":{{"friction":{{"law":"coulomb","coefficient":0.3}},
            "wear":{{"slider":null,"receptacle":{{"law":"archard","k":0.004,"hardness_mpa":1700}}}}}},"motion":{motion}}}"#
    )
}

/// A vibration of a card of 2 g.
fn vibration(rest: &str) -> String {
    sd_card(&format!(
        r#"{{"kind":"vibration","mass_g":2.0,"contacts":9,{rest}}}"#
    ))
}

fn derived(text: &str) -> (Resolved, DerivedMotion) {
    let resolved = accepted(text);
    let motion = resolved.motion.clone().expect("a derived motion");
    let Motion::Reciprocating { amplitude_mm, .. } = resolved.scene.motion else {
        panic!("a reciprocating motion");
    };
    assert!((amplitude_mm - motion.slip_amplitude_mm).abs() <= 0.0);
    // Submitted again, the resolved specification is the same.
    let again = serde_json::to_string(&resolved.spec).expect("JSON");
    assert_eq!(accepted(&again).scene, resolved.scene);
    (resolved, motion)
}

fn near(found: f64, expected: f64, allowed: f64) -> bool {
    (found / expected - 1.0).abs() < allowed
}

#[test]
fn a_card_that_friction_holds_slips_beyond_its_friction() {
    // 9 contacts, 0.15 N each, hold 2 g up to 68.8 g.
    let (_, still) = derived(&vibration(r#""acceleration_g":20,"frequency_hz":50"#));
    assert!(still.sticks && still.slip_amplitude_mm <= 0.0);
    let from = still.slips_from_g.expect("an acceleration");
    assert!(near(from, 1.35 / (2e-6 * 9_806.65), 1e-12), "{from}");
    // A thousand times the acceleration: the card rests in space.
    let (_, free) = derived(&vibration(r#""acceleration_g":68830,"frequency_hz":50"#));
    let amplitude = 68_830.0 * 9_806.65 / (2.0 * std::f64::consts::PI * 50.0_f64).powi(2);
    assert!(near(free.slip_amplitude_mm, amplitude, 2e-6) && !free.sticks);
    // Friction of 0.6 of the inertia.
    let (_, partly) = derived(&vibration(&format!(
        r#""acceleration_g":{},"frequency_hz":50"#,
        from / 0.6
    )));
    let unit = from / 0.6 * 9_806.65 / (2.0 * std::f64::consts::PI * 50.0_f64).powi(2);
    assert!(near(partly.slip_amplitude_mm, 0.5 * 0.788_372 * unit, 1e-5));
}

#[test]
fn arms_take_up_their_deflection() {
    // 0.15 N over 20 N/mm: 7.5 um; nine of them hold 2 g at 1 510 Hz.
    let arms = r#""tangential_stiffness_n_per_mm":20,"quality_factor":10"#;
    let (_, still) = derived(&vibration(&format!(
        r#"{arms},"acceleration_g":20,"frequency_hz":50"#
    )));
    assert!(still.sticks && near(still.held_amplitude_mm, still.relative_amplitude_mm, 1e-12));
    let from = still.slips_from_g.expect("an acceleration");
    let (_, shaken) = derived(&vibration(&format!(
        r#"{arms},"acceleration_g":{},"frequency_hz":50"#,
        3.0 * from
    )));
    assert!(near(shaken.held_amplitude_mm, 7.5e-3, 1e-12));
    assert!(near(shaken.slip_amplitude_mm, 2.0 * 7.5e-3, 1e-9));
}

/// The arm takes up 7.5 um of each stroke of the parts, which the stop ends.
#[test]
fn a_clearance_limits_the_motion_of_the_parts_and_not_the_slip() {
    let arms = r#""tangential_stiffness_n_per_mm":20"#;
    let cycle =
        r#""kind":"thermal_cycle","delta_t_k":-60,"length_mm":670,"expansion_mismatch_per_k":6e-6"#;
    let motions = [
        vibration(&format!(
            r#"{arms},"acceleration_g":4000,"frequency_hz":50"#
        )),
        sd_card(&format!("{{{cycle},{arms}}}")),
    ];
    for motion in &motions {
        let between = |clearance: f64| {
            let stop = format!(r#"{arms},"clearance_mm":{clearance}"#);
            derived(&motion.replace(arms, &stop)).1
        };
        let (_, free) = derived(motion);
        assert!(free.relative_amplitude_mm > 0.015, "{free:?}");
        for (clearance, slip) in [(0.012, 0.0), (0.015, 0.0), (0.016, 5e-4), (0.03, 7.5e-3)] {
            let stopped = between(clearance);
            assert!(
                (stopped.slip_amplitude_mm - slip).abs() < 1e-12,
                "{stopped:?}"
            );
            assert!(near(stopped.relative_amplitude_mm, 0.5 * clearance, 1e-12));
            assert!(near(
                stopped.held_amplitude_mm,
                7.5e-3_f64.min(0.5 * clearance),
                1e-12
            ));
            assert!(stopped.reason.contains("clearance"), "{}", stopped.reason);
            assert_eq!(stopped.sticks, slip <= 0.0);
            // No acceleration lets a contact slip whose arm takes up the whole clearance.
            let slips = free.slips_from_g.filter(|_| slip > 0.0);
            assert_eq!(stopped.slips_from_g, slips);
        }
        // A clearance beyond the motion changes nothing.
        assert_eq!(between(10.0), free);
        assert_eq!(between(0.0).slip_amplitude_mm.to_bits(), 0.0_f64.to_bits());
    }
    // A rigid part has no arm.
    let shaken = r#""acceleration_g":200,"frequency_hz":50"#;
    let (_, rigid) = derived(&vibration(&format!(r#"{shaken},"clearance_mm":0.02"#)));
    assert!(near(rigid.slip_amplitude_mm, 0.01, 1e-12), "{rigid:?}");
}

#[test]
fn a_random_motion_of_the_parts_ends_at_the_clearance() {
    let deviation = 0.049_119;
    let psd = r#""psd":[{"frequency_hz":5,"g2_per_hz":0.01},{"frequency_hz":20,"g2_per_hz":0.02},
        {"frequency_hz":500,"g2_per_hz":0.02}],"natural_frequency_hz":200,"quality_factor":10"#;
    // Arms that take up one standard deviation, stops at one, two and many.
    let stiffness = 0.15 / deviation;
    let between = |stop: f64| {
        let clearance = 2.0 * stop * deviation;
        let rest = format!(
            r#"{psd},"tangential_stiffness_n_per_mm":{stiffness},"clearance_mm":{clearance}"#
        );
        derived(&vibration(&rest)).1
    };
    // Amplitudes of a Rayleigh distribution: 4 sqrt(pi/2) [erfc(1/sqrt 2) - erfc(2/sqrt 2)] of a deviation.
    let slip = 0.25 * (1.590_759 - 0.228_104) * deviation;
    let found = between(2.0);
    assert!(near(found.slip_amplitude_mm, slip, 1e-4), "{found:?}");
    let parts = 0.25 * (5.013_257 - 0.228_104) * deviation;
    assert!(near(found.relative_amplitude_mm, parts, 1e-4), "{found:?}");
    let held = found.relative_amplitude_mm - found.slip_amplitude_mm;
    assert!(near(found.held_amplitude_mm, held, 1e-12));
    assert!(between(0.99).sticks);
    assert!(near(
        between(20.0).slip_amplitude_mm,
        0.25 * 1.590_759 * deviation,
        1e-4
    ));
}

#[test]
fn a_random_vibration_slips_by_its_mean_path() {
    let psd = r#""psd":[{"frequency_hz":5,"g2_per_hz":0.01},{"frequency_hz":20,"g2_per_hz":0.02},
        {"frequency_hz":500,"g2_per_hz":0.02}],"natural_frequency_hz":200,"quality_factor":10"#;
    let (resolved, random) = derived(&vibration(&format!(r#"{psd},"duration_s":3600"#)));
    let even = 0.25 * 5.013_257 * 0.049_119;
    assert!(near(random.slip_amplitude_mm, even, 1e-4), "{random:?}");
    assert_eq!(resolved.scene.cycles, 720_000);
    assert_eq!(resolved.spec.cycles, Some(720_000));
    // Arms that take up one standard deviation.
    let stiffness = 0.15 / 0.049_119;
    let (_, held) = derived(&vibration(&format!(
        r#"{psd},"tangential_stiffness_n_per_mm":{stiffness}"#
    )));
    let ratio = held.slip_amplitude_mm / random.slip_amplitude_mm;
    assert!(near(ratio, 1.590_759 / 5.013_257, 1e-4), "{ratio}");
}

#[test]
fn a_thermal_cycle_slips_by_the_mismatch() {
    let cycle =
        r#""kind":"thermal_cycle","delta_t_k":-60,"length_mm":67,"expansion_mismatch_per_k":6e-6"#;
    let (_, free) = derived(&sd_card(&format!("{{{cycle}}}")));
    assert!(near(free.slip_amplitude_mm, 0.5 * 24.12e-3, 1e-12));
    assert!(near(free.frequency_hz, 1.0 / 3_600.0, 1e-12));
    let arms = r#""tangential_stiffness_n_per_mm":20"#;
    let (_, held) = derived(&sd_card(&format!("{{{cycle},{arms}}}")));
    assert!(near(held.slip_amplitude_mm, 0.5 * 24.12e-3 - 7.5e-3, 1e-9));
}

#[test]
fn a_mating_wipes_in_and_out() {
    let (resolved, wipe) = derived(&sd_card(r#"{"kind":"insertion","wipe_mm":1.5}"#));
    assert!(near(wipe.slip_amplitude_mm, 0.75, 1e-15));
    assert!(near(
        resolved.scene.motion.distance_per_cycle_mm(),
        3.0,
        1e-15
    ));
}

#[test]
fn what_a_derived_motion_lacks_is_named() {
    let pointers = |text: &str| -> Vec<String> {
        let found = faults(text).into_iter();
        found.map(|fault| fault.pointer).collect()
    };
    let motion = |text: &str| pointers(&sd_card(text));
    assert_eq!(
        motion(r#"{"kind":"vibration"}"#),
        [
            "/motion/mass_g",
            "/motion/contacts",
            "/motion/acceleration_g",
            "/motion/frequency_hz"
        ]
    );
    assert_eq!(
        motion(r#"{"kind":"thermal_cycle"}"#),
        [
            "/motion/delta_t_k",
            "/motion/length_mm",
            "/motion/expansion_mismatch_per_k"
        ]
    );
    assert_eq!(motion(r#"{"kind":"insertion"}"#), ["/motion/wipe_mm"]);
    assert_eq!(
        motion(r#"{"kind":"insertion","wipe_mm":1,"amplitude_mm":1}"#),
        ["/motion/amplitude_mm"]
    );
    let psd = |points: &str| pointers(&vibration(&format!(r#""psd":[{points}]"#)));
    let point = |hz: f64| format!(r#"{{"frequency_hz":{hz},"g2_per_hz":0.01}}"#);
    assert_eq!(
        psd(&format!("{},{}", point(5.0), point(20.0))),
        ["/motion/natural_frequency_hz"]
    );
    assert_eq!(
        psd(&format!("{},{}", point(20.0), point(20.0)))[0],
        "/motion/psd/1/frequency_hz"
    );
    let both = vibration(r#""acceleration_g":20,"frequency_hz":50,"duration_s":60"#);
    let both = both.replacen('{', r#"{"cycles":5,"#, 1);
    assert_eq!(pointers(&both), ["/cycles"]);
    let far = vibration(r#""acceleration_g":1e6,"frequency_hz":1"#);
    assert_eq!(pointers(&far), ["/motion"]);
    // A load for each mm has no force on a contact.
    let fuzz = r#"{"system":{"kind":"fuzz_button"},"motion":{"kind":"vibration","mass_g":2,"contacts":1,
        "acceleration_g":1,"frequency_hz":50}}"#;
    assert_eq!(pointers(fuzz), ["/load/kind"]);
}
