//! The typed scene: names bound, units applied, loops run. Metres, seconds, radians, linear colours; `f64` throughout.
//!
//! Things that may be shared (shapes, materials, textures) live in arenas and are named by handles. Everything keeps the
//! span where it was written, so that later phases can point at it.

mod arena;
pub mod camera;
pub mod dump;
pub mod light;
pub mod material;
pub mod shape;

use crate::math::motion::{Factor, Motion};
use crate::math::{DAffine3, DMat3, Rgb};
use crate::source::{Span, Spanned};
pub use arena::{Arena, Handle};
pub use camera::{Camera, Exposure, Film, Filter, Focus, Lens, Tone};
pub use light::{Brightness, Environment, Light, LightKind};
pub use material::{
    Checker, ImageUse, Input, Material, MaterialKind, MetalColor, Projection, Texture, TextureKind, Wrap,
};
pub use shape::{Caps, Curve, CurveKind, Heights, Method as RevolveMethod, Outline, Path, Shape, ShapeKind};

/// A whole scene.
#[derive(Clone, Default, Debug)]
pub struct Scene {
    /// Every shape that is placed at least once.
    pub shapes: Arena<Shape>,
    /// Every material that was written or implied.
    pub materials: Arena<Material>,
    /// Every texture.
    pub textures: Arena<Texture>,
    /// What is in the picture, in the order written.
    pub objects: Vec<Object>,
    /// The lights that are not objects with an emissive material, in the order written.
    pub lights: Vec<Light>,
    /// The light that comes from everywhere.
    pub environment: Option<Environment>,
    /// The cameras, in the order written.
    pub cameras: Vec<Camera>,
    /// How to render.
    pub render: Render,
    /// Each parameter with its value in this run.
    pub params: Vec<Param>,
    /// The names that objects carry, by the ids in [`Object::names`].
    pub names: Vec<Named>,
    /// What the text shows beyond that, when it has mistakes.
    pub intent: Intent,
}

/// What a scene with mistakes was to be, as far as its text shows it. Nothing is rendered of it: it tells which doubts
/// are certain all the same, and where to look for more mistakes.
#[derive(Clone, Debug, Default)]
pub struct Intent {
    /// Where the first camera is written, be it well or badly.
    pub camera: Option<Span>,
    /// Whether the text speaks of light, well or badly: then there may be some, though none could be made of it.
    pub light: bool,
    /// Materials that misspelt names probably mean.
    pub materials: Vec<Handle<Material>>,
}

impl Scene {
    /// Whether nothing is in it: its file holds definitions for others, or there is nothing left of it.
    pub fn is_empty(&self) -> bool {
        self.objects.is_empty() && self.lights.is_empty() && self.cameras.is_empty()
    }
}

/// A shape in its place.
#[derive(Clone, Debug)]
pub struct Object {
    /// What it looks like; objects placed several times share it.
    pub shape: Handle<Shape>,
    /// What it is made of; `None` where nothing said so: the file's own materials for a mesh, grey otherwise.
    pub material: Option<Handle<Material>>,
    /// World space from object space: all transforms around it, composed; of what moves, as it stands when a frame begins.
    pub world_from_object: DAffine3,
    /// World space from object space in the time of a frame, and the first `moving` that says so; `None` of what stands still.
    pub motion: Option<Spanned<Motion>>,
    /// The factors of `world_from_object`, the innermost first. Kept only where they flatten the object
    /// ([`is_singular`]) or nearly do ([`is_squeezing`]), to say which of them does; empty otherwise.
    pub transforms: Vec<TransformStep>,
    /// The place that put it into the scene: its block, or the innermost `place`.
    pub span: Span,
    /// Who put it there: outer `place`s, groups, calls, innermost first.
    pub trail: Vec<Span>,
    /// The names under which `on NAME` finds it: the `let` and the `place .. as` around it.
    pub names: Vec<u32>,
}

/// A name that `on NAME` can find: of a `let` whose value is an object, or of a `place .. as`.
#[derive(Clone, PartialEq, Debug)]
pub struct Named {
    /// The name, where it is defined.
    pub name: Spanned<String>,
    /// How often what it names is in the picture.
    pub count: u32,
    /// Who put it there, the first two of them.
    pub placed: Vec<Span>,
}

