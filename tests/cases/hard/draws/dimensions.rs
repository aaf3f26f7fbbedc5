//! A drawn plane specification in another dimension, with values over the ranges of its fields. Lengths are drawn in proportion to Hertz'
//! half-width. What other dimensions refuse mostly gives way to what they have, so that many of them run.

use std::f64::consts::{FRAC_PI_4, PI};

use serde_json::{Value, json};

use super::{NUMBERS as PLANE, Numbers};

/// Largest number of random numbers that a specification uses.
pub(in crate::hard) const NUMBERS: usize = PLANE + 40;

/// Lengths in mm, `system` and `model`.
const LENGTH_MM: [f64; 2] = [1e-6, 1e4];

/// The contact of the drawn section, by Hertz.
struct Section {
    radius_mm: f64,
    load_n_per_mm: f64,
    half_width_mm: f64,
    peak_mpa: f64,
}

/// Turns random numbers into a specification of a `point`, a `line`, a `ring`, `extruded` bodies or `auto`.
pub(in crate::hard) fn specification(numbers: &[f64]) -> Value {
    let (plane, own) = numbers.split_at(PLANE);
    let mut spec = super::specification(plane);
    let mut u = Numbers(own.iter());
    let section = section(&spec);
    if u.chance(0.9) {
        without_what_only_a_section_has(&mut spec);
    }
    let amplitude = section.half_width_mm * u.log(0.05, 15.0);
    if u.chance(0.8) && spec["motion"]["amplitude_mm"].is_number() {
        spec["motion"]["amplitude_mm"] = json!(amplitude.clamp(1e-9, 1e4));
    }
    let (model, width) = match u.within(0.0, 1.0) {
        kind if kind < 0.25 => (point(&mut u, &section), None),
        kind if kind < 0.55 => line("line", &mut u, &section),
        kind if kind < 0.7 => line("auto", &mut u, &section),
        kind if kind < 0.87 => ring(&mut u, &section),
        _ => extruded(&mut u, &section),
    };
    load((&mut spec, &model), &mut u, (&section, width));
    if model["dimension"] == "line" || model["dimension"] == "ring" {
        if u.chance(0.6) {
            spec["accuracy"]["overrides"]["stations"] = u.count(3.0, 12.0);
        }
    } else if model["dimension"] == "point" && u.chance(0.9) {
        // A section's element is no cell of a point contact.
        remove(&mut spec["accuracy"]["overrides"], "contact_element_mm");
    }
    spec["model"] = model;
    let cycles = spec["cycles"].as_u64().unwrap_or(1);
    let snapshots = [1, 3, 10, 100].into_iter().filter(|at| *at <= cycles);
    spec["output"] = json!({"snapshots_at_cycles": snapshots.collect::<Vec<u64>>()});
    spec
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("it is drawn")
}

fn remove(object: &mut Value, field: &str) {
    if let Some(object) = object.as_object_mut() {
        object.remove(field);
    }
}

fn length(mm: f64) -> Value {
    json!(mm.clamp(LENGTH_MM[0], LENGTH_MM[1]))
}

fn section(spec: &Value) -> Section {
    let compliance: f64 = ["slider", "receptacle"]
        .iter()
        .map(|side| {
            let material = &spec["materials"][*side];
            let ratio = number(&material["poisson_ratio"]);
            (1.0 - ratio * ratio) / number(&material["youngs_modulus_mpa"])
        })
        .sum();
    let load = &spec["load"];
    let load_n_per_mm = match load.get("width_mm") {
        None => number(&load["n_per_mm"]),
        Some(width) => number(&load["n"]) / number(width),
    };
    let radius_mm = number(&spec["system"]["radius_mm"]);
    let half_width_mm = (load_n_per_mm * radius_mm * compliance / FRAC_PI_4).sqrt();
    Section {
        radius_mm,
        load_n_per_mm,
        half_width_mm,
        peak_mpa: 2.0 * load_n_per_mm / (PI * half_width_mm),
    }
}

