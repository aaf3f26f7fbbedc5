//! Contact of extruded bodies: a plane section drawn out over a width, whose ends are free or held.
//!
//! ```text
//!        .--------------.  u_z = 0 on the slider's top face, which is the rigid handle or the guided body of the plane model
//!        |   slider     |
//!   free |    ______    |  layers of prisms over the plane meshes, symmetric to the middle of the width:
//!   end  |___/      \___|  hexahedra over quadrilaterals, wedges over triangles
//!        |  receptacle  |
//!        '--------------'  bottom held
//!        z = 0   z = w/2: u_z = 0
//! ```
//! Held ends (u_z = 0 everywhere) are plane strain exactly. Free ends let the bodies bulge: they are softer there, and the pressure at the end
//! falls.
//!
//! Each node plane has the pairing of the plane contact and its own worn surfaces; all of them slip alike under one height of the slider, which
//! does not tilt, and couple through the compliance of the bodies (`condensation::extruded`, `contact::planes`). The load is the mean line
//! load of the section times the width.
//!
//! Limits: the slip is imposed, no part of the contact sticks; wear rates are the same in every state; no heat. The pressure falls toward a free end as far as the layers there resolve it. Limiting cases: Poisson's ratio 0 makes free
//! ends plane strain; a width of many heights is plane strain in the middle.

mod bodies;
mod cycle;
mod error;
mod integrator;
mod motion_history;
mod record;
mod run;
mod scene;
mod state;

pub(crate) use cycle::ExtrudedContact;
pub use error::ExtrudedError;
pub(crate) use integrator::ExtrudedIntegrator;
pub use motion_history::ExtrudedHistory;
pub use record::ExtrudedSummary;
pub use run::run;
pub use scene::{ExtrudedScene, MOST_LAYERS};
pub use state::{ExtrudedState, PlanesState};
