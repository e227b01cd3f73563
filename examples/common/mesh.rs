//! Polygon meshes: built face by face, checked to be closed, written as Wavefront OBJ.

use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;
use std::io;
use std::path::Path;

use glam::{Affine3A, Vec3};

/// Polygons over shared vertices. Corners run counter-clockwise seen from outside.
#[derive(Default)]
pub struct Mesh {
    pub positions: Vec<Vec3>,
    pub faces: Vec<Face>,
}

/// One polygon: its corners, and which of the mesh's materials it wears.
pub struct Face {
    pub corners: Vec<u32>,
    pub material: usize,
}

/// A material of the OBJ's companion file: its name, diffuse colour, specular reflectance and shininess.
pub struct Paint {
    pub name: &'static str,
    pub diffuse: f32,
    pub specular: f32,
    pub shininess: f32,
}

/// Where the normals of the written file come from.
#[derive(Clone, Copy)]
pub enum Normals {
    /// The file has none: the reader takes the faces as they are, or smooths them all.
    Absent,
    /// Smooth over edges that bend by less than this angle in radians, sharp over the others.
    Crease(f32),
}

impl Mesh {
    /// Adds a vertex and returns its index.
    pub fn vertex(&mut self, p: Vec3) -> u32 {
        self.positions.push(p);
        self.positions.len() as u32 - 1
    }

    /// Adds a triangle or quad of the first material. Neighbouring corners that coincide count once, and a face that
    /// this folds flat is left out: rows that meet in a point need no special case.
    pub fn face(&mut self, corners: &[u32]) {
        self.painted_face(corners, 0);
    }

    /// As [`Mesh::face`], of the given material.
    pub fn painted_face(&mut self, corners: &[u32], material: usize) {
        let mut kept = corners.to_vec();
        kept.dedup();
        while 1 < kept.len() && kept.first() == kept.last() {
            kept.pop();
        }
        let folded = kept.len() == 4 && (kept[0] == kept[2] || kept[1] == kept[3]);
        if 3 <= kept.len() && !folded {
            self.faces.push(Face { corners: kept, material });
        }
    }

