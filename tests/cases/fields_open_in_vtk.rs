//! Requirement: displacement, stress, von Mises and mesh quality at the requested cycles and positions as VTU, checked
//! with an independent reader (the Python package `vtk`).

use std::path::Path;
use std::process::Command;

use tests::fretwear;

const SPEC: &str = r#"{
  "system": {"kind": "cylinder_on_flat"},
  "cycles": 20,
  "output": {"fields": true, "snapshots_at_cycles": [20]}
}"#;

/// A ring of wire and the crowned spring of a memory card.
const ALONG_A_LINE: [&str; 2] = [
    r#"{
  "system": {"kind": "fuzz_button"},
  "model": {"dimension": "ring", "outer_diameter_mm": 1.016, "top": "rigid"},
  "load": {"kind": "force", "n": 0.5},
  "accuracy": {"preset": "draft"},
  "cycles": 2,
  "output": {"fields": true, "snapshots_at_cycles": [2]}
}"#,
    r#"{
  "system": {"kind": "sd_card"},
  "model": {"dimension": "line", "width_mm": 0.8, "crown_radius_mm": 10},
  "load": {"kind": "force", "n": 0.5},
  "accuracy": {"preset": "draft"},
  "cycles": 2,
  "output": {"fields": true, "snapshots_at_cycles": [2]}
}"#,
];

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

/// Adds the range of the volumes of all cells, and the vertical force of the pressure on the receptacle, whose cells have y up as their third side.
const VOLUMES: &str = r#"
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
size = vtkCellSizeFilter()
size.SetInputData(grid)
size.Update()
print("volume", *size.GetOutput().GetCellData().GetArray("Volume").GetRange())
pressure = grid.GetPointData().GetArray("contact_pressure_mpa")
body = grid.GetCellData().GetArray("body")
force = 0.0
for i in range(grid.GetNumberOfCells()):
    if body.GetValue(i) == 0:
        continue
    cell = grid.GetCell(i)
    for side in ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
        nodes = [cell.GetPointId(k) for k in side]
        carried = [pressure.GetValue(node) for node in nodes]
        if max(carried) > 0:
            a, b, c, d = (grid.GetPoint(node) for node in nodes)
            area = (c[2] - a[2]) * (d[0] - b[0]) - (c[0] - a[0]) * (d[2] - b[2])
            force += 0.5 * abs(area) * sum(carried) / 4
print("force", force, 0)
"#;

/// The source's wire in four layers between free ends.
const EXTRUDED: &str = r#"{
  "system": {"kind": "fuzz_button"},
  "model": {"dimension": "extruded", "width_mm": 0.01058, "layers": 4, "layer_growth": 1.5, "ends": "free"},
  "load": {"kind": "line_force", "n_per_mm": 0.508},
  "accuracy": {"preset": "draft"},
  "cycles": 2,
  "output": {"fields": true, "snapshots_at_cycles": [2]}
}"#;

/// Adds the volumes of both bodies, and the largest difference of a point from its mirror image at z = 0, of stresses over the highest and of
/// displacements over the farthest.
const HALVES: &str = r#"
volumes = size.GetOutput().GetCellData().GetArray("Volume")
for mark, name in ((0, "slider_mm3"), (1, "receptacle_mm3")):
    cells = range(grid.GetNumberOfCells())
    print(name, sum(volumes.GetValue(i) for i in cells if body.GetValue(i) == mark), 0)
data = grid.GetPointData()
names = ["stress_xx_mpa", "stress_yy_mpa", "stress_zz_mpa", "stress_xy_mpa", "stress_xz_mpa", "stress_yz_mpa"]
arrays = [data.GetArray(name) for name in names]
signs = [1, 1, 1, 1, -1, -1]
moved = data.GetArray("displacement_mm")
marks = [None] * grid.GetNumberOfPoints()
for i in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(i)
    for k in range(8):
        marks[cell.GetPointId(k)] = body.GetValue(i)
points = {(marks[i], *grid.GetPoint(i)): i for i in range(grid.GetNumberOfPoints())}
highest, farthest, stress, displacement = 0.0, 0.0, 0.0, 0.0
for (mark, x, y, z), i in points.items():
    j = points[(mark, x, y, -z)]
    for sign, array in zip(signs, arrays):
        stress = max(stress, abs(array.GetValue(i) - sign * array.GetValue(j)))
        highest = max(highest, abs(array.GetValue(i)))
    for a, b, sign in zip(moved.GetTuple(i), moved.GetTuple(j), (1, 1, -1)):
        displacement = max(displacement, abs(a - sign * b))
        farthest = max(farthest, abs(a))
print("asymmetry", stress / highest, displacement / farthest)
print("mirrored", len(points), grid.GetNumberOfPoints())
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
        let output = read(&file, READER);
        let range = |array: &str| range(&output, array);
        assert!(range("points").0 > 1000.0 && range("cells").0 > 1000.0);
        assert_eq!(range("body"), (0.0, 1.0));
        assert!(range("quality").0 > 0.5 && range("quality").1 <= 1.0 + 1e-12);
        // Below the contact von Mises peaks at 0.56 p0 = 184 MPa without friction, higher with it.
        let highest = range("von_mises_mpa").1;
        assert!((170.0..700.0).contains(&highest), "{name}: {highest}");
        assert!(range("stress_yy_mpa").0 < -200.0 && range("displacement_mm").1 > 0.0);
    }
}

