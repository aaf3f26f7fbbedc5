//! Definition of a wear law.

use std::ops::RangeInclusive;

use api::spec::{Provenance, WearLaw, WearLawName};
use solver::scene::{self, Scene};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::values::Values;

/// One wear law.
pub struct LawDefinition {
    /// Worn depth h or its increment dh under the pressure p over a slip |ds|, in the symbols of the fields.
    pub formula: &'static str,
    /// States besides pressure and slip on which the rate depends. None of a law whose rate is the same in every state, as that of a
    /// layer or a base of a plating must be.
    pub states: &'static [State],
    /// How the rate depends on the coefficient of friction.
    pub friction: ByFriction,
    /// Numbers, in the order in which they are resolved.
    pub(super) groups: &'static [FieldGroup],
    /// Fields that are no numbers.
    pub choices: &'static [&'static str],
    /// The engine's law of resolved values; `None` without a value that it depends on.
    pub(super) engine_law: fn(&Values<'_>) -> Option<scene::WearLaw>,
    /// Warning of a scene outside of the law's range.
    pub(in crate::spec) outside_range: Option<fn(scene::WearLaw, &Scene) -> Option<String>>,
    /// Fields of a part that wears, as JSON.
    #[cfg(test)]
    pub(in crate::spec) example: &'static str,
}

/// A state of the contact that a rate depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// Worn depth, by which dose, time or repetitions of a place are known.
    Depth,
    /// Speed of sliding.
    Speed,
    /// Time, whether the contact slips or sticks.
    Time,
    /// Repetitions of the load.
    Repetitions,
    /// Temperature of the contact.
    Temperature,
}

/// How a rate depends on the coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ByFriction {
    /// The rate does not depend on it.
    Independent,
    /// In proportion: nothing wears without friction.
    Proportional,
    /// The rate grows with it.
    Growing,
}

/// Fields that are resolved together.
pub(super) struct FieldGroup {
    pub(super) numbers: &'static [Number],
    /// Resolves the numbers, and checks them beside one another.
    pub(super) resolve: fn(&[Number], &mut Values<'_>, &mut Diagnostics),
}

/// A number of a law.
pub struct Number {
    /// Field in the specification, whose name ends with the unit.
    pub field: &'static str,
    /// Symbol in the formula.
    pub symbol: &'static str,
    /// Values that are accepted.
    pub range: RangeInclusive<f64>,
    /// Replacement of a value that is left out.
    pub absent: Absent,
    /// Change with the wear coefficient; `None` of a number that does not change.
    pub scaling: Option<Scaling>,
    pub(in crate::spec) of: fn(&mut WearLaw) -> &mut Option<f64>,
}

/// Replacement of a number that is left out.
pub enum Absent {
    /// Nothing: the fault says why it is required.
    Required(&'static str),
    /// A default with its provenance.
    Default(f64, Provenance),
    /// A value from elsewhere, in words.
    Other(&'static str),
}

/// Change of a number with the wear coefficient. All numbers that have one scale every depth together.
#[derive(Clone, Copy)]
pub enum Scaling {
    /// In proportion.
    Proportional,
    /// In proportion to the inverse.
    Inverse,
    /// With a power of it, the exponent of time or repetitions.
    Power(fn(&WearLaw) -> Option<f64>),
}

/// `number!(field, symbol, range, absent)`.
macro_rules! number {
    ($field:ident, $symbol:literal, $range:expr, $absent:expr) => {
        $crate::spec::law::definition::Number {
            field: stringify!($field),
            symbol: $symbol,
            range: $range,
            absent: $absent,
            scaling: None,
            of: |law| &mut law.$field,
        }
    };
}
pub(super) use number;

impl LawDefinition {
    /// The numbers, in the order in which they are resolved.
    pub fn numbers(&self) -> impl Iterator<Item = &'static Number> + use<> {
        self.groups.iter().flat_map(|group| group.numbers)
    }

    /// Returns `true` if the rate is the same in every state.
    pub(in crate::spec) fn is_uniform(&self) -> bool {
        self.states.is_empty()
    }

    /// Returns `true` if the law takes the hardness of the wearing surface.
    pub(in crate::spec) fn takes_hardness(&self) -> bool {
        self.numbers().any(|number| number.field == "hardness_mpa")
    }

    /// Resolves a law of this name; returns it with its defaults filled in.
    pub(super) fn resolve(
        &self,
        name: WearLawName,
        mut values: Values<'_>,
        diagnostics: &mut Diagnostics,
    ) -> (WearLaw, Option<scene::WearLaw>) {
        let numbers = self.numbers().map(|number| number.field);
        let fields: Vec<&str> = numbers.chain(self.choices.iter().copied()).collect();
        let fields = [&["law"], &fields[..]].concat();
        let pointer = &values.side.pointer;
        diagnostics.check_fields(pointer, values.given, &fields, name.as_str());
        for group in self.groups {
            (group.resolve)(group.numbers, &mut values, diagnostics);
        }
        let law = (self.engine_law)(&values);
        (values.law, law)
    }
}

/// Resolves numbers one by one.
pub(super) fn each(numbers: &[Number], values: &mut Values<'_>, diagnostics: &mut Diagnostics) {
    for number in numbers {
        number.resolve(values, diagnostics);
    }
}

impl Number {
    /// The number with a change with the wear coefficient.
    pub(super) const fn scaled(mut self, scaling: Scaling) -> Self {
        self.scaling = Some(scaling);
        self
    }

    /// Checks a given value, or replaces one that is left out. The least of the range stands for a required one.
    pub(super) fn resolve(&self, values: &mut Values<'_>, diagnostics: &mut Diagnostics) {
        let pointer = values.side.field(self.field);
        let value = (self.of)(&mut values.law);
        match (*value, &self.absent) {
            (Some(given), _) => {
                diagnostics.provenance(&pointer, Provenance::Given);
                diagnostics.check_range(&pointer, given, &self.range);
            }
            (None, Absent::Required(needs)) => {
                diagnostics.missing(&pointer, needs);
                *value = Some(*self.range.start());
            }
            (None, Absent::Default(default, provenance)) => {
                diagnostics.provenance(&pointer, *provenance);
                *value = Some(*default);
            }
            (None, Absent::Other(_)) => {}
        }
    }
}

impl Scaling {
    /// Factor on a number of a law for a factor on the wear coefficient.
    pub(in crate::spec) fn factor(self, law: &WearLaw, factor: f64) -> f64 {
        match self {
            Self::Proportional => factor,
            Self::Inverse => 1.0 / factor,
            Self::Power(exponent) => factor.powf(exponent(law).unwrap_or(1.0)),
        }
    }
}
