//! What happens on a path, told to whoever wants to know.
//!
//! Integrators are generic over their witness: with `()`, which hears nothing, no event is ever made, and the code is that
//! without witnesses. The path is the same either way, bit for bit.

use crate::math::{Rgb, Vec3};
use crate::render::bsdf::Lobe;
use crate::render::geometry::SurfacePoint;

/// Someone to whom a path is told as it goes.
pub trait Witness {
    /// Something happened; `event` says what to those who listen.
    fn note(&mut self, event: impl FnOnce() -> Event);
}

/// Listens to nothing.
impl Witness for () {
    #[inline(always)]
    fn note(&mut self, _: impl FnOnce() -> Event) {}
}

/// Keeps everything in order.
impl Witness for Vec<Event> {
    fn note(&mut self, event: impl FnOnce() -> Event) {
        self.push(event());
    }
}

/// A step of a path. What is `added` goes to the pixel as it is, the throughput multiplied in.
#[derive(Clone, PartialEq, Debug)]
pub enum Event {
    /// A surface was met.
    Vertex {
        /// Where.
        surface: SurfacePoint,
        /// The unit direction back to where the path came from.
        wo: Vec3,
        /// How far that is, in metres.
        t: f32,
        /// The throughput on arrival, what absorbed on the way included.
        beta: Rgb,
    },
    /// The surface shines.
    Emitted {
        /// What of it counts.
        added: Rgb,
    },
    /// How the surface scatters.
    Lobes(Vec<Lobe>),
    /// A light was asked.
    Light {
        /// The unit direction to it.
        wi: Vec3,
        /// How far it is, in metres.
        distance: f32,
        /// What arrives from there and goes on to the viewer if nothing is between, bsdf included, by no density yet.
        arriving: Rgb,
        /// The density of having asked there, per steradian; 1 for what has no size.
        pdf: f32,
        /// The density with which the bsdf would have found it, per steradian.
        pdf_bsdf: f32,
        /// Whether something lies between; not looked for where nothing arrives.
        blocked: bool,
    },
    /// What all lights together send, once each is weighed.
    Lit {
        /// What of it counts.
        added: Rgb,
    },
    /// What photons brought.
    Photons {
        /// What of it counts.
        added: Rgb,
    },
    /// What is known here of light by way of two matt surfaces, from probes.
    Gathered {
        /// What of it counts.
        added: Rgb,
    },
    /// What was met, or the sky if it was nothing, is shared with neighbouring pixels: until the next [`Self::Branch`] or
    /// [`Self::Shared`], throughputs and what is added count from here, not from the camera.
    Sends,
    /// What the pixel gets of what the paths of its group have found to share.
    Shared {
        /// How many paths these are.
        paths: usize,
        /// What of it counts.
        added: Rgb,
    },
    /// The path goes on.
    Scattered {
        /// By which lobe.
        lobe: Option<Lobe>,
        /// Along which unit direction.
        wi: Vec3,
        /// The factor of its throughput.
        weight: Rgb,
        /// The density of the direction, per steradian; for a specular lobe the chance of choosing it.
        pdf: f32,
        /// Whether it went through the surface.
        through: bool,
    },
    /// Nothing was met.
    Sky {
        /// Along which unit direction.
        dir: Vec3,
        /// What of the sky counts.
        added: Rgb,
    },
    /// Another way from an earlier vertex is followed.
    Branch {
        /// How many vertices it has so far.
        depth: u32,
    },
    /// The path was left at its last vertex.
    Ended(End),
}

/// Why a path ended at a surface.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// It has as many vertices as it may.
    Depth,
    /// The surface sends nothing on, or not that way.
    Absorbed,
    /// Chance: it was worth little.
    Roulette,
}
