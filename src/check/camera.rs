//! Cameras: that they look somewhere, and what they focus on.

use super::error::CheckError;
use super::{Check, Checked};
use crate::diag::{Problems, did_you_mean};
use crate::ir::camera::{Fov, Mapping};
use crate::ir::{Camera, Film, Focus, Lens};
use crate::math::DVec3;
use crate::schema::{Type, quoted};
use crate::source::{Span, Spanned};
use miette::LabeledSpan;

/// The longest side of a film, in pixels.
const LONGEST_SIDE: u32 = 65_536;
/// The widest pixel filter, in pixels.
pub const WIDEST_FILTER: f64 = 16.0;

/// The camera that the scene is seen through: the one asked for, or the first. `file` is where to say that there is none.
pub fn camera<'a>(
    scene: &'a Checked,
    wanted: Option<&str>,
    file: Span,
    problems: &mut Problems,
) -> Option<&'a Camera> {
    let start = Span::new(file.start, file.start);
    let Some(first) = scene.cameras.first() else {
        // A camera that could not be read was reported.
        if !problems.has_errors() {
            problems.push(CheckError::NoCamera { file: start });
        }
        return None;
    };
    let Some(wanted) = wanted else { return Some(first) };
    let name = |camera: &'a Camera| camera.name.as_ref().map(|name| name.value.as_str());
    let found = scene.cameras.iter().find(|camera| name(camera) == Some(wanted));
    if found.is_none() {
        let names: Vec<&str> = scene.cameras.iter().filter_map(name).collect();
        let help = did_you_mean(wanted, names.iter().copied()).unwrap_or_else(|| match names.as_slice() {
            [] => "its camera has no name; leave `--camera` away".to_owned(),
            _ => format!("its cameras are {}", quoted(&names)),
        });
        problems.push(CheckError::UnknownCamera { name: wanted.to_owned(), file: start, help });
    }
    found
}

