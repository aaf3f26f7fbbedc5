//! Words for values of a wrong type: what was expected, what was found, and how a number is written.

use serde_json::Value;

/// Longest part of a value that a message repeats, characters.
const SHOWN: usize = 60;

/// Rewords a message of serde such as `invalid type: string "0.5 N", expected f64`; returns other messages as they are.
pub(super) fn of_type_error(message: &str) -> String {
    // An object's fields in order, as serde reads them from a list.
    if message.starts_with("invalid length ") && message.contains(", expected struct ") {
        return "expected an object, found a list".to_owned();
    }
    let prefixes = ["invalid type: ", "invalid value: "];
    let rest = prefixes
        .into_iter()
        .find_map(|prefix| message.strip_prefix(prefix));
    // A text may contain the separator, the description of what was expected does not.
    let Some((found, expected)) = rest.and_then(|rest| rest.rsplit_once(", expected ")) else {
        return message.to_owned();
    };
    let expected = match expected {
        "f64" => "a number",
        "a string" => "a text",
        "a sequence" => "a list",
        "a map" => "an object",
        object if object.starts_with("struct ") => "an object",
        other => other,
    };
    let is_number = ["a number", "a count"].contains(&expected);
    let text = found.strip_prefix("string ");
    let advice = text.filter(|_| is_number).map_or("", number_advice);
    format!("expected {expected}, found {}{advice}", found_value(found))
}

/// The value of serde's description.
fn found_value(found: &str) -> String {
    if let Some(text) = found.strip_prefix("string ") {
        return format!("the text {}", shortened(text));
    }
    let quoted = found.split('`').nth(1).unwrap_or(found);
    match found {
        "sequence" => "a list".to_owned(),
        "map" => "an object".to_owned(),
        number if number.starts_with("integer ") || number.starts_with("floating point ") => {
            format!("the number {quoted}")
        }
        _ => quoted.to_owned(),
    }
}

/// How a number in a quoted text is to be written.
fn number_advice(quoted: &str) -> &'static str {
    let text = quoted.trim_matches('"').trim();
    let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let digits = text.trim_start_matches(is_part);
    if !text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
        ""
    } else if digits.is_empty() {
        "; write the number without quotation marks"
    } else {
        "; write the number alone, in the unit of the field's name"
    }
}

/// Names the content of a document that is no object, from its first character that is no space.
pub(super) fn of_document(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return "nothing".to_owned();
    }
    let kind = match serde_json::from_slice(bytes) {
        Ok(Value::Array(_)) => "a list",
        Ok(Value::String(_)) => "a text",
        Ok(Value::Number(_)) => "a number",
        Ok(Value::Bool(_)) => "true or false",
        Ok(_) => "null",
        Err(_) => {
            let text = String::from_utf8_lossy(bytes);
            let line = text.lines().next().unwrap_or_default();
            return format!(
                "`{}`; a document in another language, such as YAML or TOML, must be converted to JSON first (`yq -o json`)",
                shortened(line)
            );
        }
    };
    kind.to_owned()
}

/// The beginning of a text.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}..", &text[..end]),
        None => text.to_owned(),
    }
}
