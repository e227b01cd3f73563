//! Cameras: that something is before them, and larger than a pixel.

use super::super::error::CheckError;
use super::region::{Extent, Region};
use super::stuff::Stuff;
use super::{Reach, SpaceError, Survey, Thing};
use crate::ir::camera::Fov;
use crate::ir::{Camera, Focus, Lens};
use crate::math::{DVec2, DVec3};
use crate::source::Spanned;
use std::f64::consts::FRAC_PI_4;

/// How much wider the view is taken than it is, for what pixel filters add at the edges.
const WIDER: f64 = 1.05;

impl Survey<'_> {
    /// Cameras that see nothing of the scene, or only a dot.
    pub(super) fn views(&self) -> Vec<SpaceError> {
        let of_camera = |camera: &Camera| self.focus_behind(camera).or_else(|| self.view(camera));
        self.scene.cameras.iter().filter_map(of_camera).collect()
    }

    /// A lens focused on something that is all behind the camera.
    fn focus_behind(&self, camera: &Camera) -> Option<SpaceError> {
        let Some(Spanned { value: Focus::On(id, _), span }) = camera.lens.focus() else { return None };
        let (eye, forward) = (camera.position.value, camera.direction.value);
        let mut named = self.things.iter().filter(|thing| thing.object.names.contains(id)).peekable();
        named.peek()?;
        let is_behind =
            |thing: &Thing| thing.region.as_ref().is_some_and(|r| r.support(forward) <= forward.dot(eye));
        let position = camera.position.span;
        named.all(is_behind).then(|| CheckError::FocusBehind { focus: *span, position }.into())
    }

    /// Paths that end before they have been through glass, or off a mirror, and on to a light.
    pub(super) fn short_paths(&self) -> Vec<SpaceError> {
        let needed = |thing: &Thing| match thing.stuff {
            Stuff { clear: Some(_), .. } => {
                (4, "end inside of glass: in, out, on to a surface, to a light are 4")
            }
            Stuff { is_specular: true, .. } => {
                (3, "end on the way from a mirror: it, a surface, a light are 3")
            }
            Stuff { is_rough: true, .. } => (2, "see nothing but lights: a surface and a light are 2"),
            _ => (0, ""),
        };
        let longest =
            self.things.iter().map(|thing| (needed(thing), thing.object.span)).max_by_key(|(n, _)| n.0);
        match (self.scene.render.depth, longest) {
            (Some(depth), Some(((wanted, end), object))) if depth.value < wanted => {
                vec![SpaceError::ShortPaths { depth: depth.value, wanted, end, used: depth.span, object }]
            }
            _ => Vec::new(),
        }
    }

    fn view(&self, camera: &Camera) -> Option<SpaceError> {
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
            return Some(SpaceError::NothingInView {
                view: camera.direction.span,
                position: camera.position.span,
            });
        }
        let extent = all.iter().map(|region| region.extent()).reduce(Extent::union)?;
        view.is_dot(&extent).then_some(SpaceError::TooSmallToSee { position: camera.position.span })
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
        // What is no perspective has no pyramid, or no eye; what moves has many.
        if !camera.lens.has_fov() || camera.seen_motion().is_some() {
            return None;
        }
        let eye = camera.position.value;
        let forward = camera.direction.value.try_normalize()?;
        let right = forward.cross(camera.up.value).try_normalize()?;
        let up = right.cross(forward);
        let (width, aspect) = (camera.film.size.value.0, camera.film.aspect());
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
        Lens::Pinhole { shift, .. } => *shift == DVec2::ZERO,
        Lens::Thin { radius, shift, .. } => radius.value == 0.0 && *shift == DVec2::ZERO,
        _ => false,
    }
}

/// Half of the picture's width at the distance 1.
fn tan_half_fov_x(camera: &Camera, aspect: f64) -> f64 {
    let focal_length = camera.lens.focal_length();
    match (camera.fov.map(|fov| fov.value), focal_length) {
        (Some(Fov::Vertical(angle)), _) => libm::tan(angle / 2.0) * aspect,
        (Some(Fov::Horizontal(angle)), _) => libm::tan(angle / 2.0),
        (None, Some(focal_length)) => camera.film.sensor.value / (2.0 * focal_length.value),
        (None, None) => libm::tan(FRAC_PI_4 / 2.0) * aspect,
    }
}
