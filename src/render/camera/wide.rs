//! Views that are no perspective: parallel rays, all around, and through a fisheye.

use crate::math::{Ray, Vec2, Vec3, float};
use std::f32::consts::FRAC_PI_2;

/// How points of the picture become directions.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum View {
    /// Parallel rays, as from infinitely far.
    Orthographic {
        /// Half the width and half the height of what is seen, in metres.
        half: Vec2,
    },
    /// Longitude to the right and latitude upwards, in equal steps.
    Panorama {
        /// Half the angles from left to right and from bottom to top, in radians; at most π and π/2.
        half: Vec2,
    },
    /// A round picture; what lies outside of it is black.
    Fisheye {
        /// Half the angle from rim to rim, in radians.
        half: f32,
        /// From angle to radius.
        mapping: Mapping,
        /// The radius of the picture's rim, in half widths and half heights of the film.
        rim: Vec2,
    },
}

/// How a fisheye lens maps the angle θ from its axis to the distance from the picture's middle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mapping {
    /// In proportion to θ.
    Equidistant,
    /// In proportion to sin θ/2: equal solid angles fill equal areas.
    EquisolidAngle,
    /// In proportion to tan θ/2: small things keep their shape.
    Stereographic,
    /// In proportion to sin θ, up to 90°.
    Orthographic,
}

impl View {
    /// The ray, in the frame of the camera (right, up, forward), of a film point from (−1, −1) at the lower left to (1, 1).
    pub fn ray(&self, film: Vec2) -> Option<Ray> {
        match self {
            Self::Orthographic { half } => {
                Some(Ray::new(Vec3::new(film.x * half.x, film.y * half.y, 0.0), Vec3::Z))
            }
            Self::Panorama { half } => {
                let (sin, cos) = float::sin_cos(film.x * half.x);
                let (up, level) = float::sin_cos((film.y * half.y).clamp(-FRAC_PI_2, FRAC_PI_2));
                Some(Ray::new(Vec3::ZERO, Vec3::new(level * sin, up, level * cos).normalize()))
            }
            Self::Fisheye { half, mapping, rim } => {
                let p = film / *rim;
                let r = p.length();
                if r > 1.0 {
                    return None;
                }
                let (sin, cos) = float::sin_cos(mapping.angle(r, *half));
                let across = p.normalize_or_zero() * sin;
                Some(Ray::new(Vec3::ZERO, Vec3::new(across.x, across.y, cos).normalize()))
            }
        }
    }
}

impl Mapping {
    /// The angle θ at the share `r` of the rim's radius, where the rim is seen at `half`.
    fn angle(self, r: f32, half: f32) -> f32 {
        let sine = |x: f32| float::sin_cos(x).0;
        let asin = |x: f32| FRAC_PI_2 - float::acos(x);
        match self {
            Self::Equidistant => r * half,
            Self::EquisolidAngle => 2.0 * asin(r * sine(0.5 * half)),
            Self::Stereographic => {
                let (sin, cos) = float::sin_cos(0.5 * half);
                2.0 * float::atan2(r * sin, cos)
            }
            Self::Orthographic => asin(r * sine(half)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    #[test]
    fn every_fisheye_sees_its_axis_in_the_middle_and_its_angle_at_the_rim() {
        for mapping in
            [Mapping::Equidistant, Mapping::EquisolidAngle, Mapping::Stereographic, Mapping::Orthographic]
        {
            let view = View::Fisheye { half: 1.5, mapping, rim: Vec2::new(0.5, 1.0) };
            let d = |x: f32, y: f32| view.ray(Vec2::new(x, y)).expect("within the rim").d;
            assert!((d(0.0, 0.0) - Vec3::Z).length() < 1e-6);
            let (sin, cos) = (1.5_f32.sin(), 1.5_f32.cos());
            assert!((d(0.5, 0.0) - Vec3::new(sin, 0.0, cos)).length() < 1e-3, "{mapping:?}");
            assert!((d(0.0, -1.0) - Vec3::new(0.0, -sin, cos)).length() < 1e-3, "{mapping:?}");
            assert!(view.ray(Vec2::new(0.6, 0.0)).is_none());
        }
    }

    #[test]
    fn an_equisolid_fisheye_gives_equal_areas_to_equal_solid_angles() {
        let half = 1.2_f32;
        for r in [0.1_f32, 0.5, 0.9] {
            let theta = Mapping::EquisolidAngle.angle(r, half);
            let share = (1.0 - theta.cos()) / (1.0 - half.cos());
            assert!((share - r * r).abs() < 1e-5);
        }
    }

    #[test]
    fn a_whole_panorama_looks_back_at_its_sides_and_up_at_its_top() {
        let view = View::Panorama { half: Vec2::new(PI, FRAC_PI_2) };
        let d = |x: f32, y: f32| view.ray(Vec2::new(x, y)).expect("everywhere").d;
        assert!((d(0.0, 0.0) - Vec3::Z).length() < 1e-6 && (d(0.5, 0.0) - Vec3::X).length() < 1e-6);
        assert!((d(1.0, 0.0) + Vec3::Z).length() < 1e-6 && (d(0.3, 1.0) - Vec3::Y).length() < 1e-6);
    }

    #[test]
    fn parallel_rays_are_parallel() {
        let view = View::Orthographic { half: Vec2::new(2.0, 1.0) };
        let ray = view.ray(Vec2::new(-1.0, 0.5)).expect("everywhere");
        assert_eq!((ray.o, ray.d), (Vec3::new(-2.0, 0.5, 0.0), Vec3::Z));
    }
}
