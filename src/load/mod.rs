//! Reads what the placed objects need from files: whole meshes, and of pictures only the headers.
//!
//! What no object, light or environment uses is not even opened.

mod error;

use crate::asset::{self, LensTable, Model, ModelMaterial, lens, obj, picture};
use crate::check::{self, Checked, MeshPart, Meshes, OwnMaterial};
use crate::diag::Problems;
use crate::ir::light::EnvironmentRadiance;
use crate::ir::material::Input;
use crate::ir::{Handle, Heights, Lens, Material, Scene, ShapeKind, Texture, TextureKind};
use crate::source::{Files, SourceMap, Span, Spanned};
pub use error::LoadError;
use rustc_hash::{FxHashMap, FxHashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A checked scene with the files that it needs.
pub struct Loaded<'a> {
    /// The scene.
    pub scene: &'a Scene,
    meshes: FxHashMap<usize, Arc<LoadedMesh>>,
    pictures: FxHashMap<usize, PictureFile>,
    /// Lenses by where the scene names them.
    lenses: FxHashMap<Span, LensTable>,
    /// Every file that was read, so that no output replaces one.
    pub files: Vec<PathBuf>,
}

/// A mesh file that was read.
pub struct LoadedMesh {
    /// Its contents.
    pub model: Model,
    /// For each of its materials, the picture of `map_Kd`.
    pub maps: Vec<Option<PictureFile>>,
}

/// A picture whose pixels have not been read yet.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PictureFile {
    /// Where it is.
    pub path: PathBuf,
    /// As the scene or the MTL file names it.
    pub name: String,
    /// Where the scene names it.
    pub span: Span,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Loaded<'_> {
    /// The mesh of a shape; `None` when it was left out.
    pub fn mesh(&self, shape: Handle<crate::ir::Shape>) -> Option<&Arc<LoadedMesh>> {
        self.meshes.get(&shape.index())
    }

    /// The pictures that the scene names and nothing in it shows: they were not opened.
    pub fn unread(&self) -> impl Iterator<Item = &Spanned<String>> {
        let textures = self.scene.textures.iter().enumerate();
        textures.filter_map(|(index, texture)| match &texture.kind {
            TextureKind::Image(image) if !self.pictures.contains_key(&index) => Some(&image.file),
            _ => None,
        })
    }

    /// The picture of a texture; `None` when it was left out.
    pub fn picture(&self, texture: Handle<Texture>) -> Option<&PictureFile> {
        self.pictures.get(&texture.index())
    }

    /// The lens that the scene names at this place.
    pub fn lens(&self, named: Span) -> Option<&LensTable> {
        self.lenses.get(&named)
    }
}

impl Meshes for Loaded<'_> {
    fn parts(&self, shape: Handle<crate::ir::Shape>) -> Vec<MeshPart<'_>> {
        let Some(mesh) = self.mesh(shape) else { return Vec::new() };
        let part =
            |part: &'_ asset::Part| own_material(part.material.map(|index| &mesh.model.materials[index]));
        let parts = mesh.model.parts.iter();
        parts.map(|p| MeshPart { positions: &p.positions, triangles: &p.triangles, own: part(p) }).collect()
    }
}

/// What a material of a mesh file does to light.
fn own_material(material: Option<&ModelMaterial>) -> OwnMaterial {
    match material {
        Some(material) if material.shines() => OwnMaterial::Shining,
        Some(material) if material.is_clear() => OwnMaterial::Clear,
        _ => OwnMaterial::Opaque,
    }
}

/// Reads the files of everything that is in the picture. `None` when one of them cannot be used.
pub fn load<'a>(
    scene: &'a Checked,
    sources: &SourceMap,
    files: &dyn Files,
    problems: &mut Problems,
) -> Option<Loaded<'a>> {
    let mut loader = Loader {
        sources,
        files,
        problems,
        loaded: Loaded {
            scene,
            meshes: FxHashMap::default(),
            pictures: FxHashMap::default(),
            lenses: FxHashMap::default(),
            files: Vec::new(),
        },
        models: FxHashMap::default(),
        seen_shapes: FxHashSet::default(),
        seen_materials: FxHashSet::default(),
        seen_textures: FxHashSet::default(),
        seen_models: FxHashSet::default(),
        failed: false,
    };
    for object in &scene.objects {
        loader.shape(object.shape);
        match object.material.or(scene.shapes[object.shape].material) {
            Some(material) => loader.material(material),
            None => loader.own_materials(object.shape),
        }
    }
    // A misspelt name shall not hide that what it means lacks its file.
    scene.intent.materials.iter().for_each(|&material| loader.material(material));
    if let Some(environment) = &scene.environment
        && let EnvironmentRadiance::Image(texture) = environment.radiance
    {
        loader.texture(texture);
    }
    for camera in &scene.cameras {
        loader.lens(&camera.lens);
    }
    let loaded = (!loader.failed).then_some(loader.loaded)?;
    check::survey(scene, &loaded, problems);
    Some(loaded)
}

