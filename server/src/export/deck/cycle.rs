//! A whole cycle of sliding without wear, for a comparison on the same work.
//!
//! Under a load alone CalculiX does not find the first contact (its surface-to-surface penalty diverges at the first
//! increment, whatever its size): so the handle is brought down by a displacement, in ten increments, and then let go
//! under the load, with which it is in equilibrium but for the penalty's softness. The handle then moves to +A, to -A and
//! back, in equal increments.

use solver::model::Model;
use solver::scene::Scene;

use crate::export::deck::Deck;

/// Penalty stiffness over E / (size of a contact element). The stiffer one of a deck for pressures does not converge
/// under friction; the overlap is still 0.2 % of the indentation of the cylinder that is compared.
pub const PENALTY: f64 = 5.0;
/// Increments that bring the handle down.
const LOWERINGS: f64 = 10.0;
/// The smallest increment that is tried.
const SMALLEST: f64 = 1e-5;

/// The deck of one cycle in `4 quarter` increments; the handle is first brought down by `lowered_mm`.
pub fn friction_cycle(scene: &Scene, model: &Model, lowered_mm: f64, quarter: u32) -> String {
    let mut deck = Deck::default();
    let slider = deck.head(scene, model, PENALTY);
    let handle = slider.handle;
    let quarter = f64::from(quarter);
    let load = scene.load_n_per_mm;
    let amplitude = scene.motion.amplitude_mm();
    let mut step = |increments: f64, held: &[String], load: Option<f64>| {
        deck.line("*STEP, INC=1000");
        deck.line("*STATIC");
        let length = 1.0 / increments;
        deck.line(format!("{length}, 1., {SMALLEST}, {length}"));
        deck.line("*BOUNDARY, OP=NEW");
        deck.line("RECEPTACLE_FAR, 1, 2");
        for held in held {
            deck.line(held);
        }
        if let Some(load) = load {
            deck.line("*CLOAD, OP=NEW");
            deck.line(format!("{handle}, 2, {:e}", -load));
        }
        deck.line("*NODE PRINT, NSET=RECEPTACLE_FAR, TOTALS=ONLY");
        deck.line("RF");
        deck.line("*END STEP");
    };
    // A field has 20 characters.
    let lowered = format!("{handle}, 2, 2, {:.9e}", -lowered_mm);
    step(LOWERINGS, &["SLIDER_FAR, 1, 1".to_owned(), lowered], None);
    step(1.0, &["SLIDER_FAR, 1, 1".to_owned()], Some(load));
    for (to, quarters) in [(amplitude, 1.0), (-amplitude, 2.0), (0.0, 1.0)] {
        let moved = format!("SLIDER_FAR, 1, 1, {to:e}");
        step(quarters * quarter, &[moved], Some(load));
    }
    deck.text
}
