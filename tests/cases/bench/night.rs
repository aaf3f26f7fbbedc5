//! The tables of the documents.

use server::estimate::machine;
use server::export::markdown;

use crate::bench::against::{self, Comparison};
use crate::bench::predictions::{self, Pair, Prediction, TOLERANCES};
use crate::bench::{Row, cases};

#[test]
#[ignore = "night: three minutes"]
fn the_time_of_each_case() {
    let mut table = markdown::table(["case", "size", "CPU"], 2);
    for (name, case) in cases::all() {
        let measured = case().unwrap_or_else(|error| panic!("{name}: {error}"));
        for Row { what, size, cpu_s } in measured {
            table.add_row([what, size, time(cpu_s)]);
        }
    }
    println!("{table}");
}

/// One cycle of friction on the same meshes, one thread each, one after the other.
#[test]
#[cfg_attr(not(has_ccx), ignore = "needs the program ccx of CalculiX")]
#[cfg_attr(has_ccx, ignore = "night: two minutes")]
fn the_time_of_calculix_on_the_same_cycle() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let header = [
        "element, um",
        "nodes",
        "fretwear: set-up + cycle, s",
        "ccx, s",
        "ratio",
        "largest |Q|/(mu P), fretwear / ccx",
    ];
    let mut table = markdown::table(header, 0);
    for element_um in against::ELEMENTS_UM {
        let compared = against::compare(folder.path(), element_um).expect("both codes run");
        table.add_row(row(&compared));
    }
    let [ours, theirs] = against::TOLERANCES;
    println!("{table}\nProcessor seconds. Tolerances: fretwear: {ours}; ccx: {theirs}.");
}

/// Every system and both published scenes at every tolerance: expected / measured = ratio.
#[test]
#[ignore = "night: ten minutes"]
fn estimates_of_plans_beside_measurements() {
    let figures = machine::measure().expect("the machine can be measured");
    for tolerance in TOLERANCES {
        for scene in predictions::scenes().expect("scenes are sound") {
            let compared = predictions::compare(&tests::binary(), &figures, &scene, tolerance);
            println!("{}", line(&compared.expect("it is solved")));
        }
    }
}

fn time(seconds: f64) -> String {
    if seconds < 0.1 {
        format!("{:.2} ms", 1e3 * seconds)
    } else {
        format!("{seconds:.2} s")
    }
}

fn row(compared: &Comparison) -> [String; 6] {
    let [setup_s, cycle_s] = compared.ours_s;
    let (theirs, ratio) = match &compared.theirs_s {
        Ok(seconds) => (
            format!("{seconds:.1}"),
            format!("{:.0}", seconds / (setup_s + cycle_s)),
        ),
        Err(reason) => (reason.clone(), "-".to_owned()),
    };
    let [ours_use, theirs_use] = compared.friction_use;
    [
        compared.element_um.to_string(),
        compared.nodes.to_string(),
        format!("{setup_s:.3} + {cycle_s:.3}"),
        theirs,
        ratio,
        format!("{ours_use:.4} / {theirs_use:.4}"),
    ]
}

fn line(prediction: &Prediction) -> String {
    let pair = |pair: &Pair| {
        let (expected, measured) = (pair.expected, pair.measured);
        format!(
            "{} {expected:.2} / {measured:.2} = {:.2}",
            pair.what,
            pair.ratio()
        )
    };
    let pairs: Vec<String> = prediction.pairs.iter().map(pair).collect();
    let percent = 100.0 * prediction.tolerance;
    format!("{} at {percent} %: {}", prediction.scene, pairs.join(", "))
}
