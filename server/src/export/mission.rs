//! Worn depths of the blocks of a mission.

use api::results::{BlockExtent, BlockSide, BlockSummary};
use solver::record::{BlockWear, Side, Summary};

use crate::number::real;

/// The blocks of a finished run. A mission of one block has worn everything by it.
pub(crate) fn blocks(planned: &[BlockExtent], summary: &Summary) -> Vec<BlockSummary> {
    let worn = summary.block_wear();
    let total = |side: Side| {
        let areas = worn.iter().map(move |block| *block.worn_area_mm2.of(side));
        areas.sum::<f64>()
    };
    let totals = [total(Side::Slider), total(Side::Receptacle)];
    let planned = planned.iter().zip(&worn);
    planned
        .map(|(planned, worn)| BlockSummary {
            extent: done(planned, worn),
            dissipated_energy_mj_per_mm: worn.energy_mj_per_mm,
            slider: side(worn, Side::Slider, totals[0]),
            receptacle: side(worn, Side::Receptacle, totals[1]),
        })
        .collect()
}

/// Computed part of a block.
fn done(planned: &BlockExtent, worn: &BlockWear) -> BlockExtent {
    let part = real(worn.cycles) / real(planned.cycles);
    BlockExtent {
        cycles: worn.cycles,
        sliding_distance_mm: worn.sliding_distance_mm,
        duration_h: part * planned.duration_h,
        ..planned.clone()
    }
}

fn side(worn: &BlockWear, side: Side, total: f64) -> BlockSide {
    let area = *worn.worn_area_mm2.of(side);
    BlockSide {
        worn_area_mm2: area,
        share: if total > 0.0 { area / total } else { 0.0 },
        share_of_deepest: *worn.share_of_deepest.of(side),
    }
}
