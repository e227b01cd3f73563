//! The top level of a file: which scenes it holds, and which block is what.

use super::object::{NO_MATERIAL, holds_objects};
use super::{Mistake, Reader};
use crate::convert::dialect;
use crate::convert::fields::{Field, Part};
use crate::convert::log::Log;
use crate::convert::model::{Object, Scene, Settings, Shape};
use crate::convert::parse::{Block, Node, Span};
use crate::convert::report::Outcome;
use crate::convert::words::{GROUP, SETTINGS, blocks};
use crate::convert::{Detection, words};
use std::collections::BTreeSet;

/// The blocks of the top level; of each kind the last one counts.
#[derive(Default)]
struct Top<'t> {
    camera: Option<Block<'t>>,
    /// What blocks say of the camera that are none by themselves.
    camera_extras: Vec<Node<'t>>,
    background: Option<Block<'t>>,
    lights: Option<Block<'t>>,
    /// `DiskLights` and other blocks that add to `Lights`.
    more_lights: Vec<Block<'t>>,
    materials: Option<Block<'t>>,
    textures: Vec<Block<'t>>,
    group: Option<Block<'t>>,
    /// Objects and indices of materials outside every group, as after a brace too many.
    loose: Vec<Part<'t>>,
    settings: Settings,
}

/// The scenes of a file: a new one begins with a camera after a group, if a group follows it, too.
pub fn split<'t>(tree: Block<'t>, log: &mut Log) -> Vec<Block<'t>> {
    let (span, head) = (tree.span.clone(), tree.head.clone());
    let mut bodies: Vec<Vec<Node<'t>>> = vec![Vec::new()];
    for node in tree.body {
        let current = bodies.last().expect("there is always one");
        if is(&node, blocks::Top::Camera)
            && holds(current, blocks::Top::Camera)
            && holds(current, blocks::Top::Group)
        {
            bodies.push(Vec::new());
        }
        bodies.last_mut().expect("there is always one").push(node);
    }
    let mut scenes: Vec<Vec<Node<'t>>> = Vec::new();
    for body in bodies {
        match scenes.last_mut() {
            Some(scene) if !holds(&body, blocks::Top::Group) => scene.extend(body),
            _ => scenes.push(body),
        }
    }
    if let Some(second) = scenes.get(1).and_then(|body| body.first()) {
        let at = match second {
            Node::Block(block) => block.head.clone(),
            node => node.span(),
        };
        log.notes.note(Mistake::SeveralScenes { count: scenes.len(), at: at.into() });
    }
    let block = |body| Block { name: None, body, span: span.clone(), head: head.clone() };
    scenes.into_iter().map(block).collect()
}

fn is(node: &Node<'_>, kind: blocks::Top) -> bool {
    matches!(node, Node::Block(block) if blocks::top(block.name()) == Some(kind))
}

