//! Cameras: that something is before them, and larger than a pixel.

use super::region::{Extent, Region};
use super::{CheckError, Reach, Survey};
use crate::ir::camera::Fov;
use crate::ir::{Camera, Lens};
use crate::math::DVec3;
use std::f64::consts::FRAC_PI_4;

/// How much wider the view is taken than it is, for what pixel filters add at the edges.
const WIDER: f64 = 1.05;

impl Survey<'_> {
    /// Cameras that see nothing of the scene, or only a dot.
    pub(super) fn views(&self) -> Vec<CheckError> {
        self.scene.cameras.iter().filter_map(|camera| self.view(camera)).collect()
    }

    fn view(&self, camera: &Camera) -> Option<CheckError> {
        let view = View::of(camera)?;
        // Endless planes, and light all around, are nearly everywhere in view.
        let bounded: Option<Vec<&Region>> = self.things.iter().map(|thing| thing.region.as_ref()).collect();
        let lamps = self.lamps.iter().filter_map(|lamp| match &lamp.reach {
            Reach::Here(region) => Some(region),
            Reach::Far(_) | Reach::Around => None,
        });
        let all: Vec<&Region> = bounded?.into_iter().chain(lamps).collect();
        if self.things.is_empty() {
            return None;
        }
        if all.iter().all(|region| view.misses(region)) {
            return Some(CheckError::NothingInView {
                view: camera.direction.span,
                position: camera.position.span,
            });
        }
        let extent = all.iter().map(|region| region.extent()).reduce(Extent::union)?;
        view.is_dot(&extent).then_some(CheckError::TooSmallToSee { position: camera.position.span })
    }
}

/// What a camera sees: a pyramid, or with a wide lens all that is before it.
struct View {
    eye: DVec3,
    forward: DVec3,
    /// Normals that point out of the pyramid, through the eye.
    sides: Vec<DVec3>,
    /// The angle that a pixel in the middle takes, about.
    pixel: f64,
}

impl View {
    fn of(camera: &Camera) -> Option<Self> {
        let eye = camera.position.value;
        let forward = camera.direction.value.try_normalize()?;
        let right = forward.cross(camera.up.value).try_normalize()?;
        let up = right.cross(forward);
        let (width, height) = camera.film.size.value;
        let aspect = f64::from(width) / f64::from(height);
        let tan_x = tan_half_fov_x(camera, aspect);
        let (x, y) = (WIDER * tan_x, WIDER * tan_x / aspect);
        let sides = match is_point(camera) {
            true => vec![right - forward * x, -right - forward * x, up - forward * y, -up - forward * y],
            false => Vec::new(),
        };
        Some(Self { eye, forward, sides, pixel: 2.0 * tan_x / f64::from(width) })
    }

    /// Whether nothing of a region is in view.
    fn misses(&self, region: &Region) -> bool {
        let is_beyond = |normal: DVec3| region.support(-normal) < -normal.dot(self.eye);
        is_beyond(-self.forward) || self.sides.iter().any(|&side| is_beyond(side))
    }

    /// Whether a box as a whole is smaller than a pixel.
    fn is_dot(&self, extent: &Extent) -> bool {
        let (center, size) = ((extent.min + extent.max) / 2.0, (extent.max - extent.min).length());
        size < self.pixel * (center - self.eye).dot(self.forward)
    }
}

/// Whether light enters through a point: with an opening, what is beside the picture may still blur into it.
fn is_point(camera: &Camera) -> bool {
    match &camera.lens {
        Lens::Pinhole { .. } => true,
        Lens::Thin { radius, .. } => radius.value == 0.0,
    }
}

/// Half of the picture's width at the distance 1.
fn tan_half_fov_x(camera: &Camera, aspect: f64) -> f64 {
    let focal_length = match &camera.lens {
        Lens::Pinhole { focal_length } | Lens::Thin { focal_length, .. } => focal_length,
    };
    match (camera.fov.map(|fov| fov.value), focal_length) {
        (Some(Fov::Vertical(angle)), _) => libm::tan(angle / 2.0) * aspect,
        (Some(Fov::Horizontal(angle)), _) => libm::tan(angle / 2.0),
        (None, Some(focal_length)) => camera.film.sensor.value / (2.0 * focal_length.value),
        (None, None) => libm::tan(FRAC_PI_4 / 2.0) * aspect,
    }
}
