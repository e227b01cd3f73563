//! Depth of field: a dozen programs, nearly as many pairs of keys, and more meanings than pairs.

use super::Reader;
use super::lens_rules::{DISC_OF_SQUARE, DISTANCES, KEYS, OPENINGS, RULES, Rule, rule};
use crate::convert::fields::Fields;
use crate::convert::model::Lens;
use crate::convert::parse::Span;
use crate::math::DVec3;

/// The first of these keys that is there.
fn first_of(keys: &[&'static str], fields: &Fields<'_>) -> Option<&'static str> {
    keys.iter().copied().find(|key| fields.has(key))
}

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
                None => {
                    self.lens_by_rule(camera, fields, center).or_else(|| self.lens_of_opening(fields, center))
                }
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
        let rule = match RULES.iter().find(fits) {
            Some(rule) => *rule,
            None => self.unlisted_pair(fields)?,
        };
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

    /// A pair of keys that no known program has: a distance and a radius, if the radius is that of a lens at all.
    fn unlisted_pair(&mut self, fields: &Fields<'_>) -> Option<Rule> {
        let (focus, opening) = (first_of(DISTANCES, fields)?, first_of(OPENINGS, fields)?);
        let value = |role| fields.peek(role).filter(|field| field.sound).map(|field| field.number(0));
        let (distance, radius) = (value(focus)?, value(opening)?);
        if radius <= 0.0 || radius >= distance {
            return None;
        }
        let at = fields.peek(opening)?.span.clone();
        let help = "they were taken as the distance in focus and the radius of the lens";
        self.log.differs("no known program has this pair of keys for a lens", &at, help);
        Some(rule(focus, opening, |radius, _| radius, "a round lens of this radius, by the look of the keys"))
    }

    /// An opening without a distance, in hundredths, focused at the origin of the world: as one program has it.
    fn lens_of_opening(&mut self, fields: &mut Fields<'_>, center: DVec3) -> Option<Lens> {
        let is_alone = first_of(DISTANCES, fields).is_none();
        let opens = fields.peek("aperture").is_some_and(|field| field.sound && field.number(0) > 0.0);
        if !is_alone || !opens || center == DVec3::ZERO {
            return None;
        }
        let aperture = self.log.take(fields, "aperture")?;
        let note = "a round lens of the area of the original's square one, whose side is in hundredths; the original \
                    is focused at the world's origin";
        self.log.approximated(&aperture.span, note);
        let radius = 0.5 * DISC_OF_SQUARE * aperture.number(0) / 100.0;
        Some(Lens { radius, focus: center.length(), note: note.into() })
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
