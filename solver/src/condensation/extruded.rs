//! Condensation of extruded bodies: prisms over the plane meshes of several sections, onto u_x and u_y of the contact nodes of all of
//! them.
//!
//! As in the plane the contact unknowns are ordered last and the trailing block of the sparse factor is inverted; u_z of the contact nodes is
//! eliminated with the interior, because nothing loads it. Forces are per length, as in the plane: a section stands for the length w_k of the
//! half width, and the nodal forces of its line forces f are w_k f. Sections whose displacements are alike then respond as the plane body,
//!   sum_l C_kl = C (plane strain),
//! and the sections of a contact couple through C_kl, k other than l, alone.

use std::ops::Range;
use std::sync::Arc;

use super::assembly::HELD;
use super::prism_assembly::PrismNumbering;
use super::prism_interior::{self, PrismInterior};
use super::{
    BodyOperators, Compliance, OperatorError, Operators, Response, near_field, zone_operators,
};
use crate::linear::{CholeskyPattern, SquareMatrix};
use crate::mesh::NodePlanes;
use crate::model::{BodyModel, Model, Support};
use crate::scene::Ends;
use crate::sides::{Side, Sides};
use crate::threads::for_both;

/// Condensed extruded bodies.
#[derive(Debug)]
pub struct ExtrudedOperators {
    /// Nodes and unworn surface that all sections have; no responses.
    pub sections: Operators,
    /// Responses of both surfaces, zone by zone.
    pub zones: Sides<Vec<PrismZone>>,
}

/// The response of a mesh of prisms that is fine along some of the contact nodes.
#[derive(Debug)]
pub struct PrismZone {
    /// First contact node of the zone, and their number in a section.
    first: usize,
    nodes: usize,
    /// Displacements per line force, mm per N/mm: nodes in the order of the sections.
    compliance: Compliance,
    /// Displacement per unit of normal load on the far face, mm per N/mm; zero where the far face is held.
    load_response: Vec<f64>,
    pattern: Arc<CholeskyPattern>,
}

impl PrismZone {
    /// Contact nodes in each section.
    pub fn nodes(&self) -> Range<usize> {
        self.first..self.first + self.nodes
    }

    /// The response of a range of nodes of a section to a line force at a node of another.
    pub(crate) fn to_force_at(
        &self,
        section: usize,
        node: usize,
        of_section: usize,
        of: &Range<usize>,
    ) -> Response<'_> {
        let from = |node: usize, section: usize| section * self.nodes + node - self.first;
        let range = from(of.start, of_section)..from(of.end, of_section);
        self.compliance.to_force_at(from(node, section), &range)
    }

    /// Displacement of a node of a section per unit of normal load on the far face, mm per N/mm.
    pub(crate) fn under_load(&self, section: usize, node: usize) -> [f64; 2] {
        let at = 2 * (section * self.nodes + node - self.first);
        [self.load_response[at], self.load_response[at + 1]]
    }

    /// Nodes between a range and the nearer end of the zone on a surface of so many nodes; none if it is not within the zone.
    fn clearance(&self, range: &Range<usize>, surface: usize) -> Option<usize> {
        zone_operators::clearance(&self.nodes(), range, surface)
    }
}

impl ExtrudedOperators {
    /// The zone of a body in whose interior a range of contact nodes lies farthest; none if it is wider than each.
    pub fn zone(&self, side: Side, range: &Range<usize>) -> Option<&PrismZone> {
        let number = self.zone_number(side, range)?;
        self.zones.of(side).get(number)
    }

    /// The number of that zone.
    pub(crate) fn zone_number(&self, side: Side, range: &Range<usize>) -> Option<usize> {
        let (zones, surface) = (self.zones.of(side).iter(), self.sections.of(side).x.len());
        let clearances = zones
            .enumerate()
            .filter_map(|(number, zone)| Some((zone.clearance(range, surface)?, number)));
        let best = clearances.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.map(|(_, number)| number)
    }

    /// Factors the prisms of a zone again, whose sections are those of the models that it was condensed from.
    ///
    /// # Errors
    /// [`OperatorError`] if an element is inverted or the body is not held.
    pub(crate) fn interior(
        &self,
        models: &[Model],
        planes: &NodePlanes,
        ends: Ends,
        side: Side,
        zone: usize,
    ) -> Result<PrismInterior, OperatorError> {
        let bodies: Vec<&BodyModel> = models.iter().map(|m| m.bodies.of(side)).collect();
        let known = self.zones.of(side).get(zone);
        let pattern = known.map(|zone| Arc::clone(&zone.pattern));
        prism_interior::factor(&bodies, zone, side, planes, ends, pattern)
    }
}

