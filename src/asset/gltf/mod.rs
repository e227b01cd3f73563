//! glTF 2.0, as JSON or binary.
//!
//! Nothing of a file is believed before it is checked: every index, range and count, so that nothing is read beyond its
//! buffer and nothing is allocated that the file does not back. What cannot be used is left out and told; a file is
//! refused only when it is none, asks for an extension without which its triangles are wrong, or has nothing left.
//!
//! The text is read as plain JSON, because a reader with fixed types refuses a whole file for a wrong word anywhere in it.

mod access;
mod container;
mod json;
mod material;
mod nodes;
mod primitive;
mod scene;
mod texture;

use super::model::{MeshError, Model, Part, speakable};
use super::report::{About, ImportReport};
use crate::math::DAffine3;
use access::Buffers;
use json::At;
use material::Read;
use nodes::Placed;
use primitive::{Lost, MOST_TRIANGLES, Pose, Reader, turned_normal};
use rustc_hash::FxHashMap;
use serde_json::Value;
use std::rc::Rc;
use texture::Textures;

pub use scene::{Eye, Lamp, LampKind, Placement, SceneFile, Sight, read_scene};

/// Required extensions without which triangles are still right: those of materials and pictures, and whole numbers for
/// positions.
fn is_harmless(extension: &str) -> bool {
    const OTHERS: [&str; 7] = [
        "KHR_texture_transform",
        "KHR_lights_punctual",
        "KHR_mesh_quantization",
        "KHR_texture_basisu",
        "EXT_texture_webp",
        "EXT_texture_avif",
        "MSFT_texture_dds",
    ];
    extension.starts_with("KHR_materials_") || OTHERS.contains(&extension)
}

/// Whether bytes are glTF, in either form.
pub fn is_gltf(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    container::is_binary(bytes) || text.trim_ascii_start().first() == Some(&b'{')
}

/// Reads a glTF file: all that its scene places, each thing in its place; or one part, which is a primitive of a mesh, in
/// the mesh's own frame. `open` gives the bytes of a file that it names, or says why there are none.
///
/// # Errors
/// [`MeshError`] with the place where that is known.
pub fn read(
    bytes: &[u8],
    open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    part: Option<&str>,
) -> Result<Model, MeshError> {
    with_file(bytes, open, |mut file| {
        let parts = match part {
            Some(name) => vec![file.named_part(name)?],
            None => {
                pass_over_scene(&file.root, &mut file.report);
                file.placed_parts()?
            }
        };
        file.lost.report(&mut file.report);
        Ok(file.into_model(parts))
    })
}

/// Takes a file apart and hands it to `use_it`.
fn with_file<T>(
    bytes: &[u8],
    open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    use_it: impl FnOnce(File<'_, '_>) -> Result<T, MeshError>,
) -> Result<T, MeshError> {
    let mut report = ImportReport::default();
    let container = container::open(bytes, &mut report)?;
    let value: Value = serde_json::from_slice(container.json)
        .map_err(|error| MeshError::whole(format!("its JSON cannot be read: {error}")))?;
    let root = At::root(&value);
    check_version(&root)?;
    check_extensions(&root, &mut report)?;
    let buffers = Buffers::new(root.clone(), container.binary, open);
    let mut textures = Textures::new(root.clone(), &buffers);
    let materials = material::all(&root, &mut textures, &mut report)?;
    let pictures = std::mem::take(&mut textures.pictures);
    use_it(File {
        root,
        buffers: &buffers,
        report,
        materials,
        pictures,
        known: FxHashMap::default(),
        joint_count: 0,
        lost: Lost::default(),
    })
}

fn check_version(root: &At<'_>) -> Result<(), MeshError> {
    if !root.value.is_object() {
        return Err(MeshError::whole("its JSON is not an object"));
    }
    let asset = root.need("asset")?;
    let least = asset.text("minVersion")?;
    let version = asset.need("version")?;
    let version = version.value.as_str().map_or_else(|| version.value.to_string(), str::to_owned);
    match (version.split('.').next(), least) {
        (Some("2"), None | Some("2.0")) => Ok(()),
        (Some("2"), Some(least)) => {
            Err(MeshError::whole(format!("it asks for glTF {least}; glTF 2.0 is read")))
        }
        _ => Err(MeshError::whole(format!("it is glTF {version}, and only glTF 2 is read"))),
    }
}

