//! Mesh files: their triangles, the pictures of their own materials, and what is to be said of them.

use super::{LoadError, Loader, PictureFile, Wanted};
use crate::asset::{About, Fate, ImportReport, MeshError, Model, PictureSource, Remark, mesh, picture};
use crate::diag::did_you_mean;
use crate::ir::{Handle, ShapeKind};
use crate::source::{Files, Missing, Spanned};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A mesh file that was read.
pub struct LoadedMesh {
    /// Its contents.
    pub model: Model,
    path: PathBuf,
}

impl LoadedMesh {
    /// What tells it from other meshes as long as it is there.
    pub(super) fn key(&self) -> usize {
        std::ptr::from_ref(self).addr()
    }
}

/// What was read of a mesh file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MeshImport {
    /// As the scene names it.
    pub name: String,
    /// The part that the scene asks for.
    pub part: Option<String>,
    /// How many triangles it has.
    pub triangle_count: usize,
    /// How many materials of its own.
    pub material_count: usize,
    /// What became of the rest: a line for each fate.
    pub lines: Vec<String>,
}

/// More remarks than this on one mesh are only counted.
const MOST_REMARKS: usize = 8;

impl Loader<'_, '_> {
    pub(super) fn mesh_at(
        &mut self,
        path: PathBuf,
        what: &Wanted<'_>,
        part: Option<&Spanned<String>>,
    ) -> Option<Arc<LoadedMesh>> {
        let key = (path, part.map(|part| part.value.clone()));
        if let Some(known) = self.models.get(&key) {
            return known.clone();
        }
        let mesh = self.read_mesh(&key.0, what, part).map(Arc::new);
        self.failed |= mesh.is_none();
        self.models.insert(key, mesh.clone());
        mesh
    }

    fn read_mesh(
        &mut self,
        path: &Path,
        what: &Wanted<'_>,
        part: Option<&Spanned<String>>,
    ) -> Option<LoadedMesh> {
        let bytes = self.read(path, what)?;
        let opened = RefCell::new(Vec::new());
        let beside = |name: &str| {
            let (path, bytes) = open_beside(self.files, path, name)?;
            opened.borrow_mut().push(path);
            Ok(bytes)
        };
        let read = mesh::read(what.name, &bytes, &beside, part.map(|part| part.value.as_str()));
        self.loaded.files.extend(opened.into_inner());
        let model = match read {
            Ok(model) => model,
            Err(error) => {
                self.cannot_use(error, what, part);
                return None;
            }
        };
        self.loaded.imports.push(MeshImport {
            name: what.name.to_owned(),
            part: part.map(|part| part.value.clone()),
            triangle_count: model.triangle_count(),
            material_count: model.materials.len(),
            lines: model.report.lines(),
        });
        self.mention(&model.report, what, |about| about != About::Material);
        Some(LoadedMesh { model, path: path.to_owned() })
    }

    fn cannot_use(&mut self, error: MeshError, what: &Wanted<'_>, part: Option<&Spanned<String>>) {
        let name = what.name.to_owned();
        match (error, part) {
            (MeshError::NoPart { wanted, known }, Some(part)) => {
                let near = did_you_mean(&wanted, known.iter().map(String::as_str));
                let help = near.unwrap_or_else(|| match known.is_empty() {
                    true => "none of its parts has a name: leave `part` out".to_owned(),
                    false => format!("its parts are {}", listed(&known)),
                });
                self.problems.push(LoadError::NoPart { name, part: wanted, used: part.span, help });
            }
            (error, _) => {
                let reason = error.to_string();
                self.problems.push(LoadError::BadMesh { name, reason, used: what.span });
            }
        }
    }

    /// A mesh whose object says nothing of a material: now its own ones matter, and their pictures.
    pub(super) fn own_materials(&mut self, handle: Handle<crate::ir::Shape>) {
        let scene = self.loaded.scene;
        let ShapeKind::Mesh { file, skip_missing, .. } = &scene.shapes[handle].kind else { return };
        let Some(mesh) = self.loaded.meshes.get(&handle.index()).cloned() else { return };
        if !self.seen_models.insert(mesh.key()) {
            return;
        }
        let what = Wanted { name: &file.value, span: file.span, skip: *skip_missing, left_out: "" };
        self.mention(&mesh.model.report, &what, |about| about == About::Material);
        let mut wanted = vec![false; mesh.model.pictures.len()];
        for material in mesh.model.parts.iter().filter_map(|part| part.material) {
            let look = &mesh.model.materials[material].look;
            look.pictures().into_iter().for_each(|picture| wanted[picture] = true);
        }
        let pictures = wanted.iter().enumerate();
        let pictures =
            pictures.map(|(i, wanted)| wanted.then(|| self.own_picture(&mesh, i, &what)).flatten());
        let pictures = pictures.collect();
        self.loaded.model_pictures.insert(mesh.key(), pictures);
    }

