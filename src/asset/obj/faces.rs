//! From the faces of an OBJ file to parts that share their vertices.

use super::{BAD, Contents, Corner, Face, NONE};
use crate::asset::model::{MeshError, Part, is_degenerate, speakable};
use crate::asset::polygon::triangulate_face;
use crate::asset::report::{About, ImportReport};
use crate::math::{Vec2, Vec3};

/// What makes faces one part: their material, and what their corners have.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    /// The order of first use.
    material: u32,
    has_uvs: bool,
    has_normals: bool,
}

/// The parts of a file; those of one material, if `part` names it.
///
/// # Errors
/// When nothing is left, or nothing has that name.
pub(super) fn parts(
    file: &Contents,
    part: Option<&str>,
    report: &mut ImportReport,
) -> Result<Vec<Part>, MeshError> {
    let mut trouble = Trouble::default();
    let wanted = part.map(|name| wanted(file, name)).transpose()?;
    let mut faces: Vec<(Kind, usize)> = Vec::with_capacity(file.faces.len());
    for (index, face) in file.faces.iter().enumerate() {
        if wanted.is_none_or(|wanted| wanted == face.material)
            && let Some(kind) = trouble.kind(file, face, file.corners_of(index))
        {
            faces.push((kind, index));
        }
    }
    faces.sort_by_key(|(kind, _)| *kind); // stable, so that the order of the file stays

    let mut shared = vec![(0, NONE); file.positions.len()];
    let mut parts = Vec::new();
    for (epoch, faces) in faces.chunk_by(|a, b| a.0 == b.0).enumerate() {
        let mut builder = Builder::new(file, faces[0].0, epoch as u32 + 1, &mut shared);
        for &(_, index) in faces {
            builder.face(file.corners_of(index), file.faces[index].line, &mut trouble);
        }
        parts.extend(builder.finish());
    }
    trouble.report(report);
    if !parts.is_empty() {
        return Ok(parts);
    }
    let lost = trouble.said().next().map(|(_, text)| text).or_else(|| report.lost_shape());
    Err(lost.map_or(MeshError::Empty, MeshError::NothingLeft))
}

/// The number of a material by its name.
fn wanted(file: &Contents, name: &str) -> Result<u32, MeshError> {
    if name.is_empty() {
        return Ok(0); // what comes before any `usemtl`
    }
    let known: Vec<String> = file.names.iter().map(|name| speakable(name)).collect();
    match known.iter().position(|known| known == name) {
        Some(index) => Ok(index as u32 + 1),
        None => Err(MeshError::NoPart { wanted: name.to_owned(), known }),
    }
}

impl Contents {
    fn corners_of(&self, face: usize) -> &[Corner] {
        let end = self.faces.get(face + 1).map_or(self.corners.len(), |next| next.start);
        &self.corners[self.faces[face].start..end]
    }
}

/// What is wrong with faces: how many, and the line of the first.
#[derive(Default)]
struct Trouble {
    counts: [(usize, u32); Fault::ALL.len()],
}

#[derive(Clone, Copy)]
enum Fault {
    Flat,
    NotFinite,
    OutOfRange,
    FewCorners,
    HalfUvs,
    HalfNormals,
}

impl Fault {
    const ALL: [Self; 6] =
        [Self::Flat, Self::NotFinite, Self::OutOfRange, Self::FewCorners, Self::HalfUvs, Self::HalfNormals];

    fn text(self, count: usize, line: u32) -> String {
        let many = |one: &str, several: &str| match count {
            1 => format!("{one} (line {line})"),
            _ => format!("{count} {several} (the first in line {line})"),
        };
        match self {
            Self::Flat => many("one triangle that has no area", "triangles that have no area"),
            Self::NotFinite => {
                many("one face with a vertex that is not finite", "faces with vertices that are not finite")
            }
            Self::OutOfRange => many(
                "one face that names a vertex that is not there",
                "faces that name vertices that are not there",
            ),
            Self::FewCorners => {
                many("one face of fewer than three corners", "faces of fewer than three corners")
            }
            Self::HalfUvs => many(
                "the texture points of one face, which lacks some or names what is not there",
                "faces' texture points, as they lack some or name what is not there",
            ),
            Self::HalfNormals => many(
                "the normals of one face, which lacks some or has such as are no directions",
                "faces' normals, as they lack some or have such as are no directions",
            ),
        }
    }
}

impl Trouble {
    fn note(&mut self, fault: Fault, line: u32) {
        let (count, first) = &mut self.counts[fault as usize];
        *count += 1;
        *first = if *count == 1 { line } else { line.min(*first) };
    }

