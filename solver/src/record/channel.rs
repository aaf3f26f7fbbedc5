//! Channels: the named scalars of a report, and the macro that declares a report with its channels.

/// A named scalar of a report of type `R`.
#[derive(Debug)]
pub struct Channel<R> {
    /// Name in documents and tables; it ends with the unit.
    pub name: &'static str,
    /// Unit as names spell it: `mm`, `mm2`, `mpa`, ...
    pub unit: &'static str,
    /// Description in one sentence.
    pub description: &'static str,
    /// Name of its curve in the picture of worn depths; empty if it is not drawn there.
    pub curve: &'static str,
    /// Value in a report.
    pub value: fn(&R) -> f64,
}

/// A report that consists of channels, besides the fields that locate it in the run.
pub trait Channels: Sized + 'static {
    /// The channels, in the order of documents and tables.
    const CHANNELS: &'static [Channel<Self>];
}

/// Declares a report type, its table of channels and its constructor `of(source)`.
///
/// A line of `channels` is one scalar: description, name, unit, name of its curve if it is a worn depth to be drawn,
/// value. Documents know `fields` by name, so a new field needs edits there; a new channel does not.
///
/// A channel that is added later carries `#[serde(default)]` after its description: stored reports without it are read
/// with 0 for it.
macro_rules! declare_report {
    (
        $(#[$attribute:meta])*
        $visibility:vis $report:ident from $source:ident: $source_type:ty;
        fields {
            $($(#[$field_attribute:meta])* $field:ident: $field_type:ty = $field_value:expr,)*
        }
        channels {
            $(
                #[doc = $description:literal]
                $(#[$channel_attribute:meta])*
                $channel:ident [$unit:literal $(, curve $curve:literal)?] = $value:expr,
            )+
        }
    ) => {
        $(#[$attribute])*
        #[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
        $visibility struct $report {
            $($(#[$field_attribute])* pub $field: $field_type,)*
            $(
                #[doc = $description]
                $(#[$channel_attribute])*
                pub $channel: f64,
            )+
        }

        impl $crate::record::Channels for $report {
            const CHANNELS: &'static [$crate::record::Channel<Self>] = &[$(
                $crate::record::Channel {
                    name: stringify!($channel),
                    unit: $unit,
                    description: $description.trim_ascii(),
                    curve: concat!($($curve)?),
                    value: |report| report.$channel,
                },
            )+];
        }

        impl $report {
            fn of($source: $source_type) -> Self {
                Self {
                    $($field: $field_value,)*
                    $($channel: $value,)+
                }
            }
        }
    };
}
pub(super) use declare_report;
