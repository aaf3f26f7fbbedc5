use std::f64::consts::PI;

use super::*;

const STEEL: f64 = 0.5 * 200e3 / (1.0 - 0.09);
const RADIUS_MM: f64 = 10.0;
const FORCE_N: f64 = 100.0;
/// Hertz' half-length in mm, peak pressure in MPa and approach in mm of this sphere.
const HERTZ: (f64, f64, f64) = (0.189_686, 1_327.0, 3.598_06e-3);

fn square(cells: usize, length: f64) -> Cells {
    let size = length / real(cells);
    Cells {
        along_x: cells,
        along_z: cells,
        dx_mm: size,
        dz_mm: size,
    }
}

fn sphere(cells: &Cells) -> Vec<f64> {
    cells.map(|x, z| (x * x + z * z) / (2.0 * RADIUS_MM))
}

/// Solves a contact from 0 on these cells with a uniform wear.
fn solve(cells: Cells, gap: &[f64], wear: f64, preconditioned: bool) -> (Vec<f64>, NormalSolution) {
    let mut contact = NormalContact::new(cells, STEEL);
    if !preconditioned {
        contact = contact.without_preconditioner();
    }
    let mut pressure = vec![0.0; cells.count()];
    let problem = NormalProblem {
        gap_mm: gap,
        wear_mm_per_mpa: &vec![wear; cells.count()],
        force_n: FORCE_N,
    };
    let found = contact.solve(&problem, &mut pressure);
    (pressure, found.expect("the contact has a solution"))
}

fn peak(pressure: &[f64]) -> f64 {
    pressure.iter().fold(0.0, |most, p| p.max(most))
}

/// Mean of Hertz' pressure over a cell, by 8 x 8 places.
fn hertz_mean(cells: &Cells) -> Vec<f64> {
    let places = |step: f64| (0..8).map(move |i| step * (f64::from(i) / 8.0 - 0.437_5));
    cells.map(|x, z| {
        let at = |s: f64, t: f64| {
            let r2 = ((x + s).powi(2) + (z + t).powi(2)) / HERTZ.0.powi(2);
            HERTZ.1 * (1.0 - r2).max(0.0).sqrt() / 64.0
        };
        let rows = places(cells.dx_mm).map(|s| places(cells.dz_mm).map(|t| at(s, t)).sum::<f64>());
        rows.sum()
    })
}

fn l1_error(count: usize) -> f64 {
    let cells = square(count, 2.8 * HERTZ.0);
    let (pressure, _) = solve(cells, &sphere(&cells), 0.0, true);
    let exact = hertz_mean(&cells);
    let off: Vec<f64> = pressure
        .iter()
        .zip(&exact)
        .map(|(p, e)| (p - e).abs())
        .collect();
    cells.integral(&off) / FORCE_N
}

#[test]
fn a_sphere_meets_hertz() {
    let cells = square(64, 2.8 * HERTZ.0);
    let (pressure, found) = solve(cells, &sphere(&cells), 0.0, true);
    assert!((cells.integral(&pressure) / FORCE_N - 1.0).abs() < 1e-13);
    assert!(
        (found.approach_mm / HERTZ.2 - 1.0).abs() < 1e-3,
        "{found:?}"
    );
    assert!(
        (peak(&pressure) / HERTZ.1 - 1.0).abs() < 2e-3,
        "{}",
        peak(&pressure)
    );
    let area = cells.area_mm2() * real(pressure.iter().filter(|p| **p > 0.0).count());
    let half_length = (area / PI).sqrt();
    assert!((half_length / HERTZ.0 - 1.0).abs() < 0.01, "{half_length}");
}

#[test]
fn the_pressure_converges_to_hertz() {
    let errors = [16, 32, 64, 128].map(l1_error);
    let order = (errors[0] / errors[3]).log2() / 3.0;
    // 64 cells on 2.8 a: a/23.
    assert!(errors[2] < 4e-3 && order > 1.3, "{errors:?}, order {order}");
}

