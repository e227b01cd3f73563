//! Makes the meshes of the scenes in `scenes/bench`: a blob of a million triangles for S3, a wine glass for S4.
//!
//!     cargo run --release --example bench_meshes
//!
//! `goblet.obj` is kept with the scenes; `blob1m.obj`, 40 MB of text, is not, and S3 does without it where it is missing.
//! Both are faceted, so that all renderers see the same normals.

use std::f64::consts::{FRAC_PI_4, TAU};
use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

/// Squares along an edge of the cube that the blob is blown up from: 6 · 2 · 289² = 1,002,252 triangles.
const BLOB_SQUARES: u32 = 289;
/// How far the blob's waves reach, as a share of its radius.
const BLOB_WAVES: f64 = 0.18;
/// It is lifted until it stands on the floor.
const BLOB_LIFT: f32 = 1.02;

/// Pieces between two points of the glass's profile, and facets around it.
const GOBLET_PIECES: u32 = 8;
const GOBLET_FACETS: u32 = 256;
/// The profile of the glass, radius and height, up the outside and down the inside.
const GOBLET: [[f64; 2]; 24] = [
    [0.0, 0.005],
    [0.25, 0.005],
    [0.44, 0.006],
    [0.47, 0.022],
    [0.44, 0.04],
    [0.25, 0.06],
    [0.10, 0.09],
    [0.05, 0.16],
    [0.045, 0.38],
    [0.05, 0.60],
    [0.09, 0.70],
    [0.25, 0.78],
    [0.42, 0.95],
    [0.50, 1.20],
    [0.48, 1.50],
    [0.44, 1.70],
    [0.43, 1.715],
    [0.42, 1.70],
    [0.455, 1.50],
    [0.475, 1.20],
    [0.395, 0.97],
    [0.235, 0.83],
    [0.08, 0.775],
    [0.0, 0.77],
];

fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/bench");
    goblet().save(&folder.join("goblet.obj"), "A wine glass, closed, its facets flat.")?;
    blob().save(&folder.join("blob1m.obj"), "A sphere displaced by waves of five lengths.")
}

/// Vertices in single precision, as every renderer takes them, and triangles, counter-clockwise seen from outside.
#[derive(Default)]
struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Turns the triangles round if they look inwards.
    fn outward(mut self) -> Self {
        let at = |i: u32| glam::Vec3::from(self.positions[i as usize]).as_dvec3();
        let volume = |t: &[u32; 3]| at(t[0]).dot(at(t[1]).cross(at(t[2])));
        if self.triangles.iter().map(volume).sum::<f64>() < 0.0 {
            self.triangles.iter_mut().for_each(|t| t.reverse());
        }
        self
    }

    /// Writes OBJ text; each coordinate with the fewest digits that give it back.
    fn save(&self, path: &Path, title: &str) -> io::Result<()> {
        let mut text = format!("# {title} Made by examples/bench_meshes.rs\n");
        for [x, y, z] in &self.positions {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for t in &self.triangles {
            let [a, b, c] = t.map(|vertex| vertex + 1);
            let _ = writeln!(text, "f {a} {b} {c}");
        }
        fs::write(path, &text)?;
        println!("{}: {} triangles, {} kB", path.display(), self.triangles.len(), text.len() / 1000);
        Ok(())
    }
}

/// A cube, its faces cut into squares of equal angle, blown up to a sphere and displaced along the radius.
fn blob() -> Mesh {
    let side = BLOB_SQUARES + 1;
    let step = |i: u32| (FRAC_PI_4 * (2.0 * f64::from(i) / f64::from(BLOB_SQUARES) - 1.0)).tan();
    let faces: [fn(f64, f64) -> [f64; 3]; 6] = [
        |a, b| [1.0, a, b],
        |a, b| [-1.0, b, a],
        |a, b| [b, 1.0, a],
        |a, b| [a, -1.0, b],
        |a, b| [a, b, 1.0],
        |a, b| [b, a, -1.0],
    ];
    let mut mesh = Mesh::default();
    for face in faces {
        let base = mesh.positions.len() as u32;
        for i in 0..side {
            mesh.positions.extend((0..side).map(|j| displaced(face(step(i), step(j)))));
        }
        let corners: Vec<u32> =
            (0..BLOB_SQUARES).flat_map(|i| (0..BLOB_SQUARES).map(move |j| base + i * side + j)).collect();
        mesh.triangles.extend(corners.iter().map(|q| [*q, q + side, q + side + 1]));
        mesh.triangles.extend(corners.iter().map(|q| [*q, q + side + 1, q + 1]));
    }
    mesh.outward()
}

