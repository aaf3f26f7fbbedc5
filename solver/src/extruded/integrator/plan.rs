//! Inputs of the schedule of a run: one jump and one series of increments for all planes.

use crate::along_line::FollowedSection;
use crate::change::Change;
use crate::extruded::cycle::ExtrudedContact;
use crate::extruded::state::Planes;
use crate::schedule::equivalent_wear::EquivalentWear;
use crate::sides::Sides;

impl ExtrudedContact {
    /// All planes as one section, with the mean half-width of single cycles: planes take the load from each other.
    pub(super) fn followed(&self) -> FollowedSection<'_> {
        let states = &self.planes.states;
        let depths = states.iter().map(|state| state.depth.largest_of_each());
        let depth = depths.fold(Sides::default(), |most: Sides<f64>, depth| {
            most.zip(depth).map(|(most, depth)| most.max(depth))
        });
        let planes = states.iter().zip(&self.bodies.shares);
        FollowedSection {
            plane: &self.plane,
            motion: self.plane.motion,
            wear: self.interface.wear,
            depth,
            unworn_half_width: self.common.unworn_half_width,
            neutral_half_width: planes
                .map(|(state, share)| share * state.neutral.half_width)
                .sum(),
            mean_half_width: self.planes.mean_half_width,
        }
    }

    /// Measures what the next jump depends on. Its error is that of the volume: nodes weigh by their width and by the length of their plane.
    pub(super) fn measure_jump(&mut self, before: &Planes, jump: u64) {
        let shares = &self.bodies.shares;
        let widths = self.bodies.operators.sections.as_ref().map(|section| {
            let planes = shares.iter();
            let planes =
                planes.flat_map(|share| section.widths.iter().map(move |width| share * width));
            planes.collect::<Vec<f64>>()
        });
        let depths = |planes: &Planes| {
            Sides::from_fn(|side| {
                let depths = planes.states.iter().flat_map(|state| state.depth.of(side));
                depths.copied().collect::<Vec<f64>>()
            })
        };
        let (before, after) = (depths(before), depths(&self.planes));
        let depth = Change {
            before: &before,
            after: &after,
        };
        let wear = &self.interface.wear;
        let widths = widths.as_slices();
        let worn = EquivalentWear::new(wear, widths, depth);
        let friction = (self.friction).change_at_nodes(wear, widths, depth, worn.depths());
        let control = &mut self.common.jump;
        control.update(worn.weights(), friction, worn.depths(), jump);
    }
}
