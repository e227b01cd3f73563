//! Materials of mesh files in the words of the scene language.

use super::Pictures;
use crate::asset::Look;
use crate::asset::look::{GlassLook, Map, MapChannel, MapWrap, PrincipledLook, Shade};
use crate::convert::write::layout::{Entry, Value};
use crate::convert::write::text::{color, rounded, string};
use glam::DVec3;

/// A material.
pub(super) fn value(look: &Look, pictures: &Pictures) -> Value {
    let block = |head: &str, fields: Vec<Entry>| Value::Block(format!("{head} "), fields);
    let shade = |name: &str, of: &Shade| Entry::field(name, shade(of, pictures));
    match look {
        Look::Diffuse { color } => block("diffuse", vec![shade("color", color)]),
        Look::Phong { diffuse, specular, shininess } => block(
            "phong",
            vec![
                shade("diffuse", diffuse),
                Entry::field("specular", rgb(*specular)),
                Entry::field("shininess", rounded(f64::from(*shininess))),
            ],
        ),
        Look::Emissive { radiance } => block("emissive", vec![Entry::field("radiance", rgb(*radiance))]),
        Look::Glass(of) => block("glass", glass(of, pictures)),
        Look::Principled(of) => block("principled", principled(of, pictures)),
        Look::Mask { base, opacity, cutoff } => {
            let has_alpha = |map: &Map| {
                map.channel != MapChannel::Alpha
                    || pictures.get(map.picture).is_some_and(|picture| picture.has_alpha)
            };
            let opacity = match opacity.map.as_ref().is_none_or(has_alpha) {
                true => opacity.clone(),
                false => opacity.clone().times(None),
            };
            let mut fields =
                vec![Entry::field("material", value(base, pictures)), shade("opacity", &opacity)];
            fields.extend(cutoff.map(|cutoff| Entry::field("cutoff", rounded(f64::from(cutoff)))));
            block("mask", fields)
        }
        Look::NormalMap { base, map, strength } => match image(map, pictures) {
            Some(map) => {
                let mut fields =
                    vec![Entry::field("material", value(base, pictures)), Entry::field("map", map)];
                if *strength != 1.0 {
                    fields.push(Entry::field("strength", rounded(f64::from(*strength))));
                }
                block("normal_map", fields)
            }
            None => value(base, pictures),
        },
    }
}

fn glass(of: &GlassLook, pictures: &Pictures) -> Vec<Entry> {
    let mut fields = vec![Entry::field("ior", rounded(f64::from(of.ior)))];
    if !of.roughness.is_black() {
        fields.push(Entry::field("roughness", shade(&of.roughness, pictures)));
    }
    if of.tint != [1.0; 3] {
        fields.push(Entry::field("tint", rgb(of.tint)));
    }
    if let Some((left, distance)) = of.attenuation {
        let distance = rounded(f64::from(distance));
        fields.push(Entry::field("absorption", format!("{} per {distance}m", rgb(left))));
    }
    fields.extend(of.abbe.map(|abbe| Entry::field("abbe", rounded(f64::from(abbe)))));
    if of.thin {
        fields.push(Entry::field("thin", "true"));
    }
    fields
}

fn principled(of: &PrincipledLook, pictures: &Pictures) -> Vec<Entry> {
    let field = |name: &str, of: &Shade| Entry::field(name, shade(of, pictures));
    let mut fields =
        vec![field("color", &of.color), field("metallic", &of.metallic), field("roughness", &of.roughness)];
    if !of.transmission.is_black() {
        fields.push(field("transmission", &of.transmission));
    }
    if of.ior != 1.5 {
        fields.push(Entry::field("ior", rounded(f64::from(of.ior))));
    }
    if !of.clearcoat.is_black() {
        fields.push(field("clearcoat", &of.clearcoat));
        fields.push(field("clearcoat_roughness", &of.clearcoat_roughness));
    }
    if of.emission != [0.0; 3] {
        let map = of.emission_map.as_ref().map(|map| image(map, pictures));
        match map {
            None => fields.push(Entry::field("emission", rgb(of.emission))),
            Some(None) => {}
            Some(Some(image)) if of.emission == [1.0; 3] => fields.push(Entry::field("emission", image)),
            Some(Some(image)) => {
                let product = format!("{} * {}", pictures.named(image), rgb(of.emission));
                fields.push(Entry::field("emission", product));
            }
        }
    }
    fields
}

/// A colour, a picture, or a picture times a colour.
fn shade(of: &Shade, pictures: &Pictures) -> Value {
    let Some(map) = &of.map else { return rgb(of.factor).into() };
    match image(map, pictures) {
        None => rgb(of.without).into(),
        Some(image) if of.factor == [1.0; 3] => image,
        Some(image) => format!("{} * {}", pictures.named(image), rgb(of.factor)).into(),
    }
}

/// A picture; `None` if there is none that could be read.
fn image(map: &Map, pictures: &Pictures) -> Option<Value> {
    let picture = pictures.get(map.picture)?;
    let mut fields = vec![Entry::field("file", string(&picture.path))];
    let mut say = |name: &str, value: String| fields.push(Entry::field(name, value));
    let pair = |[u, v]: [f32; 2]| format!("({}, {})", rounded(f64::from(u)), rounded(f64::from(v)));
    match map.channel {
        MapChannel::Rgb => {}
        MapChannel::Red => say("channel", "red".into()),
        MapChannel::Green => say("channel", "green".into()),
        MapChannel::Blue => say("channel", "blue".into()),
        MapChannel::Alpha => say("channel", "alpha".into()),
    }
    match map.wrap {
        MapWrap::Repeat => {}
        MapWrap::Clamp => say("wrap", "clamp".into()),
        MapWrap::Mirror => say("wrap", "mirror".into()),
    }
    if !map.is_blended {
        say("filter", "nearest".into());
    }
    if map.uv_scale != [1.0; 2] {
        say("uv_scale", pair(map.uv_scale));
    }
    if map.uv_rotation != 0.0 {
        say("uv_rotation", format!("{}deg", rounded(f64::from(map.uv_rotation).to_degrees())));
    }
    if map.uv_offset != [0.0; 2] {
        say("uv_offset", pair(map.uv_offset));
    }
    if picture.is_missing {
        say("missing", "skip".into());
    }
    Some(match fields.len() {
        1 => format!("image({})", string(&picture.path)).into(),
        _ => Value::Block("image ".into(), fields),
    })
}

/// A linear colour; greys are plain numbers.
fn rgb(of: [f32; 3]) -> String {
    color(DVec3::from_array(of.map(f64::from)))
}