fn check_extensions(root: &At<'_>, report: &mut ImportReport) -> Result<(), MeshError> {
    for name in root.list("extensionsRequired")? {
        let text = name.value.as_str().ok_or_else(|| name.wrong("is not a text"))?;
        if !is_harmless(text) {
            return Err(MeshError::whole(format!(
                "it cannot be read without {text}, which is not supported: export it without that"
            )));
        }
    }
    if root.count("animations") > 0 {
        report.passed_over(About::Shape, "animations: what is stored is the pose");
    }
    Ok(())
}

/// Says what a scene has and a mesh has not.
fn pass_over_scene(root: &At<'_>, report: &mut ImportReport) {
    if root.count("cameras") > 0 {
        report.passed_over(About::File, "cameras, which a mesh has not");
    }
    let lights = root.extension("KHR_lights_punctual").map_or(0, |at| at.count("lights"));
    if lights > 0 {
        report.ignored(About::File, format!("lights, which a mesh has not ({lights})"));
    }
}

/// A file that has been taken apart.
struct File<'a, 'b> {
    root: At<'a>,
    buffers: &'b Buffers<'a>,
    report: ImportReport,
    materials: Vec<Read>,
    pictures: Vec<super::model::ModelPicture>,
    /// Primitives that rest, by their mesh and number: instances read them once.
    known: FxHashMap<(usize, usize), Option<Rc<Part>>>,
    /// How many joints hold what is placed.
    joint_count: usize,
    lost: Lost,
}

/// The most parts, and the most joints, that a file may place.
const MOST_PLACES: usize = 1_000_000;

/// A primitive: of which mesh, and which of its primitives.
type Place = (usize, usize);

