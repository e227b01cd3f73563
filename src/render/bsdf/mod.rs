//! Scattering at a point of a surface.
//!
//! A [`Material`] with its textures looked up at a point is a [`Bsdf`]: a frame and a few weighted [`Lobe`]s. It answers
//! the trio of every distribution: `eval`, `pdf`, `sample`; the three agree. Lobes that scatter into a single direction
//! evaluate to zero, and only `sample` finds them.

mod albedo;
mod assemble;
mod conductor;
mod dielectric;
mod dispersion;
mod fresnel;
mod ground;
mod lambertian;
mod lobe;
mod material;
mod materials;
mod mirror;
mod pane;
mod phong;
mod relief;
mod rough_dielectric;
mod substrate;

pub use assemble::lobe_count;
pub use conductor::Conductor;
pub use dielectric::fresnel_dielectric;
pub use dispersion::Wavelength;
pub use fresnel::Reflectance;
pub use lambertian::Lambertian;
pub use lobe::Lobe;
pub use material::{Emission, Glass, Input, Interior, Material, MaterialId, Principled, Relief, TextureId};
pub use materials::Materials;
pub use pane::Pane;
pub use relief::facing;
pub use rough_dielectric::RoughDielectric;
pub use substrate::{Coat, Substrate};

use super::geometry::SurfacePoint;
use crate::math::{Frame, Rgb, Vec2, Vec3};
use lobe::LobeSample;

/// What is carried along a path: the two differ by η² at refraction, and where shading normals stand in for real ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Transport {
    /// Radiance, sought by paths from the camera.
    Radiance,
    /// Power, carried by photons.
    Importance,
}

impl Transport {
    /// The factor of what is refracted into a medium of relative index `eta`, seen from the viewer's side: radiance
    /// scales by 1/η² (Veach 1997, eq. 5.1), power does not.
    fn refracted(self, eta: f32) -> f32 {
        match self {
            Self::Radiance => 1.0 / (eta * eta),
            Self::Importance => 1.0,
        }
    }
}

/// The side of a surface that a viewer is on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Side {
    /// That of the geometric normal.
    Outside,
    /// The other.
    Inside,
}

impl Side {
    /// The index beyond the surface over that on this side, where `ior` is that against the normal over that along it.
    fn eta(self, ior: f32) -> f64 {
        match self {
            Self::Outside => f64::from(ior),
            Self::Inside => 1.0 / f64::from(ior),
        }
    }
}

/// A drawn direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BsdfSample {
    /// The unit direction, leaving the surface.
    pub wi: Vec3,
    /// `eval / pdf`.
    pub weight: Rgb,
    /// The density per steradian, of all lobes together; for a specular lobe the probability of choosing it.
    pub pdf: f32,
    /// Whether the lobe scatters into this direction alone.
    pub specular: bool,
    /// Whether light went through the surface into what is behind it; through a pane it goes without.
    pub through: bool,
    /// The refractive index behind the surface, relative to the one in front, if the path went through; 1 otherwise.
    pub eta: f32,
}

impl BsdfSample {
    /// By how much a path grows in width for each metre once it has gone this way, from how much it did before.
    ///
    /// What scatters widely is followed in few directions, each of which stands for the solid angle 1 / pdf about it: what it
    /// meets may be blurred over a tenth of that angle's width without a trace in the picture.
    pub fn angle(&self, before: f32) -> f32 {
        const SHARE: f32 = 0.1;
        if self.specular { before } else { before.max(SHARE / self.pdf.sqrt()) }
    }
}

/// How light scatters at one point.
#[derive(Clone, Copy, Debug)]
pub struct Bsdf {
    /// About the shading normal.
    frame: Frame,
    /// The geometric normal: it alone decides on which side a direction lies.
    n: Vec3,
    lobes: [Lobe; Self::MAX_LOBES],
    count: usize,
    /// A clear layer over some of the lobes.
    coat: Option<Coat>,
    /// Which: a bit for each lobe.
    covered: u8,
}

/// The outgoing direction in the frame that serves it.
struct View {
    frame: Frame,
    /// −1 when seen from behind: local z axes are turned, so that `wo.z > 0`.
    side: f32,
    wo: Vec3,
}

impl Bsdf {
    /// The most lobes at one point: few, because a bsdf is made at every vertex.
    pub const MAX_LOBES: usize = 6;

