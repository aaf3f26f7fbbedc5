//! The parameters that filter jobs, of every request that takes a filter.

use api::job::Status;
use api::spec::{StringEnum, SystemKind};
use jiff::Timestamp;
use utoipa::IntoParams;
use uuid::Uuid;

use crate::spec;
use crate::store::Filter;
use crate::text::shortened;

/// Maximum number of labels of a filter.
const MAX_LABELS: usize = 16;

/// Longest text that is searched for, characters.
const MAX_TEXT: usize = 200;

/// Error of a parameter of a filter.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FilterError {
    /// Not a status.
    #[error("`{0}` is not a status; statuses are {1}")]
    Status(String, String),
    /// Given twice.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// Not a time.
    #[error("`{0}` is not a time such as 2026-01-31T12:00:00Z")]
    Time(String),
    /// Not the id of a sweep.
    #[error("`{0}` is not the id of a sweep")]
    Sweep(String),
    /// Not a kind of system.
    #[error("`{0}` is not a kind of system; kinds are {1}")]
    System(String, String),
    /// No text, or too long a one.
    #[error("a text has 1 to {MAX_TEXT} characters, not {0}")]
    Text(usize),
    /// Too many labels.
    #[error("a filter can have {MAX_LABELS} labels, not {0}")]
    Labels(usize),
    /// Not a label.
    #[error("`{0}` is not a label such as key:value")]
    Label(String),
}

/// Names of the parameters of a filter.
pub(super) const FILTERS: &str =
    "status, system, label, created_from, created_before, sweep and text";
/// Filters; a job passes all of them.
#[derive(Debug, Default, IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "only describes the parameters, which are parsed one by one because labels repeat"
)]
pub(crate) struct FilterQuery {
    /// Any of these statuses, separated by commas.
    status: Option<String>,
    /// This kind of system.
    system: Option<SystemKind>,
    /// This label, as `key:value`; can be repeated, for jobs that have all of them.
    label: Option<Vec<String>>,
    /// Accepted at this time (RFC 3339) or later.
    created_from: Option<String>,
    /// Accepted before this time (RFC 3339).
    created_before: Option<String>,
    /// Jobs of this sweep.
    sweep: Option<Uuid>,
    /// In the name, the value of a label or the id, whatever the case of ASCII letters.
    #[param(min_length = 1, max_length = 200)]
    text: Option<String>,
}

/// Parses the parameters that filter jobs; returns the others.
pub(super) fn filter_among<'a>(
    pairs: &'a [(String, String)],
    filter: &mut Filter,
) -> Result<Vec<(&'a str, &'a str)>, FilterError> {
    let mut others = Vec::new();
    for (index, (name, value)) in pairs.iter().enumerate() {
        let twice = pairs[..index].iter().any(|(earlier, _)| earlier == name);
        if twice && name != "label" {
            return Err(FilterError::Twice(shortened(name)));
        }
        match name.as_str() {
            "status" => filter.statuses = statuses(value)?,
            "system" => filter.system = Some(system(value)?),
            "label" => filter.labels.push(label(value)?),
            "created_from" => filter.created_from = Some(time(value)?),
            "created_before" => filter.created_before = Some(time(value)?),
            "sweep" => {
                let id = Uuid::parse_str(value);
                filter.sweep = Some(id.map_err(|_| FilterError::Sweep(shortened(value)))?);
            }
            "text" => filter.text = Some(text(value)?),
            name => others.push((name, value.as_str())),
        }
    }
    if filter.labels.len() > MAX_LABELS {
        return Err(FilterError::Labels(filter.labels.len()));
    }
    Ok(others)
}

fn text(value: &str) -> Result<String, FilterError> {
    let length = value.chars().count();
    if length == 0 || length > MAX_TEXT {
        return Err(FilterError::Text(length));
    }
    Ok(value.to_owned())
}

fn statuses(list: &str) -> Result<Vec<Status>, FilterError> {
    let status = |name| {
        Status::from_name(name)
            .ok_or_else(|| FilterError::Status(shortened(name), known::<Status>(name)))
    };
    list.split(',').map(status).collect()
}

fn system(name: &str) -> Result<String, FilterError> {
    if SystemKind::NAMES.contains(&name) {
        return Ok(name.to_owned());
    }
    Err(FilterError::System(
        shortened(name),
        known::<SystemKind>(name),
    ))
}

/// The names of an enum, and the one that was probably meant.
fn known<T: StringEnum>(name: &str) -> String {
    let meant = spec::did_you_mean(name, T::NAMES.iter().copied());
    T::NAMES.join(", ") + &meant
}

fn time(text: &str) -> Result<i64, FilterError> {
    text.parse::<Timestamp>()
        .map(Timestamp::as_millisecond)
        .map_err(|_| FilterError::Time(shortened(text)))
}

fn label(text: &str) -> Result<(String, String), FilterError> {
    let (key, value) = text
        .split_once(':')
        .ok_or_else(|| FilterError::Label(shortened(text)))?;
    Ok((key.to_owned(), value.to_owned()))
}
