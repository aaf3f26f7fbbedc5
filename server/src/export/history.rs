//! Result documents of the engine's results.

use api::job::{Outcome, Phase};
use api::plan::Decision;
use api::results::{
    AccuracyReached, Checks, ContactExtent, ContactTemperature, Cost, EffectCalledFor,
    EstimatedError, EstimatedErrors, ExposedLayer, Initial, LifeEntry, Loop, Pressure, Profile,
    SideProfile, SideSummary, Snapshot, Station, Summary, WearHistory,
};
use solver::effects::{Crossing, Verdict};
use solver::observer;
use solver::record::{self, Layer, Record, Side, SideReport};
use solver::scene::Effect;

use crate::export::{line, resistance, tractions};
use crate::words::{effects, warnings};

/// The phase of a job.
pub fn phase(phase: observer::Phase) -> Phase {
    match phase {
        observer::Phase::Companions => Phase::Companions,
        observer::Phase::Mesh => Phase::Mesh,
        observer::Phase::Condense => Phase::Condense,
        observer::Phase::Cycles => Phase::Cycles,
        observer::Phase::Relocate => Phase::Relocate,
    }
}

/// Copies the fields of the same names from a result of the engine into a document.
macro_rules! document {
    ($document:ident of $result:expr; $($field:ident),+ $(; $own:ident: $value:expr)*) => {{
        let result = $result;
        $document {
            $($field: result.$field.clone(),)+
            $($own: $value,)*
        }
    }};
}

/// The documents of a snapshot.
pub fn snapshot(snapshot: &record::Snapshot) -> Snapshot {
    let cycle = snapshot.cycle;
    Snapshot {
        profile: Profile {
            cycle,
            receptacle: document!(SideProfile of &snapshot.receptacle; x_mm, depth_mm),
            slider: document!(SideProfile of &snapshot.slider; x_mm, depth_mm),
        },
        pressure: Pressure {
            cycle,
            positions: snapshot.positions.iter().map(tractions::position).collect(),
        },
        friction_loop: document!(
            Loop of &snapshot.friction_loop;
            displacement_mm, tangential_force_n_per_mm, tangential_force_n; cycle: cycle
        ),
    }
}

/// The summary document. `cost` was measured outside of the engine, which knows no clock; only its `dofs` are set here.
pub fn summary(summary: &record::Summary, cost: Cost, life: Vec<LifeEntry>) -> Summary {
    let (last, resolution) = (&summary.last, &summary.resolution);
    let side = |side: &SideReport| {
        document!(
            SideSummary of side;
            max_depth_mm, worn_area_mm2, ideal_area_mm2, scar_half_width_mm, worn_volume_mm3, ideal_volume_mm3
        )
    };
    document!(
        Summary of last;
        sliding_distance_mm, peak_pressure_mpa, contact_half_width_mm, dissipated_energy_mj_per_mm;
        cycles_done: last.cycle;
        outcome: outcome(summary.outcome);
        receptacle: side(&last.receptacle);
        slider: side(&last.slider);
        life: life;
        extent: last.extent.map(|extent| document!(
            ContactExtent of extent; load_n, contact_half_length_across_mm, dissipated_energy_mj
        ));
        stations: last.stations.iter().map(line::station).collect();
        motion: None;
        mission: Vec::new();
        contact_resistance_mohm: resistance::of(summary);
        contact_temperature_c: summary.last.temperature.map(|found| ContactTemperature {
            r#final: found.contact_temperature_c,
            highest: found.highest_temperature_c,
        });
        warnings: summary.warnings.iter().map(warnings::warning).collect();
        initial: document!(Initial of summary.initial; peak_pressure_mpa, contact_half_width_mm);
        accuracy: document!(
            AccuracyReached of resolution;
            contact_element_mm, increments_per_cycle, computed_cycles, relocations;
            increments: resolution.work.increments;
            estimated_relative_error: estimated_error(summary);
            errors: summary.errors.map(|errors| estimated_errors(&errors));
            contact_elements: count(resolution.contact_elements)
        );
        effects: summary.effects.iter().copied().map(named).collect();
        effects_called_for: summary.crossings.iter().map(called_for).collect();
        cost: Cost {
            dofs: count(resolution.dofs),
            factorizations: resolution.work.factorizations,
            unknowns: resolution.work.unknowns,
            response_entries: resolution.work.response_entries,
            ..cost
        };
        checks: document!(
            Checks of summary.checks;
            force_balance, worn_area, complementarity, friction_cone, friction_use;
            force_balance_present_normals: Some(summary.checks.force_balance_present_normals)
        )
    )
}

