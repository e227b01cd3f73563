//! Wavefront OBJ with MTL, through `tobj`, with guards around what it lets pass.
//!
//! Guards: numbers must be finite; concave faces are ear-clipped, not fanned; `usemtl` names survive a missing MTL file;
//! comments at line ends and continued lines are accepted; faces that carry texture points or normals only at some corners
//! lose them, with a note; triangles of no area are dropped and counted.

use super::polygon::triangulate_face;
use crate::math::{Rgb, Vec2, Vec3};
use std::cell::Cell;
use std::collections::HashMap;
use std::io::{self, BufRead, Read};
use tobj::{LoadError, LoadOptions};

/// A mesh file.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Model {
    /// Triangles by material, in file order.
    pub parts: Vec<Part>,
    /// The materials that `usemtl` names, in order of first use.
    pub materials: Vec<ModelMaterial>,
    /// What was read differently from what the file says.
    pub notes: Notes,
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
    /// Vertices, in the file's own units.
    pub positions: Vec<Vec3>,
    /// Three vertex indices each.
    pub triangles: Vec<[u32; 3]>,
    /// One normal a vertex, not necessarily of unit length.
    pub normals: Option<Vec<Vec3>>,
    /// One texture point a vertex.
    pub uvs: Option<Vec<Vec2>>,
    /// Index into the model's materials.
    pub material: Option<usize>,
}

/// A material of an MTL file; without one, only its name is known.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ModelMaterial {
    /// The `usemtl` name.
    pub name: String,
    /// `Kd`.
    pub diffuse: Option<[f32; 3]>,
    /// `Ks`.
    pub specular: Option<[f32; 3]>,
    /// `Ke`.
    pub emission: Option<[f32; 3]>,
    /// `Ns`.
    pub shininess: Option<f32>,
    /// `Ni`.
    pub ior: Option<f32>,
    /// `d`: 1 is opaque.
    pub opacity: Option<f32>,
    /// `map_Kd`.
    pub diffuse_map: Option<String>,
}

impl ModelMaterial {
    /// Whether it shines.
    pub fn shines(&self) -> bool {
        self.emission.is_some_and(|c| Rgb::from(c).is_valid() && !Rgb::from(c).is_black())
    }

    /// Whether light goes through it: less than half opaque.
    pub fn is_clear(&self) -> bool {
        !self.shines() && self.opacity.is_some_and(|opacity| opacity < 0.5)
    }
}

/// What was read differently from what the file says.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Notes {
    /// Triangles of no area, left out.
    pub degenerate: usize,
    /// Parts whose texture points did not cover every corner.
    pub partial_uvs: usize,
    /// Parts whose normals did not cover every corner.
    pub partial_normals: usize,
    /// MTL files that could not be read.
    pub missing_mtl: Vec<String>,
}

/// Why a mesh cannot be read.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ObjError {
    /// A line that makes no sense.
    #[error("line {line}: {reason}")]
    Line {
        /// From 1.
        line: usize,
        /// In words.
        reason: String,
    },
    /// NaN or infinity.
    #[error("{count} of its vertices are not finite numbers in single precision")]
    NotFinite {
        /// How many.
        count: usize,
    },
    /// No faces.
    #[error("it has no faces")]
    Empty,
    /// Faces, but none that could be seen.
    #[error("all of its {count} triangles have no area")]
    Flat {
        /// How many.
        count: usize,
    },
}

