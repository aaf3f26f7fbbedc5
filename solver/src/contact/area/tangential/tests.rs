use std::f64::consts::PI;

use super::*;
use crate::contact::area::normal::{NormalContact, NormalProblem};
use crate::law::elastic::{Elastic, contact_modulus};

const STEEL: Elastic = Elastic {
    youngs_modulus_mpa: 200e3,
    poisson_ratio: 0.3,
};
const FRICTION: f64 = 0.6;
/// Half-length of Hertz' sphere of 10 mm under 100 N, mm.
const HALF_LENGTH: f64 = 0.189_686;
/// Displacement at a shear force of 30 N of Mindlin's sphere, mm: 3 mu F (2 - nu)/(16 G' a) of both bodies.
const DISPLACEMENT: f64 = 9.700_4e-4;

/// Bounds mu p of the sphere on these cells.
fn sphere(count: usize) -> (TangentialContact, Vec<f64>) {
    let size = 2.4 * HALF_LENGTH / real(count);
    let cells = Cells {
        along_x: count,
        along_z: count,
        dx_mm: size,
        dz_mm: size,
    };
    let gap = cells.map(|x, z| (x * x + z * z) / 20.0);
    let problem = NormalProblem {
        gap_mm: &gap,
        wear_mm_per_mpa: &vec![0.0; cells.count()],
        force_n: 100.0,
    };
    let mut pressure = vec![0.0; cells.count()];
    let solved =
        NormalContact::new(cells, contact_modulus(STEEL, STEEL)).solve(&problem, &mut pressure);
    solved.expect("the contact has a solution");
    let compliance = ShearCompliance::new([STEEL, STEEL]);
    let bound = pressure.iter().map(|p| FRICTION * p).collect();
    (TangentialContact::new(cells, compliance), bound)
}

/// Radius of the circle of the area that sticks, over the half-length.
fn stick_radius(contact: &TangentialContact, shear: &Shear, bound: &[f64]) -> f64 {
    let vectors = shear.along.iter().zip(&shear.across).zip(bound);
    let sticks = vectors.filter(|((x, z), bound)| x.hypot(**z) < (1.0 - 1e-6) * **bound);
    (contact.cells.area_mm2() * real(sticks.count()) / PI).sqrt() / HALF_LENGTH
}

#[test]
fn a_sphere_under_shear_meets_mindlin() {
    let (mut contact, bound) = sphere(64);
    let mut shear = Shear::zero(bound.len());
    let found = contact.advance((DISPLACEMENT, 0.0), &bound, &mut shear);
    let found = found.expect("it converges");
    let force = contact.cells.integral(&shear.along);
    // Mindlin neglects the shear across, and the direction of slip.
    assert!((force / 30.0 - 1.0).abs() < 5e-4, "{force} {found:?}");
    let radius = stick_radius(&contact, &shear, &bound);
    assert!((radius / 0.793_70 - 1.0).abs() < 0.01, "{radius}");
    assert!(contact.cells.integral(&shear.across).abs() < 1e-6);
    assert!(found.iterations < 400, "{}", found.iterations);
}

#[test]
fn a_loop_dissipates_mindlins_energy() {
    let (mut contact, bound) = sphere(48);
    let mut shear = Shear::zero(bound.len());
    let mut energy = 0.0;
    for (step, displacement) in [DISPLACEMENT, -2.0 * DISPLACEMENT, 2.0 * DISPLACEMENT]
        .into_iter()
        .enumerate()
    {
        let found = contact.advance((displacement, 0.0), &bound, &mut shear);
        let found = found.expect("it converges");
        if step > 0 {
            energy += found.energy_mj;
        }
    }
    assert!((energy / 4.431_3e-3 - 1.0).abs() < 0.02, "{energy}");
}

/// Back at no force the annulus that has slipped the other way reaches to 0.90856 of the half-length.
#[test]
fn an_unloaded_sphere_has_slipped_back_at_its_edge() {
    let (mut contact, bound) = sphere(64);
    let mut shear = Shear::zero(bound.len());
    let back = 9.150e-4;
    for displacement in [DISPLACEMENT, -back] {
        let found = contact.advance((displacement, 0.0), &bound, &mut shear);
        found.expect("it converges");
    }
    let force = contact.cells.integral(&shear.along);
    assert!(force.abs() < 0.1, "{force}");
    let radius = stick_radius(&contact, &shear, &bound);
    assert!((radius / 0.908_56 - 1.0).abs() < 0.01, "{radius}");
}

#[test]
fn gross_slip_shears_by_the_bound_along_the_displacement() {
    let (mut contact, bound) = sphere(24);
    let mut shear = Shear::zero(bound.len());
    let found = contact.advance((0.03, 0.04), &bound, &mut shear);
    let found = found.expect("it converges");
    let force = (
        contact.cells.integral(&shear.along),
        contact.cells.integral(&shear.across),
    );
    assert!(
        (force.0 / 36.0 - 1.0).abs() < 1e-3 && (force.1 / 48.0 - 1.0).abs() < 1e-3,
        "{force:?}"
    );
    // mu F times the path less the elastic deformation.
    assert!(
        found.energy_mj < 60.0 * 0.05 && found.energy_mj > 60.0 * 0.045,
        "{}",
        found.energy_mj
    );
}