    /// A surface that scatters nothing yet.
    pub fn new(surface: &SurfacePoint) -> Self {
        let frame = Frame { x: surface.tangent, y: surface.ns.cross(surface.tangent), z: surface.ns };
        Self { frame, n: surface.n, lobes: [Lobe::NONE; Self::MAX_LOBES], count: 0, coat: None, covered: 0 }
    }

    /// Adds a lobe, unless it is black; diffuse ones are joined into one, and mirrors are too.
    pub fn add(&mut self, lobe: Lobe) {
        if lobe.is_black() {
            return;
        }
        self.add_under(lobe, false);
    }

    /// Adds a lobe, under the coat or not; of those on the same side of it, alike ones are joined.
    fn add_under(&mut self, lobe: Lobe, covered: bool) {
        for i in 0..self.count {
            if self.is_covered(i) == covered
                && let Some(joined) = self.lobes[i].joined(&lobe)
            {
                self.lobes[i] = joined;
                return;
            }
        }
        self.lobes[self.count] = lobe;
        self.covered |= u8::from(covered) << self.count;
        self.count += 1;
    }

    /// Lays a clear layer over the lobes from `first` on. The layer's own lobe is added after.
    pub fn cover(&mut self, coat: Coat, first: usize) {
        self.coat = Some(coat);
        for i in first..self.count {
            self.covered |= 1 << i;
        }
    }

    fn is_covered(&self, lobe: usize) -> bool {
        self.covered >> lobe & 1 == 1
    }

    /// The albedo, if all it does is to scatter equally in all directions about the geometric normal.
    pub fn matt_albedo(&self) -> Option<Rgb> {
        match *self.lobes() {
            [Lobe::Lambert { albedo }] if self.covered == 0 && self.frame.z == self.n => Some(albedo),
            _ => None,
        }
    }

    /// Whether light may pass through into more than one direction.
    pub fn spreads_through(&self) -> bool {
        self.lobes().iter().any(Lobe::spreads_through)
    }

    /// The lobes in the order they were added.
    pub fn lobes(&self) -> &[Lobe] {
        &self.lobes[..self.count]
    }

    /// Only the lobes that a photon mapper, say, is interested in.
    #[must_use]
    pub fn only(&self, keep: impl Fn(&Lobe) -> bool) -> Self {
        let mut part = Self { count: 0, covered: 0, ..*self };
        for (i, &lobe) in self.lobes().iter().enumerate().filter(|(_, lobe)| keep(lobe)) {
            part.add_under(lobe, self.is_covered(i));
        }
        part
    }

    /// Puts it between other media: `ior` is the refractive index against the normal over that along it.
    pub fn set_ior(&mut self, ior: f32) {
        for lobe in &mut self.lobes[..self.count] {
            match lobe {
                Lobe::Dielectric { ior: own, .. } => *own = ior,
                Lobe::RoughDielectric(RoughDielectric { share, tint, .. })
                    if (ior - 1.0).abs() < RoughDielectric::LEAST_BEND =>
                {
                    *lobe = Lobe::Dielectric { share: *share, ior, tint: *tint };
                }
                Lobe::RoughDielectric(rough) => rough.ior = ior,
                _ => {}
            }
        }
    }

    /// Whether light may come through the surface.
    pub fn transmits(&self) -> bool {
        self.lobes().iter().any(Lobe::transmits)
    }

    /// The unit normal that it scatters about, on the side of the geometric one.
    pub fn normal(&self) -> Vec3 {
        self.frame.z
    }

    /// The same as if the normal that it scatters about were the real one.
    #[must_use]
    pub fn rounded(&self) -> Self {
        Self { n: self.frame.z, ..*self }
    }

    /// Puts it where another solid fills the space on both sides: light passes as if nothing were there.
    pub fn hide(&mut self) {
        self.set_ior(1.0);
        for lobe in &mut self.lobes[..self.count] {
            if let Lobe::Dielectric { tint, .. } = lobe {
                *tint = Rgb::WHITE;
            }
        }
    }

    /// Whether any lobe scatters into more than one direction.
    pub fn is_smooth(&self) -> bool {
        self.lobes().iter().any(|lobe| !lobe.is_specular())
    }

    /// About how much light it sends on, seen from `wo`: the sum over the lobes.
    pub fn albedo(&self, wo: Vec3) -> f32 {
        self.view(wo).map_or(0.0, |view| self.lobes().iter().map(|lobe| lobe.albedo(view.wo)).sum())
    }

