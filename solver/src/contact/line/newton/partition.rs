//! Partition of the coupled nodes: which tractions are solved for, and which of them may change their status without another
//! factorisation.
//!
//! From one iteration to the next statuses change at the edges of the contact and of its stick zones. The nodes there are the
//! border of the condensed system, all others its core.

use super::super::problem::{Iterate, Problem};
use super::super::status::Status;
use super::super::unknown::Unknown;

/// Nodes on either side of an edge that belong to the border. Arbitrary: with 1, 2 and 3 of them `fuzz_button.json` at 0.02
/// takes 1.47, 1.55 and 1.58 s to 500 cycles, `mccoll.json` at 0.003 5.1, 5.2 and 5.3 s.
const EDGE: usize = 1;

/// Statuses that the unknowns of a node allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AdmissibleStatuses {
    /// Open.
    Outside,
    /// This status.
    Core(Status),
    /// Open, or slipping in this direction.
    Edge(Status),
    /// Anything.
    Any,
}

/// The unknowns of an increment.
#[derive(Debug, Default)]
pub(super) struct Partition {
    /// Unknowns of the core, then those of the border.
    pub(super) unknowns: Vec<Unknown>,
    /// Number of unknowns of the core.
    pub(super) core: usize,
    admissible: Vec<AdmissibleStatuses>,
}

impl Partition {
    /// Chooses the unknowns for the statuses of an iterate.
    pub(super) fn choose(&mut self, it: &Iterate) {
        self.admissible.clear();
        self.admissible
            .extend((0..it.status.len()).map(|i| admissible(it, i)));
        self.unknowns.clear();
        for (node, statuses) in self.admissible.iter().enumerate() {
            if let AdmissibleStatuses::Core(status) = *statuses {
                self.unknowns.push(Unknown::Pressure(node, status));
                if status == Status::Stick {
                    self.unknowns.push(Unknown::Shear(node));
                }
            }
        }
        self.core = self.unknowns.len();
        for (node, statuses) in self.admissible.iter().enumerate() {
            match *statuses {
                AdmissibleStatuses::Edge(status) => {
                    self.unknowns.push(Unknown::Pressure(node, status));
                }
                AdmissibleStatuses::Any => {
                    self.unknowns.push(Unknown::Pressure(node, Status::Stick));
                    self.unknowns.push(Unknown::Shear(node));
                }
                AdmissibleStatuses::Outside | AdmissibleStatuses::Core(_) => {}
            }
        }
    }

    /// Returns `true` if the unknowns allow the statuses of an iterate.
    pub(super) fn admits(&self, it: &Iterate) -> bool {
        let admits = |(statuses, status): (&AdmissibleStatuses, &Status)| match *statuses {
            AdmissibleStatuses::Outside => *status == Status::Open,
            AdmissibleStatuses::Core(own) => *status == own,
            AdmissibleStatuses::Edge(own) => *status == own || *status == Status::Open,
            AdmissibleStatuses::Any => true,
        };
        self.admissible.iter().zip(&it.status).all(admits)
    }

    /// The load less the vertical forces of the unknowns, N/mm.
    pub(super) fn balance(&self, problem: &Problem<'_>, it: &Iterate) -> f64 {
        let load = problem.load + problem.spring * it.height;
        let weight = problem.force_weight();
        let forces = self.unknowns.iter();
        forces.fold(load, |balance, unknown| {
            balance - weight * unknown.force(problem)[1] * unknown.value(it)
        })
    }

    /// The status that a node's part of the wear is linearised in.
    pub(super) fn status(&self, it: &Iterate, node: usize) -> Status {
        match self.admissible[node] {
            AdmissibleStatuses::Core(status) | AdmissibleStatuses::Edge(status) => status,
            AdmissibleStatuses::Outside | AdmissibleStatuses::Any => it.status[node],
        }
    }
}

fn admissible(it: &Iterate, node: usize) -> AdmissibleStatuses {
    let end = (node + EDGE + 1).min(it.status.len());
    let near = it.status[node.saturating_sub(EDGE)..end].iter();
    let mut closed = near.clone().filter(|status| **status != Status::Open);
    let Some(&status) = closed.next() else {
        return AdmissibleStatuses::Outside;
    };
    let is_stick_edge = closed.any(|other| *other != status);
    let is_contact_edge = near.clone().any(|status| *status == Status::Open);
    if is_stick_edge || (is_contact_edge && status == Status::Stick) {
        AdmissibleStatuses::Any
    } else if is_contact_edge {
        AdmissibleStatuses::Edge(status)
    } else {
        AdmissibleStatuses::Core(status)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Status::{Open, SlipRight, Stick};

    fn iterate(status: &[Status]) -> Iterate {
        Iterate {
            status: status.to_vec(),
            ..Iterate::default()
        }
    }

    #[test]
    fn nodes_at_edges_form_the_border_and_may_change() {
        let mut statuses = [SlipRight; 12];
        statuses[..4].fill(Open);
        let mut partition = Partition::default();
        let mut it = iterate(&statuses);
        partition.choose(&it);
        // Nodes 3 and 4 are the edge; the last ones end with the coupled nodes, not with the contact.
        assert_eq!((partition.core, partition.unknowns.len()), (7, 9));
        for (node, status, admitted) in [
            (3, SlipRight, true),
            (4, Open, true),
            (4, Stick, false),
            (7, Open, false),
            (1, SlipRight, false),
        ] {
            it.status = statuses.to_vec();
            it.status[node] = status;
            assert_eq!(partition.admits(&it), admitted, "{node} {status:?}");
        }
    }

    #[test]
    fn nodes_at_the_edge_of_a_stick_zone_have_both_tractions() {
        let mut statuses = [SlipRight; 12];
        statuses[6..].fill(Stick);
        let mut partition = Partition::default();
        let mut it = iterate(&statuses);
        partition.choose(&it);
        // Two nodes at the edge with two unknowns each; five slipping and five sticking nodes besides.
        assert_eq!((partition.core, partition.unknowns.len()), (15, 19));
        it.status[6] = SlipRight;
        it.status[5] = Open;
        assert!(partition.admits(&it));
        it.status[9] = SlipRight;
        assert!(!partition.admits(&it));
    }
}
