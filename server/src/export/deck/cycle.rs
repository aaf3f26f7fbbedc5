//! One cycle of sliding without wear, to compare the cost of the same problem in another code.
//!
//! Under a load alone CalculiX does not find the first contact (its surface-to-surface penalty diverges at the first
//! increment, whatever its size). The slider's top is therefore lowered by a prescribed displacement, in ten
//! increments, and then released under the load, which is in equilibrium but for the compliance of the penalty. The top
//! then moves to +A, to -A and back, or to all turning points of a periodic motion, in equal increments.

use solver::model::Model;
use solver::scene::{Motion, Scene};

use crate::export::deck::Deck;

/// Penalty stiffness over E / (size of a contact element). The stiffer penalty of the pressure deck does not converge
/// under friction; the overlap is still 0.2 % of the indentation of the cylinder in the comparison.
pub const PENALTY: f64 = 5.0;
/// Increments that lower the slider.
const LOWERING_INCREMENTS: f64 = 10.0;
/// Smallest increment of the automatic step control.
const SMALLEST_INCREMENT: f64 = 1e-5;

/// The deck of one cycle in `4 quarter` increments; the slider is first lowered by `lowered_mm`.
pub fn friction_cycle(scene: &Scene, model: &Model, lowered_mm: f64, quarter: u32) -> String {
    let mut deck = Deck::default();
    let slider = deck.bodies_and_contact(scene, model, PENALTY);
    let control_node = slider.control_node;
    let quarter = f64::from(quarter);
    let load = scene.load_n_per_mm;
    let amplitude = scene.largest_amplitude_mm();
    let mut step = |increments: f64, constraints: &[String], load: Option<f64>| {
        deck.line("*STEP, INC=1000\n*STATIC");
        let length = 1.0 / increments;
        deck.line(format!("{length}, 1., {SMALLEST_INCREMENT}, {length}"));
        deck.line("*BOUNDARY, OP=NEW\nRECEPTACLE_FAR, 1, 2");
        for constraint in constraints {
            deck.line(constraint);
        }
        if let Some(load) = load {
            deck.line(format!("*CLOAD, OP=NEW\n{control_node}, 2, {:e}", -load));
        }
        deck.line("*NODE PRINT, NSET=RECEPTACLE_FAR, TOTALS=ONLY\nRF\n*END STEP");
    };
    // CalculiX reads 20 characters per field.
    let lowered = format!("{control_node}, 2, 2, {:.9e}", -lowered_mm);
    step(
        LOWERING_INCREMENTS,
        &["SLIDER_FAR, 1, 1".to_owned(), lowered],
        None,
    );
    step(1.0, &["SLIDER_FAR, 1, 1".to_owned()], Some(load));
    let places = match scene.motion {
        // From the rightmost position to itself.
        Motion::Periodic { turns, .. } => {
            let ends = turns.strokes().map(|(_, end)| end);
            [amplitude].into_iter().chain(ends).collect()
        }
        Motion::Reciprocating { .. } | Motion::Continuous { .. } => {
            vec![amplitude, -amplitude, 0.0]
        }
    };
    let mut from = 0.0;
    for to in places {
        let quarters = ((to - from) / amplitude).abs();
        from = to;
        let moved = format!("SLIDER_FAR, 1, 1, {to:e}");
        step(quarters * quarter, &[moved], Some(load));
    }
    deck.text
}
