//! The camera, with its lens focused.

use super::lens::{self, Focused};
use super::{LowerError, object_bounds};
use crate::ir::camera::Fov;
use crate::ir::{self, Focus, PixelPoint};
use crate::load::Loaded;
use crate::math::{DAffine3, DVec3, Motion};
use crate::render::camera::{CameraSpec, Filter};
use crate::source::{Span, Spanned};
use std::sync::Arc;

/// A camera ready to be built.
pub struct Seen {
    /// For the engine.
    pub spec: CameraSpec,
    /// The size of a pixel at the distance of what the camera looks at, in metres.
    pub pixel_footprint: f64,
}

/// The field of view of a camera that says nothing about it: 45° upwards.
const DEFAULT_FOV: f64 = std::f64::consts::FRAC_PI_4;

/// Places the camera relative to the scene's `center` and focuses it. `pixel` may overrule the film's filter.
pub fn camera(
    camera: &ir::Camera,
    pixel: PixelPoint,
    loaded: &Loaded<'_>,
    center: DVec3,
) -> Result<Seen, LowerError> {
    let forward = camera.direction.value.normalize();
    let (width, height) = camera.film.size.value;
    let aspect = camera.film.aspect();
    let tan_half_fov_x = tan_half_fov_x(camera, aspect);
    let Focused { spec: lens, distance } = lens::lens(camera, tan_half_fov_x, aspect, loaded)?;
    let spec = CameraSpec {
        position: (camera.position.value - center).as_vec3(),
        direction: forward.as_vec3(),
        up: camera.up.value.as_vec3(),
        tan_half_fov_x: tan_half_fov_x as f32,
        tan_half_fov_y: (tan_half_fov_x / aspect) as f32,
        lens,
        width,
        height,
        filter: match pixel {
            PixelPoint::Filter => filter(camera.film.filter.value),
            PixelPoint::Center => Filter::Box { radius: 0.0 },
            PixelPoint::Corner => Filter::Corner,
        },
        motion: motion(camera, center).map(Arc::new),
    };
    let distance = distance.unwrap_or_else(|| (center - camera.position.value).length());
    Ok(Seen { spec, pixel_footprint: 2.0 * tan_half_fov_x * distance / f64::from(width) })
}

/// Where the camera is while its shutter is open, from where it is when that opens; both about the scene's `center`.
fn motion(camera: &ir::Camera, center: DVec3) -> Option<Motion> {
    let to_scene = DAffine3::from_translation(center);
    camera.seen_motion()?.part(to_scene, 1.0, to_scene.inverse())
}

fn tan_half_fov_x(camera: &ir::Camera, aspect: f64) -> f64 {
    match (camera.fov, camera.lens.focal_length()) {
        (Some(fov), _) => match fov.value {
            Fov::Vertical(angle) => libm::tan(angle / 2.0) * aspect,
            Fov::Horizontal(angle) => libm::tan(angle / 2.0),
        },
        (None, Some(focal_length)) => camera.film.sensor.value / (2.0 * focal_length.value),
        (None, None) => libm::tan(DEFAULT_FOV / 2.0) * aspect,
    }
}

/// The distance of the plane in focus, along the view axis, in metres.
pub(super) fn focus_distance(
    focus: &Spanned<Focus>,
    camera: &ir::Camera,
    loaded: &Loaded<'_>,
) -> Result<f64, LowerError> {
    let forward = camera.direction.value.normalize();
    let along = |p: DVec3| (p - camera.position.value).dot(forward);
    let distance = match &focus.value {
        Focus::Distance(distance) => *distance,
        Focus::Point(p) => along(*p),
        Focus::On(id, name) => along(middle(*id, name, focus.span, loaded)?),
    };
    if distance > 0.0 {
        return Ok(distance);
    }
    Err(LowerError::BadFocus { reason: "that is behind the camera".to_owned(), focus: focus.span })
}

/// The middle of the named objects' box.
fn middle(id: u32, name: &str, focus: Span, loaded: &Loaded<'_>) -> Result<DVec3, LowerError> {
    let named = loaded.scene.objects.iter().filter(|object| object.names.contains(&id));
    let boxes = named.filter_map(|object| object_bounds(object, loaded));
    boxes
        .reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))
        .map(|(min, max)| (min + max) / 2.0)
        .ok_or_else(|| LowerError::BadFocus { reason: format!("`{name}` has no middle"), focus })
}

fn filter(filter: ir::Filter) -> Filter {
    match filter {
        ir::Filter::Box(radius) => Filter::Box { radius: radius as f32 },
        ir::Filter::Tent(radius) => Filter::Tent { radius: radius as f32 },
        ir::Filter::Gaussian(radius) => Filter::Gaussian { radius: radius as f32 },
        ir::Filter::Mitchell(radius) => Filter::Mitchell { radius: radius as f32 },
        ir::Filter::BlackmanHarris(radius) => Filter::BlackmanHarris { radius: radius as f32 },
    }
}
