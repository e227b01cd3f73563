//! Where the middle of a scene is, roughly: lights that do not fall off in the original are matched there.

use crate::convert::model::{Object, Shape, Step};
use crate::math::DVec3;

/// The middle of the box around the middles of all bounded shapes; the origin where there are none.
pub fn of(objects: &[Object]) -> DVec3 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    middles(objects, &mut Vec::new(), &mut |p| {
        low = low.min(p);
        high = high.max(p);
    });
    if low.is_finite() && high.is_finite() { 0.5 * (low + high) } else { DVec3::ZERO }
}

fn middles<'a>(objects: &'a [Object], outer: &mut Vec<&'a [Step]>, visit: &mut dyn FnMut(DVec3)) {
    for object in objects {
        outer.push(&object.steps);
        let own = match &object.shape {
            Shape::Group(inner) => {
                middles(inner, outer, visit);
                None
            }
            Shape::Plane { .. } => None,
            Shape::Sphere { center, .. } => Some(*center),
            Shape::Triangle { corners: [a, b, c] } => Some((*a + *b + *c) / 3.0),
            Shape::Quad { origin, edge_u, edge_v } => Some(*origin + 0.5 * (*edge_u + *edge_v)),
            Shape::Disk { center, .. } => Some(*center),
            Shape::Cuboid { min, max } => Some(0.5 * (*min + *max)),
            Shape::Cylinder { base, top, .. } => Some(0.5 * (*base + *top)),
            Shape::Mesh { .. } | Shape::Torus { .. } => Some(DVec3::ZERO),
            Shape::Revolve { profile } => {
                let heights = || profile.points.iter().map(|point| point.1);
                let sum =
                    heights().fold(f64::INFINITY, f64::min) + heights().fold(f64::NEG_INFINITY, f64::max);
                Some(0.5 * sum * DVec3::Y)
            }
        };
        if let Some(p) = own {
            visit(outer.iter().rev().flat_map(|steps| steps.iter()).fold(p, |p, step| step.apply(p)));
        }
        outer.pop();
    }
}
