//! Additions of a random specification to a bare contact: heat, a current, platings, friction that changes, a periodic motion.

use serde_json::{Value, json};

use super::draws::Numbers;

/// The contact that the specification has so far.
pub(super) struct Contact {
    /// N/mm.
    pub(super) load: f64,
    pub(super) cycles: f64,
    pub(super) amplitude: f64,
    /// A depth that its cycles may wear, mm.
    pub(super) depth: f64,
}

/// Adds each of them with some probability.
pub(super) fn add(u: &mut Numbers<'_>, spec: &mut Value, contact: &Contact) {
    let amplitude = contact.amplitude;
    if u.chance(0.3) {
        heat(u, spec, contact);
    }
    for side in ["slider", "receptacle"] {
        if u.chance(0.25) {
            plating(u, &mut spec["plating"], side, contact);
        }
    }
    let (changes, by_dose) = (u.chance(0.2), u.chance(0.5));
    let coefficients = [u.within(0.0, 1.5), u.within(0.0, 1.5)];
    let (end, last_cycle) = (u.log(1e-2, 3.0), u.count(1.0, 3.0 * contact.cycles));
    if changes && spec["interface"]["friction"]["law"] == "coulomb" {
        let [first, last] = coefficients;
        spec["interface"]["friction"] = if by_dose {
            // N/mm: of the order of the dose, MPa mm, of a contact as wide as the path of a cycle.
            let dose = end * contact.load * contact.cycles;
            json!({"law": "coulomb", "by_dose": [{"dose_mpa_mm": 0, "coefficient": first},
                {"dose_mpa_mm": dose, "coefficient": last}]})
        } else {
            json!({"law": "coulomb", "by_cycle": [{"cycle": 0, "coefficient": first},
                {"cycle": last_cycle, "coefficient": last}]})
        };
    }
    if u.chance(0.15) && amplitude > 0.0 {
        let orders = [1, 2, 3].map(|order| {
            json!({"order": order, "sine_mm": amplitude * u.within(-1.0, 1.0) / f64::from(order),
                "cosine_mm": amplitude * u.within(-1.0, 1.0) / f64::from(order)})
        });
        let motion = &spec["motion"];
        let mut series = json!({"kind": "fourier", "terms": orders, "drive": motion["drive"]});
        if let Some(frequency) = motion.get("frequency_hz") {
            series["frequency_hz"] = frequency.clone();
        }
        spec["motion"] = series;
    }
}

/// A frequency, thermal and electrical properties of both parts, a temperature and a current.
fn heat(u: &mut Numbers<'_>, spec: &mut Value, contact: &Contact) {
    spec["motion"]["frequency_hz"] = json!(u.log(1e-2, 1e5));
    let width = u.log(1e-2, 10.0);
    let (spring, force) = (
        spec["load"].get("spring_n_per_mm").cloned(),
        contact.load * width,
    );
    spec["load"] = json!({"kind": "force", "n": force, "width_mm": width});
    if let Some(spring) = spring {
        spec["load"]["spring_n_per_mm"] = spring;
    }
    spec["environment"] = json!({"temperature_c": u.within(-40.0, 150.0)});
    if u.chance(0.5) {
        spec["environment"]["current_a"] = json!(u.log(1e-3, 100.0));
    }
    for side in ["slider", "receptacle"] {
        let material = &mut spec["materials"][side];
        material["thermal_conductivity_w_mk"] = json!(u.log(1.0, 400.0));
        material["density_kg_m3"] = json!(u.within(2e3, 2e4));
        material["specific_heat_j_kgk"] = json!(u.within(100.0, 1e3));
        material["hardness_mpa"] = json!(u.log(100.0, 1e4));
        material["resistivity_ohm_m"] = json!(u.log(1e-8, 1e-5));
        material["melting_temperature_c"] = json!(u.within(200.0, 3e3));
    }
    if u.chance(0.3) {
        let film = json!({"specific_resistance_ohm_mm2": u.log(1e-9, 1e-2)});
        spec["interface"]["films"] = json!([film]);
        let limit = json!({"kind": "resistance", "mohm": u.log(1e-2, 1e4)});
        spec["life"] = json!({"criteria": [limit, {"kind": "base_metal"}]});
    }
}

/// One to three layers that wear up to twenty times as slowly or as fast as the contact may.
fn plating(u: &mut Numbers<'_>, platings: &mut Value, side: &str, contact: &Contact) {
    let rate = contact.depth / (4.0 * contact.load * contact.cycles).max(f64::MIN_POSITIVE);
    let materials = ["hard_gold", "nickel", "silver"];
    let count = 1 + usize::from(u.chance(0.5)) + usize::from(u.chance(0.3));
    let layers = materials.into_iter().take(count).map(|material| {
        let k = (rate * u.log(0.05, 20.0)).clamp(1e-15, 1.0);
        let thickness = (1e3 * contact.depth * u.log(1e-3, 1.0)).clamp(1e-3, 1e3);
        json!({"material": material, "thickness_um": thickness,
            "wear": {"law": "archard", "k_over_h_per_mpa": k}})
    });
    platings[side] = layers.collect();
}
