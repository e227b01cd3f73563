//! Materials.

use super::metal;
use crate::ir::material::Principled;
use crate::ir::{Brightness, Handle, Input, Material, MaterialKind, MetalColor, Texture};
use crate::math::Rgb;
use crate::resolve::error::Error;
use crate::resolve::fields::Fields;
use crate::resolve::{Resolver, Value};
use crate::source::{Span, Spanned};

impl<'a> Resolver<'a> {
    /// The material of a block.
    pub(super) fn material(&mut self, fields: &Fields<'a>, span: Span) -> Option<Handle<Material>> {
        let kind = self.material_kind(fields)?;
        Some(self.scene.materials.push(Material { kind, span, name: None, calls: self.calls_here() }))
    }

    /// A grey material in the place of one that could not be made.
    pub(super) fn stand_in(&mut self, span: Span) -> Handle<Material> {
        let kind = MaterialKind::Diffuse { color: Input::Constant(Spanned::new(Rgb::gray(0.5), span)) };
        self.scene.materials.push(Material { kind, span, name: None, calls: Vec::new() })
    }

    fn material_kind(&mut self, fields: &Fields<'a>) -> Option<MaterialKind> {
        Some(match fields.block.kind {
            "diffuse" => MaterialKind::Diffuse { color: fields.input("color")? },
            "phong" => MaterialKind::Phong {
                diffuse: fields.input("diffuse")?,
                specular: fields.input("specular")?,
                shininess: fields.number("shininess")?,
            },
            "mirror" => MaterialKind::Mirror { color: fields.input("color")? },
            "metal" => {
                MaterialKind::Metal { color: metal_color(fields)?, roughness: fields.input("roughness")? }
            }
            "glass" => MaterialKind::Glass {
                ior: fields.number("ior")?,
                roughness: fields.input("roughness")?,
                tint: fields.color("tint")?,
                absorption: self.absorption(fields),
                abbe: fields.given("abbe"),
                thin: fields.flag("thin")?.then(|| fields.span("thin").unwrap_or(fields.head)),
                priority: fields.number("priority")?.value as i32,
            },
            "plastic" => MaterialKind::Plastic {
                color: fields.input("color")?,
                ior: fields.number("ior")?,
                roughness: fields.input("roughness")?,
            },
            "layer" => MaterialKind::Layer {
                base: material_of(fields, "base")?,
                ior: fields.number("ior")?,
                roughness: fields.input("roughness")?,
                cover: fields.input("cover")?,
            },
            "principled" => MaterialKind::Principled(principled(fields)?),
            "mask" => MaterialKind::Mask {
                base: material_of(fields, "material")?,
                opacity: fields.input("opacity")?,
                cutoff: fields.given("cutoff").map(|cutoff| cutoff.value),
            },
            "two_sided" => MaterialKind::TwoSided {
                front: material_of(fields, "front")?,
                back: material_of(fields, "back")?,
            },
            "normal_map" => MaterialKind::NormalMap {
                base: material_of(fields, "material")?,
                map: texture_of(fields, "map")?,
                strength: fields.number("strength")?.value,
            },
            "bump" => MaterialKind::Bump {
                base: material_of(fields, "material")?,
                height: texture_of(fields, "height")?,
                depth: fields.number("depth")?.value,
            },
            "emissive" => {
                let Glow { brightness, map } = glow_of(fields)?;
                MaterialKind::Emissive { brightness, map, color: fields.color("color")?.value }
            }
            "whitted" => MaterialKind::Whitted {
                diffuse: fields.input("diffuse")?,
                specular: fields.input("specular")?,
                shininess: fields.number("shininess")?,
                reflection: fields.input("reflection")?,
                transmission: fields.input("transmission")?,
                ior: fields.number("ior")?,
                fresnel: fields.flag("fresnel")?,
            },
            _ => MaterialKind::Mix {
                a: material_of(fields, "a")?,
                b: material_of(fields, "b")?,
                amount: fields.input("amount")?,
            },
        })
    }

    /// The coefficient with which `exp(−a·x)` is what is left after x metres (Beer–Lambert).
    fn absorption(&mut self, fields: &Fields<'a>) -> Rgb {
        /// What counts as nothing left: a coefficient has to be finite.
        const BLACK: f32 = 1e-6;
        let Some(Spanned { value: Value::Absorption(left, metres), span }) = fields.value("absorption")
        else {
            return Rgb::BLACK;
        };
        if *metres > 0.0 {
            if left.is_black() {
                self.report(Error::BlackGlass { used: *span });
            }
            return left.map(|share| (-libm::log(f64::from(share.clamp(BLACK, 1.0))) / metres) as f32);
        }
        let (field, range) = ("absorption".to_owned(), "per a length greater than 0m".to_owned());
        let found = format!("per `{metres}m`");
        let help = "write for example `absorption: #f4fff6 per 10cm`".to_owned();
        self.report(Error::OutOfRange { field, range, found, used: *span, said: None, help });
        Rgb::BLACK
    }
}

fn material_of(fields: &Fields, name: &str) -> Option<Handle<Material>> {
    match fields.value(name)?.value {
        Value::Material(handle) => Some(handle),
        _ => None,
    }
}

fn texture_of(fields: &Fields, name: &str) -> Option<Spanned<Handle<Texture>>> {
    match fields.value(name)? {
        Spanned { value: Value::Texture(handle), span } => Some(Spanned::new(*handle, *span)),
        _ => None,
    }
}

fn principled(fields: &Fields) -> Option<Principled> {
    Some(Principled {
        color: fields.input("color")?,
        metallic: fields.input("metallic")?,
        roughness: fields.input("roughness")?,
        transmission: fields.input("transmission")?,
        ior: fields.number("ior")?,
        clearcoat: fields.input("clearcoat")?,
        clearcoat_roughness: fields.input("clearcoat_roughness")?,
        emission: fields.input("emission")?,
    })
}

fn metal_color(fields: &Fields) -> Option<MetalColor> {
    if fields.has("color") && !fields.has("kind") {
        let gray = || Input::Constant(Spanned::new(Rgb::gray(0.5), fields.head));
        let straight = fields.input("color").unwrap_or_else(gray);
        return Some(MetalColor::Color { straight, edge: fields.input("edge")? });
    }
    let word = fields.word("kind")?;
    let (straight, edge) = metal::measured(word.value)?;
    Some(MetalColor::Named { name: Spanned::new(word.value.to_owned(), word.span), straight, edge })
}

/// How bright what shines is, and the picture of that, if there is one.
struct Glow {
    brightness: Spanned<Brightness>,
    map: Option<Spanned<Handle<Texture>>>,
}

fn glow_of(fields: &Fields) -> Option<Glow> {
    let white = |span| Spanned::new(Brightness::Radiance(Rgb::WHITE), span);
    let (brightness, map) = if fields.has("power") {
        (fields.number("power")?.map(Brightness::Power), None)
    } else if fields.has("radiance") {
        match fields.input("radiance")? {
            Input::Constant(radiance) => (radiance.map(Brightness::Radiance), None),
            Input::Texture(map) => (white(map.span), Some(map)),
        }
    } else {
        (white(fields.head), None)
    };
    Some(Glow { brightness, map })
}
