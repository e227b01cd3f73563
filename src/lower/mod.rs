//! From the checked scene to a world ready for rays: the one place where spans and rays are both known.
//!
//! Works in double precision and moves the scene's centre to the origin before rounding to single, so that a scene far
//! from the origin keeps its digits.

mod camera;
pub mod curve;
mod daylight;
mod effects;
mod error;
mod heightfield;
mod instance;
mod lens;
mod light;
mod material;
mod object;
mod place;
mod sweep;
pub mod tessellate;

use crate::diag::Problems;
use crate::ir;
use crate::load::Loaded;
use crate::math::DVec3;
use crate::plan::{Effect, Plan, Tessellation};
use crate::render::camera::Camera;
use crate::render::geometry::Shapes;
use crate::render::integrator::{ClassicSettings, Shading};
use crate::render::shape::{MaterialId, SourceId};
use crate::render::world::{Parts, World};
use crate::render::{GatherRadius, HybridSettings, Method, PpmSettings};
use crate::source::{Files, Span};
pub use effects::can_leave_out;
pub use error::LowerError;
use instance::Instances;
pub use material::Origin;
use material::{Finished, Materials};
pub use place::object_bounds;
use rustc_hash::FxHashMap;

/// A world, and what only the caller needs to know of the scene.
pub struct Lowered {
    /// Ready for rays.
    pub world: World,
    /// The integrator with its settings.
    pub method: Method,
    /// Where each `SourceId` was written.
    pub sources: Vec<Span>,
    /// Where materials were defined, but for those that only lights have.
    pub materials: FxHashMap<MaterialId, Origin>,
    /// What was moved to the origin, in the scene's metres.
    pub center: DVec3,
}

/// Builds the world that `camera` sees. `None` when `problems` has errors already, when a picture cannot be decoded, or
/// when the camera has nothing to focus on.
pub fn lower(
    loaded: &Loaded<'_>,
    plan: &Plan,
    camera: &ir::Camera,
    files: &dyn Files,
    problems: &mut Problems,
) -> Option<Lowered> {
    if problems.has_errors() {
        return None;
    }
    let center = place::scene_center(loaded);
    let mut lowering = Lowering {
        loaded,
        center,
        materials: Materials::new(loaded, files, effects::filters(plan)),
        shapes: Shapes::default(),
        instances: Instances::count(loaded),
        sources: Vec::new(),
        is_smooth: plan.simulates(Effect::SmoothNormals),
        tessellation: plan.tessellation,
        shutter: effects::shutter(plan, camera),
    };
    for object in &loaded.scene.objects {
        lowering.object(object);
    }
    let lights = loaded.scene.lights.iter().filter_map(|light| lowering.light(light)).collect();
    let environment = loaded.scene.environment.as_ref().and_then(|e| lowering.materials.environment(e));
    let environment = environment.or_else(|| loaded.scene.lights.iter().find_map(light::sky));
    let environment = effects::surroundings(plan, environment);
    let pixel = match plan.method {
        ir::Method::Classic => loaded.scene.render.classic.pixel,
        _ => ir::PixelPoint::Filter,
    };
    let mut camera = camera::camera(camera, pixel, loaded, center).map_err(|error| problems.push(error)).ok();
    camera.iter_mut().for_each(|camera| effects::hold_camera(plan, camera));

    let Lowering { materials, shapes, sources, .. } = lowering;
    let Shapes { meshes, shared, instances, solids } = shapes;
    let Finished { materials, textures, failed, origins } = materials.finish();
    let any_failed = !failed.is_empty();
    failed.into_iter().for_each(|error| problems.push(error));
    let camera = camera.filter(|_| !any_failed)?;
    let method = method(plan, &loaded.scene.render.classic, &camera);
    let camera = Camera::new(camera.spec);
    let world = World::new(Parts {
        meshes,
        shared,
        instances,
        solids,
        materials,
        textures,
        lights,
        environment,
        camera,
        effects: effects::effects(plan),
    });
    Some(Lowered { world, method, sources, materials: origins, center })
}

fn method(plan: &Plan, classic: &ir::Classic, camera: &camera::Seen) -> Method {
    match plan.method {
        ir::Method::Pt | ir::Method::Hybrid if effects::drops_caustics(plan) => {
            Method::Hybrid(HybridSettings { photon_count: 0, ..hybrid(plan) })
        }
        ir::Method::Pt => Method::Pt,
        ir::Method::Classic => Method::Classic(ClassicSettings {
            shading: if classic.blinn { Shading::Blinn } else { Shading::Phong },
            shadows: classic.shadows,
            ambient: classic.ambient,
            lit_backs: classic.lit_backs,
        }),
        ir::Method::Hybrid => Method::Hybrid(hybrid(plan)),
        ir::Method::Ppm => Method::Ppm(PpmSettings {
            photon_count: plan.photon_count,
            k: plan.photon_k,
            radius: plan.photon_radius.unwrap_or(camera.pixel_footprint * PIXELS_PER_RADIUS) as f32,
            shrink: plan.photon_shrink,
        }),
    }
}

fn hybrid(plan: &Plan) -> HybridSettings {
    let radius = plan.photon_radius.map(|radius| GatherRadius::Meters(radius as f32));
    HybridSettings {
        photon_count: plan.photon_count,
        k: plan.photon_k,
        radius: radius.unwrap_or(GatherRadius::Pixels(CAUSTIC_PIXELS_PER_RADIUS)),
        shrink: plan.photon_shrink,
    }
}

/// The first gather radius in pixel footprints, unless the scene says otherwise.
const PIXELS_PER_RADIUS: f64 = 4.0;

/// The same for caustics in pixel footprints at the point itself: photons are few, aimed, and nothing else is blurred.
const CAUSTIC_PIXELS_PER_RADIUS: f32 = 1.5;

/// What has been lowered so far.
struct Lowering<'a> {
    loaded: &'a Loaded<'a>,
    center: DVec3,
    materials: Materials<'a>,
    shapes: Shapes,
    instances: Instances,
    sources: Vec<Span>,
    /// Whether triangles keep the normals of their vertices.
    is_smooth: bool,
    /// Whether shapes are made of triangles.
    tessellation: Tessellation,
    /// The share of a frame for which the shutter is open.
    shutter: f64,
}

impl Lowering<'_> {
    fn source(&mut self, span: Span) -> SourceId {
        self.sources.push(span);
        SourceId(self.sources.len() as u32 - 1)
    }
}
