//! Depth of field: a dozen programs, nearly as many pairs of keys, and more meanings than pairs.

use super::Reader;
use crate::convert::fields::Fields;
use crate::convert::model::Lens;
use crate::convert::parse::Span;
use crate::math::DVec3;
use crate::math::float::tan64;

/// A pair of keys that means a focus distance and the opening of a lens.
struct Rule {
    /// A part of the camera's name, for cameras that measure in their own way.
    camera: &'static str,
    focus: &'static str,
    opening: &'static str,
    /// Whether the opening stands before the distance; one program that writes it so means another size.
    opening_first: Option<bool>,
    /// The distance in focus, from what is written and the distance of the camera from the origin.
    distance: fn(f64, f64) -> f64,
    /// The radius of a round lens that blurs as much, from opening and focus distance.
    radius: fn(f64, f64) -> f64,
    note: &'static str,
}

const AS_WRITTEN: fn(f64, f64) -> f64 = |distance, _| distance;

/// A square of half side a blurs like a disc of its area, of radius 2a / sqrt(pi).
const DISC_OF_SQUARE: f64 = std::f64::consts::FRAC_2_SQRT_PI;

/// A rule for cameras of any name and keys in any order.
const fn rule(
    focus: &'static str,
    opening: &'static str,
    radius: fn(f64, f64) -> f64,
    note: &'static str,
) -> Rule {
    Rule { camera: "", focus, opening, opening_first: None, distance: AS_WRITTEN, radius, note }
}

/// What the programs of the family mean by their pairs of keys; the first that fits counts. None of the distances is a
/// focal length.
const RULES: &[Rule] = &[
    Rule {
        camera: "DepthCamera",
        distance: |written, _| written + 1.0,
        ..rule(
            "focalLength",
            "aperture",
            |width, _| 0.5 * width,
            "a round lens of this diameter, evenly open; the original's is denser at the centre, and focused 1 \
             further than it says",
        )
    },
    rule(
        "focalLength",
        "aperture",
        |half_side, _| DISC_OF_SQUARE * half_side,
        "a round lens of the area of the original's square one",
    ),
    Rule {
        opening_first: Some(true),
        ..rule(
            "focus",
            "aperture",
            |width, _| 0.5 * width,
            "a round lens of this diameter; the original's is open at its rim only",
        )
    },
    rule(
        "focus",
        "aperture",
        |half_side, _| DISC_OF_SQUARE * half_side,
        "a round lens of the area of the original's square one",
    ),
    rule(
        "focal_length",
        "aperture_size",
        |side, _| 0.5 * DISC_OF_SQUARE * side,
        "a round lens for the original's cube of this side",
    ),
    rule(
        "focusDistance",
        "aperture",
        |width, _| 0.5 * width,
        "a round lens of this diameter, as in the original",
    ),
    rule(
        "focusDist",
        "defocusAngle",
        |degrees, focus| focus * tan64((degrees / 2.0).to_radians()),
        "a round lens; the original measures the distance along each ray",
    ),
    rule("focusDist", "lenRadius", |radius, _| radius, "a round lens of this radius"),
    rule(
        "focus_distance",
        "lens_radius",
        |radius, _| radius,
        "a round lens, evenly open; the original's is a projected ball",
    ),
    rule("focal", "aperture", |radius, _| radius, "a round lens of this radius; programs differ"),
    Rule {
        distance: |_, from_origin| from_origin,
        ..rule(
            "distance",
            "aperture",
            |hundredths, _| 0.5 * DISC_OF_SQUARE * hundredths / 100.0,
            "a round lens of the area of the original's square one, whose side is in hundredths; the original is \
             focused at the world's origin, whatever its `distance` says",
        )
    },
    rule(
        "distance",
        "radius",
        |radius, _| radius,
        "a round lens, evenly open; the original's is denser at the centre",
    ),
    rule(
        "dist",
        "radius",
        |radius, _| radius,
        "a round lens, evenly open; the original's is denser at the centre",
    ),
    rule("focus", "field", |radius, _| radius, "a round lens, evenly open; the original's is a ball"),
];

/// All keys of lenses.
const KEYS: &[&str] = &[
    "focal",
    "focalLength",
    "focal_length",
    "focus",
    "focusDist",
    "focusDistance",
    "focus_distance",
    "focusPoint",
    "distance",
    "dist",
    "aperture",
    "aperture_size",
    "radius",
    "lens_radius",
    "lenRadius",
    "field",
    "defocusAngle",
    "isDOF",
];

/// The radius of the lens of the program that focuses at a point.
const POINT_LENS_RADIUS: f64 = 0.3;

