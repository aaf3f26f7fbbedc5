//! The heights of coupled sections under a common top: height v, lifts `e_j` and line loads `P_j` follow from
//!   `e_j = sum_k D_jk P_k(v + g_j + e_j)`,  `sum_j w_j P_j = F + K (v - v_0)`
//! by Newton's method with `dP_j/dv` of each section, D of the coupling. Sections are solved as under a rigid top alone; steps are limited by
//! the contact's indentation, and shortened where the last one has left a larger correction than the one before.

use super::coupling::Coupling;
use super::height::{Height, HeightSolution};
use super::section::Station;
use super::top::{BALANCED, Carrier, MOST_ITERATIONS, Unsolved, indentation, solve};
use crate::along_line::SectionsIncrement;
use crate::linear::DenseLu;

/// Largest step of a station's height over the largest indentation.
const LARGEST_STEP: f64 = 2.0;
/// Correction of a height without load that has converged, over the largest indentation.
const PLACED: f64 = 1e-3;
/// Smallest part of a step that is taken.
const SMALLEST_PART: f64 = 0.0625;

/// A correction of the heights.
struct Correction {
    /// Of the common height, and of the lifts, mm.
    common: f64,
    lifts: Vec<f64>,
    /// Largest change of a section's load over the mean one.
    of_load: f64,
    /// Largest change of a height without load, mm.
    of_height: f64,
}

impl Carrier {
    /// The common height and the lifts of coupled sections, and the number of iterations.
    pub(super) fn coupled_heights(
        &self,
        coupling: &Coupling,
        stations: &mut [Station],
        last: &Height,
        increment: SectionsIncrement,
    ) -> Result<HeightSolution, Unsolved> {
        let mut v = last.predicted(increment.cycles);
        let mut lifts = last.predicted_lifts(coupling.order(), increment.cycles);
        let mut raised: Option<Vec<f64>> = None;
        let (mut part, mut before, mut found_n) = (1.0, f64::INFINITY, 0.0);
        for iteration in 1..=MOST_ITERATIONS {
            solve(stations, |j, station| {
                let height = v + station.place.raised_mm + lifts[j];
                station.solve(increment, Some(height), raised.as_ref().map(|by| by[j]))
            })?;
            let force = stations
                .iter()
                .map(|station| station.place.weight_mm * station.attempt.line_load);
            found_n = force.sum();
            let imbalance = found_n - self.force_at(last, v);
            let attempted = stations.iter().map(Station::attempted_indentation);
            let largest = attempted.fold(indentation(stations), f64::max);
            let correction = self.correction(coupling, stations, last, &lifts, imbalance);
            let Some(correction) = correction else {
                // Nothing touches.
                v -= LARGEST_STEP * largest;
                raised = Some(vec![-LARGEST_STEP * largest; lifts.len()]);
                continue;
            };
            let off = correction.of_load.max(imbalance.abs() / self.force_n);
            if off <= BALANCED && correction.of_height <= PLACED * largest {
                return Ok(HeightSolution {
                    mm: v,
                    lifts,
                    imbalance: imbalance.abs() / self.force_n,
                    iterations: iteration,
                });
            }
            part = if off > before {
                SMALLEST_PART.max(0.5 * part)
            } else {
                1.0_f64.min(2.0 * part)
            };
            before = off;
            let steps = correction.lifts.iter().map(|lift| correction.common + lift);
            let longest = steps.fold(0.0, |most: f64, step| most.max(step.abs()));
            let taken = part.min(LARGEST_STEP * largest / longest);
            v += taken * correction.common;
            let mut by = correction.lifts;
            for (lift, by) in lifts.iter_mut().zip(&mut by) {
                *lift += taken * *by;
                *by = taken * (correction.common + *by);
            }
            raised = Some(by);
        }
        Err(Unsolved::Height {
            found_n,
            iterations: MOST_ITERATIONS,
        })
    }

    /// Newton's correction; `None` where no section's load changes with its height.
    fn correction(
        &self,
        coupling: &Coupling,
        stations: &[Station],
        last: &Height,
        lifts: &[f64],
        imbalance: f64,
    ) -> Option<Correction> {
        let count = stations.len();
        let slope = |j: usize| stations[j].attempt.load_per_height;
        let mut lu = DenseLu::default();
        let matrix = lu.matrix(count);
        for k in 0..count {
            for j in 0..count {
                let own = if j == k { 1.0 } else { 0.0 };
                *matrix.at(j, k) = own - coupling.per_load(j, k) * slope(k);
            }
        }
        lu.factor();
        let loads = || stations.iter().map(|station| station.attempt.line_load);
        let mut alone: Vec<f64> = (0..count)
            .map(|j| coupling.lift(j, loads()) - lifts[j])
            .collect();
        let mut per_height: Vec<f64> = (0..count)
            .map(|j| coupling.lift(j, (0..count).map(slope)))
            .collect();
        if !(lu.solve(&mut alone) && lu.solve(&mut per_height)) {
            return None;
        }
        let weighted = |j: usize| stations[j].place.weight_mm * slope(j);
        let (mut force, mut change) = (imbalance, 0.0);
        for j in 0..count {
            force += weighted(j) * alone[j];
            change += weighted(j) * (1.0 + per_height[j]);
        }
        change -= last.reference.map_or(0.0, |_| self.spring_n_per_mm);
        if change >= 0.0 {
            return None;
        }
        let common = -force / change;
        let lifts: Vec<f64> = (0..count)
            .map(|j| alone[j] + per_height[j] * common)
            .collect();
        let length: f64 = stations.iter().map(|station| station.place.weight_mm).sum();
        let (mut of_load, mut of_height) = (0.0_f64, 0.0_f64);
        for (j, lift) in lifts.iter().enumerate() {
            let step = (common + lift).abs();
            of_load = of_load.max(step * slope(j).abs() * length / self.force_n);
            if slope(j) == 0.0 {
                of_height = of_height.max(step);
            }
        }
        Some(Correction {
            common,
            lifts,
            of_load,
            of_height,
        })
    }
}
