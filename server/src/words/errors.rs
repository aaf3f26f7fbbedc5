//! Errors of the engine, with the fields of a specification that they are about.

use solver::station::StationError;

/// Why sections along a line cannot simulate a scene.
pub(crate) fn of_line(error: &StationError) -> String {
    match error {
        StationError::BeyondAxis { .. } => {
            format!("{error}: below a ring whose `top` bends it must end there")
        }
        _ => error.to_string(),
    }
}
