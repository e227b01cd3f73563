//! Materials.

use crate::ir::{Brightness, Handle, Input, Material, MaterialKind, MetalColor};
use crate::math::Rgb;
use crate::resolve::error::Error;
use crate::resolve::fields::Fields;
use crate::resolve::{Resolver, Value};
use crate::source::{Span, Spanned};

/// Reflectance at normal incidence in linear Rec. 709 of the metals known by name.
///
/// From measured optical constants (Johnson & Christy 1972; Palik 1985), integrated with the CIE 1931 observer, as
/// tabulated for real-time rendering by Lagarde 2014.
const METALS: &[(&str, Rgb)] = &[
    ("silver", Rgb::new(0.972, 0.960, 0.915)),
    ("gold", Rgb::new(1.0, 0.766, 0.336)),
    ("copper", Rgb::new(0.955, 0.637, 0.538)),
    ("aluminium", Rgb::new(0.913, 0.922, 0.924)),
    ("iron", Rgb::new(0.562, 0.565, 0.578)),
    ("chromium", Rgb::new(0.549, 0.556, 0.554)),
];

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
                tint: fields.color("tint")?,
                absorption: self.absorption(fields),
            },
            "emissive" => {
                let brightness = glow_of(fields);
                MaterialKind::Emissive { brightness, color: fields.color("color")?.value }
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

fn metal_color(fields: &Fields) -> Option<MetalColor> {
    if fields.has("color") && !fields.has("kind") {
        let grey = || Input::Constant(Spanned::new(Rgb::gray(0.5), fields.head));
        return Some(MetalColor::Color(fields.input("color").unwrap_or_else(grey)));
    }
    let word = fields.word("kind")?;
    let (name, color) = METALS.iter().find(|(name, _)| *name == word.value)?;
    Some(MetalColor::Named(Spanned::new((*name).to_owned(), word.span), *color))
}

fn glow_of(fields: &Fields) -> Spanned<Brightness> {
    let power = fields.number("power").map(|power| power.map(Brightness::Power));
    let radiance = fields.color("radiance").map(|radiance| radiance.map(Brightness::Radiance));
    radiance.or(power).unwrap_or(Spanned::new(Brightness::Radiance(Rgb::WHITE), fields.head))
}
