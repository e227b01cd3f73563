//! Bounded parts of space that hold a thing: exact for what is round or straight, a box around it for the rest.

use crate::ir::{Camera, Curve, Lens, LightKind, Object, ShapeKind};
use crate::math::{DAffine3, DMat3, DVec2, DVec3, Motion};

/// A part of space. It holds all of a thing, so what is true of every point in it is true of the thing.
#[derive(Clone, PartialEq, Debug)]
pub enum Region {
    /// The convex hull of points.
    Hull(Vec<DVec3>),
    /// The unit ball, stretched by `axes` and moved to `center`; flat where a column is 0.
    #[expect(missing_docs, reason = "the sentence above names both")]
    Round { center: DVec3, axes: DMat3 },
}

/// A box along the axes of the world.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Extent {
    pub(super) min: DVec3,
    pub(super) max: DVec3,
}

impl Region {
    pub(super) fn point(p: DVec3) -> Self {
        Self::Hull(vec![p])
    }

    /// The region of a shape in its own frame; `None` for endless planes. `mesh` gives the box of a mesh's vertices.
    pub(super) fn of_shape(kind: &ShapeKind, mesh: impl FnOnce() -> Option<Extent>) -> Option<Self> {
        Some(match kind {
            ShapeKind::Plane { .. } => return None,
            ShapeKind::Sphere { center, radius } => Self::ball_at(*center, radius.value),
            ShapeKind::Disk { center, normal, radius } => Self::disk(*center, normal.value, radius.value)?,
            ShapeKind::Quad { origin, edge_u, edge_v } => {
                Self::parallelogram(*origin, edge_u.value, edge_v.value)
            }
            ShapeKind::Box { min, max } => Extent { min: min.value, max: max.value }.hull(),
            ShapeKind::Triangle { corners } => Self::Hull(corners.map(|corner| corner.value).to_vec()),
            ShapeKind::Mesh { .. } => mesh()?.hull(),
            ShapeKind::Cone { .. } | ShapeKind::Torus { .. } => {
                let turned = kind.turned()?;
                Self::of_profile(&turned.profile)?.moved(&turned.object_from_profile)
            }
            // The control points hold the path, and the tube reaches no farther from it than its radius.
            ShapeKind::Sweep { path, radius, end_radius, .. } => {
                let reach = end_radius.map_or(radius.value, |end| end.value.max(radius.value));
                let Extent { min, max } = Extent::of(path.points.iter().copied())?;
                Extent { min: min - reach, max: max + reach }.hull()
            }
            ShapeKind::Heightfield { heights, size, .. } => {
                let (low, high) = heights.range();
                let (y, z) = ([low, high].map(|share| share * size.value.y), size.value.z);
                let min = DVec3::new(0.0, y[0].min(y[1]), 0.0);
                Extent { min, max: DVec3::new(size.value.x, y[0].max(y[1]), z) }.hull()
            }
            ShapeKind::Revolve { profile, .. } => Self::of_profile(profile)?,
            ShapeKind::Extrude { outline, depth, .. } => {
                let (min, max) = control_box(outline)?;
                Extent { min: min.extend(0.0), max: max.extend(depth.value) }.hull()
            }
        })
    }

    /// The region of an object in its place, from that in its own frame: of what moves a box around all that it passes while
    /// a shutter is open for such a share of the frame.
    pub(super) fn placed(&self, object: &Object, shutter: f64) -> Self {
        let motion = object.motion.as_ref();
        match motion.and_then(|motion| motion.part(DAffine3::IDENTITY, shutter, DAffine3::IDENTITY)) {
            Some(motion) => self.swept(&motion),
            None => self.moved(&object.world_from_object),
        }
    }

    /// A box around all that it passes.
    fn swept(&self, motion: &Motion) -> Self {
        let Extent { min, max } = self.extent();
        let (min, max) = motion.sweep_box(min, max);
        Extent { min, max }.hull()
    }

