//! Wavefront OBJ with MTL.
//!
//! What can be rendered is: a face that names vertices that are not there or not finite, or that has no area, is left out
//! and counted, with the first line that does so. Numbers that are no numbers are a mistake, with their line. Concave faces
//! are ear-clipped; the names of `usemtl` survive a missing MTL file; faces without texture points or normals make parts of
//! their own, so that each face is drawn by what it says itself.

mod faces;
mod mtl;
mod text;

use super::look::Look;
use super::model::{MeshError, Model, ModelMaterial};
use super::report::{About, ImportReport};
use crate::math::{Vec2, Vec3};
use std::collections::HashMap;
use text::{Lines, float, integer};

/// More corners than this make no face that anyone drew: ear-clipping takes the square of their number.
const MOST_CORNERS: usize = 10_000;

/// Reads an OBJ file; only the faces of one material, if `part` names it. `open` gives the bytes of an MTL file that it
/// names, or says why there are none.
///
/// # Errors
/// [`MeshError`] with the line where that is known.
pub fn read(
    bytes: &[u8],
    open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    part: Option<&str>,
) -> Result<Model, MeshError> {
    let bytes = text::in_utf8(bytes);
    let mut file = Contents::default();
    let mut lines = Lines::new(&bytes);
    while let Some((number, line)) = lines.next() {
        file.line(&line, number).map_err(|reason| MeshError::Line { line: number, reason })?;
    }
    file.into_model(open, part)
}

/// What the lines of a file say.
#[derive(Default)]
struct Contents {
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    corners: Vec<Corner>,
    faces: Vec<Face>,
    names: Vec<String>,
    index_of_name: HashMap<String, u32>,
    material: u32,
    libraries: Vec<String>,
    report: ImportReport,
}

/// Indices of a corner, from 0; [`NONE`] where it has none, and [`BAD`] where none can be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Corner {
    position: u32,
    uv: u32,
    normal: u32,
}

const NONE: u32 = u32::MAX;
const BAD: u32 = u32::MAX - 1;

/// A face: where its corners begin.
#[derive(Clone, Copy, Debug)]
struct Face {
    start: usize,
    /// From 1; index 0 is no material.
    material: u32,
    line: u32,
}

