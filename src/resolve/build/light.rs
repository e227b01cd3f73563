//! Lights, and the environment.

use super::sun;
use crate::ir::light::{Daylight, EnvironmentRadiance};
use crate::ir::shape::upright;
use crate::ir::{Brightness, Environment, Light, LightKind, Material, MaterialKind, TextureKind};
use crate::math::{DVec3, Rgb};
use crate::resolve::error::Error;
use crate::resolve::fields::Fields;
use crate::resolve::node::{Node, NodeKind};
use crate::resolve::{Env, Resolver, Value};
use crate::schema;
use crate::source::{Span, Spanned};
use crate::syntax::ast::Object;
use std::rc::Rc;

impl<'a> Resolver<'a> {
    /// The light of a block; it may stand in a group and is moved with it.
    pub(super) fn light(&mut self, fields: &Fields<'a>, span: Span) -> Option<Rc<Node>> {
        if fields.block.kind == "light mesh" {
            return self.glowing(fields, span);
        }
        let kind = self.light_kind(fields)?;
        let brightness = brightness(fields)?;
        let color =
            fields.block.field("color").map_or(Some(Rgb::WHITE), |_| Some(fields.color("color")?.value))?;
        let light = Light { kind, brightness, color, span, trail: Vec::new(), moves: None };
        self.node(NodeKind::Light(Box::new(light)), Rc::new([]), None, span)
    }

    /// An object that is placed with a material that shines.
    fn glowing(&mut self, fields: &Fields<'a>, span: Span) -> Option<Rc<Node>> {
        let Value::Object(object) = &fields.value("object")?.value else { return None };
        let kind = MaterialKind::Emissive {
            brightness: brightness(fields)?,
            map: None,
            color: fields.color("color")?.value,
        };
        let material = Material { kind, span, name: None, calls: self.calls_here() };
        let material = Some(self.scene.materials.push(material));
        self.node(NodeKind::Place(Rc::clone(object)), Rc::new([]), material, span)
    }

    fn light_kind(&mut self, fields: &Fields<'a>) -> Option<LightKind> {
        Some(match fields.block.kind {
            "light disk" => {
                let normal = fields.triple("normal")?;
                let Some(n) = normal.value.try_normalize() else {
                    let why = "a vector of length 0 has no direction".to_owned();
                    let help = "write the way it faces, such as `(0, -1, 0)`".to_owned();
                    self.report(Error::NotFinite { why, used: normal.span, help });
                    return None;
                };
                let radius = fields.number("radius")?;
                let m = upright(n, DVec3::ZERO).matrix3;
                let (edge_u, edge_v) = (m.z_axis * radius.value, m.x_axis * radius.value);
                let (center, two_sided) = (fields.triple("center")?.value, fields.flag("two_sided")?);
                LightKind::Disk { center, edge_u, edge_v, radius, two_sided }
            }
            _ => light_kind(fields)?,
        })
    }

    /// `environment { .. }`: one in a scene.
    pub(in crate::resolve) fn environment(&mut self, object: &'a Object, env: &Env<'a>) {
        let block = schema::block("environment").expect("declared in the registry");
        let fields = self.read(block, object.kind.span, &object.body, env);
        if let Some(first) = self.environment {
            let second = object.kind.span;
            return self.report(Error::SecondBlock { kind: "environment", second, first });
        }
        self.environment = Some(object.kind.span);
        let (Some(scale), Some(rotation)) = (fields.number("scale"), fields.number("rotation")) else {
            return;
        };
        let radiance = match fields.value("radiance") {
            Some(Spanned { value: Value::Texture(handle), span }) => {
                if !matches!(self.scene.textures[*handle].kind, TextureKind::Image(_)) {
                    self.wrong_type("a colour or an image", "a checker", *span, "write `image(\"sky.hdr\")`");
                    return;
                }
                EnvironmentRadiance::Image(*handle)
            }
            _ => EnvironmentRadiance::Constant(
                fields.color("radiance").map_or(Rgb::WHITE, |color| color.value),
            ),
        };
        let span = object.span;
        self.scene.environment = Some(Environment { radiance, scale, rotation: rotation.value, span });
    }
}

fn light_kind(fields: &Fields) -> Option<LightKind> {
    let point = |name| fields.triple(name).map(|point| point.value);
    Some(match fields.block.kind {
        "light point" => LightKind::Point { position: point("position")?, falloff: falloff(fields) },
        "light spot" => LightKind::Spot {
            position: point("position")?,
            direction: aim(fields)?,
            angle: fields.number("angle")?,
            blend: fields.number("blend")?,
            falloff: falloff(fields),
        },
        "light sun_sky" => LightKind::SunSky(Daylight {
            to_sun: to_sun(fields)?,
            turbidity: fields.number("turbidity")?,
            ground: fields.color("ground")?.value,
            sun: fields.flag("sun")?,
            sun_size: fields.number("sun_size")?,
        }),
        "light sphere" => LightKind::Sphere { center: point("center")?, radius: fields.number("radius")? },
        "light rect" => LightKind::Rect {
            origin: point("origin")?,
            edge_u: point("edge_u")?,
            edge_v: point("edge_v")?,
            two_sided: fields.flag("two_sided")?,
        },
        _ => LightKind::Directional { direction: fields.triple("direction")? },
    })
}

/// The way a light shines that is told a direction or a point.
fn aim(fields: &Fields) -> Option<Spanned<DVec3>> {
    let from = fields.triple("position")?.value;
    let towards = fields.triple("look_at").map(|target| target.map(|target| target - from));
    towards.or_else(|| fields.triple("direction"))
}

/// The way to the sun: said, by angles, or by place and time.
fn to_sun(fields: &Fields) -> Option<Spanned<DVec3>> {
    if let Some(direction) = fields.triple("direction") {
        return Some(direction);
    }
    if let Some(elevation) = fields.number("elevation") {
        let azimuth = fields.number("azimuth")?.value;
        return Some(elevation.map(|elevation| sun::by_angles(elevation, azimuth)));
    }
    let latitude = fields.number("latitude")?;
    let longitude = fields.number("longitude")?.value;
    let (day, hour) = (fields.number("day")?.value, fields.number("hour")?.value);
    let zone = fields.number("zone")?.value;
    Some(latitude.map(|latitude| sun::by_place_and_time(latitude, longitude, day, hour, zone)))
}

fn falloff(fields: &Fields) -> Spanned<[f64; 3]> {
    match fields.value("falloff") {
        Some(Spanned { value: Value::Word("none"), span }) => Spanned::new([1.0, 0.0, 0.0], *span),
        Some(slot) => {
            Spanned::new(slot.triple().map_or(LightKind::PHYSICAL, |abc| abc.to_array()), slot.span)
        }
        None => Spanned::new(LightKind::PHYSICAL, fields.head),
    }
}

fn brightness(fields: &Fields) -> Option<Spanned<Brightness>> {
    if let Some(scale) = fields.block.field("scale").and_then(|_| fields.number("scale")) {
        return Some(scale.map(|scale| Brightness::Radiance(Rgb::gray(scale as f32))));
    }
    if let Some(irradiance) = fields.number("irradiance") {
        return Some(irradiance.map(Brightness::Irradiance));
    }
    let power = fields.number("power").map(|power| power.map(Brightness::Power));
    let intensity = fields.color("intensity").map(|color| color.map(Brightness::Intensity));
    power.or(intensity).or_else(|| Some(fields.color("radiance")?.map(Brightness::Radiance)))
}
