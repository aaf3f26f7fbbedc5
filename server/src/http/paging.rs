//! Pagination of lists. A page token holds a digest of the list's filters and where the page ends: its last entry where the newest come first,
//! the number of entries up to there in any other order, whose entries can change their places between two pages.

use std::mem;

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
    start: Start,
}

/// Where a page starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    /// Behind the last entry of the page before, which has older ones; at the newest entry if there is none.
    Before(Option<Uuid>),
    /// Behind so many entries.
    Behind(u32),
}

impl Page {
    /// Parses the parameters of a page of a list whose newest entries come first; `list` is a text that is unique to the list and its filters.
    pub(super) fn parse(
        list: &str,
        limit: Option<&str>,
        token: Option<&str>,
    ) -> Result<Self, PageError> {
        Self::parse_from(list, Start::Before(None), limit, token)
    }

    /// The same of a list whose first page starts so.
    pub(super) fn parse_from(
        list: &str,
        first: Start,
        limit: Option<&str>,
        token: Option<&str>,
    ) -> Result<Self, PageError> {
        let number = |text: &str| text.parse().map_err(|_| PageError::Number(shortened(text)));
        let limit = limit.map(number).transpose()?.unwrap_or(DEFAULT_LIMIT);
        if !(1..=MAX_LIMIT).contains(&limit) {
            return Err(PageError::Limit(limit));
        }
        let digest = files::sha256(list.as_bytes())[..8].to_owned();
        let start = match token.map(|token| parse_token(token, &digest)).transpose()? {
            None => first,
            Some(found) if mem::discriminant(&found) == mem::discriminant(&first) => found,
            Some(_) => return Err(PageError::Token),
        };
        Ok(Self {
            digest,
            limit,
            start,
        })
    }

    /// The last entry of the page before, if the page starts behind one.
    pub(super) fn before(&self) -> Option<Uuid> {
        match self.start {
            Start::Before(before) => before,
            Start::Behind(_) => None,
        }
    }

    /// The number of entries that the page starts behind, if they are counted.
    pub(super) fn skipped(&self) -> u32 {
        match self.start {
            Start::Before(_) => 0,
            Start::Behind(skipped) => skipped,
        }
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
        let end = match self.start {
            Start::Before(_) => id(last).simple().to_string(),
            Start::Behind(skipped) => format!("{:08x}", skipped.saturating_add(self.limit)),
        };
        Some(format!("{}{end}", self.digest))
    }
}

fn parse_token(token: &str, digest: &str) -> Result<Start, PageError> {
    let end = token.strip_prefix(digest).ok_or(PageError::Token)?;
    let start = match end.len() {
        32 => Uuid::parse_str(end).ok().map(|id| Start::Before(Some(id))),
        8 => u32::from_str_radix(end, 16).ok().map(Start::Behind),
        _ => None,
    };
    start.ok_or(PageError::Token)
}
