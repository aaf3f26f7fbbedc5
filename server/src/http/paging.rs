//! Pages of lists. A token names the last entry of its page, and the list that it belongs to by a digest of its filters.

use sha2::{Digest, Sha256};
use uuid::Uuid;

use crate::http::problem::shortened;

/// Entries of a page unless asked otherwise.
const USUAL: u32 = 50;
/// Most entries of a page.
const MOST: u32 = 500;

/// Why there is no such page.
#[derive(Debug, thiserror::Error)]
pub(super) enum PageError {
    /// Not a number.
    #[error("the limit `{0}` is not a number from 1 to {MOST}")]
    Number(String),
    /// Too many, or none.
    #[error("a page holds 1 to {MOST} entries, not {0}")]
    Limit(u32),
    /// Not a token of this list.
    #[error("the page token is not one of this list")]
    Token,
}

/// How many entries a page of a list is to hold, and where it starts.
#[derive(Debug)]
pub(super) struct Page {
    digest: String,
    limit: u32,
    /// It holds what is older than this.
    pub(super) before: Option<Uuid>,
}

impl Page {
    /// Of a list that is described by this text, as a client asks for it.
    pub(super) fn asked(
        list: &str,
        limit: Option<&str>,
        token: Option<&str>,
    ) -> Result<Self, PageError> {
        let number = |text: &str| text.parse().map_err(|_| PageError::Number(shortened(text)));
        let limit = limit.map(number).transpose()?.unwrap_or(USUAL);
        if !(1..=MOST).contains(&limit) {
            return Err(PageError::Limit(limit));
        }
        let digest = Sha256::digest(list);
        let digest = u32::from_be_bytes([digest[0], digest[1], digest[2], digest[3]]);
        let digest = format!("{digest:08x}");
        let before = token.map(|token| position(token, &digest)).transpose()?;
        Ok(Self {
            digest,
            limit,
            before,
        })
    }

    /// How many entries are to be looked up: one more tells whether there is a next page.
    pub(super) fn wanted(&self) -> u32 {
        self.limit + 1
    }

    /// Leaves what the page holds; the token of the next one, if there is one.
    pub(super) fn cut<T>(&self, entries: &mut Vec<T>, id: impl Fn(&T) -> Uuid) -> Option<String> {
        let limit = usize::try_from(self.limit).unwrap_or(usize::MAX);
        let more = entries.len() > limit;
        entries.truncate(limit);
        let last = entries.last().filter(|_| more)?;
        Some(format!("{}{}", self.digest, id(last).simple()))
    }
}

fn position(token: &str, digest: &str) -> Result<Uuid, PageError> {
    token
        .strip_prefix(digest)
        .filter(|id| id.len() == 32)
        .and_then(|id| Uuid::parse_str(id).ok())
        .ok_or(PageError::Token)
}
