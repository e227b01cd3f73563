//! Where things are: transforms, cameras and lights.

use super::{Writer, spoken};
use crate::asset::gltf::{Eye, Lamp, LampKind, Sight};
use crate::convert::write::layout::{Entry, Value};
use crate::convert::write::names::identifier;
use crate::convert::write::text::{color, point, rounded, rounded_point};
use crate::math::DAffine3;
use glam::DVec3;

/// Lumens that make a watt, for all of this project's light (LANGUAGE: power).
const LUMENS: f64 = 683.0;
/// The height of the film, in pixels.
const HEIGHT: f64 = 480.0;

/// The field that moves a thing to its place; none for what lies where it was made.
pub(super) fn transform(world_from_mesh: &DAffine3) -> Option<Entry> {
    let (m, t) = (world_from_mesh.matrix3, world_from_mesh.translation);
    if *world_from_mesh == DAffine3::IDENTITY {
        return None;
    }
    if m == crate::math::DMat3::IDENTITY {
        return Some(Entry::field("transform", format!("translate{}", rounded_point(t))));
    }
    let row = |r: usize| {
        let numbers = [m.x_axis[r], m.y_axis[r], m.z_axis[r], t[r]].map(rounded);
        numbers.join(", ")
    };
    let matrix = format!("matrix([{}, {}, {}, 0, 0, 0, 1])", row(0), row(1), row(2));
    Some(Entry::field("transform", matrix))
}

impl Writer<'_> {
    /// The cameras; one that sees everything, if the file has none.
    pub(super) fn eyes(&mut self) -> Vec<Entry> {
        let eyes = std::mem::take(&mut self.scene.eyes);
        if eyes.is_empty() {
            return self.usual_eye().into_iter().collect();
        }
        let entries = eyes.iter().map(|eye| self.eye(eye, eyes.len() > 1)).collect();
        self.scene.eyes = eyes;
        entries
    }

    fn eye(&mut self, eye: &Eye, is_named: bool) -> Entry {
        let m = eye.world_from_eye.matrix3;
        let mut fields = vec![
            Entry::field("position", point(eye.world_from_eye.translation)),
            Entry::field("direction", rounded_point(-m.z_axis.normalize_or(DVec3::Z))),
        ];
        let up = m.y_axis.normalize_or(DVec3::Y);
        if (up - DVec3::Y).length() > 1e-9 {
            fields.push(Entry::field("up", rounded_point(up)));
        }
        let aspect = match eye.sight {
            Sight::Perspective { fov, aspect } => {
                let degrees = fov.to_degrees().clamp(0.01, 179.0);
                fields.push(Entry::field("fov", format!("{}deg", rounded(degrees))));
                aspect.unwrap_or(4.0 / 3.0)
            }
            Sight::Orthographic { half } => {
                let height = vec![Entry::field("height", format!("{}m", rounded(2.0 * half[1])))];
                fields.push(Entry::field("lens", Value::Block("orthographic ".into(), height)));
                (half[0] / half[1]).clamp(0.01, 100.0)
            }
        };
        fields.push(film(aspect));
        let wish = eye.name.as_deref().map_or_else(|| "view".to_owned(), identifier);
        let head = match is_named {
            true => format!("camera {} ", self.names.unique(&spoken(&wish, "camera"))),
            false => "camera ".to_owned(),
        };
        Entry::item(Value::Group(head, fields))
    }

    /// A camera before everything and above it, that sees all of it.
    fn usual_eye(&self) -> Option<Entry> {
        let (low, high) = self.scene.bounds?;
        let (middle, half) = ((low + high) / 2.0, ((high - low) / 2.0).length().max(1e-6));
        // A ball around all of it just fits into an angle of 40 degrees.
        let distance = half / libm::sin(20_f64.to_radians());
        let position = middle + DVec3::new(0.5, 0.4, 1.0).normalize() * distance;
        let fields = vec![
            Entry::field("position", rounded_point(position)),
            Entry::field("look_at", rounded_point(middle)),
            Entry::field("fov", "40deg"),
            film(4.0 / 3.0),
        ];
        let note = "The file has no camera: this one sees all of it.".to_owned();
        Some(Entry::item(Value::Group("camera ".into(), fields)).noted(&[note]))
    }

    /// The lights; light from all around, if nothing shines.
    pub(super) fn lamps(&mut self) -> Vec<Entry> {
        let entries: Vec<Entry> = self.scene.lamps.iter().filter_map(lamp).collect();
        let shines = self.scene.materials.iter().any(|material| material.look.shines());
        if !entries.is_empty() || shines {
            return entries;
        }
        let note = "The file has no light: this comes from all around.".to_owned();
        let fields = vec![Entry::field("radiance", "1")];
        vec![Entry::item(Value::Block("environment ".into(), fields)).noted(&[note])]
    }
}

fn film(aspect: f64) -> Entry {
    let width = (HEIGHT * aspect).round().clamp(1.0, 65_536.0);
    let fields = vec![
        Entry::field("size", format!("{width} x {HEIGHT}")),
        Entry::field("exposure", "auto"),
        Entry::field("tone", "agx"),
    ];
    Entry::field("film", Value::Block(String::new(), fields))
}

/// A light; `None` for one that sends out nothing.
fn lamp(of: &Lamp) -> Option<Entry> {
    let position = Entry::field("position", point(of.world_from_lamp.translation));
    let along = -of.world_from_lamp.matrix3.z_axis.normalize_or(DVec3::Z);
    let direction = Entry::field("direction", rounded_point(along));
    let brightness = rounded(of.intensity / LUMENS);
    let (head, mut fields) = match of.kind {
        LampKind::Point => ("light point ", vec![position, Entry::field("intensity", brightness)]),
        LampKind::Directional => {
            ("light directional ", vec![direction, Entry::field("irradiance", brightness)])
        }
        LampKind::Spot { inner, outer } => {
            let angle = (2.0 * outer.to_degrees()).clamp(0.1, 179.9);
            let blend = rounded((1.0 - inner / outer).clamp(0.0, 1.0));
            let cone =
                [Entry::field("angle", format!("{}deg", rounded(angle))), Entry::field("blend", blend)];
            let mut fields = vec![position, direction];
            fields.extend(cone);
            fields.push(Entry::field("intensity", brightness));
            ("light spot ", fields)
        }
    };
    let tint = DVec3::from_array(of.color);
    if tint != DVec3::ONE {
        fields.push(Entry::field("color", color(tint)));
    }
    let notes: Vec<String> = of.name.iter().map(|name| super::plain(name)).collect();
    let is_lit = of.intensity > 0.0 && tint != DVec3::ZERO;
    is_lit.then(|| Entry::item(Value::Block(head.into(), fields)).noted(&notes))
}
