//! The summary of a solve as an engineer reads it: lives first, then wear, contact, errors and cost.

use api::problem::Fault;
use api::results::{
    BlockSummary, ContactExtent, Initial, LifeEntry, LifeStatus, Quantities, Quantity, SideSummary,
    Summary,
};
use api::spec::Spec;
use comfy_table::Table;

use crate::cli::figures::{rounded, until};
use crate::cli::terminal::{Ended, printable, write_err, write_json, write_out};
use crate::export::markdown;
use crate::spec::is_continuous;

/// How a summary is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Tables,
    Json,
}

impl Format {
    /// The format that the option `--json` selects.
    pub(super) fn json_if(json: bool) -> Self {
        if json { Self::Json } else { Self::Tables }
    }
}

/// Writes the summary of a resolved specification to standard output, and to standard error its warnings that were not said before.
pub(super) fn write(spec: &Spec, summary: &Summary, format: Format, said: &[Fault]) -> Ended {
    match format {
        Format::Json => write_json(summary)?,
        Format::Tables => write_out(text(spec, summary))?,
    }
    let is_new = |warning: &&String| !said.iter().any(|fault| warning.ends_with(&fault.detail));
    for warning in summary.warnings.iter().filter(is_new) {
        write_err(format_args!("fretwear: warning: {warning}"));
    }
    Ok(())
}

/// All tables and lines, with empty lines around tables.
fn text(spec: &Spec, summary: &Summary) -> String {
    let mut parts = vec![end(spec, summary)];
    if !summary.life.is_empty() {
        parts.push(lives(spec, &summary.life).to_string());
        let reasons = reasons(&summary.life);
        parts.extend((!reasons.is_empty()).then_some(reasons));
    }
    parts.push(wear(summary).to_string());
    parts.push(contact(summary).to_string());
    if !summary.mission.is_empty() {
        parts.push(blocks(&summary.mission).to_string());
    }
    let motion = summary.motion.as_ref();
    parts.extend(motion.map(|motion| format!("motion: {}", motion.reason)));
    let cost = &summary.cost;
    parts.push(format!(
        "{}\n{:.2} s, {:.2} s of processor time, {:.0} MiB",
        errors(summary),
        cost.wall_s,
        cost.cpu_s,
        cost.peak_memory_mb
    ));
    parts.join("\n\n")
}

/// Name, system and outcome of the run.
fn end(spec: &Spec, summary: &Summary) -> String {
    let name = spec.name.as_deref().map(printable);
    let name = name.map_or_else(String::new, |name| format!("{}: ", name.replace('\n', " ")));
    // The parts of a continuous motion are no cycles of the user.
    let cycles = if is_continuous(spec) {
        String::new()
    } else {
        format!("{} cycles, ", summary.cycles_done)
    };
    format!(
        "{name}{} after {cycles}{} mm of sliding",
        summary.outcome.as_str(),
        rounded(summary.sliding_distance_mm)
    )
}

/// Lives with their scatter; a continuous motion has millimetres instead of cycles. Columns without a value are left out.
fn lives(spec: &Spec, life: &[LifeEntry]) -> Table {
    let unit = if is_continuous(spec) { "mm" } else { "cycles" };
    let contacts = spec.life.contacts.unwrap_or(1);
    let shares = further_shares(spec);
    let target = spec.life.target_cycles.unwrap_or_default();
    let mut header = vec![
        "life until".to_owned(),
        "side".to_owned(),
        unit.to_owned(),
        "b10".to_owned(),
        "b90".to_owned(),
        format!("first of {contacts}, b10"),
    ];
    header.extend(shares.iter().map(|share| {
        // Without round-off.
        let percent = (1e8 * share).round() / 1e6;
        format!("{percent} % of connectors")
    }));
    header.extend([
        format!("connectors failed by {target}, %"),
        "verdict".to_owned(),
        "repetitions".to_owned(),
        "hours".to_owned(),
        "error, %".to_owned(),
    ]);
    let rows: Vec<_> = life.iter().map(|entry| cells(entry, &shares)).collect();
    let is_filled = |column: &usize| rows.iter().any(|row| !row[*column].is_empty());
    let columns: Vec<usize> = (0..header.len()).filter(is_filled).collect();
    let of_columns = |cells: &Vec<String>| -> Vec<String> {
        let filled = columns.iter().map(|column| cells[*column].clone());
        filled.collect()
    };
    let mut table = markdown::table(of_columns(&header), 2);
    table.add_rows(rows.iter().map(of_columns));
    table
}

/// Shares of the reliability besides nine tenths, which are the column of the first contact.
fn further_shares(spec: &Spec) -> Vec<f64> {
    let shares = spec.life.reliability.iter().flatten().copied();
    shares.filter(|share| (share - 0.9).abs() > 1e-9).collect()
}

