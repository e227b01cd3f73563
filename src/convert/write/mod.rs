//! Model → Snell text, as a person would have written it.

mod glossary;
mod layout;
mod middle;
mod names;
mod object;
mod picture;
mod text;

use super::dialect::{Detection, Dialect};
use super::model::{Background, Camera, Light, Look, Scene, Texture};
use crate::math::DVec3;
use layout::{Entry, Value, comment, paragraph};
use std::f64::consts::PI;
use text::{color, number, point, rough, rough_color, rounded, string};

/// Writes a scene. `name` is the file it came from, `asset_roots` where its files were found.
pub fn write(scene: &Scene, name: &str, detection: &Detection, asset_roots: &[String]) -> String {
    let names = glossary::Glossary::of(scene);
    let mut out = String::from("snell 1\n\n");
    out += &header(name, detection, asset_roots);

    let light_items: Vec<Entry> = scene.lights.iter().map(|light| light_entry(light, scene)).collect();
    let camera = scene.camera.iter().map(|camera| camera_entry(camera, scene.dialect)).collect();
    let sections = [
        camera,
        background(&scene.background),
        light_items,
        names.bindings(scene),
        object::entries(&scene.objects, scene, &names),
        vec![render_entry(scene.dialect)],
    ];
    for section in sections.iter().filter(|section| !section.is_empty()) {
        out.push('\n');
        out += &paragraph(section);
    }
    out
}

/// Where the scene came from, and what holds for all of it.
fn header(name: &str, detection: &Detection, asset_roots: &[String]) -> String {
    let name: String = name.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    let Detection { dialect, reason } = detection;
    let mut out = comment(&format!("Converted from {name}, read as {}: {reason}.", dialect.title()), 0);
    out += &comment("The format has no units; its lengths are metres here.", 0);
    let elsewhere: Vec<String> =
        asset_roots.iter().filter(|root| *root != ".").map(|root| format!("--asset-dir {root}")).collect();
    if !elsewhere.is_empty() {
        let note = format!(
            "Its files lie elsewhere: render it, from the original's folder, with `{}`.",
            elsewhere.join(" ")
        );
        out += &comment(&note, 0);
    }
    out
}

fn camera_entry(camera: &Camera, dialect: Dialect) -> Entry {
    let mut fields = vec![
        Entry::field("position", point(camera.center)),
        Entry::field("direction", point(camera.direction)),
    ];
    if camera.up != DVec3::Y {
        fields.push(Entry::field("up", point(camera.up)));
    }
    fields.push(Entry::field("fov", format!("{}deg", rounded(camera.angle))).noted(&camera.notes));
    if let Some(lens) = &camera.lens {
        let parts =
            vec![Entry::field("radius", rounded(lens.radius)), Entry::field("focus", number(lens.focus))];
        let note = format!("Approximates the original's lens: {}.", lens.note);
        fields.push(Entry::field("lens", Value::Block("thin ".into(), parts)).noted(&[note]));
    }
    fields.push(film(camera, dialect));
    Entry::item(Value::Group("camera ".into(), fields))
}

fn film(camera: &Camera, dialect: Dialect) -> Entry {
    let mut parts = Vec::new();
    if let Some((width, height)) = camera.size {
        parts.push(Entry::field("size", format!("{width} x {height}")));
    }
    let note = match dialect {
        Dialect::Pa1 => {
            parts.push(Entry::field("tone", "linear"));
            "The original stores linear values as they are."
        }
        _ => {
            parts.push(Entry::field("exposure", "auto"));
            parts.push(Entry::field("tone", "srgb"));
            "The original's brightness is its own, so the exposure is taken from the picture."
        }
    };
    Entry::field("film", Value::Block(String::new(), parts)).noted(&[note.into()])
}

/// Black needs no words: rays that meet nothing bring nothing.
fn background(background: &Background) -> Vec<Entry> {
    if background.color == DVec3::ZERO {
        return Vec::new();
    }
    let parts = vec![Entry::field("radiance", color(background.color))];
    let note = "What rays see that meet nothing. In the original it lights nothing; here it lights the scene as well.";
    let notes: Vec<String> = background.notes.iter().cloned().chain([note.to_string()]).collect();
    vec![Entry::item(Value::Block("environment ".into(), parts)).noted(&notes)]
}

