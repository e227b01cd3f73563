//! Mesh files as scenes: glTF with its nodes, cameras and lights, OBJ with its materials.
//!
//! The scene names the mesh file for its triangles, a part for each placement, so that what is placed often is kept once;
//! materials, cameras and lights are written out, to be edited. Pictures inside of the mesh file become files of their own.

mod material;
mod place;

use super::write::layout::{Entry, Value, comment, paragraph};
use super::write::names::{Names, identifier};
use super::write::text::string;
use crate::asset::gltf::{self, SceneFile};
use crate::asset::mesh::{MeshFormat, format_of};
use crate::asset::{ImportReport, MeshError, PictureSource, obj, picture};
use crate::math::DAffine3;
use glam::DVec3;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Where the files are that a converted scene names, as seen from it.
#[derive(Clone, Debug)]
pub struct Places {
    /// The mesh file.
    pub mesh: String,
    /// The folder that pictures are written to.
    pub pictures: String,
}

/// What a conversion of a mesh file yields.
#[derive(Clone, Debug)]
pub struct MeshConversion {
    /// The scene in Snell.
    pub snell: String,
    /// Pictures to write: names as the scene has them, and their bytes.
    pub pictures: Vec<(String, Arc<[u8]>)>,
    /// What was used, approximated, ignored and left out.
    pub report: ImportReport,
    /// How many things are placed, and how many materials, cameras and lights there are.
    pub counts: [usize; 4],
}

/// Whether bytes are a mesh file rather than a scene of the arsenal family: glTF by its marks, anything else by its name.
pub fn is_mesh(name: &str, bytes: &[u8]) -> bool {
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
    bytes.starts_with(b"glTF") || matches!(ending.as_deref(), Some("obj" | "gltf" | "glb"))
}