fn named((effect, verdict): (Effect, Verdict)) -> (String, Decision) {
    (effects::name(effect).to_owned(), decision(verdict))
}

/// A decision about an effect.
pub(crate) fn decision(verdict: Verdict) -> Decision {
    match verdict {
        Verdict::Simulated => Decision::Simulated,
        Verdict::Skipped => Decision::Skipped,
        Verdict::ForcedOn => Decision::ForcedOn,
        Verdict::ForcedOff => Decision::ForcedOff,
        Verdict::InputMissing => Decision::InputMissing,
    }
}

fn called_for(crossing: &Crossing) -> EffectCalledFor {
    EffectCalledFor {
        effect: effects::name(crossing.effect).to_owned(),
        cycle: crossing.cycle,
        // JSON has no infinity.
        value: crossing.value.filter(|value| value.is_finite()),
    }
}

/// The larger one of worn depth and scar width; that of the jumps alone without companions.
fn estimated_error(summary: &record::Summary) -> f64 {
    let jumps = summary.resolution.estimated_relative_error;
    summary.errors.map_or(jumps, |errors| {
        errors
            .worn_depth
            .relative
            .max(errors.scar_half_width.relative)
    })
}

fn estimated_errors(errors: &record::Errors) -> EstimatedErrors {
    let parts = |parts: record::ErrorParts| document!(EstimatedError of parts; relative, mesh, increments, jump, effects);
    EstimatedErrors {
        worn_depth: parts(errors.worn_depth),
        scar_half_width: parts(errors.scar_half_width),
        worn_area: parts(errors.worn_area),
        peak_pressure: parts(errors.peak_pressure),
        contact_resistance: errors.contact_resistance.map(parts),
    }
}

fn outcome(outcome: record::Outcome) -> Outcome {
    match outcome {
        record::Outcome::Completed => Outcome::Completed,
        record::Outcome::OutsideTolerance => Outcome::OutsideTolerance,
        record::Outcome::StopCondition => Outcome::StopCondition,
        record::Outcome::WornThrough => Outcome::WornThrough,
        record::Outcome::DeeperThanRadius => Outcome::DeeperThanRadius,
        record::Outcome::Stopped => Outcome::Stopped,
    }
}

/// A count as documents and files have it.
pub(crate) fn count(count: usize) -> u64 {
    u64::try_from(count).unwrap_or(u64::MAX)
}

/// The document of a wear history.
pub fn wear_history(record: Record) -> WearHistory {
    let mut history = WearHistory {
        cycle: record.cycle,
        jump: record.jump,
        sliding_distance_mm: record.sliding_distance_mm,
        line_stations: record.line.into_iter().map(line::series).collect(),
        ..WearHistory::default()
    };
    for column in record.columns {
        if let (Some(side), Some(layer)) = (column.side, column.layer) {
            history.exposed.push(ExposedLayer {
                side: side.name().to_owned(),
                layer: match layer {
                    Layer::Plated(number) => Some(count(number)),
                    Layer::BaseMetal => None,
                },
                length_mm: column.values,
            });
            continue;
        }
        let columns = match (column.side, column.place_mm) {
            (Some(side), Some(x_mm)) => {
                history.stations.push(Station {
                    side: side.name().to_owned(),
                    x_mm,
                    depth_mm: column.values,
                });
                continue;
            }
            (Some(Side::Receptacle), None) => &mut history.receptacle.columns,
            (Some(Side::Slider), None) => &mut history.slider.columns,
            (None, _) => &mut history.contact,
        };
        columns.insert(column.name.to_owned(), column.values);
    }
    history
}