/// A light of the course, matched where it can be.
///
/// There a light of colour c makes a surface of reflectance r that faces it shine with c r; here radiance r E / pi
/// leaves it. So E = pi c, and for a point light at distance d an intensity of pi c d^2.
fn light_entry(light: &Light, scene: &Scene) -> Entry {
    match light {
        Light::Point { position, color: c } => {
            let distance = match middle::of(&scene.objects).distance(*position) {
                0.0 => 1.0,
                distance => distance,
            };
            let note = format!(
                "The original's light is {} at every distance and passes through everything. This one has that \
                 brightness {} away, at the middle of the scene, and casts shadows.",
                color(*c),
                rough(distance)
            );
            let parts = vec![
                Entry::field("position", point(*position)),
                Entry::field("intensity", rough_color(*c * (PI * distance * distance))),
            ];
            Entry::item(Value::Block("light point ".into(), parts)).noted(&[note])
        }
        Light::Sphere { center, radius, radiance } => {
            let parts = vec![
                Entry::field("center", point(*center)),
                Entry::field("radius", number(*radius)),
                Entry::field("radiance", color(*radiance)),
            ];
            Entry::item(Value::Block("light sphere ".into(), parts))
        }
        Light::Rect { origin, edge_u, edge_v, radiance } => {
            let parts = vec![
                Entry::field("origin", point(*origin)),
                Entry::field("edge_u", point(*edge_u)),
                Entry::field("edge_v", point(*edge_v)),
                Entry::field("radiance", color(*radiance)),
                Entry::field("two_sided", "true"),
            ];
            let note = "Programs differ on which side such a light shines to; here it is both.";
            Entry::item(Value::Block("light rect ".into(), parts)).noted(&[note.into()])
        }
        Light::Directional { direction, color: c } => {
            let luminance = c.dot(DVec3::new(0.2126, 0.7152, 0.0722)); // Rec. 709
            let mut parts = vec![
                Entry::field("direction", point(*direction)),
                Entry::field("irradiance", rough(PI * luminance)),
            ];
            if luminance > 0.0 && !(c.x == c.y && c.y == c.z) {
                parts.push(Entry::field("color", rough_color(*c / luminance)));
            }
            let note = format!(
                "As bright on a facing surface as the original's {}; there it casts no shadows.",
                color(*c)
            );
            Entry::item(Value::Block("light directional ".into(), parts)).noted(&[note])
        }
    }
}

fn material_value(look: &Look) -> Value {
    let block = |head: &str, fields: Vec<Entry>| Value::Block(format!("{head} "), fields);
    match look {
        Look::Diffuse { color } => block("diffuse", vec![texture_field("color", color)]),
        Look::Phong { diffuse, specular, shininess } => block(
            "phong",
            vec![
                texture_field("diffuse", diffuse),
                Entry::field("specular", color(*specular)),
                Entry::field("shininess", number(*shininess)),
            ],
        ),
        Look::Mirror { color } => block("mirror", vec![texture_field("color", color)]),
        Look::Metal { color: c, roughness } => block(
            "metal",
            vec![Entry::field("color", color(*c)), Entry::field("roughness", rounded(*roughness))],
        ),
        Look::Glass { ior, tint } => glass(*ior, *tint),
        Look::Emissive { radiance } => block("emissive", vec![Entry::field("radiance", color(*radiance))]),
        Look::Mix { weights, color, ior } => mix(*weights, color, *ior),
        Look::Placeholder => block("diffuse", vec![Entry::field("color", "0.5")]),
    }
}

fn glass(ior: f64, tint: DVec3) -> Value {
    let fields = vec![Entry::field("ior", number(ior)), Entry::field("tint", color(tint))];
    Value::Block("glass ".into(), fields)
}

/// `mix` joins two materials, so three of them take two: `amount` is the share of `b`.
fn mix([diffuse, mirror, glass_share]: [f64; 3], tint: &Texture, ior: f64) -> Value {
    let two = |a: Value, b: Value, amount: f64| {
        let fields =
            vec![Entry::field("a", a), Entry::field("b", b), Entry::field("amount", rounded(amount))];
        Value::Block("mix ".into(), fields)
    };
    let matte = Value::Block("diffuse ".into(), vec![texture_field("color", tint)]);
    let shiny = Value::Block("mirror ".into(), vec![texture_field("color", tint)]);
    let clear = glass(ior, tint.color);
    let specular = mirror + glass_share;
    match (diffuse > 0.0, mirror > 0.0, glass_share > 0.0) {
        (true, true, true) => two(matte, two(shiny, clear, glass_share / specular), specular),
        (true, true, false) => two(matte, shiny, mirror),
        (true, false, _) => two(matte, clear, glass_share),
        (false, ..) => two(shiny, clear, glass_share / specular),
    }
}

fn texture_field(name: &str, texture: &Texture) -> Entry {
    let Some(picture) = &texture.picture else { return Entry::field(name, color(texture.color)) };
    if !picture.missing {
        return Entry::field(name, format!("image({})", string(&picture.path)));
    }
    let parts = vec![Entry::field("file", string(&picture.path)), Entry::field("missing", "skip")];
    Entry::field(name, Value::Block("image ".into(), parts))
}

/// The renderer of arsenal.txt maps photons; for the others any method will do.
fn render_entry(dialect: Dialect) -> Entry {
    let method = if dialect == Dialect::Arsenal { "ppm" } else { "auto" };
    Entry::item(Value::Block("render ".into(), vec![Entry::field("method", method)]))
}
