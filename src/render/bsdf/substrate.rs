//! What is matt under something clear: the body of plastic.

use super::albedo;
use super::conductor::MIRROR_ALPHA;
use super::fresnel::Reflectance;
use super::lobe::LobeSample;
use crate::math::{Rgb, Vec2, Vec3, warp};
use std::f32::consts::FRAC_1_PI;

/// A clear layer as what lies under it sees it: how much light it lets through, by the angle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Coat {
    /// The share reflected straight on; all is reflected edge-on.
    f0: f32,
    /// The width of its slopes.
    alpha: f32,
    /// How much of the surface it covers, in [0, 1].
    cover: f32,
}

impl Coat {
    /// A layer of refractive index `ior` over a share of the surface.
    pub fn new(ior: f32, alpha: f32, cover: f32) -> Self {
        Self { f0: Reflectance::of_ior(ior).f0.r, alpha, cover }
    }

    /// What it lets through, seen at an angle: 1 − E of its facets (Kulla & Conty 2017), for a coat of any roughness.
    pub(super) fn passed(&self, cos: f32) -> f32 {
        let reflected = if self.alpha < MIRROR_ALPHA {
            Reflectance { f0: Rgb::gray(self.f0), f90: Rgb::WHITE, dip: Rgb::BLACK }.at(cos).r
        } else {
            albedo::directional(self.alpha, cos).by_schlick(self.f0)
        };
        1.0 - self.cover * reflected
    }

    /// The mean of [`Self::passed`] over the hemisphere, weighted by the cosine.
    fn passed_on_average(&self) -> f32 {
        let reflected = if self.alpha < MIRROR_ALPHA {
            self.f0 + (1.0 - self.f0) / 21.0
        } else {
            albedo::average(self.alpha).by_schlick(self.f0)
        };
        1.0 - self.cover * reflected
    }
}

/// A matt body under a coat. Light that the coat throws back inside is scattered again, and saturates the colour.
///
/// f = ρ T(o) T(i) / (π η² (1 − ρ (1 − T̄ / η²))): T is what the coat lets through, T̄ its mean, T̄ / η² that of light
/// from within (Egan & Hilgeman 1979). Reciprocal; with ρ = 1 coat and body together return all light.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Substrate {
    /// Everything of the formula but T(o) T(i) / π, times the share among lobes.
    albedo: Rgb,
    coat: Coat,
}

impl Substrate {
    /// A body of albedo `color` in [0, 1] under a coat of index `ior`; `share` of the material.
    pub fn new(color: Rgb, ior: f32, coat: Coat, share: f32) -> Self {
        let eta2 = ior * ior;
        let leaves = coat.passed_on_average() / eta2;
        let albedo = color.map(|rho| share * rho / (eta2 * (1.0 - rho * (1.0 - leaves))));
        Self { albedo, coat }
    }

    /// Whether it scatters nothing.
    pub fn is_black(&self) -> bool {
        self.albedo.is_black()
    }

    /// About how much light leaves it, seen at an angle.
    pub(super) fn albedo(&self, cos: f32) -> f32 {
        /// About what comes out at other angles.
        const OTHERS: f32 = 0.9;
        self.albedo.mean() * self.coat.passed(cos) * OTHERS
    }

    /// Value times `cos θi`, and density, per steradian.
    pub(super) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
        let passed = self.coat.passed(wo.z) * self.coat.passed(wi.z);
        (self.albedo * (passed * wi.z * FRAC_1_PI), warp::square_to_cosine_hemisphere_pdf(wi))
    }

    /// Draws by the cosine.
    pub(super) fn sample(&self, wo: Vec3, u: Vec2) -> Option<LobeSample> {
        let wi = warp::square_to_cosine_hemisphere(u);
        let (value, pdf) = self.eval_pdf(wo, wi);
        (pdf > 0.0).then(|| LobeSample::smooth(wi, value / pdf, pdf))
    }
}
