//! Materials, each by the rules of its own dialect.

use super::{Dialect, Reader, vocab};
use crate::convert::dialect;
use crate::convert::error::Mistake;
use crate::convert::fields::{Field, Fields, Part};
use crate::convert::model::{Look, Material, Texture};
use crate::convert::parse::{Block, Span};
use crate::math::DVec3;

/// Words after `type`, and the lobe each of them means: 0 diffuse, 1 mirror, 2 glass.
const TYPE_WORDS: &[(&str, usize)] =
    &[("DIFF", 0), ("GLOS", 1), ("METAL", 1), ("SPEC", 1), ("REFR", 2), ("RFRE", 2), ("REFL", 2)];

/// Keys for the index of refraction in the dialects that pick a lobe by `type`.
const INDEX_KEYS: &[&str] = &["refr", "refraction", "refractive_rate", "refractive", "reflectRate"];

impl Reader<'_> {
    /// `Materials { numMaterials n .. }`. A block that is not read keeps its index as a placeholder.
    pub(super) fn materials(&mut self, block: Block<'_>) -> Vec<Material> {
        self.log.mapped(&block.head, "`let` bindings");
        let (mut materials, mut counts) = (Vec::new(), Vec::new());
        for part in self.log.parts(block.body, vocab::MATERIALS) {
            match part {
                Part::Field(field) if field.key == "numMaterials" => counts.push(field),
                Part::Field(field) => self.log.unknown_field(&field, "Materials", vocab::MATERIALS),
                Part::Block(block) => materials.push(self.material(block)),
            }
        }
        for count in counts {
            self.log.check_counts(&count, materials.len());
        }
        materials
    }

    pub(super) fn material(&mut self, block: Block<'_>) -> Material {
        let span = block.span.clone();
        Material { span, ..self.material_by_dialect(block) }
    }

    fn material_by_dialect(&mut self, block: Block<'_>) -> Material {
        let told = dialect::of_material(&block).map(|(dialect, _)| dialect);
        let dialect = match self.options.dialect {
            Some(forced) if told != Some(Dialect::Typed) => forced,
            // MIT's editions reflect and refract by the specular colour, which the course's does not.
            _ if self.dialect.is_mit() && block.words().any(|word| word == "specularColor") => self.dialect,
            _ => told.unwrap_or(self.dialect),
        };
        if !["Material", "PhongMaterial"].contains(&block.name()) {
            return match self.typed_material(block) {
                Ok(material) => material,
                Err(block) => self.unread_block(block, dialect),
            };
        }
        let fields = self.log.fields(block, vocab::MATERIAL);
        match dialect {
            Dialect::Arsenal => self.arsenal_material(fields),
            Dialect::Pa1 => self.pa1_material(fields),
            Dialect::Weights => self.weights_material(fields),
            Dialect::Enum => self.enum_material(fields),
            Dialect::Flags => self.flags_material(fields),
            Dialect::Factors => self.factors_material(fields),
            _ => self.unread_material(fields, dialect),
        }
    }

    /// A material of `arsenal.txt`: one of a matt surface, a mirror and glass, tinted by `color`; or a lamp.
    fn arsenal_material(&mut self, mut fields: Fields<'_>) -> Material {
        self.log.mapped(&fields.head, "a material");
        let mut notes = Vec::new();
        let color = self.log.take(&mut fields, "color");
        let tint = color.as_ref().map_or(DVec3::ONE, |field| self.reflectance(field));
        let emission = self.emission(&mut fields, "emissionColor");
        let kind = self.log.take(&mut fields, "reflection");
        let shininess = self.log.take(&mut fields, "shininess");
        if let Some(texture) = self.log.take(&mut fields, "texture") {
            self.log.ignored(&texture.span, "the original reads it and shows no picture");
        }
        self.log.finish(fields);

        let kind_number = kind.as_ref().map_or(0.0, |field| field.number(0));
        let look = match kind_number {
            _ if emission.is_some() => Look::Emissive { radiance: emission.unwrap_or_default() },
            1.0 => Look::Mirror { color: Texture::plain(tint) },
            // The original's glass has one index, and Schlick's approximation with R0 = 0.04, that of 1.5.
            2.0 => Look::Glass { ior: 1.5, tint },
            _ => Look::Diffuse { color: Texture::plain(tint) },
        };
        if let Some(kind) = &kind {
            self.log.mapped(&kind.span, "the kind of material: 0 diffuse, 1 mirror, 2 glass of index 1.5");
            if ![0.0, 1.0, 2.0].contains(&kind_number) {
                self.bad_value(
                    "`reflection` is 0, 1 or 2 in this dialect",
                    &kind.span,
                    "0 diffuse, 1 mirror, 2 glass",
                );
            }
        }
        self.tint_fate(color, &look);
        let look = self.arsenal_highlight(look, shininess, &mut notes);
        material(look, notes)
    }

    /// `shininess` adds, for each lamp and without a shadow test, `0.3 color (V.R)^shininess` to the diffuse light.
    fn arsenal_highlight(&mut self, look: Look, field: Option<Field<'_>>, notes: &mut Vec<String>) -> Look {
        let Some(field) = field else { return look };
        let shininess = field.number(0);
        match look {
            Look::Diffuse { color } if shininess > 0.0 => {
                self.log.approximated(&field.span, "`phong` with 0.3 of the colour as its highlight");
                notes.push(
                    "The original adds 0.3 of the colour as a highlight of each lamp, even where the lamp is hidden."
                        .into(),
                );
                let specular = 0.3 * color.color;
                Look::Phong { diffuse: color, specular, shininess }
            }
            look if shininess > 0.0 => {
                self.log.dropped(&field.span, "a highlight on a surface that is not diffuse");
                look
            }
            look => {
                self.log.mapped(&field.span, "no highlight");
                look
            }
        }
    }

    /// A material of the course: `diffuse max(0, L.N) + specular max(0, V.R)^shininess` for each light, no shadows.
    fn pa1_material(&mut self, mut fields: Fields<'_>) -> Material {
        self.log.mapped(&fields.head, "a material");
        let mut notes = Vec::new();
        let diffuse = self.log.take(&mut fields, "diffuseColor");
        let diffuse_color = diffuse.as_ref().map_or(DVec3::ONE, |field| self.reflectance(field));
        let specular = self.log.take(&mut fields, "specularColor");
        let specular_color = specular.as_ref().map_or(DVec3::ZERO, |field| self.reflectance(field));
        let shininess = self.log.take(&mut fields, "shininess");
        if let Some(field) = &diffuse {
            self.log.mapped(&field.span, "diffuse colour");
        }
        let mut matte = Look::Diffuse { color: Texture::plain(diffuse_color) };
        self.dress(&mut matte, &mut fields);
        self.log.finish(fields);

        if specular_color == DVec3::ZERO {
            for field in [&specular, &shininess].into_iter().flatten() {
                self.log.mapped(&field.span, "no highlight");
            }
            return material(matte, notes);
        }
        let specular_span = specular.map(|field| field.span).unwrap_or_default();
        let how = "a `phong` lobe whose highlight is as bright as the original's at its middle";
        self.log.approximated(&specular_span, how);
        let exponent = match &shininess {
            Some(field) => {
                self.log.mapped(&field.span, "`shininess`");
                field.number(0).clamp(0.0, 1e5)
            }
            None => 0.0,
        };
        if exponent == 0.0 {
            self.differs(
                "`specularColor` without `shininess` brightens the whole surface in the original",
                &specular_span,
                "it became a lobe of exponent 0, which is as wide; add `shininess` for a highlight",
            );
        }
        let color = match matte {
            Look::Diffuse { color } => color,
            _ => Texture::plain(diffuse_color),
        };
        let look = fitted_phong(color, specular_color, exponent, &mut notes);
        material(look, notes)
    }

    /// `type d s t`: the probabilities of a diffuse, a mirror and a refracted bounce, all tinted by one colour.
    fn weights_material(&mut self, mut fields: Fields<'_>) -> Material {
        self.log.mapped(&fields.head, "a material");
        let weights = self.weights(&mut fields);
        let index = self.index(&mut fields, &["refr"]).unwrap_or(1.0);
        for key in ["specularColor", "shininess"] {
            if let Some(field) = self.log.take(&mut fields, key) {
                self.log.ignored(&field.span, "used by the original's ray caster only");
            }
        }
        self.weighted(fields, weights, index)
    }

    /// `type WORD` or `type 0|1|2`: one lobe.
    fn enum_material(&mut self, mut fields: Fields<'_>) -> Material {
        self.log.mapped(&fields.head, "a material");
        let lobe = self.log.take(&mut fields, "type").map_or(0, |field| self.lobe(&field));
        let index = self.index(&mut fields, INDEX_KEYS).unwrap_or(1.0);
        let mut weights = [0.0; 3];
        weights[lobe] = 1.0;
        self.weighted(fields, weights, index)
    }

    /// What the weights of the three lobes make together with colour, light and picture.
    pub(super) fn weighted(&mut self, mut fields: Fields<'_>, weights: [f64; 3], index: f64) -> Material {
        let color = self.one_color(&mut fields);
        let tint = color.as_ref().map_or(DVec3::ONE, |field| self.reflectance(field));
        let emission = match self.emission(&mut fields, "emission") {
            Some(emission) => Some(emission),
            None => self.emission(&mut fields, "emissionColor"),
        };
        let mut look = match emission {
            Some(radiance) => Look::Emissive { radiance },
            None => blended(weights, Texture::plain(tint), index),
        };
        self.tint_fate(color, &look);
        self.dress(&mut look, &mut fields);
        if let Some(field) = self.log.take(&mut fields, "bump") {
            self.log.dropped(&field.span, "bump maps are not read yet");
            self.note_not_read("`bump`".into(), &field.span, "left out");
        }
        self.log.finish(fields);
        material(look, Vec::new())
    }

    /// Which lobe a word or integer after `type` means.
    fn lobe(&mut self, field: &Field<'_>) -> usize {
        let known = match &field.word {
            Some(word) => TYPE_WORDS.iter().find(|(name, _)| *name == word.text).map(|(_, lobe)| *lobe),
            None => [0.0, 1.0, 2.0].iter().position(|&kind| kind == field.number(0)),
        };
        let Some(lobe) = known else {
            self.log.dropped(&field.span, "an unknown kind of material, taken as diffuse");
            self.note_not_read("this kind of material".into(), &field.span, "taken as diffuse");
            return 0;
        };
        match field.word.as_ref().map_or("", |word| word.text) {
            "REFL" => {
                self.log.approximated(&field.span, "glass");
                let help = "in the program that has this word it means refraction; where it means a mirror write `SPEC`";
                self.differs("`REFL` was taken as refraction", &field.span, help);
            }
            "GLOS" | "METAL" => self.log.approximated(&field.span, "a perfect mirror"),
            _ => self.log.mapped(&field.span, ["`diffuse`", "`mirror`", "`glass`"][lobe]),
        }
        lobe
    }

    /// The three weights after `type`, normalised; diffuse alone where there are none.
    fn weights(&mut self, fields: &mut Fields<'_>) -> [f64; 3] {
        let Some(field) = self.log.take(fields, "type") else { return [1.0, 0.0, 0.0] };
        let weights = [0, 1, 2].map(|i| field.number(i).max(0.0));
        let sum: f64 = weights.iter().sum();
        if field.numbers.len() > 3 && field.number(3) != 0.0 {
            self.log.approximated(&field.span, "the first three weights; the fourth is not read");
            self.note_not_read("the fourth weight".into(), &field.span, "the first three were used");
        } else {
            self.log.mapped(&field.span, "which lobes, and how much of each");
        }
        if sum <= 0.0 {
            let help = "write the shares of diffuse, mirror and glass, such as `type 1 0 0`";
            self.bad_value("the weights of `type` are all 0", &field.span, help);
            return [1.0, 0.0, 0.0];
        }
        weights.map(|weight| weight / sum)
    }

    /// A material of a dialect that is not read: its colour and light, if they have a familiar name.
    pub(super) fn unread_material(&mut self, mut fields: Fields<'_>, dialect: Dialect) -> Material {
        let head = fields.head.clone();
        self.log.approximated(&head, "what is familiar of it");
        let color = self.one_color(&mut fields);
        let emission = match self.emission(&mut fields, "emission") {
            Some(emission) => Some(emission),
            None => self.emission(&mut fields, "emissionColor"),
        };
        let tint = color.as_ref().map(|field| self.reflectance(field));
        let look = match (emission, tint) {
            (Some(radiance), _) => Look::Emissive { radiance },
            (None, Some(color)) => Look::Diffuse { color: Texture::plain(color) },
            (None, None) => Look::Placeholder,
        };
        self.tint_fate(color, &look);
        self.log.finish_quietly(fields, "its dialect is not read yet");
        self.note_unread(dialect, &head, "only its colour and light were read");
        let notes = vec![format!("Of {}, which is not read yet: colour and light only.", dialect.title())];
        material(look, notes)
    }

    /// A kind of material block that is not read: grey.
    fn unread_block(&mut self, block: Block<'_>, dialect: Dialect) -> Material {
        self.log.dropped(&block.span, "its dialect is not read yet; a grey placeholder keeps its index");
        self.note_unread(dialect, &block.head, "a grey placeholder stands in");
        let notes = vec![format!("Stands in for a `{}`, which is not read yet.", block.name())];
        material(Look::Placeholder, notes)
    }

    fn note_unread(&mut self, dialect: Dialect, at: &Span, done: &'static str) {
        self.log.notes.note(Mistake::NotReadYet {
            what: "this material".into(),
            dialect: dialect.title().into(),
            at: at.clone().into(),
            done,
            help: None,
        });
    }

    /// `color` or `diffuseColor`, whichever comes last: they share a slot.
    pub(super) fn one_color<'t>(&mut self, fields: &mut Fields<'t>) -> Option<Field<'t>> {
        let color = self.log.take(fields, "color").or_else(|| self.log.take(fields, "mColor"));
        let diffuse = self.log.take(fields, "diffuseColor");
        match (color, diffuse) {
            (Some(a), Some(b)) => {
                let (first, last) = if a.span.start < b.span.start { (a, b) } else { (b, a) };
                self.log.repeated("color", &first.span, &last.span);
                Some(last)
            }
            (a, b) => a.or(b),
        }
    }

    /// What became of a material's colour.
    pub(super) fn tint_fate(&mut self, color: Option<Field<'_>>, look: &Look) {
        let Some(field) = color else { return };
        match look {
            Look::Emissive { .. } if field.vector() == DVec3::ZERO => {
                self.log.mapped(&field.span, "black: a lamp reflects nothing");
            }
            Look::Emissive { .. } => self.log.dropped(&field.span, "a lamp reflects nothing here"),
            Look::Glass { .. } => self.log.mapped(&field.span, "`tint`"),
            _ => self.log.mapped(&field.span, "colour"),
        }
    }

    /// A colour of a surface: each component in 0..=1, as no surface returns more than it receives.
    pub(super) fn reflectance(&mut self, field: &Field<'_>) -> DVec3 {
        let color = field.vector();
        let clamped = color.clamp(DVec3::ZERO, DVec3::ONE);
        if clamped != color {
            self.differs(
                "this surface reflects more light than it receives, or less than none",
                &field.span,
                "the colour was brought into 0 to 1",
            );
        }
        clamped
    }

    /// Emitted light, if there is any.
    pub(super) fn emission(&mut self, fields: &mut Fields<'_>, key: &str) -> Option<DVec3> {
        let field = self.log.take(fields, key)?;
        let radiance = field.vector().max(DVec3::ZERO);
        let shines = radiance != DVec3::ZERO;
        self.log.mapped(&field.span, if shines { "`emissive` radiance" } else { "no light" });
        shines.then_some(radiance)
    }

    pub(super) fn index(&mut self, fields: &mut Fields<'_>, keys: &[&str]) -> Option<f64> {
        let mut index = None;
        for key in keys {
            if let Some(field) = self.log.take(fields, key) {
                self.log.mapped(&field.span, "`ior`, where it refracts");
                index = Some(field.number(0));
            }
        }
        index
    }

    /// Puts a material's picture in the place of its colour; glass and lamps have none that it could replace.
    pub(super) fn dress(&mut self, look: &mut Look, fields: &mut Fields<'_>) {
        for key in ["texture", "texture_file"] {
            let Some(field) = self.log.take(fields, key) else { continue };
            let slot = match look {
                Look::Diffuse { color } | Look::Mirror { color } | Look::Mix { color, .. } => Some(color),
                Look::Phong { diffuse, .. } => Some(diffuse),
                Look::Metal { .. } | Look::Glass { .. } | Look::Emissive { .. } | Look::Placeholder => None,
            };
            let (Some(slot), Some(word)) = (slot, &field.word) else {
                self.log.dropped(&field.span, "a picture that is not read yet here");
                self.note_not_read("this picture".into(), &field.span, "left out");
                continue;
            };
            slot.picture = Some(self.asset(word));
            self.log.approximated(&field.span, "`image`, laid on by the shape's own uv coordinates");
            self.differs(
                "how a picture is laid on differs from program to program",
                &field.span,
                "compare with the original, and turn or scale it by `uv_scale` and `uv_offset`",
            );
        }
    }
}

