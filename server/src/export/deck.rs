//! The model as an input deck for Abaqus and CalculiX, for a check of the contact with another code.
//!
//! Plane strain CPE4 and CPE3, the receptacle's bottom fixed, the slider's top rigid (`u_x` prescribed, `u_y` tied by
//! `*EQUATION` to its middle node, the control node, which carries the load), surface-to-surface contact with Coulomb
//! friction. The first step applies the load, the second moves the slider's top by the amplitude, if there is one.
//! Units: mm, N, MPa, one mm of depth.

pub mod cycle;
pub mod extruded;

use solver::interpolation;
use solver::law::elastic::Lame;
use solver::mesh::columns::Cell;
use solver::model::{BodyModel, Model, ZoneModel};
use solver::scene::Effect;
use solver::scene::{Elastic, Scene};
use solver::sides::Sides;

/// Penalty stiffness over E / (size of a contact element): high enough for an overlap of 1 % of an indentation.
const PENALTY: f64 = 50.0;
/// Stick slope over the penalty stiffness.
const STICK_SLOPE: f64 = 0.1;
/// Node numbers per line of a set.
const LINE: usize = 8;
/// Output and end of a step.
const OUTPUT: &str = "\
*NODE PRINT, NSET=RECEPTACLE_NEAR, FREQUENCY=1000
U
*NODE PRINT, NSET=SLIDER_FAR, FREQUENCY=1000
U
*NODE FILE, FREQUENCY=1000
U
*EL FILE, FREQUENCY=1000
S
*CONTACT FILE, FREQUENCY=1000
CDIS, CSTR
*END STEP";

/// The deck; without the second step if the motion has no amplitude.
pub fn inp(scene: &Scene, model: &Model) -> String {
    let mut deck = Deck::default();
    let slider = deck.bodies_and_contact(scene, model, PENALTY);
    deck.load_step(scene.load_n_per_mm, &slider);
    let amplitude = scene.largest_amplitude_mm();
    if amplitude > 0.0 {
        deck.motion_step(amplitude);
    }
    deck.text
}

/// Smallest vertical gap at the receptacle's contact nodes, mm, by which worn bodies are brought into contact.
fn first_gap(slider: &BodyModel, receptacle: &BodyModel) -> f64 {
    let (x, y) = (&slider.layout.x, slider.surface_y());
    let places = receptacle.layout.x.iter().zip(receptacle.surface_y());
    let under = places.filter(|(at, _)| **at >= x[0] && **at <= x[x.len() - 1]);
    let gaps = under.map(|(&at, below)| interpolation::linear(x, y, at) - below);
    gaps.fold(f64::INFINITY, f64::min)
}

/// Node numbers of the far side of a body in the deck.
struct Part {
    control_node: usize,
    far: Vec<usize>,
}

#[derive(Default)]
struct Deck {
    text: String,
    nodes: usize,
    elements: usize,
}

