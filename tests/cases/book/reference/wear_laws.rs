//! The page of the wear laws, from their definitions.

use std::fmt::Write;

use api::spec::{Provenance, WearLawName};
use server::spec::law::{Absent, ByFriction, LawDefinition, Number, Scaling, State, definition};

use super::{cell, number};

const HEAD: &str = "# Wear laws and their fields

h is the worn depth, dh its increment, p the pressure, |ds| the slip, v the speed, mu the coefficient of friction, R the gas constant, []+
the positive part.
[Which wear law?](../guide/wear-laws.md) chooses a law, [Wear laws](../theory/wear-laws.md) has sources and ranges, and
[WearLaw](fields.md#wearlaw) the meaning and unit of each field. Every law takes `measured_at_hz` too.

| law | worn depth | rate depends on, besides pressure and slip | wears layers of platings |
| --- | --- | --- | --- |
";

/// States in words, the friction among them.
fn states(law: &LawDefinition) -> String {
    let states = law.states.iter().map(|state| match state {
        State::Depth => "worn depth",
        State::Speed => "speed",
        State::Time => "time",
        State::Repetitions => "repetitions",
        State::Temperature => "temperature",
    });
    let friction = match law.friction {
        ByFriction::Independent => None,
        ByFriction::Proportional => Some("friction, in proportion"),
        ByFriction::Growing => Some("friction"),
    };
    let states: Vec<&str> = states.chain(friction).collect();
    states.join(", ")
}

fn absent(number: &Number) -> String {
    match &number.absent {
        Absent::Required(_) => "required".to_owned(),
        Absent::Default(value, Provenance::Assumed) => format!("{value} (assumed)"),
        Absent::Default(value, _) => value.to_string(),
        Absent::Other(words) => (*words).to_owned(),
    }
}

fn scaling(scaling: Option<Scaling>) -> &'static str {
    match scaling {
        None => "",
        Some(Scaling::Proportional) => "in proportion",
        Some(Scaling::Inverse) => "in inverse proportion",
        Some(Scaling::Power(_)) => "with a power, the exponent of time or repetitions",
    }
}

fn fields(name: WearLawName, page: &mut String) {
    let law = definition(name);
    writeln!(
        page,
        "\n## {}\n\n| field | symbol | values | if left out | changes with the wear coefficient |\n| --- | --- | --- | --- | --- |",
        name.as_str()
    )
    .expect("a text grows");
    for choice in law.choices {
        writeln!(
            page,
            "| `{choice}` | | [names](fields.md#wearlaw) | required | |"
        )
        .expect("a text grows");
    }
    for field in law.numbers() {
        let (from, to) = (number(*field.range.start()), number(*field.range.end()));
        writeln!(
            page,
            "| `{}` | {} | {from} to {to} | {} | {} |",
            field.field,
            field.symbol,
            absent(field),
            scaling(field.scaling)
        )
        .expect("a text grows");
    }
}

pub(super) fn page() -> String {
    let mut page = HEAD.to_owned();
    for name in WearLawName::ALL {
        let law = definition(name);
        let layers = if law.states.is_empty() { "yes" } else { "no" };
        let (name, formula) = (name.as_str(), cell(law.formula));
        let states = states(law);
        writeln!(
            page,
            "| [`{name}`](#{name}) | {formula} | {states} | {layers} |"
        )
        .expect("a text grows");
    }
    for name in WearLawName::ALL {
        fields(name, &mut page);
    }
    page
}
