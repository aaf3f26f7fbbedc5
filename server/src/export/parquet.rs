//! The wear history as Apache Parquet: the columns of the CSV table, as 64-bit integers and doubles, uncompressed.

use std::sync::Arc;

use ::parquet::basic::{Repetition, Type as Physical};
use ::parquet::data_type::{DoubleType, Int64Type};
use ::parquet::errors::ParquetError as Cause;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::Type;
use solver::record::Record;

use crate::export::columns;
use crate::export::columns::Values;

/// The table could not be written as Parquet.
#[derive(Debug, thiserror::Error)]
#[error("writing Parquet: {0}")]
pub struct ParquetError(#[from] Cause);

/// The wear history, one row per computed cycle.
///
/// # Errors
/// [`ParquetError`] if the writer fails.
pub fn wear_history(record: &Record) -> Result<Vec<u8>, ParquetError> {
    let columns = columns::of(record);
    let properties = Arc::new(WriterProperties::builder().build());
    let mut file = SerializedFileWriter::new(Vec::new(), schema(&columns)?, properties)?;
    let mut rows = file.next_row_group()?;
    for (_, values) in &columns {
        let Some(mut column) = rows.next_column()? else {
            break;
        };
        match values {
            Values::Counts(counts) => {
                let counts: Vec<i64> = counts.iter().map(|count| to_i64(*count)).collect();
                column
                    .typed::<Int64Type>()
                    .write_batch(&counts, None, None)?;
            }
            Values::Numbers(numbers) => {
                column
                    .typed::<DoubleType>()
                    .write_batch(numbers, None, None)?;
            }
        }
        column.close()?;
    }
    rows.close()?;
    Ok(file.into_inner()?)
}

fn schema(columns: &[(String, Values<'_>)]) -> Result<Arc<Type>, Cause> {
    let fields = columns
        .iter()
        .map(|(name, values)| {
            let physical = match values {
                Values::Counts(_) => Physical::INT64,
                Values::Numbers(_) => Physical::DOUBLE,
            };
            Type::primitive_type_builder(name, physical)
                .with_repetition(Repetition::REQUIRED)
                .build()
                .map(Arc::new)
        })
        .collect::<Result<_, _>>()?;
    let root = Type::group_type_builder("wear_history").with_fields(fields);
    Ok(Arc::new(root.build()?))
}

/// A count as Parquet stores it; counts stay far below 2^63.
fn to_i64(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use ::parquet::record::RowAccessor;

    use super::*;
    use crate::http::tests::row;

    #[test]
    fn a_reader_returns_the_same_rows_under_the_same_names() {
        let written = Record::new(&[10, 20].map(row), &[-0.5, 0.0, 0.5]);
        let bytes = wear_history(&written).expect("bytes");
        let reader = SerializedFileReader::new(axum::body::Bytes::from(bytes)).expect("a file");
        let names: Vec<String> = reader
            .metadata()
            .file_metadata()
            .schema_descr()
            .columns()
            .iter()
            .map(|column| column.name().to_owned())
            .collect();
        let expected: Vec<String> = columns::of(&written).into_iter().map(|c| c.0).collect();
        assert_eq!(names, expected);
        let rows: Vec<_> = reader
            .get_row_iter(None)
            .expect("rows")
            .map(|row| row.expect("a row"))
            .collect();
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[1].get_long(0).expect("a count"), 20);
        let middle = names
            .iter()
            .position(|name| name == "receptacle_depth_at_0_mm");
        let depth = rows[1]
            .get_double(middle.expect("a station"))
            .expect("a number");
        assert!((depth - 0.5).abs() < 1e-15);
    }
}
