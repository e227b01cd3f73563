//! Where light comes from.
//!
//! Each light answers for paths that look for it (`sample_li` draws a direction towards it, and `pdf_*` tells the density
//! of one found by chance), and for photons (`sample_emission` draws a ray that leaves it).

mod alias;
mod cone;
mod distribution;
mod environment;
mod lights;
mod rect;
mod spot;
mod sun;
mod tree;

pub use alias::AliasTable;
pub use cone::Cone;
pub use environment::{Environment, EnvironmentRadiance, Sky};
pub use lights::Lights;
pub use spot::Spot;
pub use sun::Sun;
pub use tree::{LightBounds, LightTree, Viewpoint};

use super::bsdf::Emission;
use super::geometry::{DirectionSample, Geometry, PrimId, SurfacePoint};
use crate::math::{Bounds, Frame, Ray, Rgb, Vec2, Vec3, warp};
use std::f32::consts::{FRAC_1_PI, PI};

/// A source of light.
pub enum Light {
    /// Shines from one point equally in all directions.
    Point {
        /// Where, in metres.
        p: Vec3,
        /// Radiant intensity, in W·sr⁻¹.
        intensity: Rgb,
        /// How it fades; all but recursive ray tracing take [`Falloff::PHYSICAL`] only.
        falloff: Falloff,
    },
    /// Shines from one point into a cone.
    Spot(Spot),
    /// Shines along one direction from infinitely far away.
    Directional {
        /// The unit direction in which the light travels.
        direction: Vec3,
        /// On a surface that faces it, in W·m⁻².
        irradiance: Rgb,
    },
    /// The surface of a primitive that emits.
    Area {
        /// Which.
        prim: PrimId,
        /// What; of one that shines by a picture, on average.
        emission: Emission,
    },
    /// All directions at infinity.
    Environment(Box<Sky>),
}

/// How the light of a point fades with the distance d: it is divided by a + b·d + c·d².
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Falloff(pub [f32; 3]);

impl Falloff {
    /// As light does: by the square of the distance.
    pub const PHYSICAL: Self = Self([0.0, 0.0, 1.0]);

    /// What light is divided by at this distance, in metres.
    fn divisor(self, distance: f32) -> f32 {
        let [a, b, c] = self.0;
        a + b * distance + c * (distance * distance)
    }
}

/// A direction drawn towards a light.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LightSample {
    /// The unit direction to the light.
    pub wi: Vec3,
    /// The radiance from there if nothing is in between; for delta lights the irradiance on a facing surface.
    pub radiance: Rgb,
    /// The density per steradian; 1 for delta lights.
    pub pdf: f32,
    /// Whether no other strategy can find this direction.
    pub delta: bool,
    /// Where the light is.
    pub end: LightEnd,
    /// The surface that shines, where it is drawn by itself.
    pub prim: Option<PrimId>,
}

/// The far end of a shadow ray.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LightEnd {
    /// A point, in metres.
    At {
        /// The point.
        p: Vec3,
        /// A bound on its error, per axis.
        p_error: Vec3,
        /// The normal of its surface; zero for what has none.
        n: Vec3,
        /// How far it is.
        distance: f32,
    },
    /// Infinitely far away.
    Infinity,
}

impl LightSample {
    /// What a point drawn on a surface sends; `None` if it shines to the other side.
    fn of_surface(at: DirectionSample, emission: &Emission) -> Option<Self> {
        let radiance = emission.radiance(-at.wi.dot(at.n));
        let end = LightEnd::At { p: at.p, p_error: at.p_error, n: at.n, distance: at.distance };
        (!radiance.is_black()).then_some(Self {
            wi: at.wi,
            radiance,
            pdf: at.pdf,
            delta: false,
            end,
            prim: None,
        })
    }

    /// The open segment that must be free for the light to arrive.
    pub fn shadow_ray(&self, from: &SurfacePoint) -> Ray {
        match self.end {
            LightEnd::At { p, p_error, n, .. } => from.spawn_to(p, p_error, n),
            LightEnd::Infinity => from.spawn(self.wi),
        }
    }

