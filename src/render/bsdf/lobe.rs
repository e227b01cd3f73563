//! One way of scattering, in the local frame: the normal is +z, and the viewer is above the horizon.

use super::conductor::Conductor;
use super::dielectric::fresnel_dielectric;
use super::fresnel::Reflectance;
use super::pane::Pane;
use super::rough_dielectric::RoughDielectric;
use super::substrate::Substrate;
use super::{Side, Transport, dielectric, mirror, phong};
use crate::math::{Rgb, Vec2, Vec3, warp};
use std::f32::consts::FRAC_1_PI;

/// A way of scattering, with its share among the others multiplied into its colours.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Lobe {
    /// The same radiance in every direction.
    Lambert {
        /// The share of the light that is reflected.
        albedo: Rgb,
    },
    /// A power of the cosine from the mirror direction.
    Phong {
        /// The share reflected at normal incidence.
        albedo: Rgb,
        /// The power, at least 0.
        exponent: f32,
    },
    /// A rough surface that reflects.
    Conductor(Conductor),
    /// A smooth metal or mirror.
    Mirror(Reflectance),
    /// A smooth dielectric: reflects a part and lets the other through.
    Dielectric {
        /// Its share among the lobes.
        share: f32,
        /// The refractive index of the side against the normal, relative to the other.
        ior: f32,
        /// The factor of light that passes.
        tint: Rgb,
    },
    /// A ground dielectric.
    RoughDielectric(RoughDielectric),
    /// A pane, which light passes straight.
    Pane(Pane),
    /// The matt body under a coat.
    Substrate(Substrate),
}

/// A direction drawn from one lobe.
pub(super) struct LobeSample {
    /// The unit direction.
    pub wi: Vec3,
    /// `eval / pdf` of this lobe.
    pub weight: Rgb,
    /// Per steradian; 1 for specular lobes.
    pub pdf: f32,
    /// Whether the lobe scatters into this direction alone.
    pub specular: bool,
    /// Whether light went through the surface.
    pub through: bool,
    /// Whether it is in another medium then.
    pub enters: bool,
    /// Relative refractive index behind the surface if it did; 1 otherwise.
    pub eta: f32,
}

impl LobeSample {
    /// A reflection into one of many directions.
    pub fn smooth(wi: Vec3, weight: Rgb, pdf: f32) -> Self {
        Self { wi, weight, pdf, specular: false, through: false, enters: false, eta: 1.0 }
    }

    /// A reflection into the only direction.
    pub fn mirrored(wi: Vec3, weight: Rgb) -> Self {
        Self { wi, weight, pdf: 1.0, specular: true, through: false, enters: false, eta: 1.0 }
    }
}

impl Lobe {
    /// Whether light may go through the surface: so unless it is known to be otherwise.
    pub fn transmits(&self) -> bool {
        !matches!(
            self,
            Self::Lambert { .. }
                | Self::Phong { .. }
                | Self::Conductor(_)
                | Self::Mirror(_)
                | Self::Substrate(_)
        )
    }

    /// The lobe that scatters nothing.
    pub(super) const NONE: Self = Self::Lambert { albedo: Rgb::BLACK };

    /// Whether it scatters into one direction (or two) only.
    pub fn is_specular(&self) -> bool {
        match self {
            Self::Mirror(_) | Self::Dielectric { .. } => true,
            Self::Pane(pane) => pane.is_specular(),
            _ => false,
        }
    }

    /// Whether it looks at a number of its own to choose between ways.
    pub(super) fn has_choice(&self) -> bool {
        matches!(self, Self::Dielectric { .. } | Self::RoughDielectric(_) | Self::Pane(_))
    }

    /// The chance of being mirrored where the only other is to go through, each in one direction.
    pub(super) fn mirrored_share(&self, wo: Vec3, side: Side) -> Option<f32> {
        match *self {
            Self::Dielectric { ior, .. } => Some(fresnel_dielectric(f64::from(wo.z), side.eta(ior)).0 as f32),
            Self::Pane(pane) if pane.is_specular() => Some(pane.reflected(wo.z)),
            _ => None,
        }
    }

    /// Whether light may pass through into more than one direction.
    pub fn spreads_through(&self) -> bool {
        match self {
            Self::RoughDielectric(_) => true,
            Self::Pane(pane) => !pane.is_specular(),
            _ => false,
        }
    }