impl Contents {
    fn line(&mut self, line: &[u8], number: usize) -> Result<(), String> {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let Some(keyword) = words.next() else { return Ok(()) };
        // A sign of its own or at the start of a word begins a comment.
        let mut words = words.take_while(|word| word[0] != b'#');
        match keyword {
            b"v" => {
                let values = numbers::<3>(&mut words).ok_or("a `v` needs three numbers")?;
                self.positions.push(Vec3::from_array(values));
                if words.count() >= 3 {
                    self.report.ignored(About::Material, "colours of vertices");
                }
            }
            b"vt" => {
                let u = words.next().and_then(float).ok_or("a `vt` needs a number")?;
                let v = words.next().map_or(Some(0.0), float).ok_or("a `vt` needs two numbers")?;
                self.uvs.push(Vec2::new(u, v));
            }
            b"vn" => {
                let values = numbers::<3>(&mut words).ok_or("a `vn` needs three numbers")?;
                self.normals.push(Vec3::from_array(values));
            }
            b"f" | b"fo" => return self.face(words, number),
            b"usemtl" => self.material = self.number_of(&text::name(line, keyword)),
            b"mtllib" => self.libraries.push(text::name(line, keyword)),
            b"p" => self.report.left_out(About::Shape, "points, which have no surface"),
            b"l" => self.report.left_out(About::Shape, "lines, which have no surface"),
            b"curv" | b"curv2" | b"surf" => {
                self.report.left_out(About::Shape, "curves and free-form surfaces");
            }
            _ if keyword[0] == b'#' || IDLE.contains(&keyword) => {}
            _ if keyword.is_ascii() && keyword.iter().all(u8::is_ascii_graphic) => {
                let keyword = String::from_utf8_lossy(&keyword[..keyword.len().min(20)]);
                self.report.passed_over(About::Shape, format!("lines that begin with `{keyword}`"));
            }
            _ => return Err("this is not text".to_owned()),
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, number: usize) -> Result<(), String> {
        let start = self.corners.len();
        for word in words {
            let corner = self.corner(word).ok_or_else(|| {
                "a face needs indices such as `f 1 2 3` or `f 1/1/1 2/2/2 3/3/3`".to_owned()
            })?;
            self.corners.push(corner);
        }
        match self.corners.len() - start {
            0 => Err("a face needs at least three corners".to_owned()),
            count if count > MOST_CORNERS => {
                self.corners.truncate(start);
                let text = format!("faces of more than {MOST_CORNERS} corners");
                self.report.left_out(About::Shape, text);
                Ok(())
            }
            _ => {
                self.faces.push(Face { start, material: self.material, line: number as u32 });
                Ok(())
            }
        }
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &[u8]) -> Option<Corner> {
        let mut fields = word.split(|&byte| byte == b'/');
        let position = index(fields.next()?, self.positions.len())?;
        let mut optional = |count: usize| match fields.next() {
            None | Some(b"") => Some(NONE),
            Some(field) => index(field, count),
        };
        let (uv, normal) = (optional(self.uvs.len())?, optional(self.normals.len())?);
        (position != NONE).then_some(Corner { position, uv, normal })
    }

    /// The number of a material, from 1.
    fn number_of(&mut self, name: &str) -> u32 {
        if let Some(&known) = self.index_of_name.get(name) {
            return known;
        }
        self.names.push(name.to_owned());
        let number = self.names.len() as u32;
        self.index_of_name.insert(name.to_owned(), number);
        number
    }

    fn into_model(
        mut self,
        open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
        part: Option<&str>,
    ) -> Result<Model, MeshError> {
        let (materials, pictures) = self.materials(open);
        let mut report = std::mem::take(&mut self.report);
        let parts = faces::parts(&self, part, &mut report)?;
        Ok(Model { parts, materials, pictures, report })
    }

    /// The materials that are used, from the MTL files.
    fn materials(
        &mut self,
        open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    ) -> (Vec<ModelMaterial>, Vec<super::model::ModelPicture>) {
        let mut library = mtl::Library::default();
        for file in &self.libraries {
            match mtl::open(file, open) {
                Ok(bytes) => library.read(&bytes, &mut self.report),
                Err(reason) => {
                    self.report.left_out(About::Material, format!("the material file `{file}`: {reason}"));
                }
            }
        }
        let found = |name: &String| match library.look(name) {
            Some(look) => ModelMaterial { name: name.clone(), look },
            None => ModelMaterial { name: name.clone(), look: Look::gray() },
        };
        let materials: Vec<ModelMaterial> = self.names.iter().map(found).collect();
        for name in self.names.iter().filter(|name| !library.knows(name)) {
            // Without a material file a name is only that, and that a file is missing has been said.
            match library.is_empty() {
                true => {
                    self.report.passed_over(About::Material, format!("`{name}`, a mere name: it is grey"))
                }
                false => self.report.approximated(
                    About::Material,
                    format!("the material `{name}`, which no material file describes, by grey"),
                ),
            }
        }
        (materials, library.pictures)
    }
}

/// Keywords that say nothing of surfaces: groups, smoothing that the normals carry, levels of detail, and what describes
/// free-form curves.
const IDLE: &[&[u8]] = &[
    b"g",
    b"o",
    b"s",
    b"mg",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"usemap",
    b"maplib",
    b"shadow_obj",
    b"trace_obj",
    b"ctech",
    b"stech",
    b"vp",
    b"deg",
    b"bmat",
    b"step",
    b"cstype",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
];

/// An index of a corner, from 0, where `count` things have been read: counted from 1, or backwards from -1. What may yet
/// come is known only at the end of the file.
fn index(field: &[u8], count: usize) -> Option<u32> {
    match integer(field)? {
        0 => Some(BAD),
        forwards @ 1.. => Some(u32::try_from(forwards - 1).unwrap_or(BAD).min(BAD)),
        backwards => {
            let index = (count as i64).checked_add(backwards).filter(|index| *index >= 0);
            Some(index.and_then(|index| u32::try_from(index).ok()).unwrap_or(BAD).min(BAD))
        }
    }
}

fn numbers<'a, const N: usize>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<[f32; N]> {
    let mut out = [0.0; N];
    for value in &mut out {
        *value = float(words.next()?)?;
    }
    Some(out)
}

#[cfg(test)]
mod tests;
