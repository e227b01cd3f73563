//! The names of a scene, and the `let` bindings that give them.

use super::layout::Entry;
use super::material::material_value;
use super::names::{self, Names};
use super::object::shape_value;
use super::picture;
use crate::convert::model::{Light, Look, Material, Object, Scene, Shape};
use std::collections::{BTreeMap, BTreeSet};

/// The names of a scene's materials and of the shapes that stand in it more than once.
pub struct Glossary {
    /// A name for each material, and one more for the index past the last.
    materials: Vec<String>,
    shapes: BTreeMap<String, String>,
}

/// How a scene's objects use its materials and shapes.
#[derive(Default)]
struct Uses<'s> {
    /// Materials that objects name.
    named: BTreeSet<usize>,
    /// Materials that only go into the picture on a plane.
    inlined: BTreeSet<usize>,
    /// The shapes worth a name, by [`identity`], with how often they are used.
    shapes: BTreeMap<String, (&'s Shape, usize)>,
}

impl Glossary {
    pub fn of(scene: &Scene) -> Self {
        let mut names = Names::default();
        let mut materials: Vec<String> = scene
            .materials
            .iter()
            .enumerate()
            .map(|(index, material)| names.unique(&names::of_look(&material.look, index)))
            .collect();
        materials.push(names.unique("missing_material"));
        let repeated = Uses::of(scene).shapes.into_iter().filter(|(_, (_, count))| *count > 1);
        let shapes = repeated.map(|(key, (shape, _))| (key, names.unique(&name_of(shape)))).collect();
        Self { materials, shapes }
    }

    /// The `let` bindings: materials in their order, then the shapes that are placed several times.
    ///
    /// Materials that no object uses are kept as remarks: the compiler would warn about them.
    pub fn bindings(&self, scene: &Scene) -> Vec<Entry> {
        let uses = Uses::of(scene);
        let mut entries = Vec::new();
        let mut said = BTreeSet::new(); // what holds for several materials is said at the first
        for (index, material) in scene.materials.iter().enumerate() {
            let entry = Entry::binding(&self.materials[index], material_value(&material.look, self));
            if uses.named.contains(&index) {
                let news: Vec<String> =
                    material.notes.iter().filter(|&note| said.insert(note)).cloned().collect();
                entries.push(entry.noted(&news));
            } else if !uses.inlined.contains(&index) {
                entries.push(remark(&entry));
            }
        }
        if uses.named.contains(&scene.materials.len()) {
            let name = &self.materials[scene.materials.len()];
            let note = "Its index is past the last material.".to_string();
            entries.push(Entry::binding(name, material_value(&Look::Placeholder, self)).noted(&[note]));
        }
        let shape = |(key, name): (&String, &String)| {
            let (shape, _) = uses.shapes[key];
            Entry::binding(name, shape_value(shape, None, Vec::new()))
        };
        entries.extend(self.shapes.iter().map(shape));
        entries
    }

    /// The name of a material.
    pub fn material(&self, index: usize) -> &str {
        &self.materials[index.min(self.materials.len() - 1)]
    }

    /// The name of a shape, if it stands in several places.
    pub fn shape(&self, shape: &Shape) -> Option<&str> {
        self.shapes.get(&identity(shape)?).map(String::as_str)
    }
}

impl<'s> Uses<'s> {
    fn of(scene: &'s Scene) -> Self {
        let mut uses = Self::default();
        let mut glowing = |object: &'s Object| {
            if let Some(key) = identity(&object.shape) {
                uses.shapes.entry(key).or_insert((&object.shape, 0)).1 += 1;
            }
        };
        for light in &scene.lights {
            if let Light::Glowing { object, .. } = light {
                Object::each(std::slice::from_ref(object), &mut glowing);
            }
        }
        Object::each(&scene.objects, &mut |object| {
            if let Some(key) = identity(&object.shape) {
                uses.shapes.entry(key).or_insert((&object.shape, 0)).1 += 1;
            }
            if let Some(index) = object.material {
                let look = scene.materials.get(index).map(|material: &Material| &material.look);
                let is_laid = object.laid_picture().is_some() && look.is_some_and(picture::fits);
                let is_inlined = is_laid || object.picture.is_some() && look.is_some_and(has_texture);
                let set = if is_inlined { &mut uses.inlined } else { &mut uses.named };
                set.insert(index);
            }
        });
        for (index, material) in scene.materials.iter().enumerate().rev() {
            // Blends refer to those before them, so whoever uses a material has been seen by now.
            if uses.named.contains(&index) {
                uses.named.extend(material.look.parts());
            }
        }
        uses
    }
}

/// Whether a picture can stand for a colour of this material.
fn has_texture(look: &Look) -> bool {
    !look.clone().textures().is_empty()
}

/// What tells a shape that is worth sharing from others of its kind.
fn identity(shape: &Shape) -> Option<String> {
    match shape {
        Shape::Mesh { file, smooth } => Some(format!("{} {smooth}", file.path)),
        Shape::Revolve { profile } => Some(format!("{profile:?}")),
        _ => None,
    }
}

fn name_of(shape: &Shape) -> String {
    match shape {
        Shape::Mesh { file, .. } => names::of_mesh(&file.path),
        _ => "turned_shape".into(),
    }
}

/// An unused binding as a comment, on one line.
fn remark(entry: &Entry) -> Entry {
    let line = entry.flat().unwrap_or_default();
    Entry::item(format!("// {line} (no object uses it)"))
}
