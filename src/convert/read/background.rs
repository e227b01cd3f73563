//! `Background`: what rays see that meet nothing, and the light that comes from everywhere.

use super::Reader;
use crate::convert::fields::Fields;
use crate::convert::model::{Asset, Background};
use crate::convert::parse::Block;
use crate::convert::words::BACKGROUND;
use crate::math::DVec3;

/// Pictures that the renderer can read.
const READABLE: &[&str] = &["png", "jpg", "jpeg", "hdr", "exr", "ppm", "pgm", "pbm", "pnm", "bmp", "tga"];

/// Whether a picture's ending is one that the renderer can read.
pub(super) fn is_readable(path: &str) -> bool {
    let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
    READABLE.iter().any(|known| known.eq_ignore_ascii_case(ending))
}

impl Reader<'_> {
    /// The colour of rays that meet nothing, 0.5 grey where the file has none.
    ///
    /// MIT's editions add an ambient light to it, `ambient * diffuse` on every surface, which a constant environment
    /// of that radiance gives a surface that sees all of it; and without any light the ambient light is 1.
    pub(super) fn background(&mut self, block: Option<Block<'_>>, is_unlit: bool) -> Background {
        let mut background =
            Background { color: DVec3::splat(0.5), ambient: DVec3::ZERO, picture: None, notes: Vec::new() };
        if self.is_classic() && self.dialect.is_mit() && is_unlit {
            background.ambient = DVec3::ONE;
        }
        let Some(block) = block else {
            background.notes.push("The file has no `Background`; the original then takes this grey.".into());
            return background;
        };
        let mut fields = self.log.fields(block, &BACKGROUND);
        self.log.mapped(&fields.head, "`environment`");
        if let Some(field) = self.log.take(&mut fields, "color") {
            background.color = self.light_colour(&field);
            if self.is_classic() {
                self.log.mapped(&field.span, "what rays see that meet nothing");
            } else if background.color == DVec3::ZERO {
                self.log.mapped(&field.span, "black, which is what an empty scene shows");
            } else {
                let how = "a constant `environment`, which also lights the scene";
                self.log.approximated(&field.span, how);
            }
        }
        self.ambient(&mut fields, &mut background, is_unlit);
        background.picture = self.sky(&mut fields, &mut background.notes);
        self.log.finish(fields);
        background
    }

    fn ambient(&mut self, fields: &mut Fields<'_>, background: &mut Background, is_unlit: bool) {
        let field = self.log.take(fields, "ambient");
        let ambient = field.as_ref().map_or(DVec3::ZERO, |field| field.vector().max(DVec3::ZERO));
        if self.is_classic() {
            if let Some(field) = field {
                self.log.mapped(&field.span, "`ambient`");
                background.ambient = if is_unlit { DVec3::ONE } else { ambient };
            }
        } else if self.dialect.is_mit() && is_unlit {
            background.color = DVec3::ONE;
            background.notes.push("Without any light the original's ambient light is 1.".into());
            if let Some(field) = field {
                self.log.approximated(&field.span, "1, for there is no light; a constant `environment`");
            }
        } else if let Some(field) = field {
            if ambient == DVec3::ZERO {
                self.log.mapped(&field.span, "no ambient light");
            } else if background.color == DVec3::ZERO {
                self.log.approximated(&field.span, "a constant `environment`, which is also seen");
                background.color = ambient;
                let note = "The original's ambient light; its background is black, here this is seen there.";
                background.notes.push(note.into());
            } else {
                self.log.dropped(&field.span, "the background lights the scene in its place");
                self.log.differs(
                    "the ambient light and the background differ in colour",
                    &field.span,
                    "the environment has the colour of the background, and lights the scene by it",
                );
            }
        }
    }

    /// A picture of everything around, if it is a single one that can be read.
    fn sky(&mut self, fields: &mut Fields<'_>, notes: &mut Vec<String>) -> Option<Asset> {
        if let Some(field) = self.log.take(fields, "cube map") {
            self.log.dropped(&field.span, "six pictures in a folder; the colour stands in");
            self.log.not_convertible(
                "a cube map",
                &field.span,
                "an environment is one picture, as wide as the whole circle; the background's colour stands in",
            );
            let path = field.text().replace('"', "");
            notes.push(format!(
                "Stands in for the six pictures of {path}: join them to an equirectangular one for `image`."
            ));
        }
        let field = self.log.take(fields, "picture")?;
        let word = field.word.as_ref()?;
        if !is_readable(word.text) {
            self.log.dropped(&field.span, "a kind of picture that cannot be read; the colour stands in");
            self.log.not_convertible(
                "this picture",
                &field.span,
                "the renderer reads PNG, JPEG, BMP, TGA, PPM, HDR and EXR; convert it and write `radiance: image(..)`",
            );
            return None;
        }
        self.log.approximated(&field.span, "`image`, as an equirectangular one");
        Some(self.asset(word))
    }
}
