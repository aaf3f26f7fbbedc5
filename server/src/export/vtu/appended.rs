//! The part of VTK's XML format that `vtkio` does not write: arrays as compressed bytes behind the XML, which text would make a third longer.
//!
//! An array is cut into blocks, each compressed by zlib. Before them stand, as 64-bit numbers, how many there are, the length of a block, that of a
//! last one that is shorter (0 if none is), and the compressed length of each.

use std::fmt::Write as _;
use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Bytes of a block before compression.
const BLOCK: usize = 1 << 17;
/// Level of zlib. Level 6 takes three times as long for files 4 % smaller.
const LEVEL: u32 = 3;

/// Values of an array.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
    /// Single precision.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
    /// Numbers of nodes.
    I32(Vec<i32>),
    /// Marks.
    U8(Vec<u8>),
}

/// A named array.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Array {
    pub(super) name: &'static str,
    /// Values of a node or cell.
    pub(super) components: usize,
    pub(super) values: Values,
}

/// An unstructured grid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid {
    pub(super) nodes: usize,
    pub(super) cells: usize,
    pub(super) points: Array,
    /// Connectivity, offsets and types of the cells.
    pub(super) topology: Vec<Array>,
    pub(super) point_data: Vec<Array>,
    pub(super) cell_data: Vec<Array>,
}

/// The file of a grid.
///
/// # Errors
/// The error of the compressor.
pub(super) fn file(grid: &Grid) -> std::io::Result<Vec<u8>> {
    let (mut head, mut data) = (String::new(), Vec::new());
    let mut section = |name: &str, arrays: &[Array]| -> std::io::Result<()> {
        // Writing to a string cannot fail.
        let _ = writeln!(head, "      <{name}>");
        for array in arrays {
            let Array {
                name, components, ..
            } = array;
            let kind = array.values.kind();
            let offset = data.len();
            let _ = writeln!(
                head,
                "        <DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>"
            );
            append(&array.values.bytes(), &mut data)?;
        }
        let _ = writeln!(head, "      </{name}>");
        Ok(())
    };
    section("PointData", &grid.point_data)?;
    section("CellData", &grid.cell_data)?;
    section("Points", std::slice::from_ref(&grid.points))?;
    section("Cells", &grid.topology)?;
    let (nodes, cells) = (grid.nodes, grid.cells);
    let mut file = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  \
         <UnstructuredGrid>\n    \
         <Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\">\n\
         {head}    \
         </Piece>\n  \
         </UnstructuredGrid>\n  \
         <AppendedData encoding=\"raw\">\n_"
    )
    .into_bytes();
    file.append(&mut data);
    file.extend_from_slice(b"\n  </AppendedData>\n</VTKFile>\n");
    Ok(file)
}

impl Values {
    /// Name of the type.
    fn kind(&self) -> &'static str {
        match self {
            Self::F32(_) => "Float32",
            Self::F64(_) => "Float64",
            Self::I32(_) => "Int32",
            Self::U8(_) => "UInt8",
        }
    }

    /// The values, the lowest byte of each first.
    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::F32(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::F64(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::I32(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::U8(values) => values.clone(),
        }
    }
}

/// Appends the blocks of an array.
fn append(bytes: &[u8], data: &mut Vec<u8>) -> std::io::Result<()> {
    let blocks = bytes.chunks(BLOCK).map(compressed);
    let blocks = blocks.collect::<std::io::Result<Vec<_>>>()?;
    let lengths = [blocks.len(), BLOCK, bytes.len() % BLOCK];
    for length in lengths.into_iter().chain(blocks.iter().map(Vec::len)) {
        data.extend_from_slice(&u64::try_from(length).unwrap_or(u64::MAX).to_le_bytes());
    }
    data.extend(blocks.into_iter().flatten());
    Ok(())
}

fn compressed(block: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::with_capacity(BLOCK / 2), Compression::new(LEVEL));
    encoder.write_all(block)?;
    encoder.finish()
}
