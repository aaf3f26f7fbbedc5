//! Quantities: the named numbers of a summary, and the macro that declares a part of a summary with them.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A named number of a part `P` of a summary.
#[derive(Debug)]
pub struct Quantity<P> {
    /// Name of its field; it ends with the unit of the value.
    pub name: &'static str,
    /// Title on pages and in tables.
    pub title: &'static str,
    /// Unit in which pages and tables show it; empty of a count.
    pub unit: &'static str,
    /// Factor from the unit of the value to that one.
    pub factor: f64,
    /// Value in a part that has one.
    pub value: fn(&P) -> Option<f64>,
}

/// A part of a summary that has quantities.
pub trait Quantities: Sized + 'static {
    /// The quantities, in the order of the fields.
    const QUANTITIES: &'static [Quantity<Self>];
}

/// Declares a part of a summary with its quantities: the fields that are followed by a title, and by the factor to the
/// unit in which they are shown. Tables, pages and the list of the interface have them all.
macro_rules! quantities {
    (
        $(#[$attribute:meta])*
        pub struct $part:ident {
            $(
                $(#[$field_attribute:meta])*
                pub $field:ident: $type:ty $(=> $title:literal [$factor:literal, $unit:literal])?,
            )+
        }
    ) => {
        $(#[$attribute])*
        pub struct $part {
            $($(#[$field_attribute])* pub $field: $type,)+
        }

        impl $crate::results::Quantities for $part {
            const QUANTITIES: &'static [$crate::results::Quantity<Self>] = &[$($(
                $crate::results::Quantity {
                    name: stringify!($field),
                    title: $title,
                    unit: $unit,
                    factor: $factor,
                    value: |part| part.$field.into(),
                },
            )?)+];
        }
    };
}
pub(super) use quantities;

/// A quantity of summaries, as pages show it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct QuantityDescription {
    /// Name of its column in the table of a sweep; it ends with the unit of the values.
    pub column: String,
    /// JSON pointer to it in a summary; absent where it follows from several fields.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pointer: Option<String>,
    /// Title.
    pub title: String,
    /// The side that it belongs to; absent of the whole contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side: Option<String>,
    /// Unit in which it is shown; empty of a count.
    pub unit: String,
    /// Factor from the unit of the values to that one.
    pub factor: f64,
}

/// The quantities of summaries (`GET /v1/quantities`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct QuantityList {
    /// In the order of the columns.
    pub quantities: Vec<QuantityDescription>,
}
