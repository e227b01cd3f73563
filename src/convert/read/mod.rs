//! Raw tree → model: the meaning of the blocks, by dialect.
//!
//! Every function takes what it understands out of a block by the roles of its keys, says what became of it, and leaves
//! the rest to [`Log::finish`], so that nothing passes without a word.

mod background;
mod camera;
mod facing;
mod lamp;
mod lens;
mod lens_rules;
mod light;
mod material;
mod object;
mod picture;
mod plane;
mod quad;
mod revolve;
mod scene;
mod shape;
mod spot;
mod transform;

use super::asset::{AssetFinder, Search, picture_size};
use super::dialect::Dialect;
use super::fields::{Field, Fields};
use super::log::Log;
use super::mistake::Mistake;
use super::model::{Asset, Light, Material, Scene};
use super::notebook::Notebook;
use super::parse::{Block, Span, Word};
use super::report::Fate;
use super::{Basis, Options, Rendition};
use crate::math::DVec3;
use std::collections::BTreeMap;

/// What reading a file yields besides its problems.
pub struct Reading {
    pub scenes: Vec<Scene>,
    pub fates: Vec<Fate>,
    pub notes: Notebook,
}

/// Reads a tree by the rules of its dialect.
pub fn read(
    tree: Block<'_>,
    comments: &[Span],
    options: &Options,
    files: Option<&dyn AssetFinder>,
    notes: Notebook,
) -> Reading {
    let mut log = Log::new(notes);
    let mut scenes = Vec::new();
    for tree in scene::split(tree, &mut log) {
        let mut reader = Reader::new(log, options, files);
        scenes.push(reader.scene(tree));
        log = reader.log;
    }
    for comment in comments {
        log.comment(comment);
    }
    let (fates, notes) = log.into_fates();
    Reading { scenes, fates, notes }
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
    /// The pictures that a block of textures lists.
    textures: Vec<Asset>,
    /// Lights that stand among the objects.
    stray_lights: Vec<Light>,
    camera_center: Option<DVec3>,
    /// How many transforms are around the block that is being read.
    transform_depth: usize,
}

impl<'a> Reader<'a> {
    fn new(log: Log, options: &'a Options, files: Option<&'a dyn AssetFinder>) -> Self {
        Self {
            log,
            dialect: Dialect::Pa1,
            options,
            files,
            assets: BTreeMap::new(),
            asset_roots: Vec::new(),
            material_index: None,
            materials: Vec::new(),
            textures: Vec::new(),
            stray_lights: Vec::new(),
            camera_center: None,
            transform_depth: 0,
        }
    }
}

impl Reader<'_> {
    /// Whether the terms of the original are kept: those of a program that simulates light are kept in any case.
    fn is_classic(&self) -> bool {
        let adds_terms = self.dialect == Dialect::Pa1 || self.dialect.is_mit();
        self.options.rendition == Rendition::Original && adds_terms
    }

    fn note_not_read(&mut self, what: impl Into<String>, at: &Span, done: &'static str) {
        self.log.notes.note(Mistake::NotReadYet { what: what.into(), at: at.clone().into(), done });
    }

    /// Notes that a block was given a meaning by the look of its name.
    fn guess_block(&mut self, name: &str, meant: &'static str, head: &Span) {
        let at = head.clone().into();
        self.log.notes.note(Mistake::GuessedBlock { name: name.into(), meant, at });
    }

    fn asset(&mut self, word: &Word<'_>) -> Asset {
        self.asset_at(word.text, &word.span)
    }

    /// Looks for a file that the scene names; a missing one is warned about once.
    fn asset_at(&mut self, written: &str, span: &Span) -> Asset {
        let path = written.replace('\\', "/").replace('"', ""); // Snell's strings hold no quotation marks
        if let Some(known) = self.assets.get(&path) {
            return known.clone();
        }
        let mut asset = Asset { path: path.clone(), beside: true, size: None };
        let at = span.clone().into();
        match self.files.map(|files| files.find(&path)) {
            None => {}
            Some(Search::Found { root, head }) => {
                asset.size = picture_size(&head);
                asset.beside = root == ".";
                self.note_root(&root);
            }
            Some(Search::Elsewhere { path: found, head }) => {
                asset.size = picture_size(&head);
                asset.beside = false;
                // With the right folder to look in, the path leads there.
                if let Some(root) =
                    found.strip_suffix(&path).filter(|root| root.is_empty() || root.ends_with('/'))
                {
                    self.note_root(root.trim_end_matches('/'));
                }
                self.log.notes.note(Mistake::AssetElsewhere { path: path.clone(), found, at });
            }
            Some(Search::Missing { tried }) => {
                asset.beside = false;
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
    fn positive(&mut self, fields: &mut Fields<'_>, role: &'static str, to: &str) -> Option<f64> {
        let field = self.log.need(fields, role)?;
        self.log.mapped(&field.span, to);
        let value = field.number(0);
        if value <= 0.0 {
            let what = format!("`{}` is {value}, and it must be greater than 0", field.key);
            self.log.bad_value(what, &field.span, "write how large it is");
            return None;
        }
        Some(value)
    }

    /// The three numbers of a field that could hold others.
    fn three(&mut self, field: &Field<'_>) -> Option<DVec3> {
        if field.is_vector() {
            return Some(field.vector());
        }
        self.log.dropped(&field.span, "malformed");
        self.log.notes.note(Mistake::MissingNumber {
            key: field.key.into(),
            wanted: "3 numbers".into(),
            found: format!("{} follow", field.numbers.len()),
            at: field.span.clone().into(),
            help: format!("write `{} 0 1 0`", field.key),
        });
        None
    }

    /// A colour of light: each component at least 0.
    fn light_colour(&mut self, field: &Field<'_>) -> DVec3 {
        let color = field.vector();
        if color.min_element() < 0.0 {
            self.log.differs("a light takes light away", &field.span, "negative components were set to 0");
        }
        color.max(DVec3::ZERO)
    }

    /// Whether the camera's basis is used as it is, which magnifies the picture where `up` leans.
    fn basis(&self) -> Basis {
        self.options.basis.unwrap_or(match self.dialect {
            Dialect::Arsenal => Basis::Raw,
            _ => Basis::Orthonormal,
        })
    }
}
