//! A primitive of a mesh: its triangles, with the vertices that these use, in the pose that the file stores.

use super::access::{Accessor, Buffers};
use super::json::At;
use crate::asset::model::{MeshError, Part, is_degenerate};
use crate::asset::report::{About, ImportReport};
use crate::math::{DAffine3, DMat3, DVec3, Vec2, Vec3};

/// The most triangles that a file may place.
pub(super) const MOST_TRIANGLES: u64 = 20_000_000;

/// How vertices move from where the mesh has them.
#[derive(Default)]
pub(super) struct Pose {
    /// The share of each morph target.
    pub(super) weights: Vec<f64>,
    /// For each joint of the skin, world from mesh; then the node's own place does not count.
    pub(super) joints: Vec<DAffine3>,
}

impl Pose {
    /// Whether nothing moves.
    pub(super) fn is_rest(&self) -> bool {
        self.joints.is_empty() && self.weights.iter().all(|weight| *weight == 0.0)
    }
}

/// What a primitive is read from.
pub(super) struct Reader<'r, 'a> {
    pub(super) buffers: &'r Buffers<'a>,
    pub(super) report: &'r mut ImportReport,
    pub(super) lost: &'r mut Lost,
    /// Which set of texture points the material looks up.
    pub(super) uv_set: u32,
}

