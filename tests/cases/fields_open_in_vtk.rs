//! Requirement: displacement, stress, von Mises and mesh quality at the requested cycles and positions as VTU, checked
//! with an independent reader (the Python package `vtk`).

use std::process::Command;

use tests::fretwear;

const SPEC: &str = r#"{
  "system": {"kind": "cylinder_on_flat"},
  "cycles": 20,
  "output": {"fields": true, "snapshots_at_cycles": [20]}
}"#;

/// Prints the numbers of points and cells and the lowest and highest value of every array.
const READER: &str = r#"
import sys
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
print("points", grid.GetNumberOfPoints(), 0)
print("cells", grid.GetNumberOfCells(), 0)
for data in (grid.GetPointData(), grid.GetCellData()):
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        print(array.GetName(), *array.GetRange(0))
"#;

#[test]
#[cfg_attr(not(has_vtk), ignore = "needs the Python package vtk")]
fn requested_fields_open_in_vtk() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), SPEC).expect("a file can be written");
    let ran = fretwear(folder.path(), &["solve", "spec.json", "--out", "results"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    for name in [
        "fields-0",
        "fields-20",
        "fields-20-rightmost",
        "fields-20-leftmost",
    ] {
        let file = folder.path().join("results").join(format!("{name}.vtu"));
        let read = Command::new(env!("FRETWEAR_PYTHON"))
            .args(["-c", READER])
            .arg(&file)
            .output()
            .expect("the reader can be started");
        let output = String::from_utf8_lossy(&read.stdout).into_owned();
        let range = |array: &str| -> (f64, f64) {
            let line = output
                .lines()
                .find(|line| line.split(' ').next() == Some(array));
            let mut numbers = line
                .unwrap_or_else(|| panic!("{array} is missing in {name}: {output}"))
                .split(' ')
                .skip(1)
                .map(|number| number.parse::<f64>().expect("the reader prints numbers"));
            (
                numbers.next().expect("two numbers"),
                numbers.next().expect("two numbers"),
            )
        };
        assert!(range("points").0 > 1000.0 && range("cells").0 > 1000.0);
        assert_eq!(range("body"), (0.0, 1.0));
        assert!(range("quality").0 > 0.5 && range("quality").1 <= 1.0 + 1e-12);
        // Below the contact von Mises peaks at 0.56 p0 = 184 MPa without friction, higher with it.
        let highest = range("von_mises_mpa").1;
        assert!((170.0..700.0).contains(&highest), "{name}: {highest}");
        assert!(range("stress_yy_mpa").0 < -200.0 && range("displacement_mm").1 > 0.0);
    }
}
