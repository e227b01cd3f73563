//! What a path is inside of.

use super::bsdf::{Interior, MaterialId, Materials, Wavelength};
use super::effects::Effects;
use super::sampler::{Dim, Sampler};
use crate::math::{Rgb, float};

/// What the surface of a clear solid parts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Boundary {
    /// The refractive index on the inner side over that on the outer.
    pub ior: f32,
    /// Whether another solid fills both sides, so that there is nothing to see.
    pub hidden: bool,
}

/// The clear solids around a point of a path, the innermost last. One inside another hides it.
///
/// Solids nested deeper than eight are not told apart from the eighth.
///
/// A path that may meet glass which spreads colours has a wavelength, by which all such glass bends it. It is as white as
/// any other until it goes through the first of them, and then takes on the colour of its wavelength.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Media {
    stack: [MaterialId; Self::DEPTH],
    count: usize,
    wavelength: Option<Wavelength>,
    /// Whether the path has the colour of its wavelength.
    colored: bool,
}

impl Media {
    const DEPTH: usize = 8;

    /// Free space.
    pub const NONE: Self =
        Self { stack: [MaterialId(0); Self::DEPTH], count: 0, wavelength: None, colored: false };

    /// Free space at the start of a path, which draws its wavelength if some glass disperses.
    pub fn start(materials: &Materials, sampler: &Sampler) -> Self {
        let draw = || Wavelength::sample(sampler.get_1d(Dim::Wavelength));
        Self { wavelength: materials.effects().has(Effects::DISPERSION).then(draw), ..Self::NONE }
    }

    /// Goes through the surface of a solid, as [`Self::cross`]; the factor of the light that does.
    pub fn pass(&mut self, solid: MaterialId, inwards: bool, materials: &Materials) -> Rgb {
        self.cross(solid, inwards);
        match (self.wavelength, materials.interior(solid)) {
            (Some(wavelength), Some(interior)) if interior.spread > 0.0 && !self.colored => {
                self.colored = true;
                wavelength.color()
            }
            _ => Rgb::WHITE,
        }
    }

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
    /// Where solids overlap, the one of highest priority fills the space (Schmidt & Budge 2002); of equals, the one entered
    /// last: leaving another one there changes nothing.
    pub fn relative_ior(&self, solid: MaterialId, from_outside: bool, materials: &Materials) -> Option<f32> {
        Some(self.boundary(solid, from_outside, materials)?.ior)
    }

    /// What the surface of a solid parts; `None` if it is not glass.
    pub fn boundary(&self, solid: MaterialId, from_outside: bool, materials: &Materials) -> Option<Boundary> {
        let own = materials.interior(solid)?;
        let mut beyond = *self;
        beyond.cross(solid, from_outside);
        let (here, there) = (self.filling(materials), beyond.filling(materials));
        // Whoever leaves what was never entered has been in it all along.
        let here = if !from_outside && beyond.count == self.count { Some((solid, own)) } else { here };
        let ior = |filling: Option<(MaterialId, &Interior)>| {
            filling.map_or(1.0, |(_, interior)| self.ior(interior))
        };
        let id = |filling: Option<(MaterialId, &Interior)>| filling.map(|(id, _)| id);
        let (inner, outer) = if from_outside { (there, here) } else { (here, there) };
        Some(Boundary {
            ior: ior(inner) / ior(outer),
            hidden: id(inner) == id(outer) && id(inner) != Some(solid),
        })
    }

    /// The share of light that is left after `distance` metres.
    pub fn transmittance(&self, distance: f32, materials: &Materials) -> Rgb {
        if self.count == 0 || !materials.effects().has(Effects::ABSORPTION) {
            return Rgb::WHITE;
        }
        self.filling(materials).map_or(Rgb::WHITE, |(_, interior)| {
            interior.absorption.map(|sigma| if sigma > 0.0 { float::exp(-sigma * distance) } else { 1.0 })
        })
    }

    /// The refractive index of a solid for this path.
    fn ior(&self, interior: &Interior) -> f32 {
        match self.wavelength {
            Some(wavelength) if interior.spread > 0.0 => wavelength.ior(interior.ior, interior.spread),
            _ => interior.ior,
        }
    }

    /// What fills the space: the solid of highest priority, of equals the one entered last.
    fn filling<'a>(&self, materials: &'a Materials) -> Option<(MaterialId, &'a Interior)> {
        let solids = self.inside().iter().filter_map(|&id| Some((id, materials.interior(id)?)));
        solids.reduce(|best, next| if next.1.priority >= best.1.priority { next } else { best })
    }

    fn inside(&self) -> &[MaterialId] {
        &self.stack[..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::bsdf::{Glass, Material};

    const BOWL: MaterialId = MaterialId(0);
    const WATER: MaterialId = MaterialId(1);
    const STONE: MaterialId = MaterialId(2);

    fn materials() -> Materials {
        let glass = |ior, absorption, priority| {
            Material::Glass(Glass { absorption: Rgb::gray(absorption), priority, ..Glass::of_ior(ior) })
        };
        Materials::new(vec![glass(1.5, 0.0, 0), glass(1.25, 1.0, 0), glass(2.0, 0.0, 1)], Vec::new())
    }

    #[test]
    fn glass_that_spreads_colours_bends_blue_more_than_red() {
        let flint = Glass { spread: 0.017, ..Glass::of_ior(1.62) };
        let materials = Materials::new(vec![Material::Glass(flint)], Vec::new());
        let ior = |u| {
            let media = Media { wavelength: Some(Wavelength::sample(u)), ..Media::NONE };
            media.relative_ior(MaterialId(0), true, &materials).expect("it is glass")
        };
        let (blue, red) = (ior(0.0), ior(0.999));
        assert!(red < 1.62 && 1.62 < blue && (0.02..0.06).contains(&(blue - red)), "{blue} {red}");
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

    #[test]
    fn of_solids_that_overlap_the_one_of_highest_priority_fills_the_space() {
        let mut media = Media::NONE;
        media.cross(STONE, true);
        let boundary = media.boundary(WATER, true, &materials());
        assert_eq!(boundary, Some(Boundary { ior: 1.0, hidden: true }), "water cannot get into the stone");
        media.cross(WATER, true);
        assert_eq!(media.transmittance(1.0, &materials()), Rgb::WHITE, "nor darken it");
        assert_eq!(
            media.relative_ior(STONE, false, &materials()),
            Some(2.0 / 1.25),
            "the stone lies in water"
        );
        media.cross(STONE, false);
        assert_eq!(media.relative_ior(WATER, false, &materials()), Some(1.25));
    }
}
