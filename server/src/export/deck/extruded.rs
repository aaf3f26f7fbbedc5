//! The deck of extruded bodies: half of their width, the middle being a mirror plane, of C3D8I over quadrilaterals and C3D6 over triangles.
//!
//! C3D8I has incompatible modes, as the elements here. The slider's top is as in the deck of a section, and held along z; the load is half of
//! that of the whole width.

use solver::extruded::ExtrudedScene;
use solver::mesh::{NodePlanes, Prism, PrismMesh};
use solver::model::{Model, ZoneModel};
use solver::scene::{Elastic, Ends};
use solver::sides::Side;

use crate::export::deck::{Deck, PENALTY, Part, first_gap, listed};

/// The deck of bodies whose section in each node plane is a model; without the second step if the motion has no amplitude.
pub fn inp(bodies: &ExtrudedScene, models: &[Model]) -> String {
    let scene = &bodies.section;
    let mut deck = Deck::default();
    let width = bodies.width_mm;
    deck.line(format!(
        "*HEADING\nfretwear: mm, N, MPa; half of a width of {width} mm, mirror plane z = {}",
        0.5 * width
    ));
    let gaps = models.iter().map(|model| {
        let bodies = &model.bodies;
        first_gap(&bodies.slider, &bodies.receptacle)
    });
    let lowered = -gaps.fold(f64::INFINITY, f64::min);
    let planes = bodies.planes();
    let sections = |side: Side| -> Vec<&ZoneModel> {
        let bodies = models.iter().map(|model| model.bodies.of(side));
        bodies.map(|body| &body.zones[body.zone_at(0.0)]).collect()
    };
    let slider = sections(Side::Slider);
    let slider = deck.prisms("SLIDER", &slider, lowered, &planes, scene.slider.elastic);
    let receptacle = sections(Side::Receptacle);
    deck.prisms(
        "RECEPTACLE",
        &receptacle,
        0.0,
        &planes,
        scene.receptacle.elastic,
    );
    deck.contact(scene, &models[0], PENALTY);
    deck.boundary(&slider);
    deck.line("RECEPTACLE_FAR, 3, 3\nSLIDER_FAR, 3, 3");
    let held = match bodies.ends {
        Ends::Free => "SLIDER_MIRROR, 3, 3\nRECEPTACLE_MIRROR, 3, 3",
        Ends::Held => "SLIDER, 3, 3\nRECEPTACLE, 3, 3",
    };
    deck.line(held);
    deck.load_step(0.5 * bodies.force_n(), &slider);
    let amplitude = scene.largest_amplitude_mm();
    if amplitude > 0.0 {
        deck.motion_step(amplitude);
    }
    deck.text
}

impl Deck {
    /// A body of prisms, moved up by a height in mm.
    fn prisms(
        &mut self,
        name: &str,
        sections: &[&ZoneModel],
        by: f64,
        planes: &NodePlanes,
        elastic: Elastic,
    ) -> Part {
        let meshes = sections.iter().map(|section| &section.mesh);
        let mesh = PrismMesh::new(meshes.collect(), planes);
        let first_node = self.nodes + 1;
        self.line(format!("*NODE, NSET={name}"));
        for [x, y, z] in mesh.coordinates() {
            self.nodes += 1;
            let line = format!("{}, {x:.12e}, {:.12e}, {z:.12e}", self.nodes, y + by);
            self.line(line);
        }
        let prisms = mesh.prisms();
        let first_element = self.elements + 1;
        for (kind, corners) in [("C3D8I", 8), ("C3D6", 6)] {
            let of_kind = |prism: &&Prism| nodes_of(prism).len() == corners;
            if prisms.iter().any(|prism| of_kind(&prism)) {
                self.line(format!("*ELEMENT, TYPE={kind}, ELSET={name}"));
            }
            for (element, prism) in prisms
                .iter()
                .enumerate()
                .filter(|(_, prism)| of_kind(prism))
            {
                let ids = listed(nodes_of(prism).iter().map(|node| first_node + node));
                self.line(format!("{}, {ids}", first_element + element));
            }
        }
        self.elements += prisms.len();
        self.material(name, elastic, "");
        self.faces(name, &mesh, &prisms, first_element);
        let (section, nodes) = (&sections[0].mesh, mesh.nodes_of_section());
        let spines = section.spines();
        let in_planes = |of: &dyn Fn(usize) -> usize, along: std::ops::Range<usize>| {
            let planes = 0..mesh.sections();
            let all = planes.flat_map(|plane| along.clone().map(move |i| (plane, i)));
            all.map(|(plane, i)| first_node + plane * nodes + of(i))
                .collect::<Vec<usize>>()
        };
        let contact = sections[0].zone.contact;
        let far = in_planes(&|i| section.far_node(i), 0..spines);
        let near = in_planes(&|i| section.surface_node(i), contact.0..contact.1);
        let mirror = first_node + (mesh.sections() - 1) * nodes;
        self.set(&format!("{name}_FAR"), &far);
        self.set(&format!("{name}_NEAR"), &near);
        let mirror: Vec<usize> = (mirror..mirror + nodes).collect();
        self.set(&format!("{name}_MIRROR"), &mirror);
        Part {
            control_node: far[spines / 2],
            far,
        }
    }

    /// The faces of the contact surface: the edge k of a section is the face k + 3 of the prism over it.
    fn faces(&mut self, name: &str, mesh: &PrismMesh<'_>, prisms: &[Prism], first_element: usize) {
        self.line(format!("*SURFACE, NAME={name}_FACE, TYPE=ELEMENT"));
        let (section, nodes) = (mesh.section(0), mesh.nodes_of_section());
        let near: Vec<usize> = (0..section.spines())
            .map(|i| section.surface_node(i))
            .collect();
        for (element, prism) in prisms.iter().enumerate() {
            let all = nodes_of(prism);
            let corners = all.len() / 2;
            let on_surface = |k: usize| near.binary_search(&(all[k % corners] % nodes)).is_ok();
            if let Some(edge) = (0..corners).find(|&k| on_surface(k) && on_surface(k + 1)) {
                self.line(format!("{}, S{}", first_element + element, edge + 3));
            }
        }
    }
}

fn nodes_of(prism: &Prism) -> &[usize] {
    match prism {
        Prism::Hexahedron(nodes) => nodes,
        Prism::Wedge(nodes) => nodes,
    }
}
