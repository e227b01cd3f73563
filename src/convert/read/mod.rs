//! Raw tree → model: the meaning of the blocks, by dialect.
//!
//! Every function takes what it understands out of a block, says what became of it, and leaves the rest to
//! [`Log::finish`], so that nothing passes without a word.

mod camera;
mod light;
mod lobes;
mod material;
mod object;
mod plane;
mod revolve;
mod shape;

use super::asset::{AssetFinder, Search, picture_size};
use super::dialect::{Detection, Dialect};
use super::error::{Mistake, Notebook};
use super::fields::{Field, Fields, Log, Part};
use super::model::{Asset, Background, Material, Object, Scene};
use super::parse::{Block, Span, Word};
use super::report::{Fate, Outcome};
use super::vocabulary as vocab;
use super::{Basis, Lights, Options};
use crate::math::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// What reading a file yields besides its problems.
pub struct Reading {
    pub scene: Scene,
    pub fates: Vec<Fate>,
    pub notes: Notebook,
    /// The folders, seen from the scene's, from which its files were found.
    pub asset_roots: Vec<String>,
}

/// Reads a tree by the rules of its dialect.
pub fn read(
    tree: Block<'_>,
    detection: &Detection,
    options: &Options,
    files: Option<&dyn AssetFinder>,
    notes: Notebook,
) -> Reading {
    let mut reader = Reader {
        log: Log::new(notes),
        dialect: detection.dialect,
        options,
        files,
        assets: BTreeMap::new(),
        asset_roots: Vec::new(),
        material_index: None,
        materials: Vec::new(),
        camera_center: None,
        transform_depth: 0,
    };
    let scene = reader.scene(tree);
    let Reader { log: Log { notes, fates }, asset_roots, .. } = reader;
    Reading { scene, fates: fates.into_values().collect(), notes, asset_roots }
}

/// What reading needs to know on the way.
struct Reader<'a> {
    log: Log,
    dialect: Dialect,
    options: &'a Options,
    files: Option<&'a dyn AssetFinder>,
    assets: BTreeMap<String, Asset>,
    asset_roots: Vec<String>,
    /// The index in force: it holds for every later object of the file, through the ends of groups.
    material_index: Option<usize>,
    materials: Vec<Material>,
    camera_center: Option<DVec3>,
    /// How many transforms are around the block that is being read.
    transform_depth: usize,
}

/// The blocks of the top level; of each kind the last one counts.
#[derive(Default)]
struct Top<'t> {
    camera: Option<Block<'t>>,
    background: Option<Block<'t>>,
    lights: Option<Block<'t>>,
    materials: Option<Block<'t>>,
    group: Option<Block<'t>>,
}