    /// What a face is part of; `None` for one that cannot be drawn.
    fn kind(&mut self, file: &Contents, face: &Face, corners: &[Corner]) -> Option<Kind> {
        let fault = if corners.len() < 3 {
            Some(Fault::FewCorners)
        } else if corners.iter().any(|c| c.position as usize >= file.positions.len()) {
            Some(Fault::OutOfRange)
        } else if corners.iter().any(|c| !file.positions[c.position as usize].is_finite()) {
            Some(Fault::NotFinite)
        } else {
            None
        };
        if let Some(fault) = fault {
            self.note(fault, face.line);
            return None;
        }
        let is_uv = |index: u32| file.uvs.get(index as usize).is_some_and(|uv| uv.is_finite());
        let is_normal = |index: u32| file.normals.get(index as usize).is_some_and(|n| is_direction(*n));
        let has_uvs = corners.iter().all(|c| is_uv(c.uv));
        if !has_uvs && corners.iter().any(|c| c.uv != NONE) {
            self.note(Fault::HalfUvs, face.line);
        }
        let has_normals = corners.iter().all(|c| is_normal(c.normal));
        if !has_normals && corners.iter().any(|c| c.normal != NONE) {
            self.note(Fault::HalfNormals, face.line);
        }
        Some(Kind { material: face.material, has_uvs, has_normals })
    }

    /// The faults there are.
    fn said(&self) -> impl Iterator<Item = (Fault, String)> {
        let all = Fault::ALL.into_iter().zip(self.counts);
        all.filter(|(_, (count, _))| *count > 0)
            .map(|(fault, (count, line))| (fault, fault.text(count, line)))
    }

    fn report(&self, report: &mut ImportReport) {
        for (fault, text) in self.said() {
            let about = if matches!(fault, Fault::HalfUvs) { About::Material } else { About::Shape };
            report.left_out(about, text);
        }
    }
}

/// Whether a vector says a direction: finite, and not 0.
fn is_direction(n: Vec3) -> bool {
    n.is_finite() && n.as_dvec3().length_squared() > 0.0
}

/// A part as it grows.
struct Builder<'a> {
    file: &'a Contents,
    kind: Kind,
    epoch: u32,
    /// By position: the part that last used it, and the first of its vertices there.
    shared: &'a mut [(u32, u32)],
    /// By vertex: its corner, and the next vertex of the same position.
    vertices: Vec<(Corner, u32)>,
    triangles: Vec<[u32; 3]>,
    face: Vec<u32>,
}

impl<'a> Builder<'a> {
    fn new(file: &'a Contents, kind: Kind, epoch: u32, shared: &'a mut [(u32, u32)]) -> Self {
        Self { file, kind, epoch, shared, vertices: Vec::new(), triangles: Vec::new(), face: Vec::new() }
    }

    /// Adds the triangles of a face that have an area, and no vertex that only others have.
    fn face(&mut self, corners: &[Corner], line: u32, trouble: &mut Trouble) {
        let point = |corner: &Corner| self.file.positions[corner.position as usize];
        let before = self.vertices.len();
        let mut add = |this: &mut Self, t: [u32; 3]| {
            if is_degenerate(t.map(|i| point(&corners[i as usize]))) {
                trouble.note(Fault::Flat, line);
                return;
            }
            let triangle = t.map(|i| this.vertex(&corners[i as usize]));
            this.triangles.push(triangle);
        };
        if corners.len() == 3 {
            add(self, [0, 1, 2]);
        } else {
            let points: Vec<Vec3> = corners.iter().map(point).collect();
            triangulate_face(&points).into_iter().for_each(|t| add(self, t));
        }
        debug_assert!(self.vertices.len() - before <= corners.len());
        self.face.clear();
    }

    /// The vertex of a corner: one that is there, or a new one.
    fn vertex(&mut self, corner: &Corner) -> u32 {
        let used = |has: bool, index: u32| if has { index } else { NONE };
        let corner = Corner {
            position: corner.position,
            uv: used(self.kind.has_uvs, corner.uv),
            normal: used(self.kind.has_normals, corner.normal),
        };
        let entry = &mut self.shared[corner.position as usize];
        if entry.0 != self.epoch {
            *entry = (self.epoch, NONE);
        }
        let mut at = entry.1;
        while at != NONE {
            let (known, next) = self.vertices[at as usize];
            if known == corner {
                return at;
            }
            at = next;
        }
        let index = self.vertices.len() as u32;
        self.vertices.push((corner, entry.1));
        entry.1 = index;
        index
    }

    /// The part, unless none of its faces has an area.
    fn finish(self) -> Option<Part> {
        let of =
            |index: fn(&Corner) -> u32| self.vertices.iter().map(move |(corner, _)| index(corner) as usize);
        let normals = || of(|c| c.normal).map(|i| self.file.normals[i]).collect();
        let uvs = || of(|c| c.uv).map(|i| self.file.uvs[i]).collect::<Vec<Vec2>>();
        let material = (self.kind.material as usize).checked_sub(1);
        (!self.triangles.is_empty()).then(|| Part {
            name: material.map_or(String::new(), |index| speakable(&self.file.names[index])),
            positions: of(|c| c.position).map(|i| self.file.positions[i]).collect(),
            normals: self.kind.has_normals.then(normals),
            uvs: self.kind.has_uvs.then(uvs),
            material,
            triangles: self.triangles,
        })
    }
}

const _: () = assert!(BAD < NONE, "both lie beyond every index");
