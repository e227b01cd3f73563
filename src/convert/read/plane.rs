//! Planes, and the pictures that the renderer of arsenal.txt lays on them.

use super::{Dialect, Mistake, Reader};
use crate::convert::PlaneSign;
use crate::convert::fields::Fields;
use crate::convert::model::{PlanePicture, Shape};
use crate::convert::parse::Span;
use crate::math::DVec3;

/// Normals within this distance of unit length count as unit vectors.
const UNIT_TOLERANCE: f64 = 1e-3;

impl Reader<'_> {
    /// `normal . p = offset`, with the normal as long as it was written.
    pub(super) fn plane(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        let (span, head) = (fields.span.clone(), fields.head.clone());
        self.log.mapped(&head, "`plane`");
        let normal = self.log.need(fields, "normal");
        let offset = self.log.need_number(fields, "offset", "offset of the plane");
        let picture = self.laid_picture(fields);
        let frame = "the frame of a picture, which is laid on by uv coordinates";
        self.log.put_aside(fields, &["p1", "p2", "p3", "p4", "origin"], frame);

        let normal = normal?;
        let direction = self.three(&normal)?;
        let length = direction.length();
        self.log.mapped(&normal.span, "`normal`");
        if length == 0.0 {
            self.log.bad_value(
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
        let (normal, mut offset) = (direction / length, offset? / length);
        if self.is_sign_opposite(&head) {
            offset = -offset;
        }
        if self.is_seen_through(normal, offset) {
            self.log.drop_all(&span, "the camera is behind it, where this dialect's planes cannot be seen");
            let why =
                "programs of this dialect see through a plane from behind; `--planes two-sided` keeps it";
            self.log.not_convertible("a plane between the camera and the scene", &head, why);
            return None;
        }
        Some(Shape::Plane { normal, offset, picture })
    }

    /// Whether `normal . p + offset = 0` is meant.
    fn is_sign_opposite(&mut self, head: &Span) -> bool {
        match self.options.plane_sign {
            PlaneSign::Same => false,
            PlaneSign::Opposite => true,
            PlaneSign::Auto => {
                if self.dialect == Dialect::Flags {
                    self.log.differs(
                        "a plane of a dialect that is not agreed on its side",
                        head,
                        "it was put where `normal . p = offset`; one program means `normal . p = -offset`, for \
                         which there is `--plane-sign opposite`",
                    );
                }
                false
            }
        }
    }

    /// A picture with axes in the plane.
    fn laid_picture(&mut self, fields: &mut Fields<'_>) -> Option<PlanePicture> {
        let axes = ["x-axis", "y-axis", "x-offset", "y-offset"];
        if !axes.iter().any(|key| fields.has(key)) {
            return None;
        }
        let texture = self.log.need(fields, "texture")?;
        let how = "`image`, smooth between pixels, decoded as sRGB; the original does neither";
        self.log.approximated(&texture.span, how);
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
            self.log.bad_value(
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
