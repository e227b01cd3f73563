//! Cameras.

use super::{Basis, Dialect, Mistake, Reader, vocab};
use crate::convert::fields::{Field, Fields};
use crate::convert::model::{Camera, Lens};
use crate::convert::parse::{Block, Span};
use crate::math::DVec3;
use crate::math::float::tan64;

/// Blocks that are cameras in some dialect.
pub const NAMES: &[&str] = &[
    "PerspectiveCamera",
    "OrthographicCamera",
    "LensCamera",
    "DofCamera",
    "DepthCamera",
    "RealisticCamera",
    "ApertureCamera",
];

/// How far the length of `direction x up` may be from 1 before it counts as leaning: what single precision leaves of 1.
const LEAN_TOLERANCE: f64 = 1e-6;

/// A pair of keys that means a focus distance and the opening of a lens.
struct LensRule {
    focus: &'static str,
    opening: &'static str,
    /// The radius of a round lens that blurs as much, from opening and focus distance.
    radius: fn(f64, f64) -> f64,
    note: &'static str,
}

/// A square of half side a blurs like a disc of its area, of radius 2a / sqrt(pi).
const DISC_OF_SQUARE: f64 = std::f64::consts::FRAC_2_SQRT_PI;

/// What the programs of the family mean by their pairs of keys. None of the distances is a focal length.
const LENSES: &[LensRule] = &[
    LensRule {
        focus: "focalLength",
        opening: "aperture",
        radius: |half_side, _| DISC_OF_SQUARE * half_side,
        note: "a round lens of the area of the original's square one",
    },
    LensRule {
        focus: "focus",
        opening: "aperture",
        radius: |half_side, _| DISC_OF_SQUARE * half_side,
        note: "a round lens of the area of the original's square one, if it is one; programs differ",
    },
    LensRule {
        focus: "focal_length",
        opening: "aperture_size",
        radius: |side, _| 0.5 * DISC_OF_SQUARE * side,
        note: "a round lens for the original's cube of this side",
    },
    LensRule {
        focus: "focusDistance",
        opening: "aperture",
        radius: |diameter, _| 0.5 * diameter,
        note: "a round lens of this diameter, as in the original",
    },
    LensRule {
        focus: "focusDist",
        opening: "defocusAngle",
        radius: |degrees, focus| focus * tan64((degrees / 2.0).to_radians()),
        note: "a round lens; the original measures the distance along each ray",
    },
    LensRule {
        focus: "focus_distance",
        opening: "lens_radius",
        radius: |radius, _| radius,
        note: "a round lens, evenly open; the original's is a projected ball",
    },
    LensRule {
        focus: "focal",
        opening: "aperture",
        radius: |radius, _| radius,
        note: "a round lens of this radius; programs differ",
    },
    LensRule {
        focus: "distance",
        opening: "radius",
        radius: |radius, _| radius,
        note: "a round lens, evenly open; the original's is denser at the centre",
    },
    LensRule {
        focus: "dist",
        opening: "radius",
        radius: |radius, _| radius,
        note: "a round lens, evenly open; the original's is denser at the centre",
    },
    LensRule {
        focus: "focus",
        opening: "field",
        radius: |radius, _| radius,
        note: "a round lens, evenly open; the original's is a ball",
    },
];

