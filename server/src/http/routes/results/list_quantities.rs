//! `GET /v1/quantities`: the quantities of summaries.

use api::results::QuantityList;
use axum::Json;

use crate::export::quantities::{self, Column};

/// Quantities of summaries with their titles and units, in the order of the columns of a sweep's table.
#[utoipa::path(
    get,
    path = "/v1/quantities",
    tag = "results",
    responses((status = 200, description = "The quantities", body = QuantityList))
)]
pub(crate) async fn list_quantities() -> Json<QuantityList> {
    let columns = quantities::columns(None);
    Json(QuantityList {
        quantities: columns.iter().map(Column::description).collect(),
    })
}

#[cfg(test)]
mod tests {
    use api::results::QuantityList;
    use serde_json::Value;

    use crate::http::openapi::document;
    use crate::http::tests::{SWEEP, Service};

    /// Schema of the field of a summary that a pointer leads to.
    fn field(pointer: &str) -> Value {
        const SCHEMAS: &str = "#/components/schemas/";
        let schemas = &document()["components"]["schemas"];
        let mut field = &schemas["Summary"];
        for key in pointer.split('/').skip(1) {
            let text = field.to_string();
            let name = text.split(SCHEMAS).nth(1);
            let name = name.and_then(|after| after.split('"').next());
            if !field["properties"].is_object() {
                field = &schemas[name.expect("an object")];
            }
            field = &field["properties"][key];
        }
        field.clone()
    }

    #[tokio::test]
    async fn quantities_are_columns_of_sweeps_and_fields_of_summaries() {
        let service = Service::new().await;
        let (status, _, list) = service.get("/v1/quantities").await;
        assert_eq!(status, 200);
        let list: QuantityList = serde_json::from_value(list).expect("a list");
        let columns = list.quantities.iter().map(|quantity| &quantity.column[..]);
        let columns: Vec<&str> = columns.collect();
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let id = sweep["id"].as_str().expect("an id");
        let path = format!("/v1/sweeps/{id}/outcomes");
        let (_, _, table) = service.text("GET", &path, &[], "").await;
        let header = table.lines().next().expect("a header");
        assert!(header.ends_with(&columns.join(",")), "{header}");
        let pointers = list
            .quantities
            .iter()
            .filter_map(|one| one.pointer.as_ref());
        assert!(pointers.clone().count() + 1 == columns.len());
        for pointer in pointers {
            let kind = field(pointer)["type"].to_string();
            assert!(
                kind.contains("number") || kind.contains("integer"),
                "{pointer}: {kind}"
            );
        }
    }
}
