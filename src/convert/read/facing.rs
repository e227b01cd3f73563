//! Planes and the camera: whether one is seen from its side, and how much of one that glows matters.

use super::{Dialect, Reader};
use crate::convert::Planes;
use crate::convert::model::{Object, Shape};
use crate::math::DVec3;

/// How many times the size of what is known of the scene a plane of light reaches.
const REACH: f64 = 100.0;

impl Reader<'_> {
    /// Whether the camera is behind a plane that can only be seen from the front.
    ///
    /// Planes of the dialect of weights have one side, and its cameras like to stand behind the front wall.
    pub(super) fn is_seen_through(&self, normal: DVec3, offset: f64) -> bool {
        let one_sided = match self.options.planes {
            Planes::Auto => self.dialect == Dialect::Weights,
            Planes::OneSided => true,
            Planes::TwoSided => false,
        };
        let is_behind = |camera: DVec3| normal.dot(camera) < offset;
        one_sided && self.transform_depth == 0 && self.camera_center.is_some_and(is_behind)
    }

    /// A plane of light has no end and so no power; a wide square, facing the camera, stands for it. Groups of light are
    /// looked through.
    pub(super) fn bound(&mut self, object: &mut Object) {
        if let Shape::Group(inner) = &mut object.shape {
            for object in inner {
                self.bound(object);
            }
        }
        let Shape::Plane { normal, offset, .. } = object.shape else { return };
        let camera = self.camera_center.filter(|_| self.transform_depth == 0).unwrap_or_default();
        let height = normal.dot(camera) - offset;
        let reach = REACH * offset.abs().max(camera.length()).max(1.0);
        let across = if normal.x.abs() < 0.9 { DVec3::X } else { DVec3::Z };
        let u = (across - normal * across.dot(normal)).normalize() * reach;
        let v = normal.cross(u) * height.signum();
        let foot = camera - normal * height;
        object.shape = Shape::Quad { origin: foot - u - v, edge_u: 2.0 * u, edge_v: 2.0 * v };
        object.notes.push("Stands for an endless plane of light.".into());
        self.log.approximated(&object.span, "a wide `quad`, for what is endless cannot shine");
        let help = "a wide square stands for it, and shines to the side of the camera";
        self.log.differs("an endless plane shines", &object.span.clone(), help);
    }
}
