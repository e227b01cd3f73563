//! Draws `football.obj` and `football.mtl`: twelve black pentagons and twenty white hexagons, sewn into a ball.
//!
//! The panels are the faces of a truncated icosahedron, blown up to the unit sphere. Each is a fan of triangles from
//! its middle, cut into rings that lie closer together near the seam, where the surface dips into a groove.

mod common;

use std::collections::HashMap;
use std::io;

use common::mesh::{Mesh, Normals, Paint};
use glam::Vec3;

/// Rings in each panel.
const RINGS: usize = 8;

/// Depth of the groove along the seams and half its width, for a ball of radius 1.
const GROOVE: (f32, f32) = (0.035, 0.028);

const WHITE: usize = 0;
const BLACK: usize = 1;
const PAINTS: [Paint; 2] = [
    Paint { name: "white", diffuse: 0.8, specular: 0.04, shininess: 60.0 },
    Paint { name: "black", diffuse: 0.025, specular: 0.05, shininess: 60.0 },
];

fn main() -> io::Result<()> {
    let mut ball = Ball::default();
    for panel in panels() {
        ball.sew(&panel);
    }
    let volume = ball.mesh.manifold_volume().map_err(io::Error::other)?;
    println!("a manifold, volume {volume:.4} of {:.4}", std::f32::consts::PI * 4.0 / 3.0);
    ball.mesh.save("football", "A football, by examples/football.rs", Normals::Crease(1.0), &PAINTS)
}

/// The corners of each panel, counter-clockwise seen from outside: the truncated icosahedron.
fn panels() -> Vec<Vec<Vec3>> {
    let tips = icosahedron();
    let touching = |a: Vec3, b: Vec3| a != b && a.distance(b) < 2.1;
    let third = |a: Vec3, b: Vec3| a.lerp(b, 1.0 / 3.0);

    // Cutting a tip off leaves a pentagon, a third of the way along the five edges that leave it.
    let mut panels: Vec<Vec<Vec3>> = Vec::new();
    for &tip in &tips {
        let near = tips.iter().filter(|&&other| touching(tip, other));
        panels.push(around(tip, near.map(|&other| third(tip, other)).collect()));
    }

    // Of a triangle between three tips that touch, the cuts leave a hexagon.
    for (i, &a) in tips.iter().enumerate() {
        for (j, &b) in tips.iter().enumerate().skip(i + 1) {
            for &c in tips.iter().skip(j + 1).filter(|&&c| touching(a, b) && touching(b, c) && touching(c, a))
            {
                let corners =
                    [(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)].map(|(from, to)| third(from, to));
                panels.push(around(a + b + c, corners.to_vec()));
            }
        }
    }
    panels
}

/// The twelve tips of an icosahedron whose edges are 2 long.
fn icosahedron() -> Vec<Vec3> {
    let golden = (1.0 + 5f32.sqrt()) / 2.0;
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let rectangle = |(s, t): (f32, f32)| {
        let (one, long) = (s, t * golden);
        [Vec3::new(0.0, one, long), Vec3::new(one, long, 0.0), Vec3::new(long, 0.0, one)]
    };
    signs.into_iter().flat_map(rectangle).collect()
}

/// Sorts corners counter-clockwise around an axis that points outwards.
fn around(axis: Vec3, mut corners: Vec<Vec3>) -> Vec<Vec3> {
    let side = axis.any_orthogonal_vector().normalize();
    let up = axis.normalize().cross(side);
    let angle = |p: &Vec3| p.dot(up).atan2(p.dot(side));
    corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    corners
}

/// The ball so far, with its vertices by rounded position: panels share those on their seam.
#[derive(Default)]
struct Ball {
    mesh: Mesh,
    known: HashMap<[i32; 3], u32>,
}

impl Ball {
    fn sew(&mut self, panel: &[Vec3]) {
        let paint = if panel.len() == 5 { BLACK } else { WHITE };
        let middle = panel.iter().sum::<Vec3>() / panel.len() as f32;
        for (&a, &b) in panel.iter().zip(panel.iter().cycle().skip(1)) {
            self.sector(middle, a, b, paint);
        }
    }

    /// One triangle of the fan, between the middle of the panel and its edge from `a` to `b`.
    fn sector(&mut self, middle: Vec3, a: Vec3, b: Vec3, paint: usize) {
        let scale = a.length();
        let apothem = middle.distance((a + b) / 2.0) / scale;
        let rings: Vec<Vec<u32>> = (0..=RINGS)
            .map(|ring| {
                let gap = (1.0 - ring as f32 / RINGS as f32).powi(2); // to the seam, from 1 to 0
                let dip = GROOVE.0 * (-(gap * apothem / GROOVE.1).powi(2)).exp();
                let (from, to) = (middle.lerp(a, 1.0 - gap), middle.lerp(b, 1.0 - gap));
                let point = |i: usize| from.lerp(to, i as f32 / ring.max(1) as f32).normalize() * (1.0 - dip);
                (0..=ring).map(|i| self.vertex(point(i))).collect()
            })
            .collect();
        for pair in rings.windows(2) {
            let (inner, outer) = (&pair[0], &pair[1]);
            for i in 0..inner.len() {
                self.mesh.painted_face(&[inner[i], outer[i], outer[i + 1]], paint);
            }
            for i in 1..inner.len() {
                self.mesh.painted_face(&[inner[i - 1], outer[i], inner[i]], paint);
            }
        }
    }

    fn vertex(&mut self, p: Vec3) -> u32 {
        let key = (p * 10_000.0).round().to_array().map(|x| x as i32);
        let mesh = &mut self.mesh;
        *self.known.entry(key).or_insert_with(|| mesh.vertex(p))
    }
}
