//! Random specifications over the documented ranges, from numbers in [0, 1). Lengths, loads and rates are drawn by
//! their logarithm, and mostly in proportion to each other: independent draws would nearly all be refused.

pub(super) mod dimensions;

use std::f64::consts::{FRAC_PI_4, PI};

use serde_json::{Value, json};

use super::additions::{self, Contact};

/// Largest number of random numbers that a specification uses.
pub(crate) const NUMBERS: usize = 112;

/// Random numbers not yet used.
pub(super) struct Numbers<'a>(std::slice::Iter<'a, f64>);

impl Numbers<'_> {
    fn next(&mut self) -> f64 {
        *self.0.next().expect("there are enough numbers")
    }

    pub(super) fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    pub(super) fn log(&mut self, from: f64, to: f64) -> f64 {
        from * (to / from).powf(self.next())
    }

    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.next() < probability
    }

    /// A whole number, by its logarithm.
    pub(super) fn count(&mut self, from: f64, to: f64) -> Value {
        let text = format!("{:.0}", self.log(from, to).floor());
        text.parse::<u64>().expect("it is a whole number").into()
    }
}

/// Lengths to which other quantities are drawn in proportion.
struct Lengths {
    radius: f64,
    block: f64,
    height: f64,
    contact: f64,
}

/// Turns random numbers into a specification.
pub(crate) fn specification(numbers: &[f64]) -> Value {
    let mut u = Numbers(numbers.iter());
    let (materials, compliance) = materials(&mut u);
    let (mut system, lengths) = system(&mut u);
    let load = FRAC_PI_4 * lengths.contact.powi(2) / (lengths.radius * compliance);
    let load = load.clamp(1e-9, 1e6);
    let cycles = u.count(1.0, 1e6);
    let total = cycles.as_f64().unwrap_or(1.0);
    let wear = json!({
        "slider": wear(&mut u, &lengths, load, total),
        "receptacle": wear(&mut u, &lengths, load, total),
    });
    let friction = if u.chance(0.1) {
        json!({"law": "frictionless"})
    } else {
        json!({"law": "coulomb", "coefficient": u.within(0.0, 2.0)})
    };
    let drive = if u.chance(0.2) {
        "slider_body"
    } else {
        "slider_top"
    };
    let amplitude = amplitude(&mut u, &lengths);
    if u.chance(0.2) {
        let crown = (0.5 * lengths.block * u.log(1.0, 100.0)).clamp(1e-6, 1e4);
        system["crown_radius_mm"] = json!(crown);
    }
    let mut line = json!({"kind": "line_force", "n_per_mm": load});
    if u.chance(0.2) {
        let spring = load / lengths.height * u.log(1e-3, 1e2);
        line["spring_n_per_mm"] = json!(spring.min(1e9));
    }
    let mut spec = json!({
        "system": system,
        "materials": materials,
        "interface": {"friction": friction, "wear": wear},
        "load": line,
        "motion": {"kind": "reciprocating", "amplitude_mm": amplitude, "drive": drive},
        "cycles": cycles,
        "accuracy": {"preset": "draft", "overrides": overrides(&mut u, &lengths, total)},
    });
    let contact = Contact {
        load,
        cycles: total,
        amplitude,
        depth: u.log(1e-6, 1.0) * lengths.height.min(lengths.radius),
    };
    additions::add(&mut u, &mut spec, &contact);
    spec
}

fn materials(u: &mut Numbers<'_>) -> (Value, f64) {
    let mut compliance = 0.0;
    let mut side = || {
        let modulus = if u.chance(0.5) {
            200e3
        } else {
            u.log(1e-3, 1e8)
        };
        let poisson = u.within(0.0, 0.4999);
        compliance += (1.0 - poisson * poisson) / modulus;
        json!({"youngs_modulus_mpa": modulus, "poisson_ratio": poisson})
    };
    let materials = json!({"slider": side(), "receptacle": side()});
    (materials, compliance)
}

fn system(u: &mut Numbers<'_>) -> (Value, Lengths) {
    let radius = if u.chance(0.5) {
        u.log(1e-2, 10.0)
    } else {
        u.log(1e-5, 1e4)
    };
    let block = (radius * u.log(0.1, 10.0)).clamp(1e-6, 1e4);
    let height = (block * u.log(0.1, 2.0)).clamp(1e-6, 1e4);
    let half_width = (radius * u.within(0.05, 1.0)).clamp(1e-6, 1e4);
    let sagitta = radius - (radius * radius - half_width * half_width).max(0.0).sqrt();
    let slider_height = (half_width * u.log(1.0, 3.0)).clamp(1e-6, 1e4).max(sagitta);
    let system = json!({
        "kind": "cylinder_on_flat",
        "radius_mm": radius,
        "flat_length_mm": block,
        "flat_height_mm": height,
        "slider_half_width_mm": half_width,
        "slider_height_mm": slider_height,
    });
    let contact = radius * u.log(1e-4, 0.3);
    (
        system,
        Lengths {
            radius,
            block,
            height,
            contact,
        },
    )
}

/// Archard's law, so that all cycles wear up to three times the height, or a pass up to the pressure's own length.
fn wear(u: &mut Numbers<'_>, lengths: &Lengths, load: f64, cycles: f64) -> Value {
    let (chance, depth, rate) = (u.next(), u.log(1e-6, 3.0), u.log(1e-4, 1.0));
    let peak = 2.0 * load / (PI * lengths.contact);
    let k = match chance {
        chance if chance < 0.3 => return Value::Null,
        chance if chance < 0.8 => {
            depth * lengths.height.min(lengths.radius) / (load * 4.0 * cycles)
        }
        _ => rate / peak,
    };
    json!({"law": "archard", "k_over_h_per_mpa": k.min(1.0)})
}

/// In proportion to the contact or to the block, or any allowed value.
fn amplitude(u: &mut Numbers<'_>, lengths: &Lengths) -> f64 {
    let amplitude = match u.next() {
        chance if chance < 0.05 => 0.0,
        chance if chance < 0.5 => lengths.contact * u.log(1e-2, 30.0),
        chance if chance < 0.95 => 0.5 * lengths.block * u.log(1e-2, 30.0),
        _ => u.log(1e-9, 1e4),
    };
    if amplitude > 0.0 {
        amplitude.clamp(1e-9, 1e4)
    } else {
        0.0
    }
}

fn overrides(u: &mut Numbers<'_>, lengths: &Lengths, cycles: f64) -> Value {
    let jump = if u.chance(0.5) {
        json!("adaptive")
    } else {
        u.count(1.0, cycles)
    };
    let mut overrides = json!({"cycle_jump": jump});
    if u.chance(0.6) {
        overrides["increments_per_cycle"] = u.count(4.0, 200.0);
    }
    if u.chance(0.3) {
        overrides["contact_element_mm"] = json!(lengths.contact * u.log(0.1, 10.0));
    }
    overrides
}
