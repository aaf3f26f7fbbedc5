//! Changes of a JSON document at JSON pointers (RFC 6901).

use serde_json::Value;

/// Sets the value at a pointer. Missing objects on the way are created; a missing variant or material, which a single
/// field cannot describe, is copied from the preset.
pub(super) fn set(
    document: &mut Value,
    preset: &Value,
    pointer: &str,
    value: Value,
) -> Result<(), &'static str> {
    let Some(tokens) = pointer.strip_prefix('/') else {
        return Err("not a JSON pointer such as `/load/n`");
    };
    if let Some((parent, _)) = pointer.rsplit_once('/')
        && document.pointer(parent).is_none_or(Value::is_null)
        && let Some(whole) = preset.pointer(parent)
        && is_indivisible(parent, whole)
    {
        set(document, preset, parent, whole.clone())?;
    }
    let mut target = document;
    for token in tokens.split('/') {
        let token = token.replace("~1", "/").replace("~0", "~");
        target = match target {
            Value::Array(items) => token
                .parse::<usize>()
                .ok()
                .and_then(|index| items.get_mut(index))
                .ok_or("there is no such item in the base specification")?,
            Value::Object(fields) => fields.entry(token).or_insert(Value::Null),
            // Indexing replaces a null by an object, and creates the field.
            Value::Null => &mut target[token],
            _ => return Err("a value of the base specification stands where an object is needed"),
        };
    }
    *target = value;
    Ok(())
}

/// Checks whether an object is meaningless in parts: a variant or a material.
fn is_indivisible(pointer: &str, object: &Value) -> bool {
    let variant = object.get("kind").or(object.get("law")).is_some();
    variant || pointer.starts_with("/materials/")
}
