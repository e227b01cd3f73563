//! Radiance from the photons around a point.

use super::{Disc, Neighbor, Photon, PhotonMap};
use crate::math::{Rgb, Vec3};
use crate::render::bsdf::Bsdf;
use crate::render::geometry::SurfacePoint;
use std::cell::RefCell;
use std::f32::consts::{FRAC_1_PI, PI};
use std::ops::ControlFlow;

/// Surfaces whose normals differ by more than 60° do not share photons.
const COS_MOST_BENT: f32 = 0.5;

thread_local! {
    /// Room for the photons of one gather; kept, so that gathering allocates nothing.
    static FOUND: RefCell<Vec<Neighbor>> = const { RefCell::new(Vec::new()) };
}

/// How photons are gathered.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gather {
    /// The square of the largest radius of the disc, in m².
    pub radius2: f32,
    /// The most photons that count, at least 2: of more, the nearest.
    pub k: usize,
    /// Photons of longer paths do not count.
    pub max_depth: u32,
}

impl Gather {
    /// The radiance along `wo` of light that photons brought: their number, weighed by the bsdf, over the area of the disc.
    ///
    /// When the k-th photon bounds the disc, only the k − 1 inside count: k over that area would be too bright by k / (k − 1).
    pub fn radiance(&self, map: &PhotonMap, surface: &SurfacePoint, bsdf: &Bsdf, wo: Vec3) -> Rgb {
        let n = if wo.dot(surface.n) < 0.0 { -surface.n } else { surface.n };
        let disc = Disc { p: surface.p, n, radius: self.radius2.sqrt(), k: self.k };
        let accepts = |photon: &Photon| {
            photon.depth <= self.max_depth && photon.wi.dot(n) > 0.0 && photon.n.dot(n) >= COS_MOST_BENT
        };
        let sends = Sends::new(bsdf, wo, n);
        if let Some(sum) = self.sum_all(map, &disc, accepts, &sends) {
            return sends.radiance(sum) / (PI * self.radius2);
        }
        FOUND.with_borrow_mut(|found| {
            map.nearest(&disc, accepts, found);
            let (counted, disc2) = bounding_disc(found, self.k, self.radius2);
            let photons = counted.iter().map(|neighbor| &map.photons()[neighbor.index as usize]);
            sends.radiance(photons.map(|photon| sends.of(photon)).sum()) / (PI * disc2)
        })
    }

    /// The sum over all photons of the disc; `None` if there are `k` or more. Most discs hold fewer, and then nothing need
    /// be collected or compared.
    fn sum_all(
        &self,
        map: &PhotonMap,
        disc: &Disc,
        accepts: impl Fn(&Photon) -> bool,
        sends: &Sends,
    ) -> Option<Rgb> {
        let (mut sum, mut count) = (Rgb::BLACK, 0);
        map.within(disc, |photon| {
            if accepts(photon) {
                sum += sends.of(photon);
                count += 1;
            }
            if count < self.k { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        (count < self.k).then_some(sum)
    }
}

/// The photons that count, and the squared radius of the disc over which they are spread.
fn bounding_disc(found: &[Neighbor], k: usize, radius2: f32) -> (&[Neighbor], f32) {
    match found.split_last() {
        // Photons on one spot bound no disc.
        Some((farthest, inside)) if found.len() == k && farthest.radius2 >= f32::MIN_POSITIVE => {
            (inside, farthest.radius2)
        }
        _ => (found, radius2),
    }
}

/// What photons send on along one direction, each its power times the bsdf.
///
/// Photons arrive in proportion to the cosine with the geometric normal, `eval` counts that with the shading normal: their
/// ratio remains. Where both are the same and the surface is diffuse, the bsdf is the same for all.
struct Sends<'a> {
    bsdf: &'a Bsdf,
    wo: Vec3,
    n: Vec3,
    /// What all photons have in common.
    factor: Option<Rgb>,
}

impl<'a> Sends<'a> {
    fn new(bsdf: &'a Bsdf, wo: Vec3, n: Vec3) -> Self {
        let factor = bsdf.matt_albedo().map(|albedo| albedo * FRAC_1_PI);
        Self { bsdf, wo, n, factor }
    }

    /// What one photon adds, but for the common factor.
    #[inline]
    fn of(&self, photon: &Photon) -> Rgb {
        match self.factor {
            Some(_) => photon.power,
            None => photon.power * self.bsdf.eval(self.wo, photon.wi) / photon.wi.dot(self.n),
        }
    }

    fn radiance(&self, sum: Rgb) -> Rgb {
        self.factor.map_or(sum, |factor| sum * factor)
    }
}