    /// Whether it scatters nothing.
    pub fn is_black(&self) -> bool {
        match self {
            Self::Lambert { albedo } | Self::Phong { albedo, .. } => albedo.is_black(),
            Self::Conductor(rough) => rough.reflectance.is_black(),
            Self::Mirror(reflectance) => reflectance.is_black(),
            Self::Dielectric { share, .. } => *share == 0.0,
            Self::RoughDielectric(rough) => rough.share == 0.0,
            Self::Pane(pane) => pane.share == 0.0,
            Self::Substrate(body) => body.is_black(),
        }
    }

    /// Whether it scatters equally in all directions.
    pub fn is_diffuse(&self) -> bool {
        matches!(self, Self::Lambert { .. })
    }

    /// One lobe that scatters as both together, if there is one.
    pub(super) fn joined(&self, other: &Self) -> Option<Self> {
        match (*self, *other) {
            (Self::Lambert { albedo: a }, Self::Lambert { albedo: b }) => {
                Some(Self::Lambert { albedo: a + b })
            }
            (Self::Mirror(a), Self::Mirror(b)) => Some(Self::Mirror(a + b)),
            _ => None,
        }
    }

    /// About how much light it sends on, seen from `wo`: the chance of being chosen among other lobes.
    pub(super) fn albedo(&self, wo: Vec3) -> f32 {
        match *self {
            Self::Lambert { albedo } | Self::Phong { albedo, .. } => albedo.mean(),
            Self::Conductor(rough) => rough.albedo(wo.z),
            Self::Mirror(reflectance) => reflectance.at(wo.z).mean(),
            Self::Dielectric { share, .. } => share,
            Self::RoughDielectric(rough) => rough.share,
            Self::Pane(pane) => pane.share,
            Self::Substrate(body) => body.albedo(wo.z),
        }
    }

    /// Value times `|cos θi|`, and density, for two directions, of which `wo` is above the horizon.
    pub(super) fn eval_pdf(&self, wo: Vec3, wi: Vec3, side: Side) -> (Rgb, f32) {
        if wi.z < 0.0 && !self.spreads_through() {
            return (Rgb::BLACK, 0.0);
        }
        match *self {
            Self::Lambert { albedo } => {
                let pdf = warp::square_to_cosine_hemisphere_pdf(wi);
                (albedo * (wi.z * FRAC_1_PI), pdf)
            }
            Self::Phong { albedo, exponent } => phong::eval_pdf(albedo, exponent, wo, wi),
            Self::Conductor(rough) => rough.eval_pdf(wo, wi),
            Self::RoughDielectric(rough) => rough.eval_pdf(wo, wi, side),
            Self::Pane(pane) => pane.eval_pdf(wo, wi),
            Self::Substrate(body) => body.eval_pdf(wo, wi),
            Self::Mirror(_) | Self::Dielectric { .. } => (Rgb::BLACK, 0.0),
        }
    }

    /// Draws a direction by `u`; `u_choice` chooses between reflection and refraction.
    pub(super) fn sample(
        &self,
        wo: Vec3,
        side: Side,
        u: Vec2,
        u_choice: f32,
        transport: Transport,
    ) -> Option<LobeSample> {
        match *self {
            Self::Lambert { albedo } => {
                let wi = warp::square_to_cosine_hemisphere(u);
                let pdf = warp::square_to_cosine_hemisphere_pdf(wi);
                (pdf > 0.0).then(|| LobeSample::smooth(wi, albedo, pdf))
            }
            Self::Phong { albedo, exponent } => phong::sample(albedo, exponent, wo, u),
            Self::Conductor(rough) => rough.sample(wo, u),
            Self::Mirror(reflectance) => Some(mirror::sample(&reflectance, wo)),
            Self::Dielectric { share, ior, tint } => {
                let drawn = dielectric::sample(side.eta(ior), tint, wo, u_choice, transport);
                Some(LobeSample { weight: drawn.weight * share, ..drawn })
            }
            Self::RoughDielectric(rough) => rough.sample(wo, side, u, u_choice, transport),
            Self::Pane(pane) => pane.sample(wo, u, u_choice),
            Self::Substrate(body) => body.sample(wo, u),
        }
    }
}
