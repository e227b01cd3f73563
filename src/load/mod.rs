//! Reads what the placed objects need from files: whole meshes, and of pictures only the headers.
//!
//! What no object, light or environment uses is not even opened.

mod error;
mod mesh;

use crate::asset::{self, LensTable, ModelMaterial, lens, picture};
use crate::check::{self, Checked, MeshPart, Meshes, OwnMaterial};
use crate::diag::Problems;
use crate::ir::light::EnvironmentRadiance;
use crate::ir::material::Input;
use crate::ir::{Handle, Heights, Lens, Material, Scene, ShapeKind, Texture, TextureKind};
use crate::source::{Files, SourceMap, Span, Spanned};
pub use error::LoadError;
pub use mesh::{LoadedMesh, MeshImport, open_beside};
use rustc_hash::{FxHashMap, FxHashSet};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A checked scene with the files that it needs.
pub struct Loaded<'a> {
    /// The scene.
    pub scene: &'a Scene,
    meshes: FxHashMap<usize, Arc<LoadedMesh>>,
    pictures: FxHashMap<usize, PictureFile>,
    /// By mesh, the pictures of its own materials, where those are seen.
    model_pictures: FxHashMap<usize, Vec<Option<PictureFile>>>,
    imports: Vec<MeshImport>,
    /// Lenses by where the scene names them.
    lenses: FxHashMap<Span, LensTable>,
    /// Every file that was read, so that no output replaces one.
    pub files: Vec<PathBuf>,
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
    /// Whether it says how much there is of each pixel.
    pub has_alpha: bool,
    /// Its bytes, where they are part of another file; `path` then only tells it from others.
    pub bytes: Option<Arc<[u8]>>,
}

impl PictureFile {
    /// A picture on its own.
    fn new(path: PathBuf, name: String, span: Span, header: picture::Header) -> Self {
        let picture::Header { width, height, has_alpha } = header;
        Self { path, name, span, width, height, has_alpha, bytes: None }
    }

    /// The bytes of the file.
    ///
    /// # Errors
    /// Whatever the system says.
    pub fn read(&self, files: &dyn Files) -> std::io::Result<Cow<'_, [u8]>> {
        match &self.bytes {
            Some(bytes) => Ok(Cow::Borrowed(bytes)),
            None => files.read(&self.path).map(Cow::Owned),
        }
    }
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

    /// A picture of a mesh's own materials; `None` when it was left out.
    pub fn model_picture(&self, mesh: &LoadedMesh, picture: usize) -> Option<&PictureFile> {
        self.model_pictures.get(&mesh.key())?.get(picture)?.as_ref()
    }

    /// What became of what the mesh files hold: for each its name, what was read, and a line for each fate.
    pub fn imports(&self) -> impl Iterator<Item = &MeshImport> {
        self.imports.iter()
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
        Some(material) if material.look.shines() => OwnMaterial::Shining,
        Some(material) if material.look.is_pierced() => OwnMaterial::Pierced,
        Some(material) if material.look.is_clear() => OwnMaterial::Clear,
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
            model_pictures: FxHashMap::default(),
            imports: Vec::new(),
            lenses: FxHashMap::default(),
            files: Vec::new(),
        },
        models: FxHashMap::default(),
        seen_shapes: FxHashSet::default(),
        seen_materials: FxHashSet::default(),
        seen_textures: FxHashSet::default(),
        seen_models: FxHashSet::default(),
        missing: FxHashSet::default(),
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
    /// Meshes by path and part, so that a file named twice is read once; `None` for one that was reported.
    models: FxHashMap<(PathBuf, Option<String>), Option<Arc<LoadedMesh>>>,
    /// Shapes, materials, textures, and meshes rendered in their own materials: many objects share one.
    seen_shapes: FxHashSet<usize>,
    seen_materials: FxHashSet<usize>,
    seen_textures: FxHashSet<usize>,
    seen_models: FxHashSet<usize>,
    /// Files that were told to be missing, by the place that names them: what a loop places is told once.
    missing: FxHashSet<(Span, String)>,
    failed: bool,
}

impl Loader<'_, '_> {
    fn shape(&mut self, handle: Handle<crate::ir::Shape>) {
        let scene = self.loaded.scene;
        if let ShapeKind::Heightfield { heights: Heights::Image(texture), .. } = &scene.shapes[handle].kind {
            return self.heights(texture.value);
        }
        let ShapeKind::Mesh { file, part, skip_missing, .. } = &scene.shapes[handle].kind else { return };
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
        if let Some(mesh) = self.mesh_at(path, &what, part.as_ref()) {
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
        match picture::header(&bytes) {
            Ok(header) => Some(PictureFile::new(path, name, what.span, header)),
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
        if !self.missing.insert((what.span, what.name.to_owned())) {
            return None;
        }
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
