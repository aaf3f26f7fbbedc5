//! Requirement: friction of 0.78, 1.21 and 1.5, as measured on clean metals, preserves the balance of the contact, and the
//! worn area follows Archard's law.
//! Source: D. Shinde's thesis (0.78 steel, 1.21 copper); noble metals reach 1.5 in air.
//! Naive: a symmetric solve or shear taken from the last iteration diverges from mu near 1 on; pairing frozen at the
//! start of an increment gives |Q| up to 1.7 mu P with perfect vertical balance.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::fuzz_button;

#[test]
fn high_friction_preserves_balance_cone_and_worn_area() {
    for mu in [0.78, 1.21, 1.5] {
        let run = solve(&fuzz_button(json!({
            "interface": {"friction": {"law": "coulomb", "coefficient": mu}},
            "cycles": 40,
            "effects": {"friction": "on", "stick_memory": "on"},
        })));
        hold(&run);
        let used = run.summary().checks.friction_use;
        assert!(used > 0.999 && used < 1.0 + 1e-9, "mu {mu}: {used}");
        assert!(
            (run.area_ratio() - 1.0).abs() < 0.02,
            "mu {mu}: {}",
            run.area_ratio()
        );
    }
}
