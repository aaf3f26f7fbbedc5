//! String enums, and their form in specifications: there they also accept an unknown name, which is then reported with
//! all other faults.

use serde::de::value::{Error as ValueError, StrDeserializer};
use serde::de::{DeserializeOwned, IntoDeserializer};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// An enum whose members have names.
pub trait StringEnum: Sized + Copy + 'static {
    /// The first member.
    const FIRST: Self;
    /// Names of all members.
    const NAMES: &'static [&'static str];
}

/// A member of the enum `T`, or an unknown name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EnumValue<T> {
    /// A member.
    Known(T),
    /// An unknown name; refused later, together with all other faults.
    Unknown(String),
}

impl<T: Copy> EnumValue<T> {
    /// Returns the member, if the name is known.
    pub fn known(&self) -> Option<T> {
        match self {
            Self::Known(member) => Some(*member),
            Self::Unknown(_) => None,
        }
    }
}

/// The first member: a start for objects whose fields are then filled in.
impl<T: StringEnum> Default for EnumValue<T> {
    fn default() -> Self {
        Self::Known(T::FIRST)
    }
}

impl<T> From<T> for EnumValue<T> {
    fn from(member: T) -> Self {
        Self::Known(member)
    }
}

impl<T: Serialize> Serialize for EnumValue<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Known(member) => member.serialize(serializer),
            Self::Unknown(text) => text.serialize(serializer),
        }
    }
}

impl<'de, T: DeserializeOwned> Deserialize<'de> for EnumValue<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let member: StrDeserializer<'_, ValueError> = text.as_str().into_deserializer();
        Ok(match T::deserialize(member) {
            Ok(member) => Self::Known(member),
            Err(_) => Self::Unknown(text),
        })
    }
}

/// Declares a string enum: its members, serde names, schema and [`StringEnum`].
macro_rules! string_enum {
    ($(#[doc = $doc:literal])* $name:ident { $($(#[$inner:meta])* $member:ident = $text:literal),+ $(,)? }) => {
        $(#[doc = $doc])*
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
        )]
        pub enum $name {
            $($(#[$inner])* #[serde(rename = $text)] $member),+
        }

        impl crate::enum_value::StringEnum for $name {
            const FIRST: Self = Self::ALL[0];
            const NAMES: &'static [&'static str] = &[$($text),+];
        }

        // Derived, the schema would not see the names, which come out of this macro.
        impl utoipa::PartialSchema for $name {
            fn schema() -> utoipa::openapi::RefOr<utoipa::openapi::Schema> {
                utoipa::openapi::ObjectBuilder::new()
                    .schema_type(utoipa::openapi::schema::Type::String)
                    .description(Some(concat!($($doc),*).trim()))
                    .enum_values(Some([$($text),+]))
                    .into()
            }
        }

        impl utoipa::ToSchema for $name {
            fn name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }
        }

        impl $name {
            /// All members.
            pub const ALL: [Self; [$($text),+].len()] = [$(Self::$member),+];

            /// Name of the member in JSON.
            pub fn as_str(self) -> &'static str {
                match self {
                    $(Self::$member => $text),+
                }
            }

            /// Returns the member of that name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|member| member.as_str() == name)
            }
        }
    };
}

pub(crate) use string_enum;
