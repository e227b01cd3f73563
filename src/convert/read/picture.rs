//! Pictures that belong to one object rather than to its material.

use super::Reader;
use crate::convert::fields::Fields;
use crate::convert::model::Object;

impl Reader<'_> {
    /// `Plane { .. texture FILE }`, and the frames in which some programs lay it, which are lost.
    pub(super) fn object_picture(&mut self, fields: &mut Fields<'_>, object: &mut Object) {
        if let Some(switch) = self.log.take(fields, "texture switch") {
            self.log.dropped(&switch.span, "how the material's picture is laid on; uv coordinates are used");
        }
        let Some(field) = self.log.take(fields, "texture") else { return };
        let had_picture = object.picture.is_some();
        object.picture = self.picture(&field, &mut object.notes);
        if object.picture.is_some() && !had_picture {
            self.log.approximated(&field.span, "`image`, laid on by the shape's own uv coordinates");
            self.log.differs(
                "how a picture is laid on differs from program to program",
                &field.span,
                "compare with the original, and turn or scale it by `uv_scale` and `uv_offset`",
            );
        }
    }
}