impl<'a> Reader<'_, 'a> {
    /// The triangles of a primitive; `None` for points and lines, and where no triangle has an area.
    pub(super) fn part(&mut self, at: &At<'_>, name: &str, pose: &Pose) -> Result<Option<Part>, MeshError> {
        let mode = at.whole("mode")?.unwrap_or(4);
        if mode < 4 {
            self.report.left_out(About::Shape, "points and lines, which have no surface");
            return Ok(None);
        }
        let attributes = at.need("attributes")?;
        let positions = self.attribute(&attributes, "POSITION", &[3], 0).map_err(|error| {
            let is_packed = at.extension("KHR_draco_mesh_compression").is_some();
            let packed = || at.wrong("is compressed (KHR_draco_mesh_compression), which is not read");
            if is_packed { packed() } else { error }
        })?;
        let positions = positions.ok_or_else(|| at.wrong("has no `POSITION`"))?;
        let corners = self.corners(at, positions.count)?;
        let triangles = triangles(mode, &corners).ok_or_else(|| at.wrong(format!("has the mode {mode}")))?;
        if mode == 4 && corners.len() % 3 != 0 {
            self.report.left_out(About::Shape, "corners beyond the last whole triangle");
        }
        let used = Used::of(&triangles, positions.count);
        let mut vertices = Vertices {
            points: used.iter().map(|i| vector(positions.floats(i))).collect(),
            normals: self.normals(&attributes, &used, positions.count)?,
        };
        self.morph(at, &used, pose, &mut vertices)?;
        self.skin(&attributes, &used, pose, &mut vertices)?;

        let mut part = Part { name: name.to_owned(), ..Part::default() };
        part.positions = vertices.points.iter().map(|p| p.as_vec3()).collect();
        self.keep_triangles(&mut part, &triangles, &used);
        if part.triangles.is_empty() {
            return Ok(None);
        }
        part.normals = vertices.normals.map(|normals| self.directions(&part, &normals));
        part.uvs = self.uvs(&attributes, &used, positions.count)?;
        self.pass_over(at, &attributes, pose);
        Ok(Some(part.without_unused_vertices()))
    }

    /// An attribute with as many elements as there are vertices.
    fn attribute(
        &self,
        attributes: &At<'_>,
        name: &str,
        widths: &[usize],
        vertices: usize,
    ) -> Result<Option<Accessor<'a>>, MeshError> {
        let Some(accessor) = self.buffers.refer(attributes, name)? else { return Ok(None) };
        let accessor = accessor.of_width(widths)?;
        if accessor.count < vertices {
            let reason = format!("has {} elements for {vertices} vertices", accessor.count);
            return Err(MeshError::At { path: accessor.path, reason });
        }
        Ok(Some(accessor))
    }

    /// The vertex of each corner, in order.
    fn corners(&self, at: &At<'_>, vertices: usize) -> Result<Vec<u32>, MeshError> {
        let indices = self.buffers.refer(at, "indices")?.map(|indices| indices.of_width(&[1])).transpose()?;
        let count = indices.as_ref().map_or(vertices, |indices| indices.count) as u64;
        if count > 3 * MOST_TRIANGLES {
            return Err(at.wrong(format!("has {count} corners: at most {MOST_TRIANGLES} triangles are read")));
        }
        indices.map_or_else(|| Ok((0..vertices as u32).collect()), |indices| indices.indices())
    }

    fn normals(
        &mut self,
        attributes: &At<'_>,
        used: &Used,
        vertices: usize,
    ) -> Result<Option<Vec<DVec3>>, MeshError> {
        match self.attribute(attributes, "NORMAL", &[3], vertices) {
            Ok(normals) => Ok(normals.map(|all| used.iter().map(|i| vector(all.floats(i))).collect())),
            Err(error) => {
                self.report.left_out(About::Shape, format!("normals, as {error}"));
                Ok(None)
            }
        }
    }

    /// Moves vertices by their morph targets.
    fn morph(&self, at: &At<'_>, used: &Used, pose: &Pose, vertices: &mut Vertices) -> Result<(), MeshError> {
        for (target, &weight) in at.list("targets")?.iter().zip(&pose.weights) {
            if weight == 0.0 {
                continue;
            }
            let add = |to: &mut [DVec3], name: &str| -> Result<(), MeshError> {
                if let Some(by) = self.attribute(target, name, &[3], used.vertex_count())? {
                    used.iter().zip(to).for_each(|(i, p)| *p += vector(by.floats(i)) * weight);
                }
                Ok(())
            };
            add(&mut vertices.points, "POSITION")?;
            if let Some(normals) = &mut vertices.normals {
                add(normals, "NORMAL")?;
            }
        }
        Ok(())
    }

    /// Moves vertices by the joints that hold them (glTF 2.0, section 3.7.3).
    fn skin(
        &self,
        attributes: &At<'_>,
        used: &Used,
        pose: &Pose,
        vertices: &mut Vertices,
    ) -> Result<(), MeshError> {
        let Some(last) = pose.joints.len().checked_sub(1) else { return Ok(()) };
        let of = |name: &str| self.attribute(attributes, name, &[4], used.vertex_count());
        let sets = [(of("JOINTS_0")?, of("WEIGHTS_0")?), (of("JOINTS_1")?, of("WEIGHTS_1")?)];
        for (slot, vertex) in used.iter().enumerate() {
            let (mut sum, mut total) = (DAffine3::ZERO, 0.0);
            for (joints, weights) in sets.iter().filter_map(|(j, w)| Some((j.as_ref()?, w.as_ref()?))) {
                for (joint, weight) in joints.floats::<4>(vertex).into_iter().zip(weights.floats::<4>(vertex))
                {
                    let (joint, weight) = (pose.joints[(joint as usize).min(last)], f64::from(weight));
                    sum = blend(sum, joint, weight);
                    total += weight;
                }
            }
            if total.is_finite() && total > 0.0 {
                let moved = blend(DAffine3::ZERO, sum, 1.0 / total);
                vertices.points[slot] = moved.transform_point3(vertices.points[slot]);
                if let Some(normals) = &mut vertices.normals {
                    normals[slot] = turned_normal(normals[slot], &moved.matrix3);
                }
            }
        }
        Ok(())
    }

    /// Keeps the triangles whose vertices are there and finite, and that have an area.
    fn keep_triangles(&mut self, part: &mut Part, triangles: &[[u32; 3]], used: &Used) {
        for triangle in triangles {
            let Some(t) = used.renumbered(*triangle) else {
                self.lost.outside.add(&part.name);
                continue;
            };
            let corners = t.map(|i| part.positions[i as usize]);
            if corners.iter().any(|p| !p.is_finite()) {
                self.lost.infinite.add(&part.name);
            } else if is_degenerate(corners) {
                self.lost.flat.add(&part.name);
            } else {
                part.triangles.push(t);
            }
        }
    }

    /// Normals that say a direction; where one does not, that of the triangles around it stands in.
    fn directions(&mut self, part: &Part, normals: &[DVec3]) -> Vec<Vec3> {
        let is_direction = |n: &DVec3| n.is_finite() && n.length_squared() > 0.0;
        let bad = normals.iter().filter(|n| !is_direction(n)).count();
        if bad > 0 {
            let text =
                format!("{bad} normals of `{}` that are no directions, by those of its triangles", part.name);
            self.report.approximated(About::Shape, text);
        }
        let mut around = if bad > 0 { vec![DVec3::ZERO; normals.len()] } else { Vec::new() };
        for t in part.triangles.iter().filter(|_| bad > 0) {
            let [a, b, c] = t.map(|i| part.positions[i as usize].as_dvec3());
            t.iter().for_each(|&i| around[i as usize] += (b - a).cross(c - a));
        }
        let direction = |(i, n): (usize, &DVec3)| match is_direction(n) {
            true => n.normalize_or_zero().as_vec3(),
            false => around[i].normalize_or(DVec3::Y).as_vec3(),
        };
        normals.iter().enumerate().map(direction).collect()
    }

    /// The texture points that the material looks up, v upwards.
    fn uvs(
        &mut self,
        attributes: &At<'_>,
        used: &Used,
        vertices: usize,
    ) -> Result<Option<Vec<Vec2>>, MeshError> {
        let name = format!("TEXCOORD_{}", self.uv_set);
        let accessor = match self.attribute(attributes, &name, &[2], vertices) {
            Ok(Some(accessor)) => accessor,
            Ok(None) => return Ok(None),
            Err(error) => {
                self.report.left_out(About::Material, format!("texture points, as {error}"));
                return Ok(None);
            }
        };
        let read = |i: usize| {
            let [u, v] = accessor.floats(i);
            Vec2::new(u, 1.0 - v)
        };
        let mut uvs: Vec<Vec2> = used.iter().map(read).collect();
        let bad = uvs.iter_mut().filter(|uv| !uv.is_finite()).map(|uv| *uv = Vec2::ZERO).count();
        if bad > 0 {
            self.report.left_out(About::Material, format!("{bad} texture points that are not finite"));
        }
        Ok(Some(uvs))
    }

    /// Says what else a primitive has.
    fn pass_over(&mut self, at: &At<'_>, attributes: &At<'_>, pose: &Pose) {
        let has = |name: &str| attributes.get(name).is_some();
        if has("COLOR_0") {
            self.report.ignored(About::Material, "colours of vertices");
        }
        if has("TANGENT") {
            self.report.passed_over(About::Material, "tangents, which follow from the texture points");
        }
        if has("JOINTS_0") && pose.joints.is_empty() {
            self.report.ignored(About::Shape, "joints without a skin that is placed");
        }
        if at.count("targets") > 0 {
            self.report.used(About::Shape, "morph targets, with the shares that are stored");
        }
    }
}