impl Deck {
    fn line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }

    /// Bodies, contact and supports; returns the slider.
    fn bodies_and_contact(&mut self, scene: &Scene, model: &Model, penalty: f64) -> Part {
        self.line("*HEADING\nfretwear: mm, N, MPa; plane strain, one mm of depth");
        let bodies = &model.bodies;
        let lowered = -first_gap(&bodies.slider, &bodies.receptacle);
        let at_neutral = |body: &BodyModel| {
            if body.zones.len() > 1 {
                self.line("** elements are small near the neutral position only");
            }
            body.zones[body.zone_at(0.0)].clone()
        };
        let Sides { slider, receptacle } = bodies.as_ref().map(at_neutral);
        let slider = self.body("SLIDER", &slider, scene.slider.elastic, lowered);
        let elastic = scene.receptacle.elastic;
        self.body("RECEPTACLE", &receptacle, elastic, 0.0);
        self.contact(scene, model, penalty);
        self.boundary(&slider);
        slider
    }

    fn body(&mut self, name: &str, model: &ZoneModel, elastic: Elastic, by: f64) -> Part {
        debug_assert!(
            model.lame == Lame::from(elastic),
            "the model was built from the scene"
        );
        let first_node = self.nodes + 1;
        self.line(format!("*NODE, NSET={name}"));
        for node in model.mesh.coordinates() {
            self.nodes += 1;
            let line = format!("{}, {:.12e}, {:.12e}", self.nodes, node[0], node[1] + by);
            self.line(line);
        }
        let first_element = self.elements + 1;
        let cells = model.mesh.cells();
        self.cells(name, &cells, first_node);
        self.material(name, elastic, "\n1.");
        self.surface(name, model, &cells, first_element);
        let spines = model.mesh.spines();
        let far: Vec<usize> = (0..spines)
            .map(|i| first_node + model.mesh.far_node(i))
            .collect();
        let contact = model.zone.contact.0..model.zone.contact.1;
        let near: Vec<usize> = contact
            .map(|i| first_node + model.mesh.surface_node(i))
            .collect();
        self.set(&format!("{name}_FAR"), &far);
        self.set(&format!("{name}_NEAR"), &near);
        Part {
            control_node: far[spines / 2],
            far,
        }
    }

    /// The material of a body, whose section may have a thickness.
    fn material(&mut self, name: &str, elastic: Elastic, thickness: &str) {
        let (modulus, ratio) = (elastic.youngs_modulus_mpa, elastic.poisson_ratio);
        self.line(format!(
            "*MATERIAL, NAME={name}\n*ELASTIC\n{modulus:e}, {ratio}"
        ));
        self.line(format!(
            "*SOLID SECTION, ELSET={name}, MATERIAL={name}{thickness}"
        ));
    }

    fn cells(&mut self, name: &str, cells: &[Cell], first_node: usize) {
        for (kind, corners) in [("CPE4", 4), ("CPE3", 3)] {
            let of_kind = |cell: &&Cell| corners == nodes_of(cell).len();
            if cells.iter().any(|cell| of_kind(&cell)) {
                self.line(format!("*ELEMENT, TYPE={kind}, ELSET={name}"));
            }
            // Elements are numbered in the order of the mesh, not by kind.
            for (element, cell) in cells.iter().enumerate().filter(|(_, cell)| of_kind(cell)) {
                let ids = listed(nodes_of(cell).iter().map(|node| first_node + node));
                self.line(format!("{}, {ids}", self.elements + element + 1));
            }
        }
        self.elements += cells.len();
    }

    /// The faces of the contact surface.
    fn surface(&mut self, name: &str, model: &ZoneModel, cells: &[Cell], first_element: usize) {
        self.line(format!("*SURFACE, NAME={name}_FACE, TYPE=ELEMENT"));
        let mesh = &model.mesh;
        let near: Vec<usize> = (0..mesh.spines()).map(|i| mesh.surface_node(i)).collect();
        for (element, cell) in cells.iter().enumerate() {
            let nodes = nodes_of(cell);
            let corners = nodes.len();
            let on_surface = |k: usize| near.binary_search(&nodes[k % corners]).is_ok();
            if let Some(face) = (0..corners).find(|&k| on_surface(k) && on_surface(k + 1)) {
                self.line(format!("{}, S{}", first_element + element, face + 1));
            }
        }
    }

    fn set(&mut self, name: &str, nodes: &[usize]) {
        self.line(format!("*NSET, NSET={name}"));
        for chunk in nodes.chunks(LINE) {
            self.line(format!("{},", listed(chunk.iter().copied())));
        }
    }

    fn contact(&mut self, scene: &Scene, model: &Model, penalty: f64) {
        let elastic = [scene.slider.elastic, scene.receptacle.elastic];
        let [slider, receptacle] = elastic.map(|elastic| elastic.youngs_modulus_mpa);
        let stiffest = slider.max(receptacle);
        let penalty = penalty * stiffest / model.sizes.contact_element;
        self.line("*SURFACE INTERACTION, NAME=TOUCH");
        self.line("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR");
        self.line(format!("{penalty:e}"));
        let friction = model.interface.friction;
        if scene.friction.changes() {
            self.line("** the coefficient of friction is that of the unworn contact");
        }
        if scene.effects.of(Effect::Friction) == Some(false) {
            self.line("** friction is switched off: its traction deforms neither body");
        } else if friction > 0.0 {
            self.line(format!(
                "*FRICTION\n{friction}, {:e}",
                STICK_SLOPE * penalty
            ));
        }
        self.line("*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE");
        self.line("RECEPTACLE_FACE, SLIDER_FACE");
    }

    fn boundary(&mut self, slider: &Part) {
        let control = slider.control_node;
        for node in slider.far.iter().filter(|node| **node != control) {
            self.line(format!("*EQUATION\n2\n{node}, 2, 1., {control}, 2, -1."));
        }
        self.line("*BOUNDARY\nRECEPTACLE_FAR, 1, 2\nSLIDER_FAR, 1, 1");
    }

    /// The step that applies a load in N, or in N per mm of depth.
    fn load_step(&mut self, load: f64, slider: &Part) {
        self.line("*STEP, INC=1000\n*STATIC\n0.05, 1., 1e-6, 0.25\n*CLOAD");
        let node = slider.control_node;
        self.line(format!("{node}, 2, {:e}", -load));
        self.line(OUTPUT);
    }

    fn motion_step(&mut self, amplitude: f64) {
        self.line("*STEP, INC=10000\n*STATIC\n0.05, 1., 1e-6, 0.05\n*BOUNDARY");
        self.line(format!("SLIDER_FAR, 1, 1, {amplitude:e}"));
        self.line(OUTPUT);
    }
}

/// Numbers with commas between them.
fn listed(numbers: impl Iterator<Item = usize>) -> String {
    let texts: Vec<String> = numbers.map(|number| number.to_string()).collect();
    texts.join(", ")
}

fn nodes_of(cell: &Cell) -> &[usize] {
    match cell {
        Cell::Quad(nodes) => nodes,
        Cell::Tri(nodes) => nodes,
    }
}
