//! Materials and textures: nothing sends back more light than arrives.

use super::Check;
use super::error::CheckError;
use crate::ir::material::CheckerCells;
use crate::ir::{
    Brightness, ImageUse, Input, Material, MaterialKind, MetalColor, Projection, Texture, TextureKind, Wrap,
};
use crate::math::Rgb;
use crate::schema::Type;
use crate::source::Spanned;

/// The most parts of a mix that count on their own: what a renderer keeps at hand for a point.
const MAX_PARTS: u32 = 6;
/// The most materials that a mix may come down to, alike or not: each is looked at wherever a ray meets it.
const MAX_MIXED: u32 = 64;

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
            MaterialKind::Emissive { .. } | MaterialKind::Mix { .. } => (false, false, 0),
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
    }

    /// Mixes come after their parts, so one walk counts the parts of them all, however deep they nest.
    fn mixes(&mut self) {
        let mut parts: Vec<Parts> = Vec::with_capacity(self.scene.materials.len());
        for material in self.scene.materials.iter() {
            let own = match &material.kind {
                MaterialKind::Mix { a, b, .. } => parts[a.index()].with(parts[b.index()]),
                kind => Parts::of(kind),
            };
            let mixed = matches!(material.kind, MaterialKind::Mix { .. });
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
                if let MetalColor::Color(color) = color {
                    self.albedo("this metal", *color);
                }
                self.share("`roughness`", *roughness);
            }
            MaterialKind::Glass { ior, tint, .. } => {
                self.ior(*ior);
                self.reflectance("this glass", *tint);
            }
            MaterialKind::Whitted { diffuse, specular, reflection, transmission, ior, .. } => {
                [diffuse, specular, reflection, transmission]
                    .into_iter()
                    .for_each(|&input| self.factor(input));
                self.ior(*ior);
            }
            MaterialKind::Emissive { brightness, color } => self.glow(*brightness, *color),
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
                    TextureKind::Checker(checker) => {
                        self.reflectance(what, checker.a);
                        self.reflectance(what, checker.b);
                    }
                    TextureKind::Image(ImageUse { wrap: Wrap::Border(border), .. }) => {
                        self.reflectance("the border of this picture", Spanned::new(*border, texture.span));
                    }
                    TextureKind::Image(_) => {}
                }
            }
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
        match &texture.kind {
            TextureKind::Checker(checker) => {
                let least = match checker.cells {
                    CheckerCells::Uv(cells) => cells.min_element(),
                    CheckerCells::Solid(size) => size,
                };
                let size = Spanned::new(least, texture.span);
                self.positive("the size of this checker's cells", size, Type::Number);
            }
            TextureKind::Image(image) => {
                if let Projection::Planar { u, v, .. } = image.projection {
                    self.spanned("the vectors of this projection span no area", u, v, texture.span);
                }
            }
        }
    }
}
