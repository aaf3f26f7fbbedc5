//! Text in messages.

/// Returns a client's text, cut to a length that a message can quote.
pub(crate) fn shortened(text: &str) -> String {
    const MAX_CHARS: usize = 40;
    if text.chars().count() <= MAX_CHARS {
        return text.to_owned();
    }
    text.chars().take(MAX_CHARS).chain(['\u{2026}']).collect()
}
