//! One jump: doses at its end, and its error.

use super::fields::add_mirrored;
use super::positions::positions;
use super::pressures::{CyclePressures, JumpSurfaces};
use super::surface::JumpSurface;
use crate::contact::area::AreaError;
use crate::law::dose_laws::DoseLaws;
use crate::number::real_cycles;
use crate::point::energy::WholeAndSection;
use crate::point::error::PointError;
use crate::point::field::Field;
use crate::point::integrator::PointIntegrator;
use crate::point::point_state::PointState;
use crate::point::section::section_integral;
use crate::point::state::State;
use crate::point::surface::Surface;
use crate::point::window::widen;
use crate::schedule::jump::Formula;
use crate::schedule::jump::implicit::formulas::{Formulas, JumpFrom, LastDoses};
use crate::sides::{Side, Sides};

/// Formula and estimated error of a jump.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jumped {
    pub(super) formula: Formula,
    pub(super) error: f64,
}

/// Doses of both surfaces, MPa mm.
type Doses = Sides<Vec<f64>>;

impl PointIntegrator {
    /// Makes a jump on a window that holds all contacts.
    pub(super) fn jump(
        &mut self,
        state: &mut PointState,
        laws: &DoseLaws,
        jump: u64,
    ) -> Result<Jumped, PointError> {
        loop {
            let mut pressure = self.place(state);
            let found = self.jump_in_window(state, laws, &mut pressure, jump);
            match found {
                Err(AreaError::ReachesEdge { .. }) => {
                    take_all(&mut state.sliding, &pressure);
                    widen(&mut state.sliding)?;
                }
                Err(error) => return Err(PointError::Contact { cycle: 0, error }),
                Ok(jumped) => return Ok(jumped),
            }
        }
    }

    /// Places the contacts of the next cycle; returns the pressures to begin with, those of the last jump if there was one.
    fn place(&mut self, state: &PointState) -> Vec<f64> {
        let (sliding, cells) = (&state.sliding, state.sliding.lattice.cells());
        let pressures = match self.pressures.take() {
            Some(pressures) if pressures.cells == cells => self.pressures.insert(pressures),
            _ => {
                let pressures =
                    CyclePressures::new(cells, self.scene.modulus(), self.scene.accuracy.tolerance);
                self.pressures.insert(pressures)
            }
        };
        let along = state.neutral.half_lengths_mm.0 / cells.dx_mm;
        let positions = positions(&sliding.lattice, self.scene.parts(along));
        let unworn = positions.iter().flat_map(|position| {
            let mut mean = vec![0.0; cells.count()];
            for (place, weight) in position.weights() {
                let gap = sliding.lattice.unworn_gap_mm(&self.scene, place.slider);
                for (mean, gap) in mean.iter_mut().zip(gap) {
                    *mean += weight * gap;
                }
            }
            mean
        });
        let unworn = unworn.collect();
        // As far from the turning point.
        let begin = |number: usize| {
            let last = (number + sliding.passing.len()).saturating_sub(positions.len());
            let found = sliding.passing.get(last).unwrap_or(&sliding.pressure);
            &found.values
        };
        let pressure = (0..positions.len()).flat_map(begin).copied().collect();
        pressures.place(positions, unworn);
        pressure
    }

