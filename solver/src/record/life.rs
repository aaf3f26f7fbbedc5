//! Life: the cycles until each criterion of a scene is reached.
//!
//! Between two computed cycles the dose of the deepest point is taken as linear in the cycles, which is exact for a pressure
//! that does not change; an exposed part is taken as linear itself.

use serde::{Deserialize, Serialize};

use super::CycleReport;
use crate::number::real_cycles;
use crate::scene::{Criterion, Scene};
use crate::sides::Side;

/// Life by the criteria of a scene, in their order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Life {
    /// One entry a criterion.
    pub lived: Vec<Lived>,
    /// Cycle of the last report.
    cycle: u64,
}

/// How far a criterion is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Lived {
    /// Physical cycles at which it was reached; `None` if it was not.
    pub cycles: Option<f64>,
    /// Value at the last report: worn depth, mm, or exposed part of the scar, -.
    pub value: f64,
    /// Value that counts as reached.
    pub limit: f64,
    /// Measure at the last report, and at the limit: the equivalent depth, mm, or the exposed part, -.
    measure: [f64; 2],
}

impl Life {
    /// Takes the report of the next computed cycle.
    pub fn push(&mut self, scene: &Scene, report: &CycleReport) {
        self.lived.resize(scene.life.len(), Lived::default());
        for (lived, criterion) in self.lived.iter_mut().zip(&scene.life) {
            let last = *lived;
            *lived = Lived {
                cycles: last.cycles,
                ..at(scene, *criterion, report)
            };
            let [measure, limit] = lived.measure;
            if lived.cycles.is_none() && lived.value >= lived.limit {
                let step = real_cycles(report.cycle - self.cycle);
                let share = (limit - last.measure[0]) / (measure - last.measure[0]);
                lived.cycles = Some(real_cycles(self.cycle) + share.clamp(0.0, 1.0) * step);
            }
        }
        self.cycle = report.cycle;
    }
}

/// How far a criterion is in a report.
fn at(scene: &Scene, criterion: Criterion, report: &CycleReport) -> Lived {
    match criterion {
        Criterion::WornDepth { side, depth_mm } => {
            let of = |side| worn_depth(scene, side, depth_mm, report);
            side.map_or_else(
                || {
                    let (slider, receptacle) = (of(Side::Slider), of(Side::Receptacle));
                    if slider.value > receptacle.value {
                        slider
                    } else {
                        receptacle
                    }
                },
                of,
            )
        }
        Criterion::ExposedFraction {
            side,
            layer,
            fraction,
        } => {
            let value = report.exposed_fraction(side, layer);
            Lived {
                cycles: None,
                value,
                limit: fraction,
                measure: [value, fraction],
            }
        }
    }
}

fn worn_depth(scene: &Scene, side: Side, limit: f64, report: &CycleReport) -> Lived {
    let wear = *scene.surface_wear().of(side);
    let equivalent = |depth| wear.map_or(depth, |wear| wear.equivalent(depth));
    let value = report.side(side).max_depth_mm;
    Lived {
        cycles: None,
        value,
        limit,
        measure: [equivalent(value), equivalent(limit)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::record::SideReport;
    use crate::scene::{Layer, WearLaw};

    fn report(cycle: u64, depth: f64, exposed: f64) -> CycleReport {
        let mut report = CycleReport {
            cycle,
            receptacle: SideReport {
                max_depth_mm: depth,
                scar_half_width_mm: 0.5,
                ..SideReport::default()
            },
            ..CycleReport::default()
        };
        report.exposed_length_mm.receptacle = vec![exposed];
        report
    }

    #[test]
    fn criteria_are_reached_between_computed_cycles_by_the_dose() {
        let mut scene = fuzz_button();
        scene.receptacle.plating = vec![Layer {
            thickness_mm: 1e-3,
            rate_per_mpa: 1e-8,
        }];
        scene.receptacle.wear = Some(WearLaw::Archard {
            k_over_h_per_mpa: 4e-8,
        });
        let depth = |side, depth_mm| Criterion::WornDepth { side, depth_mm };
        scene.life = vec![
            depth(Some(Side::Receptacle), 1e-3),
            depth(None, 2e-3),
            Criterion::ExposedFraction {
                side: Side::Receptacle,
                layer: 0,
                fraction: 0.5,
            },
            depth(Some(Side::Slider), 1e-3),
        ];
        let mut life = Life::default();
        // 1 um of the layer in 100 cycles, so 3 um in the 75 cycles after these.
        life.push(&scene, &report(50, 0.5e-3, 0.0));
        assert!(life.lived.iter().all(|lived| lived.cycles.is_none()));
        life.push(&scene, &report(175, 4e-3, 0.8));
        let cycles: Vec<_> = life.lived.iter().map(|lived| lived.cycles).collect();
        let expected = [Some(100.0), Some(125.0), Some(50.0 + 125.0 * 0.625), None];
        for (found, expected) in cycles.iter().zip(expected) {
            assert_eq!(found.is_some(), expected.is_some());
            let apart = found.unwrap_or(0.0) - expected.unwrap_or(0.0);
            assert!(apart.abs() < 1e-9, "{found:?} {expected:?}");
        }
        // What is reached stays.
        life.push(&scene, &report(200, 5e-3, 0.9));
        assert_eq!(life.lived[0].cycles.map(f64::round), Some(100.0));
        assert!((life.lived[0].value - 5e-3).abs() < 1e-15);
    }
}