fn holds(body: &[Node<'_>], kind: blocks::Top) -> bool {
    body.iter().any(|node| is(node, kind))
}

impl Reader<'_> {
    pub(super) fn scene(&mut self, tree: Block<'_>) -> Scene {
        let detection = match self.options.dialect {
            Some(dialect) => Detection { dialect, reason: "the options say so".into() },
            None => dialect::of_file(&tree),
        };
        self.dialect = detection.dialect;
        let top = self.top(tree);

        let camera = top.camera.and_then(|mut block| {
            block.body.extend(top.camera_extras);
            self.camera(block)
        });
        self.camera_center = camera.as_ref().map(|camera| camera.center);
        for block in top.textures {
            self.texture_list(block);
        }
        self.materials = top.materials.map(|block| self.materials(block)).unwrap_or_default();
        let mut objects = top.group.map(|block| self.group(block)).unwrap_or_default();
        objects.extend(self.group_parts(top.loose).0);
        let mut lights = Vec::new();
        for block in top.lights.into_iter().chain(top.more_lights) {
            lights.extend(self.lights(block));
        }
        lights.append(&mut self.stray_lights);
        let background = self.background(top.background, lights.is_empty());
        self.tell_unused_materials(&objects);
        settle(&mut objects, self.materials.len());
        Scene {
            is_classic: self.is_classic(),
            detection,
            camera,
            background,
            lights,
            materials: std::mem::take(&mut self.materials),
            objects,
            settings: top.settings,
            asset_roots: std::mem::take(&mut self.asset_roots),
        }
    }

    /// What is mapped into a material that no object uses is in the result as a remark only.
    fn tell_unused_materials(&mut self, objects: &[Object]) {
        let mut used = BTreeSet::new();
        Object::each(objects, &mut |object| used.extend(object.material));
        for (index, material) in self.materials.iter().enumerate().rev() {
            // Blends refer to those before them, so whoever uses a material has been seen by now.
            used.extend(material.look.parts().filter(|_| used.contains(&index)).collect::<Vec<_>>());
        }
        let unused: Vec<Span> = (0..)
            .zip(&self.materials)
            .filter(|(index, _)| !used.contains(index))
            .map(|(_, material)| material.span.clone())
            .collect();
        for span in unused {
            for (_, fate) in self.log.fates.range_mut(span) {
                if matches!(fate.outcome, Outcome::Mapped(_) | Outcome::Approximated(_)) {
                    fate.outcome = Outcome::Dropped("no object uses this material; a remark keeps it".into());
                }
            }
        }
    }

    fn top<'t>(&mut self, tree: Block<'t>) -> Top<'t> {
        let mut top = Top::default();
        for part in self.log.parts(tree.body, &GROUP) {
            match part {
                Part::Field(field) if field.role == "MaterialIndex" => top.loose.push(Part::Field(field)),
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
        let Some(kind) = blocks::top(block.name()) else {
            if holds_objects(&block) {
                return self.loose_object(top, block);
            }
            let usual = ["PerspectiveCamera", "Background", "Lights", "Materials", "Group"];
            return self.log.unknown_block(&block, "at the top level".into(), &usual);
        };
        let slot = match kind {
            blocks::Top::Camera if is_whole_camera(&block) => &mut top.camera,
            blocks::Top::Camera => {
                self.log.mapped(&block.head, "said of the camera");
                return top.camera_extras.extend(block.body);
            }
            blocks::Top::Background => &mut top.background,
            blocks::Top::Lights if block.name() == "Lights" => &mut top.lights,
            blocks::Top::Lights => return top.more_lights.push(block),
            blocks::Top::Materials => &mut top.materials,
            blocks::Top::Textures => return top.textures.push(block),
            blocks::Top::Group => &mut top.group,
            blocks::Top::Settings => return self.settings(block, &mut top.settings),
            blocks::Top::Object => return self.loose_object(top, block),
            blocks::Top::Sky => {
                self.log.drop_all(&block.span, "pictures all around are not read");
                return self.log.not_convertible(
                    format!("`{}`", block.name()),
                    &block.head,
                    "it is put together from several pictures",
                );
            }
        };
        let kind = block.name().to_string();
        if let Some(earlier) = slot.replace(block) {
            let last = slot.as_ref().map_or(0..0, |block| block.head.clone());
            self.log.repeated(&kind, &earlier.span, &last);
        }
    }

    /// An object outside every group is taken into the scene all the same.
    fn loose_object<'t>(&mut self, top: &mut Top<'t>, block: Block<'t>) {
        let at = block.head.clone().into();
        self.log.notes.note(Mistake::GuessedBlock {
            name: block.name().into(),
            meant: "an object of the scene, though no group is around it",
            at,
        });
        top.loose.push(Part::Block(block));
    }

    /// A word, with its numbers, that is neither a block nor belongs to one.
    fn stray(&mut self, field: &Field<'_>) {
        self.log.dropped(&field.span, "belongs to nothing");
        self.log.notes.note(Mistake::StrayToken { text: field.key.into(), at: field.span.clone().into() });
    }

    /// What the original's renderer is told; of all that only the number of samples matters to another one.
    fn settings(&mut self, block: Block<'_>, settings: &mut Settings) {
        let head = block.head.clone();
        self.log.ignored(&head, "tells the original's renderer what to do");
        for part in self.log.parts(block.body, &SETTINGS) {
            match part {
                Part::Field(field) if field.role == "samples" && field.sound && field.number(0) >= 1.0 => {
                    let samples = field.number(0).min(1e6) as u32;
                    self.log.mapped(&field.span, "`stop`, that many samples");
                    settings.samples = Some(samples);
                }
                Part::Field(field) => {
                    self.log.dropped(&field.span, "a setting of the original's renderer, not of the scene");
                }
                Part::Block(block) => {
                    self.log.dropped(&block.span, "a setting of the original's renderer, not of the scene");
                }
            }
        }
    }

    /// `Textures { Image { imgFile FILE } .. }`: pictures that materials name by their index.
    fn texture_list(&mut self, block: Block<'_>) {
        self.log.mapped(&block.head, "pictures, where materials name them");
        let mut open = vec![Part::Block(block)];
        while let Some(part) = open.pop() {
            match part {
                Part::Field(field) if field.role == "count" => self.log.mapped(&field.span, "counts them"),
                Part::Field(field) => match &field.word {
                    Some(word) => {
                        self.log.mapped(&field.span, "a picture, where materials name it");
                        let asset = self.asset(word);
                        self.textures.push(asset);
                    }
                    None => self.log.dropped(&field.span, "no file of a picture"),
                },
                Part::Block(block) => {
                    self.log.mapped(&block.head, "pictures, where materials name them");
                    let mut parts = self.log.parts(block.body, &words::TEXTURES);
                    parts.reverse();
                    open.extend(parts);
                }
            }
        }
    }
}

/// Gives the objects of no material the placeholder, which comes after all materials there are.
fn settle(objects: &mut [Object], placeholder: usize) {
    for object in objects {
        if object.material == Some(NO_MATERIAL) {
            object.material = Some(placeholder);
        }
        if let Shape::Group(inner) = &mut object.shape {
            settle(inner, placeholder);
        }
    }
}

/// Whether a block of a camera's name says where the camera is.
fn is_whole_camera(block: &Block<'_>) -> bool {
    let mut words = block.words();
    words.any(|word| words::CAMERA.find(word).is_some_and(|row| ["center", "target"].contains(&row.role)))
        || !["Camera"].contains(&block.name())
}