    /// The region of a profile turned about the y axis.
    pub(super) fn of_profile(profile: &Curve) -> Option<Self> {
        let (min, max) = control_box(profile)?;
        let reach = max.x.max(-min.x);
        let (min, max) = (DVec3::new(-reach, min.y, -reach), DVec3::new(reach, max.y, reach));
        Some(Extent { min, max }.hull())
    }

    /// The region of a light in the world; `None` for what shines from infinitely far.
    pub(super) fn of_light(kind: &LightKind) -> Option<Self> {
        match kind {
            LightKind::Point { position, .. } => Some(Self::point(*position)),
            LightKind::Sphere { center, radius } => Some(Self::ball_at(*center, radius.value)),
            LightKind::Rect { origin, edge_u, edge_v, .. } => {
                Some(Self::parallelogram(*origin, *edge_u, *edge_v))
            }
            LightKind::Spot { position, .. } => Some(Self::point(*position)),
            LightKind::Disk { center, edge_u, edge_v, .. } => {
                let axes = DMat3::from_cols(*edge_u, *edge_v, DVec3::ZERO);
                Some(Self::Round { center: *center, axes })
            }
            LightKind::Directional { .. } | LightKind::SunSky(_) => None,
        }
    }

    /// Where light enters a camera: a point, or the opening of its lens.
    pub(super) fn of_camera(camera: &Camera) -> Self {
        let still = Self::of_still_camera(camera);
        match camera.seen_motion() {
            Some(motion) => still.swept(&motion),
            None => still,
        }
    }

    fn of_still_camera(camera: &Camera) -> Self {
        let (position, direction) = (camera.position.value, camera.direction.value);
        match &camera.lens {
            Lens::Thin { radius, .. } if radius.value > 0.0 => {
                Self::disk(position, direction, radius.value).unwrap_or_else(|| Self::point(position))
            }
            _ => Self::point(position),
        }
    }

    fn ball_at(center: DVec3, radius: f64) -> Self {
        Self::Round { center, axes: DMat3::from_diagonal(DVec3::splat(radius)) }
    }

    fn disk(center: DVec3, normal: DVec3, radius: f64) -> Option<Self> {
        let (u, v) = normal.try_normalize()?.any_orthonormal_pair();
        Some(Self::Round { center, axes: DMat3::from_cols(u * radius, v * radius, DVec3::ZERO) })
    }

    pub(super) fn parallelogram(origin: DVec3, u: DVec3, v: DVec3) -> Self {
        Self::Hull(vec![origin, origin + u, origin + u + v, origin + v])
    }

    /// The region after a transform.
    pub(super) fn moved(&self, by: &DAffine3) -> Self {
        match self {
            Self::Hull(points) => Self::Hull(points.iter().map(|&p| by.transform_point3(p)).collect()),
            Self::Round { center, axes } => {
                Self::Round { center: by.transform_point3(*center), axes: by.matrix3 * *axes }
            }
        }
    }

    /// The largest `n · p` of its points p.
    pub fn support(&self, n: DVec3) -> f64 {
        match self {
            Self::Hull(points) => points.iter().map(|p| n.dot(*p)).fold(f64::NEG_INFINITY, f64::max),
            Self::Round { center, axes } => n.dot(*center) + (axes.transpose() * n).length(),
        }
    }

    /// The smallest box that holds it.
    pub(super) fn extent(&self) -> Extent {
        match self {
            Self::Hull(points) => {
                let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
                let (min, max) = points.iter().fold(empty, |(min, max), &p| (min.min(p), max.max(p)));
                Extent { min, max }
            }
            Self::Round { center, axes } => {
                let rows = axes.transpose();
                let reach = DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length());
                Extent { min: *center - reach, max: *center + reach }
            }
        }
    }

    /// A ball that holds it: the smallest for balls, a good one for the rest.
    pub fn ball(&self) -> (DVec3, f64) {
        match self {
            Self::Hull(_) => {
                let Extent { min, max } = self.extent();
                let center = (min + max) / 2.0;
                (center, self.farthest(center))
            }
            Self::Round { center, axes } => (*center, stretch(axes)),
        }
    }

    /// No point of it is farther from `p` than this.
    pub(super) fn farthest(&self, p: DVec3) -> f64 {
        match self {
            Self::Hull(points) => points.iter().map(|q| q.distance(p)).fold(0.0, f64::max),
            Self::Round { center, axes } => center.distance(p) + stretch(axes),
        }
    }
}

