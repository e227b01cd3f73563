//! Lenses that are no pinhole, focused.

use super::{LowerError, camera};
use crate::asset::LensTable;
use crate::ir::camera::Mapping;
use crate::ir::{self, Lens};
use crate::load::Loaded;
use crate::math::{DVec2, DVec3, Vec2, Vec3};
use crate::render::camera::{
    Interface, LensSpec, Mapping as ViewMapping, Prescription, ThinLens, Tilt, View, image_distance, paraxial,
};
use crate::source::Spanned;
use std::sync::Arc;

/// A lens, and how far it is focused.
pub struct Focused {
    /// For the engine; `None` is a pinhole.
    pub spec: Option<LensSpec>,
    /// In metres along the view axis.
    pub distance: Option<f64>,
}

/// The lens of a camera that sees `tan_half_fov_x` to each side.
pub fn lens(
    camera: &ir::Camera,
    tan_half_fov_x: f64,
    aspect: f64,
    loaded: &Loaded<'_>,
) -> Result<Focused, LowerError> {
    let distance = match camera.lens.focus() {
        Some(focus) => Some(camera::focus_distance(focus, camera, loaded)?),
        None => None,
    };
    let view = |view| Focused { spec: Some(LensSpec::View(view)), distance: None };
    Ok(match &camera.lens {
        Lens::Pinhole { shift, .. } if *shift == DVec2::ZERO => Focused { spec: None, distance: None },
        Lens::Pinhole { shift, .. } => {
            let lens = ThinLens { shift: shift.as_vec2(), ..ThinLens::new(0.0, 1.0) };
            Focused { spec: Some(LensSpec::Thin(lens)), distance: None }
        }
        Lens::Thin { .. } => {
            let lens = distance.map(|distance| thin(camera, tan_half_fov_x, distance));
            Focused { spec: lens.filter(|lens| !lens.is_plain_pinhole()).map(LensSpec::Thin), distance }
        }
        Lens::Orthographic { size, is_width } => {
            let half = size.value / 2.0;
            let half =
                if *is_width { DVec2::new(half, half / aspect) } else { DVec2::new(half * aspect, half) };
            view(View::Orthographic { half: half.as_vec2() })
        }
        Lens::Panorama { width, height } => {
            view(View::Panorama { half: Vec2::new((width.value / 2.0) as f32, (height.value / 2.0) as f32) })
        }
        Lens::Fisheye { angle, mapping, full } => {
            let shape = DVec2::new(aspect, 1.0);
            let radius = if *full { shape.length() } else { shape.min_element() };
            let rim = (DVec2::splat(radius) / shape).as_vec2();
            let mapping = match mapping {
                Mapping::Equidistant => ViewMapping::Equidistant,
                Mapping::EquisolidAngle => ViewMapping::EquisolidAngle,
                Mapping::Stereographic => ViewMapping::Stereographic,
                Mapping::Orthographic => ViewMapping::Orthographic,
            };
            view(View::Fisheye { half: (angle.value / 2.0) as f32, mapping, rim })
        }
        Lens::Prescription { file, aperture, focus } => {
            let table = loaded.lens(file.span).expect("`load` reads the lens of every camera");
            let focused = focus.as_ref().map_or(file.span, |focus| focus.span);
            let far = distance.unwrap_or(f64::INFINITY);
            let sensor = camera.film.sensor.value;
            let real = prescription(
                table,
                *aperture,
                Spanned::new(far, focused),
                DVec2::new(sensor, sensor / aspect),
            )?;
            Focused { spec: Some(LensSpec::Real(Arc::new(real))), distance }
        }
    })
}

fn thin(camera: &ir::Camera, tan_half_fov_x: f64, distance: f64) -> ThinLens {
    let Lens::Thin { focal_length, radius, blades, rotation, anamorphic, cat_eye, shift, tilt, .. } =
        &camera.lens
    else {
        unreachable!("called for thin lenses")
    };
    let [up, right] = tilt.map(|turn| libm::sincos(turn.value));
    let normal = DVec3::new(right.0 * up.1, up.0, right.1 * up.1);
    let tilt = (normal != DVec3::Z).then(|| {
        // Without a focal length it follows from the film's size, at which the point in focus is sharp.
        let film = camera.film.sensor.value / (2.0 * tan_half_fov_x);
        let focal_length = focal_length.map_or(1.0 / (1.0 / distance + 1.0 / film), |length| length.value);
        Tilt { normal: normal.as_vec3().normalize_or(Vec3::Z), focal_length: focal_length as f32 }
    });
    ThinLens {
        radius: radius.value as f32,
        focus_distance: distance as f32,
        blades: blades.value,
        rotation: rotation.value as f32,
        anamorphic: anamorphic.value as f32,
        cat_eye: cat_eye.value as f32,
        shift: shift.as_vec2(),
        tilt,
    }
}

/// A real lens, focused at a distance from its entrance pupil and stopped down.
fn prescription(
    table: &LensTable,
    aperture: Option<Spanned<f64>>,
    distance: Spanned<f64>,
    film: DVec2,
) -> Result<Prescription, LowerError> {
    let interface = |s: &crate::asset::LensSurface| Interface {
        radius: s.radius,
        thickness: s.thickness,
        ior: s.ior,
        aperture: s.aperture,
    };
    let mut surfaces: Vec<Interface> = table.surfaces.iter().map(interface).collect();
    let optics = paraxial(&surfaces, table.stop);
    if let Some(aperture) = aperture {
        let wanted = optics.focal_length.abs() / (2.0 * aperture.value) / optics.pupil_scale.abs();
        let widest = surfaces[table.stop].aperture;
        if wanted > widest * (1.0 + 1e-9) {
            let opens = optics.focal_length.abs() / (2.0 * widest * optics.pupil_scale.abs());
            let widest = format!("f/{}", (opens * 100.0).ceil() / 100.0);
            return Err(LowerError::TooWide { widest, aperture: aperture.span });
        }
        surfaces[table.stop].aperture = wanted.min(widest);
    }
    // Farther than a million focal lengths is as good as infinitely far.
    let before_front = (distance.value - optics.entrance_pupil).min(1e6 * optics.focal_length.abs());
    let back = image_distance(&surfaces, before_front);
    if !(before_front > 0.0 && back > 0.0 && back.is_finite()) {
        let reason = format!(
            "this lens of {}mm makes no picture of what is so near",
            (optics.focal_length * 1e5).round() / 100.0
        );
        return Err(LowerError::BadFocus { reason, focus: distance.span });
    }
    if let Some(rear) = surfaces.last_mut() {
        rear.thickness = back;
    }
    let length: f64 = surfaces.iter().map(|surface| surface.thickness).sum();
    let lens = Prescription::new(surfaces, length - optics.entrance_pupil, film / 2.0);
    if lens.is_blind() {
        let reason = "no light gets through so small an opening".to_owned();
        return Err(LowerError::BadFocus { reason, focus: aperture.map_or(distance.span, |n| n.span) });
    }
    Ok(lens)
}