impl Reader<'_> {
    /// Depth of field; what is left of a lens that is not understood, or switched off, is dropped.
    pub(super) fn lens(
        &mut self,
        camera: &str,
        fields: &mut Fields<'_>,
        center: Option<DVec3>,
        direction: Option<DVec3>,
    ) -> Option<Lens> {
        let center = center.unwrap_or_default();
        let lens = match self.is_inert_lens(fields) {
            true => None,
            false => match self.lens_at_point(fields, center, direction.unwrap_or(DVec3::NEG_Z)) {
                Some(lens) => Some(lens),
                None => self.lens_by_rule(camera, fields, center),
            },
        };
        self.leave_rest(fields);
        lens
    }

    /// Lenses that programs read and do without.
    fn is_inert_lens(&mut self, fields: &mut Fields<'_>) -> bool {
        if self.dialect == super::Dialect::Arsenal
            && let Some(focal) = self.log.take(fields, "focal")
        {
            self.log.ignored(&focal.span, "the original reads it and builds the camera without it");
            return true;
        }
        if let Some(switch) = self.log.take(fields, "isDOF") {
            let is_on = switch.number(0) != 0.0;
            self.log.mapped(&switch.span, if is_on { "there is a lens" } else { "no lens" });
            return !is_on;
        }
        if fields.has("focus") && fields.has("radius") {
            let why = "the original moves its rays and then does not use that";
            for role in ["focus", "radius"] {
                if let Some(field) = self.log.take(fields, role) {
                    self.log.ignored(&field.span, why);
                }
            }
            return true;
        }
        false
    }

    /// `focusPoint True V`: what is there is sharp.
    fn lens_at_point(&mut self, fields: &mut Fields<'_>, center: DVec3, direction: DVec3) -> Option<Lens> {
        let field = self.log.take(fields, "focusPoint")?;
        if !field.is_vector() {
            self.log.mapped(&field.span, "no lens");
            return None;
        }
        self.log.approximated(&field.span, "a lens that is focused there");
        let focus = (field.vector() - center).dot(direction.normalize());
        let note = "the original's has a radius of 0.3, whatever the scene".into();
        let is_ahead = self.check_distance(focus, &field.span);
        is_ahead.then_some(Lens { radius: POINT_LENS_RADIUS, focus, note })
    }

    fn lens_by_rule(&mut self, camera: &str, fields: &mut Fields<'_>, center: DVec3) -> Option<Lens> {
        let place = |fields: &Fields<'_>, role| fields.peek(role).map(|field| field.span.start);
        let fits = |rule: &&Rule| {
            let (Some(focus), Some(opening)) = (place(fields, rule.focus), place(fields, rule.opening))
            else {
                return false;
            };
            let in_order = rule.opening_first.is_none_or(|first| first == (opening < focus));
            in_order && camera.contains(rule.camera)
        };
        let rule = RULES.iter().find(fits)?;
        if camera == "LensCamera" && ["distance", "dist"].contains(&rule.focus) {
            self.log.differs(
                "`LensCamera` blurs the finished picture, it has no lens",
                &fields.head.clone(),
                "the distance is kept as the focus of a real lens, so the blur will differ",
            );
        }
        let taken = (self.log.take(fields, rule.focus), self.log.take(fields, rule.opening));
        let (Some(focus), Some(opening)) = taken else {
            for field in [taken.0, taken.1].into_iter().flatten() {
                self.log.dropped(&field.span, "does not make a lens by itself");
            }
            return None;
        };
        self.log.approximated(&focus.span, "the distance in focus, along the view axis");
        self.log.approximated(&opening.span, rule.note);
        let distance = (rule.distance)(focus.number(0), center.length());
        let radius = (rule.radius)(opening.number(0), distance);
        if radius <= 0.0 {
            for field in [&focus, &opening] {
                self.log.mapped(&field.span, "a lens of no width, which is a pinhole");
            }
            return None;
        }
        let is_ahead = self.check_distance(distance, &focus.span);
        is_ahead.then(|| Lens { radius, focus: distance, note: rule.note.into() })
    }

    fn check_distance(&mut self, distance: f64, at: &Span) -> bool {
        if distance <= 0.0 {
            self.log.dropped(at, "behind the camera; there is no lens");
            self.log.bad_value(
                "the lens is focused behind the camera",
                at,
                "write a distance greater than 0",
            );
        }
        distance > 0.0
    }

    /// Half of a lens is none.
    fn leave_rest(&mut self, fields: &mut Fields<'_>) {
        for role in KEYS {
            let Some(field) = self.log.take(fields, role) else { continue };
            let is_nothing = field.numbers.iter().all(|number| number.value == 0.0) && field.word.is_none();
            if is_nothing {
                self.log.mapped(&field.span, "no lens");
                continue;
            }
            self.log.dropped(&field.span, "does not make a lens by itself");
            self.log.differs(
                format!("`{}` does not make a lens by itself", field.key),
                &field.span,
                "the camera is a pinhole: a lens needs a distance in focus and the size of its opening",
            );
        }
    }
}