/// A material whose place is still to be set.
pub(super) fn material(look: Look, notes: Vec<String>) -> Material {
    Material { span: 0..0, look, notes }
}

/// A mix of lobes, or the single one that has all the weight. An index below 1 is that of air in glass.
fn blended(weights: [f64; 3], color: Texture, index: f64) -> Look {
    let ior = index.max(1.0);
    match weights {
        [_, 0.0, 0.0] => Look::Diffuse { color },
        [0.0, _, 0.0] => Look::Mirror { color },
        [0.0, 0.0, _] => Look::Glass { ior, tint: color.color },
        weights => Look::Mix { weights, color, ior },
    }
}

/// A Phong lobe that shows like the course's own.
///
/// There, a light of colour c adds `c specular (V.R)^n`; here, with light that makes a white diffuse surface as bright
/// as there, it adds `c specular (n + 2) / 2 (V.R)^n cos`: the lobe is normalised. So the highlights are equally bright
/// for a specular colour of `2 / (n + 2)` of the original's. Both lobes are scaled where together they would reflect
/// more than they receive.
fn fitted_phong(diffuse: Texture, specular: DVec3, shininess: f64, notes: &mut Vec<String>) -> Look {
    let specular = specular * (2.0 / (shininess + 2.0));
    notes.push("`specular` makes the highlight as bright as the original's, which is not normalised.".into());
    let most = (diffuse.color + specular).max_element();
    if most <= 1.0 {
        return Look::Phong { diffuse, specular, shininess };
    }
    let divisor = (most * 1e3).ceil() / 1e3; // so that rounding cannot bring the sum above 1
    notes.push(format!("Both colours are divided by {divisor}, lest more light leaves than arrives."));
    let diffuse = Texture { color: diffuse.color / divisor, ..diffuse };
    Look::Phong { diffuse, specular: specular / divisor, shininess }
}
