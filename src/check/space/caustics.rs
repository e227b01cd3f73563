//! Caustics that path tracing does not find: light reaches a matt surface by way of glass or a mirror, and a path from
//! there has to hit the light by chance.

use super::{SpaceError, Survey, Thing};
use crate::ir::{Light, LightKind};
use crate::math::DVec3;
use crate::source::Span;
use std::f64::consts::PI;

/// A light that fills less than this share of all directions, seen from the glass, is found too seldom.
const SELDOM: f64 = 1e-4;

impl Survey<'_> {
    /// A light whose caustics path tracing misses: one, for the method is the mistake, not each of the lights.
    pub(super) fn caustics(&self, method: Option<Span>) -> Option<SpaceError> {
        if !self.things.iter().any(|thing| thing.stuff.is_rough) {
            return None; // nothing that they could fall on
        }
        let lights = || self.scene.lights.iter().filter(|light| light.brightness.value.is_lit());
        let sizeless = lights().find(|light| light.kind.is_sizeless());
        if let Some(light) = sizeless {
            let object = self.things.iter().find(|thing| thing.stuff.is_specular)?.object.span;
            return Some(SpaceError::CausticsInvisible { light: light.span, object, method });
        }
        lights().find_map(|light| self.found_by_luck(light, method))
    }

    fn found_by_luck(&self, light: &Light, method: Option<Span>) -> Option<SpaceError> {
        // Its middle, and the largest area that it shows.
        let (center, area) = match light.kind {
            LightKind::Sphere { center, radius } => (center, PI * radius.value * radius.value),
            LightKind::Disk { center, edge_u, edge_v, .. } => (center, PI * edge_u.cross(edge_v).length()),
            LightKind::Rect { origin, edge_u, edge_v, .. } => {
                (origin + (edge_u + edge_v) / 2.0, edge_u.cross(edge_v).length())
            }
            _ => return None,
        };
        let specular = self.things.iter().filter(|thing| thing.stuff.is_specular);
        // From where the light looks largest it is still found too seldom.
        let (thing, distance) =
            specular.map(|thing| (thing, distance(thing, center))).min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let share = area / (4.0 * PI * distance * distance);
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
