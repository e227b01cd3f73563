//! What a mesh file holds, whatever its format: triangles, materials, pictures, and what became of the rest.

use super::look::Look;
use super::report::ImportReport;
use crate::math::{Vec2, Vec3};
use std::sync::Arc;

/// A mesh file.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Model {
    /// Triangles by material, in file order.
    pub parts: Vec<Part>,
    /// The materials that the parts name.
    pub materials: Vec<ModelMaterial>,
    /// The pictures that the materials look up.
    pub pictures: Vec<ModelPicture>,
    /// What was used, approximated, ignored and left out.
    pub report: ImportReport,
}

impl Model {
    /// The number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|part| part.triangles.len()).sum()
    }
}

/// Triangles of one material.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Part {
    /// What a scene calls it by: the material in OBJ, the mesh in glTF.
    pub name: String,
    /// Vertices, in the file's own units.
    pub positions: Vec<Vec3>,
    /// Three vertex indices each.
    pub triangles: Vec<[u32; 3]>,
    /// One normal a vertex, not necessarily of unit length.
    pub normals: Option<Vec<Vec3>>,
    /// One texture point a vertex, v upwards.
    pub uvs: Option<Vec<Vec2>>,
    /// Index into the model's materials.
    pub material: Option<usize>,
}

/// A material of a mesh file.
#[derive(Clone, PartialEq, Debug)]
pub struct ModelMaterial {
    /// As the file names it.
    pub name: String,
    /// What it does to light.
    pub look: Look,
}

/// A picture that a mesh file names or holds.
#[derive(Clone, PartialEq, Debug)]
pub struct ModelPicture {
    /// For people: the file's name, or what the mesh file calls it.
    pub name: String,
    /// Where its bytes are.
    pub source: PictureSource,
}

/// Where the bytes of a picture are.
#[derive(Clone, PartialEq, Debug)]
pub enum PictureSource {
    /// In a file of this name, as seen from the mesh file.
    File(String),
    /// In the mesh file itself.
    Bytes(Arc<[u8]>),
    /// Nowhere that can be read, for this reason.
    Nowhere(String),
}

/// Why a mesh cannot be read.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum MeshError {
    /// A line that makes no sense.
    #[error("line {line}: {reason}")]
    Line {
        /// From 1.
        line: usize,
        /// In words.
        reason: String,
    },
    /// A place in a glTF file that makes no sense.
    #[error("`{path}` {reason}")]
    At {
        /// Such as `meshes[0].primitives[2].mode`.
        path: String,
        /// In words that follow the path.
        reason: String,
    },
    /// The whole of it makes no sense.
    #[error("{0}")]
    Whole(String),
    /// No faces.
    #[error("it has no faces")]
    Empty,
    /// Faces, but none that could be seen.
    #[error("nothing is left of it: {0}")]
    NothingLeft(String),
    /// No part has the name that the scene asks for.
    #[error("no part of it is named `{wanted}`")]
    NoPart {
        /// The name.
        wanted: String,
        /// The names there are.
        known: Vec<String>,
    },
}

impl MeshError {
    /// The whole file is wrong.
    pub(super) fn whole(reason: impl Into<String>) -> Self {
        Self::Whole(reason.into())
    }
}

/// A name as it can stand between quotes.
pub(super) fn speakable(name: &str) -> String {
    name.chars().map(|c| if c.is_control() || c == '"' { '_' } else { c }).collect()
}

/// Whether the area is exactly 0, in double precision; nothing fuzzier.
pub(super) fn is_degenerate(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    (b - a).cross(c - a).length_squared() == 0.0
}

impl Part {
    /// The same without vertices that no triangle uses, so that these do not stretch its box.
    #[must_use]
    pub(super) fn without_unused_vertices(mut self) -> Self {
        let mut place = vec![u32::MAX; self.positions.len()];
        self.triangles.iter().flatten().for_each(|&vertex| place[vertex as usize] = 0);
        if place.iter().all(|&place| place == 0) {
            return self;
        }
        let used: Vec<bool> = place.iter().map(|&place| place == 0).collect();
        let kept = place.iter_mut().filter(|place| **place == 0);
        kept.zip(0..).for_each(|(place, number)| *place = number);
        self.triangles.iter_mut().flatten().for_each(|vertex| *vertex = place[*vertex as usize]);
        keep(&mut self.positions, &used);
        self.normals.iter_mut().for_each(|normals| keep(normals, &used));
        self.uvs.iter_mut().for_each(|uvs| keep(uvs, &used));
        self
    }
}

fn keep<T>(list: &mut Vec<T>, used: &[bool]) {
    let mut used = used.iter();
    list.retain(|_| used.next() == Some(&true));
}
