//! Specification and plan of a job whose results were moved to a store of objects: compressed together.

use api::plan::Plan;
use api::spec::Spec;
use serde_json::{Map, Value};
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::compression::{compress, decompress};
use crate::store::rows::corrupt;

/// Largest length of specification and plan, bytes.
const LIMIT: usize = 64 << 20;
/// Members of a specification that lists of jobs show and are searched by.
const LISTED: [&str; 2] = ["name", "labels"];

/// Compresses the texts of a specification and its plan.
pub(in crate::store) fn pack(spec: &str, plan: &str) -> Vec<u8> {
    compress(format!("[{spec},{plan}]").as_bytes())
}

/// Specification and plan.
pub(in crate::store) fn unpack(id: Uuid, packed: &[u8]) -> Result<(Spec, Plan), StoreError> {
    let texts = decompress(packed, LIMIT);
    serde_json::from_slice(&texts).map_err(|cause| corrupt(id, "specification and plan", &cause))
}

/// The part of a specification that stays as it is.
pub(in crate::store) fn listed(id: Uuid, spec: &str) -> Result<String, StoreError> {
    let spec: Map<String, Value> =
        serde_json::from_str(spec).map_err(|cause| corrupt(id, "specification", &cause))?;
    let members = spec.into_iter();
    let listed = members.filter(|(name, _)| LISTED.contains(&name.as_str()));
    Ok(serde_json::to_string(&listed.collect::<Map<_, _>>())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lists_show_stays() {
        let spec = r#"{"name":"a","cycles":2,"labels":{"lot":"7"},"system":{"kind":"dimm"}}"#;
        let kept = listed(Uuid::nil(), spec).expect("read");
        let kept: Value = serde_json::from_str(&kept).expect("JSON");
        assert_eq!(
            kept,
            serde_json::json!({"name": "a", "labels": {"lot": "7"}})
        );
        assert_eq!(listed(Uuid::nil(), "{}").expect("read"), "{}");
    }
}
