//! Shapes as triangles, in their own frame, in double precision.

use super::curve::{self, Cubic, OutlinePoint};
use crate::asset::polygon::triangulate_region;
use crate::asset::{Model, Part};
use crate::ir::Outline;
use crate::math::{DVec2, DVec3, Vec2};
use std::f64::consts::TAU;

/// Triangles in the frame of a shape.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Triangles {
    /// Vertices, in metres.
    pub positions: Vec<DVec3>,
    /// Three vertex indices each, counter-clockwise seen from outside.
    pub indices: Vec<[u32; 3]>,
    /// One normal a vertex, outwards; `None` for flat shading.
    pub normals: Option<Vec<DVec3>>,
    /// One texture point a vertex.
    pub uvs: Option<Vec<Vec2>>,
}

impl Triangles {
    /// A parallelogram with the normal `u × v`; its texture points are the unit square.
    pub fn quad(origin: DVec3, u: DVec3, v: DVec3) -> Self {
        let mut out = Self { uvs: Some(Vec::new()), ..Self::default() };
        out.add_quad([origin, origin + u, origin + u + v, origin + v]);
        out
    }

    /// A box along the axes; each face has the unit square for its texture.
    pub fn cuboid(min: DVec3, max: DVec3) -> Self {
        let corner = |x: u8, y: u8, z: u8| {
            let pick = |bit: u8, low: f64, high: f64| if bit == 0 { low } else { high };
            DVec3::new(pick(x, min.x, max.x), pick(y, min.y, max.y), pick(z, min.z, max.z))
        };
        let mut out = Self { uvs: Some(Vec::new()), ..Self::default() };
        out.add_quad([corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)]); // front, +z
        out.add_quad([corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0)]); // back
        out.add_quad([corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1)]); // right, +x
        out.add_quad([corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)]); // left
        out.add_quad([corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0)]); // top, +y
        out.add_quad([corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)]); // bottom
        out
    }

    /// One triangle.
    pub fn triangle(corners: [DVec3; 3]) -> Self {
        Self { positions: corners.to_vec(), indices: vec![[0, 1, 2]], ..Self::default() }
    }

    /// A part of a mesh file, scaled. `smooth`: `None` takes the file's normals if it has any.
    pub fn part(part: &Part, scale: f64, smooth: Option<bool>) -> Self {
        let positions: Vec<DVec3> = part.positions.iter().map(|p| p.as_dvec3() * scale).collect();
        let from_file = || part.normals.as_ref().map(|all| all.iter().map(|n| n.as_dvec3()).collect());
        let normals = match smooth {
            Some(false) => None,
            Some(true) => from_file().or_else(|| Some(vertex_normals(&positions, &part.triangles))),
            None => from_file(),
        };
        Self { positions, indices: part.triangles.clone(), normals, uvs: part.uvs.clone() }
    }

    /// A profile (radius, height), counter-clockwise about its inside, turned about the y axis.
    ///
    /// Chords stay within `tolerance` of the surface. u runs once around, v along the profile.
    pub fn revolve(profile: &[Cubic], tolerance: f64) -> Self {
        let reach = profile.iter().flatten().fold(0.0_f64, |most, p| most.max(p.x));
        let around = segments_around(reach, tolerance);
        let mut out = Self { normals: Some(Vec::new()), uvs: Some(Vec::new()), ..Self::default() };
        for (i, piece) in profile.iter().enumerate() {
            let steps = curve::steps(piece, tolerance);
            let base = out.positions.len() as u32;
            for &t in &steps {
                let v = (i as f64 + t) / profile.len() as f64;
                out.add_ring(curve::point(piece, t), curve::tangent(piece, t), v, around);
            }
            out.join_rings(base, steps.len() as u32, around);
        }
        out
    }

    /// An outline with holes, in the xy plane, drawn out from z = 0 to `depth`.
    pub fn extrude(outline: &Outline, holes: &[Outline], depth: f64, tolerance: f64) -> Self {
        let outer = curve::outline(outline, tolerance);
        let holes: Vec<Vec<OutlinePoint>> =
            holes.iter().map(|hole| curve::outline(hole, tolerance)).collect();
        let flat = |points: &[OutlinePoint]| points.iter().map(|o| o.p).collect::<Vec<DVec2>>();
        let caps =
            triangulate_region(&flat(&outer), &holes.iter().map(|hole| flat(hole)).collect::<Vec<_>>());
        let all: Vec<DVec2> = std::iter::once(&outer).chain(&holes).flat_map(|points| flat(points)).collect();

        let mut out = Self { normals: Some(Vec::new()), uvs: Some(Vec::new()), ..Self::default() };
        out.add_cap(&all, &caps, depth);
        out.add_cap(&all, &caps.iter().map(|t| [t[0], t[2], t[1]]).collect::<Vec<_>>(), 0.0);
        out.add_wall(&outer, depth, 1.0);
        for hole in &holes {
            out.add_wall(hole, depth, -1.0);
        }
        out
    }

    fn add_quad(&mut self, corners: [DVec3; 4]) {
        let base = self.positions.len() as u32;
        self.positions.extend(corners);
        self.indices.extend([[base, base + 1, base + 2], [base, base + 2, base + 3]]);
        if let Some(uvs) = &mut self.uvs {
            uvs.extend([Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]);
        }
    }

    pub(super) fn add_vertex(&mut self, p: DVec3, normal: DVec3, uv: Vec2) {
        self.positions.push(p);
        self.normals.get_or_insert_default().push(normal);
        self.uvs.get_or_insert_default().push(uv);
    }

    /// One ring of vertices; its last lies on its first, so that u can end at 1.
    fn add_ring(&mut self, p: DVec2, travel: DVec2, v: f64, around: u32) {
        for j in 0..=around {
            // As on exact shapes, u = 1/2 faces +z and grows to the right seen from outside.
            let (sin, cos) = libm::sincos(TAU * (f64::from(j % around) / f64::from(around) - 0.5));
            let radius = p.x.max(0.0); // a fitted curve may end a rounding below the axis
            let position = DVec3::new(radius * sin, p.y, radius * cos);
            let normal = DVec3::new(travel.y * sin, -travel.x, travel.y * cos);
            let u = f64::from(j) / f64::from(around);
            self.add_vertex(position, normal, Vec2::new(u as f32, v as f32));
        }
    }

    pub(super) fn join_rings(&mut self, base: u32, rings: u32, around: u32) {
        let at = |ring: u32, j: u32| base + ring * (around + 1) + j;
        for ring in 0..rings - 1 {
            for j in 0..around {
                let (a, b) = (at(ring, j), at(ring + 1, j));
                let (c, d) = (at(ring + 1, j + 1), at(ring, j + 1));
                // On the axis a whole edge is one point, and one of the two triangles vanishes.
                let same = |x: u32, y: u32| self.positions[x as usize] == self.positions[y as usize];
                if !same(b, c) && !same(a, b) {
                    self.indices.push([a, c, b]);
                }
                if !same(a, d) && !same(d, c) {
                    self.indices.push([a, d, c]);
                }
            }
        }
    }

    fn add_cap(&mut self, points: &[DVec2], triangles: &[[u32; 3]], z: f64) {
        let base = self.positions.len() as u32;
        let normal = if z > 0.0 { DVec3::Z } else { DVec3::NEG_Z };
        for p in points {
            self.add_vertex(p.extend(z), normal, p.as_vec2());
        }
        self.indices.extend(triangles.iter().map(|t| t.map(|i| base + i)));
    }

    /// The side of an outline that runs counter-clockwise; `sign` −1 turns it inside out, for a hole.
    fn add_wall(&mut self, points: &[OutlinePoint], depth: f64, sign: f64) {
        let outwards = |travel: DVec2| DVec3::new(travel.y, -travel.x, 0.0) * sign;
        for (i, from) in points.iter().enumerate() {
            let to = &points[(i + 1) % points.len()];
            let base = self.positions.len() as u32;
            let u = |i: usize| i as f32 / points.len() as f32;
            for (o, travel, u) in [(from, from.leaving, u(i)), (to, to.arriving, u(i + 1))] {
                self.add_vertex(o.p.extend(0.0), outwards(travel), Vec2::new(u, 0.0));
                self.add_vertex(o.p.extend(depth), outwards(travel), Vec2::new(u, 1.0));
            }
            let (a, b, c, d) = (base, base + 2, base + 3, base + 1);
            self.indices.extend(if sign > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
    }
}

/// Whether a model's own materials are worth having: it names some.
pub fn has_materials(model: &Model) -> bool {
    model.parts.iter().any(|part| part.material.is_some())
}

/// Segments of a circle of this radius whose chords stay within `tolerance`: r (1 − cos π/n) ≤ tolerance.
pub(super) fn segments_around(radius: f64, tolerance: f64) -> u32 {
    let cos = (1.0 - tolerance / radius).max(0.5);
    (std::f64::consts::PI / libm::acos(cos)).ceil().clamp(8.0, 4096.0) as u32
}

/// Normals averaged over the triangles around each point in space, weighted by their angles there (Thürmer & Wüthrich 1998).
fn vertex_normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let key = |p: DVec3| p.to_array().map(|x| (x + 0.0).to_bits()); // −0 and 0 are one place
    let mut sums: rustc_hash::FxHashMap<[u64; 3], DVec3> = rustc_hash::FxHashMap::default();
    for triangle in triangles {
        let p = triangle.map(|i| positions[i as usize]);
        let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
        for i in 0..3 {
            let (a, b) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            let angle = libm::atan2(a.cross(b).length(), a.dot(b));
            *sums.entry(key(p[i])).or_default() += normal * angle;
        }
    }
    positions.iter().map(|&p| sums.get(&key(p)).copied().unwrap_or_default()).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::ir::{Curve, CurveKind};
    use crate::source::Span;
    use std::collections::BTreeMap;

    /// Every directed edge, by position, meets its reverse: the surface is closed and consistently oriented.
    pub fn assert_closed(t: &Triangles) {
        let key = |i: u32| t.positions[i as usize].to_array().map(|x| (x + 0.0).to_bits());
        let mut edges: BTreeMap<_, i32> = BTreeMap::new();
        for triangle in &t.indices {
            for i in 0..3 {
                let (a, b) = (key(triangle[i]), key(triangle[(i + 1) % 3]));
                *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
            }
        }
        assert!(edges.values().all(|&sum| sum == 0), "some edges are open");
    }

    pub fn volume(t: &Triangles) -> f64 {
        let corner = |i: u32| t.positions[i as usize];
        t.indices.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
    }

    /// Shading normals lie on the outer side of every triangle.
    fn assert_normals_outwards(t: &Triangles) {
        let normals = t.normals.as_ref().unwrap();
        for &[a, b, c] in &t.indices {
            let [p, q, r] = [a, b, c].map(|i| t.positions[i as usize]);
            let n = (q - p).cross(r - p);
            assert!([a, b, c].iter().all(|&i| normals[i as usize].dot(n) > 0.0), "{p} {q} {r}");
        }
    }

    #[test]
    fn a_box_is_closed_and_faces_outwards() {
        let cuboid = Triangles::cuboid(DVec3::new(-1.0, 0.0, 2.0), DVec3::new(1.0, 3.0, 4.0));
        assert_closed(&cuboid);
        assert!((volume(&cuboid) - 12.0).abs() < 1e-12);
    }

    #[test]
    fn a_revolved_half_circle_is_a_ball() {
        let k = 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
        let profile = [
            [(0.0, -1.0), (k, -1.0), (1.0, -k), (1.0, 0.0)].map(DVec2::from),
            [(1.0, 0.0), (1.0, k), (k, 1.0), (0.0, 1.0)].map(DVec2::from),
        ];
        let ball = Triangles::revolve(&profile, 1e-4);
        assert_closed(&ball);
        assert_normals_outwards(&ball);
        assert!((volume(&ball) - TAU * 2.0 / 3.0).abs() < 2e-3, "{}", volume(&ball));
    }

    #[test]
    fn an_extruded_frame_is_closed_and_faces_outwards() {
        let square = |r: f64| Curve {
            kind: CurveKind::Polyline,
            points: [(-r, -r), (r, -r), (r, r), (-r, r)].map(DVec2::from).to_vec(),
            span: Span::default(),
        };
        let frame = Triangles::extrude(&square(2.0), &[square(1.0)], 0.5, 1e-3);
        assert_closed(&frame);
        assert_normals_outwards(&frame);
        assert!((volume(&frame) - 6.0).abs() < 1e-12, "{}", volume(&frame));
    }
}
