//! The camera: from a pixel to a ray.

mod aperture;
mod filter;
mod prescription;
mod wide;

pub use aperture::{ThinLens, Tilt};
pub use filter::{Filter, FilterSample};
pub use prescription::{Interface, Paraxial, Prescription, image_distance, paraxial};
pub use wide::{Mapping, View};

use crate::math::{Motion, Ray, Vec2, Vec3};
use std::sync::Arc;

/// What a camera is built from.
#[derive(Clone, PartialEq, Debug)]
pub struct CameraSpec {
    /// The centre of the lens, in metres.
    pub position: Vec3,
    /// Where it looks; not zero.
    pub direction: Vec3,
    /// What appears upright; not along `direction`.
    pub up: Vec3,
    /// The tangent of half the horizontal field of view.
    pub tan_half_fov_x: f32,
    /// The tangent of half the vertical field of view.
    pub tan_half_fov_y: f32,
    /// What light comes through; `None` is a pinhole.
    pub lens: Option<LensSpec>,
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// How samples spread about pixel centres.
    pub filter: Filter,
    /// Where it is while the shutter is open, from where it is when that opens: a rotation and a shift. `None`: it stands still.
    pub motion: Option<Arc<Motion>>,
}

/// How light gets in, where that is not through a point.
#[derive(Clone, PartialEq, Debug)]
pub enum LensSpec {
    /// Through a thin lens; or through a point, with the picture shifted.
    Thin(ThinLens),
    /// Not in perspective.
    View(View),
    /// Through a real lens.
    Real(Arc<Prescription>),
}

/// A ray that a pixel sends out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CameraRay {
    /// Its direction is a unit vector.
    pub ray: Ray,
    /// What arrives along it counts this much; negative at the rim of some filters.
    pub weight: f32,
}

/// A camera in its place.
#[derive(Clone, PartialEq, Debug)]
pub struct Camera {
    position: Vec3,
    forward: Vec3,
    /// Unit vectors of the picture: to the right, and upwards.
    right: Vec3,
    up: Vec3,
    /// World offsets on the plane at distance 1: half the picture's width to the right, and half its height up.
    half_width: Vec3,
    half_height: Vec3,
    lens: Option<LensSpec>,
    width: u32,
    height: u32,
    filter: Filter,
    motion: Option<Arc<Motion>>,
}

impl Camera {
    /// A camera from its specification.
    pub fn new(spec: CameraSpec) -> Self {
        let forward = spec.direction.as_dvec3().normalize();
        let right = forward.cross(spec.up.as_dvec3()).normalize();
        let up = right.cross(forward);
        Self {
            position: spec.position,
            forward: forward.as_vec3(),
            right: right.as_vec3(),
            up: up.as_vec3(),
            half_width: (right * f64::from(spec.tan_half_fov_x)).as_vec3(),
            half_height: (up * f64::from(spec.tan_half_fov_y)).as_vec3(),
            lens: spec.lens,
            width: spec.width,
            height: spec.height,
            filter: spec.filter,
            motion: spec.motion,
        }
    }

    /// Columns of the picture.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of the picture.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Where rays start, or about where, in metres.
    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// The angle across a pixel in the middle of the picture, in radians: what it covers grows by that for each metre.
    pub fn pixel_angle(&self) -> f32 {
        self.half_width.length() * 2.0 / self.width as f32
    }

    /// The cone that a pixel's ray stands for: its width where it leaves, in metres, and by how much that grows for each.
    pub fn cone(&self) -> (f32, f32) {
        let width = self.width as f32;
        match &self.lens {
            Some(LensSpec::View(View::Orthographic { half })) => (2.0 * half.x / width, 0.0),
            Some(LensSpec::View(View::Panorama { half })) => (0.0, 2.0 * half.x / width),
            Some(LensSpec::View(View::Fisheye { half, rim, .. })) => (0.0, 2.0 * half / (rim.x * width)),
            None | Some(LensSpec::Thin(_) | LensSpec::Real(_)) => (0.0, self.pixel_angle()),
        }
    }

