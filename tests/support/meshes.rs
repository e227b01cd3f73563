//! Meshes and rays that are hard on a ray tracer, and the answers that trying every triangle gives.

use super::Random;
use snell::math::{DAffine3, Ray, Vec3};
use snell::render::geometry::{Geometry, Hit};
use snell::render::shape::triangle::{ShearedRay, TriangleBlock};
use snell::render::shape::{MaterialId, Mesh, Solid, SolidKind, SourceId};

pub fn mesh(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        positions,
        triangles,
        normals: None,
        uvs: None,
        material: MaterialId(0),
        object_from_world: DAffine3::IDENTITY,
        source: SourceId(0),
    }
}

pub fn solid(kind: SolidKind, world_from_object: DAffine3) -> Solid {
    let texture_from_object = DAffine3::IDENTITY;
    Solid {
        kind,
        world_from_object,
        texture_from_object,
        material: MaterialId(0),
        source: SourceId(0),
        motion: None,
    }
}

pub fn scene(mesh: Mesh) -> Geometry {
    Geometry::build(vec![mesh], Vec::new())
}

/// A closed sphere of `rows × columns` faces, its radius given by longitude and row; normals outwards.
pub fn sphere(rows: u32, columns: u32, radius: impl Fn(u32, u32) -> f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    use std::f32::consts::{PI, TAU};
    let mut positions = vec![Vec3::Y * radius(0, 0), Vec3::NEG_Y * radius(rows, 0)];
    for row in 1..rows {
        for column in 0..columns {
            let (theta, phi) = (PI * row as f32 / rows as f32, TAU * column as f32 / columns as f32);
            let dir = Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
            positions.push(dir * radius(row, column));
        }
    }
    let at = |row: u32, column: u32| match row {
        0 => 0,
        row if row == rows => 1,
        row => 2 + (row - 1) * columns + column % columns,
    };
    let mut triangles = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
            if a != b {
                triangles.push([a, b, c]);
            }
            if c != d {
                triangles.push([b, d, c]);
            }
        }
    }
    (positions, triangles)
}

/// The cube [−1, 1]³, each face of `side²` squares; vertices shared.
pub fn cube(side: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut index = std::collections::BTreeMap::new();
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for face in [0, side] {
            let mut vertex = |i: u32, j: u32| {
                let mut key = [0; 3];
                (key[axis], key[(axis + 1) % 3], key[(axis + 2) % 3]) = (face, i, j);
                *index.entry(key).or_insert_with(|| {
                    positions.push(Vec3::from(key.map(|x| x as f32 * 2.0 / side as f32 - 1.0)));
                    positions.len() as u32 - 1
                })
            };
            for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
                let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
                let quad = [[a, b, c], [a, c, d]];
                triangles.extend(if face == 0 { quad.map(|[a, b, c]| [a, c, b]) } else { quad });
            }
        }
    }
    (positions, triangles)
}

/// Closed meshes with the point inside that rays start near: spiky, round, flat-sided, far away, tiny and huge.
pub fn closed_meshes() -> Vec<(&'static str, Mesh, Vec3)> {
    let mut random = Random(1);
    let radii: Vec<f32> = (0..17 * 16).map(|_| 1.0 + 5.0 * random.unit()).collect();
    let spiky = sphere(16, 16, |row, column| radii[(row * 16 + column) as usize]);
    let round = sphere(60, 60, |_, _| 1.0);
    let cube = cube(32);
    let placed = |(positions, triangles): &(Vec<Vec3>, Vec<[u32; 3]>), scale: f32, shift: Vec3| {
        (mesh(positions.iter().map(|p| *p * scale + shift).collect(), triangles.clone()), shift)
    };
    let far = Vec3::new(148_376.0, 1234.0, -223_423.0);
    [
        ("spiky", placed(&spiky, 1.0, Vec3::ZERO)),
        ("round", placed(&round, 1.0, Vec3::ZERO)),
        ("round, far", placed(&round, 8.0, far)),
        ("round, tiny", placed(&round, 1e-6, Vec3::ZERO)),
        ("round, huge", placed(&round, 1e6, Vec3::ZERO)),
        ("round, small and far", placed(&round, 0.2, Vec3::splat(1e4))),
        ("cube", placed(&cube, 1.0, Vec3::ZERO)),
        ("cube, far", placed(&cube, 1.0, Vec3::new(1000.0, 0.0, -333.0))),
    ]
    .map(|(name, (mesh, center))| (name, mesh, center))
    .into()
}

/// A ray from near `center`, a quarter each: anywhere, at a vertex, at an edge, along an axis through a vertex's coordinate.
pub fn aimed_ray(mesh: &Mesh, center: Vec3, i: usize, random: &mut Random) -> Ray {
    let size = (mesh.positions[0] - center).length() * 0.08; // stays within the spiky one too
    let o = center + random.point() * size;
    let [a, b, _] = mesh.corners(mesh.triangles[random.below(mesh.triangles.len())]);
    match i % 4 {
        0 => Ray::new(o, random.direction()),
        1 => Ray::new(o, a - o),
        2 => Ray::new(o, a.lerp(b, random.unit()) - o),
        _ => {
            let axis = random.axis();
            let near = |p: Vec3| (p - center).abs().max_element() < size;
            let through = Vec3::select(axis.abs().cmpgt(Vec3::splat(0.5)), o, a);
            Ray::new(if near(through) { through } else { o }, axis)
        }
    }
}

/// The nearest hit by trying every triangle.
pub struct BruteForce(Vec<TriangleBlock>);

impl BruteForce {
    pub fn new(mesh: &Mesh) -> Self {
        let corners: Vec<_> =
            mesh.triangles.iter().map(|triangle| mesh.corners(*triangle)).zip(0..).collect();
        Self(corners.chunks(4).map(TriangleBlock::new).collect())
    }

    /// Whether a hit lies on the ray, before the best so far; of equals the lower primitive comes first.
    pub fn precedes((t, prim): (f32, u32), best: Option<(f32, u32)>, ray: &Ray) -> bool {
        let before = best.is_none_or(|(best_t, best_prim)| t < best_t || t == best_t && prim < best_prim);
        0.0 < t && t < ray.t_max && before
    }

    pub fn closest_hit(&self, ray: &Ray) -> Option<(u32, u32)> {
        let sheared = ShearedRay::new(ray);
        let mut best: Option<(f32, u32)> = None;
        for block in &self.0 {
            block.intersect(&sheared, |prim, hit| {
                if Self::precedes((hit.t, prim), best, ray) {
                    best = Some((hit.t, prim));
                }
            });
        }
        best.map(|(t, prim)| (t.to_bits(), prim))
    }
}

pub fn bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.prim.0))
}

/// Möller and Trumbore's test (1997) as it is mostly written: edges decided in single precision, each triangle alone.
pub fn naive_intersect([a, b, c]: [Vec3; 3], ray: &Ray) -> bool {
    let (e1, e2) = (b - a, c - a);
    let h = ray.d.cross(e2);
    let f = 1.0 / e1.dot(h);
    let s = ray.o - a;
    let u = f * s.dot(h);
    let q = s.cross(e1);
    let v = f * ray.d.dot(q);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && f * e2.dot(q) > 0.0
}
