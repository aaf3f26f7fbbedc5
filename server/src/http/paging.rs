//! Pagination of lists. A page token holds a digest of the list's filters and the place of the last entry of the page in the order of the
//! list. The next page begins behind that place, whatever has been added or removed since.

use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::export::files;
use crate::http::problem::{ProblemType, RouteError};
use crate::text::shortened;

/// Default number of entries of a page.
const DEFAULT_LIMIT: u32 = 50;
/// Maximum number of entries of a page.
const MAX_LIMIT: u32 = 500;

/// Error of the parameters of a page.
#[derive(Debug, thiserror::Error)]
pub(super) enum PageError {
    /// Not a number.
    #[error("the limit `{0}` is not a number from 1 to {MAX_LIMIT}")]
    Number(String),
    /// Out of range.
    #[error("a page holds 1 to {MAX_LIMIT} entries, not {0}")]
    Limit(u32),
    /// Not a token of this list.
    #[error("the page token does not belong to this list")]
    Token,
}

impl RouteError for PageError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Length and start of a page of a list, whose entries have places of a type.
#[derive(Debug)]
pub(super) struct Page<P> {
    digest: String,
    limit: u32,
    after: Option<P>,
}

impl<P: Serialize + DeserializeOwned> Page<P> {
    /// Parses the parameters of a page; `list` is a text that is unique to the list, its filters and its order.
    pub(super) fn parse(
        list: &str,
        limit: Option<&str>,
        token: Option<&str>,
    ) -> Result<Self, PageError> {
        let number = |text: &str| text.parse().map_err(|_| PageError::Number(shortened(text)));
        let limit = limit.map(number).transpose()?.unwrap_or(DEFAULT_LIMIT);
        if !(1..=MAX_LIMIT).contains(&limit) {
            return Err(PageError::Limit(limit));
        }
        let digest = files::sha256(list.as_bytes())[..8].to_owned();
        let after = token.map(|token| place(token, &digest).ok_or(PageError::Token));
        Ok(Self {
            digest,
            limit,
            after: after.transpose()?,
        })
    }

    /// The place of the last entry of the page before; none of the first page.
    pub(super) fn after(&self) -> Option<&P> {
        self.after.as_ref()
    }

    /// Entries to query: one more than the page has, which shows whether there is a next page.
    pub(super) fn query_limit(&self) -> u32 {
        self.limit + 1
    }

    /// Truncates queried entries to the page, and returns the token of the next page, if there is one.
    ///
    /// # Errors
    /// [`serde_json::Error`] if the place cannot be written as JSON.
    pub(super) fn truncate<T>(
        &self,
        entries: &mut Vec<T>,
        place: impl Fn(&T) -> P,
    ) -> Result<Option<String>, serde_json::Error> {
        let limit = usize::try_from(self.limit).unwrap_or(usize::MAX);
        let more = entries.len() > limit;
        entries.truncate(limit);
        let Some(last) = entries.last().filter(|_| more) else {
            return Ok(None);
        };
        let end = BASE64_URL_SAFE_NO_PAD.encode(serde_json::to_vec(&place(last))?);
        Ok(Some(format!("{}{end}", self.digest)))
    }
}

/// The place in a token of the list with this digest.
fn place<P: DeserializeOwned>(token: &str, digest: &str) -> Option<P> {
    let end = token.strip_prefix(digest)?;
    let json = BASE64_URL_SAFE_NO_PAD.decode(end).ok()?;
    serde_json::from_slice(&json).ok()
}
