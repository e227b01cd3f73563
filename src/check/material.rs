//! Materials and textures: nothing sends back more light than arrives.

use super::Check;
use super::error::CheckError;
use crate::ir::material::{CheckerCells, Join, Pattern};
use crate::ir::{
    Brightness, Handle, ImageUse, Input, Material, MaterialKind, MetalColor, Projection, Texture,
    TextureKind, Wrap,
};
use crate::math::Rgb;
use crate::schema::Type;
use crate::source::Spanned;

/// The most parts of a mix that count on their own: what a renderer keeps at hand for a point.
const MAX_PARTS: u32 = 6;
/// The most materials that a mix may come down to, alike or not: each is looked at wherever a ray meets it.
const MAX_MIXED: u32 = 64;

/// The most textures that one may be made of, itself included: all are looked up wherever a ray meets the surface.
const MAX_LOOKED_UP: u32 = 256;

/// What a material scatters by: all matt parts count as one, all mirrors too, each glossy part and each glass alone.
#[derive(Clone, Copy, Default)]
struct Parts {
    matt: bool,
    mirror: bool,
    others: u32,
    /// The materials that are no mixes, each as often as it occurs.
    all: u32,
}

impl Parts {
    fn of(kind: &MaterialKind) -> Self {
        let (matt, mirror, others) = match kind {
            MaterialKind::Diffuse { .. } | MaterialKind::Whitted { .. } => (true, false, 0),
            MaterialKind::Phong { .. } => (true, false, 1),
            MaterialKind::Mirror { .. } => (false, true, 0),
            MaterialKind::Metal { .. } | MaterialKind::Glass { .. } => (false, false, 1),
            MaterialKind::Plastic { .. } => (false, false, 2),
            MaterialKind::Principled(_) => (false, false, 5),
            _ => (false, false, 0),
        };
        Self { matt, mirror, others, all: 1 }
    }

    fn with(self, other: Self) -> Self {
        let others = self.others.saturating_add(other.others);
        let all = self.all.saturating_add(other.all);
        Self { matt: self.matt || other.matt, mirror: self.mirror || other.mirror, others, all }
    }

    fn count(self) -> u32 {
        self.others.saturating_add(u32::from(self.matt) + u32::from(self.mirror))
    }
}

