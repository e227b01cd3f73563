//! Planes, and the pictures that the renderer of arsenal.txt lays on them.

use super::{Dialect, Mistake, Reader, vocab};
use crate::convert::fields::Fields;
use crate::convert::model::{PlanePicture, Shape};
use crate::convert::parse::Block;
use crate::math::DVec3;

/// Normals within this distance of unit length count as unit vectors.
const UNIT_TOLERANCE: f64 = 1e-3;

impl Reader<'_> {
    /// `normal . p = offset`, with the normal as long as it was written.
    pub(super) fn plane(&mut self, block: Block<'_>) -> Option<Shape> {
        let (span, head) = (block.span.clone(), block.head.clone());
        let mut fields = self.log.fields(block, vocab::PLANE);
        self.log.mapped(&fields.head, "`plane`");
        let normal = self.log.need(&mut fields, "normal");
        let offset = self.log.need_number(&mut fields, "offset", "offset of the plane");
        let picture = self.plane_picture(&mut fields);
        self.log.finish(fields);

        let normal = normal?;
        let length = normal.vector().length();
        self.log.mapped(&normal.span, "`normal`");
        if length == 0.0 {
            self.bad_value(
                "the normal of this plane is the zero vector",
                &normal.span,
                "write the plane's normal",
            );
            return None;
        }
        if (length - 1.0).abs() > UNIT_TOLERANCE {
            let length = (length * 1e4).round() / 1e4;
            self.log.notes.note(Mistake::NormalNotUnit { length, at: normal.span.clone().into() });
        }
        let (normal, offset) = (normal.vector() / length, offset? / length);
        if self.is_seen_through(normal, offset) {
            self.log.drop_all(&span, "the camera is behind it, where this dialect's planes cannot be seen");
            let what = "a plane between the camera and the scene".into();
            let why = "programs of this dialect see through a plane from behind";
            self.log.notes.note(Mistake::NotConvertible { what, why, at: head.into() });
            return None;
        }
        Some(Shape::Plane { normal, offset, picture })
    }

    /// Planes of the dialect of weights have one side, and its cameras like to stand behind the front wall.
    fn is_seen_through(&self, normal: DVec3, offset: f64) -> bool {
        let is_behind = |camera: DVec3| normal.dot(camera) < offset;
        self.dialect == Dialect::Weights
            && self.transform_depth == 0
            && self.camera_center.is_some_and(is_behind)
    }

    fn plane_picture(&mut self, fields: &mut Fields<'_>) -> Option<PlanePicture> {
        let texture = self.log.take(fields, "texture")?;
        let axes = ["x-axis", "y-axis", "x-offset", "y-offset"];
        if !axes.iter().any(|key| fields.has(key)) {
            self.log.dropped(&texture.span, "without axes it is not read yet");
            self.note_not_read("a picture on a plane without axes".into(), &texture.span, "left out");
            return None;
        }
        self.log.approximated(
            &texture.span,
            "`image`, smooth between pixels, decoded as sRGB; the original does neither",
        );
        let file = texture.word.as_ref().map(|word| self.asset(word));
        let x_axis = self.log.need(fields, "x-axis");
        let y_axis = self.log.need(fields, "y-axis");
        let x_offset = self.log.need_number(fields, "x-offset", "`origin` of the picture");
        let y_offset = self.log.need_number(fields, "y-offset", "`origin` of the picture");
        for axis in [&x_axis, &y_axis].into_iter().flatten() {
            self.log.mapped(&axis.span, "`u` and `v` of the picture");
        }
        let (x_axis, y_axis) = (x_axis?, y_axis?);
        if x_axis.vector().cross(y_axis.vector()) == DVec3::ZERO {
            self.bad_value(
                "the axes of this picture are parallel",
                &y_axis.span,
                "write the direction of its height",
            );
            return None;
        }
        Some(PlanePicture {
            file: file?,
            x_axis: x_axis.vector(),
            y_axis: y_axis.vector(),
            x_offset: x_offset?,
            y_offset: y_offset?,
        })
    }
}