/// The sections of a ring are joined by straight edges, which take 1.6 % of its length and force in 20 sections; walls
/// take another hundredth of the vertical force by friction.
#[test]
#[cfg_attr(not(has_vtk), ignore = "needs the Python package vtk")]
fn fields_along_a_line_open_in_vtk() {
    for spec in ALONG_A_LINE {
        let folder = tempfile::tempdir().expect("a folder can be made");
        std::fs::write(folder.path().join("spec.json"), spec).expect("a file can be written");
        let ran = fretwear(folder.path(), &["solve", "spec.json", "--out", "results"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let results = folder.path().join("results");
        for name in ["fields-0", "fields-2-rightmost", "fields-2-leftmost"] {
            assert!(results.join(format!("{name}.vtu")).is_file(), "{name}");
        }
        let output = read(&results.join("fields-2.vtu"), &format!("{READER}{VOLUMES}"));
        let range = |array: &str| range(&output, array);
        let bytes = std::fs::read(results.join("fields-2.vtu"))
            .expect("a file")
            .len();
        println!("fields-2.vtu: {bytes} bytes, {} nodes", range("points").0);
        assert!(range("points").0 > 10_000.0 && range("cells").0 > 10_000.0);
        assert_eq!(range("body"), (0.0, 1.0));
        assert!(range("quality").0 > 0.5, "{output}");
        assert!(range("volume").0 > 0.0, "{output}");
        assert!(range("von_mises_mpa").1 > 100.0, "{output}");
        assert!((range("force").0 / 0.5 - 1.0).abs() < 0.03, "{output}");
        let picture = std::fs::read_to_string(results.join("maps-2.svg")).expect("a picture");
        assert!(picture.contains("pressure (MPa)"));
        assert!(results.join("maps-2.json").is_file());
    }
}

/// Both halves of the width are there, mirror images to the bit. The receptacle has the volume of the block, of which two cycles wear 0.06 %, the
/// slider that of its half circle, of which the chords between its nodes take 0.25 %, and the pressure carries the force to 1 %.
#[test]
#[cfg_attr(not(has_vtk), ignore = "needs the Python package vtk")]
fn fields_of_extruded_bodies_open_in_vtk() {
    const WIDTH: f64 = 0.010_58;
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), EXTRUDED).expect("a file can be written");
    let ran = fretwear(folder.path(), &["solve", "spec.json", "--out", "results"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let results = folder.path().join("results");
    for name in [
        "fields-0",
        "fields-2",
        "fields-2-rightmost",
        "fields-2-leftmost",
    ] {
        let file = results.join(format!("{name}.vtu"));
        let output = read(&file, &format!("{READER}{VOLUMES}{HALVES}"));
        let range = |array: &str| range(&output, array);
        let bytes = std::fs::metadata(&file).expect("a file").len();
        println!("{name}.vtu: {bytes} bytes, {} nodes", range("points").0);
        assert_eq!(range("body"), (0.0, 1.0));
        assert_eq!(range("mirrored").0.to_bits(), range("mirrored").1.to_bits());
        assert_eq!(range("asymmetry"), (0.0, 0.0));
        assert!(
            range("volume").0 > 0.0 && range("quality").0 > 0.5,
            "{output}"
        );
        let block = 0.084_67 * 0.0635 * WIDTH;
        assert!((range("receptacle_mm3").0 / block - 1.0).abs() < 1e-3);
        let wire = 0.5 * std::f64::consts::PI * 0.0254_f64.powi(2) * WIDTH;
        assert!((range("slider_mm3").0 / wire - 1.0).abs() < 3e-3);
        assert!(
            (range("force").0 / (0.508 * WIDTH) - 1.0).abs() < 0.01,
            "{output}"
        );
        assert!(range("von_mises_mpa").1 > 100.0);
        for name in [
            "worn_depth_mm",
            "contact_pressure_mpa",
            "contact_shear_mpa",
            "largest_shear_mpa",
        ] {
            assert!(range(name).1.is_finite(), "{name}");
        }
    }
}

/// Output of a program of the reader for a file.
fn read(file: &Path, program: &str) -> String {
    let read = Command::new(env!("FRETWEAR_PYTHON"))
        .args(["-c", program])
        .arg(file)
        .output()
        .expect("the reader can be started");
    let errors = String::from_utf8_lossy(&read.stderr);
    assert!(read.status.success(), "{errors}");
    String::from_utf8_lossy(&read.stdout).into_owned()
}

/// The two numbers printed of an array.
fn range(output: &str, array: &str) -> (f64, f64) {
    let mut lines = output.lines();
    let line = lines
        .find(|line| line.split(' ').next() == Some(array))
        .unwrap_or_else(|| panic!("{array} is missing: {output}"));
    let numbers = line.split(' ').skip(1);
    let mut numbers = numbers.map(|number| number.parse().expect("the reader prints numbers"));
    (
        numbers.next().expect("two numbers"),
        numbers.next().expect("two numbers"),
    )
}
