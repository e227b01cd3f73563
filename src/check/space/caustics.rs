//! Caustics that path tracing does not find: light reaches a matt surface by way of glass or a mirror, and a path from
//! there has to hit the light by chance.

use super::{SpaceError, Survey, Thing};
use crate::ir::{Light, LightKind, Method};
use crate::math::DVec3;
use crate::source::Span;

/// A light that fills less than this share of all directions, seen from the glass, is found too seldom.
const SELDOM: f64 = 1e-4;

impl Survey<'_> {
    /// Lights whose caustics the scene's own method misses.
    pub(super) fn caustics(&self) -> Vec<SpaceError> {
        let method = self.scene.render.method.filter(|method| method.value == Method::Pt);
        let is_seen = self.things.iter().any(|thing| thing.stuff.is_rough);
        match method {
            Some(method) if is_seen => self.missed(method.span).into_iter().collect(),
            _ => Vec::new(),
        }
    }

    /// One report: the method is the mistake, not each of the lights.
    fn missed(&self, method: Span) -> Option<SpaceError> {
        let lights = || self.scene.lights.iter().filter(|light| light.brightness.value.is_lit());
        let sizeless = lights().find(|light| light.kind.is_sizeless());
        if let Some(light) = sizeless {
            let object = self.things.iter().find(|thing| thing.stuff.is_specular)?.object.span;
            return Some(SpaceError::CausticsInvisible { light: light.span, object, method });
        }
        lights().find_map(|light| self.found_by_luck(light, method))
    }

    fn found_by_luck(&self, light: &Light, method: Span) -> Option<SpaceError> {
        let LightKind::Sphere { center, radius } = light.kind else { return None };
        let specular = self.things.iter().filter(|thing| thing.stuff.is_specular);
        // From where the light looks largest it is still found too seldom.
        let (thing, distance) =
            specular.map(|thing| (thing, distance(thing, center))).min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let share = (radius.value / (2.0 * distance)).powi(2);
        let paths = (1.0 / share).round() as u64;
        let (light, object) = (light.span, thing.object.span);
        (share < SELDOM).then_some(SpaceError::CausticsByLuck { paths, light, object, method })
    }
}

/// No point of a thing is nearer than this; 0 for endless planes.
fn distance(thing: &Thing<'_>, p: DVec3) -> f64 {
    thing.region.as_ref().map_or(0.0, |region| {
        let (center, radius) = region.ball();
        (center.distance(p) - radius).max(0.0)
    })
}