struct Loader<'a, 'b> {
    sources: &'b SourceMap,
    files: &'b dyn Files,
    problems: &'b mut Problems,
    loaded: Loaded<'a>,
    /// Meshes by path, so that a file named twice is read once; `None` for one that was reported.
    models: FxHashMap<PathBuf, Option<Arc<LoadedMesh>>>,
    /// Shapes, materials, textures, and meshes rendered in their own materials: many objects share one.
    seen_shapes: FxHashSet<usize>,
    seen_materials: FxHashSet<usize>,
    seen_textures: FxHashSet<usize>,
    seen_models: FxHashSet<usize>,
    failed: bool,
}

impl Loader<'_, '_> {
    fn shape(&mut self, handle: Handle<crate::ir::Shape>) {
        let scene = self.loaded.scene;
        if let ShapeKind::Heightfield { heights: Heights::Image(texture), .. } = &scene.shapes[handle].kind {
            return self.heights(texture.value);
        }
        let ShapeKind::Mesh { file, skip_missing, .. } = &scene.shapes[handle].kind else { return };
        if !self.seen_shapes.insert(handle.index()) {
            return;
        }
        let what = Wanted {
            name: &file.value,
            span: file.span,
            skip: *skip_missing,
            left_out: "the mesh is left out",
        };
        let Some(path) = self.locate(&what) else { return };
        if let Some(mesh) = self.mesh_at(path, &what) {
            self.loaded.meshes.insert(handle.index(), mesh);
        }
    }

    /// A picture of heights: of a size that makes a surface, and not one that fills the memory.
    fn heights(&mut self, handle: Handle<Texture>) {
        const MOST: u64 = 16_000_000;
        self.texture(handle);
        let Some(picture) = self.loaded.pictures.get(&handle.index()) else { return };
        let (width, height) = (picture.width, picture.height);
        let reason = match u64::from(width) * u64::from(height) {
            _ if width < 2 || height < 2 => "heights take at least 2 x 2 pixels",
            count if count > MOST => "heights take at most 16 million pixels: make it smaller",
            _ => return,
        };
        let (name, used) = (picture.name.clone(), picture.span);
        self.problems.push(LoadError::BadPicture { name, reason: reason.to_owned(), used });
        self.failed = true;
    }

    fn mesh_at(&mut self, path: PathBuf, what: &Wanted<'_>) -> Option<Arc<LoadedMesh>> {
        if let Some(known) = self.models.get(&path) {
            return known.clone();
        }
        let mesh = self.read_mesh(&path, what).map(Arc::new);
        self.failed |= mesh.is_none();
        self.models.insert(path, mesh.clone());
        mesh
    }

    fn read_mesh(&mut self, path: &Path, what: &Wanted<'_>) -> Option<LoadedMesh> {
        let bytes = self.read(path, what)?;
        let beside =
            |name: &str| self.files.locate(path, name).ok().and_then(|path| self.files.read(&path).ok());
        let model = match obj::read(&bytes, beside) {
            Ok(model) => model,
            Err(error) => {
                let (name, reason) = (what.name.to_owned(), error.to_string());
                self.problems.push(LoadError::BadMesh { name, reason, used: what.span });
                return None;
            }
        };
        self.mention(&model, what);
        let maps =
            model.materials.iter().map(|m| self.model_map(m.diffuse_map.as_deref()?, path, what)).collect();
        Some(LoadedMesh { model, maps })
    }

    /// A picture that an MTL file names: one that is missing is worth a warning only, as the mesh can do without.
    fn model_map(&mut self, name: &str, mesh: &Path, what: &Wanted<'_>) -> Option<PictureFile> {
        let found = self.files.locate(mesh, name).ok().and_then(|path| {
            let bytes = self.files.read(&path).ok()?;
            let (width, height) = picture::size(&bytes).ok()?;
            self.loaded.files.push(path.clone());
            Some(PictureFile { path, name: name.to_owned(), span: what.span, width, height })
        });
        if found.is_none() {
            let note = format!("its texture `{name}` cannot be read and is left out");
            self.note(what, note, "put the texture beside the mesh, or give the object a `material`");
        }
        found
    }

    fn mention(&mut self, model: &Model, what: &Wanted<'_>) {
        let notes = &model.notes;
        if notes.degenerate > 0 {
            let note = match notes.degenerate {
                1 => "one of its triangles has no area and is left out".to_owned(),
                many => format!("{many} of its triangles have no area and are left out"),
            };
            let help = "nothing is lost: clean the mesh, or write `allow(mesh_note, \"harmless\")` before it";
            self.note(what, note, help);
        }
        if notes.partial_uvs > 0 {
            let note = "some faces have no texture points, so all of that group's are ignored".to_owned();
            self.note(what, note, "give every face corner a `vt` index");
        }
        if notes.partial_normals > 0 {
            let note = "some faces have no normals, so all of that group's are ignored".to_owned();
            self.note(what, note, "give every face corner a `vn` index, or write `smooth: true`");
        }
    }