impl<'a> File<'a, '_> {
    fn into_model(self, parts: Vec<Part>) -> Model {
        let materials = self.materials.into_iter().map(|read| read.material).collect();
        Model { parts, materials, pictures: self.pictures, report: self.report }
    }

    /// What each primitive of the file is called, by its mesh and number; no two alike.
    fn names(&mut self) -> Result<Vec<(Place, String)>, MeshError> {
        let mut taken = rustc_hash::FxHashSet::default();
        let mut out = Vec::new();
        for (index, mesh) in self.root.list("meshes")?.iter().enumerate() {
            let named = mesh.name().map(speakable).filter(|name| !taken.contains(name));
            let name = named.unwrap_or_else(|| format!("mesh {index}"));
            taken.insert(name.clone());
            if mesh.get("primitives").is_some_and(|list| !list.value.is_array()) {
                let text = format!("`{}.primitives`, which is not a list", mesh.path);
                self.report.left_out(About::Shape, text);
            }
            let count = mesh.count("primitives");
            for number in 0..count {
                let name = if count == 1 { name.clone() } else { format!("{name}/{number}") };
                out.push(((index, number), name));
            }
        }
        Ok(out)
    }

    /// One primitive by its name, in its mesh's own frame.
    fn named_part(&mut self, wanted: &str) -> Result<Part, MeshError> {
        let names = self.names()?;
        let Some((place, name)) = names.iter().find(|(_, name)| name == wanted) else {
            let known = names.into_iter().map(|(_, name)| name).collect();
            return Err(MeshError::NoPart { wanted: wanted.to_owned(), known });
        };
        match self.primitive(*place, name, &Pose::default()) {
            Some(part) => Ok((*part).clone()),
            None => Err(self.nothing_left()),
        }
    }

    /// Every primitive that the scene places, in its place.
    fn placed_parts(&mut self) -> Result<Vec<Part>, MeshError> {
        let names: FxHashMap<Place, String> = self.names()?.into_iter().collect();
        let places = nodes::placed(&self.root, &mut self.report)?;
        let worlds = nodes::worlds(&places);
        let mut all: Vec<(usize, Pose, DAffine3)> =
            places.iter().filter_map(|placed| self.pose(placed, &worlds)).collect();
        if self.root.count("nodes") == 0 {
            // A file of meshes alone, such as a part of a library.
            let meshes = 0..self.root.count("meshes");
            all.extend(meshes.map(|mesh| (mesh, Pose::default(), DAffine3::IDENTITY)));
        }
        let (mut parts, mut triangle_count, mut place_count) = (Vec::new(), 0_u64, 0);
        for (mesh, pose, world_from_mesh) in all {
            let count = self.root.element("meshes", mesh)?.count("primitives");
            for number in 0..count {
                let Some(part) = self.primitive((mesh, number), &names[&(mesh, number)], &pose) else {
                    continue;
                };
                triangle_count += part.triangles.len() as u64;
                place_count += 1;
                if triangle_count > MOST_TRIANGLES || place_count > MOST_PLACES {
                    return Err(MeshError::whole(format!(
                        "it places more than {MOST_TRIANGLES} triangles or {MOST_PLACES} parts: `snell convert` makes \
                         a scene of it, which keeps what is placed often once"
                    )));
                }
                parts.extend(self.moved(&part, &world_from_mesh));
            }
        }
        if parts.is_empty() { Err(self.nothing_left()) } else { Ok(parts) }
    }

    /// The mesh of a node, how it is posed, and where it is; `None` for a node without one.
    fn pose(
        &mut self,
        placed: &Placed<'a>,
        worlds: &FxHashMap<usize, DAffine3>,
    ) -> Option<(usize, Pose, DAffine3)> {
        let mesh = match placed.node.refer("mesh", &self.root, "meshes") {
            Ok(mesh) => mesh?,
            Err(error) => {
                self.report.left_out(About::Shape, format!("a mesh, as {error}"));
                return None;
            }
        };
        let weights = self.weights(&placed.node, mesh).unwrap_or_else(|error| {
            self.report.left_out(About::Shape, format!("shares of morph targets, as {error}"));
            Vec::new()
        });
        let joints = self.joints(&placed.node, worlds).unwrap_or_else(|error| {
            self.report.left_out(About::Shape, format!("a skin, as {error}"));
            Vec::new()
        });
        let is_skinned = !joints.is_empty();
        if is_skinned {
            self.report.used(About::Shape, "skins, in the pose that is stored");
        }
        let world_from_mesh = if is_skinned { DAffine3::IDENTITY } else { placed.world_from_node };
        Some((mesh, Pose { weights, joints }, world_from_mesh))
    }

    /// The shares of morph targets: the node's, or the mesh's.
    fn weights(&self, node: &At<'a>, mesh: usize) -> Result<Vec<f64>, MeshError> {
        let mesh = self.root.element("meshes", mesh)?;
        let at = if node.get("weights").is_some() { node } else { &mesh };
        at.list("weights")?
            .iter()
            .map(|weight| weight.value.as_f64().ok_or_else(|| weight.wrong("is not a number")))
            .collect()
    }

    /// For each joint of a node's skin, world from mesh.
    fn joints(
        &mut self,
        node: &At<'a>,
        worlds: &FxHashMap<usize, DAffine3>,
    ) -> Result<Vec<DAffine3>, MeshError> {
        let Some(skin) = node.refer("skin", &self.root, "skins")? else { return Ok(Vec::new()) };
        let skin = self.root.element("skins", skin)?;
        let matrices = self.buffers.refer(&skin, "inverseBindMatrices")?;
        let matrices = matrices.map(|matrices| matrices.of_width(&[16])).transpose()?;
        let joints = skin.list("joints")?;
        self.joint_count += joints.len();
        if self.joint_count > MOST_PLACES {
            return Err(skin.wrong(format!("brings the joints to more than {MOST_PLACES}")));
        }
        let mut out = Vec::with_capacity(joints.len());
        for (number, joint) in joints.iter().enumerate() {
            let node = joint.value.as_u64().and_then(|node| worlds.get(&usize::try_from(node).ok()?));
            let world_from_joint = *node.ok_or_else(|| joint.wrong("is no node of the scene"))?;
            let joint_from_mesh = match matrices.as_ref().filter(|matrices| number < matrices.count) {
                Some(matrices) => {
                    let columns = matrices.floats::<16>(number).map(f64::from);
                    DAffine3::from_mat4(glam::DMat4::from_cols_array(&columns))
                }
                None => DAffine3::IDENTITY,
            };
            out.push(world_from_joint * joint_from_mesh);
        }
        Ok(out)
    }

    /// A primitive in a pose, in its mesh's frame; `None` when nothing of it can be drawn, which is told.
    fn primitive(&mut self, place: Place, name: &str, pose: &Pose) -> Option<Rc<Part>> {
        if let Some(known) = self.known.get(&place).filter(|_| pose.is_rest()) {
            return known.clone();
        }
        let part = self.read_primitive(place, name, pose).unwrap_or_else(|error| {
            self.report.left_out(About::Shape, format!("`{name}`, as {error}"));
            None
        });
        let part = part.map(Rc::new);
        if pose.is_rest() {
            self.known.insert(place, part.clone());
        }
        part
    }

    fn read_primitive(
        &mut self,
        (mesh, number): Place,
        name: &str,
        pose: &Pose,
    ) -> Result<Option<Part>, MeshError> {
        let mesh = self.root.element("meshes", mesh)?;
        let at = mesh.nth("primitives", number).ok_or_else(|| mesh.wrong("has no such primitive"))?;
        let material = match at.refer("material", &self.root, "materials") {
            Ok(material) => material,
            Err(error) => {
                self.report.left_out(About::Material, format!("a material, as {error}"));
                None
            }
        };
        if material.is_none() {
            self.report.passed_over(About::Material, "what has no material is grey");
        }
        let uv_set = material.map_or(0, |index| self.materials[index].uv_set);
        let (report, lost) = (&mut self.report, &mut self.lost);
        let mut reader = Reader { buffers: self.buffers, report, lost, uv_set };
        Ok(reader.part(&at, name, pose)?.map(|part| Part { material, ..part }))
    }

    /// A part in its place in the world; `None` when nothing of it has an area there.
    fn moved(&mut self, part: &Part, world_from_mesh: &DAffine3) -> Option<Part> {
        if *world_from_mesh == DAffine3::IDENTITY {
            return Some(part.clone());
        }
        let m = &world_from_mesh.matrix3;
        let point = |p: &crate::math::Vec3| world_from_mesh.transform_point3(p.as_dvec3()).as_vec3();
        let positions: Vec<_> = part.positions.iter().map(point).collect();
        let is_mirrored = m.determinant() < 0.0;
        let turned = |t: &[u32; 3]| if is_mirrored { [t[0], t[2], t[1]] } else { *t };
        let keep = |t: &[u32; 3]| {
            let corners = t.map(|i| positions[i as usize]);
            corners.iter().all(|p| p.is_finite()) && !super::model::is_degenerate(corners)
        };
        let triangles: Vec<_> = part.triangles.iter().map(turned).filter(keep).collect();
        (triangles.len()..part.triangles.len()).for_each(|_| self.lost.flat.add(&part.name));
        let normals = part
            .normals
            .as_ref()
            .map(|normals| normals.iter().map(|n| turned_normal(n.as_dvec3(), m).as_vec3()).collect());
        let moved = Part { positions, triangles, normals, ..part.clone() };
        (!moved.triangles.is_empty()).then(|| moved.without_unused_vertices())
    }

    /// Why nothing can be drawn: what was left out, or that there is nothing.
    fn nothing_left(&mut self) -> MeshError {
        self.lost.report(&mut self.report);
        match self.report.lost_shape() {
            Some(sentence) => MeshError::NothingLeft(sentence),
            None if self.root.count("meshes") > 0 => {
                MeshError::NothingLeft("its scene places no mesh".to_owned())
            }
            None => MeshError::Empty,
        }
    }
}
