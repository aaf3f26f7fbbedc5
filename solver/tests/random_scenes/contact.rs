//! The two bodies of a random scene and their unworn contact.

use std::f64::consts::PI;

use fastrand::Rng;
use solver::law::elastic::contact_modulus;
use solver::scene::{BlockShape, Drive, Elastic, SliderShape};

/// Random numbers.
pub(super) struct Numbers(pub(super) Rng);

impl Numbers {
    pub(super) fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.0.f64()
    }

    /// By its logarithm.
    pub(super) fn log(&mut self, from: f64, to: f64) -> f64 {
        from * (to / from).powf(self.0.f64())
    }

    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.0.f64() < probability
    }
}

/// The unworn contact.
pub(super) struct Contact {
    pub(super) slider: Elastic,
    pub(super) receptacle: Elastic,
    radius: f64,
    crown: Option<f64>,
    /// Radius of the relative curvature, mm.
    pub(super) relative: f64,
    pub(super) half_width: f64,
    pub(super) load: f64,
}

pub(super) fn draw(u: &mut Numbers) -> Contact {
    let (slider, receptacle) = (elastic(u), elastic(u));
    let radius = u.log(0.05, 20.0);
    let crown = u.chance(0.25).then(|| radius * u.log(0.5, 20.0));
    let relative = 1.0 / (1.0 / radius + crown.map_or(0.0, |crown| 1.0 / crown));
    // Small strains allow 0.03 and more (`solver::effects`).
    let half_width = relative * u.log(0.002, 0.02);
    Contact {
        slider,
        receptacle,
        radius,
        crown,
        relative,
        half_width,
        load: 0.25 * PI * contact_modulus(slider, receptacle) * half_width.powi(2) / relative,
    }
}

/// From soft plastics to twice steel.
fn elastic(u: &mut Numbers) -> Elastic {
    Elastic {
        youngs_modulus_mpa: u.log(2e3, 4e5),
        poisson_ratio: u.within(0.1, 0.45),
    }
}

fn sagitta(radius: f64, half: f64) -> f64 {
    radius - (radius * radius - half * half).max(0.0).sqrt()
}

/// Bodies that reach beyond the contact, `last` wide in the end, by two to nineteen of its half-widths.
pub(super) fn shapes(
    u: &mut Numbers,
    contact: &Contact,
    travel: f64,
    last: f64,
) -> (SliderShape, BlockShape) {
    let &Contact { radius, crown, .. } = contact;
    let half_width = (last * u.log(3.0, 20.0)).min(radius);
    // A crown spans the block.
    let widest = crown.map_or(f64::INFINITY, |crown| 0.8 * crown);
    let half_block = (travel + last * u.log(3.0, 20.0)).min(widest);
    let crowned = crown.map_or(0.0, |crown| sagitta(crown, half_block));
    let slider = SliderShape {
        radius_mm: radius,
        half_width_mm: half_width,
        height_mm: (half_width * u.log(1.0, 3.0)).max(2.0 * sagitta(radius, half_width)),
    };
    let block = BlockShape {
        length_mm: 2.0 * half_block,
        height_mm: (half_block * u.log(0.5, 2.0)).max(2.0 * crowned),
        crown_radius_mm: crown,
    };
    (slider, block)
}

/// Displacement of gross slip: mu P times the compliance of each body under a tangential line load on its surface, that of a
/// strip of its smaller length (`solver::model`) and that of a beam held at its far face. A slider that is displaced as a
/// whole does not deform so.
pub(super) fn gross_slip(
    contact: &Contact,
    slider: SliderShape,
    block: BlockShape,
    drive: Drive,
    friction: f64,
) -> f64 {
    let displaced = |(height, half): (f64, f64), elastic: Elastic| {
        let Elastic {
            youngs_modulus_mpa,
            poisson_ratio,
        } = elastic;
        let compliance = (1.0 - poisson_ratio.powi(2)) / youngs_modulus_mpa;
        let strip = (2.0 * (4.0 * height.min(half) / contact.half_width).ln() - 1.0) / PI;
        let slender = height / half;
        let beam = 0.5 * slender.powi(3) + 1.2 * slender / (1.0 - poisson_ratio);
        friction * contact.load * compliance * (strip + beam)
    };
    let upper = match drive {
        Drive::Handle => displaced((slider.height_mm, slider.half_width_mm), contact.slider),
        Drive::WholeBody => 0.0,
    };
    upper + displaced((block.height_mm, 0.5 * block.length_mm), contact.receptacle)
}