    /// The ray of a pixel, counted from the top left; `None` where the lens lets nothing through to the film.
    pub fn ray(&self, [x, y]: [u32; 2], u_filter: Vec2, u_lens: Vec2) -> Option<CameraRay> {
        let FilterSample { offset, weight } = self.filter.sample(u_filter);
        let across = (x as f32 + 0.5 + offset.x) * 2.0 / self.width as f32 - 1.0;
        let upwards = 1.0 - (y as f32 + 0.5 + offset.y) * 2.0 / self.height as f32;
        let film = Vec2::new(across, upwards);
        match &self.lens {
            None => {
                let dir = self.forward + self.half_width * across + self.half_height * upwards;
                Some(CameraRay { ray: Ray::new(self.position, dir.normalize()), weight })
            }
            Some(LensSpec::Thin(lens)) => {
                let half = Vec2::new(self.half_width.length(), self.half_height.length());
                let shifted = (film + lens.shift * 2.0) * half;
                let corner = film * half / half.length();
                let ray = lens.ray(shifted.extend(1.0), corner, u_lens)?;
                Some(CameraRay { ray: self.to_world(&ray), weight })
            }
            Some(LensSpec::View(view)) => Some(CameraRay { ray: self.to_world(&view.ray(film)?), weight }),
            Some(LensSpec::Real(lens)) => {
                let (ray, share) = lens.ray(film, u_lens)?;
                Some(CameraRay { ray: self.to_world(&ray), weight: weight * share })
            }
        }
    }

    /// A ray of [`Self::ray`] as it leaves at a time in [0, 1), from where the camera is then.
    pub fn at(&self, camera: CameraRay, time: f32) -> CameraRay {
        let Some(motion) = &self.motion else { return CameraRay { ray: camera.ray.at_time(time), ..camera } };
        let moved = motion.at(time.into());
        let o = moved.transform_point3(camera.ray.o.as_dvec3()).as_vec3();
        let d = moved.transform_vector3(camera.ray.d.as_dvec3()).normalize().as_vec3();
        CameraRay { ray: Ray { o, d, time, ..camera.ray }, ..camera }
    }

    /// A ray of the camera's frame (right, up, forward) in the world.
    fn to_world(&self, ray: &Ray) -> Ray {
        let turned = |v: Vec3| self.right * v.x + self.up * v.y + self.forward * v.z;
        Ray::new(self.position + turned(ray.o), turned(ray.d).normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(lens: Option<LensSpec>) -> CameraSpec {
        CameraSpec {
            position: Vec3::new(0.0, 1.0, 4.0),
            direction: Vec3::NEG_Z,
            up: Vec3::Y,
            tan_half_fov_x: 1.0,
            tan_half_fov_y: 0.5,
            lens,
            width: 4,
            height: 2,
            filter: Filter::Box { radius: 0.5 },
            motion: None,
        }
    }

    const CENTER: Vec2 = Vec2::splat(0.5);

    #[test]
    fn the_first_pixel_is_at_the_top_left() {
        let ray = Camera::new(spec(None)).ray([0, 0], CENTER, CENTER).expect("open").ray;
        let expected = Vec3::new(-0.75, 0.25, -1.0).normalize();
        assert!((ray.d - expected).length() < 1e-6, "{}", ray.d);
    }

    #[test]
    fn an_opening_of_radius_0_is_a_pinhole() {
        let u = Vec2::new(0.3, 0.8);
        let closed = Camera::new(spec(Some(LensSpec::Thin(ThinLens::new(0.0, 3.0)))));
        let (a, b) = (
            closed.ray([1, 1], u, u).expect("open"),
            Camera::new(spec(None)).ray([1, 1], u, u).expect("open"),
        );
        assert!(a.ray.o == b.ray.o && (a.ray.d - b.ray.d).length() < 1e-6);
    }

    #[test]
    fn all_rays_of_a_film_point_meet_in_the_plane_of_focus() {
        let lens = ThinLens { blades: 6, rotation: 0.4, ..ThinLens::new(0.2, 3.0) };
        let camera = Camera::new(spec(Some(LensSpec::Thin(lens))));
        let at_focus = |u_lens| {
            let ray = camera.ray([3, 0], CENTER, u_lens).expect("no barrel").ray;
            ray.at((ray.o.z - 1.0) / -ray.d.z)
        };
        let first = at_focus(Vec2::new(0.1, 0.9));
        for i in 0..20 {
            let u = Vec2::new(i as f32 / 20.0, (i as f32 * 0.618).fract());
            assert!((at_focus(u) - first).length() < 1e-5);
        }
    }

    #[test]
    fn a_shifted_picture_shows_what_lies_beside() {
        // By its whole width: the pixel at the left is where the one beyond the right edge would be.
        let lens = ThinLens { shift: Vec2::new(1.0, 0.0), ..ThinLens::new(0.0, 3.0) };
        let d =
            Camera::new(spec(Some(LensSpec::Thin(lens)))).ray([0, 0], CENTER, CENTER).expect("open").ray.d;
        assert!((d - Vec3::new(1.25, 0.25, -1.0).normalize()).length() < 1e-6, "{d}");
    }
}
