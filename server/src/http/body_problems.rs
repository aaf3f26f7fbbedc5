//! What routes that take a specification answer if they do not take it, for their description.

use api::problem::Problem;
use utoipa::IntoResponses;

/// Why a body is not taken.
#[derive(IntoResponses)]
#[expect(dead_code, reason = "describes answers, which are made of `Refusal`")]
pub(super) enum BodyProblems {
    /// The body, the key or a query parameter cannot be read.
    #[response(status = 400)]
    Unreadable(Problem),
    /// The body did not arrive in time.
    #[response(status = 408)]
    Slow(Problem),
    /// The body is too large.
    #[response(status = 413)]
    TooLarge(Problem),
    /// The body is not declared as JSON.
    #[response(status = 415)]
    MediaType(Problem),
    /// What is asked for has faults, or the key belongs to another body.
    #[response(status = 422)]
    Faults(Problem),
}
