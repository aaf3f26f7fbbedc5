//! `fretwear calibrate SPEC --rated-cycles N --criterion KIND`: the wear coefficients that a rating implies.

use api::rating::{Coefficient, Rating};
use comfy_table::Table;

use crate::cli::arguments::CalibrateArguments;
use crate::cli::terminal::{
    Ended, failed, failed_at, refused, spinner, write_err, write_json, write_out,
};
use crate::cli::{destination, specification};
use crate::export::markdown;
use crate::rating;
use crate::rating::{RatingError, Request};

pub(super) fn run(arguments: &CalibrateArguments) -> Ended {
    let resolved = specification::resolved(&arguments.spec)?;
    arguments.out.as_deref().map_or(Ok(()), destination::file)?;
    let mut criterion = arguments.criterion.clone();
    if arguments.side.is_some() {
        criterion.side.clone_from(&arguments.side);
    }
    let request = Request {
        resolved: &resolved,
        criterion,
        cycles: arguments.rated_cycles,
        failing: arguments.failing,
    };
    let spinner = spinner();
    let found = rating::coefficients(&request, &mut |run| spinner.set_message(run.to_owned()));
    spinner.finish_and_clear();
    let rating = found.map_err(|error| match error {
        RatingError::Refused(error) => refused(specification::name(&arguments.spec), &error),
        error => failed(error),
    })?;
    if let Some(path) = &arguments.out {
        let spec = serde_json::to_vec_pretty(&rating.spec).map_err(failed)?;
        std::fs::write(path, spec).map_err(|cause| failed_at(path, &cause))?;
    }
    if arguments.json {
        return write_json(&rating);
    }
    write_out(coefficients(&rating))?;
    report(&rating)
}

fn coefficients(rating: &Rating) -> Table {
    let mut table = markdown::table(["coefficient", "material", "given", "implied"], 2);
    for Coefficient {
        pointer,
        material,
        given,
        implied,
    } in &rating.coefficients
    {
        table.add_row([
            pointer.clone(),
            material.clone().unwrap_or_default(),
            format!("{given:.4e}"),
            format!("{implied:.4e}"),
        ]);
    }
    table
}

fn report(rating: &Rating) -> Ended {
    for (index, run) in rating.runs.iter().enumerate() {
        write_err(format_args!(
            "run {}: {:.4e} times the given coefficients, {:.1} cycles{}",
            index + 1,
            run.factor,
            run.cycles,
            if run.is_reached { "" } else { " if continued" }
        ));
    }
    write_out(format_args!(
        "The median contact lasts {:.1} cycles, so that {} % have failed after {}.",
        rating.median_cycles,
        format_args!("{:.4}", 100.0 * rating.failing),
        rating.rated_cycles
    ))
}
