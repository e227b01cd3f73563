//! Solid textures of MIT's edition of 2004: two materials, blended by a function of space.

use crate::convert::fields::{Field, Part};
use crate::convert::mistake::Mistake;
use crate::convert::model::{Look, Pattern, Texture};
use crate::convert::parse::{Block, Span};
use crate::convert::read::Reader;
use crate::convert::words::blocks::Solid;
use crate::convert::words::{SOLID, TRANSFORM};
use std::f64::consts::TAU;

/// The most blends inside one another; looking through them takes time that doubles with each.
const MOST_BLENDS: usize = 8;

/// What a solid texture says of its function, besides its place.
#[derive(Default)]
struct Waves {
    octaves: Option<f64>,
    frequency: Option<f64>,
    amplitude: Option<f64>,
    size: Option<f64>,
}

impl Waves {
    /// The function in space whose lengths are `scale` times as large in the texture's own.
    ///
    /// With noise N of a feature per unit length, the original's noise is N, marble sin(f x + a N) and wood the same of
    /// the distance from the y axis: veins and rings are 2 pi / f wide and moved by a / 2 pi of that. Noise with a
    /// frequency is marble, too. `None` where the numbers make no function.
    fn pattern(&self, solid: Solid, scale: f64) -> Option<Pattern> {
        let has_waves = self.frequency.is_some_and(|frequency| frequency != 0.0);
        let size = (self.size.unwrap_or(1.0) / scale).abs();
        let wave = (TAU / (self.frequency.unwrap_or(1.0) * scale)).abs();
        let turbulence = (self.amplitude.unwrap_or(1.0) / TAU).abs().min(100.0);
        let pattern = match solid {
            Solid::Checkerboard => Pattern::Checker { size },
            Solid::Marble | Solid::Noise if has_waves => Pattern::Marble { size: wave, turbulence },
            Solid::Noise => {
                Pattern::Noise { size, octaves: self.octaves.unwrap_or(1.0).clamp(1.0, 16.0) as u32 }
            }
            Solid::Marble => Pattern::Marble { size: wave, turbulence },
            Solid::Wood => Pattern::Wood { size: wave, turbulence },
        };
        let (Pattern::Checker { size }
        | Pattern::Noise { size, .. }
        | Pattern::Marble { size, .. }
        | Pattern::Wood { size, .. }) = pattern;
        (1e-6..1e9).contains(&size).then_some(pattern)
    }
}

/// What a pattern is called in the language.
fn word(pattern: Pattern) -> &'static str {
    match pattern {
        Pattern::Checker { .. } => "checker",
        Pattern::Noise { .. } => "noise",
        Pattern::Marble { .. } => "marble",
        Pattern::Wood { .. } => "wood",
    }
}

