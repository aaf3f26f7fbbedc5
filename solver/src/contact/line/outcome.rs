//! Result of an increment: the new contact, wear, energy and residuals.

use super::friction::Coefficient;
use super::geometry::{Geometry, Setting};
use super::newton::HeightResponse;
use super::pair::{Displacement, Pair};
use super::problem::{GAP_TOLERANCE, Iterate};
use super::state::ContactState;
use super::status::Status;
use super::work::Work;
use crate::model::Tangential;
use crate::sides::Sides;

/// Result of an increment; arrays begin at the first coupled node of their side.
#[derive(Debug, Clone, Copy)]
pub struct Increment<'a> {
    /// First coupled node of each side.
    pub first: Sides<usize>,
    /// Path p |sigma| of the slave's nodes from there on, MPa mm.
    pub path: &'a [f64],
    /// Vertical recession at the nodes from there on, mm; empty where nothing wears.
    pub recession: Sides<&'a [f64]>,
    /// Integral of the wear rate over the contact, mm^2.
    pub worn_area: Sides<f64>,
    /// Energy dissipated by friction, N/mm mm.
    pub energy: f64,
    /// Friction along the line in the direction of the slip, N/mm.
    pub friction_along: f64,
    /// Vertical force on the slider, N/mm.
    pub vertical_force: f64,
    /// Where the height is given: change of the pressures of the slave's nodes from the first coupled one on per height, MPa/mm.
    pub pressure_per_height: &'a [f64],
    /// Change of the vertical force with them, N/mm per mm.
    pub force_per_height: f64,
    /// |sum of vertical forces - load| over the load on the unworn contact; 0 where the height is given.
    pub force_balance: f64,
    /// Largest gap of a closed node or penetration of an open one, over the indentation (or the round-off of longer
    /// lengths).
    pub complementarity: f64,
    /// Largest |q| - mu p over the peak pressure.
    pub friction_cone: f64,
    /// Work of the solve.
    pub work: Work,
}

/// Solution of an increment over its window.
#[derive(Clone, Copy)]
pub(super) struct Solution<'a> {
    pub(super) geometry: &'a Geometry,
    pub(super) iterate: &'a Iterate,
    pub(super) friction: Coefficient<'a>,
}

/// Wear of an increment.
#[derive(Clone, Copy)]
pub(super) struct Recession<'a> {
    /// Vertical recession at the nodes of each side from the first coupled one on, mm.
    pub(super) depth: Sides<&'a [f64]>,
    /// Integral of the wear rate over the contact, mm^2.
    pub(super) area: Sides<f64>,
}

impl<'a> Increment<'a> {
    /// No wear, no energy, no residuals.
    pub(super) const NONE: Self = Self {
        first: Sides {
            slider: 0,
            receptacle: 0,
        },
        path: &[],
        recession: Sides {
            slider: &[],
            receptacle: &[],
        },
        worn_area: Sides {
            slider: 0.0,
            receptacle: 0.0,
        },
        energy: 0.0,
        friction_along: 0.0,
        vertical_force: 0.0,
        pressure_per_height: &[],
        force_per_height: 0.0,
        force_balance: 0.0,
        complementarity: 0.0,
        friction_cone: 0.0,
        work: Work {
            increments: 1,
            factorizations: 0,
            unknowns: 0,
            response_entries: 0,
        },
    };

