//! Lights, matched in brightness where they can be.

use super::glossary::Glossary;
use super::layout::{Entry, Value};
use super::material::material_value;
use super::text::{color, number, point, rough, rough_color, rounded};
use super::{middle, object};
use crate::convert::model::{Cone, Light, Look, Scene};
use crate::math::DVec3;
use std::f64::consts::PI;

/// A light of the course.
///
/// There a light of colour c makes a surface of reflectance r that faces it shine with c r; here radiance r E / pi
/// leaves it. So E = pi c, and for a point light at distance d an intensity of pi c d^2.
pub fn entry(light: &Light, scene: &Scene, names: &Glossary) -> Entry {
    match light {
        Light::Point { position, cone, color, falloff, notes } if scene.is_classic => {
            classic_point(*position, *cone, *color, *falloff).noted(notes)
        }
        Light::Directional { direction, color } if scene.is_classic => {
            classic_directional(*direction, *color)
        }
        Light::Point { position, cone, color, falloff, notes } => {
            point_light(*position, *cone, *color, *falloff, scene).noted(notes)
        }
        Light::Sphere { center, radius, radiance } => {
            let parts = vec![
                Entry::field("center", point(*center)),
                Entry::field("radius", number(*radius)),
                Entry::field("radiance", color(*radiance)),
            ];
            Entry::item(Value::Block("light sphere ".into(), parts))
        }
        Light::Rect { origin, edge_u, edge_v, radiance, notes } => {
            let parts = vec![
                Entry::field("origin", point(*origin)),
                Entry::field("edge_u", point(*edge_u)),
                Entry::field("edge_v", point(*edge_v)),
                Entry::field("radiance", color(*radiance)),
                Entry::field("two_sided", "true"),
            ];
            Entry::item(Value::Block("light rect ".into(), parts)).noted(notes)
        }
        Light::Directional { direction, color } => directional(*direction, *color),
        Light::Glowing { object, radiance } => {
            let glow = material_value(&Look::Emissive { radiance: *radiance }, names);
            object::glowing(object, glow, scene, names)
        }
    }
}

/// The original's light as it is, with its own law of fading.
fn classic_point(position: DVec3, cone: Option<Cone>, light: DVec3, falloff: DVec3) -> Entry {
    let (head, mut parts) = from_point(position, cone);
    parts.push(Entry::field("intensity", color(light)));
    if falloff == DVec3::X {
        parts.push(Entry::field("falloff", "none"));
    } else if falloff != DVec3::Z {
        parts.push(Entry::field("falloff", point(falloff)));
    }
    Entry::item(Value::Block(head.into(), parts))
}

/// The head of a light at a point, and where it shines.
fn from_point(position: DVec3, cone: Option<Cone>) -> (&'static str, Vec<Entry>) {
    let mut parts = vec![Entry::field("position", point(position))];
    let Some(Cone { direction, angle, blend }) = cone else { return ("light point ", parts) };
    parts.extend([
        Entry::field("direction", point(direction)),
        Entry::field("angle", format!("{}deg", rounded(angle))),
        Entry::field("blend", rounded(blend)),
    ]);
    ("light spot ", parts)
}

fn classic_directional(direction: DVec3, light: DVec3) -> Entry {
    let parts = vec![
        Entry::field("direction", point(direction)),
        Entry::field("irradiance", "1"),
        Entry::field("color", color(light)),
    ];
    Entry::item(Value::Block("light directional ".into(), parts))
}

/// Intensity such that the light is as bright at the middle of the scene as the original's there.
fn point_light(position: DVec3, cone: Option<Cone>, light: DVec3, falloff: DVec3, scene: &Scene) -> Entry {
    let distance = match middle::of(&scene.objects).distance(position) {
        0.0 => 1.0,
        distance => distance,
    };
    let DVec3 { x: a, y: b, z: e } = falloff;
    let square = distance * distance;
    // The inverse square law is that of nature, at every distance.
    let is_natural = a == 0.0 && b == 0.0;
    let factor = if is_natural { 1.0 / e } else { square / (a + b * distance + e * square) };
    let note = if is_natural {
        "As bright as the original's, which falls off as this one does.".to_string()
    } else if falloff == DVec3::X {
        format!(
            "The original's light is {} at every distance and passes through everything. This one has that \
             brightness {} away, at the middle of the scene, and casts shadows.",
            color(light),
            rough(distance)
        )
    } else {
        format!(
            "The original's light is {} / ({} + {} d + {} d^2) at distance d. This one has that brightness {} away, \
             at the middle of the scene.",
            color(light),
            rough(a),
            rough(b),
            rough(e),
            rough(distance)
        )
    };
    let (head, mut parts) = from_point(position, cone);
    parts.push(Entry::field("intensity", rough_color(light * (PI * factor))));
    Entry::item(Value::Block(head.into(), parts)).noted(&[note])
}

fn directional(direction: DVec3, light: DVec3) -> Entry {
    let luminance = light.dot(DVec3::new(0.2126, 0.7152, 0.0722)); // Rec. 709
    let mut parts =
        vec![Entry::field("direction", point(direction)), Entry::field("irradiance", rough(PI * luminance))];
    if luminance > 0.0 && !(light.x == light.y && light.y == light.z) {
        parts.push(Entry::field("color", rough_color(light / luminance)));
    }
    let note = format!(
        "As bright on a facing surface as the original's {}; there it may cast no shadows.",
        color(light)
    );
    Entry::item(Value::Block("light directional ".into(), parts)).noted(&[note])
}