    /// Where light can only be mirrored or go through, each in one direction: the chance of being mirrored, for which
    /// [`Self::sample`] wants a `u_lobe` below it.
    pub fn mirrored_share(&self, wo: Vec3) -> Option<f32> {
        let [lobe] = self.lobes() else { return None };
        let view = self.view(wo)?;
        lobe.mirrored_share(view.wo, view.side())
    }

    /// Whether [`Self::sample`] looks at `u_lobe`: not with a single lobe that only reflects.
    pub fn has_choice(&self) -> bool {
        !matches!(self.lobes(), [lobe] if !lobe.has_choice())
    }

    /// The lobe from which [`Self::sample`] draws for `u_lobe`.
    pub fn lobe_chosen(&self, wo: Vec3, u_lobe: f32) -> Option<Lobe> {
        let (lobe, ..) = self.choose(self.view(wo)?.wo, u_lobe)?;
        Some(self.lobes[lobe])
    }

    /// The value for a pair of directions times `|cos θi|`, per steradian; zero for specular lobes.
    ///
    /// The cosine is that of the shading normal: what a photon of flux Φ per area gives off is `eval · Φ / |wi · n|`.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        self.eval_pdf(wo, wi).0
    }

    /// The density with which [`Self::sample`] draws `wi`, per steradian; zero for specular lobes.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.eval_pdf(wo, wi).1
    }

    /// [`Self::eval`] and [`Self::pdf`] at once.
    ///
    /// Both directions are unit vectors that leave the surface. Where the two lie on different sides of the geometric
    /// normal, only lobes that spread light through the surface count.
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
        const NOTHING: (Rgb, f32) = (Rgb::BLACK, 0.0);
        let through = !self.same_side(wo, wi);
        if through && !self.spreads_through() {
            return NOTHING;
        }
        let Some(view) = self.view(wo) else { return NOTHING };
        let wi = view.to_local(wi);
        if wi.z == 0.0 || (wi.z < 0.0) != through {
            return NOTHING;
        }
        self.eval_pdf_local(&view, wi)
    }

    /// Draws a direction: a lobe by `u_lobe`, then from the lobe by `u`.
    ///
    /// `None` when nothing is scattered: seen edge-on, black, or drawn to where no light can go.
    pub fn sample(&self, wo: Vec3, u: Vec2, u_lobe: f32, transport: Transport) -> Option<BsdfSample> {
        let view = self.view(wo)?;
        let (lobe, pmf, u_rest) = self.choose(view.wo, u_lobe)?;
        let drawn = self.lobes[lobe].sample(view.wo, view.side(), u, u_rest, transport)?;
        let wi = self.on_its_side(wo, view.to_world(drawn.wi), &drawn)?;
        let (weight, pdf) = self.weigh(&view, &drawn, lobe, pmf, transport)?;
        let weight = match transport {
            Transport::Radiance => weight,
            Transport::Importance => weight * self.shading_correction(wo, wi, &view, drawn.wi),
        };
        let LobeSample { specular, through, enters, eta, .. } = drawn;
        Some(BsdfSample { wi, weight, pdf, specular, through: through && enters, eta })
    }

    /// Weight and density of a drawn direction among all lobes.
    fn weigh(
        &self,
        view: &View,
        drawn: &LobeSample,
        lobe: usize,
        pmf: f32,
        transport: Transport,
    ) -> Option<(Rgb, f32)> {
        if drawn.specular || self.count == 1 {
            let passed = if self.is_covered(lobe) { self.passed(view.wo, drawn.wi) } else { 1.0 };
            return Some((drawn.weight * (passed / pmf), drawn.pdf * pmf));
        }
        let (value, pdf) = self.eval_pdf_local(view, drawn.wi);
        // The value is that of radiance.
        let scale = transport.refracted(drawn.eta) * drawn.eta * drawn.eta;
        (pdf > 0.0).then(|| (value * (scale / pdf), pdf))
    }

    /// All smooth lobes together, in the local frame.
    fn eval_pdf_local(&self, view: &View, wi: Vec3) -> (Rgb, f32) {
        let wo = view.wo;
        let (mut value, mut pdf, mut total) = (Rgb::BLACK, 0.0, 0.0);
        let passed = if self.covered == 0 { 1.0 } else { self.passed(wo, wi) };
        for (i, lobe) in self.lobes().iter().enumerate() {
            let share = lobe.albedo(wo);
            total += share;
            if !lobe.is_specular() {
                let (f, p) = lobe.eval_pdf(wo, wi, view.side());
                value += if self.is_covered(i) { f * passed } else { f };
                pdf += share * p;
            }
        }
        if total > 0.0 { (value, pdf / total) } else { (Rgb::BLACK, 0.0) }
    }

    /// The share of light that reaches what is under the coat and comes out again.
    ///
    /// The lesser of what passes at the two angles: reciprocal, and whatever lies below returns no more than the coat
    /// leaves it.
    fn passed(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.coat.map_or(1.0, |coat| coat.passed(wo.z).min(coat.passed(wi.z.abs())))
    }

    /// A lobe with the probability of choosing it, in proportion to its albedo, and what is left of `u`.
    fn choose(&self, wo: Vec3, u: f32) -> Option<(usize, f32, f32)> {
        if let [lobe] = self.lobes() {
            return (lobe.albedo(wo) > 0.0).then_some((0, 1.0, u));
        }
        let total: f32 = self.lobes().iter().map(|lobe| lobe.albedo(wo)).sum();
        let mut rest = u * total;
        let mut chosen = None;
        for (i, lobe) in self.lobes().iter().enumerate() {
            let share = lobe.albedo(wo);
            if share > 0.0 {
                chosen = Some((i, share / total, (rest / share).clamp(0.0, ONE_MINUS)));
                if rest < share {
                    break;
                }
            }
            rest -= share;
        }
        chosen
    }

    /// The frame for an outgoing direction; `None` edge-on.
    ///
    /// Where an interpolated normal faces away from a viewer who sees the surface, the geometric one takes its place:
    /// nothing that is visible turns black, and no cosine turns negative.
    fn view(&self, wo: Vec3) -> Option<View> {
        let cos = wo.dot(self.n);
        let side = 1.0_f32.copysign(cos);
        let shading = View { frame: self.frame, side, wo: Vec3::ZERO };
        let wo_local = shading.to_local(wo);
        if wo_local.z > 0.0 && cos != 0.0 {
            return Some(View { wo: wo_local, ..shading });
        }
        let geometric = View { frame: Frame::from_normal(self.n), side, wo: Vec3::ZERO };
        let wo = geometric.to_local(wo);
        (wo.z > 0.0).then_some(View { wo, ..geometric })
    }

    /// Whether two directions lie on the same side of the geometric surface.
    fn same_side(&self, a: Vec3, b: Vec3) -> bool {
        a.dot(self.n) * b.dot(self.n) > 0.0
    }

    /// Holds a drawn direction to the side of the geometric surface that it belongs to.
    ///
    /// A specular direction that an interpolated normal sends to the wrong side is bent back; any other is lost.
    fn on_its_side(&self, wo: Vec3, wi: Vec3, drawn: &LobeSample) -> Option<Vec3> {
        if self.same_side(wo, wi) != drawn.through {
            return Some(wi);
        }
        let bent = wi - self.n * (2.0 * wi.dot(self.n));
        (drawn.specular && self.same_side(wo, bent) != drawn.through).then_some(bent)
    }

    /// What makes scattering of photons by shading normals the adjoint of that of radiance (Veach 1997, eq. 5.19).
    fn shading_correction(&self, wo: Vec3, wi: Vec3, view: &View, wi_local: Vec3) -> f32 {
        let (shading, geometric) = (view.wo.z * wi.dot(self.n), wi_local.z * wo.dot(self.n));
        (shading / geometric).abs()
    }
}

impl View {
    /// The side of the geometric normal that the viewer is on.
    fn side(&self) -> Side {
        if self.side > 0.0 { Side::Outside } else { Side::Inside }
    }

    fn to_local(&self, w: Vec3) -> Vec3 {
        let w = self.frame.to_local(w);
        Vec3::new(w.x, w.y, w.z * self.side)
    }

    fn to_world(&self, w: Vec3) -> Vec3 {
        self.frame.to_world(Vec3::new(w.x, w.y, w.z * self.side)).normalize()
    }
}

/// The largest number below 1.
const ONE_MINUS: f32 = 1.0 - f32::EPSILON / 2.0;