impl Check<'_> {
    /// Checks every material and texture that was written, placed or not.
    pub(super) fn materials(&mut self) {
        for material in self.scene.materials.iter() {
            self.calls = &material.calls;
            self.material(material);
        }
        self.calls = &[];
        for texture in self.scene.textures.iter() {
            self.texture(texture);
        }
        self.mixes();
        self.nesting();
        self.texture_depths();
    }

    /// Mixes come after their parts, so one walk counts the parts of them all, however deep they nest.
    fn mixes(&mut self) {
        let mut parts: Vec<Parts> = Vec::with_capacity(self.scene.materials.len());
        for material in self.scene.materials.iter() {
            let of = |handle: &Handle<Material>| parts[handle.index()];
            let own = match &material.kind {
                MaterialKind::Mix { a, b, .. } => of(a).with(of(b)),
                // Under a coat, what is matt or a mirror is not joined with what is not.
                MaterialKind::Layer { base, .. } => Parts {
                    matt: false,
                    mirror: false,
                    others: of(base).count().saturating_add(1),
                    ..of(base)
                },
                MaterialKind::Mask { base, .. }
                | MaterialKind::NormalMap { base, .. }
                | MaterialKind::Bump { base, .. } => of(base),
                kind => Parts::of(kind),
            };
            let mixed = matches!(material.kind, MaterialKind::Mix { .. } | MaterialKind::Layer { .. });
            let too_many = mixed && own.count() > MAX_PARTS;
            let too_deep = own.all > MAX_MIXED;
            if too_many {
                self.report(CheckError::TooManyParts {
                    found: own.count(),
                    most: MAX_PARTS,
                    used: material.span,
                });
            } else if too_deep {
                self.report(CheckError::TooDeepMix { found: own.all, most: MAX_MIXED, used: material.span });
            }
            // One report for what is too large, not one more for each mix around it.
            parts.push(if too_many || too_deep { Parts::default() } else { own });
        }
    }

    fn material(&mut self, material: &Material) {
        match &material.kind {
            MaterialKind::Diffuse { color } => self.albedo("this surface", *color),
            MaterialKind::Phong { diffuse, specular, .. } => self.phong(*diffuse, *specular),
            MaterialKind::Mirror { color } => self.albedo("this mirror", *color),
            MaterialKind::Metal { color, roughness } => {
                if let MetalColor::Color { straight, edge } = color {
                    self.albedo("this metal", *straight);
                    self.albedo("the edge of this metal", *edge);
                }
                self.share("`roughness`", *roughness);
            }
            MaterialKind::Glass { ior, tint, roughness, absorption, abbe, thin, .. } => {
                self.ior(*ior);
                self.reflectance("this glass", *tint);
                self.share("`roughness`", *roughness);
                if let (Some(thin), false) = (*thin, absorption.is_black()) {
                    let help = "colour it by `tint`, or leave `thin` out and give the glass two sides";
                    self.report(CheckError::ThinInside { what: "absorb light in", help, used: thin });
                }
                if let (Some(_), Some(abbe)) = (thin, abbe) {
                    let help = "light leaves a pane as it came: leave `abbe` out, or `thin`";
                    self.report(CheckError::ThinInside { what: "spread colours in", help, used: abbe.span });
                }
            }
            MaterialKind::Plastic { color, ior, roughness } => {
                self.albedo("this plastic", *color);
                self.ior(*ior);
                self.share("`roughness`", *roughness);
            }
            MaterialKind::Layer { ior, roughness, cover, .. } => {
                self.ior(*ior);
                self.share("`roughness`", *roughness);
                self.share("`cover`", *cover);
            }
            MaterialKind::Principled(of) => {
                self.albedo("this surface", of.color);
                self.ior(of.ior);
                self.share("`metallic`", of.metallic);
                self.share("`roughness`", of.roughness);
                self.share("`transmission`", of.transmission);
                self.share("`clearcoat`", of.clearcoat);
                self.share("`clearcoat_roughness`", of.clearcoat_roughness);
                self.factor(of.emission);
            }
            MaterialKind::Mask { opacity, .. } => self.share("`opacity`", *opacity),
            MaterialKind::TwoSided { .. } | MaterialKind::NormalMap { .. } | MaterialKind::Bump { .. } => {}
            MaterialKind::Whitted { diffuse, specular, reflection, transmission, ior, .. } => {
                [diffuse, specular, reflection, transmission]
                    .into_iter()
                    .for_each(|&input| self.factor(input));
                self.ior(*ior);
            }
            MaterialKind::Emissive { brightness, color, .. } => self.glow(*brightness, *color),
            MaterialKind::Mix { amount, .. } => self.share("`amount`", *amount),
        }
    }

    fn ior(&mut self, ior: Spanned<f64>) {
        if ior.value < 1.0 {
            self.report(CheckError::IorBelowOne { found: ior.value, used: ior.span });
        }
    }

    fn phong(&mut self, diffuse: Input, specular: Input) {
        self.albedo("the matt part of this surface", diffuse);
        self.albedo("the gloss of this surface", specular);
        let (Input::Constant(matt), Input::Constant(gloss)) = (diffuse, specular) else { return };
        let found = (matt.value + gloss.value).max_component();
        let single = matt.value.max_component().max(gloss.value.max_component());
        // Colours of eight bits add up to a hair more than 1.
        if found > 1.0 + 1e-4 && single <= 1.0 {
            self.report(CheckError::PhongEnergy { found, specular: gloss.span, diffuse: matt.span });
        }
    }

    /// An input that says how much light is sent back: the colours of a checker and what lies around a picture count;
    /// most pictures never exceed 1, and of the others the pixels are not known yet.
    fn albedo(&mut self, what: &'static str, input: Input) {
        match input {
            Input::Constant(color) => self.reflectance(what, color),
            Input::Texture(handle) => {
                let texture = &self.scene.textures[handle.value];
                match &texture.kind {
                    TextureKind::Image(ImageUse { wrap: Wrap::Border(border), .. }) => {
                        self.reflectance("the border of this picture", Spanned::new(*border, texture.span));
                    }
                    TextureKind::Image(_) => {}
                    // What is scaled or summed counts as a whole.
                    TextureKind::Join { .. } => {
                        let found = self.brightest(input);
                        if found > 1.0 + 1e-4 {
                            let found = (found * 1e3).round() / 1e3;
                            self.report(CheckError::MayCreateEnergy { what, found, used: texture.span });
                        }
                    }
                    TextureKind::Blend { a, b, .. } => {
                        [*a, *b].into_iter().for_each(|part| self.albedo(what, part))
                    }
                    kind => kind.inputs().into_iter().for_each(|part| self.albedo(what, part)),
                }
            }
        }
    }

    /// The most that any channel of an input can be; pictures are held to go up to 1.
    fn brightest(&self, input: Input) -> f32 {
        let Input::Texture(handle) = input else {
            let Input::Constant(color) = input else { return 0.0 };
            return color.value.max_component();
        };
        match &self.scene.textures[handle.value].kind {
            TextureKind::Image(_) => 1.0,
            TextureKind::Join { op: Join::Add, a, b } => self.brightest(*a) + self.brightest(*b),
            TextureKind::Join { op: Join::Subtract, a, .. } => self.brightest(*a),
            TextureKind::Join { op: Join::Multiply, a, b } => self.brightest(*a) * self.brightest(*b),
            TextureKind::Blend { a, b, .. } => self.brightest(*a).max(self.brightest(*b)),
            kind => kind.inputs().into_iter().map(|part| self.brightest(part)).fold(0.0, f32::max),
        }
    }

    /// A factor of a formula that makes no promise of energy: anything but negative.
    fn factor(&mut self, input: Input) {
        let Input::Constant(color) = input else { return };
        let least = color.min_component();
        if least < 0.0 {
            let what = "a channel of this colour";
            self.report(CheckError::NegativeLight { what, found: least.to_string(), used: color.span });
        }
    }

    fn reflectance(&mut self, what: &'static str, color: Spanned<Rgb>) {
        let (least, most) = (color.min_component(), color.max_component());
        if least < 0.0 {
            let what = "a channel of this colour";
            self.report(CheckError::NegativeLight { what, found: least.to_string(), used: color.span });
        } else if most > 1.0 {
            let bytes = [color.r, color.g, color.b];
            // Whole numbers beyond 2 are the bytes of a picture.
            let help = match most > 2.0 && bytes.iter().all(|c| *c <= 255.0 && c.fract() == 0.0) {
                true => {
                    let [r, g, b] = bytes.map(|c| c as u8);
                    format!(
                        "channels go from 0 to 1: for those of a picture, from 0 to 255, write `#{r:02x}{g:02x}{b:02x}`"
                    )
                }
                false => "no channel may be greater than 1".to_owned(),
            };
            self.report(CheckError::CreatesEnergy { what, found: most, help, used: color.span });
        }
    }

    /// An input in [0, 1].
    fn share(&mut self, what: &'static str, input: Input) {
        let Input::Constant(value) = input else { return };
        if !(0.0..=1.0).contains(&value.r) {
            let (found, range) = (value.r.to_string(), "from 0 to 1".to_owned());
            let example = value.r.clamp(0.0, 1.0).to_string();
            self.report(CheckError::OutOfRange { what, found, range, example, used: value.span });
        }
    }

    fn glow(&mut self, brightness: Spanned<Brightness>, color: Rgb) {
        self.brightness(brightness, color, brightness.span);
    }

    fn texture(&mut self, texture: &Texture) {
        let span = texture.span;
        let mut positive = |what, least| self.positive(what, Spanned::new(least, span), Type::Number);
        match &texture.kind {
            TextureKind::Checker(checker) => {
                let least = match checker.cells {
                    CheckerCells::Uv(cells) => cells.min_element(),
                    CheckerCells::Solid(size) => size,
                };
                positive("the size of this checker's cells", least);
            }
            TextureKind::Pattern { pattern, .. } => match *pattern {
                Pattern::Noise { size, .. } | Pattern::Marble { size, .. } | Pattern::Wood { size, .. } => {
                    positive("the size of this pattern", size);
                }
                Pattern::Brick { cells, .. } => positive("the number of these bricks", cells.min_element()),
                Pattern::Gradient(Some([start, end])) if start == end => {
                    let help = "let it end somewhere else than where it starts";
                    let what = "this gradient starts and ends at one point".to_owned();
                    self.report(CheckError::Degenerate { what, used: span, help });
                }
                Pattern::Gradient(_) => {}
            },
            TextureKind::Image(image) => match image.projection {
                Projection::Planar { u, v, .. } => {
                    self.spanned("the vectors of this projection span no area", u, v, span);
                }
                Projection::Cubic { size, .. } => positive("an edge of this box", size.min_element()),
                Projection::Uv | Projection::Spherical { .. } => {}
            },
            TextureKind::Blend { amount, .. } => self.share("`amount`", *amount),
            TextureKind::Join { .. } => {}
        }
    }

    /// Textures come after what they are made of, so one walk counts what is looked up for them all.
    fn texture_depths(&mut self) {
        let mut counts: Vec<u32> = Vec::with_capacity(self.scene.textures.len());
        for texture in self.scene.textures.iter() {
            let parts = texture.kind.inputs().into_iter().map(|input| match input {
                Input::Texture(handle) => counts[handle.value.index()],
                Input::Constant(_) => 0,
            });
            let mut found = parts.fold(1, u32::saturating_add);
            if found > MAX_LOOKED_UP {
                self.report(CheckError::TooDeepTexture { found, most: MAX_LOOKED_UP, used: texture.span });
                found = 1; // one report, not one more for each around it
            }
            counts.push(found);
        }
    }

    /// What can stand in what: holes outermost, then sides, then reliefs; coats over what is solid, and only one.
    fn nesting(&mut self) {
        let mut traits: Vec<Traits> = Vec::with_capacity(self.scene.materials.len());
        for material in self.scene.materials.iter() {
            let own = Traits::of(&material.kind, |part| traits[part.index()]);
            let parts = material.kind.parts();
            let refused = parts
                .iter()
                .find_map(|part| Some((*part, own.refuses(&material.kind, traits[part.index()])?)));
            let coats = parts.iter().filter(|part| traits[part.index()].coat).count();
            if let Some((part, (inner, outer, help))) = refused {
                let (used, outside) = (self.scene.materials[part].span, material.span);
                self.report(CheckError::CannotHold { inner, outer, help, outside, used });
            } else if coats > 1 {
                let (inner, outer) = ("a second coat", "a mix");
                let help = "put one `layer` over the whole mix, or a `plastic` into it";
                let (used, outside) = (self.scene.materials[parts[1]].span, material.span);
                self.report(CheckError::CannotHold { inner, outer, help, outside, used });
            }
            traits.push(own);
        }
    }
}