/// A reciprocating motion of the slider's top.
fn without_what_only_a_section_has(spec: &mut Value) {
    spec["motion"]["drive"] = json!("slider_top");
    if let Some(terms) = spec["motion"].get("terms").cloned() {
        let amplitude = number(&terms[0]["sine_mm"]).hypot(number(&terms[0]["cosine_mm"]));
        spec["motion"]["kind"] = json!("reciprocating");
        spec["motion"]["amplitude_mm"] = json!(amplitude.max(1e-9));
        remove(&mut spec["motion"], "terms");
    }
}

fn point(u: &mut Numbers<'_>, section: &Section) -> Value {
    let mut model = json!({"dimension": "point"});
    if u.chance(0.8) {
        model["radius_z_mm"] = length(section.radius_mm * u.log(1e-2, 1e2));
    }
    model
}

fn top(u: &mut Numbers<'_>, last: f64) -> &'static str {
    match u.within(0.0, 1.0) {
        kind if kind < 0.6 => "rigid",
        kind if kind < last => "even",
        _ => "pressure",
    }
}

/// A straight, crowned or tilted line, with its width.
fn line(name: &str, u: &mut Numbers<'_>, section: &Section) -> (Value, Option<f64>) {
    let width = (section.half_width_mm * u.log(2.0, 2e3)).clamp(LENGTH_MM[0], LENGTH_MM[1]);
    let mut model = json!({"dimension": name, "width_mm": width, "top": top(u, 0.98)});
    let crown = width * u.log(0.3, 1e5);
    if u.chance(0.6) {
        model["crown_radius_mm"] = length(crown);
    }
    let tilt = u.log(1e-4, 110.0);
    if u.chance(0.5) {
        model["tilt_mrad"] = json!(if u.chance(0.5) { tilt } else { -tilt });
    }
    (model, Some(width))
}

fn ring(u: &mut Numbers<'_>, section: &Section) -> (Value, Option<f64>) {
    let diameter = (section.radius_mm * u.log(3.8, 200.0)).clamp(LENGTH_MM[0], LENGTH_MM[1]);
    let motion = if u.chance(0.7) { "in_plane" } else { "torsion" };
    let top = top(u, 0.8);
    let model =
        json!({"dimension": "ring", "outer_diameter_mm": diameter, "top": top, "motion": motion});
    (
        model,
        Some(PI * (diameter - 2.0 * section.radius_mm).max(1e-6)),
    )
}

fn extruded(u: &mut Numbers<'_>, section: &Section) -> (Value, Option<f64>) {
    let width = (section.half_width_mm * u.log(0.1, 1e3)).clamp(LENGTH_MM[0], LENGTH_MM[1]);
    let mut model = json!({"dimension": "extruded", "width_mm": width});
    if u.chance(0.5) {
        let half = u.count(1.0, 4.0).as_u64().unwrap_or(1);
        model["layers"] = json!(2 * half);
    }
    let growth = u.within(1.0, 5.0);
    if u.chance(0.5) {
        model["layer_growth"] = json!(growth);
    }
    if u.chance(0.5) {
        model["ends"] = json!(if u.chance(0.5) { "held" } else { "free" });
    }
    (model, Some(width))
}

/// The force of the whole contact, or still that of a mm.
fn load(
    (spec, model): (&mut Value, &Value),
    u: &mut Numbers<'_>,
    (section, width): (&Section, Option<f64>),
) {
    let spring = spec["load"].get("spring_n_per_mm").map(number);
    let (force, of_whole) = if let Some(width) = width {
        (section.load_n_per_mm * width, width)
    } else {
        // Of about the same peak pressure.
        let across = model.get("radius_z_mm").map_or(section.radius_mm, number);
        let area = PI * section.half_width_mm.powi(2) * (across / section.radius_mm).sqrt();
        let force = section.peak_mpa * area / 1.5 * u.log(0.1, 10.0);
        (force, force / section.load_n_per_mm)
    };
    if width.is_some() && u.chance(0.4) {
        spec["load"] = json!({"kind": "line_force", "n_per_mm": section.load_n_per_mm});
        if let Some(spring) = spring {
            spec["load"]["spring_n_per_mm"] = json!(spring);
        }
    } else {
        spec["load"] = json!({"kind": "force", "n": force.clamp(1e-9, 1e6)});
        if let Some(spring) = spring {
            spec["load"]["spring_n_per_mm"] = json!((spring * of_whole).min(1e9));
        }
    }
}