/// Whether a transform flattens what it moves: its determinant vanishes beside the product of the columns' lengths.
pub fn is_singular(transform: &DAffine3) -> bool {
    /// Below this the volume is rounding error (f64 has 2⁻⁵³; a few factors lose a few digits).
    const VANISHING: f64 = 1e-12;
    let m = transform.matrix3;
    let lengths = m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
    m.determinant().abs() <= VANISHING * lengths
}

/// Whether a transform squeezes what it moves so much in one direction that single precision cannot tell its two sides
/// apart: it stretches another direction more than 10⁷ times as much (single precision has 24 bits).
///
/// By the Frobenius norms of the matrix and its inverse, whose product is from 1 to 3 times the ratio.
pub fn is_squeezing(transform: &DAffine3) -> bool {
    const MOST: f64 = 1e7;
    let norm = |m: DMat3| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(transform.matrix3) * norm(transform.matrix3.inverse()) > 3.0 * MOST
}

/// One factor of a transform, for reports about singular ones.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TransformStep {
    /// The factor alone.
    pub factor: Factor,
    /// Where it was written.
    pub span: Span,
}

impl TransformStep {
    /// The factor when a frame begins.
    pub fn matrix(&self) -> DAffine3 {
        self.factor.at(0.0)
    }
}

/// Where the first factor that moves was written.
pub fn first_moving(steps: &[TransformStep]) -> Option<Span> {
    steps.iter().find(|step| !step.factor.is_still()).map(|step| step.span)
}

/// A `param` in this run.
#[derive(Clone, PartialEq, Debug)]
pub struct Param {
    /// Its name.
    pub name: Spanned<String>,
    /// Its value, as it would be written.
    pub value: String,
    /// The sentence above it.
    pub doc: Option<String>,
}

/// The `render` block, or what is assumed without one.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Render {
    /// Which integrator; `None` is `auto`.
    pub method: Option<Spanned<Method>>,
    /// When to stop; `None` leaves it to the command.
    pub stop: Stop,
    /// The most vertices of a path.
    pub depth: Option<Spanned<u32>>,
    /// The seed of all random numbers.
    pub seed: Option<Spanned<u64>>,
    /// Photon settings.
    pub photons: Photons,
    /// Settings of recursive ray tracing.
    pub classic: Classic,
}

/// The integrators that can be asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Method {
    /// Path tracing.
    Pt,
    /// Progressive photon mapping.
    Ppm,
    /// Path tracing, with caustics from photons.
    Hybrid,
    /// Recursive ray tracing.
    Classic,
}

/// Settings of recursive ray tracing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Classic {
    /// Highlights by the half vector (Blinn 1977), not by the mirrored light (Phong 1975).
    pub blinn: bool,
    /// Whether things keep the light from each other.
    pub shadows: bool,
    /// Light on everything, times its diffuse colour.
    pub ambient: Rgb,
    /// Whether surfaces are lit when seen from behind.
    pub lit_backs: bool,
    /// Where rays go through a pixel.
    pub pixel: PixelPoint,
    /// Whether display values lose their fraction, rather than being rounded.
    pub floor: bool,
}

impl Default for Classic {
    fn default() -> Self {
        let (pixel, ambient) = (PixelPoint::Filter, Rgb::BLACK);
        Self { blinn: false, shadows: true, ambient, lit_backs: true, pixel, floor: false }
    }
}

/// Where rays go through a pixel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PixelPoint {
    /// Spread by the film's filter.
    Filter,
    /// All through its middle.
    Center,
    /// All through its lower left corner.
    Corner,
}

/// When a render stops: at whichever comes first.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Stop {
    /// After this many passes.
    pub passes: Option<Spanned<u32>>,
    /// After this many seconds.
    pub seconds: Option<Spanned<f64>>,
    /// When the relative error of the picture is below this.
    pub error: Option<Spanned<f64>>,
}

/// Photon settings; what is not said, `plan` chooses.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Photons {
    /// Photons emitted a pass.
    pub count: Option<Spanned<u32>>,
    /// The most photons of a gather.
    pub k: Option<Spanned<u32>>,
    /// The gather radius of the first pass, in metres.
    pub radius: Option<Spanned<f64>>,
    /// α of Knaus & Zwicker 2011, in (0, 1).
    pub shrink: Option<Spanned<f64>>,
}