/// What matters for where a material can stand.
#[derive(Clone, Copy, Default)]
struct Traits {
    holes: bool,
    sides: bool,
    relief: bool,
    coat: bool,
    shines: bool,
    clear: bool,
}

impl Traits {
    fn of(kind: &MaterialKind, part: impl Fn(Handle<Material>) -> Self) -> Self {
        let below = kind.parts().into_iter().map(part).fold(Self::default(), |a, b| Self {
            holes: a.holes || b.holes,
            sides: a.sides || b.sides,
            relief: a.relief || b.relief,
            coat: a.coat || b.coat,
            shines: a.shines || b.shines,
            clear: a.clear || b.clear,
        });
        match kind {
            MaterialKind::Mask { .. } => Self { holes: true, ..below },
            MaterialKind::TwoSided { .. } => Self { sides: true, ..below },
            MaterialKind::NormalMap { .. } | MaterialKind::Bump { .. } => Self { relief: true, ..below },
            MaterialKind::Layer { .. } => Self { coat: true, ..below },
            MaterialKind::Emissive { .. } => Self { shines: true, ..below },
            MaterialKind::Glass { .. } => Self { clear: true, ..below },
            MaterialKind::Principled(of) => {
                let is_black = |input| matches!(input, Input::Constant(color) if color.is_black());
                Self {
                    shines: !of.emission.is_black(),
                    clear: !is_black(of.transmission),
                    coat: !is_black(of.clearcoat),
                    ..below
                }
            }
            _ => below,
        }
    }