impl Check<'_> {
    /// Checks every camera.
    pub(super) fn cameras(&mut self) {
        for camera in &self.scene.cameras {
            self.camera(camera);
        }
    }

    fn camera(&mut self, camera: &Camera) {
        self.near("the position of this camera", camera.position);
        self.view(camera);
        self.field_of_view(camera);
        self.film(&camera.film);
        match &camera.lens {
            Lens::Pinhole { focal_length, .. } => self.focal_length(*focal_length),
            Lens::Thin { focal_length, radius, focus, blades, anamorphic, cat_eye, tilt, .. } => {
                self.positive("`anamorphic`", *anamorphic, Type::Number);
                if !(0.0..=2.0).contains(&cat_eye.value) {
                    let (found, range) = (cat_eye.value.to_string(), "from 0 to 2".to_owned());
                    let (what, example, used) = ("`cat_eye`", "cat_eye: 0.5".to_owned(), cat_eye.span);
                    self.report(CheckError::OutOfRange { what, found, range, example, used });
                }
                for turn in tilt {
                    self.turn(*turn);
                }
                self.focal_length(*focal_length);
                if radius.value < 0.0 || !radius.value.is_finite() {
                    let example = "f/2.8";
                    let found = match radius.value.is_finite() {
                        true => Type::Length.write(radius.value),
                        false => "f/0".to_owned(),
                    };
                    let what = "the aperture";
                    self.report(CheckError::NotPositive { what, found, used: radius.span, example });
                }
                if matches!(blades.value, 1 | 2) {
                    let (found, range) =
                        (blades.value.to_string(), "0 for a round iris, or at least 3".to_owned());
                    let (what, example, used) = ("`blades`", "blades: 7".to_owned(), blades.span);
                    self.report(CheckError::OutOfRange { what, found, range, example, used });
                }
                if let Some(focus) = focus {
                    self.focus(camera, focus, *focal_length);
                }
            }
            Lens::Orthographic { size, .. } => self.positive("what this lens sees", *size, Type::Length),
            Lens::Panorama { width, height } => {
                use std::f64::consts::{PI, TAU};
                self.within("the width of this panorama", *width, Type::Angle, 0.0, TAU, "360deg");
                self.within("the height of this panorama", *height, Type::Angle, 0.0, PI, "180deg");
            }
            Lens::Fisheye { angle, mapping, .. } => self.fisheye(*angle, *mapping),
            Lens::Prescription { aperture, focus, .. } => {
                if let Some(aperture) = aperture.filter(|n| n.value <= 0.0) {
                    let (found, example) = (Type::FNumber.write(aperture.value), "f/4");
                    let (what, used) = ("the aperture", aperture.span);
                    self.report(CheckError::NotPositive { what, found, used, example });
                }
                if let Some(focus) = focus {
                    self.focus(camera, focus, None);
                }
            }
        }
    }

    /// A lens turned by half a right angle or more.
    fn turn(&mut self, turn: Spanned<f64>) {
        if turn.value.abs() >= std::f64::consts::FRAC_PI_4 {
            let (found, range) = (Type::Angle.write(turn.value), "between -45deg and 45deg".to_owned());
            let (what, example, used) = ("the turn of the lens", "5deg".to_owned(), turn.span);
            self.report(CheckError::OutOfRange { what, found, range, example, used });
        }
    }

    fn fisheye(&mut self, angle: Spanned<f64>, mapping: Mapping) {
        use std::f64::consts::{PI, TAU};
        let (most, so) = match mapping {
            Mapping::Orthographic => (PI, "this lens sees no more than half of the sphere"),
            Mapping::Stereographic => (TAU * 0.99, "seen behind, things become endlessly large"),
            Mapping::Equidistant | Mapping::EquisolidAngle => (TAU, "there is no more to see"),
        };
        if !(0.0 < angle.value && angle.value <= most) {
            let found = Type::Angle.write(angle.value);
            let range = format!("greater than 0deg and at most {}: {so}", Type::Angle.write(most));
            let (what, example, used) = ("the angle of this lens", "180deg".to_owned(), angle.span);
            self.report(CheckError::OutOfRange { what, found, range, example, used });
        }
    }

    fn view(&mut self, camera: &Camera) {
        /// A sine below this leaves no digits for the right-hand side of the picture.
        const PARALLEL: f64 = 1e-9;
        let (direction, up) = (camera.direction, camera.up);
        if direction.value == DVec3::ZERO {
            let (target, position) = (direction.span, camera.position.span);
            self.report(CheckError::CameraLooksNowhere { target, position });
        } else if direction.cross(up.value).length() <= PARALLEL * direction.length() * up.length() {
            // A default stands at the head of the camera's block.
            let said = match up.span.start == camera.span.start {
                true => "`up` is (0, 1, 0) where it is not given",
                false => "this is up",
            };
            self.report(CheckError::UpAlongView { view: direction.span, said, up: up.span });
        }
    }

    fn field_of_view(&mut self, camera: &Camera) {
        let Some(Spanned { value: Fov::Vertical(angle) | Fov::Horizontal(angle), span }) = camera.fov else {
            return;
        };
        if !(0.0 < angle && angle < std::f64::consts::PI) {
            let (found, range) =
                (Type::Angle.write(angle), "greater than 0deg and less than 180deg".to_owned());
            let (what, example) = ("the field of view", "45deg".to_owned());
            self.report(CheckError::OutOfRange { what, found, range, example, used: span });
        }
    }

    fn focal_length(&mut self, focal_length: Option<Spanned<f64>>) {
        if let Some(length) = focal_length {
            self.positive("the focal length", length, Type::Length);
        }
    }

    fn film(&mut self, film: &Film) {
        let (width, height) = film.size.value;
        if !(1..=LONGEST_SIDE).contains(&width) || !(1..=LONGEST_SIDE).contains(&height) {
            self.report(CheckError::FilmSize { width, height, used: film.size.span });
        }
        self.positive("the width of the sensor", film.sensor, Type::Length);
        self.positive("the width of a pixel by its height", film.pixel_aspect, Type::Number);
        if let Some(Spanned { value: [left, top, right, bottom], span }) = film.crop
            && film.crop_in_pixels().is_none_or(|[_, _, width, height]| width == 0 || height == 0)
        {
            let (what, example) = ("the crop", "crop: { left: 0.25, right: 0.75 }".to_owned());
            let found = format!("from ({left}, {top}) to ({right}, {bottom})");
            let range = "wider and higher than a pixel, with `left` before `right` and `top` above `bottom`"
                .to_owned();
            self.report(CheckError::OutOfRange { what, found, range, example, used: span });
        }
        let radius = film.filter.value.radius();
        if !(0.0 < radius && radius <= WIDEST_FILTER) {
            let (found, range) = (Type::Pixels.write(radius), "greater than 0px and at most 16px".to_owned());
            let (what, example, used) =
                ("the radius of the filter", "tent(1px)".to_owned(), film.filter.span);
            self.report(CheckError::OutOfRange { what, found, range, example, used });
        }
    }

    fn focus(&mut self, camera: &Camera, focus: &Spanned<Focus>, focal_length: Option<Spanned<f64>>) {
        let distance = match &focus.value {
            Focus::Distance(distance) => *distance,
            Focus::Point(point) => (*point - camera.position.value).dot(camera.direction.normalize_or_zero()),
            Focus::On(id, name) => return self.focus_on(*id, name, focus.span),
        };
        // A camera that looks nowhere has nothing behind it, and has its own report.
        if distance <= 0.0 && camera.direction.value != DVec3::ZERO {
            self.report(CheckError::FocusBehind { focus: focus.span, position: camera.position.span });
        } else if let Some(length) = focal_length.filter(|length| 0.0 < distance && distance <= length.value)
        {
            // 1/f = 1/distance + 1/image: at f and nearer there is no image.
            let rounded = (distance * 1e6).round() / 1e6;
            let (focal, found) = (Type::Length.write(length.value), Type::Length.write(rounded));
            let (focus, focal_length) = (focus.span, length.span);
            self.report(CheckError::FocusTooNear { focal, found, focus, focal_length });
        }
    }

    /// What a lens is focused on has to be in one place.
    fn focus_on(&mut self, id: u32, name: &str, used: Span) {
        let named = &self.scene.names[id as usize];
        if named.count == 1 || (named.count == 0 && !self.whole) {
            return;
        }
        let mut labels = vec![LabeledSpan::new_with_span(Some("focused on here".to_owned()), used)];
        let placed = |span: &Span| LabeledSpan::new_with_span(Some("placed here".to_owned()), *span);
        labels.extend(named.placed.iter().map(placed));
        let (message, help) = match named.count {
            0 => (
                format!("the lens is focused on `{name}`, which is not in the picture"),
                format!("put it there: `place {name}`"),
            ),
            count => (
                format!("the lens is focused on `{name}`, which is in {count} places"),
                format!("name one of them: `place {name} as hero`, and focus `on hero`"),
            ),
        };
        self.report(CheckError::FocusNotOnce { message, labels, help });
    }
}