/// Reads an OBJ file. `open` gives the bytes of an MTL file that it names.
///
/// # Errors
/// [`ObjError`] with the line where that is known.
pub fn read(bytes: &[u8], open: impl Fn(&str) -> Option<Vec<u8>>) -> Result<Model, ObjError> {
    let text = clean(bytes);
    let names = used_materials(&text);
    let line = Cell::new(0);
    let mut reader =
        io::BufReader::new(&b"mtllib names\n"[..]).chain(Counted { inner: &text[..], line: &line });
    let options =
        LoadOptions { single_index: true, ignore_points: true, ignore_lines: true, ..Default::default() };
    let table = Cell::new(name_table(&names)); // taken by our own `mtllib`, which comes first
    let (models, _) = tobj::load_obj_buf(&mut reader, &options, |_| Ok(table.take())).map_err(|error| {
        ObjError::Line { line: bad_face(&text, error).unwrap_or(line.get()).max(1), reason: reason(error) }
    })?;

    let mut model = Model::default();
    (model.materials, model.notes.missing_mtl) = materials(&text, &names, open);
    for source in &models {
        let part = part(&source.mesh, &mut model.notes)?;
        if !part.triangles.is_empty() {
            model.parts.push(part);
        }
    }
    match model.notes.degenerate {
        _ if !model.parts.is_empty() => Ok(model),
        0 => Err(ObjError::Empty),
        count => Err(ObjError::Flat { count }),
    }
}

/// The line (from 1) of the first face with an index out of bounds: `tobj` judges faces only when their group is done.
fn bad_face(text: &[u8], error: LoadError) -> Option<usize> {
    let (keyword, slot) = match error {
        LoadError::FaceVertexOutOfBounds => ("v", 0),
        LoadError::FaceTexCoordOutOfBounds => ("vt", 1),
        LoadError::FaceNormalOutOfBounds => ("vn", 2),
        _ => return None,
    };
    let total = words_after(text, keyword).count() as i64;
    let mut so_far = 0;
    let text = String::from_utf8_lossy(text);
    text.lines()
        .position(|line| {
            let mut words = line.split_whitespace();
            let head = words.next().unwrap_or("");
            so_far += i64::from(head == keyword);
            let index = |corner: &str| corner.split('/').nth(slot)?.parse::<i64>().ok();
            let outside = |index: i64| index == 0 || index > total || index < -so_far;
            head == "f" && words.filter_map(index).any(outside)
        })
        .map(|line| line + 1)
}

/// The text without comments, with continued lines joined; line ends stay where they are.
fn clean(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(bytes.len());
    let mut owed = 0;
    for line in bytes.split(|&byte| byte == b'\n') {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let line = &line[..line.iter().position(|&byte| byte == b'#').unwrap_or(line.len())];
        match line.strip_suffix(b"\\") {
            Some(continued) => {
                out.extend_from_slice(continued);
                out.push(b' ');
                owed += 1;
            }
            None => {
                out.extend_from_slice(line);
                out.resize(out.len() + owed + 1, b'\n');
                owed = 0;
            }
        }
    }
    out
}

fn words_after<'a>(text: &'a [u8], keyword: &'a str) -> impl Iterator<Item = String> + 'a {
    text.split(|&byte| byte == b'\n').filter_map(move |line| {
        let rest = line.trim_ascii().strip_prefix(keyword.as_bytes())?;
        let separated = rest.first().is_some_and(u8::is_ascii_whitespace);
        separated.then(|| String::from_utf8_lossy(rest.trim_ascii()).into_owned())
    })
}

