//! Every channel of the engine's reports reaches every format, without an edit outside of its table.

use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::record::RowAccessor;
use serde_json::{Value, json};
use solver::record::{
    Channel, Channels, CycleReport, Record, ResistanceReport, SideReport, TemperatureReport,
};

use crate::export::thin::FEWEST_POINTS;
use crate::export::{csv, history, parquet, pictures, thin};
use crate::http::openapi::document;

/// A value that no other channel has, in one row of a hundred.
const PEAK: f64 = 0.375;
const PEAK_ROW: usize = 42;
const PEAK_CYCLE: u64 = 42;

/// A channel where documents have it.
struct DocumentChannel {
    side: Option<&'static str>,
    name: &'static str,
    curve: &'static str,
    schema: &'static str,
    /// The object of a row that has it, where that is not the row or a side.
    part: Option<&'static str>,
    is_required: bool,
}

impl DocumentChannel {
    fn new<R>(side: Option<&'static str>, schema: &'static str) -> impl Fn(&Channel<R>) -> Self {
        move |channel| Self {
            side,
            name: channel.name,
            curve: channel.curve,
            schema,
            part: None,
            is_required: true,
        }
    }

    /// The object that has the channel as a field, in a row.
    fn holder_in_row<'a>(&self, row: &'a mut Value) -> &'a mut Value {
        match self.part {
            Some(part) => &mut row[part],
            None => self.holder(row),
        }
    }

    /// The same in a wear history.
    fn holder<'a>(&self, document: &'a mut Value) -> &'a mut Value {
        match self.side {
            Some(side) => &mut document[side],
            None => document,
        }
    }

    /// Reports in which only this channel differs from 0, in one row; read from JSON as from a store.
    fn reports(&self) -> Vec<CycleReport> {
        let report = |cycle: u64| {
            let report = CycleReport {
                cycle,
                resistance: self.part.map(|_| ResistanceReport::default()),
                temperature: self.part.map(|_| TemperatureReport::default()),
                ..CycleReport::default()
            };
            let mut row = json!(report);
            if cycle == PEAK_CYCLE {
                self.holder_in_row(&mut row)[self.name] = PEAK.into();
            }
            serde_json::from_value(row).expect("a report")
        };
        (0..100).map(report).collect()
    }

    fn header(&self) -> String {
        let side = self
            .side
            .map_or_else(String::new, |side| format!("{side}_"));
        side + self.name
    }
}

fn channels() -> Vec<DocumentChannel> {
    let sides = ["receptacle", "slider"].map(|side| {
        let found = DocumentChannel::new(Some(side), "SideSeries");
        SideReport::CHANNELS.iter().map(found).collect::<Vec<_>>()
    });
    let contact = DocumentChannel::new(None, "WearHistory");
    let contact = CycleReport::CHANNELS.iter().map(contact);
    let resistance = ResistanceReport::CHANNELS
        .iter()
        .map(|channel| DocumentChannel {
            part: Some("resistance"),
            is_required: false,
            ..DocumentChannel::new(None, "WearHistory")(channel)
        });
    let temperature = TemperatureReport::CHANNELS
        .iter()
        .map(|channel| DocumentChannel {
            part: Some("temperature"),
            is_required: false,
            ..DocumentChannel::new(None, "WearHistory")(channel)
        });
    let contact = contact.chain(resistance).chain(temperature);
    sides.into_iter().flatten().chain(contact).collect()
}

#[test]
fn every_channel_is_in_the_rows_and_the_document() {
    for channel in channels() {
        let reports = channel.reports();
        let mut row = json!(reports[PEAK_ROW]);
        assert_eq!(channel.holder_in_row(&mut row)[channel.name], json!(PEAK));
        let mut document = json!(history::wear_history(Record::new(&reports, &[])));
        let column = &channel.holder(&mut document)[channel.name];
        assert_eq!(column[PEAK_ROW], json!(PEAK), "{}", channel.header());
        assert_eq!(column.as_array().map(Vec::len), Some(100));
    }
}

#[test]
fn every_channel_is_a_column_of_the_tables() {
    for channel in channels() {
        let (record, header) = (Record::new(&channel.reports(), &[]), channel.header());
        let text = csv::wear_history(&record).expect("a table");
        let mut table = ::csv::Reader::from_reader(&text[..]);
        let mut headers = table.headers().expect("headers").iter();
        let index = headers.position(|found| found == header);
        let index = index.unwrap_or_else(|| panic!("{header} is a column"));
        let row = table.records().nth(PEAK_ROW).expect("a row").expect("text");
        assert_eq!(row[index], PEAK.to_string());
        let bytes = parquet::wear_history(&record).expect("a table");
        let table = SerializedFileReader::new(axum::body::Bytes::from(bytes)).expect("a file");
        let schema = table.metadata().file_metadata().schema_descr_ptr();
        assert_eq!(schema.column(index).name(), header);
        let mut rows = table.get_row_iter(None).expect("rows");
        let row = rows.nth(PEAK_ROW).expect("a row").expect("values");
        assert!((row.get_double(index).expect("a number") - PEAK).abs() < 1e-15);
    }
}

#[test]
fn thinning_selects_the_peak_of_every_channel() {
    for channel in channels() {
        let rows = thin::rows(channel.reports(), FEWEST_POINTS);
        assert_eq!(rows.len(), FEWEST_POINTS);
        assert!(
            rows.iter().any(|row| row.cycle == PEAK_CYCLE),
            "{}",
            channel.header()
        );
    }
}

#[test]
fn channels_with_a_curve_are_drawn() {
    for channel in channels() {
        let record = Record::new(&channel.reports(), &[]);
        let pictures = pictures::run::pictures("", &record, &[]);
        let series = &pictures[0].1.panels[0].series;
        let labels: Vec<&str> = series.iter().map(|series| series.label.as_str()).collect();
        let expected = format!("{}, {}", channel.side.unwrap_or("contact"), channel.curve);
        let drawn = !channel.curve.is_empty();
        assert_eq!(
            labels,
            if drawn {
                vec![expected.as_str()]
            } else {
                vec![]
            }
        );
    }
}

#[test]
fn every_channel_is_described() {
    for channel in channels() {
        let schema = &document()["components"]["schemas"][channel.schema];
        assert_eq!(schema["properties"][channel.name]["type"], "array");
        let required = schema["required"].as_array().expect("a list");
        assert_eq!(
            required.contains(&channel.name.into()),
            channel.is_required,
            "{}",
            channel.header()
        );
    }
}

#[test]
fn a_run_whose_resistance_and_heat_are_not_computed_has_no_columns_of_them() {
    let reports = vec![CycleReport::default(); 3];
    let document = json!(history::wear_history(Record::new(&reports, &[])));
    let resistance = ResistanceReport::CHANNELS
        .iter()
        .map(|channel| channel.name);
    let temperature = TemperatureReport::CHANNELS
        .iter()
        .map(|channel| channel.name);
    for name in resistance.chain(temperature) {
        assert!(document[name].is_null(), "{name}");
    }
}