/// An ellipse of 1:10 on cells of its own aspect: p0 644.07 MPa, short half-length 19.258 um, aspect 9.994.
#[test]
fn an_ellipse_meets_hertz() {
    let modulus = 0.5 * 117e3 / (1.0 - 0.34 * 0.34);
    let (short, aspect, p0) = (19.258e-3, 9.994, 644.07);
    let mut cells = square(72, 2.4 * short);
    cells.dz_mm *= aspect;
    let gap = cells.map(|x, z| 0.5 * (x * x + z * z / 36.5));
    let mut pressure = vec![0.0; cells.count()];
    let problem = NormalProblem {
        gap_mm: &gap,
        wear_mm_per_mpa: &vec![0.0; cells.count()],
        force_n: 5.0,
    };
    let solved = NormalContact::new(cells, modulus).solve(&problem, &mut pressure);
    solved.expect("the contact has a solution");
    // The cells at the peak lie half a cell off it along both axes.
    let at = 1.0 - 2.0 * (1.2_f64 / 72.0).powi(2);
    let found = peak(&pressure) / at.sqrt();
    assert!((found / p0 - 1.0).abs() < 1e-3, "{found}");
    let moment = |axis: &dyn Fn(f64, f64) -> f64| {
        let second = cells.map(axis);
        second
            .iter()
            .zip(&pressure)
            .map(|(s, p)| s * p)
            .sum::<f64>()
    };
    // Second moments of Hertz' pressure are a^2/5, b^2/5.
    let total: f64 = pressure.iter().sum();
    let a = (5.0 * moment(&|x, _| x * x) / total).sqrt();
    let b = (5.0 * moment(&|_, z| z * z) / total).sqrt();
    assert!((a / short - 1.0).abs() < 1e-3, "{a}");
    assert!((b / a / aspect - 1.0).abs() < 1e-3, "{}", b / a);
}

#[test]
fn a_symmetric_gap_has_a_symmetric_pressure() {
    let cells = square(40, 2.8 * HERTZ.0);
    let (pressure, _) = solve(cells, &sphere(&cells), 1e-6, true);
    let mirrored = pressure.iter().rev();
    for (p, q) in pressure.iter().zip(mirrored) {
        assert!((p - q).abs() < 1e-6 * HERTZ.1, "{p} {q}");
    }
}

/// The scale of a contact is arbitrary: lengths times 2 and forces times 4 leave the pressure.
#[test]
fn a_contact_of_twice_the_size_has_the_same_pressure() {
    let cells = square(32, 2.8 * HERTZ.0);
    let (pressure, _) = solve(cells, &sphere(&cells), 1e-6, true);
    let twice = square(32, 5.6 * HERTZ.0);
    let gap = twice.map(|x, z| (x * x + z * z) / (4.0 * RADIUS_MM));
    let mut scaled = vec![0.0; twice.count()];
    let problem = NormalProblem {
        gap_mm: &gap,
        wear_mm_per_mpa: &vec![2e-6; twice.count()],
        force_n: 4.0 * FORCE_N,
    };
    let solved = NormalContact::new(twice, STEEL).solve(&problem, &mut scaled);
    solved.expect("the contact has a solution");
    for (p, q) in pressure.iter().zip(&scaled) {
        assert!((p - q).abs() < 1e-6 * HERTZ.1, "{p} {q}");
    }
}

/// With wear that is large against the deformation, the pressure is that of a bed of springs: p = (delta - h)/d.
#[test]
fn heavy_wear_is_a_bed_of_springs() {
    let wear = 1e-2;
    let cells = square(48, 12.0);
    let (pressure, found) = solve(cells, &sphere(&cells), wear, true);
    let gap = sphere(&cells);
    for (p, h) in pressure.iter().zip(&gap) {
        let bed = (found.approach_mm - h).max(0.0) / wear;
        assert!((p - bed).abs() < 0.01 * peak(&pressure), "{p} {bed}");
    }
}

#[test]
fn the_preconditioner_changes_the_iterations_only() {
    for (count, wear) in [(32, 0.0), (64, 0.0), (128, 0.0), (64, 1e-6), (64, 1e-5)] {
        let cells = square(count, 2.8 * HERTZ.0 * if wear > 5e-6 { 2.0 } else { 1.0 });
        let gap = sphere(&cells);
        let (with, fast) = solve(cells, &gap, wear, true);
        let (without, slow) = solve(cells, &gap, wear, false);
        assert!(
            fast.iterations < slow.iterations,
            "{count}, {wear}: {fast:?} {slow:?}"
        );
        for (p, q) in with.iter().zip(&without) {
            assert!((p - q).abs() < 1e-3 * HERTZ.1, "{count}, {wear}: {p} {q}");
        }
    }
}