    /// Makes a jump from the pressures to begin with.
    fn jump_in_window(
        &mut self,
        state: &mut PointState,
        laws: &DoseLaws,
        pressure: &mut [f64],
        jump: u64,
    ) -> Result<Jumped, AreaError> {
        let Some(pressures) = &mut self.pressures else {
            debug_assert!(false, "contacts are placed before they are solved");
            return Err(AreaError::Force { force_n: 0.0 });
        };
        let force_n = self.scene.force_n;
        let surfaces = &state.sliding.surfaces;
        let before = surfaces.as_ref().map(mirrored_mean);
        let mut first = at_the_end(surfaces, before.clone(), 0.0);
        let mut iterations = pressures.solve(force_n, &mut first, pressure)?;
        let first = first.map(|surface| surface.of_cycle);
        let cycles = real_cycles(jump);
        let last = state.control.last_jump();
        let sizes = first.as_ref().map(|places| vec![1.0; places.len()]);
        let Formulas {
            formula,
            known,
            cycles: on_last,
        } = Formulas::new(&JumpFrom {
            laws,
            dose: &before,
            of_cycle: &first,
            sizes: sizes.as_slices(),
            depth: &depths(surfaces, &before),
            cycles,
            last: last.map(|last| last_doses(surfaces, last)),
        });
        let mut end = at_the_end(surfaces, known, on_last);
        iterations += pressures.solve(force_n, &mut end, pressure)?;
        let error = error(surfaces, &before, &first, &end, cycles);
        let dose = end.map(|surface| surface.dose);
        let count = pressures.cells.count();
        let positions = pressures.positions.len();
        let section_work = Sides::from_fn(|side| {
            let doses = dose.of(side).iter().zip(before.of(side));
            let added: Vec<f64> = doses.map(|(after, before)| after - before).collect();
            let cells = surfaces.of(side).dose.cells(state.sliding.lattice.size_mm);
            section_integral(&cells, &added)
        });
        let sliding = &mut state.sliding;
        let work = WholeAndSection {
            whole: cycles * self.scene.path_mm() * force_n,
            section: 0.5 * (section_work.slider + section_work.receptacle),
        };
        // Of friction that does not change.
        let friction = WholeAndSection {
            whole: sliding.coefficient,
            section: sliding.coefficient,
        };
        sliding.add_work(work, friction);
        sliding.work.0 += 2 * positions;
        sliding.work.1 += iterations * positions;
        for (side, dose) in [
            (Side::Slider, dose.slider),
            (Side::Receptacle, dose.receptacle),
        ] {
            let surface = sliding.surfaces.of_mut(side);
            surface.jump_to(before.of(side), dose, cycles);
        }
        let window = sliding.lattice.window();
        let fields = pressure.chunks_exact(count);
        sliding.passing = fields.map(|p| Field::of(window, p.to_vec())).collect();
        Ok(Jumped { formula, error })
    }
}

/// Both surfaces at the end of a jump, of a known part of the doses.
fn at_the_end(surfaces: &Sides<Surface>, known: Doses, cycles: f64) -> JumpSurfaces<'_> {
    let Sides { slider, receptacle } = known;
    let surface = |side, known| JumpSurface::new(side, surfaces.of(side), known, cycles);
    Sides {
        slider: surface(Side::Slider, slider),
        receptacle: surface(Side::Receptacle, receptacle),
    }
}

/// Estimated relative error of a jump (`schedule::jump::implicit`), from the doses before it, and those of one cycle before it and at its end. Where
/// a fast layer opens, doses of the slow one above count by its rate.
fn error(
    surfaces: &Sides<Surface>,
    before: &Doses,
    first: &Doses,
    end: &JumpSurfaces<'_>,
    cycles: f64,
) -> f64 {
    let (mut worn, mut error) = (0.0, 0.0);
    for side in Side::BOTH {
        let (surface, end) = (surfaces.of(side), end.of(side));
        let ends = first.of(side).iter().zip(&end.of_cycle);
        let doses = before.of(side).iter().zip(&end.dose);
        for ((from, to), (first, last)) in doses.zip(ends).filter(|((a, b), _)| b > a) {
            let rate = surface.rate_at(*from).min(surface.rate_at(*to));
            worn += (surface.depth_mm(*to) - surface.depth_mm(*from)) / cycles;
            error += rate * ((to - from) / cycles - 0.5 * (first + last)).abs();
        }
    }
    if worn > 0.0 { error / worn } else { 0.0 }
}

/// Depths of doses on both surfaces, mm.
fn depths(surfaces: &Sides<Surface>, dose: &Doses) -> Sides<Vec<f64>> {
    Sides::from_fn(|side| {
        let surface = surfaces.of(side);
        let doses = dose.of(side).iter();
        doses.map(|dose| surface.depth_mm(*dose)).collect()
    })
}

/// Doses of a jump before of a number of cycles.
fn last_doses(surfaces: &Sides<Surface>, cycles: f64) -> LastDoses {
    let of_side = |surface: &Surface| {
        let mut doses: Vec<f64> = surface.pace().to_vec();
        add_mirrored(&mut doses);
        for dose in &mut doses {
            *dose *= 0.5 * cycles;
        }
        doses
    };
    LastDoses {
        cycles,
        dose: surfaces.as_ref().map(of_side),
    }
}

/// Doses of a surface, the mean with the mirrored ones.
fn mirrored_mean(surface: &Surface) -> Vec<f64> {
    let mut doses = surface.dose.values.clone();
    add_mirrored(&mut doses);
    for dose in &mut doses {
        *dose *= 0.5;
    }
    doses
}

/// Takes the pressures of all positions as one, with the mirrored ones, for a window that holds them all.
fn take_all(state: &mut State, pressure: &[f64]) {
    let together = &mut state.pressure.values;
    for values in pressure.chunks_exact(together.len()) {
        for (sum, value) in together.iter_mut().zip(values) {
            *sum += value;
        }
    }
    add_mirrored(together);
    state.passing.clear();
}
