//! Pagination of lists. A page token holds the last entry of its page, and a digest of the list's filters.

use uuid::Uuid;

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

/// Length and start of a page of a list.
#[derive(Debug)]
pub(super) struct Page {
    digest: String,
    limit: u32,
    /// Last entry of the page before; this page has older ones.
    pub(super) before: Option<Uuid>,
}

impl Page {
    /// Parses the parameters of a page; `list` is a text that is unique to the list and its filters.
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
        let before = token.map(|token| parse_token(token, &digest)).transpose()?;
        Ok(Self {
            digest,
            limit,
            before,
        })
    }

    /// Entries to query: one more than the page has, which shows whether there is a next page.
    pub(super) fn query_limit(&self) -> u32 {
        self.limit + 1
    }

    /// Truncates queried entries to the page, and returns the token of the next page, if there is one.
    pub(super) fn truncate<T>(
        &self,
        entries: &mut Vec<T>,
        id: impl Fn(&T) -> Uuid,
    ) -> Option<String> {
        let limit = usize::try_from(self.limit).unwrap_or(usize::MAX);
        let more = entries.len() > limit;
        entries.truncate(limit);
        let last = entries.last().filter(|_| more)?;
        Some(format!("{}{}", self.digest, id(last).simple()))
    }
}

fn parse_token(token: &str, digest: &str) -> Result<Uuid, PageError> {
    token
        .strip_prefix(digest)
        .filter(|id| id.len() == 32)
        .and_then(|id| Uuid::parse_str(id).ok())
        .ok_or(PageError::Token)
}
