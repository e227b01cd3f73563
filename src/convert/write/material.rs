//! Materials and their pictures.

use super::glossary::Glossary;
use super::layout::{Entry, Value};
use super::text::{color, number, rounded, string};
use crate::convert::model::{Asset, Look, Pattern, Texture};
use crate::math::DVec3;

pub fn material_value(look: &Look, names: &Glossary) -> Value {
    let block = |head: &str, fields: Vec<Entry>| Value::Block(format!("{head} "), fields);
    match look {
        Look::Diffuse { color } => block("diffuse", vec![texture_field("color", color)]),
        Look::Phong { diffuse, specular, shininess } => block(
            "phong",
            vec![
                texture_field("diffuse", diffuse),
                Entry::field("specular", color(*specular)),
                Entry::field("shininess", rounded(*shininess)),
            ],
        ),
        Look::Mirror { color } => block("mirror", vec![texture_field("color", color)]),
        Look::Metal { color, roughness } => block(
            "metal",
            vec![texture_field("color", color), Entry::field("roughness", rounded(*roughness))],
        ),
        Look::Glass { ior, tint, roughness } => glass(*ior, *tint, *roughness),
        Look::Emissive { radiance } => block("emissive", vec![Entry::field("radiance", color(*radiance))]),
        Look::Whitted { diffuse, specular, shininess, reflection, transmission, ior, fresnel } => {
            let mut fields = vec![texture_field("diffuse", diffuse)];
            let mut add = |name, factor: DVec3| {
                if factor != DVec3::ZERO {
                    fields.push(Entry::field(name, color(factor)));
                }
            };
            add("specular", *specular);
            add("reflection", *reflection);
            add("transmission", *transmission);
            if *specular != DVec3::ZERO && *shininess > 0.0 {
                fields.push(Entry::field("shininess", rounded(*shininess)));
            }
            if *transmission != DVec3::ZERO {
                fields.push(Entry::field("ior", number(*ior)));
            }
            if *fresnel {
                fields.push(Entry::field("fresnel", "true"));
            }
            block("whitted", fields)
        }
        Look::Mix(lobes) => mix(lobes, names),
        Look::Solid { parts: [a, b], pattern } => {
            let amount = pattern.map_or("0.5".into(), |pattern| solid(&pattern, [DVec3::ZERO, DVec3::ONE]));
            let fields = vec![
                Entry::field("a", names.material(*a)),
                Entry::field("b", names.material(*b)),
                Entry::field("amount", amount),
            ];
            block("mix", fields)
        }
        Look::Placeholder => block("diffuse", vec![Entry::field("color", "0.5")]),
    }
}

fn glass(ior: f64, tint: DVec3, roughness: f64) -> Value {
    let mut fields = vec![Entry::field("ior", number(ior)), Entry::field("tint", color(tint))];
    if roughness > 0.0 {
        fields.push(Entry::field("roughness", rounded(roughness)));
    }
    Value::Block("glass ".into(), fields)
}

/// `mix` joins two materials, so more of them nest: `amount` is the share of `b` in what is left.
fn mix(lobes: &[(f64, Look)], names: &Glossary) -> Value {
    let [(_, first), rest @ ..] = lobes else { return "diffuse {}".into() };
    let a = material_value(first, names);
    if rest.is_empty() {
        return a;
    }
    let share = |lobes: &[(f64, Look)]| lobes.iter().map(|(share, _)| share).sum::<f64>();
    let amount = share(rest) / share(lobes);
    let fields = vec![
        Entry::field("a", a),
        Entry::field("b", mix(rest, names)),
        Entry::field("amount", rounded(amount)),
    ];
    Value::Block("mix ".into(), fields)
}

fn texture_field(name: &str, texture: &Texture) -> Entry {
    match (&texture.picture, &texture.blend) {
        (Some(picture), _) => Entry::field(name, image(picture)),
        (None, Some((colors, pattern))) => Entry::field(name, solid(pattern, *colors)),
        (None, None) => Entry::field(name, color(texture.color)),
    }
}

/// A pattern between two colours.
fn solid(pattern: &Pattern, [a, b]: [DVec3; 2]) -> Value {
    let (head, size, own) = match pattern {
        Pattern::Checker { size } => ("checker ", size, None),
        Pattern::Noise { size, octaves } => ("noise ", size, Some(("octaves", octaves.to_string()))),
        Pattern::Marble { size, turbulence } => ("marble ", size, Some(("turbulence", rounded(*turbulence)))),
        Pattern::Wood { size, turbulence } => ("wood ", size, Some(("turbulence", rounded(*turbulence)))),
    };
    let mut fields =
        vec![Entry::field("a", color(a)), Entry::field("b", color(b)), Entry::field("size", rounded(*size))];
    fields.extend(own.map(|(name, value)| Entry::field(name, value)));
    Value::Block(head.into(), fields)
}

/// A picture; one that is not beside the scene may be missing, which then is no mistake.
pub fn image(picture: &Asset) -> Value {
    if picture.beside {
        return format!("image({})", string(&picture.path)).into();
    }
    let parts = vec![Entry::field("file", string(&picture.path)), Entry::field("missing", "skip")];
    Value::Block("image ".into(), parts)
}
