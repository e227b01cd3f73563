//! What a path is inside of.

use super::bsdf::{MaterialId, Materials};
use crate::math::{Rgb, float};

/// The clear solids around a point of a path, the innermost last. One inside another hides it.
///
/// Solids nested deeper than eight are not told apart from the eighth.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Media {
    stack: [MaterialId; Self::DEPTH],
    count: usize,
}

impl Media {
    const DEPTH: usize = 8;

    /// Free space.
    pub const NONE: Self = Self { stack: [MaterialId(0); Self::DEPTH], count: 0 };

    /// Goes through the surface of a solid: into it, or out of it. Leaving what was never entered changes nothing.
    pub fn cross(&mut self, solid: MaterialId, inwards: bool) {
        if inwards && self.count < Self::DEPTH {
            self.stack[self.count] = solid;
            self.count += 1;
        } else if !inwards && let Some(i) = self.inside().iter().rposition(|&id| id == solid) {
            self.stack.copy_within(i + 1..self.count, i);
            self.count -= 1;
        }
    }

    /// The refractive index on the inner side of a solid's surface over that on the outer side; `None` if it is not glass.
    ///
    /// Where solids overlap, the one entered last fills the space: leaving another one there changes nothing.
    pub fn relative_ior(&self, solid: MaterialId, from_outside: bool, materials: &Materials) -> Option<f32> {
        let own = materials.ior(solid)?;
        if from_outside {
            return Some(own / self.ior(materials));
        }
        let mut beyond = *self;
        beyond.cross(solid, false);
        let inner = if beyond.count < self.count { self.ior(materials) } else { own };
        Some(inner / beyond.ior(materials))
    }

    /// The share of light that is left after `distance` metres.
    pub fn transmittance(&self, distance: f32, materials: &Materials) -> Rgb {
        let innermost = self.inside().last().and_then(|&id| materials.absorption(id));
        innermost.map_or(Rgb::WHITE, |sigma| {
            sigma.map(|sigma| if sigma > 0.0 { float::exp(-sigma * distance) } else { 1.0 })
        })
    }

    /// The refractive index of what fills the space.
    fn ior(&self, materials: &Materials) -> f32 {
        self.inside().last().and_then(|&id| materials.ior(id)).unwrap_or(1.0)
    }

    fn inside(&self) -> &[MaterialId] {
        &self.stack[..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::bsdf::Material;

    const BOWL: MaterialId = MaterialId(0);
    const WATER: MaterialId = MaterialId(1);

    fn materials() -> Materials {
        let glass =
            |ior, absorption| Material::Glass { ior, tint: Rgb::WHITE, absorption: Rgb::gray(absorption) };
        Materials::new(vec![glass(1.5, 0.0), glass(1.25, 1.0)], Vec::new())
    }

    #[test]
    fn water_in_a_bowl_refracts_by_the_ratio_of_the_two() {
        let mut media = Media::NONE;
        assert_eq!(media.relative_ior(BOWL, true, &materials()), Some(1.5));
        media.cross(BOWL, true);
        assert_eq!(media.relative_ior(WATER, true, &materials()), Some(1.25 / 1.5));
        media.cross(WATER, true);
        assert_eq!(media.relative_ior(WATER, false, &materials()), Some(1.25 / 1.5));
        assert!((media.transmittance(1.0, &materials()).r - (-1.0_f32).exp()).abs() < 1e-6);
        media.cross(WATER, false);
        assert_eq!(media.relative_ior(BOWL, false, &materials()), Some(1.5));
    }

    #[test]
    fn where_solids_overlap_the_last_entered_fills_the_space() {
        let mut media = Media::NONE;
        media.cross(BOWL, true);
        assert_eq!(media.relative_ior(BOWL, true, &materials()), Some(1.0), "glass melts into like glass");
        media.cross(WATER, true);
        assert_eq!(
            media.relative_ior(BOWL, false, &materials()),
            Some(1.0),
            "the bowl ends within the water"
        );
        media.cross(BOWL, false);
        assert_eq!(media.relative_ior(WATER, false, &materials()), Some(1.25));
        media.cross(WATER, false);
        media.cross(WATER, false);
        assert_eq!(media.transmittance(1.0, &materials()), Rgb::WHITE);
        assert_eq!(
            media.relative_ior(BOWL, false, &materials()),
            Some(1.5),
            "whoever starts inside gets out"
        );
    }
}
