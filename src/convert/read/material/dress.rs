//! Pictures of materials.

use crate::convert::dialect::Dialect;
use crate::convert::fields::{Field, Fields};
use crate::convert::model::Asset;
use crate::convert::model::Look;
use crate::convert::read::Reader;
use crate::convert::read::background::is_readable;
use crate::convert::words::normalised;

impl Reader<'_> {
    /// Puts a material's picture in the place of its colour; glass and lamps have none that it could replace.
    pub(super) fn dress(&mut self, look: &mut Look, fields: &mut Fields<'_>, notes: &mut Vec<String>) {
        if let Some(noise) = fields.take_block(|name| normalised(name) == "noise") {
            self.noise_inside(noise, look, notes);
        }
        if let Some(inner) = fields.take_block(|name| normalised(name) == "fresnel") {
            self.log.drop_all(&inner.span, "reflection by the angle of view is that of the material here");
        }
        if let Some(field) = self.log.take(fields, "texture") {
            if self.is_classic() && self.dialect == Dialect::Pa1 {
                return self.log.ignored(&field.span, "the original reads it and shows no picture");
            }
            self.picture_of(look, &field, notes);
        }
        for (role, what) in [
            ("bump", "a bump map"),
            ("normal map", "a map of normals"),
            ("specular map", "a map of anything but colour"),
        ] {
            let Some(field) = self.log.take(fields, role) else { continue };
            if self.dialect.is_mit() && role == "bump" {
                self.log.ignored(&field.span, "the original reads it and does nothing with it");
                continue;
            }
            self.log.dropped(&field.span, format!("{what} is not read yet"));
            self.note_not_read(what, &field.span, "left out");
        }
    }

    fn picture_of(&mut self, look: &mut Look, field: &Field<'_>, notes: &mut Vec<String>) {
        let Some(picture) = self.picture(field, notes) else { return };
        let mut slots = look.textures();
        if slots.is_empty() {
            self.log.dropped(&field.span, "a picture where no colour is that it could replace");
            return self.log.not_convertible(
                "this picture",
                &field.span,
                "glass and lamps are of one colour",
            );
        }
        for slot in &mut slots {
            slot.picture = Some(picture.clone());
        }
        if !field.numbers.is_empty() && field.word.is_some() {
            let said: Vec<&str> = field.numbers.iter().map(|number| number.text).collect();
            let said = said.join(" ");
            notes.push(format!(
                "The original says {said} after its picture, usually how often it repeats: see `uv_scale`."
            ));
        }
        self.log.approximated(&field.span, "`image`, laid on by the shape's own uv coordinates");
        self.log.differs(
            "how a picture is laid on differs from program to program",
            &field.span,
            "compare with the original, and turn or scale it by `uv_scale` and `uv_offset`",
        );
    }

    /// The picture that a field names, by its file or by its place in the list of textures.
    pub(in crate::convert::read) fn picture(
        &mut self,
        field: &Field<'_>,
        notes: &mut Vec<String>,
    ) -> Option<Asset> {
        let asset = match &field.word {
            Some(word) if !word.text.contains('.') => {
                self.log.mapped(&field.span, "no picture");
                return None;
            }
            Some(word) => self.asset(word),
            None => {
                let index = field.number(0);
                let listed = (index >= 0.0).then(|| self.textures.get(index as usize).cloned()).flatten();
                if listed.is_none() {
                    self.log.dropped(&field.span, "no such picture is listed");
                }
                listed?
            }
        };
        if !is_readable(&asset.path) {
            self.log.dropped(&field.span, "a kind of picture that cannot be read; the colour stands in");
            self.log.not_convertible(
                "this picture",
                &field.span,
                "the renderer reads PNG, JPEG, BMP, TGA, PPM, HDR and EXR; convert it and write `image(..)` for the colour",
            );
            notes.push(format!(
                "Its picture {} is of a kind that cannot be read; convert it to PNG.",
                asset.path
            ));
            return None;
        }
        Some(asset)
    }
}
