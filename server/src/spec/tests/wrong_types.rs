//! Values of wrong types at every field of specifications.

use api::spec::{ParseError, SystemKind, pointer_token};
use serde_json::{Value, json};

use super::accepted;
use crate::spec::{Refused, read};

/// Words of the program, which an engineer does not read.
const PROGRAM_WORDS: [&str; 8] = [
    "f64",
    "u64",
    "u32",
    "struct ",
    "sequence",
    "variant",
    "untagged",
    "invalid type",
];

/// Every pointer of a document.
fn all_pointers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    found.push(pointer.to_owned());
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                all_pointers(value, &format!("{pointer}/{}", pointer_token(key)), found);
            }
        }
        Value::Array(values) => {
            for (index, value) in values.iter().enumerate() {
                all_pointers(value, &format!("{pointer}/{index}"), found);
            }
        }
        _ => {}
    }
}

/// Asserts that a refusal names the pointer of the wrong value, or one below it, in words.
fn check(error: &ParseError, pointer: &str) {
    assert!(error.pointer.starts_with(pointer), "{pointer}: {error}");
    let others = error.others.iter().map(|fault| &fault.detail);
    for detail in others.chain([&error.detail]) {
        let is_of_program = PROGRAM_WORDS.iter().any(|word| detail.contains(word));
        assert!(!is_of_program, "{pointer}: {detail}");
    }
}

#[test]
fn a_value_of_a_wrong_type_is_refused_in_words_at_every_field() {
    let mut refusals = 0;
    for kind in SystemKind::ALL {
        let resolved = accepted(&format!(r#"{{"system":{{"kind":"{}"}}}}"#, kind.as_str()));
        let mut document = serde_json::to_value(&resolved.spec).expect("writable");
        let fields = document.as_object_mut();
        fields.expect("an object").remove("provenance");
        let mut pointers = Vec::new();
        all_pointers(&document, "", &mut pointers);
        for pointer in &pointers {
            for wrong in [
                json!("0.5 N"),
                json!(true),
                json!(-0.5),
                json!({}),
                json!([]),
            ] {
                let mut changed = document.clone();
                *changed.pointer_mut(pointer).expect("it is there") = wrong;
                let text = changed.to_string();
                if let Err(Refused::Parse(error)) = read(text.as_bytes()) {
                    check(&error, pointer);
                    refusals += 1;
                }
            }
        }
    }
    assert!(refusals > 500, "{refusals}");
}

#[test]
fn a_byte_order_mark_is_no_part_of_the_document() {
    let text = "\u{feff}{\"system\": {\"kind\": \"dimm\"}";
    accepted(&format!("{text}}}"));
    let Err(Refused::Parse(error)) = read(text.as_bytes()) else {
        panic!("it is not complete");
    };
    assert_eq!((error.line, error.column), (1, 27), "{error}");
}