/// Triangles that were left out, by why.
#[derive(Default)]
pub(super) struct Lost {
    pub(super) flat: Tally,
    pub(super) infinite: Tally,
    pub(super) outside: Tally,
}

/// How many there are, and the part that has the first.
#[derive(Default)]
pub(super) struct Tally {
    count: usize,
    first: String,
}

impl Tally {
    pub(super) fn add(&mut self, part: &str) {
        if self.count == 0 {
            part.clone_into(&mut self.first);
        }
        self.count += 1;
    }
}

impl Lost {
    /// Tells of them, a sentence for each why.
    pub(super) fn report(&self, report: &mut ImportReport) {
        let mut tell = |of: &Tally, one: &str, many: &str| match of.count {
            0 => {}
            1 => report.left_out(About::Shape, format!("one triangle that {one} (in `{}`)", of.first)),
            n => report
                .left_out(About::Shape, format!("{n} triangles that {many} (the first in `{}`)", of.first)),
        };
        tell(&self.flat, "has no area", "have no area");
        tell(&self.infinite, "has a vertex that is not finite", "have vertices that are not finite");
        tell(&self.outside, "names a vertex that is not there", "name vertices that are not there");
    }
}

/// Vertices on their way to their places.
struct Vertices {
    points: Vec<DVec3>,
    normals: Option<Vec<DVec3>>,
}

fn vector(of: [f32; 3]) -> DVec3 {
    Vec3::from_array(of).as_dvec3()
}

fn blend(sum: DAffine3, other: DAffine3, weight: f64) -> DAffine3 {
    DAffine3 {
        matrix3: sum.matrix3 + other.matrix3 * weight,
        translation: sum.translation + other.translation * weight,
    }
}

/// A normal by the cofactor matrix, which is the inverse transpose up to scale and also serves flat transforms.
pub(super) fn turned_normal(n: DVec3, m: &DMat3) -> DVec3 {
    let cofactor =
        DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    (cofactor * n * m.determinant().signum()).normalize_or_zero()
}

/// Triangles of a list, a strip or a fan; `None` for what is none of these (glTF 2.0, section 3.7.2.1).
fn triangles(mode: u64, corners: &[u32]) -> Option<Vec<[u32; 3]>> {
    let strip = |(i, w): (usize, &[u32])| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
    Some(match mode {
        4 => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        5 => corners.windows(3).enumerate().map(strip).collect(),
        6 => corners.get(1..).unwrap_or(&[]).windows(2).map(|w| [corners[0], w[0], w[1]]).collect(),
        _ => return None,
    })
}

/// The vertices that triangles use, in order, and their new numbers.
struct Used {
    vertices: Vec<u32>,
    /// By vertex.
    numbers: Vec<u32>,
}

impl Used {
    fn of(triangles: &[[u32; 3]], count: usize) -> Self {
        let mut numbers = vec![u32::MAX; count];
        let inside = |t: &&[u32; 3]| t.iter().all(|&i| (i as usize) < count);
        for &vertex in triangles.iter().filter(inside).flatten() {
            numbers[vertex as usize] = 0;
        }
        let vertices: Vec<u32> = (0..count as u32).filter(|&v| numbers[v as usize] == 0).collect();
        vertices.iter().zip(0..).for_each(|(&vertex, number)| numbers[vertex as usize] = number);
        Self { vertices, numbers }
    }

    fn iter(&self) -> impl Iterator<Item = usize> {
        self.vertices.iter().map(|&vertex| vertex as usize)
    }

    fn vertex_count(&self) -> usize {
        self.numbers.len()
    }

    fn renumbered(&self, t: [u32; 3]) -> Option<[u32; 3]> {
        let number = |i: u32| self.numbers.get(i as usize).copied().filter(|&number| number != u32::MAX);
        Some([number(t[0])?, number(t[1])?, number(t[2])?])
    }
}