impl Reader<'_> {
    fn scene(&mut self, tree: Block<'_>) -> Scene {
        let top = self.top(tree);
        let camera = top.camera.and_then(|block| self.camera(block));
        self.camera_center = camera.as_ref().map(|camera| camera.center);
        let background = self.background(top.background);
        self.materials = top.materials.map(|block| self.materials(block)).unwrap_or_default();
        let objects = top.group.map(|block| self.group(block)).unwrap_or_default();
        let lights = top.lights.map(|block| self.lights(block)).unwrap_or_default();
        self.tell_unused_materials(&objects);
        let materials = std::mem::take(&mut self.materials);
        Scene { dialect: self.dialect, camera, background, lights, materials, objects }
    }

    /// What is mapped into a material that no object uses is in the result as a remark only.
    fn tell_unused_materials(&mut self, objects: &[Object]) {
        let mut used = BTreeSet::new();
        Object::each(objects, &mut |object| used.extend(object.material));
        let unused: Vec<&Span> = (0..)
            .zip(&self.materials)
            .filter(|(index, _)| !used.contains(index))
            .map(|(_, material)| &material.span)
            .collect();
        for fate in self.log.fates.values_mut() {
            let next = unused.partition_point(|span| span.end <= fate.span.start);
            let is_inside = unused.get(next).is_some_and(|span| span.start <= fate.span.start);
            if is_inside && matches!(fate.outcome, Outcome::Mapped(_) | Outcome::Approximated(_)) {
                fate.outcome = Outcome::Dropped("no object uses this material; a remark keeps it".into());
            }
        }
    }

    fn top<'t>(&mut self, tree: Block<'t>) -> Top<'t> {
        let mut top = Top::default();
        for part in self.log.parts(tree.body, &[]) {
            match part {
                Part::Field(field) => self.stray(&field),
                Part::Block(block) => self.top_block(&mut top, block),
            }
        }
        if top.camera.is_none() {
            self.log.notes.note(Mistake::NoCamera);
        }
        top
    }

    fn top_block<'t>(&mut self, top: &mut Top<'t>, block: Block<'t>) {
        let slot = match block.name() {
            name if camera::NAMES.contains(&name) => &mut top.camera,
            "Background" => &mut top.background,
            "Lights" => &mut top.lights,
            "Materials" => &mut top.materials,
            "Group" => &mut top.group,
            "Textures" | "DiskLights" | "SurfaceLights" | "Objects" | "Model" | "SkyBox" => {
                return self.not_read(&block, "left out, braces and all");
            }
            _ => return self.log.unknown_block(&block, "at the top level".into(), vocab::TOP),
        };
        let kind = block.name().to_string();
        if let Some(earlier) = slot.replace(block) {
            let last = slot.as_ref().map_or(0..0, |block| block.head.clone());
            self.log.repeated(&kind, &earlier.span, &last);
        }
    }

    /// The colour of rays that meet nothing, 0.5 grey where the file has none.
    fn background(&mut self, block: Option<Block<'_>>) -> Background {
        let mut background = Background { color: DVec3::splat(0.5), notes: Vec::new() };
        let Some(block) = block else {
            background.notes.push("The file has no `Background`; the original then takes this grey.".into());
            return background;
        };
        let mut fields = self.log.fields(block, vocab::BACKGROUND);
        self.log.mapped(&fields.head, "`environment`");
        if let Some(field) = self.log.take(&mut fields, "color") {
            background.color = field.vector();
            if background.color == DVec3::ZERO {
                self.log.mapped(&field.span, "black, which is what an empty scene shows");
            } else {
                let how = "a constant `environment`, which also lights the scene";
                self.log.approximated(&field.span, how);
            }
        }
        if self.dialect.is_mit() {
            for key in ["ambientLight", "cubeMap"] {
                if let Some(field) = self.log.take(&mut fields, key) {
                    self.log.dropped(&field.span, "not read yet");
                    self.note_not_read(format!("`{key}`"), &field.span, "left out");
                }
            }
        }
        self.log.finish(fields);
        background
    }

    /// Drops a block of another dialect, with a warning that says so.
    fn not_read(&mut self, block: &Block<'_>, done: &'static str) {
        self.log.dropped(&block.span, "not read yet");
        self.note_not_read(format!("`{}`", block.name()), &block.head, done);
    }

    fn note_not_read(&mut self, what: String, at: &Span, done: &'static str) {
        self.log.notes.note(Mistake::NotReadYet { what, at: at.clone().into(), done });
    }

    /// A word, with its numbers, that is neither a block nor belongs to one.
    fn stray(&mut self, field: &Field<'_>) {
        self.log.dropped(&field.span, "belongs to nothing");
        self.log.notes.note(Mistake::StrayToken { text: field.key.into(), at: field.span.clone().into() });
    }

    /// Notes a value that the converted scene could not have. The field's fate is told by its reader.
    fn bad_value(&mut self, what: impl Into<String>, at: &Span, help: &'static str) {
        self.log.notes.note(Mistake::BadValue { what: what.into(), at: at.clone().into(), help });
    }

    /// Notes a difference from the original that a person should know.
    fn differs(&mut self, what: impl Into<String>, at: &Span, help: &'static str) {
        self.log.notes.note(Mistake::Differs { what: what.into(), at: at.clone().into(), help });
    }

    /// Looks for a file that the scene names; a missing one is warned about once.
    fn asset(&mut self, word: &Word<'_>) -> Asset {
        let path = word.text.replace('\\', "/").replace('"', ""); // Snell's strings hold no quotation marks
        if let Some(known) = self.assets.get(&path) {
            return known.clone();
        }
        let mut asset = Asset { path: path.clone(), missing: false, size: None };
        let at = word.span.clone().into();
        match self.files.map(|files| files.find(&path)) {
            None => {}
            Some(Search::Found { root, head }) => {
                asset.size = picture_size(&head);
                self.note_root(&root);
            }
            Some(Search::Elsewhere { path: found, head }) => {
                asset.size = picture_size(&head);
                // With the right folder to look in, the path leads there; else the renderer cannot follow it.
                match found.strip_suffix(&path).filter(|root| root.is_empty() || root.ends_with('/')) {
                    Some(root) => self.note_root(root.trim_end_matches('/')),
                    None => asset.missing = true,
                }
                self.log.notes.note(Mistake::AssetElsewhere { path: path.clone(), found, at });
            }
            Some(Search::Missing { tried }) => {
                asset.missing = true;
                let help = format!("looked for {}", tried.join(", "));
                self.log.notes.note(Mistake::MissingAsset { path: path.clone(), at, help });
            }
        }
        self.assets.insert(path, asset.clone());
        asset
    }

    /// Notes a folder from which files were found.
    fn note_root(&mut self, root: &str) {
        if !self.asset_roots.iter().any(|known| known == root) {
            self.asset_roots.push(root.into());
        }
    }

    /// A field of one number greater than zero, which becomes `to`.
    fn positive(&mut self, fields: &mut Fields<'_>, key: &'static str, to: &str) -> Option<f64> {
        let field = self.log.need(fields, key)?;
        self.log.mapped(&field.span, to);
        let value = field.number(0);
        if value <= 0.0 {
            self.bad_value(
                format!("`{key}` is {value}, and it must be greater than 0"),
                &field.span,
                "write how large it is",
            );
            return None;
        }
        Some(value)
    }

    /// Whether the camera's basis is used as it is, which magnifies the picture where `up` leans.
    fn basis(&self) -> Basis {
        self.options.basis.unwrap_or(match self.dialect {
            Dialect::Arsenal => Basis::Raw,
            _ => Basis::Orthonormal,
        })
    }

    /// Why the lights of this file are inert, if they are.
    fn lights_inert(&self, any_emission: bool) -> Option<&'static str> {
        match (self.options.lights, self.dialect) {
            (Lights::Keep, _) => None,
            (Lights::Drop, _) => Some("the options say so"),
            (Lights::Auto, Dialect::Arsenal) => Some("in this dialect only emissive spheres shine"),
            (Lights::Auto, Dialect::Weights | Dialect::Enum | Dialect::Flags) if any_emission => {
                Some("programs of this dialect ignore it where materials emit light")
            }
            _ => None,
        }
    }
}
