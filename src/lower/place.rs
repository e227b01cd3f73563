//! Where objects are: their extent in the world, in double precision.

use crate::ir::{Curve, Object, ShapeKind};
use crate::load::Loaded;
use crate::math::{DAffine3, DVec2, DVec3};

/// A box in double precision; `None` for what is endless or left out.
pub type Extent = Option<(DVec3, DVec3)>;

/// The smallest box along the axes that is known to hold an object; endless planes have none.
pub fn object_bounds(object: &Object, loaded: &Loaded<'_>) -> Extent {
    let (min, max) = shape_bounds(object, loaded)?;
    extent(corners(min, max).map(|corner| object.world_from_object.transform_point3(corner)))
}

fn corners(min: DVec3, max: DVec3) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |i| {
        let pick = |bit: u32, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
        DVec3::new(pick(0, min.x, max.x), pick(1, min.y, max.y), pick(2, min.z, max.z))
    })
}

/// The box of a profile turned about the y axis.
fn turned_bounds(profile: &Curve) -> Extent {
    let (min, max) = curve_bounds(profile)?;
    let reach = max.x.max(-min.x);
    Some((DVec3::new(-reach, min.y, -reach), DVec3::new(reach, max.y, reach)))
}

/// The middle of all that is bounded, but for what is more than a thousand times as large as most of it: around a ball as
/// large as a planet that serves as a floor, what stands on it would be left without digits.
pub fn scene_center(loaded: &Loaded<'_>) -> DVec3 {
    const MOST: f64 = 1e3;
    let boxes = loaded.scene.objects.iter().filter_map(|object| object_bounds(object, loaded));
    let boxes: Vec<_> = boxes.collect();
    let size = |(min, max): &(DVec3, DVec3)| (*max - *min).max_element();
    let mut sizes: Vec<f64> = boxes.iter().map(size).collect();
    sizes.sort_by(f64::total_cmp);
    let usual = sizes.get(sizes.len().saturating_sub(1) / 2).copied().unwrap_or(0.0);
    let near = boxes.iter().filter(|bounds| size(bounds) <= MOST * usual);
    extent(near.flat_map(|&(min, max)| [min, max])).map_or(DVec3::ZERO, |(min, max)| (min + max) / 2.0)
}

fn extent(points: impl IntoIterator<Item = DVec3>) -> Extent {
    points.into_iter().fold(None, |extent, p| match extent {
        None => Some((p, p)),
        Some((min, max)) => Some((min.min(p), max.max(p))),
    })
}

fn shape_bounds(object: &Object, loaded: &Loaded<'_>) -> Extent {
    match &loaded.scene.shapes[object.shape].kind {
        ShapeKind::Plane { .. } => None,
        // Along each axis a disk reaches at most its radius, as a ball does.
        ShapeKind::Sphere { center, radius } | ShapeKind::Disk { center, radius, .. } => {
            Some((*center - radius.value, *center + radius.value))
        }
        ShapeKind::Quad { origin, edge_u, edge_v } => {
            let (u, v) = (edge_u.value, edge_v.value);
            extent([*origin, *origin + u, *origin + v, *origin + u + v])
        }
        ShapeKind::Box { min, max } => Some((min.value, max.value)),
        ShapeKind::Triangle { corners } => extent(corners.map(|corner| corner.value)),
        ShapeKind::Mesh { scale, .. } => {
            let model = &loaded.mesh(object.shape)?.model;
            let positions = model.parts.iter().flat_map(|part| &part.positions);
            extent(positions.map(|p| p.as_dvec3() * scale.value))
        }
        kind @ (ShapeKind::Cone { .. } | ShapeKind::Torus { .. }) => {
            let turned = kind.turned()?;
            let (min, max) = turned_bounds(&turned.profile)?;
            extent(corners(min, max).map(|corner| turned.object_from_profile.transform_point3(corner)))
        }
        ShapeKind::Sweep { path, radius, end_radius, .. } => {
            let reach = end_radius.map_or(radius.value, |end| end.value.max(radius.value));
            let (min, max) = extent(path.points.iter().copied())?;
            Some((min - reach, max + reach))
        }
        ShapeKind::Heightfield { heights, size, .. } => {
            let (low, high) = heights.range();
            extent([DVec3::new(0.0, low, 0.0) * size.value, DVec3::new(1.0, high, 1.0) * size.value])
        }
        ShapeKind::Revolve { profile, .. } => turned_bounds(profile),
        ShapeKind::Extrude { outline, depth, .. } => {
            let (min, max) = curve_bounds(outline)?;
            Some((min.extend(0.0), max.extend(depth.value)))
        }
    }
}

/// The box of the control points, which holds the curve.
fn curve_bounds(curve: &Curve) -> Option<(DVec2, DVec2)> {
    let first = *curve.points.first()?;
    Some(curve.points.iter().fold((first, first), |(min, max), p| (min.min(*p), max.max(*p))))
}

/// Whether a transform keeps angles: a rotation, mirror, uniform scale or shift.
pub fn is_similarity(transform: &DAffine3) -> bool {
    let m = transform.matrix3;
    let (x, y, z) = (m.x_axis.length_squared(), m.y_axis.length_squared(), m.z_axis.length_squared());
    let size = x.max(y).max(z);
    let close = |a: f64| a.abs() <= 1e-12 * size; // f64 rounding of a few products
    let square = [m.x_axis.dot(m.y_axis), m.y_axis.dot(m.z_axis), m.z_axis.dot(m.x_axis)];
    close(x - y) && close(y - z) && square.into_iter().all(close)
}