    /// A mesh whose object says nothing of a material: now its own ones matter.
    fn own_materials(&mut self, handle: Handle<crate::ir::Shape>) {
        let scene = self.loaded.scene;
        let ShapeKind::Mesh { file, skip_missing, .. } = &scene.shapes[handle].kind else { return };
        let Some(mesh) = self.loaded.meshes.get(&handle.index()).cloned() else { return };
        if !self.seen_models.insert(handle.index()) {
            return;
        }
        let what = Wanted { name: &file.value, span: file.span, skip: *skip_missing, left_out: "" };
        for file in &mesh.model.notes.missing_mtl {
            let note = format!("its material file `{file}` cannot be read, so its materials are grey");
            self.note(&what, note, "put it beside the mesh, or give the object a `material`");
        }
    }

    fn note(&mut self, what: &Wanted<'_>, note: String, help: &'static str) {
        self.problems.push(LoadError::MeshNote { name: what.name.to_owned(), note, used: what.span, help });
    }

    fn material(&mut self, handle: Handle<Material>) {
        if !self.seen_materials.insert(handle.index()) {
            return;
        }
        let scene = self.loaded.scene;
        let kind = &scene.materials[handle].kind;
        kind.inputs().iter().for_each(|input| self.input(input));
        kind.parts().into_iter().for_each(|part| self.material(part));
    }

    fn input(&mut self, input: &Input) {
        if let Input::Texture(texture) = input {
            self.texture(texture.value);
        }
    }

    fn texture(&mut self, handle: Handle<Texture>) {
        let scene = self.loaded.scene;
        if !self.seen_textures.insert(handle.index()) {
            return;
        }
        let kind = &scene.textures[handle].kind;
        kind.inputs().iter().for_each(|input| self.input(input));
        let TextureKind::Image(image) = kind else { return };
        let what = Wanted {
            name: &image.file.value,
            span: image.file.span,
            skip: image.skip_missing,
            left_out: "the texture is left out",
        };
        let Some(path) = self.locate(&what) else { return };
        match self.read_header(path, &what) {
            Some(picture) => drop(self.loaded.pictures.insert(handle.index(), picture)),
            None => self.failed = true,
        }
    }

    fn read_header(&mut self, path: PathBuf, what: &Wanted<'_>) -> Option<PictureFile> {
        let bytes = self.read(&path, what)?;
        let name = what.name.to_owned();
        match picture::size(&bytes) {
            Ok((width, height)) => Some(PictureFile { path, name, span: what.span, width, height }),
            Err(error) => {
                self.problems.push(LoadError::BadPicture {
                    name,
                    reason: error.to_string(),
                    used: what.span,
                });
                None
            }
        }
    }

    fn lens(&mut self, lens: &Lens) {
        let Lens::Prescription { file, .. } = lens else { return };
        let what = Wanted { name: &file.value, span: file.span, skip: false, left_out: "" };
        let Some(path) = self.locate(&what) else { return };
        let table = self.read(&path, &what).and_then(|bytes| match lens::read(&bytes) {
            Ok(table) => Some(table),
            Err(error) => {
                let (name, reason) = (file.value.clone(), error.to_string());
                self.problems.push(LoadError::BadLens { name, reason, used: file.span });
                None
            }
        });
        match table {
            Some(table) => drop(self.loaded.lenses.insert(file.span, table)),
            None => self.failed = true,
        }
    }

    fn locate(&mut self, what: &Wanted<'_>) -> Option<PathBuf> {
        let from = self
            .sources
            .find(what.span.start)
            .map(|id| self.sources.file(id).path.clone())
            .unwrap_or_default();
        let error = match self.files.locate(&from, what.name) {
            Ok(path) => return Some(path),
            Err(missing) => LoadError::not_found(what.name, what.span, missing),
        };
        match error {
            LoadError::MissingFile { name, used, help } if what.skip => {
                self.problems.push(LoadError::SkippedFile { name, left_out: what.left_out, used, help });
            }
            error => {
                self.problems.push(error);
                self.failed = true;
            }
        }
        None
    }

    fn read(&mut self, path: &Path, what: &Wanted<'_>) -> Option<Vec<u8>> {
        self.loaded.files.push(path.to_owned());
        self.files
            .read(path)
            .map_err(|error| {
                let (name, reason) = (what.name.to_owned(), error.to_string());
                self.problems.push(LoadError::Unreadable { name, reason, used: what.span });
            })
            .ok()
    }
}

/// A file that the scene names.
struct Wanted<'a> {
    name: &'a str,
    span: Span,
    skip: bool,
    left_out: &'static str,
}
