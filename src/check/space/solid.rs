//! Solids: whether something lies wholly inside or wholly outside of them. What cannot be said for certain is not said.

use super::region::{Extent, Region};
use super::surface::Surface;
use crate::check::curve;
use crate::ir::{Curve, CurveKind, ShapeKind};
use crate::math::{DAffine3, DVec2, DVec3};
use std::rc::Rc;

/// Rounding of what is compared with 1.
const ROUNDING: f64 = 1e-9;
/// Where a tessellation may leave its shape, as a share of its size: more than any that is rendered does.
const TESSELLATION: f64 = 4e-3;
/// Triangles looked at for one question, at most: beyond, none is answered.
const MOST_TRIANGLES: usize = 2_000_000;

/// Something with an inside, placed in the world.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub(super) form: Form,
    own_from_world: DAffine3,
    /// A box in the world that holds it.
    pub(super) extent: Extent,
}

/// The kinds of solids, each in a frame of its own.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// The unit ball.
    Ball,
    /// From −1 to 1 along each axis.
    Cube,
    /// A closed profile (radius, height), turned about the y axis.
    Turned(Loop),
    /// A closed outline with holes, from z = 0 to `depth`.
    Drawn { outline: Loop, holes: Vec<Loop>, depth: f64 },
    /// A closed surface of triangles.
    Closed(Rc<Surface>),
}

impl Form {
    /// What people call it.
    pub(super) const fn noun(&self) -> &'static str {
        match self {
            Self::Ball => "ball",
            Self::Cube => "box",
            Self::Turned(_) | Self::Drawn { .. } => "solid",
            Self::Closed(_) => "closed surface",
        }
    }
}

impl Solid {
    /// The solid that a shape encloses, placed by `world_from_object`; `None` where it has no certain inside. `mesh` gives
    /// the surface of a mesh, if that is closed.
    pub(super) fn of(
        kind: &ShapeKind,
        world_from_object: &DAffine3,
        mesh: impl FnOnce() -> Option<Rc<Surface>>,
    ) -> Option<Self> {
        let mut own_region = None;
        let (form, object_from_own, extent) = match kind {
            ShapeKind::Sphere { center, radius } => {
                let placed = DAffine3::from_scale_rotation_translation(
                    DVec3::splat(radius.value),
                    glam::DQuat::IDENTITY,
                    *center,
                );
                (Form::Ball, placed, None)
            }
            ShapeKind::Box { min, max } => {
                let (center, half) = ((min.value + max.value) / 2.0, (max.value - min.value) / 2.0);
                let placed = DAffine3::from_scale_rotation_translation(half, glam::DQuat::IDENTITY, center);
                (Form::Cube, placed, None)
            }
            ShapeKind::Revolve { profile, .. } => {
                (Form::Turned(Loop::of_profile(profile)?), DAffine3::IDENTITY, None)
            }
            ShapeKind::Cone { .. } | ShapeKind::Torus { .. } => {
                let turned = kind.turned()?;
                own_region = Region::of_profile(&turned.profile);
                (Form::Turned(Loop::of_profile(&turned.profile)?), turned.object_from_profile, None)
            }
            ShapeKind::Extrude { outline, holes, depth, .. } => {
                let holes = holes.iter().map(Loop::of_outline).collect::<Option<Vec<_>>>()?;
                let form = Form::Drawn { outline: Loop::of_outline(outline)?, holes, depth: depth.value };
                (form, DAffine3::IDENTITY, None)
            }
            ShapeKind::Mesh { .. } => {
                let surface = mesh()?;
                let extent = surface.extent()?;
                (Form::Closed(surface), DAffine3::IDENTITY, Some(extent))
            }
            _ => return None,
        };
        let world_from_own = *world_from_object * object_from_own;
        let region = match &form {
            Form::Ball => Region::Round { center: DVec3::ZERO, axes: crate::math::DMat3::IDENTITY },
            Form::Cube => Extent { min: DVec3::NEG_ONE, max: DVec3::ONE }.hull(),
            _ => own_region.or_else(|| Region::of_shape(kind, || extent))?,
        };
        let extent = region.moved(&world_from_own).extent();
        Some(Self { form, own_from_world: world_from_own.inverse(), extent })
    }