#[test]
fn a_contact_that_its_window_does_not_hold_is_refused() {
    let cells = square(16, 1.8 * HERTZ.0);
    let mut pressure = vec![0.0; cells.count()];
    let problem = NormalProblem {
        gap_mm: &sphere(&cells),
        wear_mm_per_mpa: &vec![0.0; cells.count()],
        force_n: FORCE_N,
    };
    let found = NormalContact::new(cells, STEEL).solve(&problem, &mut pressure);
    assert_eq!(
        found,
        Err(AreaError::ReachesEdge {
            along_x: 16,
            along_z: 16
        })
    );
}

/// A stick zone that does not wear in an annulus that does.
#[test]
fn an_annulus_that_wears_alone_converges_however_much_it_wears() {
    let cells = square(32, 2.8 * HERTZ.0);
    let gap = sphere(&cells);
    let approach_per_pressure = HERTZ.2 / HERTZ.1;
    for factor in [1e-2, 1.0, 1e2, 1e4, 1e6] {
        let worn = factor * approach_per_pressure;
        let wear = cells.map(|x, z| {
            if x.hypot(z) < 0.7 * HERTZ.0 {
                0.0
            } else {
                worn
            }
        });
        let mut pressure = vec![0.0; cells.count()];
        let problem = NormalProblem {
            gap_mm: &gap,
            wear_mm_per_mpa: &wear,
            force_n: FORCE_N,
        };
        let mut contact = NormalContact::new(cells, STEEL);
        let found = contact.solve(&problem, &mut pressure);
        let found = found.expect("the contact has a solution");
        assert!(found.iterations < 40, "{factor}: {found:?}");
        assert!((cells.integral(&pressure) / FORCE_N - 1.0).abs() < 1e-12);
        // Cells that wear that much carry nothing.
        let carried = pressure.iter().zip(&wear).filter(|(_, wear)| **wear > 0.0);
        let share = carried.map(|(p, _)| p * cells.area_mm2()).sum::<f64>() / FORCE_N;
        assert!(factor < 1e4 || share < 1e-2, "{factor}: {share}");
    }
}

/// Random scars that fit the sphere, with pockets where a softer layer is through, solved from the pressure of a part of the contact: many
/// cells overlap a little then.
#[test]
fn worn_contacts_are_solved_from_any_part_of_them() {
    let mut random = fastrand::Rng::with_seed(4);
    for _ in 0..60 {
        let mut between = |least: f64, most: f64| least * (most / least).powf(random.f64());
        let cells = Cells {
            along_x: 128,
            along_z: 48,
            dx_mm: 1.25e-3,
            dz_mm: 1.25e-3 * between(1.0, 4.0),
        };
        let (depth, pocket, radius) = (between(1e-5, 5e-4), between(1e-6, 1e-4), between(0.3, 1.0));
        let (wear, soft) = (between(1e-11, 1e-7), between(1.0, 1e3));
        let (middle, begin) = (between(1e-4, 0.02), between(1e-4, 0.02));
        let is_soft = |x: f64, z: f64| (x - middle).hypot(z) < 0.012;
        let gap = cells.map(|x, z| {
            let unworn = 0.5 * (x * x + z * z) / radius;
            unworn.max(depth) + if is_soft(x, z) { pocket } else { 0.0 }
        });
        let wear = cells.map(|x, z| if is_soft(x, z) { soft * wear } else { wear });
        let begun = |x: f64, z: f64| (x - begin).hypot(z) < 0.006;
        let mut pressure = cells.map(|x, z| if begun(x, z) { 1.0 } else { 0.0 });
        let problem = NormalProblem {
            gap_mm: &gap,
            wear_mm_per_mpa: &wear,
            force_n: 0.3,
        };
        let mut contact = NormalContact::new(cells, 69e3);
        let mut solved = |pressure: &mut [f64]| {
            let found = contact.solve(&problem, pressure);
            found.expect("the contact has a solution")
        };
        let (warm, cold) = (solved(&mut pressure), solved(&mut vec![0.0; cells.count()]));
        let off = warm.approach_mm / cold.approach_mm - 1.0;
        assert!(off.abs() < 1e-7, "{warm:?} {cold:?}");
        assert!(warm.iterations < MOST_ITERATIONS / 2, "{warm:?}");
    }
}