    /// What a part has that its whole cannot hold: that, the whole, and what to do.
    fn refuses(self, whole: &MaterialKind, part: Self) -> Option<(&'static str, &'static str, &'static str)> {
        const HOLES: (&str, &str) = ("a `mask`", "put the `mask` around everything else");
        const SIDES: (&str, &str) = ("a `two_sided` material", "put it around everything but a `mask`");
        const RELIEF: (&str, &str) = ("a relief", "put `normal_map` or `bump` around the whole material");
        const SHINES: (&str, &str) =
            ("what shines", "let it shine without: give it the `emissive` material alone");
        const COAT: (&str, &str) = ("a coat", "one coat is all there is room for: leave one out");
        const CLEAR: (&str, &str) = ("glass", "glass has a surface of its own: leave the layer out");
        const OPEN: (&str, &str) = ("glass", "glass is the same from both sides: give it the `glass` alone");
        let rules: &[(bool, (&str, &str))] = match whole {
            MaterialKind::Mask { .. } => &[(part.holes, HOLES), (part.shines, SHINES)],
            MaterialKind::TwoSided { .. } => &[(part.holes, HOLES), (part.sides, SIDES), (part.clear, OPEN)],
            MaterialKind::NormalMap { .. } | MaterialKind::Bump { .. } => {
                &[(part.holes, HOLES), (part.sides, SIDES), (part.relief, RELIEF)]
            }
            MaterialKind::Mix { .. } => &[(part.holes, HOLES), (part.sides, SIDES), (part.relief, RELIEF)],
            MaterialKind::Layer { .. } => &[
                (part.holes, HOLES),
                (part.sides, SIDES),
                (part.relief, RELIEF),
                (part.coat, COAT),
                (part.shines, SHINES),
                (part.clear, CLEAR),
            ],
            _ => &[],
        };
        let outer = match whole {
            MaterialKind::Mask { .. } => "a `mask`",
            MaterialKind::TwoSided { .. } => "a `two_sided` material",
            MaterialKind::Layer { .. } => "a `layer`",
            MaterialKind::Mix { .. } => "a `mix`",
            _ => "a relief",
        };
        let (inner, help) = rules.iter().find(|(applies, _)| *applies)?.1;
        Some((inner, outer, help))
    }
}