    /// A closed surface in the world.
    pub(super) fn closed(surface: Surface) -> Option<Self> {
        let extent = surface.extent()?;
        Some(Self { form: Form::Closed(Rc::new(surface)), own_from_world: DAffine3::IDENTITY, extent })
    }

    /// Whether all of `region` is inside, or all of it outside; `None` where it is neither, or that is not certain.
    pub(super) fn holds(&self, region: &Region) -> Option<bool> {
        self.holds_within(region, &region.extent())
    }

    /// The same for whoever asks often about one region, and knows the box around it.
    pub(super) fn holds_within(&self, region: &Region, extent: &Extent) -> Option<bool> {
        if !self.extent.touches(extent) {
            return Some(false);
        }
        let own = region.moved(&self.own_from_world);
        match &self.form {
            Form::Ball => {
                let (center, radius) = own.ball();
                let outside = center.length() - radius > 1.0 + ROUNDING;
                side(own.farthest(DVec3::ZERO) < 1.0 - ROUNDING, outside)
            }
            Form::Cube => {
                let reaches = DVec3::AXES.map(|axis| (own.support(axis), -own.support(-axis)));
                let inside = reaches.iter().all(|&(most, least)| most.max(-least) < 1.0 - ROUNDING);
                let outside = reaches.iter().any(|&(most, least)| least.max(-most) > 1.0 + ROUNDING);
                side(inside, outside)
            }
            form => {
                let (center, radius) = own.ball();
                form.holds_ball(center, radius)
            }
        }
    }

    /// Whether a point of the world lies inside; `None` where it is too near to the surface to say.
    pub(super) fn contains(&self, p: DVec3) -> Option<bool> {
        self.holds(&Region::point(p))
    }

    /// Points on its surface, which hangs together; none where it may not, or where they are too many.
    pub(super) fn surface_points(&self) -> Vec<DVec3> {
        let own = match &self.form {
            Form::Ball => DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).collect(),
            Form::Cube => cube_points(),
            Form::Turned(profile) => profile.turned_points(),
            Form::Drawn { outline, depth, .. } => outline.drawn_points(*depth),
            Form::Closed(_) => Vec::new(),
        };
        let world_from_own = self.own_from_world.inverse();
        own.into_iter().map(|p| world_from_own.transform_point3(p)).collect()
    }

    /// From its own frame, in which balls have the radius 1 and cubes go from −1 to 1, to the world.
    pub(super) fn world_from_own(&self) -> DAffine3 {
        self.own_from_world.inverse()
    }

    /// From the world to its own frame.
    pub(super) fn own_from_world(&self) -> &DAffine3 {
        &self.own_from_world
    }
}

impl Form {
    /// Whether a ball lies inside or outside of what is neither ball nor box.
    fn holds_ball(&self, center: DVec3, radius: f64) -> Option<bool> {
        match self {
            Self::Ball | Self::Cube => None,
            Self::Turned(profile) => {
                let p = DVec2::new(center.x.hypot(center.z), center.y);
                (profile.distance(p) > radius).then(|| profile.winding(p) != 0)
            }
            Self::Drawn { outline, holes, depth } => {
                let p = center.truncate();
                let size = outline.size.max(*depth) * ROUNDING;
                let (least, most) = (center.z - radius, center.z + radius);
                if most < -size || least > depth + size {
                    return Some(false);
                }
                let is_clear = std::iter::once(outline).chain(holes).all(|edge| edge.distance(p) > radius);
                let is_within = outline.winding(p) != 0 && holes.iter().all(|hole| hole.winding(p) == 0);
                match (is_clear, is_within) {
                    (true, false) => Some(false),
                    (true, true) => (least > size && most < depth - size).then_some(true),
                    (false, _) => None,
                }
            }
            Self::Closed(surface) => {
                let size = surface.extent().map_or(0.0, |extent| (extent.max - extent.min).max_element());
                let is_clear = surface.triangle_count() <= MOST_TRIANGLES
                    && surface.distance(center) > radius + ROUNDING * size;
                is_clear.then(|| surface.winding(center)).flatten().map(|turns| turns != 0)
            }
        }
    }
}