    /// A picture of a mesh's own: one that is missing is worth a warning only, as the mesh can do without.
    fn own_picture(&mut self, mesh: &LoadedMesh, index: usize, what: &Wanted<'_>) -> Option<PictureFile> {
        let picture = &mesh.model.pictures[index];
        let found = match &picture.source {
            PictureSource::File(name) => open_beside(self.files, &mesh.path, name).map(|(path, bytes)| {
                self.loaded.files.push(path.clone());
                (path, bytes, None)
            }),
            PictureSource::Bytes(bytes) => {
                let path = PathBuf::from(format!("{}#{index}", mesh.path.display()));
                Ok((path, bytes.to_vec(), Some(bytes.clone())))
            }
            PictureSource::Nowhere(reason) => Err(reason.clone()),
        };
        let read = found.and_then(|(path, content, bytes)| {
            let header = picture::header(&content).map_err(|error| error.to_string())?;
            let file = PictureFile::new(path, picture.name.clone(), what.span, header);
            Ok(PictureFile { bytes, ..file })
        });
        read.map_err(|reason| {
            let note = format!("without its picture `{}`: {reason}", picture.name);
            self.note(what, note, "put the picture beside the mesh, or give the object a `material`");
        })
        .ok()
    }

    /// Says what the picture lacks, of what is asked for.
    fn mention(&mut self, report: &ImportReport, what: &Wanted<'_>, wanted: impl Fn(About) -> bool) {
        let matters: Vec<&Remark> =
            report.remarks().iter().filter(|remark| remark.matters && wanted(remark.about)).collect();
        for remark in matters.iter().take(MOST_REMARKS) {
            let (how, help) = match (remark.fate, remark.about) {
                (Fate::LeftOut, About::Shape) => ("without", MEND),
                (Fate::LeftOut, _) => ("without", PAINT),
                (Fate::Ignored, About::Material) => ("ignoring", PAINT),
                (Fate::Ignored, About::File) => ("ignoring", CONVERT),
                (Fate::Ignored, About::Shape) => ("ignoring", MEND),
                (_, About::Material) => ("approximating", PAINT),
                (..) => ("approximating", MEND),
            };
            self.note(what, format!("{how} {}", remark.sentence()), help);
        }
        let more = matters.len().saturating_sub(MOST_REMARKS) + report.untold();
        if more > 0 {
            let note = format!("with {more} more differences from what it says");
            self.note(what, note, "`snell check -v` tells them all");
        }
    }

    fn note(&mut self, what: &Wanted<'_>, note: String, help: &'static str) {
        self.problems.push(LoadError::MeshNote { name: what.name.to_owned(), note, used: what.span, help });
    }
}

const MEND: &str = "mend the file, or write `allow(mesh_note, \"harmless\")` before the mesh";
const PAINT: &str = "give the object a `material`, or write `allow(mesh_note, \"harmless\")` before it";
const CONVERT: &str = "`snell convert` makes a scene with them; or write `allow(mesh_note, \"harmless\")`";

/// A file that a mesh file names: its path and its bytes.
///
/// # Errors
/// Why it cannot be read, in words that can follow a colon.
pub fn open_beside(files: &dyn Files, mesh: &Path, name: &str) -> Result<(PathBuf, Vec<u8>), String> {
    match files.locate(mesh, name) {
        Ok(path) => {
            let bytes = files.read(&path).map_err(|error| error.to_string())?;
            Ok((path, bytes))
        }
        Err(Missing::Outside { .. }) => Err("it lies outside the scene's folder".to_owned()),
        Err(Missing::NotFound { near, .. }) => {
            let near = did_you_mean(name, near.iter().map(String::as_str));
            Err(format!("there is no such file{}", near.map_or(String::new(), |near| format!("; {near}"))))
        }
    }
}

/// Some names, and how many more there are.
fn listed(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    match names.len().checked_sub(SHOWN) {
        None | Some(0) => shown.join(", "),
        Some(more) => format!("{} and {more} more", shown.join(", ")),
    }
}