/// Condenses both bodies, whose section in each plane is a model. A body whose sections are those of earlier models keeps its responses,
/// one of the same mesh lines its patterns. In more than one thread both are condensed side by side.
///
/// # Errors
/// [`OperatorError`] if an element is inverted or a body is not held.
pub(crate) fn condense_extruded(
    models: &[Model],
    planes: &NodePlanes,
    ends: Ends,
    earlier: Option<(&[Model], Sides<Vec<PrismZone>>)>,
    threads: usize,
) -> Result<ExtrudedOperators, OperatorError> {
    let sections = Sides::from_fn(|side| section_of(models[0].bodies.of(side)));
    let (before, known) = match earlier {
        Some((before, zones)) => (before, zones.map(Some)),
        None => (&[][..], Sides::default()),
    };
    let zones = for_both(threads, known, |side, known| {
        let bodies: Vec<&BodyModel> = models.iter().map(|m| m.bodies.of(side)).collect();
        let mut earlier = before.iter().map(|model| model.bodies.of(side));
        let is_same = |(now, before): (&&BodyModel, &BodyModel)| now.zones == before.zones;
        let is_same = bodies.iter().zip(earlier.clone()).all(is_same);
        if let Some(known) = known.take_if(|_| is_same) {
            return Ok(known);
        }
        let is_alike = earlier
            .next()
            .is_some_and(|before| before.layout == bodies[0].layout);
        let patterns: Vec<Arc<CholeskyPattern>> = known
            .take()
            .filter(|_| is_alike)
            .map(|zones| zones.into_iter().map(|zone| zone.pattern).collect())
            .unwrap_or_default();
        let condense = |zone: usize| {
            let pattern = patterns.get(zone).cloned();
            condense_zone(&bodies, zone, side, planes, ends, pattern)
        };
        (0..bodies[0].zones.len()).map(condense).collect()
    });
    Ok(ExtrudedOperators {
        sections,
        zones: zones.transpose()?,
    })
}

fn section_of(body: &BodyModel) -> BodyOperators {
    BodyOperators {
        x: body.contact_x().to_vec(),
        widths: body.contact_widths(),
        profile: body.layout.profile,
        zones: Vec::new(),
    }
}

fn condense_zone(
    bodies: &[&BodyModel],
    zone: usize,
    side: Side,
    planes: &NodePlanes,
    ends: Ends,
    pattern: Option<Arc<CholeskyPattern>>,
) -> Result<PrismZone, OperatorError> {
    let interior = prism_interior::factor(bodies, zone, side, planes, ends, pattern)?;
    let PrismInterior {
        numbering,
        factor,
        far_load: mut response,
        lengths,
    } = interior;
    let first_section = &bodies[0].zones[zone];
    let first = bodies[0].first_node(first_section);
    let nodes = first_section.zone.nodes();
    let mut compliance = per_line_force(&numbering, &factor.retained_inverse(), &lengths);
    let load_response = match first_section.support {
        Support::FarFaceHeld => {
            let widths = &bodies[0].contact_widths()[first..first + nodes];
            equalise(&mut compliance, widths, planes.count());
            vec![0.0; numbering.place.len()]
        }
        Support::GuidedUnderPressure => {
            factor.solve(&mut response);
            let first = numbering.order - numbering.retained;
            let at = |p: &usize| if *p == HELD { 0.0 } else { response[first + p] };
            numbering.place.iter().map(at).collect()
        }
    };
    Ok(PrismZone {
        first,
        nodes,
        compliance,
        load_response,
        pattern: Arc::clone(factor.pattern()),
    })
}

/// The inverse over the retained unknowns as displacements of all contact unknowns per line force, zero where they are held.
fn per_line_force(
    numbering: &PrismNumbering,
    retained: &SquareMatrix,
    lengths: &[f64],
) -> Compliance {
    let place = &numbering.place;
    let of_section = place.len() / lengths.len();
    let mut all = Compliance::zeros(place.len() / 2);
    for (column, &c) in place.iter().enumerate().filter(|(_, c)| **c != HELD) {
        let length = lengths[column / of_section];
        for (row, &r) in place.iter().enumerate().filter(|(_, r)| **r != HELD) {
            *all.at(row, column) = length * retained.get(r, c);
        }
    }
    all
}

/// Replaces the near field of tangential forces by that of normal ones, as in the plane: for line forces that are alike in all sections,
/// where they act.
fn equalise(compliance: &mut Compliance, widths: &[f64], sections: usize) {
    let n = widths.len();
    for k in 0..sections {
        let mut line = Compliance::zeros(n);
        for d in 0..2 {
            for j in 0..n {
                for i in 0..n {
                    let mut sum = 0.0;
                    for l in 0..sections {
                        let (row, column) = (2 * (k * n + i) + d, 2 * (l * n + j) + d);
                        sum += compliance.get(row, column);
                    }
                    *line.at(2 * i + d, 2 * j + d) = sum;
                }
            }
        }
        // Between free ends the sections respond unlike, so that it is not symmetric.
        for (j, i) in (0..n).flat_map(|j| (0..j).map(move |i| (j, i))) {
            for d in 0..2 {
                let (one, other) = (2 * i + d, 2 * j + d);
                let mean = 0.5 * (line.get(one, other) + line.get(other, one));
                *line.at(one, other) = mean;
                *line.at(other, one) = mean;
            }
        }
        let mut near = line.clone();
        near_field::equalise(&mut near, widths);
        for j in 0..n {
            for i in 0..n {
                let change = near.get(2 * i, 2 * j) - line.get(2 * i, 2 * j);
                *compliance.at(2 * (k * n + i), 2 * (k * n + j)) += change;
            }
        }
    }
}

#[cfg(test)]
mod tests;
