//! OpenAPI responses of the routes that receive a specification.

use api::problem::Problem;
use utoipa::IntoResponses;

/// Problems of a request with a body.
#[derive(IntoResponses)]
#[expect(
    dead_code,
    reason = "only describes the responses in the OpenAPI document"
)]
pub(super) enum BodyProblems {
    /// The body, the `Idempotency-Key` or a query parameter is not valid.
    #[response(status = 400)]
    UnreadableBody(Problem),
    /// The body did not arrive in time.
    #[response(status = 408)]
    RequestTimeout(Problem),
    /// The body is too large.
    #[response(status = 413)]
    BodyTooLarge(Problem),
    /// The body is not declared as JSON.
    #[response(status = 415)]
    MediaType(Problem),
    /// The specification has faults, or the `Idempotency-Key` was used with another body.
    #[response(status = 422)]
    InvalidSpecification(Problem),
}
