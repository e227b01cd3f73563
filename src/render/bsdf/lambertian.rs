//! A surface that only scatters equally in all directions, reduced to what many directions in a row ask of it.

use super::{Bsdf, Lobe};
use crate::math::{Rgb, Vec3};
use std::f32::consts::FRAC_1_PI;

/// A Lambertian surface seen from one direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Lambertian {
    albedo: Rgb,
    /// The geometric normal and the one that it scatters about, on the viewer's side.
    n: Vec3,
    ns: Vec3,
}

impl Bsdf {
    /// Whether all it does is to scatter equally in all directions.
    pub fn is_lambertian(&self) -> bool {
        matches!(self.lobes(), [Lobe::Lambert { .. }]) && self.covered == 0
    }

    /// What it is for a viewer along `wo`, if that is all it does; `None` edge-on, too.
    pub fn lambertian(&self, wo: Vec3) -> Option<Lambertian> {
        let &[Lobe::Lambert { albedo }] = self.lobes() else { return None };
        let view = self.view(wo).filter(|_| self.covered == 0)?;
        Some(Lambertian { albedo, n: self.n * view.side, ns: view.frame.z * view.side })
    }
}

impl Lambertian {
    /// [`Bsdf::eval_pdf`] for the viewer's direction and `wi`.
    #[inline]
    pub fn eval_pdf(&self, wi: Vec3) -> (Rgb, f32) {
        let pdf = self.ns.dot(wi) * FRAC_1_PI;
        if pdf > 0.0 && self.n.dot(wi) > 0.0 { (self.albedo * pdf, pdf) } else { (Rgb::BLACK, 0.0) }
    }
}
