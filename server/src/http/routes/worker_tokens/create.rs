//! `POST /v1/worker-tokens`: makes a token for remote workers.

use api::worker::{CreatedWorkerToken, NewWorkerToken};
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use sha2::{Digest, Sha256};

use crate::http::app::App;
use crate::http::extract::JsonBody;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::spec::Refused;

/// Longest name, characters.
const MAX_NAME: usize = 100;
/// Random bytes of a token.
const TOKEN_BYTES: usize = 32;

/// Why no token is made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CreateError {
    /// The name is empty or too long.
    #[error("a name has 1 to {MAX_NAME} characters, not all of them blank; this one has {0}")]
    Name(usize),
    /// The name has the character that databases cannot store in a text.
    #[error("the character U+0000 is not allowed in a name")]
    Nul,
    /// The system has no random numbers.
    #[error("no random numbers: {0}")]
    Random(getrandom::Error),
}

impl RouteError for CreateError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Name(_) | Self::Nul => ProblemType::UNREADABLE_BODY,
            Self::Random(_) => ProblemType::INTERNAL,
        }
    }
}

/// Makes a token for remote workers. It is shown once; the service stores its SHA-256.
#[utoipa::path(
    post,
    path = "/v1/worker-tokens",
    tag = "operation",
    request_body = NewWorkerToken,
    responses((status = 201, description = "The token", body = CreatedWorkerToken))
)]
pub(crate) async fn create_worker_token(
    State(app): State<App>,
    JsonBody(body): JsonBody,
) -> Result<(StatusCode, Json<CreatedWorkerToken>), ProblemResponse> {
    let (new, _): (NewWorkerToken, _) = api::spec::read(&body).map_err(Refused::Parse)?;
    let length = new.name.chars().count();
    if new.name.trim().is_empty() || length > MAX_NAME {
        return Err(CreateError::Name(length).into());
    }
    if new.name.contains('\0') {
        return Err(CreateError::Nul.into());
    }
    let mut random = [0; TOKEN_BYTES];
    getrandom::fill(&mut random).map_err(CreateError::Random)?;
    let token = BASE64_URL_SAFE_NO_PAD.encode(random);
    let sha256 = Sha256::digest(&token).into();
    let entry = app.store.add_worker_token(new.name.trim(), &sha256).await?;
    tracing::info!(id = %entry.id, name = entry.name, "a token for workers was made");
    Ok((
        StatusCode::CREATED,
        Json(CreatedWorkerToken { entry, token }),
    ))
}
