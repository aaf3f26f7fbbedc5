//! Contact patch test: a uniform pressure passes through non-matching meshes unchanged.
//!
//! ```text
//!     p = 10 MPa           both bodies 1 mm wide, nu = 0, so the exact stress is uniform;
//!   v v v v v v v          the slider's mesh is chosen so that at its position s it lies
//!   +--+---+--+-+          exactly over the receptacle
//!   +-+--+----+-+
//!   ~~~~ fixed ~~
//! ```

use solver::condensation::condense;
use solver::contact::{ContactState, Displacement, Pair, Solver, Surfaces};
use solver::model::{
    BodyLayout, BodyModel, HeatSources, Interface, Model, Profile, Support, Tangential, Zone,
    ZoneSizes,
};
use solver::scene::{Elastic, SurfaceEffects};
use solver::sides::{Side, Sides};

use crate::verification::scenes::mccoll;

fn body(x: Vec<f64>, far_y: f64, support: Support) -> BodyModel {
    let contact = (0, x.len());
    let zones = vec![Zone {
        spines: (0..x.len()).collect(),
        contact,
    }];
    let layout = BodyLayout {
        x,
        profile: Profile::Flat,
        far_y,
        fractions: vec![0.0, 0.2, 0.5, 1.0],
        contact,
        zones,
        zone_sizes: ZoneSizes {
            half_width: 0.5,
            width: 2.0,
            fewest: 240.0,
            largest: 0.5,
        },
    };
    let elastic = Elastic {
        youngs_modulus_mpa: 100e3,
        poisson_ratio: 0.0,
    };
    BodyModel::new(layout, elastic, support).expect("it can be meshed")
}

#[test]
fn uniform_pressure_passes_through_non_matching_meshes_at_any_position() {
    let (pressure, friction) = (10.0, 0.5);
    let sizes = solver::model::build(&mccoll(), &solver::effects::plan(&mccoll()))
        .expect("the scene can be meshed")
        .sizes;
    let positions = [-0.731, -0.05, 0.0, 0.2, 1.37];
    for (slider_x, slave) in positions
        .map(|x| Side::BOTH.map(|slave| (x, slave)))
        .as_flattened()
    {
        let (slider_x, slave) = (*slider_x, *slave);
        let upper = [-0.5, -0.33, -0.21, 0.02, 0.09, 0.31, 0.5].map(|x| x - slider_x);
        let lower = vec![-0.5, -0.4, -0.15, -0.1, 0.13, 0.24, 0.4, 0.5];
        let model = Model {
            bodies: Sides {
                slider: body(upper.to_vec(), 0.7, Support::GuidedUnderPressure),
                receptacle: body(lower, -0.6, Support::FarFaceHeld),
            },
            interface: Interface {
                slave,
                sticks: true,
                slope_weights: Sides {
                    slider: 0.5,
                    receptacle: 0.5,
                },
                friction,
                tangential: if friction > 0.0 {
                    Tangential::StickSlip
                } else {
                    Tangential::Omitted
                },
                wear: Sides::default(),
                load: pressure * 1.0,
                spring: 0.0,
                modulus: 50e3,
                heated_by: HeatSources::default(),
            },
            relocates: false,
            conducts: false,
            surface: SurfaceEffects {
                plating: false,
                softening: false,
            },
            sizes,
        };
        let operators = condense(&model, 1)
            .expect("the blocks can be condensed")
            .operators;
        let pair = Pair {
            operators: &operators,
            interface: model.interface,
        };
        let zero = operators.as_ref().map(|body| vec![0.0; body.x.len()]);
        let surfaces = Surfaces {
            depth: zero.as_slices(),
            slope: zero.as_slices(),
            friction: Sides::default(),
        };
        let mut last = ContactState::untouched(&operators, slave);
        last.slider_x = slider_x;
        let mut next = last.clone();
        Solver::default()
            .advance(
                &pair,
                &surfaces,
                &last,
                Displacement {
                    slider_x,
                    surface_slip: 0.0,
                    along: 0.0,
                    height: None,
                    repeated: false,
                    cycles: 0.0,
                    lemke: true,
                    start: None,
                },
                &mut next,
            )
            .expect("the blocks are in equilibrium");
        for p in &next.pressure {
            assert!(
                (p / pressure - 1.0).abs() < 1e-10,
                "{slider_x} {slave:?}: {:?}",
                next.pressure
            );
        }
        assert!(next.shear.iter().all(|q| q.abs() < 1e-9 * pressure));
    }
}
