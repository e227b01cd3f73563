//! Lights, and the environment.

use crate::ir::light::EnvironmentRadiance;
use crate::ir::{Brightness, Environment, Light, LightKind, TextureKind};
use crate::math::Rgb;
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
        let kind = light_kind(fields)?;
        let brightness = brightness(fields)?;
        let color = fields.color("color")?.value;
        let light = Light { kind, brightness, color, span, trail: Vec::new() };
        self.node(NodeKind::Light(Box::new(light)), Rc::new([]), None, span)
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
    if let Some(irradiance) = fields.number("irradiance") {
        return Some(irradiance.map(Brightness::Irradiance));
    }
    let power = fields.number("power").map(|power| power.map(Brightness::Power));
    let intensity = fields.color("intensity").map(|color| color.map(Brightness::Intensity));
    power.or(intensity).or_else(|| Some(fields.color("radiance")?.map(Brightness::Radiance)))
}
