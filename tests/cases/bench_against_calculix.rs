//! Requirement: `fretwear bench --against ccx` runs one friction cycle on the same mesh through CalculiX and prints the
//! ratio of times beside both tolerances, and both obey the friction law.

use tests::fretwear;

#[test]
#[cfg_attr(not(has_ccx), ignore = "needs the program ccx of CalculiX")]
fn calculix_solves_the_same_cycle() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let arguments = ["bench", "--against", "ccx", "--elements-um", "90"];
    let ran = fretwear(folder.path(), &arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let row = ran.stdout.lines().nth(2).expect("a row");
    let cells: Vec<&str> = row.split('|').map(str::trim).collect();
    let ratio: f64 = cells[5].parse().expect(row);
    assert!(ratio > 1.0, "{row}");
    // |Q| reaches mu P in gross slip, and never passes it; the penalty's slope rounds it off.
    for used in cells[6].split('/') {
        let used: f64 = used.trim().parse().expect(row);
        assert!((0.98..=1.001).contains(&used), "{row}");
    }
    assert!(ran.stdout.contains("Tolerances"), "{}", ran.stdout);
}