impl Extent {
    /// The box around points; `None` without any.
    pub(super) fn of(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        points.into_iter().fold(None, |extent: Option<Self>, p| match extent {
            None => Some(Self { min: p, max: p }),
            Some(Self { min, max }) => Some(Self { min: min.min(p), max: max.max(p) }),
        })
    }

    pub(super) fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether two boxes have a point in common.
    pub(super) fn touches(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Larger on each side by a share of its size.
    pub(super) fn grown(&self, share: f64) -> Self {
        let more = DVec3::splat(share * (self.max - self.min).max_element());
        Self { min: self.min - more, max: self.max + more }
    }

    pub(super) fn volume(&self) -> f64 {
        (self.max - self.min).element_product()
    }

    pub(super) fn hull(&self) -> Region {
        let pick = |bit: u32, low: f64, high: f64| if bit == 0 { low } else { high };
        let corner = |i: u32| {
            let (min, max) = (self.min, self.max);
            let x = pick(i & 1, min.x, max.x);
            DVec3::new(x, pick(i >> 1 & 1, min.y, max.y), pick(i >> 2 & 1, min.z, max.z))
        };
        Region::Hull((0..8).map(corner).collect())
    }
}

/// The box of the control points, which holds the curve.
fn control_box(curve: &Curve) -> Option<(DVec2, DVec2)> {
    let first = *curve.points.first()?;
    Some(curve.points.iter().fold((first, first), |(min, max), p| (min.min(*p), max.max(*p))))
}

/// The most by which a matrix lengthens a vector: exact where it keeps angles, at most √3 times too much elsewhere.
fn stretch(m: &DMat3) -> f64 {
    /// Rounding of a few products.
    const EVEN: f64 = 1e-12;
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let size = x.length_squared().max(y.length_squared()).max(z.length_squared());
    let even = |a: f64| a.abs() <= EVEN * size;
    let square = even(x.dot(y)) && even(y.dot(z)) && even(z.dot(x));
    match square {
        true => size.sqrt(),
        false => (x.length_squared() + y.length_squared() + z.length_squared()).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_is_held_exactly_wherever_it_is_turned() {
        let ball = Region::ball_at(DVec3::new(1.0, 2.0, 3.0), 2.0);
        let turned = ball.moved(&DAffine3::from_rotation_y(0.7));
        let (center, radius) = turned.ball();
        assert!((radius - 2.0).abs() < 1e-12 && (center.y - 2.0).abs() < 1e-12);
        assert!((turned.support(DVec3::Y) - 4.0).abs() < 1e-12);
    }

    #[test]
    fn a_box_around_a_region_reaches_as_far_as_its_points() {
        let turn = DAffine3::from_rotation_z(0.4) * DAffine3::from_scale(DVec3::new(1.0, 2.0, 3.0));
        let cube = Extent { min: DVec3::ZERO, max: DVec3::ONE }.hull();
        for region in [Region::ball_at(DVec3::ONE, 2.0), cube].map(|region| region.moved(&turn)) {
            let Extent { min, max } = region.extent();
            for (axis, (least, most)) in
                DVec3::AXES.into_iter().zip(min.to_array().into_iter().zip(max.to_array()))
            {
                assert!((region.support(axis) - most).abs() < 1e-12);
                assert!((region.support(-axis) + least).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_disk_is_flat_along_its_normal() {
        let disk = Region::disk(DVec3::ZERO, DVec3::new(0.0, 3.0, 0.0), 2.0).expect("it has a normal");
        assert_eq!(disk.support(DVec3::Y), 0.0);
        assert!((disk.support(DVec3::new(0.6, 0.0, 0.8)) - 2.0).abs() < 1e-12);
    }
}
