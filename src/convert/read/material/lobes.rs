//! Materials that name their lobes: by weights, by words and integers after `type`, by bare words, by shares.

use super::{USUAL_INDEX, frosted, shiny};
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
    /// Whether each lobe may have a colour of its own, rather than all of them the one of the material.
    own_colors: bool,
    /// Whether the weight of a lobe was read off its colour, which then says the hue only.
    in_color: [bool; 3],
}

impl Lobes {
    fn one(lobe: usize) -> Self {
        let mut weights = [0.0; 3];
        weights[lobe] = 1.0;
        Self { weights, ..Self::default() }
    }
}

impl Lobes {
    /// All of it glass.
    pub(super) fn glass() -> Self {
        Self::one(2)
    }

    /// This share of light mirrored, in the material's one colour, and the rest scattered.
    pub(super) fn mirrored(share: f64) -> Self {
        Self { weights: [1.0 - share, share, 0.0], ..Self::default() }
    }
}

impl Default for Lobes {
    fn default() -> Self {
        Self { weights: [0.0; 3], index: USUAL_INDEX, own_colors: false, in_color: [false; 3] }
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

    /// `DIFF`, `SPEC` or `REFR` as a word of its own, or a key of a lobe with nothing after it.
    fn lobe_of_flags(&mut self, fields: &mut Fields<'_>) -> Option<Lobes> {
        let mut lobes = None;
        for (lobe, flag) in ["DIFF", "SPEC", "REFR"].into_iter().enumerate() {
            if let Some(field) = self.log.take(fields, flag) {
                self.log.mapped(&field.span, LOBE_NAMES[lobe]);
                lobes = Some(Lobes { own_colors: field.guessed, ..Lobes::one(lobe) });
            }
        }
        for (lobe, role) in [(0, "diffuse"), (1, "specular or share"), (1, "mirror"), (2, "glass")] {
            let Some(field) = self.log.take_where(fields, role, Field::is_flag) else { continue };
            if field.text().eq_ignore_ascii_case("false") {
                self.log.mapped(&field.span, "a lobe that it does not have");
                continue;
            }
            let lobe = self.clear_if_it_bends(lobe, fields, &field);
            self.log.mapped(&field.span, LOBE_NAMES[lobe]);
            lobes = Some(Lobes { own_colors: true, ..Lobes::one(lobe) });
        }
        lobes
    }

    /// A polished surface with an index of refraction lets light in.
    fn clear_if_it_bends(&mut self, lobe: usize, fields: &Fields<'_>, flag: &Field<'_>) -> usize {
        let bends = fields.peek("index").is_some_and(|index| index.number(0) > 1.0);
        if lobe != 1 || !bends {
            return lobe;
        }
        let help = "the index of refraction says so; without it, it would be a mirror";
        self.log.differs(format!("`{}` was taken as glass", flag.key), &flag.span, help);
        2
    }

    fn lobes_of_prop(&mut self, prop: &Field<'_>) -> Lobes {
        match PROPS.iter().find(|(known, _)| *known == prop.text()) {
            Some((_, weights)) => {
                self.log.approximated(&prop.span, "the weights that the program gives this name");
                Lobes { weights: *weights, index: PROP_INDEX, ..Lobes::default() }
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
        Lobes { weights, index: 1.0, ..Lobes::default() }
    }

    /// One number for each lobe, under the names that a dozen programs give them.
    fn shares(&mut self, fields: &mut Fields<'_>) -> Option<Lobes> {
        let mut share = |role| self.log.take_where(fields, role, Field::is_share);
        let mirror = share("mirror").or_else(|| share("reflection")).or_else(|| share("specular or share"));
        let (mut glass, diffuse) = (share("glass"), share("diffuse"));
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
        // A lobe with a colour and no share has the share that is in its colour; without either it has none, but the
        // diffuse one takes what the others leave.
        let in_color = |role| {
            let color = fields.peek_where(role, Field::is_vector).map(Field::vector);
            color.map_or(0.0, |color| color.max_element().clamp(0.0, 1.0))
        };
        let is_missing = weights.map(|weight| weight.is_none());
        let mirror = weights[1].unwrap_or_else(|| in_color("mirror"));
        let glass = weights[2].unwrap_or_else(|| in_color("glass"));
        let weights = [weights[0].unwrap_or((1.0 - mirror - glass).max(0.0)), mirror, glass];
        if weights.iter().sum::<f64>() <= 0.0 {
            return Some(Lobes::one(0));
        }
        let in_color = [false, is_missing[1], is_missing[2]];
        Some(Lobes { weights, index, own_colors: true, in_color })
    }

    /// What the lobes make together with the colours: one for all of them, or in some dialects one for each.
    pub(super) fn lobed_look(&mut self, fields: &mut Fields<'_>, lobes: Lobes, dialect: Dialect) -> Look {
        let color = self.one_color(fields);
        let index =
            self.index(fields, &["index", "refr", "refractRate", "refraction"]).unwrap_or(lobes.index);
        let [_, mirror, glass] = lobes.weights;
        let has_own = lobes.own_colors || dialect == Dialect::Factors || fields.has("glass");
        let mirror_color = match mirror > 0.0 && has_own {
            true => self.lobe_color(fields, &["mirror", "specular", "specular or share"], color),
            false => color,
        };
        let glass_color = match glass > 0.0 && has_own {
            true => self.lobe_color(fields, &["glass"], color),
            false => color,
        };
        let hue_of = |lobe: usize, color: DVec3| match lobes.in_color[lobe] {
            true => color / color.max_element(),
            false => color,
        };
        let roughness = if mirror > 0.0 || glass > 0.0 { self.roughness(fields) } else { 0.0 };
        let unused = "the original's ray caster alone uses it";
        self.log.put_aside(
            fields,
            &["specular", "specular or share", "shininess", "roughness", "gloss"],
            unused,
        );
        let sum: f64 = lobes.weights.iter().sum();
        let parts = [
            Look::Diffuse { color: Texture::plain(color) },
            shiny(hue_of(1, mirror_color), roughness),
            frosted(index, hue_of(2, glass_color), roughness),
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
