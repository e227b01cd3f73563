//! Cameras.

use super::lens_rules::KEYS;
use super::{Basis, Dialect, Mistake, Reader};
use crate::convert::Angle;
use crate::convert::fields::{Field, Fields};
use crate::convert::model::Camera;
use crate::convert::parse::{Block, Span};
use crate::convert::words::CAMERA;
use crate::math::DVec3;
use crate::math::float::tan64;

/// How far the length of `direction x up` may be from 1 before it counts as leaning: what single precision leaves of 1.
const LEAN_TOLERANCE: f64 = 1e-6;

/// How far a pixel may be from square before that counts: angles are written with few digits.
const SQUARE_TOLERANCE: f64 = 1e-3;

/// How many times its own size an orthographic camera is moved back: far enough to have most scenes in front, near
/// enough to keep the digits of single precision.
const STEP_BACK: f64 = 100.0;

impl Reader<'_> {
    pub(super) fn camera(&mut self, block: Block<'_>) -> Option<Camera> {
        let (name, head) = (block.name().to_string(), block.head.clone());
        let mut fields = self.log.fields(block, &CAMERA);
        self.log.mapped(&head, "`camera`");
        let camera = self.camera_of(&name, &mut fields);
        let aside = "a setting of the original's renderer, not of the scene";
        self.log.put_aside(&mut fields, &["setting"], aside);
        self.log.put_aside(
            &mut fields,
            &["time"],
            "times of a shutter, which is not in the scene language yet",
        );
        match camera {
            Some(_) => self.log.finish(fields),
            None => self.log.finish_lost(fields, "lost with its camera"),
        }
        camera
    }

    fn camera_of(&mut self, name: &str, fields: &mut Fields<'_>) -> Option<Camera> {
        let center = self.log.need_vector(fields, "center", "`position`");
        let direction = self.direction(fields, center);
        let up = self.axis(fields, "up");
        let is_orthographic = name.contains("Orthographic") || (fields.has("size") && !fields.has("angle"));
        let side =
            if is_orthographic { self.positive(fields, "size", "`height` of what it sees") } else { None };
        let angle = if is_orthographic { None } else { self.angle(fields) };
        let across = self.log.take(fields, "angle across");
        let size = self.picture_size(fields);
        let lens = if is_orthographic { None } else { self.lens(name, fields, center, direction) };
        if is_orthographic {
            self.log.put_aside(fields, KEYS, "parallel rays are sharp at every distance");
        }
        let (center, direction, (up, up_span)) = (center?, direction?, up?);
        let mut camera = Camera {
            center,
            direction,
            up,
            angle: 45.0,
            parallel: side,
            is_across: false,
            pixel_aspect: 1.0,
            size,
            lens,
            notes: Vec::new(),
            angle_notes: Vec::new(),
        };
        self.check_up(&camera, &up_span)?;
        match side {
            Some(side) => self.step_back(&mut camera, side, &fields.head),
            None => {
                self.field_of_view(&mut camera, angle?)?;
                self.angle_across(&mut camera, across.as_ref());
                self.straighten(&mut camera, &up_span);
            }
        }
        Some(camera)
    }

    /// `direction`, or the way to what the camera looks at.
    fn direction(&mut self, fields: &mut Fields<'_>, center: Option<DVec3>) -> Option<DVec3> {
        if !fields.has("direction")
            && let Some(target) = self.log.take(fields, "target")
        {
            self.log.mapped(&target.span, "`direction`, from the camera to there");
            return Some(target.vector() - center?).filter(|way| *way != DVec3::ZERO);
        }
        self.axis(fields, "direction").map(|(direction, _)| direction)
    }

    /// `direction` or `up`: any length but zero.
    fn axis(&mut self, fields: &mut Fields<'_>, key: &'static str) -> Option<(DVec3, Span)> {
        let field = self.log.need(fields, key)?;
        self.log.mapped(&field.span, format!("`{key}`"));
        if field.vector() == DVec3::ZERO {
            let what = format!("`{key}` is the zero vector");
            self.log.bad_value(what, &field.span, "write where it points, such as `0 1 0`");
            return None;
        }
        Some((field.vector(), field.span))
    }

    /// `angle`, or the vertical one of two.
    fn angle<'t>(&mut self, fields: &mut Fields<'t>) -> Option<Field<'t>> {
        match fields.has("angle upwards") && !fields.has("angle") {
            true => self.log.take(fields, "angle upwards"),
            false => self.log.need(fields, "angle"),
        }
    }

    /// An angle for the width beside one for the height: together with the picture's sides they make the shape of a
    /// pixel.
    fn angle_across(&mut self, camera: &mut Camera, across: Option<&Field<'_>>) {
        let Some(field) = across else { return };
        let degrees = field.number(0);
        if !(0.0 < degrees && degrees < 180.0) {
            self.log.dropped(&field.span, "no angle of view");
            let what = format!("`{}` is {degrees} degrees", field.key);
            return self.log.bad_value(what, &field.span, "a field of view lies between 0 and 180 degrees");
        }
        self.log.mapped(&field.span, "`pixel_aspect`, together with the other angle");
        let tan_half = |degrees: f64| tan64((degrees / 2.0).to_radians());
        let (width, height) = camera.size.unwrap_or((1, 1));
        let aspect = tan_half(degrees) / tan_half(camera.angle) * f64::from(height) / f64::from(width);
        // Angles that were worked out from the sides are square but for their rounding.
        camera.pixel_aspect = if (aspect - 1.0).abs() < SQUARE_TOLERANCE { 1.0 } else { aspect };
    }

    fn field_of_view(&mut self, camera: &mut Camera, angle: Field<'_>) -> Option<()> {
        let degrees = angle.number(0);
        if !(0.0 < degrees && degrees < 180.0) {
            let what = format!("`angle` is {degrees} degrees");
            self.log.bad_value(what, &angle.span, "a field of view lies between 0 and 180 degrees");
            return None;
        }
        camera.angle = degrees;
        camera.is_across = self.options.angle == Some(Angle::Horizontal);
        let to = if camera.is_across { "`fov_x`" } else { "`fov`, which is vertical" };
        self.log.mapped(&angle.span, to);
        let is_square = camera.size.is_none_or(|(width, height)| width == height);
        let is_settled =
            matches!(self.dialect, Dialect::Arsenal | Dialect::Pa1) || self.options.angle.is_some();
        if !is_square && !is_settled {
            self.log.notes.note(Mistake::DisputedAngle { at: angle.span.clone().into() });
        }
        let both = self.options.angle == Some(Angle::Both) || self.dialect.is_mit();
        if !is_square && both {
            let (width, height) = camera.size.unwrap_or((1, 1));
            self.log.mapped(
                &angle.span,
                "`fov`, which is vertical, and `pixel_aspect`, for it spans the width, too",
            );
            camera.pixel_aspect = f64::from(height) / f64::from(width);
        }
        Some(())
    }

    /// Both numbers or none; a fraction is cut off, as by the original's `%d`.
    fn picture_size(&mut self, fields: &mut Fields<'_>) -> Option<(u32, u32)> {
        if !fields.has("width") && !fields.has("height") {
            return None;
        }
        let width = self.log.need(fields, "width");
        let height = self.log.need(fields, "height");
        let mut side = |field: Field<'_>| {
            self.log.mapped(&field.span, "`film` size");
            let pixels = field.number(0).trunc();
            let fits = (1.0..=65536.0).contains(&pixels);
            if !fits {
                let written = field.numbers.first().map_or("0", |number| number.text);
                let what = format!("a picture cannot be {written} pixels wide or high");
                self.log.dropped(&field.span, "out of range");
                self.log.bad_value(what, &field.span, "write a whole number from 1 to 65536");
            }
            fits.then_some(pixels as u32)
        };
        let (width, height) = (width.map(&mut side), height.map(&mut side));
        width.flatten().zip(height.flatten())
    }

    /// Nothing is upright when `up` points along the view.
    fn check_up(&mut self, camera: &Camera, at: &Span) -> Option<()> {
        let sine = camera.direction.normalize().cross(camera.up.normalize()).length();
        if sine >= LEAN_TOLERANCE {
            return Some(());
        }
        self.log.bad_value(
            "`up` points along `direction`",
            at,
            "write an `up` that points sideways of the view",
        );
        None
    }

    /// Resolves an `up` that is not perpendicular to the view.
    ///
    /// The framework's first edition does not normalise `direction x up`, of length s, which scales the picture by
    /// 1 / s: its effective angle is 2 atan(s tan(angle / 2)). Later editions make the basis orthonormal.
    fn straighten(&mut self, camera: &mut Camera, at: &Span) {
        let s = camera.direction.normalize().cross(camera.up).length();
        if (s - 1.0).abs() < LEAN_TOLERANCE {
            return;
        }
        let half = (camera.angle / 2.0).to_radians();
        let raw = 2.0 * libm::atan2(s * tan64(half), 1.0).to_degrees();
        let help = match self.basis() {
            Basis::Raw => {
                camera.angle_notes.push(format!(
                    "`up` is not perpendicular to the view, and the original does not normalise: its angle of {} \
                     degrees shows as this one.",
                    camera.angle
                ));
                camera.angle = raw;
                "the original does not normalise its basis, which changes the angle; `fov` says the angle that shows"
                    .to_string()
            }
            Basis::Orthonormal => format!(
                "the camera was made orthonormal; programs on the framework of 2020 do not normalise and magnify \
                 the picture by {:.4} (convert with `--basis raw` for those)",
                1.0 / s
            ),
        };
        self.log.notes.note(Mistake::UpNotPerpendicular { at: at.clone().into(), help });
    }

    /// Moves an orthographic camera back, which changes nothing but what is in front of it.
    ///
    /// MIT's sees what is behind its place as well. What it sees is a square, whatever the sides of the picture.
    fn step_back(&mut self, camera: &mut Camera, side: f64, head: &Span) {
        camera.center -= camera.direction.normalize() * (STEP_BACK * side);
        camera.notes.push(format!(
            "Moved back by {} along its parallel rays, for the original sees what is behind its place as well.",
            STEP_BACK * side
        ));
        self.log.mapped(head, "`camera` with an `orthographic` lens");
        if self.dialect.is_mit() {
            let (width, height) = camera.size.unwrap_or((1, 1));
            camera.pixel_aspect = f64::from(height) / f64::from(width);
        }
    }
}