    /// How far the light is, in metres.
    pub fn distance(&self) -> f32 {
        match self.end {
            LightEnd::At { distance, .. } => distance,
            LightEnd::Infinity => f32::INFINITY,
        }
    }
}

/// A ray that leaves a light, with the power it stands for.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EmissionSample {
    /// From the light, along the direction of travel.
    pub ray: Ray,
    /// Emitted radiance · cos / density: its mean over all draws is the power of the light, in watts.
    pub weight: Rgb,
}

impl Light {
    /// Draws a direction in which `from` may see the light; `None` where it does not shine.
    pub fn sample_li(&self, geometry: &Geometry, from: Vec3, u: Vec2) -> Option<LightSample> {
        match self {
            Self::Point { p, intensity, falloff } => {
                let to = *p - from;
                let distance = to.length();
                let wi = to.try_normalize()?;
                let end = LightEnd::At { p: *p, p_error: Vec3::ZERO, n: Vec3::ZERO, distance };
                let radiance = *intensity / falloff.divisor(distance);
                Some(LightSample { wi, radiance, pdf: 1.0, delta: true, end, prim: None })
            }
            Self::Spot(spot) => spot.sample_li(from),
            Self::Directional { direction, irradiance } => Some(LightSample {
                wi: -*direction,
                radiance: *irradiance,
                pdf: 1.0,
                delta: true,
                end: LightEnd::Infinity,
                prim: None,
            }),
            Self::Area { prim, emission } => {
                let drawn = LightSample::of_surface(geometry.sample_toward(*prim, from, u)?, emission)?;
                Some(LightSample { prim: Some(*prim), ..drawn })
            }
            Self::Environment(sky) => {
                let (wi, pdf) = sky.sample(u);
                let end = LightEnd::Infinity;
                Some(LightSample { wi, radiance: sky.radiance(wi), pdf, delta: false, end, prim: None })
            }
        }
    }

    /// Draws a ray that leaves the light: a position by `u_pos`, a direction by `u_dir`.
    ///
    /// Light from infinity starts on a disk that faces the ball around all bounded geometry.
    pub fn sample_emission(&self, geometry: &Geometry, u_pos: Vec2, u_dir: Vec2) -> EmissionSample {
        match self {
            Self::Point { p, intensity, .. } => {
                let ray = Ray::new(*p, warp::square_to_uniform_sphere(u_dir));
                EmissionSample { ray, weight: *intensity * (4.0 * PI) }
            }
            Self::Spot(spot) => spot.sample_emission(u_dir),
            Self::Directional { direction, irradiance } => {
                emission_from_infinity(geometry, *direction, *irradiance, u_pos)
            }
            Self::Area { prim, emission } => {
                let at = geometry.sample_area(*prim, u_pos);
                let (side, u_dir) = choose_side(emission, u_dir);
                let dir = Frame::from_normal(at.n * side).to_world(warp::square_to_cosine_hemisphere(u_dir));
                let chance = if emission.front.is_black() || emission.back.is_black() { 1.0 } else { 0.5 };
                let weight = emission.radiance(side) * (PI / (at.pdf_area * chance));
                EmissionSample { ray: at.spawn(dir.normalize()), weight }
            }
            Self::Environment(sky) => {
                let (towards, pdf) = sky.sample(u_dir);
                emission_from_infinity(geometry, -towards, sky.radiance(towards) / pdf, u_pos)
            }
        }
    }

