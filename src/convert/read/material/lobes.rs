//! Materials that name their lobes: by weights, by words and integers after `type`, by bare words, by shares.

use super::{USUAL_INDEX, clear, shiny};
use crate::convert::dialect::Dialect;
use crate::convert::fields::{Field, Fields};
use crate::convert::mistake::Mistake;
use crate::convert::model::{Look, Texture};
use crate::convert::read::Reader;
use crate::math::DVec3;

/// How much of the light each lobe takes: diffuse, mirror, glass. Not all are zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lobes {
    weights: [f64; 3],
    /// The index of refraction where the material does not say one.
    index: f64,
}

impl Lobes {
    fn one(lobe: usize) -> Self {
        let mut weights = [0.0; 3];
        weights[lobe] = 1.0;
        Self { weights, index: USUAL_INDEX }
    }
}

/// Words after `type`, and the lobe each of them means: 0 diffuse, 1 mirror, 2 glass. A part of the word will do.
const TYPE_WORDS: &[(&str, usize)] = &[
    ("dif", 0),
    ("lamb", 0),
    ("glos", 1),
    ("metal", 1),
    ("spec", 1),
    ("mirr", 1),
    ("refr", 2),
    ("rfre", 2),
    ("glass", 2),
    ("dielec", 2),
    ("trans", 2),
];

/// Materials that one program knows by name, with their weights; its glass has the index [`PROP_INDEX`].
const PROPS: &[(&str, [f64; 3])] = &[
    ("Matte", [1.0, 0.0, 0.0]),
    ("Mirror", [0.0, 1.0, 0.0]),
    ("Glass", [0.0, 0.0, 1.0]),
    ("DiffLight", [1.0, 0.0, 0.0]),
    ("Light", [1.0, 0.0, 0.0]),
    ("China", [0.8, 0.2, 0.0]),
    ("Photo", [0.8, 0.2, 0.0]),
    ("Apple", [0.99, 0.1, 0.0]),
    ("Marble", [0.9, 0.1, 0.0]),
    ("Cobble", [0.7, 0.3, 0.0]),
];

/// See [`PROPS`].
const PROP_INDEX: f64 = 1.65;

const LOBE_NAMES: [&str; 3] = ["`diffuse`", "`mirror`", "`glass`"];

