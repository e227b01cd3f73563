//! Flat lights that shine to one side: that something is there, and more than a hair's breadth away.

use super::region::Region;
use super::{SpaceError, Survey, Thing, plane_of};
use crate::ir::{LightKind, ShapeKind};
use crate::math::DVec3;
use crate::source::Span;

/// A wall nearer than this share of a lamp's shorter edge takes nearly all of its light.
const GAP: f64 = 0.01;
/// The share of a size that is rounding.
const ROUNDING: f64 = 1e-9;

/// A flat light that shines to one side only.
struct Panel {
    corners: [DVec3; 4],
    /// The way it shines, of unit length.
    normal: DVec3,
    span: Span,
    /// The thing that it is; `None` for a `light rect`.
    owner: Option<usize>,
}

impl Panel {
    fn of(origin: DVec3, u: DVec3, v: DVec3, span: Span, owner: Option<usize>) -> Option<Self> {
        let normal = u.cross(v).try_normalize()?;
        Some(Self { corners: [origin, origin + u, origin + u + v, origin + v], normal, span, owner })
    }

    fn size(&self) -> f64 {
        self.corners[0].distance(self.corners[1]).min(self.corners[0].distance(self.corners[3]))
    }

    /// How far a region reaches before this light; less than 0 for what is all behind it.
    fn reach(&self, region: &Region) -> f64 {
        region.support(self.normal) - self.normal.dot(self.corners[0])
    }
}

impl Survey<'_> {
    /// Lights that shine away from everything, or into a wall.
    pub(super) fn aims(&self) -> Vec<SpaceError> {
        self.panels()
            .iter()
            .filter_map(|panel| self.away(panel).or_else(|| self.against_wall(panel)))
            .collect()
    }

    fn panels(&self) -> Vec<Panel> {
        let lights = self.scene.lights.iter().filter_map(|light| match light.kind {
            LightKind::Rect { origin, edge_u, edge_v, two_sided: false }
                if light.brightness.value.is_lit() =>
            {
                Panel::of(origin, edge_u, edge_v, light.span, None)
            }
            _ => None,
        });
        let quads = self.things.iter().enumerate().filter(|(_, thing)| thing.stuff.is_lamp);
        let quads = quads.filter_map(|(index, thing)| {
            let ShapeKind::Quad { origin, edge_u, edge_v } = thing.kind else { return None };
            let to_world = thing.object.world_from_object;
            let (u, v) = (to_world.transform_vector3(edge_u.value), to_world.transform_vector3(edge_v.value));
            // A mirror image shines to the same side of what is around it.
            let (u, v) = if to_world.matrix3.determinant() < 0.0 { (v, u) } else { (u, v) };
            Panel::of(to_world.transform_point3(*origin), u, v, thing.object.span, Some(index))
        });
        lights.chain(quads).collect()
    }

    /// A light with nothing before it: no object, no camera that would see it shine.
    fn away(&self, panel: &Panel) -> Option<SpaceError> {
        let slack = ROUNDING * panel.corners.iter().map(|p| p.length()).fold(panel.size(), f64::max);
        let is_before = |region: &Region| panel.reach(region) > slack;
        let others = || self.things.iter().enumerate().filter(|(index, _)| panel.owner != Some(*index));
        let anything = self.eyes.iter().any(is_before)
            || others().any(|(_, thing)| match &thing.region {
                Some(region) => is_before(region),
                None => panel.meets_plane(thing, slack),
            });
        let is_seen = !self.eyes.is_empty() && others().next().is_some();
        (!anything && is_seen).then_some(SpaceError::LightFacesAway { light: panel.span, help: panel.cure() })
    }

    /// A light whose way is barred all over by something flat and opaque.
    fn against_wall(&self, panel: &Panel) -> Option<SpaceError> {
        let opaque = self.things.iter().filter(|thing| thing.stuff.is_opaque);
        let wall = opaque.filter(|thing| panel.is_covered_by(thing)).map(|thing| thing.object.span).next()?;
        Some(SpaceError::LightAgainstWall { light: panel.span, wall, help: panel.cure() })
    }
}

impl Panel {
    /// What to write instead.
    fn cure(&self) -> &'static str {
        match self.owner {
            None => {
                "it shines to the side of `edge_u` x `edge_v`: let them change places, or write `two_sided: true`"
            }
            Some(_) => "it shines to the side of `edge_u` x `edge_v`: let them change places",
        }
    }

    /// Whether some of an endless plane lies before this light; all of it that is not parallel does.
    fn meets_plane(&self, thing: &Thing<'_>, slack: f64) -> bool {
        let Some((n, offset)) = plane_of(thing) else { return true };
        let is_parallel = n.cross(self.normal).length() <= ROUNDING;
        !is_parallel || self.normal.dot(n * offset - self.corners[0]) > slack
    }

    fn is_covered_by(&self, thing: &Thing<'_>) -> bool {
        if let Some((n, offset)) = plane_of(thing) {
            return self.is_near(n, n * offset);
        }
        match (thing.kind, &thing.region) {
            (ShapeKind::Quad { .. }, Some(Region::Hull(p))) => {
                let [o, u, v] = [p[0], p[1] - p[0], p[3] - p[0]];
                u.cross(v).try_normalize().is_some_and(|n| self.is_near(n, o)) && self.is_within(o, u, v)
            }
            (ShapeKind::Box { .. }, Some(Region::Hull(p))) => {
                let axes = [p[1] - p[0], p[2] - p[0], p[4] - p[0]];
                (0..6).any(|face| {
                    let (u, v, w) = (axes[face % 3], axes[(face + 1) % 3], axes[(face + 2) % 3]);
                    let o = if face < 3 { p[0] } else { p[0] + w };
                    u.cross(v).try_normalize().is_some_and(|n| self.is_near(n, o)) && self.is_within(o, u, v)
                })
            }
            _ => false,
        }
    }

    /// Whether a plane through `p` with the unit normal `n` lies before this light and next to it.
    fn is_near(&self, n: DVec3, p: DVec3) -> bool {
        let distance = self.normal.dot(p - self.corners[0]);
        let slack = ROUNDING * p.length().max(self.size());
        n.cross(self.normal).length() < GAP * GAP && slack < distance && distance < GAP * self.size()
    }

    /// Whether all of it lies over a parallelogram.
    fn is_within(&self, origin: DVec3, u: DVec3, v: DVec3) -> bool {
        let n = u.cross(v);
        self.corners.iter().all(|&corner| {
            let p = corner - origin;
            let (s, t) = (p.cross(v).dot(n) / n.length_squared(), u.cross(p).dot(n) / n.length_squared());
            (-ROUNDING..=1.0 + ROUNDING).contains(&s) && (-ROUNDING..=1.0 + ROUNDING).contains(&t)
        })
    }
}