impl Reader<'_> {
    pub(super) fn camera(&mut self, block: Block<'_>) -> Option<Camera> {
        let (name, head) = (block.name().to_string(), block.head.clone());
        if name == "OrthographicCamera" {
            self.not_read(&block, "left out; the scene has no camera");
            return None;
        }
        let mut fields = self.log.fields(block, vocab::CAMERA);
        self.log.mapped(&head, "`camera`");
        let center = self.log.need_vector(&mut fields, "center", "`position`");
        let direction = self.axis(&mut fields, "direction");
        let up = self.axis(&mut fields, "up");
        let angle = self.angle(&mut fields);
        let size = self.picture_size(&mut fields);
        let lens = self.lens(&name, &head, &mut fields);
        self.log.finish(fields);

        let angle = self.field_of_view(angle?, size);
        let (direction, (up, up_span)) = (direction?.0, up?);
        let mut camera =
            Camera { center: center?, direction, up, angle: angle?, size, lens, notes: Vec::new() };
        self.straighten(&mut camera, &up_span);
        Some(camera)
    }

    /// `direction` or `up`: any length but zero.
    fn axis(&mut self, fields: &mut Fields<'_>, key: &'static str) -> Option<(DVec3, Span)> {
        let field = self.log.need(fields, key)?;
        self.log.mapped(&field.span, format!("`{key}`"));
        if field.vector() == DVec3::ZERO {
            self.bad_value(
                format!("`{key}` is the zero vector"),
                &field.span,
                "write where it points, such as `0 1 0`",
            );
            return None;
        }
        Some((field.vector(), field.span))
    }

    /// `angle`, or `h-angle`, its vertical half in a dialect that has one for each axis.
    fn angle<'t>(&mut self, fields: &mut Fields<'t>) -> Option<Field<'t>> {
        if fields.has("angle") || !fields.has("h-angle") {
            return self.log.need(fields, "angle");
        }
        if let Some(across) = self.log.take(fields, "w-angle") {
            self.log.approximated(&across.span, "it follows from `fov` and the picture's shape");
        }
        self.log.take(fields, "h-angle")
    }

    fn field_of_view(&mut self, angle: Field<'_>, size: Option<(u32, u32)>) -> Option<f64> {
        let degrees = angle.number(0);
        if !(0.0 < degrees && degrees < 180.0) {
            self.log.dropped(&angle.span, "out of range");
            self.bad_value(
                format!("`angle` is {degrees} degrees"),
                &angle.span,
                "a field of view lies between 0 and 180 degrees",
            );
            return None;
        }
        self.log.mapped(&angle.span, "`fov`, which is vertical");
        let is_square = size.is_none_or(|(width, height)| width == height);
        if !is_square && !matches!(self.dialect, Dialect::Arsenal | Dialect::Pa1) {
            self.log.notes.note(Mistake::DisputedAngle { at: angle.span.clone().into() });
        }
        Some(degrees)
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
                self.bad_value(what, &field.span, "write a whole number from 1 to 65536");
            }
            fits.then_some(pixels as u32)
        };
        width.map(&mut side).zip(height.map(&mut side)).and_then(|(w, h)| Some((w?, h?)))
    }

    /// Depth of field, for the pairs of keys whose meaning is known.
    fn lens(&mut self, camera: &str, head: &Span, fields: &mut Fields<'_>) -> Option<Lens> {
        if self.dialect == Dialect::Arsenal
            && let Some(focal) = self.log.take(fields, "focal")
        {
            self.log.ignored(&focal.span, "the original reads it and builds the camera without it");
        }
        match camera {
            "PerspectiveCamera" | "DofCamera" => {}
            "LensCamera" => {
                self.differs(
                    "`LensCamera` blurs the finished picture, it has no lens",
                    head,
                    "the distance is kept as the focus of a real lens, so the blur will differ",
                );
            }
            _ => {
                self.note_not_read(format!("the lens of `{camera}`"), head, "read as a pinhole camera");
                for key in ["focalLength", "aperture", "distance", "radius"] {
                    if let Some(field) = self.log.take(fields, key) {
                        self.log.dropped(&field.span, "the lens is not read yet");
                    }
                }
                return None;
            }
        }
        let rule = LENSES.iter().find(|rule| fields.has(rule.focus) && fields.has(rule.opening))?;
        let focus = self.log.take(fields, rule.focus)?;
        let opening = self.log.take(fields, rule.opening)?;
        self.log.approximated(&focus.span, "the distance in focus, along the view axis");
        self.log.approximated(&opening.span, rule.note);
        let (distance, size) = (focus.number(0), opening.number(0));
        if distance <= 0.0 {
            self.bad_value(
                "the lens is focused behind the camera",
                &focus.span,
                "write a distance greater than 0",
            );
            return None;
        }
        let radius = (rule.radius)(size, distance);
        (radius > 0.0).then(|| Lens { radius, focus: distance, note: rule.note.into() })
    }

    /// Resolves an `up` that is not perpendicular to the view.
    ///
    /// The framework's first edition does not normalise `direction x up`, of length s, which scales the picture by
    /// 1 / s: its effective angle is 2 atan(s tan(angle / 2)). Later editions make the basis orthonormal.
    fn straighten(&mut self, camera: &mut Camera, at: &Span) {
        let s = camera.direction.normalize().cross(camera.up).length();
        let sine = camera.direction.normalize().cross(camera.up.normalize()).length();
        if sine < LEAN_TOLERANCE {
            return self.bad_value(
                "`up` points along `direction`",
                at,
                "write an `up` that points sideways of the view",
            );
        }
        if (s - 1.0).abs() < LEAN_TOLERANCE {
            return;
        }
        let half = (camera.angle / 2.0).to_radians();
        let raw = 2.0 * libm::atan2(s * tan64(half), 1.0).to_degrees();
        let help = match self.basis() {
            Basis::Raw => {
                camera.notes.push(format!(
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
}
