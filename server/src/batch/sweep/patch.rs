//! Changes of a submitted specification at JSON pointers (RFC 6901) into the resolved one.

use serde_json::Value;

/// Sets the value at a pointer into the resolved specification. A list, a variant or a material on the way that the document leaves
/// out is first copied from the resolved specification, of a variant its kind: a single value does not describe it.
pub(super) fn set(
    document: &mut Value,
    resolved: &Value,
    pointer: &str,
    value: Value,
) -> Result<(), &'static str> {
    let Some(tokens) = pointer.strip_prefix('/') else {
        return Err("not a JSON pointer such as `/load/n`");
    };
    for (end, _) in pointer.match_indices('/').skip(1) {
        let parent = &pointer[..end];
        if document.pointer(parent).is_some_and(is_container) {
            continue;
        }
        if let Some(whole) = resolved
            .pointer(parent)
            .and_then(|of| indivisible(parent, of))
        {
            set(document, resolved, parent, whole)?;
        }
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

fn is_container(value: &Value) -> bool {
    value.is_object() || value.is_array()
}

/// The part of a value of the resolved specification without which one of its members is meaningless: a list and a material as they are,
/// of a variant the field that selects it. Its other fields have the same defaults again.
fn indivisible(pointer: &str, value: &Value) -> Option<Value> {
    if value.is_array() || pointer.starts_with("/materials/") {
        return Some(value.clone());
    }
    let selects =
        |(name, _): &(&String, &Value)| ["kind", "law", "dimension"].contains(&name.as_str());
    let selecting = value.as_object()?.iter().filter(selects);
    let selecting: serde_json::Map<_, _> = selecting
        .map(|(name, value)| (name.clone(), value.clone()))
        .collect();
    (!selecting.is_empty()).then_some(Value::Object(selecting))
}
