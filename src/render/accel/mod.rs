//! Finding what a ray meets among many.

use super::geometry::{Hit, Nearest, PrimId};
use super::shape::triangle::{LANES, ShearedRay, TriangleBlock};
use crate::math::{Bounds, Ray, Vec3};

/// What rays are traced against.
pub struct Tree {
    bounds: Bounds,
    blocks: Vec<TriangleBlock>,
    solids: Vec<u32>,
}

impl Tree {
    /// Builds over triangles, whose primitive is their index, and solids with their index and box.
    pub fn build(triangles: &[[Vec3; 3]], solids: &[(u32, Bounds)]) -> Self {
        let triangles: Vec<_> = triangles.iter().copied().zip(0..).collect();
        let bounds = Bounds::of(triangles.iter().flat_map(|(corners, _)| *corners));
        Self {
            bounds: solids.iter().fold(bounds, |all, (_, solid)| all.union(*solid)),
            blocks: triangles.chunks(LANES).map(TriangleBlock::new).collect(),
            solids: solids.iter().map(|(solid, _)| *solid).collect(),
        }
    }

    /// A box that holds everything.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Offers to `nearest` every hit that can be the nearest; `hit_solid` tests a solid.
    pub fn closest(&self, ray: &Ray, nearest: &mut Nearest, hit_solid: impl Fn(u32, &Ray) -> Option<Hit>) {
        let sheared = ShearedRay::new(ray);
        for block in &self.blocks {
            block.intersect(&sheared, |prim, hit| {
                nearest.offer(Some(Hit { t: hit.t, prim: PrimId(prim), uv: hit.uv }));
            });
        }
        for &solid in &self.solids {
            nearest.offer(hit_solid(solid, ray));
        }
    }

    /// Whether anything lies in the open interval (0, `ray.t_max`).
    pub fn any(&self, ray: &Ray, hit_solid: impl Fn(u32, &Ray) -> Option<Hit>) -> bool {
        let mut nearest = Nearest { t: ray.t_max, hit: None };
        self.closest(ray, &mut nearest, hit_solid);
        nearest.hit.is_some()
    }
}