impl Reader<'_> {
    /// The lobes that the fields name, in the first way that one of them is in; `None` if no field names a lobe.
    pub(super) fn lobes(&mut self, fields: &mut Fields<'_>) -> Option<Lobes> {
        if let Some(lobes) = self.lobe_of_flags(fields) {
            return Some(lobes);
        }
        if let Some(prop) = self.log.take(fields, "prop") {
            return Some(self.lobes_of_prop(&prop));
        }
        for role in ["type", "kind"] {
            if let Some(field) = self.log.take(fields, role) {
                // Kinds and shares beside each other say the same.
                let shares = self.shares(fields);
                let lobes = self.lobes_of_type(&field);
                return Some(shares.filter(|_| field.role == "kind").unwrap_or(lobes));
            }
        }
        self.shares(fields)
    }

    /// `DIFF`, `SPEC` or `REFR` as a word of its own.
    fn lobe_of_flags(&mut self, fields: &mut Fields<'_>) -> Option<Lobes> {
        let mut lobes = None;
        for (lobe, flag) in ["DIFF", "SPEC", "REFR"].into_iter().enumerate() {
            if let Some(field) = self.log.take(fields, flag) {
                self.log.mapped(&field.span, LOBE_NAMES[lobe]);
                lobes = Some(Lobes::one(lobe));
            }
        }
        lobes
    }

    fn lobes_of_prop(&mut self, prop: &Field<'_>) -> Lobes {
        match PROPS.iter().find(|(known, _)| *known == prop.text()) {
            Some((_, weights)) => {
                self.log.approximated(&prop.span, "the weights that the program gives this name");
                Lobes { weights: *weights, index: PROP_INDEX }
            }
            None => {
                self.log.dropped(&prop.span, "an unknown name, taken as diffuse");
                self.note_not_read("this name of a material", &prop.span, "taken as diffuse");
                Lobes::one(0)
            }
        }
    }

    /// `type WORD`, `type 0|1|2`, or `type d s t` with the probabilities of the lobes.
    fn lobes_of_type(&mut self, field: &Field<'_>) -> Lobes {
        if field.numbers.len() > 1 && field.word.is_none() {
            return self.weights(field);
        }
        let word = field.text().to_ascii_lowercase();
        let known = match &field.word {
            Some(_) => TYPE_WORDS.iter().find(|(part, _)| word.contains(part)).map(|(_, lobe)| *lobe),
            None => [0.0, 1.0, 2.0].iter().position(|&kind| kind == field.number(0)),
        };
        // In the program whose integers go further, 3 is a lamp, which its `emission` makes of it.
        let lobe = known.or((field.word.is_none() && field.number(0) == 3.0).then_some(0));
        match (lobe, word.as_str()) {
            (Some(lobe), _) => {
                let is_vague = ["glos", "metal"].iter().any(|vague| word.contains(vague));
                match is_vague {
                    true => self.log.approximated(&field.span, "a mirror, as rough as another field says"),
                    false => self.log.mapped(&field.span, LOBE_NAMES[lobe]),
                }
                Lobes::one(lobe)
            }
            (None, "refl") => {
                self.log.approximated(&field.span, "glass");
                let help = "in the program that has this word it means refraction; where it means a mirror write `SPEC`";
                self.log.differs("`REFL` was taken as refraction", &field.span, help);
                Lobes::one(2)
            }
            (None, _) => {
                self.log.dropped(&field.span, "an unknown kind of material, taken as diffuse");
                self.note_not_read("this kind of material", &field.span, "taken as diffuse");
                Lobes::one(0)
            }
        }
    }

    /// Three weights; what a fourth one means differs.
    fn weights(&mut self, field: &Field<'_>) -> Lobes {
        let weights = [0, 1, 2].map(|i| field.number(i).max(0.0));
        if field.numbers.len() > 3 && field.number(3) != 0.0 {
            self.log.approximated(&field.span, "the first three weights; the fourth is not read");
            self.note_not_read("the fourth weight", &field.span, "the first three were used");
        } else {
            self.log.mapped(&field.span, "which lobes, and how much of each");
        }
        if weights.iter().sum::<f64>() <= 0.0 {
            let help = "it was taken as diffuse; write the shares of diffuse, mirror and glass, such as `type 1 0 0`";
            self.log.bad_value("the weights of `type` are all 0", &field.span, help);
            return Lobes::one(0);
        }
        Lobes { weights, index: 1.0 }
    }

    /// One number for each lobe, under the names that a dozen programs give them.
    fn shares(&mut self, fields: &mut Fields<'_>) -> Option<Lobes> {
        let is_share = |fields: &Fields<'_>, role: &str| {
            fields.peek(role).is_some_and(|field| !field.is_vector() && field.word.is_none())
        };
        let mut mirror = if is_share(fields, "mirror") { self.log.take(fields, "mirror") } else { None };
        let mut glass = if is_share(fields, "glass") { self.log.take(fields, "glass") } else { None };
        if mirror.is_none() {
            mirror = self.log.take_any(fields, &["reflection"]);
        }
        if mirror.is_none() && is_share(fields, "specular or share") {
            mirror = self.log.take(fields, "specular or share");
        }
        let diffuse = if is_share(fields, "diffuse") { self.log.take(fields, "diffuse") } else { None };
        if mirror.is_none() && diffuse.is_none() && glass.is_none() {
            return None;
        }
        // `refr` is a weight beside weights, and so is `refraction`; `refractRate` is one beside `refractIndex` only.
        if glass.is_none() {
            let rate = fields.has("index").then_some("refractRate");
            glass = self.log.take_any(fields, &["refr", "refraction", rate.unwrap_or("refr")]);
        }
        let weights =
            [&diffuse, &mirror, &glass].map(|field| field.as_ref().map(|field| field.number(0).max(0.0)));
        for field in [&diffuse, &mirror, &glass].into_iter().flatten() {
            self.log.mapped(&field.span, "the share of a lobe");
        }
        // The second number of one program's `transmissive 0.9 1.5` is the index.
        let index =
            glass.as_ref().and_then(|field| field.numbers.get(1)).map_or(USUAL_INDEX, |index| index.value);
        // Without a share of its own the diffuse lobe takes what the others leave.
        let others = weights[1].unwrap_or(0.0) + weights[2].unwrap_or(0.0);
        let weights = [
            weights[0].unwrap_or((1.0 - others).max(0.0)),
            weights[1].unwrap_or(0.0),
            weights[2].unwrap_or(0.0),
        ];
        Some(if weights.iter().sum::<f64>() > 0.0 { Lobes { weights, index } } else { Lobes::one(0) })
    }

    /// What the lobes make together with the colours: one for all of them, or in some dialects one for each.
    pub(super) fn lobed_look(
        &mut self,
        fields: &mut Fields<'_>,
        lobes: Lobes,
        dialect: Dialect,
        notes: &mut Vec<String>,
    ) -> Look {
        let color = self.one_color(fields);
        let index =
            self.index(fields, &["index", "refr", "refractRate", "refraction"]).unwrap_or(lobes.index);
        let [_, mirror, glass] = lobes.weights;
        let has_own = dialect == Dialect::Factors || fields.has("glass");
        let mirror_color = match mirror > 0.0 && has_own {
            true => self.lobe_color(fields, &["mirror", "specular", "specular or share"], color),
            false => color,
        };
        let glass_color = match glass > 0.0 && has_own {
            true => self.lobe_color(fields, &["glass"], color),
            false => color,
        };
        let roughness = if mirror > 0.0 || glass > 0.0 { self.roughness(fields) } else { 0.0 };
        if glass > 0.0 && mirror == 0.0 && roughness > 0.0 {
            notes.push("The original's glass is rough; this one is clear.".into());
        }
        let unused = "the original's ray caster alone uses it";
        self.log.put_aside(
            fields,
            &["specular", "specular or share", "shininess", "roughness", "gloss"],
            unused,
        );
        let sum: f64 = lobes.weights.iter().sum();
        let parts = [
            Look::Diffuse { color: Texture::plain(color) },
            shiny(mirror_color, roughness),
            clear(index, glass_color),
        ];
        let weighted = lobes.weights.into_iter().zip(parts).map(|(weight, look)| (weight / sum, look));
        mixed(weighted.collect())
    }

    fn lobe_color(&mut self, fields: &mut Fields<'_>, roles: &[&str], otherwise: DVec3) -> DVec3 {
        match self.log.take_any(fields, roles) {
            Some(field) if field.is_vector() => {
                self.log.mapped(&field.span, "the colour of a lobe");
                self.reflectance(&field)
            }
            Some(field) => {
                self.log.dropped(&field.span, "no colour");
                self.log.notes.note(Mistake::NotConvertible {
                    what: format!("`{}`", field.key),
                    why: "its meaning beside the shares of lobes is not known",
                    at: field.span.clone().into(),
                });
                otherwise
            }
            None => otherwise,
        }
    }
}

/// Lobes with shares that add up to 1; those without a share are left out, and one alone is no mix.
pub(super) fn mixed(mut lobes: Vec<(f64, Look)>) -> Look {
    lobes.retain(|(share, _)| *share > 1e-6);
    let sum: f64 = lobes.iter().map(|(share, _)| share).sum();
    for (share, _) in &mut lobes {
        *share /= sum;
    }
    match lobes.len() {
        0 => Look::Diffuse { color: Texture::plain(DVec3::ZERO) },
        1 => lobes.remove(0).1,
        _ => Look::Mix(lobes),
    }
}
