//! Quantities: the named numbers of a summary, and the macro that declares a part of a summary with them.

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
/// unit in which they are shown. The tables of the command line have them all.
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
