//! Model → Snell text, as a person would have written it.

mod glossary;
pub(super) mod layout;
mod light;
mod material;
mod middle;
pub(super) mod names;
mod object;
mod picture;
pub(super) mod text;

use super::dialect::Dialect;
use super::model::{Background, Camera, Scene};
use crate::math::DVec3;
use layout::{Entry, Value, comment, paragraph};
use std::collections::BTreeSet;
use text::{color, number, point, rounded};

/// The sides of a picture whose size the original learns on its command line; square, as its pictures are.
const USUAL_SIZE: (u32, u32) = (500, 500);

/// Writes a scene. `name` is the file it came from.
pub fn write(scene: &Scene, name: &str) -> String {
    let names = glossary::Glossary::of(scene);
    let mut out = String::from("snell 1\n\n");
    out += &header(scene, name);

    let dialect = scene.detection.dialect;
    let camera = scene.camera.iter().map(|camera| camera_entry(camera, dialect)).collect();
    let sections = [
        camera,
        background(&scene.background, scene.is_classic),
        said_once(scene.lights.iter().map(|light| light::entry(light, scene, &names)).collect()),
        names.bindings(scene),
        object::entries(&scene.objects, scene, &names),
        vec![render_entry(scene)],
    ];
    for section in sections.iter().filter(|section| !section.is_empty()) {
        out.push('\n');
        out += &paragraph(section);
    }
    out
}

/// What holds for several entries is said at the first.
fn said_once(mut entries: Vec<Entry>) -> Vec<Entry> {
    let mut said = BTreeSet::new();
    for entry in &mut entries {
        entry.notes.retain(|note| said.insert(note.clone()));
    }
    entries
}

/// Where the scene came from, and what holds for all of it.
fn header(scene: &Scene, name: &str) -> String {
    let name: String = name.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    let detection = &scene.detection;
    let origin =
        format!("Converted from {name}, read as {}: {}.", detection.dialect.title(), detection.reason);
    let mut out = comment(&origin, 0);
    out += &comment("The format has no units; its lengths are metres here.", 0);
    let is_elsewhere = |root: &&String| *root != ".";
    let elsewhere: Vec<String> =
        scene.asset_roots.iter().filter(is_elsewhere).map(|root| format!("--asset-dir {root}")).collect();
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
    if let Some(height) = camera.parallel {
        let parts = vec![Entry::field("height", number(height))];
        fields.push(Entry::field("lens", Value::Block("orthographic ".into(), parts)));
    } else {
        let name = if camera.is_across { "fov_x" } else { "fov" };
        fields.push(Entry::field(name, format!("{}deg", rounded(camera.angle))).noted(&camera.angle_notes));
    }
    if let Some(lens) = &camera.lens {
        let parts =
            vec![Entry::field("radius", rounded(lens.radius)), Entry::field("focus", rounded(lens.focus))];
        let note = format!("Approximates the original's lens: {}.", lens.note);
        fields.push(Entry::field("lens", Value::Block("thin ".into(), parts)).noted(&[note]));
    }
    fields.push(film(camera, dialect));
    Entry::item(Value::Group("camera ".into(), fields)).noted(&camera.notes)
}

fn film(camera: &Camera, dialect: Dialect) -> Entry {
    let mut notes = Vec::new();
    if camera.size.is_none() {
        notes.push("The original learns the size on its command line.".into());
    }
    let (width, height) = camera.size.unwrap_or(USUAL_SIZE);
    let mut parts = vec![Entry::field("size", format!("{width} x {height}"))];
    if camera.pixel_aspect != 1.0 {
        parts.push(Entry::field("pixel_aspect", rounded(camera.pixel_aspect)));
        notes.push(
            "The original's angles of view are not in the ratio of the sides: its pixels are not square."
                .into(),
        );
    }
    if dialect == Dialect::Pa1 || dialect.is_mit() {
        parts.push(Entry::field("tone", "linear"));
        notes.push("The original stores linear values as they are.".into());
    } else {
        parts.push(Entry::field("exposure", "auto"));
        parts.push(Entry::field("tone", "srgb"));
        let note = "The original's brightness is its own, so the exposure is taken from the picture.";
        notes.push(note.into());
    }
    Entry::field("film", Value::Block(String::new(), parts)).noted(&notes)
}

/// Black needs no words: rays that meet nothing bring nothing.
fn background(background: &Background, is_classic: bool) -> Vec<Entry> {
    let radiance: Value = match &background.picture {
        Some(picture) => material::image(picture),
        None if background.color == DVec3::ZERO => {
            let notes = background.notes.iter();
            return notes.map(|note| Entry::item(layout::remark(note))).collect();
        }
        None => color(background.color).into(),
    };
    let parts = vec![Entry::field("radiance", radiance)];
    let note = "What rays see that meet nothing. In the original it lights nothing; here it lights the scene as well.";
    let note = (!is_classic).then(|| note.to_string());
    let notes: Vec<String> = background.notes.iter().cloned().chain(note).collect();
    vec![Entry::item(Value::Block("environment ".into(), parts)).noted(&notes)]
}

/// The renderer of arsenal.txt maps photons; for the others any method will do, unless their own terms are kept.
fn render_entry(scene: &Scene) -> Entry {
    let method: Value = match scene.detection.dialect {
        dialect if scene.is_classic => classic(dialect, scene.background.ambient),
        Dialect::Arsenal => "ppm".into(),
        _ => "auto".into(),
    };
    let mut parts = vec![Entry::field("method", method)];
    parts.extend(scene.settings.samples.map(|samples| Entry::field("stop", format!("samples({samples})"))));
    Entry::item(Value::Block("render ".into(), parts))
}

/// How the original adds up its terms: the course's casts no shadows and sends its rays through the corners of pixels.
fn classic(dialect: Dialect, ambient: DVec3) -> Value {
    let mut parts = Vec::new();
    if dialect == Dialect::Pa1 {
        parts.extend([
            Entry::field("shadows", "false"),
            Entry::field("backs", "dark"),
            Entry::field("pixel", "corner"),
        ]);
    }
    if ambient != DVec3::ZERO {
        parts.push(Entry::field("ambient", color(ambient)));
    }
    parts.push(Entry::field("quantise", "floor"));
    Value::Block("classic ".into(), parts)
}