    /// Where it is and how it shines; `None` for what is infinitely far away.
    fn bounds(&self, geometry: &Geometry) -> Option<LightBounds> {
        match self {
            Self::Point { p, intensity, .. } => Some(LightBounds {
                bounds: Bounds::new(*p, *p),
                intensity: intensity.luminance(),
                normals: Cone::ALL,
                cos_reach: 0.0,
                two_sided: false,
            }),
            Self::Area { prim, emission } => {
                let outline = geometry.outline(*prim)?;
                let (front, back) = (emission.front.luminance(), emission.back.luminance());
                let side = if front > 0.0 { 1.0 } else { -1.0 };
                // Of a ball a quarter of the surface is seen, as a disk that faces the viewer.
                let seen = if outline.n.is_some() { 1.0 } else { 0.25 };
                Some(LightBounds {
                    bounds: outline.bounds,
                    intensity: front.max(back) * geometry.area(*prim) as f32 * seen,
                    normals: outline.n.map_or(Cone::ALL, |n| Cone::around(n * side)),
                    cos_reach: 0.0,
                    two_sided: front > 0.0 && back > 0.0,
                })
            }
            Self::Spot(spot) => Some(LightBounds {
                bounds: Bounds::new(spot.p, spot.p),
                intensity: spot.intensity.luminance(),
                normals: Cone::around(spot.axis),
                cos_reach: spot.cos_outer,
                two_sided: false,
            }),
            Self::Directional { .. } | Self::Environment(_) => None,
        }
    }

    /// What a surface that faces it receives from infinitely far away beyond what chance finds as well, as luminance.
    fn distant_irradiance(&self) -> f32 {
        match self {
            Self::Directional { irradiance, .. } => irradiance.luminance(),
            Self::Environment(sky) => sky.direct_irradiance(),
            Self::Point { .. } | Self::Spot(_) | Self::Area { .. } => 0.0,
        }
    }

    /// Whether it has no size, so that only a look straight at it finds it.
    pub fn is_delta(&self) -> bool {
        matches!(self, Self::Point { .. } | Self::Spot(_) | Self::Directional { .. })
    }

    /// The power it sends into the scene, in watts; infinite for an endless surface.
    pub fn power(&self, geometry: &Geometry) -> Rgb {
        let (_, radius) = ball(geometry);
        match self {
            Self::Point { intensity, .. } => *intensity * (4.0 * PI),
            Self::Spot(spot) => spot.power(),
            Self::Directional { irradiance, .. } => *irradiance * (PI * radius * radius),
            Self::Area { prim, emission } => {
                (emission.front + emission.back) * (PI * geometry.area(*prim) as f32)
            }
            Self::Environment(sky) => sky.mean() * (4.0 * PI * PI * radius * radius),
        }
    }
}

/// The side from which a photon leaves a surface (1 front, −1 back), and `u` stretched to the unit square again.
fn choose_side(emission: &Emission, u: Vec2) -> (f32, Vec2) {
    if emission.back.is_black() {
        (1.0, u)
    } else if emission.front.is_black() {
        (-1.0, u)
    } else if u.x < 0.5 {
        (1.0, Vec2::new(2.0 * u.x, u.y))
    } else {
        (-1.0, Vec2::new(2.0 * u.x - 1.0, u.y))
    }
}

/// A ray from far away along `dir` through a uniform point of the disk that covers the scene.
///
/// `irradiance` is what arrives on a surface that faces the light, over the density of the direction.
fn emission_from_infinity(geometry: &Geometry, dir: Vec3, irradiance: Rgb, u: Vec2) -> EmissionSample {
    let (center, radius) = ball(geometry);
    let frame = Frame::from_normal(dir);
    let disk = warp::square_to_uniform_disk(u) * radius;
    let o = center + frame.x * disk.x + frame.y * disk.y - dir * radius;
    EmissionSample { ray: Ray::new(o, dir), weight: irradiance * (radius * radius / FRAC_1_PI) }
}

/// Centre and radius of a ball that holds all bounded geometry; of radius 1 when there is none.
fn ball(geometry: &Geometry) -> (Vec3, f32) {
    let bounds = geometry.bounds();
    if bounds.is_empty() { (Vec3::ZERO, 1.0) } else { (bounds.center(), bounds.radius()) }
}