impl Reader<'_> {
    /// `Checkerboard { [Transform { .. }] materialIndex i materialIndex j }`, and its relatives with noise.
    ///
    /// Cells are as wide as 1 in the space that the transform leads to.
    pub(super) fn solid_look(&mut self, block: Block<'_>, solid: Solid, notes: &mut Vec<String>) -> Look {
        let (name, head, whole) = (block.name().to_string(), block.head.clone(), block.span.clone());
        let (mut indices, mut scale, mut waves) = (Vec::new(), 1.0, Waves::default());
        for part in self.log.parts(block.body, &SOLID) {
            match part {
                Part::Field(field) if field.role == "material" => indices.extend(self.part_index(&field)),
                Part::Field(field) => self.wave(&field, solid, &mut waves),
                Part::Block(block) if block.name() == "Transform" => scale = self.scale_of(block),
                Part::Block(block) => self.log.unknown_block(&block, format!("in `{name}`"), &["Transform"]),
            }
        }
        let [first, second] = indices[..] else {
            self.log.lose(&whole, "a grey placeholder stands in");
            self.log.approximated(&head, "a grey placeholder");
            self.log.notes.note(Mistake::MissingField {
                block: name,
                field: "materialIndex",
                at: head.into(),
                help: "write two of them, of materials further up".into(),
            });
            return Look::Placeholder;
        };
        let pattern = waves.pattern(solid, scale);
        match pattern {
            Some(pattern) => {
                let how = format!("`mix` by `{}` in the object's own space", word(pattern));
                self.log.approximated(&head, how);
                if solid != Solid::Checkerboard {
                    notes.push(other_noise(&name));
                }
            }
            None => {
                self.log.approximated(&head, "an even `mix` of the two materials");
                let why = "its features are too small or too large";
                self.log.not_convertible(format!("the solid texture `{name}`"), &head, why);
                notes.push(format!("The original blends the two by a solid `{name}`; here it is even."));
            }
        }
        Look::Solid { parts: [first, second], pattern }
    }

    /// One number of a solid texture's function.
    fn wave(&mut self, field: &Field<'_>, solid: Solid, waves: &mut Waves) {
        let is_checker = solid == Solid::Checkerboard;
        let (slot, how) = match field.role {
            "size" => (&mut waves.size, "`size`"),
            "octaves" if solid == Solid::Noise => {
                (&mut waves.octaves, "`octaves`; of marble there are always five")
            }
            "frequency" if !is_checker => (&mut waves.frequency, "`size`, of a whole wave"),
            "amplitude" if !is_checker => (&mut waves.amplitude, "`turbulence`, in whole waves"),
            "octaves" if !is_checker => {
                return self.log.dropped(&field.span, "its noise has as many as are usual here");
            }
            _ => return self.log.dropped(&field.span, "no part of its function"),
        };
        if !field.sound {
            return self.log.dropped(&field.span, "malformed");
        }
        *slot = Some(field.number(0));
        match field.role {
            "size" => self.log.mapped(&field.span, how),
            _ => self.log.approximated(&field.span, how),
        }
    }

    /// An index of a material further up.
    fn part_index(&mut self, field: &Field<'_>) -> Option<usize> {
        self.log.mapped(&field.span, "one of the two materials");
        let (index, count) = (field.number(0).trunc() as i64, self.materials.len());
        let valid = usize::try_from(index).ok().filter(|index| *index < count && field.sound);
        let Some(index) = valid else {
            self.log.dropped(&field.span, "no material further up");
            let at = field.span.clone().into();
            self.log.notes.note(Mistake::IndexOutOfRange { index, count, at });
            return None;
        };
        let why = match &self.materials[index].look {
            Look::Emissive { .. } => "a surface that shines in places only",
            _ if self.depth_of_blends(index) >= MOST_BLENDS => "so many blends of blends",
            _ => return Some(index),
        };
        self.log.dropped(&field.span, "no material that can be blended");
        self.log.not_convertible("this part of a solid texture", &field.span, why);
        None
    }

    /// How many blends are inside one another in a material; a plain one has none. Blends refer backwards only.
    fn depth_of_blends(&self, index: usize) -> usize {
        let parts = self.materials[index].look.parts();
        parts.map(|part| 1 + self.depth_of_blends(part)).max().unwrap_or(0)
    }

    /// How many times the transform of a texture magnifies; all else about it is lost.
    fn scale_of(&mut self, block: Block<'_>) -> f64 {
        self.log.approximated(&block.head, "its scale, as the size of the cells");
        let mut scale = 1.0;
        for part in self.log.parts(block.body, &TRANSFORM) {
            match part {
                Part::Field(field) if ["UniformScale", "Scale"].contains(&field.role) && field.sound => {
                    self.log.approximated(&field.span, "the size of the cells");
                    scale *= field.number(0);
                }
                Part::Field(field) => self.log.dropped(&field.span, "a texture keeps its place here"),
                Part::Block(block) => {
                    self.log.unknown_block(&block, "in a `Transform` of a texture".into(), &[])
                }
            }
        }
        scale
    }

    /// `Noise { color V color V .. }` inside a material: a pattern between the two colours.
    pub(super) fn noise_inside(&mut self, block: Block<'_>, look: &mut Look, notes: &mut Vec<String>) {
        let head: Span = block.head.clone();
        let (mut colors, mut waves) = (Vec::new(), Waves::default());
        for part in self.log.parts(block.body, &SOLID) {
            match part {
                Part::Field(field) if field.role == "color" && field.sound => {
                    self.log.mapped(&field.span, "a colour of the pattern");
                    colors.push(self.reflectance(&field));
                }
                Part::Field(field) => self.wave(&field, Solid::Noise, &mut waves),
                Part::Block(block) => self.log.unknown_block(&block, "in `Noise`".into(), &[]),
            }
        }
        let ([first, second], Some(pattern)) = (&colors[..], waves.pattern(Solid::Noise, 1.0)) else {
            self.log.approximated(&head, "a plain colour");
            let why = "it needs two colours, and features of a sensible size";
            return self.log.not_convertible("noise in a material", &head, why);
        };
        self.log.approximated(&head, format!("`{}` between its two colours", word(pattern)));
        if let Some(texture) = look.textures().into_iter().next() {
            let room = texture.color.max_element().clamp(1e-6, 1.0);
            let plain = Texture::plain((*first + *second) * 0.5);
            *texture =
                Texture { blend: Some(([*first, *second], pattern)), ..plain }.map(|color| color * room);
            notes.push(other_noise("Noise"));
        }
    }
}

/// What is to be said of a pattern that is made of noise.
fn other_noise(name: &str) -> String {
    format!("The original's `{name}` has its features at other places: its noise is its own.")
}
