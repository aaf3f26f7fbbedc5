//! Constriction resistance of a contact through the layers that are left, from one spot whose size the softer surface gives.

use api::results::{ContactResistance, ResistanceParts};
use solver::law::resistance::{Deformation, half_space};
use solver::sides::Sides;

use crate::spec::Conductors;

/// mOhm in an ohm, and um in a mm.
const MILLI: f64 = 1e3;

/// Resistance of the unworn contact, and of one that is worn to these depths, mm.
pub(crate) fn of(conductors: &Conductors, depth: Sides<f64>) -> ContactResistance {
    let initial = parts(conductors, Sides::default());
    let parts = parts(conductors, depth);
    ContactResistance {
        initial: initial.slider_constriction + initial.receptacle_constriction,
        r#final: parts.slider_constriction + parts.receptacle_constriction,
        parts,
    }
}

fn parts(conductors: &Conductors, depth: Sides<f64>) -> ResistanceParts {
    let left = conductors.left_at(depth);
    let surface = |metals: &[(_, _)]| -> f64 {
        let outermost: Option<&(crate::spec::Metal, _)> = metals.first();
        outermost.map_or(f64::INFINITY, |(metal, _)| metal.hardness_mpa)
    };
    let hardness = surface(&left.slider).min(surface(&left.receptacle));
    let radius_mm = Deformation::Plastic.radius_mm(conductors.force_n, hardness);
    let constriction = left.map(|metals| {
        let stack: Vec<_> = metals.into_iter().map(|(_, conductor)| conductor).collect();
        MILLI * half_space(radius_mm, &stack)
    });
    ResistanceParts {
        slider_constriction: constriction.slider,
        receptacle_constriction: constriction.receptacle,
        spot_radius_um: MILLI * radius_mm,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::read;

    /// An SD card with hard gold on nickel on copper under the tip of gold, 0.5 N.
    fn conductors() -> Conductors {
        let layer = |name: &str, um: f64| {
            format!(
                r#"{{"material":"{name}","thickness_um":{um},"wear":{{"law":"archard","k":1e-4}}}}"#
            )
        };
        let text = format!(
            r#"{{"system":{{"kind":"sd_card"}},"load":{{"kind":"force","n":0.5,"width_mm":1.0}},
            "interface":{{"wear":{{"slider":null}}}},
            "plating":{{"slider":[{}],"receptacle":[{},{}]}}}}"#,
            layer("hard_gold", 1_000.0),
            layer("hard_gold", 0.76),
            layer("nickel", 1.27)
        );
        let resolved = read(text.as_bytes()).expect("it is accepted");
        resolved.conductors.expect("everything is known")
    }

    #[test]
    fn the_resistance_of_thick_gold_is_that_of_the_closed_form_and_wear_changes_the_spot() {
        let conductors = conductors();
        let resistance = of(&conductors, Sides::default());
        // 3e-8 ohm m over 4 times 9.675 77 um, and a little of the base a hundred radii below.
        let gold = 1e3 * 3e-8 / (4.0 * 9.675_77e-6);
        let slider = resistance.parts.slider_constriction;
        assert!((slider / gold - 1.0).abs() < 5e-3, "{slider} {gold}");
        assert!(resistance.initial.to_bits() == resistance.r#final.to_bits());
        // Through both layers the soft copper widens the spot.
        let depth = |receptacle| Sides {
            slider: 0.0,
            receptacle,
        };
        let worn = of(&conductors, depth(2.1e-3));
        assert!(worn.parts.spot_radius_um > 1.9 * resistance.parts.spot_radius_um);
        let copper = 1e3 * 1.68e-8 / (4e-6 * worn.parts.spot_radius_um);
        let found = worn.parts.receptacle_constriction;
        assert!((found / copper - 1.0).abs() < 1e-6, "{found} {copper}");
        // Through the gold the nickel has more than three times its own resistivity of gold.
        let nickel = of(&conductors, depth(0.8e-3));
        assert!(nickel.r#final > resistance.initial);
    }
}
