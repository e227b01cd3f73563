//! One way of scattering, in the local frame: the normal is +z, and the viewer is above the horizon.

use super::{Transport, conductor, dielectric, mirror, phong};
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
    /// Metal with microfacets.
    Conductor {
        /// Reflectance at normal incidence.
        f0: Rgb,
        /// Reflectance at grazing incidence.
        f90: Rgb,
        /// The width of the distribution of slopes.
        alpha: f32,
    },
    /// A smooth metal or mirror.
    Mirror {
        /// Reflectance at normal incidence.
        f0: Rgb,
        /// Reflectance at grazing incidence.
        f90: Rgb,
    },
    /// A smooth dielectric: reflects a part and lets the other through.
    Dielectric {
        /// Its share among the lobes.
        share: f32,
        /// The refractive index of the side against the normal, relative to the other.
        ior: f32,
        /// The factor of light that passes.
        tint: Rgb,
    },
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
    /// Relative refractive index behind the surface if it did; 1 otherwise.
    pub eta: f32,
}

impl LobeSample {
    /// A reflection into one of many directions.
    pub fn smooth(wi: Vec3, weight: Rgb, pdf: f32) -> Self {
        Self { wi, weight, pdf, specular: false, through: false, eta: 1.0 }
    }

    /// A reflection into the only direction.
    pub fn mirrored(wi: Vec3, weight: Rgb) -> Self {
        Self { wi, weight, pdf: 1.0, specular: true, through: false, eta: 1.0 }
    }
}

impl Lobe {
    /// Whether light may go through the surface: so unless it is known to be otherwise.
    pub fn transmits(&self) -> bool {
        !matches!(
            self,
            Self::Lambert { .. } | Self::Phong { .. } | Self::Conductor { .. } | Self::Mirror { .. }
        )
    }

    /// The lobe that scatters nothing.
    pub(super) const NONE: Self = Self::Lambert { albedo: Rgb::BLACK };

    /// Whether it scatters into one direction (or two) only.
    pub fn is_specular(&self) -> bool {
        matches!(self, Self::Mirror { .. } | Self::Dielectric { .. })
    }

    /// Whether it scatters nothing.
    pub fn is_black(&self) -> bool {
        match self {
            Self::Lambert { albedo } | Self::Phong { albedo, .. } => albedo.is_black(),
            Self::Conductor { f0, f90, .. } | Self::Mirror { f0, f90 } => f0.is_black() && f90.is_black(),
            Self::Dielectric { share, .. } => *share == 0.0,
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
            (Self::Mirror { f0, f90 }, Self::Mirror { f0: g0, f90: g90 }) => {
                Some(Self::Mirror { f0: f0 + g0, f90: f90 + g90 })
            }
            _ => None,
        }
    }

    /// About how much light it sends on, seen from `wo`: the chance of being chosen among other lobes.
    pub(super) fn albedo(&self, wo: Vec3) -> f32 {
        match *self {
            Self::Lambert { albedo } | Self::Phong { albedo, .. } => albedo.mean(),
            Self::Conductor { f0, f90, .. } | Self::Mirror { f0, f90 } => {
                mirror::schlick(f0, f90, wo.z).mean()
            }
            Self::Dielectric { share, .. } => share,
        }
    }

    /// Value times `cos θi`, and density, for two directions above the horizon.
    pub(super) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
        match *self {
            Self::Lambert { albedo } => {
                let pdf = warp::square_to_cosine_hemisphere_pdf(wi);
                (albedo * (wi.z * FRAC_1_PI), pdf)
            }
            Self::Phong { albedo, exponent } => phong::eval_pdf(albedo, exponent, wo, wi),
            Self::Conductor { f0, f90, alpha } => conductor::eval_pdf(f0, f90, alpha, wo, wi),
            Self::Mirror { .. } | Self::Dielectric { .. } => (Rgb::BLACK, 0.0),
        }
    }

    /// Draws a direction by `u`; `u_choice` chooses between reflection and refraction.
    ///
    /// `outside` says whether the viewer is on the side of the geometric normal.
    pub(super) fn sample(
        &self,
        wo: Vec3,
        outside: bool,
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
            Self::Conductor { f0, f90, alpha } => conductor::sample(f0, f90, alpha, wo, u),
            Self::Mirror { f0, f90 } => Some(mirror::sample(f0, f90, wo)),
            Self::Dielectric { share, ior, tint } => {
                let eta = if outside { f64::from(ior) } else { 1.0 / f64::from(ior) };
                let drawn = dielectric::sample(eta, tint, wo, u_choice, transport);
                Some(LobeSample { weight: drawn.weight * share, ..drawn })
            }
        }
    }
}
