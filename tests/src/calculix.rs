//! Runs CalculiX on exported decks and reads its output.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use crate::fretwear;

/// The exported deck of a specification.
///
/// # Panics
/// If the specification is refused.
pub fn deck(folder: &Path, spec: &str) -> String {
    std::fs::write(folder.join("spec.json"), spec).expect("a file can be written");
    let deck = fretwear(folder, &["export", "spec.json", "--format", "inp"]);
    assert_eq!(deck.code, Some(0), "{}", deck.stderr);
    deck.stdout
}

/// Runs a deck to its end.
///
/// # Panics
/// If `ccx` is absent or fails.
pub fn run(folder: &Path, deck: &str) {
    std::fs::write(folder.join("deck.inp"), deck).expect("a file can be written");
    let ran = Command::new("ccx").arg("deck").current_dir(folder).output();
    assert!(ran.expect("ccx can be started").status.success());
}

/// Key of a node: its x in whole nanometres.
pub fn nanometres(x: f64) -> String {
    format!("{:.0}", 1e6 * x)
}

/// Contact pressures of the last increment by the node's x, where y = 0.
///
/// # Panics
/// If there are no results.
pub fn contact_pressures(folder: &Path) -> BTreeMap<String, f64> {
    let all = placed_pressures(folder).into_iter();
    all.map(|((x, _), p)| (x, p)).collect()
}

/// Contact pressures of the last increment by the node's x and z, where y = 0.
///
/// # Panics
/// If there are no results.
pub fn placed_pressures(folder: &Path) -> BTreeMap<(String, String), f64> {
    let text = std::fs::read_to_string(folder.join("deck.frd")).expect("ccx wrote its results");
    let (mut block, mut places, mut pressures) = ("", BTreeMap::new(), BTreeMap::new());
    for line in text.lines() {
        match line.trim_start() {
            start if start.starts_with("2C") => block = "nodes",
            start if start.starts_with("-4  CONTACT") => block = "contact",
            start if start.starts_with("-3") => block = "",
            start if start.starts_with("-1") && !block.is_empty() => {
                let value = |k: usize| {
                    line.get(13 + 12 * k..25 + 12 * k)?
                        .trim()
                        .parse::<f64>()
                        .ok()
                };
                let node = line[3..13].trim().to_owned();
                if block == "nodes" {
                    places.insert(node, (value(0), value(1), value(2)));
                } else if let (Some((Some(x), Some(y), z)), Some(p)) = (places.get(&node), value(3))
                    && y.abs() < 1e-9
                    && p > 0.0
                {
                    let z = nanometres(z.unwrap_or(0.0));
                    pressures.insert((nanometres(*x), z), p);
                }
            }
            _ => {}
        }
    }
    pressures
}

/// Displacements of the receptacle's contact nodes, in their order.
///
/// # Panics
/// If there are no results.
pub fn displacements(folder: &Path) -> Vec<[f64; 2]> {
    let text = std::fs::read_to_string(folder.join("deck.dat")).expect("ccx wrote its table");
    let table = text
        .lines()
        .skip_while(|line| !line.contains("RECEPTACLE_NEAR"))
        .skip(2);
    table
        .map_while(|line| {
            let mut numbers = line.split_whitespace().skip(1).map(str::parse::<f64>);
            Some([numbers.next()?.ok()?, numbers.next()?.ok()?])
        })
        .collect()
}