fn displaced(p: [f64; 3]) -> [f32; 3] {
    let [x, y, z] = glam::DVec3::from(p).normalize().to_array();
    let s = f64::sin;
    let waves = 0.50 * s(5.0 * x + 1.0) * s(6.0 * y + 0.5) * s(4.0 * z + 2.0)
        + 0.25 * s(13.0 * x + 3.0 * z) * s(11.0 * y + 1.7)
        + 0.15 * s(29.0 * x + 7.0 * y + 0.3) * s(31.0 * z - 5.0 * y)
        + 0.06 * s(71.0 * x + 13.0 * z) * s(67.0 * y + 2.2) * s(73.0 * z)
        + 0.02 * s(211.0 * x) * s(199.0 * y) * s(223.0 * z);
    let r = 1.0 + BLOB_WAVES * waves;
    let [x, y, z] = [x * r, y * r, z * r].map(|coordinate| coordinate as f32);
    [x, y + BLOB_LIFT, z]
}

/// The profile, smooth through its points (Catmull & Rom 1974), turned about the y axis.
fn goblet() -> Mesh {
    let profile = profile();
    let mut mesh = Mesh::default();
    mesh.positions.push([0.0, profile[0][1] as f32, 0.0]);
    for &[r, y] in &profile[1..profile.len() - 1] {
        mesh.positions.extend((0..GOBLET_FACETS).map(|j| {
            let angle = TAU * f64::from(j) / f64::from(GOBLET_FACETS);
            [(r * angle.cos()) as f32, y as f32, (r * angle.sin()) as f32]
        }));
    }
    let last = mesh.positions.len() as u32;
    mesh.positions.push([0.0, profile[profile.len() - 1][1] as f32, 0.0]);

    // A fan at either pole, two triangles a facet between.
    let next = |j: u32| (j + 1) % GOBLET_FACETS;
    let facets = || 0..GOBLET_FACETS;
    mesh.triangles.extend(facets().map(|j| [0, 1 + j, 1 + next(j)]));
    for a in (1..last - GOBLET_FACETS).step_by(GOBLET_FACETS as usize) {
        let b = a + GOBLET_FACETS;
        mesh.triangles.extend(facets().map(|j| [a + j, b + j, b + next(j)]));
        mesh.triangles.extend(facets().map(|j| [a + j, b + next(j), a + next(j)]));
    }
    let a = last - GOBLET_FACETS;
    mesh.triangles.extend(facets().map(|j| [a + j, last, a + next(j)]));
    mesh.outward()
}

/// Points of the glass's profile; its ends lie on the axis, and no radius is negative.
fn profile() -> Vec<[f64; 2]> {
    let n = GOBLET.len();
    let mut points = Vec::new();
    for k in 0..n - 1 {
        let [p0, p1, p2, p3] = [k.saturating_sub(1), k, k + 1, (k + 2).min(n - 1)].map(|i| GOBLET[i]);
        for piece in 0..GOBLET_PIECES {
            let t = f64::from(piece) / f64::from(GOBLET_PIECES);
            points.push([0, 1].map(|axis| {
                let (a, b, c, d) = (p0[axis], p1[axis], p2[axis], p3[axis]);
                0.5 * (2.0 * b
                    + (c - a) * t
                    + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t
                    + (3.0 * b - a - 3.0 * c + d) * t * t * t)
            }));
        }
    }
    points.push(GOBLET[n - 1]);
    points.iter_mut().for_each(|point| point[0] = point[0].max(0.0));
    points
}
