//! Fields inside the bodies as VTU files (VTK's XML format for unstructured grids), for ParaView and similar programs.
//!
//! One file holds both bodies at one position: the nodes of the undeformed, worn bodies (mm), the displacement as a
//! vector to warp them by, stresses in MPa. Of a contact along a line or a width it holds the swept bodies (`swept`).

mod appended;
mod planes;
mod swept;

use solver::fields::{BodyFields, Stress};
use solver::mesh::columns::Cell;
use solver::record::{LineFields, PlacedFields, Position};
use vtkio::model::{
    Attribute, Attributes, ByteOrder, CellType, Cells, DataArray, DataSet, UnstructuredGridPiece,
    Version, VertexNumbers, Vtk,
};

use crate::export::history::count;

/// The fields could not be written as VTU.
#[derive(Debug, thiserror::Error)]
pub enum VtuError {
    /// Writing a section failed.
    #[error("the fields cannot be written as VTU: {0}")]
    Section(#[from] vtkio::Error),
    /// Writing a line failed.
    #[error("the fields along the line cannot be written as VTU: {0}")]
    Line(#[from] std::io::Error),
}

/// Content of the file of the fields at one position.
///
/// # Errors
/// [`VtuError`] if the writer fails.
pub fn bytes(fields: &PlacedFields) -> Result<Vec<u8>, VtuError> {
    let bodies = [&fields.slider, &fields.receptacle];
    let piece = UnstructuredGridPiece {
        points: collect(bodies, |body| {
            body.nodes.iter().flat_map(|n| [n[0], n[1], 0.0])
        })
        .into(),
        cells: cells(bodies),
        data: Attributes {
            point: point_data(bodies),
            cell: cell_data(bodies),
        },
    };
    let vtk = Vtk {
        version: Version::Auto,
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        data: DataSet::inline(piece),
        file_path: None,
    };
    let mut bytes = Vec::new();
    vtk.write_xml(&mut bytes)?;
    Ok(bytes)
}

/// Content of the file of the fields along a line at one position.
///
/// # Errors
/// [`VtuError`] if the writer fails.
pub fn line_bytes(fields: &LineFields) -> Result<Vec<u8>, VtuError> {
    Ok(swept::bytes(fields)?)
}

/// Name of the file of a cycle and position; the neutral position has no suffix.
pub fn file_name(cycle: u64, position: Position) -> String {
    match position {
        Position::Neutral => format!("fields-{cycle}.vtu"),
        Position::Rightmost => format!("fields-{cycle}-rightmost.vtu"),
        Position::Leftmost => format!("fields-{cycle}-leftmost.vtu"),
    }
}

fn collect<'a, I: Iterator<Item = f64>>(
    bodies: [&'a BodyFields; 2],
    values: impl Fn(&'a BodyFields) -> I,
) -> Vec<f64> {
    bodies.into_iter().flat_map(values).collect()
}

fn cells(bodies: [&BodyFields; 2]) -> Cells {
    let (mut connectivity, mut offsets, mut types) = (Vec::new(), Vec::new(), Vec::new());
    let mut first = 0;
    for body in bodies {
        for cell in &body.cells {
            let (nodes, kind): (&[usize], _) = match cell {
                Cell::Quad(nodes) => (nodes, CellType::Quad),
                Cell::Tri(nodes) => (nodes, CellType::Triangle),
            };
            connectivity.extend(nodes.iter().map(|node| count(first + node)));
            offsets.push(count(connectivity.len()));
            types.push(kind);
        }
        first += body.nodes.len();
    }
    let cell_verts = VertexNumbers::XML {
        connectivity,
        offsets,
    };
    Cells { cell_verts, types }
}

fn point_data(bodies: [&BodyFields; 2]) -> Vec<Attribute> {
    let scalars = |name: &str, value: fn(&Stress) -> f64| {
        let values = collect(bodies, |body| body.stress.iter().map(value));
        Attribute::DataArray(DataArray::scalars(name, 1).with_vec(values))
    };
    let displacement = collect(bodies, |body| {
        body.displacement_mm.iter().flat_map(|u| [u[0], u[1], 0.0])
    });
    vec![
        Attribute::DataArray(DataArray::vectors("displacement_mm").with_vec(displacement)),
        scalars("stress_xx_mpa", |s| s.xx),
        scalars("stress_yy_mpa", |s| s.yy),
        scalars("stress_zz_mpa", |s| s.zz),
        scalars("stress_xy_mpa", |s| s.xy),
        scalars("von_mises_mpa", Stress::von_mises),
        scalars("largest_shear_mpa", Stress::largest_shear),
    ]
}

fn cell_data(bodies: [&BodyFields; 2]) -> Vec<Attribute> {
    let quality = collect(bodies, |body| body.quality.iter().copied());
    let marks = [0.0, 1.0].into_iter().zip(bodies);
    let body: Vec<f64> = marks
        .flat_map(|(mark, body)| body.cells.iter().map(move |_| mark))
        .collect();
    vec![
        Attribute::DataArray(DataArray::scalars("body", 1).with_vec(body)),
        Attribute::DataArray(DataArray::scalars("quality", 1).with_vec(quality)),
    ]
}