    /// Of a solution that is written to `next`.
    pub(super) fn of(
        solution: Solution<'a>,
        worn: Recession<'a>,
        pair: &Pair<'_>,
        next: &ContactState,
        to: Displacement<'_>,
        response: HeightResponse<'a>,
        work: Work,
    ) -> Self {
        let (it, friction) = (solution.iterate, solution.friction);
        let coupling = &solution.geometry.coupling;
        let slave = pair.interface.slave;
        let widths = &pair.slave().widths[coupling.first..coupling.end];
        let slipping = widths
            .iter()
            .zip(it.shear.iter().zip(&it.slip))
            .zip(&it.status)
            .filter(|(_, status)| status.direction() != 0.0);
        let mut energy = slipping
            .map(|((d, (q, slip)), _)| d * (q * slip).abs())
            .sum();
        let mut friction_along = 0.0;
        if to.along != 0.0 {
            // Over the length of the surface, which the slip along the line is a multiple of.
            let nodes = widths.iter().zip(&it.pressure).zip(&it.along).enumerate();
            let work: f64 = nodes
                .map(|(i, ((d, pressure), along))| d * friction.along(i) * pressure * along.abs())
                .sum();
            energy += work;
            friction_along = work / to.along.abs();
        }
        let forces = &next.force.of(slave)[2 * coupling.first..2 * coupling.end];
        let vertical: f64 = forces.iter().skip(1).step_by(2).sum();
        let load = next.equilibrium_load(&pair.interface);
        let peak = next.peak_pressure().max(f64::MIN_POSITIVE);
        // Round-off of longer lengths where these exceed the indentation.
        let scale = it.indentation.max(f64::MIN_POSITIVE) * it.tolerance / GAP_TOLERANCE;
        let (mut complementarity, mut cone) = (0.0_f64, 0.0_f64);
        for (i, status) in it.status.iter().enumerate() {
            let violation = if *status == Status::Open {
                -it.gap[i]
            } else {
                it.gap[i].abs()
            };
            complementarity = complementarity.max(violation);
            cone = cone.max(it.shear[i].abs() - friction.at(i) * it.pressure[i]);
        }
        Self {
            first: Sides::from_fn(|side| {
                if side == slave {
                    coupling.first
                } else {
                    coupling.master_range.0
                }
            }),
            path: &it.path,
            recession: worn.depth,
            worn_area: worn.area,
            energy,
            friction_along,
            vertical_force: vertical,
            pressure_per_height: if to.height.is_some() {
                response.pressure
            } else {
                &[]
            },
            force_per_height: if to.height.is_some() {
                response.force
            } else {
                0.0
            },
            force_balance: if to.height.is_some() {
                0.0
            } else {
                (vertical - load).abs() / pair.interface.load
            },
            complementarity: complementarity / scale,
            friction_cone: cone / peak,
            work,
        }
    }
}

/// Writes a solution to `next`.
pub(super) fn write(
    solution: Solution<'_>,
    pair: &Pair<'_>,
    last: &ContactState,
    setting: Setting,
    next: &mut ContactState,
) {
    let (geometry, it) = (solution.geometry, solution.iterate);
    let coupling = &geometry.coupling;
    let slave = pair.interface.slave;
    next.reset_open(last, setting.slider_x, setting.pairing_x);
    next.height = it.height;
    next.indentation = it.indentation;
    let span = coupling.first..coupling.end;
    next.set_statuses(coupling.first, &it.status);
    next.pressure[span.clone()].copy_from_slice(&it.pressure);
    next.shear[span.clone()].copy_from_slice(&it.shear);
    for i in span {
        let width = pair.slave().widths[i];
        let p = next.pressure[i];
        // Omitted shear acts on neither body.
        let q = match pair.interface.tangential {
            Tangential::Omitted => 0.0,
            Tangential::ImposedSlip | Tangential::StickSlip => next.shear[i],
        };
        let s = geometry.slopes.interface[i - coupling.first];
        let force = [width * (-p * s - q), width * (p - q * s)];
        next.force.of_mut(slave)[2 * i..2 * i + 2].copy_from_slice(&force);
        let other = next.force.of_mut(slave.other());
        let (from, weights) = coupling.dual_row(i);
        for (offset, weight) in weights.iter().enumerate() {
            other[2 * (from + offset)] += weight * force[0];
            other[2 * (from + offset) + 1] += weight * force[1];
        }
    }
    let (begin, stop) = coupling.master_range;
    next.set_loaded(slave, coupling.first..coupling.end);
    next.set_loaded(slave.other(), begin..stop);
    let widths = &pair.slave().widths[coupling.first..coupling.end];
    let forces = it.pressure.iter().zip(widths);
    next.friction = solution.friction.mean(forces.map(|(p, width)| width * p));
}
