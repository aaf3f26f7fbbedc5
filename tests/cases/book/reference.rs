//! The reference pages: fields of a specification and columns of the wear history from the OpenAPI document, wear laws from their
//! definitions, commands from their help.
//! `FRETWEAR_WRITE_BOOK=1` writes the pages again.

mod combinations;
mod wear_laws;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::process::Command;

use serde_json::Value;

const SCHEMAS: &str = "#/components/schemas/";

fn schemas() -> Value {
    let path = super::house().join("api/openapi.json");
    let text = std::fs::read_to_string(path).expect("the OpenAPI document");
    let document: Value = serde_json::from_str(&text).expect("JSON");
    document["components"]["schemas"].clone()
}

/// Name of the schema that a schema refers to.
fn target(schema: &Value) -> Option<&str> {
    schema["$ref"].as_str()?.strip_prefix(SCHEMAS)
}

/// Schemas of which a value fulfils one.
fn choices(schema: &Value) -> impl Iterator<Item = &Value> {
    let lists = ["oneOf", "anyOf"].into_iter();
    lists.filter_map(|key| schema[key].as_array()).flatten()
}

/// Names of the objects that a value of this schema contains.
fn contained<'a>(schemas: &'a Value, schema: &'a Value) -> Vec<&'a str> {
    if let Some(name) = target(schema) {
        let of_target = contained(schemas, &schemas[name]);
        return std::iter::once(name).chain(of_target).collect();
    }
    let items = schema.get("items").into_iter();
    let inner = items.chain(choices(schema));
    inner.flat_map(|inner| contained(schemas, inner)).collect()
}

/// Text in a cell of a table.
fn cell(text: &str) -> String {
    text.replace('\n', " ").replace('|', "\\|")
}

/// Values that a schema accepts, in words.
fn values(schemas: &Value, schema: &Value) -> String {
    if let Some(name) = target(schema) {
        let target = &schemas[name];
        return if target["properties"].is_object() {
            format!("[{name}](#{})", name.to_lowercase())
        } else {
            values(schemas, target)
        };
    }
    if let Some(names) = schema["enum"].as_array() {
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        return names.join(", ").replace('"', "");
    }
    if let Some(items) = schema.get("items") {
        return format!("list of {}", values(schemas, items));
    }
    let is_value = |choice: &&Value| choice["type"] != "null";
    let choices: Vec<String> = choices(schema)
        .filter(is_value)
        .map(|choice| values(schemas, choice))
        .collect();
    if !choices.is_empty() {
        return choices.join(" or ");
    }
    if let Some(constant) = schema.get("const") {
        return constant.to_string();
    }
    let number = |key: &str| schema[key].as_f64().map(number);
    let kind = match &schema["type"] {
        Value::String(kind) => kind.clone(),
        Value::Array(kinds) => {
            let kinds = kinds.iter().filter_map(Value::as_str);
            kinds
                .filter(|kind| *kind != "null")
                .collect::<Vec<_>>()
                .join(" or ")
        }
        _ => "value".to_owned(),
    };
    match (number("minimum"), number("maximum")) {
        (Some(from), Some(to)) => format!("{kind}, {from} to {to}"),
        (Some(from), None) => format!("{kind}, from {from}"),
        _ => kind,
    }
}

fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e5).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// A section for an object and those that it contains.
fn object(schemas: &Value, name: &str, seen: &mut BTreeSet<String>, page: &mut String) {
    let schema = &schemas[name];
    let Some(fields) = schema["properties"].as_object() else {
        return;
    };
    if !seen.insert(name.to_owned()) {
        return;
    }
    let description = schema["description"].as_str().unwrap_or_default();
    writeln!(
        page,
        "\n## {name}\n\n{description}\n\n| field | values | meaning |\n| --- | --- | --- |"
    )
    .expect("a text grows");
    for (field, schema) in fields {
        let target = target(schema).map_or(&Value::Null, |name| &schemas[name]);
        let described = [schema, target].map(|schema| schema["description"].as_str());
        let meaning = cell(described.into_iter().flatten().next().unwrap_or_default());
        let values = cell(&values(schemas, schema));
        writeln!(page, "| `{field}` | {values} | {meaning} |").expect("a text grows");
    }
    for schema in fields.values() {
        for name in contained(schemas, schema) {
            object(schemas, name, seen, page);
        }
    }
}

fn fields() -> String {
    let schemas = schemas();
    let mut page = "# Fields of a specification\n\nA field that is left out has a default, which the resolved specification in every answer \
                    states with its source.\nUnknown fields are refused.\n"
        .to_owned();
    object(&schemas, "Spec", &mut BTreeSet::new(), &mut page);
    page
}

fn columns() -> String {
    let schemas = schemas();
    let fields = schemas["WearHistory"]["properties"].as_object();
    let mut page = "# Columns of the wear history\n\nThe CSV and Parquet files, the JSON document and the `cycle` events of a job have these columns. A column \
                    that does not\nbelong to a scene is left out.\n\n| column | meaning |\n| --- | --- |\n"
        .to_owned();
    for (field, schema) in fields.expect("columns") {
        let meaning = cell(schema["description"].as_str().unwrap_or_default());
        writeln!(page, "| `{field}` | {meaning} |").expect("a text grows");
    }
    page
}

/// Help of a command, which shows the values of variables of the environment.
fn help(command: &[&str]) -> String {
    let mut program = Command::new(tests::binary());
    program.env_clear().args(command).arg("--help");
    let output = program.output().expect("the program starts");
    assert!(output.status.success(), "{command:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n")
}

/// Names of the subcommands that a help lists.
fn subcommands(help: &str) -> Vec<String> {
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    let names = listed.filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next());
    names
        .filter(|name| *name != "help")
        .map(str::to_owned)
        .collect()
}

/// Adds the help of a command and of its subcommands.
fn command(path: &[&str], page: &mut String) {
    let help = help(path);
    let name = [&["fretwear"], path].concat().join(" ");
    writeln!(page, "\n## {name}\n\n```text\n{help}\n```").expect("a text grows");
    for name in subcommands(&help) {
        command(&[path, &[name.as_str()]].concat(), page);
    }
}

fn commands() -> String {
    let mut page = "# Commands and their options\n\nAn option with `[env: NAME]` is also read from this variable of the environment.\n".to_owned();
    command(&[], &mut page);
    page
}

#[test]
fn reference_pages_are_those_of_the_program() {
    let pages = [
        ("fields", fields()),
        ("wear-laws", wear_laws::page()),
        ("columns", columns()),
        ("combinations", combinations::page()),
        ("commands", commands()),
    ];
    for (name, expected) in pages {
        let path = super::house().join(format!("docs/reference/{name}.md"));
        if std::env::var_os("FRETWEAR_WRITE_BOOK").is_some() {
            std::fs::write(&path, &expected).expect("the page can be written");
        }
        let committed = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            committed == expected,
            "docs/reference/{name}.md is not that of the program; write it with FRETWEAR_WRITE_BOOK=1"
        );
    }
}