fn used_materials(text: &[u8]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for name in words_after(text, "usemtl") {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// What `tobj` is told instead of the MTL files, so that a missing one does not lose the names.
fn name_table(names: &[String]) -> (Vec<tobj::Material>, HashMap<String, usize>) {
    let named = |name: &String| tobj::Material { name: name.clone(), ..Default::default() };
    let indices = names.iter().enumerate().map(|(index, name)| (name.clone(), index));
    (names.iter().map(named).collect(), indices.collect())
}

/// The materials of `names` from the MTL files, and the files that could not be read.
fn materials(
    text: &[u8],
    names: &[String],
    open: impl Fn(&str) -> Option<Vec<u8>>,
) -> (Vec<ModelMaterial>, Vec<String>) {
    let mut found: HashMap<String, tobj::Material> = HashMap::new();
    let mut missing = Vec::new();
    for file in words_after(text, "mtllib") {
        let read = open(&file).and_then(|bytes| tobj::load_mtl_buf(&mut &clean(&bytes)[..]).ok());
        match read {
            Some((materials, _)) => found.extend(materials.into_iter().map(|m| (m.name.clone(), m))),
            None => missing.push(file),
        }
    }
    (names.iter().map(|name| model_material(name, found.get(name))).collect(), missing)
}

fn model_material(name: &str, found: Option<&tobj::Material>) -> ModelMaterial {
    let finite = |c: [f32; 3]| c.iter().all(|x| x.is_finite()).then_some(c);
    let Some(m) = found else { return ModelMaterial { name: name.to_owned(), ..Default::default() } };
    let emission = m.unknown_param.get("Ke").and_then(|text| {
        let mut numbers = text.split_whitespace().map(str::parse);
        Some([numbers.next()?.ok()?, numbers.next()?.ok()?, numbers.next()?.ok()?])
    });
    ModelMaterial {
        name: name.to_owned(),
        diffuse: m.diffuse.and_then(finite),
        specular: m.specular.and_then(finite),
        emission: m.emissive.or(emission).and_then(finite),
        shininess: m.shininess.filter(|x| x.is_finite()),
        ior: m.optical_density.filter(|x| x.is_finite()),
        opacity: m.dissolve.filter(|x| x.is_finite()),
        diffuse_map: m.diffuse_texture.clone(),
    }
}

fn part(mesh: &tobj::Mesh, notes: &mut Notes) -> Result<Part, ObjError> {
    let positions: Vec<Vec3> = mesh.positions.chunks_exact(3).map(Vec3::from_slice).collect();
    let bad = positions.iter().filter(|p| !p.is_finite()).count();
    if bad > 0 {
        return Err(ObjError::NotFinite { count: bad });
    }
    let uvs = whole(&mesh.texcoords, 2, positions.len(), &mut notes.partial_uvs)
        .map(|flat| flat.chunks_exact(2).map(Vec2::from_slice).collect());
    let normals = whole(&mesh.normals, 3, positions.len(), &mut notes.partial_normals)
        .map(|flat| flat.chunks_exact(3).map(Vec3::from_slice).collect());
    let mut triangles = triangles(mesh, &positions);
    let before = triangles.len();
    triangles.retain(|t| !is_degenerate(t.map(|i| positions[i as usize])));
    notes.degenerate += before - triangles.len();
    let part = Part { positions, triangles, normals, uvs, material: mesh.material_id };
    Ok(if part.triangles.len() < before { part.without_unused_vertices() } else { part })
}

impl Part {
    /// The same without vertices that no triangle uses, so that these do not stretch its box.
    fn without_unused_vertices(mut self) -> Self {
        let mut used = vec![false; self.positions.len()];
        self.triangles.iter().flatten().for_each(|&vertex| used[vertex as usize] = true);
        let place: Vec<u32> = used
            .iter()
            .scan(0, |count, &used| {
                *count += u32::from(used);
                Some(u32::saturating_sub(*count, 1))
            })
            .collect();
        self.triangles.iter_mut().flatten().for_each(|vertex| *vertex = place[*vertex as usize]);
        let mut keep = used.iter().copied();
        self.positions.retain(|_| keep.next() == Some(true));
        if let Some(normals) = &mut self.normals {
            let mut keep = used.iter().copied();
            normals.retain(|_| keep.next() == Some(true));
        }
        if let Some(uvs) = &mut self.uvs {
            let mut keep = used.iter().copied();
            uvs.retain(|_| keep.next() == Some(true));
        }
        self
    }
}

/// The values, if there is one for every vertex and all are finite.
fn whole<'a>(flat: &'a [f32], width: usize, vertices: usize, partial: &mut usize) -> Option<&'a [f32]> {
    if flat.is_empty() {
        return None;
    }
    let good = flat.len() == vertices * width && flat.iter().all(|x| x.is_finite());
    *partial += usize::from(!good);
    good.then_some(flat)
}

