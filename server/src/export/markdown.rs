//! Tables in Markdown, as text reports and the command line print them.

use comfy_table::{CellAlignment, Row, Table};

/// Returns a table without rows; the columns after the first `left` ones are right-aligned.
pub fn table(header: impl Into<Row>, left: usize) -> Table {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header(header);
    for column in table.column_iter_mut().skip(left) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
