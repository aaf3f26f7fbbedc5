//! Arrhenius' factor exp(-Q/(R T)) of a reaction with the activation energy Q, J/mol, at the temperature T, K.

/// Molar gas constant R, J/(mol K) (CODATA 2018, exact).
const GAS_CONSTANT: f64 = 8.314_462_618;

/// The factor, -.
pub(super) fn factor(activation_j_mol: f64, temperature_k: f64) -> f64 {
    (-activation_j_mol / (GAS_CONSTANT * temperature_k)).exp()
}