/// One life in the columns above.
fn cells(entry: &LifeEntry, shares: &[f64]) -> Vec<String> {
    let band = entry.band.as_ref();
    let reached = match entry.status {
        LifeStatus::Reached => shown(entry.cycles.or(entry.sliding_distance_mm)),
        LifeStatus::NotReached => "not reached".to_owned(),
        LifeStatus::NotModelled => "not modelled".to_owned(),
    };
    let percent = |share: Option<f64>| shown(share.map(|share| 100.0 * share));
    let mut cells = vec![
        until(&entry.criterion),
        entry.side.clone().unwrap_or_default(),
        reached,
        shown(band.map(|band| band.b10)),
        shown(band.map(|band| band.b90)),
        shown(band.map(|band| band.first_of_contacts_b10)),
    ];
    cells.extend(shares.iter().map(|share| {
        let mut at = entry.at_reliability.iter();
        let at = at.find(|at| at.share.to_bits() == share.to_bits());
        shown(at.map(|at| at.of_contacts))
    }));
    cells.extend([
        percent(entry.connectors_failed_at_target),
        entry
            .verdict
            .map_or_else(String::new, |verdict| verdict.as_str().to_owned()),
        shown(entry.repetitions),
        shown(entry.duration_h),
        percent(entry.estimated_relative_error),
    ]);
    cells
}

fn shown(value: Option<f64>) -> String {
    value.map_or_else(String::new, rounded)
}

/// Why lives are missing, or have no scatter.
fn reasons(life: &[LifeEntry]) -> String {
    let lines = life.iter().filter_map(|entry| {
        let side = entry.side.as_ref();
        let side = side.map_or_else(String::new, |side| format!(" ({side})"));
        let reason = entry.reason.as_ref()?;
        Some(format!("{}{side}: {reason}", until(&entry.criterion)))
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn wear(summary: &Summary) -> Table {
    let mut table = markdown::table(["wear", "slider", "receptacle"], 1);
    let sides = [&summary.slider, &summary.receptacle];
    let mut row = |name: String, values: [String; 2]| {
        // A quantity that neither side has is left out.
        if values.iter().any(|value| !value.is_empty()) {
            let [slider, receptacle] = values;
            table.add_row([name, slider, receptacle]);
        }
    };
    for quantity in SideSummary::QUANTITIES {
        row(heading(quantity), sides.map(|side| figure(quantity, side)));
    }
    let over_ideal = sides.map(|side| {
        let ideal = side.ideal_area_mm2.filter(|ideal| *ideal > 0.0);
        shown(ideal.map(|ideal| side.worn_area_mm2 / ideal))
    });
    row("area / (k P s)".to_owned(), over_ideal);
    table
}

fn contact(summary: &Summary) -> Table {
    let mut table = markdown::table(["contact", "unworn", "at the end"], 1);
    let mut row = |name: String, unworn: String, end: String| {
        table.add_row([name, unworn, end]);
    };
    for quantity in Summary::QUANTITIES {
        let mut of_unworn = Initial::QUANTITIES.iter();
        let unworn = of_unworn.find(|unworn| unworn.name == quantity.name);
        let unworn = unworn.map(|unworn| figure(unworn, &summary.initial));
        row(
            heading(quantity),
            unworn.unwrap_or_default(),
            figure(quantity, summary),
        );
    }
    if let Some(extent) = &summary.extent {
        for quantity in ContactExtent::QUANTITIES {
            row(heading(quantity), String::new(), figure(quantity, extent));
        }
    }
    if let Some(resistance) = &summary.contact_resistance_mohm {
        row(
            "resistance, mOhm".to_owned(),
            rounded(resistance.initial),
            rounded(resistance.r#final),
        );
    }
    if let Some(temperature) = &summary.contact_temperature_c {
        row(
            "highest temperature, °C".to_owned(),
            String::new(),
            rounded(temperature.highest),
        );
    }
    table
}

/// Title of a quantity with the unit in which it is shown.
fn heading<P>(quantity: &Quantity<P>) -> String {
    format!("{}, {}", quantity.title, quantity.unit)
}

/// Value of a quantity in that unit; empty where the part has none.
fn figure<P>(quantity: &Quantity<P>, part: &P) -> String {
    shown((quantity.value)(part).map(|value| quantity.factor * value))
}

/// Shares of the blocks of a mission in the wear.
fn blocks(blocks: &[BlockSummary]) -> Table {
    let header = [
        "block",
        "cycles",
        "share of slider's wear, %",
        "of receptacle's, %",
    ];
    let mut table = markdown::table(header, 1);
    for (index, block) in blocks.iter().enumerate() {
        let name = block.extent.name.as_deref().map(printable);
        table.add_row([
            name.map_or_else(|| (index + 1).to_string(), |name| name.replace('\n', " ")),
            block.extent.cycles.to_string(),
            rounded(100.0 * block.slider.share),
            rounded(100.0 * block.receptacle.share),
        ]);
    }
    table
}

fn errors(summary: &Summary) -> String {
    let Some(errors) = &summary.accuracy.errors else {
        return "errors were not estimated".to_owned();
    };
    let resistance = errors.contact_resistance.as_ref();
    let of_quantities = [
        ("worn depth", Some(&errors.worn_depth)),
        ("half-width of the scar", Some(&errors.scar_half_width)),
        ("worn area", Some(&errors.worn_area)),
        ("peak pressure", Some(&errors.peak_pressure)),
        ("contact resistance", resistance),
    ];
    let words = of_quantities
        .into_iter()
        .filter_map(|(name, error)| Some(format!("{name} {} %", rounded(100.0 * error?.relative))));
    format!("estimated errors: {}", words.collect::<Vec<_>>().join(", "))
}