fn triangles(mesh: &tobj::Mesh, positions: &[Vec3]) -> Vec<[u32; 3]> {
    if mesh.face_arities.is_empty() {
        return mesh.indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
    }
    let mut out = Vec::with_capacity(mesh.indices.len());
    let mut rest = &mesh.indices[..];
    for &arity in &mesh.face_arities {
        let (face, after) = rest.split_at(arity as usize);
        rest = after;
        let corners: Vec<Vec3> = face.iter().map(|&i| positions[i as usize]).collect();
        out.extend(triangulate_face(&corners).iter().map(|t| t.map(|i| face[i as usize])));
    }
    out
}

/// Whether the area is exactly 0, in double precision; nothing fuzzier.
fn is_degenerate(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    (b - a).cross(c - a).length_squared() == 0.0
}

fn reason(error: LoadError) -> String {
    let reason = match error {
        LoadError::PositionParseError => "a `v` needs three numbers",
        LoadError::NormalParseError => "a `vn` needs three numbers",
        LoadError::TexcoordParseError => "a `vt` needs two numbers",
        LoadError::FaceParseError => "a face needs indices such as `f 1 2 3` or `f 1/1/1 2/2/2 3/3/3`",
        LoadError::FaceVertexOutOfBounds => "a face names a vertex that is not there",
        LoadError::FaceTexCoordOutOfBounds => "a face names a texture point that is not there",
        LoadError::FaceNormalOutOfBounds => "a face names a normal that is not there",
        LoadError::InvalidPolygon => "a face needs at least three corners",
        LoadError::ReadError => "this is not text",
        other => return other.to_string(),
    };
    reason.to_owned()
}

/// Counts the lines that are consumed, so that an error can name one.
struct Counted<'a> {
    inner: &'a [u8],
    line: &'a Cell<usize>,
}

impl Read for Counted<'_> {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.len().min(buf.len());
        buf[..n].copy_from_slice(&self.inner[..n]);
        self.consume(n);
        Ok(n)
    }
}

impl BufRead for Counted<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Ok(self.inner)
    }

    fn consume(&mut self, n: usize) {
        let (used, rest) = self.inner.split_at(n);
        self.line.set(self.line.get() + used.iter().filter(|&&byte| byte == b'\n').count());
        self.inner = rest;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn obj(text: &str) -> Result<Model, ObjError> {
        read(text.as_bytes(), |_| None)
    }

    #[test]
    fn names_survive_a_missing_mtl_file() {
        let model =
            obj("mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 3 2 1\n")
                .unwrap();
        let names: Vec<&str> = model.materials.iter().map(|m| m.name.as_str()).collect();
        assert_eq!(names, ["red", "blue"]);
        assert_eq!(model.parts.iter().map(|p| p.material).collect::<Vec<_>>(), [Some(0), Some(1)]);
        assert_eq!(model.notes.missing_mtl, ["gone.mtl"]);
    }

    #[test]
    fn an_error_names_its_line() {
        let error = obj("v 0 0 0\nv 1 0 0\n# a comment\nv 0 one 0\nf 1 2 3\n").unwrap_err();
        assert!(matches!(error, ObjError::Line { line: 4, .. }), "{error}");
        let error = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\nf 1 2 3\n").unwrap_err();
        assert!(matches!(error, ObjError::Line { line: 5, .. }), "{error}");
    }

    #[test]
    fn comments_and_continued_lines_are_read() {
        let model = obj("v 0 0 0 # origin\nv 1 0 \\\n0\nv 0 1 0\nf 1 2 3\n").unwrap();
        assert_eq!(model.triangle_count(), 1);
    }

    #[test]
    fn what_cannot_be_rendered_is_refused_or_counted() {
        assert_eq!(obj("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), Err(ObjError::NotFinite { count: 1 }));
        assert_eq!(obj("v 0 0 0\n"), Err(ObjError::Empty));
        let model = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n").unwrap();
        assert_eq!((model.triangle_count(), model.notes.degenerate), (1, 1));
    }

    #[test]
    fn partial_normals_are_dropped_with_a_note() {
        let model = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3\n").unwrap();
        assert_eq!(model.parts[0].normals, None);
        assert_eq!(model.notes.partial_normals, 1);
    }
}