    /// Adds a copy of another mesh. A placement that mirrors turns the faces round, so that they still face outwards.
    pub fn append(&mut self, other: &Mesh, placement: Affine3A) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions.iter().map(|&p| placement.transform_point3(p)));
        let mirrored = placement.matrix3.determinant() < 0.0;
        for face in &other.faces {
            let mut corners: Vec<u32> = face.corners.iter().map(|c| first + c).collect();
            if mirrored {
                corners.reverse();
            }
            self.faces.push(Face { corners, material: face.material });
        }
    }

    /// Makes one vertex of those that round to the same multiples of `grid`, and drops the faces that vanish.
    pub fn weld(&self, grid: f32) -> Mesh {
        let mut welded = Mesh::default();
        let mut known: HashMap<[i32; 3], u32> = HashMap::new();
        let mut merge = |p: &Vec3| {
            let key = (*p / grid).round().to_array().map(|x| x as i32);
            *known.entry(key).or_insert_with(|| welded.vertex(*p))
        };
        let kept: Vec<u32> = self.positions.iter().map(&mut merge).collect();
        for face in &self.faces {
            let corners: Vec<u32> = face.corners.iter().map(|&c| kept[c as usize]).collect();
            welded.painted_face(&corners, face.material);
        }
        welded
    }

    /// Joins rows of vertices into a skin, row by row: `rows[i][j]` to `rows[i + 1][j + 1]`. `around` closes each row.
    pub fn skin(&mut self, rows: &[Vec<u32>], around: bool) {
        for pair in rows.windows(2) {
            let n = pair[0].len();
            for j in 0..if around { n } else { n - 1 } {
                let next = (j + 1) % n;
                self.face(&[pair[0][j], pair[0][next], pair[1][next], pair[1][j]]);
            }
        }
    }

    /// Proves that the mesh bounds a solid: along every edge as many faces run forth as back, and the enclosed volume
    /// is positive, so the faces look outwards. Returns the volume.
    pub fn closed_volume(&self) -> Result<f32, String> {
        if let Some((edge, [forth, back])) = self.edge_uses().iter().find(|(_, [forth, back])| forth != back)
        {
            return Err(format!("edge {edge:?} is used {forth} times forth and {back} times back"));
        }
        let volume = self.volume();
        if volume <= 0.0 { Err(format!("the faces look inwards: volume {volume}")) } else { Ok(volume) }
    }

    /// As [`Mesh::closed_volume`], and every edge belongs to exactly two faces: the surface touches itself nowhere.
    pub fn manifold_volume(&self) -> Result<f32, String> {
        match self.edge_uses().iter().find(|(_, count)| **count != [1, 1]) {
            Some((edge, _)) => Err(format!("edge {edge:?} does not belong to exactly two faces")),
            None => self.closed_volume(),
        }
    }

    /// How often faces run along each edge, from its lower vertex to its higher one and back.
    fn edge_uses(&self) -> BTreeMap<(u32, u32), [u32; 2]> {
        let mut uses: BTreeMap<(u32, u32), [u32; 2]> = BTreeMap::new();
        for face in &self.faces {
            for (&a, &b) in face.corners.iter().zip(face.corners.iter().cycle().skip(1)) {
                uses.entry((a.min(b), a.max(b))).or_default()[usize::from(b < a)] += 1;
            }
        }
        uses
    }

    /// The signed volume, by the divergence theorem over the triangles of a fan in each face.
    fn volume(&self) -> f32 {
        let at = |i: u32| self.positions[i as usize].as_dvec3();
        let six: f64 = self
            .faces
            .iter()
            .flat_map(|f| f.corners[1..].windows(2).map(|w| at(f.corners[0]).dot(at(w[0]).cross(at(w[1])))))
            .sum();
        (six / 6.0) as f32
    }

    /// The area vector of a face (Newell's method): along its normal, as long as its area.
    fn area(&self, face: &Face) -> Vec3 {
        let origin = self.positions[face.corners[0] as usize];
        let at = |i: u32| self.positions[i as usize] - origin;
        face.corners[1..].windows(2).map(|w| at(w[0]).cross(at(w[1])) / 2.0).sum()
    }

    /// A unit normal for each corner of each face: the mean of the faces around the vertex, weighted by area, without
    /// those that bend away by more than `crease` radians.
    fn corner_normals(&self, crease: f32) -> Vec<Vec<Vec3>> {
        let areas: Vec<Vec3> = self.faces.iter().map(|face| self.area(face)).collect();
        let mut around = vec![Vec::new(); self.positions.len()];
        for (index, face) in self.faces.iter().enumerate() {
            face.corners.iter().for_each(|&c| around[c as usize].push(index));
        }
        let limit = crease.cos();
        let normal = |index: usize, corner: u32| -> Vec3 {
            let own = areas[index].normalize_or_zero();
            let near = around[corner as usize].iter().map(|&i| areas[i]);
            near.filter(|area| limit <= area.normalize_or_zero().dot(own)).sum::<Vec3>().normalize_or(own)
        };
        let corners =
            |(index, face): (usize, &Face)| face.corners.iter().map(|&c| normal(index, c)).collect();
        self.faces.iter().enumerate().map(corners).collect()
    }

    /// The mesh as OBJ text, positions rounded to `digits` decimals. `title` becomes the comment on top; `paints`
    /// are the materials that faces refer to, and may be empty.
    pub fn to_obj(&self, title: &str, digits: usize, normals: Normals, paints: &[Paint]) -> String {
        let mut text = format!("# {title}\n");
        for p in &self.positions {
            let _ = writeln!(text, "v {} {} {}", short(p.x, digits), short(p.y, digits), short(p.z, digits));
        }
        let indices = self.write_normals(&mut text, normals);

        // Faces, in the order they were made; a material is named where it changes.
        let mut worn = None;
        for (index, face) in self.faces.iter().enumerate() {
            if worn != Some(face.material) && !paints.is_empty() {
                worn = Some(face.material);
                let _ = writeln!(text, "usemtl {}", paints[face.material].name);
            }
            text.push('f');
            for (k, corner) in face.corners.iter().enumerate() {
                let _ = match &indices {
                    Some(normal) => write!(text, " {}//{}", corner + 1, normal[index][k]),
                    None => write!(text, " {}", corner + 1),
                };
            }
            text.push('\n');
        }
        text
    }

    /// Writes the `vn` lines, each rounded normal once, and returns the one-based index for each corner.
    fn write_normals(&self, text: &mut String, normals: Normals) -> Option<Vec<Vec<usize>>> {
        let Normals::Crease(crease) = normals else { return None };
        let mut known: HashMap<String, usize> = HashMap::new();
        let mut index = |n: &Vec3| {
            let line = format!("vn {} {} {}\n", short(n.x, 3), short(n.y, 3), short(n.z, 3));
            let next = known.len() + 1;
            *known.entry(line).or_insert_with_key(|line| {
                text.push_str(line);
                next
            })
        };
        let rows = self.corner_normals(crease);
        Some(rows.iter().map(|row| row.iter().map(&mut index).collect()).collect())
    }

    /// Writes `NAME.obj` among the assets, with `NAME.mtl` if there are paints, and says what it wrote.
    pub fn save(&self, name: &str, title: &str, normals: Normals, paints: &[Paint]) -> io::Result<()> {
        let mut text = self.to_obj(title, 4, normals, paints);
        if !paints.is_empty() {
            text.insert_str(text.find('\n').map_or(0, |end| end + 1), &format!("mtllib {name}.mtl\n"));
            std::fs::write(super::asset(&format!("{name}.mtl")), to_mtl(paints))?;
        }
        let path = super::asset(&format!("{name}.obj"));
        std::fs::write(&path, &text)?;
        report(&path, self, text.len());
        Ok(())
    }
}

/// Says on standard output what was written, and where.
fn report(path: &Path, mesh: &Mesh, bytes: usize) {
    let (vertices, faces) = (mesh.positions.len(), mesh.faces.len());
    println!("{}: {vertices} vertices, {faces} faces, {} kB", path.display(), bytes / 1000);
}

/// The companion file with one `newmtl` for each paint.
fn to_mtl(paints: &[Paint]) -> String {
    let mut text = String::new();
    for Paint { name, diffuse, specular, shininess } in paints {
        let _ = writeln!(text, "newmtl {name}\nKd {diffuse} {diffuse} {diffuse}");
        let _ = writeln!(text, "Ks {specular} {specular} {specular}\nNs {shininess}\n");
    }
    text
}

/// A number with at most `digits` decimals and no idle zeros: `0.5`, not `0.5000`, and never `-0`.
fn short(x: f32, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_string() } else { text.to_string() }
}