fn side(inside: bool, outside: bool) -> Option<bool> {
    match (inside, outside) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// Corners, middles of edges and middles of faces of the cube.
fn cube_points() -> Vec<DVec3> {
    let step = |i: i32| f64::from(i % 3 - 1);
    let grid = (0..27).map(|i| DVec3::new(step(i), step(i / 3), step(i / 9)));
    grid.filter(|p| *p != DVec3::ZERO).collect()
}

/// A closed line in the plane, known to within `slack`.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Loop {
    points: Vec<DVec2>,
    /// Whether the side from the last point to the first belongs to it; otherwise it lies on the axis, inside of the solid.
    is_whole: bool,
    /// How far the true line may be from this one.
    slack: f64,
    size: f64,
}

impl Loop {
    /// The profile of a surface of revolution that encloses something: closed, or from axis to axis.
    fn of_profile(profile: &Curve) -> Option<Self> {
        let points = curve::flatten(profile, false);
        let (first, last) = (points.first()?, points.last()?);
        let size = size(&points);
        let meet = first.distance(*last) <= ROUNDING * size;
        let on_axis = first.x.max(last.x) <= ROUNDING * size;
        let slack = slack(profile, size);
        (meet || on_axis).then_some(Self { is_whole: meet, slack, size, points })
    }

    /// An outline; `None` when it crosses itself, or has too many points to tell.
    fn of_outline(outline: &Curve) -> Option<Self> {
        let points = curve::flatten(outline, true);
        let is_simple = points.len() <= curve::MOST_PIECES && curve::crossing(&points).is_none();
        let size = size(&points);
        is_simple.then(|| Self { is_whole: true, slack: slack(outline, size), size, points })
    }

    fn sides(&self) -> impl Iterator<Item = (DVec2, DVec2)> {
        self.points.iter().copied().zip(self.points.iter().copied().cycle().skip(1))
    }

    /// How often it goes round a point, by the crossings of the ray to the right (Sunday 2001).
    fn winding(&self, p: DVec2) -> i32 {
        let turn = |(a, b): (DVec2, DVec2)| {
            let left = (b - a).perp_dot(p - a);
            i32::from(a.y <= p.y && p.y < b.y && left > 0.0)
                - i32::from(b.y <= p.y && p.y < a.y && left < 0.0)
        };
        self.sides().map(turn).sum()
    }

    /// No point of the true line is nearer than this.
    fn distance(&self, p: DVec2) -> f64 {
        let count = self.points.len() - usize::from(!self.is_whole);
        let squared = |(a, b): (DVec2, DVec2)| {
            let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            let nearest = if a == b { a } else { a.lerp(b, along) };
            nearest.distance_squared(p)
        };
        self.sides().take(count).map(squared).fold(f64::INFINITY, f64::min).sqrt() - self.slack
    }

    /// Points of the surface of revolution.
    fn turned_points(&self) -> Vec<DVec3> {
        const AROUND: u32 = 8;
        let directions =
            (0..AROUND).map(|i| DVec2::from_angle(f64::from(i) / f64::from(AROUND) * std::f64::consts::TAU));
        let directions: Vec<DVec2> = directions.collect();
        let ring = |p: &DVec2| {
            let p = *p;
            directions.iter().map(move |d| DVec3::new(p.x * d.x, p.y, p.x * d.y)).collect::<Vec<_>>()
        };
        self.points.iter().flat_map(ring).collect()
    }

    /// Points of the extruded surface.
    fn drawn_points(&self, depth: f64) -> Vec<DVec3> {
        self.points.iter().flat_map(|p| [p.extend(0.0), p.extend(depth)]).collect()
    }
}

fn size(points: &[DVec2]) -> f64 {
    let (min, max) = points
        .iter()
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), p| (min.min(*p), max.max(*p)));
    (max - min).max_element()
}

/// How far a curve may leave the points that stand for it, as they are here or as they are rendered.
fn slack(curve: &Curve, size: f64) -> f64 {
    match curve.kind {
        CurveKind::Polyline => TESSELLATION / 4.0 * size,
        _ => TESSELLATION * size + curve::chord_error(curve),
    }
}