/// Converts a mesh file that is called `name`. `open` gives the bytes of a file that it names, or says why there are none.
///
/// # Errors
/// [`MeshError`] when nothing of it can be placed.
pub fn convert_mesh(
    bytes: &[u8],
    name: &str,
    places: &Places,
    open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<MeshConversion, MeshError> {
    let (scene, origin) = match format_of(bytes)? {
        MeshFormat::Gltf => (gltf::read_scene(bytes, open)?, "glTF 2.0"),
        MeshFormat::Obj => (scene_of_obj(bytes, open)?, "Wavefront OBJ"),
    };
    let pictures = Pictures::of(&scene, places, open);
    Writer { scene, places, pictures, names: Names::default() }.write(name, origin)
}

/// The faces of each material as a placement of their own.
fn scene_of_obj(
    bytes: &[u8],
    open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<SceneFile, MeshError> {
    let model = obj::read(bytes, open, None)?;
    let mut scene = SceneFile::default();
    for part in &model.parts {
        for p in part.positions.iter().map(|p| p.as_dvec3()) {
            let (low, high) = scene.bounds.unwrap_or((p, p));
            scene.bounds = Some((low.min(p), high.max(p)));
        }
        if scene.placements.iter().any(|placement| placement.part == part.name) {
            continue;
        }
        scene.placements.push(gltf::Placement {
            name: None,
            part: part.name.clone(),
            material: part.material,
            world_from_mesh: DAffine3::IDENTITY,
        });
    }
    (scene.materials, scene.pictures, scene.report) = (model.materials, model.pictures, model.report);
    Ok(scene)
}

/// A picture as the scene names it.
struct PictureFile {
    path: String,
    has_alpha: bool,
    is_missing: bool,
    /// Its bytes, if it is to be written.
    bytes: Option<Arc<[u8]>>,
}

/// The pictures of a mesh file.
struct Pictures {
    /// By their index; `None` for one that cannot be had.
    files: Vec<Option<PictureFile>>,
    /// Those that need a name, because they are part of an expression.
    bindings: RefCell<Vec<Entry>>,
}

impl Pictures {
    fn of(scene: &SceneFile, places: &Places, open: &dyn Fn(&str) -> Result<Vec<u8>, String>) -> Self {
        let mut names = Names::default();
        let folder = places.mesh.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
        let file = |picture: &crate::asset::ModelPicture| match &picture.source {
            PictureSource::File(file) => {
                let header = open(file).ok().and_then(|bytes| picture::header(&bytes).ok());
                Some(PictureFile {
                    path: format!("{folder}{file}"),
                    has_alpha: header.is_some_and(|header| header.has_alpha),
                    is_missing: header.is_none(),
                    bytes: None,
                })
            }
            PictureSource::Bytes(bytes) => {
                let header = picture::header(bytes).ok()?;
                let ending = if bytes.starts_with(b"\x89PNG") { "png" } else { "jpg" };
                let name = names.unique(&identifier(&picture.name));
                Some(PictureFile {
                    path: format!("{}/{name}.{ending}", places.pictures),
                    has_alpha: header.has_alpha,
                    is_missing: false,
                    bytes: Some(bytes.clone()),
                })
            }
            PictureSource::Nowhere(_) => None,
        };
        Self { files: scene.pictures.iter().map(file).collect(), bindings: RefCell::default() }
    }

    /// The name of a picture in an expression.
    fn named(&self, image: Value) -> String {
        let mut bindings = self.bindings.borrow_mut();
        let name = format!("map_{}", bindings.len() + 1);
        bindings.push(Entry::binding(&name, image));
        name
    }

    fn get(&self, index: usize) -> Option<&PictureFile> {
        self.files.get(index).and_then(Option::as_ref)
    }
}

struct Writer<'a> {
    scene: SceneFile,
    places: &'a Places,
    pictures: Pictures,
    names: Names,
}

impl Writer<'_> {
    fn write(mut self, name: &str, origin: &str) -> Result<MeshConversion, MeshError> {
        let (placed, bindings) = self.placed();
        if placed.is_empty() {
            return Err(MeshError::NothingLeft("everything is placed without a volume".to_owned()));
        }
        let (eyes, lamps) = (self.eyes(), self.lamps());
        let counts = [placed.len(), bindings.len(), self.scene.eyes.len(), self.scene.lamps.len()];
        let render = Entry::item(Value::Block("render ".into(), vec![Entry::field("method", "auto")]));
        let maps = self.pictures.bindings.take();
        let sections = [eyes, lamps, maps, bindings, placed, vec![render]];
        let name: String = name.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
        let mut snell = format!("snell 1\n\n{}", comment(&format!("Converted from {name}, {origin}."), 0));
        for line in self.scene.report.lines().iter().filter(|line| !line.starts_with("used")) {
            snell += &comment(&format!("{}.", capital(line)), 0);
        }
        for section in sections.iter().filter(|section| !section.is_empty()) {
            snell.push('\n');
            snell += &paragraph(section);
        }
        let used = self.pictures.files.into_iter().flatten();
        let pictures = used.filter_map(|picture| Some((picture.path, picture.bytes?))).collect();
        Ok(MeshConversion { snell, pictures, report: self.scene.report, counts })
    }

    /// Every placement, and the materials that they have.
    fn placed(&mut self) -> (Vec<Entry>, Vec<Entry>) {
        let mut material_names: BTreeMap<usize, String> = BTreeMap::new();
        let (mut placed, mut bindings) = (Vec::new(), Vec::new());
        let is_alone = self.scene.placements.len() == 1 && self.scene.placements[0].part.is_empty();
        for placement in std::mem::take(&mut self.scene.placements) {
            if !has_volume(&placement.world_from_mesh) {
                let text = format!("`{}`, which is placed without a volume", placement.part);
                self.scene.report.left_out(crate::asset::About::Shape, text);
                continue;
            }
            let mut fields = vec![Entry::field("file", string(&self.places.mesh))];
            if !is_alone {
                fields.push(Entry::field("part", string(&placement.part)));
            }
            if let Some(material) = placement.material {
                let name = material_names.entry(material).or_insert_with(|| {
                    let wish = identifier(&self.scene.materials[material].name);
                    let name = self.names.unique(&spoken(&wish, "material"));
                    let look = &self.scene.materials[material].look;
                    bindings.push(Entry::binding(&name, material::value(look, &self.pictures)));
                    name
                });
                fields.push(Entry::field("material", name.as_str()));
            }
            fields.extend(place::transform(&placement.world_from_mesh));
            let notes = placement.name.filter(|name| *name != placement.part);
            let notes: Vec<String> = notes.into_iter().map(|name| plain(&name)).collect();
            placed.push(Entry::item(Value::Block("mesh ".into(), fields)).noted(&notes));
        }
        (placed, bindings)
    }
}

/// A name that hides no word of the language.
fn spoken(wish: &str, kind: &str) -> String {
    match wish.starts_with(|c: char| c.is_ascii_digit() || c == '_') {
        true => format!("{kind}_{wish}"),
        false => format!("{wish}_{kind}"),
    }
}

/// A name without what would end a remark.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}

/// Whether a transform leaves things the volume they have, as far as that can be told from rounding.
fn has_volume(of: &DAffine3) -> bool {
    let longest = [of.matrix3.x_axis, of.matrix3.y_axis, of.matrix3.z_axis].map(DVec3::length);
    let longest = longest.into_iter().fold(0.0_f64, f64::max);
    of.is_finite() && of.matrix3.determinant().abs() > 1e-12 * longest.powi(3)
}
