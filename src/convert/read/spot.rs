//! Spotlights: programs say in half a dozen ways how wide their cones are.

use super::Reader;
use crate::convert::fields::Fields;
use crate::convert::model::{Cone, Light};
use crate::math::DVec3;

/// The roles that say how wide a cone is.
pub(super) const SPREADS: &[&str] =
    &["spread", "inner spread", "whole spread", "whole inner spread", "exponent"];

/// The whole angle of a cone of which nothing is said, in degrees: what the language takes.
const USUAL_ANGLE: f64 = 45.0;

/// The widest cone there is, in degrees, and the narrowest.
const WIDEST: f64 = 179.0;
const NARROWEST: f64 = 0.01;

/// How wide a cone is, and what is to be said of that.
struct Spread {
    angle: f64,
    blend: f64,
    note: &'static str,
}

impl Reader<'_> {
    pub(super) fn spot_light(&mut self, fields: &mut Fields<'_>, color: DVec3) -> Option<Light> {
        let head = fields.head.clone();
        self.log.mapped(&head, "`light spot`");
        let position = self.log.need_vector(fields, "position", "`position`");
        let way = self.log.take_any(fields, &["direction", "normal"])?;
        self.log.mapped(&way.span, "`direction`, the way its middle shines");
        let spread = self.spread(fields);
        let falloff = self.falloff(fields);
        self.log.put_aside(fields, SPREADS, "its cone is said already");
        self.log.put_aside(fields, &["radius", "direction", "normal"], "it shines from a point, one way");
        let direction = way.vector();
        if direction == DVec3::ZERO {
            self.log.bad_value(
                "a light cannot shine along the zero vector",
                &way.span,
                "write where it shines",
            );
            return None;
        }
        let Spread { angle, blend, note } = spread;
        let cone = Some(Cone { direction, angle: angle.clamp(NARROWEST, WIDEST), blend });
        Some(Light::Point { position: position?, cone, color, falloff, notes: vec![note.into()] })
    }

    /// Angles are from the middle of the cone to its edge, but for `hotspotAngle` and `falloffAngle`, which are from edge
    /// to edge; with an exponent n the original shines as the cosine to the power of n.
    fn spread(&mut self, fields: &mut Fields<'_>) -> Spread {
        if let Some(outer) = self.degrees(fields, "whole spread") {
            let inner = self.degrees(fields, "whole inner spread");
            return between(outer, inner, "Its angle was taken as one from edge to edge.");
        }
        if let Some(outer) = self.degrees(fields, "spread") {
            let inner = self.degrees(fields, "inner spread");
            let note = "Its angle was taken as one from the middle to the edge; programs differ on that.";
            return between(2.0 * outer, inner.map(|inner| 2.0 * inner), note);
        }
        let exponent = self.log.take(fields, "exponent").filter(|field| field.number(0) > 0.0);
        let Some(field) = exponent else {
            let note = "The original does not say how wide its cone is, so it is as wide as usual here.";
            return Spread { angle: USUAL_ANGLE, blend: 0.0, note };
        };
        self.log.approximated(&field.span, "a cone that is half as bright where the original is");
        // Half as bright is half way from 1 to the cosine of the edge.
        let edge = 2.0 * libm::pow(0.5, 1.0 / field.number(0)) - 1.0;
        let note = "The original fades as a power of the cosine; this cone is half as bright where that is.";
        Spread { angle: 2.0 * libm::acos(edge.clamp(-1.0, 1.0)).to_degrees(), blend: 1.0, note }
    }

    /// An angle in degrees, above 0.
    fn degrees(&mut self, fields: &mut Fields<'_>, role: &'static str) -> Option<f64> {
        let field = self.log.take(fields, role)?;
        let degrees = field.number(0);
        if degrees > 0.0 && degrees <= 180.0 {
            self.log.approximated(&field.span, "the `angle` of its cone, or its `blend`");
            return Some(degrees);
        }
        self.log.dropped(&field.span, "no angle of a cone");
        let what = format!("`{}` is {degrees} degrees", field.key);
        self.log.bad_value(what, &field.span, "a cone has an angle above 0");
        None
    }
}

/// A cone from one whole angle, where it is dark, to another, up to which it is as bright as in the middle.
fn between(outer: f64, inner: Option<f64>, note: &'static str) -> Spread {
    let blend = inner.map_or(0.0, |inner| (1.0 - inner / outer).clamp(0.0, 1.0));
    Spread { angle: outer, blend, note }
}
