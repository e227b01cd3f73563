//! Draws `crest.obj`: a shield of openwork glass that tells Snell's law.
//!
//! Under a star, three parallel rays fall on a lens and meet in its focus. The solid lies between two height fields,
//! `z = ±h(x, y)`: each part of the drawing is a shape in the plane with a bevel of its own, and the highest part wins.
//!
//! The plane is cut into square cells with one vertex each. A vertex goes where the facets around it meet, or onto the
//! outline (Ju et al. 2002, in the plane), so bevels, ridges and rims come out as clean lines. The program ends with a
//! proof that the mesh is closed.

mod common;

use std::f32::consts::TAU;
use std::io;

use common::curve::bezier_chain;
use common::field::{polygon, segment};
use common::mesh::{Mesh, Normals};
use glam::{Mat3, Vec2, Vec3};

/// Edge of a cell; the shield is 1 wide and 1.2 high, its tip at the origin.
const CELL: f32 = 1.0 / 96.0;

/// Half the thickness of the glass along every outline.
const EDGE: f32 = 0.03;

/// The middle of the star.
const STAR: Vec2 = Vec2::new(0.0, 0.965);

/// Where the rays meet.
const FOCUS: Vec2 = Vec2::new(0.0, 0.175);

fn main() -> io::Result<()> {
    let mesh = solid(&Drawing::new());
    let volume = mesh.manifold_volume().map_err(io::Error::other)?;
    println!("a manifold, volume {volume:.4}");
    mesh.save("crest", "Snell's crest, by examples/crest.rs", Normals::Crease(0.5), &[])
}

/// The shapes of the crest.
struct Drawing {
    shield: Vec<Vec2>,
    star: Vec<Vec2>,
}

impl Drawing {
    fn new() -> Self {
        let right = [
            [0.0, 1.2],
            [0.17, 1.2],
            [0.34, 1.175],
            [0.455, 1.115], // the top right corner
            [0.5, 0.93],
            [0.53, 0.76],
            [0.49, 0.58], // where the side begins to close
            [0.44, 0.34],
            [0.24, 0.13],
            [0.0, 0.0],
        ];
        let half: Vec<Vec2> = bezier_chain(&right, 16).into_iter().map(Vec2::from_array).collect();
        let mirrored = half[1..half.len() - 1].iter().rev().map(|p| Vec2::new(-p.x, p.y));
        let shield = half.iter().copied().chain(mirrored).collect();

        let tip = |i: usize| {
            let radius = if i.is_multiple_of(2) { 0.15 } else { 0.062 };
            STAR + Vec2::from_angle((0.25 + 0.1 * i as f32) * TAU) * radius
        };
        Self { shield, star: (0..10).map(tip).collect() }
    }

    /// Half the thickness of the glass at a point, or something negative where there is none.
    fn height(&self, p: Vec2) -> f32 {
        let shield = polygon(p, &self.shield);
        let frame = shield.max(-shield - 0.085);
        let chief = shield.max(0.775 - p.y);
        let mullion = shield.max((p.y - 0.79).abs() - 0.035);
        let lens = shield.max(lens(p));
        let focus = p.distance(FOCUS) - 0.058;

        [
            bevel(frame, 0.03, 0.105),
            if chief < -0.06 { sunburst(p) } else { -1.0 },
            bevel(mullion, 0.03, 0.085),
            facet(polygon(p, &self.star), 0.085, 1.1),
            dome(lens, 0.115, 0.13),
            facet(rays(p), EDGE, 1.9),
            dome(focus, 0.058, 0.1),
        ]
        .into_iter()
        .fold(-1.0, f32::max)
    }

    /// Signed distance, near the outline, from the drawing as a whole; negative in the glass.
    fn distance(&self, p: Vec2) -> f32 {
        let shield = polygon(p, &self.shield);
        let frame = shield.max(-shield - 0.085);
        let chief = shield.max(0.755 - p.y);
        let lens = shield.max(lens(p));
        let focus = p.distance(FOCUS) - 0.058;
        [chief, lens, rays(p), focus].into_iter().fold(frame, f32::min)
    }
}

/// Signed distance from the section of a biconvex lens: what two large disks have in common.
fn lens(p: Vec2) -> f32 {
    let (middle, radius, offset) = (Vec2::new(0.0, 0.5), 0.95, 0.835);
    let disk = |side: f32| p.distance(middle + Vec2::Y * side * offset) - radius;
    disk(1.0).max(disk(-1.0))
}

/// Signed distance from the rays: parallel down to the lens, then bent towards the focus.
fn rays(p: Vec2) -> f32 {
    let bent = |x: f32| {
        let (top, knee) = (Vec2::new(x, 0.8), Vec2::new(x, 0.5));
        segment(p, top, knee).min(segment(p, knee, FOCUS))
    };
    [-0.21, 0.0, 0.21].into_iter().map(bent).fold(f32::INFINITY, f32::min) - 0.033
}

/// The pleated ground of the chief: forty flat facets that fan out from behind the star, deeper towards the rim.
fn sunburst(p: Vec2) -> f32 {
    let turn = (p - STAR).to_angle() / TAU * 20.0;
    let zigzag = (turn - turn.floor() - 0.5).abs() * 2.0;
    0.034 + 0.1 * p.distance(STAR) * (1.0 - zigzag)
}

/// A flat top of height `top` behind a straight bevel of the given width; `d` is the distance from the outline.
fn bevel(d: f32, width: f32, top: f32) -> f32 {
    if d < 0.0 { EDGE + (top - EDGE) * (-d / width).min(1.0) } else { -1.0 }
}

/// A roof that rises from `foot` at the outline with the given slope up to its ridges.
fn facet(d: f32, foot: f32, slope: f32) -> f32 {
    if d < 0.0 { foot - d * slope } else { -1.0 }
}

/// A round back that rises over `width` up to the height `top`.
fn dome(d: f32, width: f32, top: f32) -> f32 {
    let s = (1.0 + d / width).clamp(0.0, 1.0);
    if d < 0.0 { EDGE + (top - EDGE) * (1.0 - s * s).sqrt() } else { -1.0 }
}

/// The closed solid: a front, its mirror image as a back, and a wall along every outline.
fn solid(drawing: &Drawing) -> Mesh {
    let front = front(drawing);
    let mut mesh = Mesh::default();
    let back = front.positions.len() as u32;
    mesh.positions.extend(&front.positions);
    mesh.positions.extend(front.positions.iter().map(|p| p.with_z(-p.z)));

    let mut open = std::collections::BTreeSet::new();
    for face in &front.faces {
        mesh.face(&face.corners);
        let mirrored: Vec<u32> = face.corners.iter().rev().map(|c| c + back).collect();
        mesh.face(&mirrored);
        for (&a, &b) in face.corners.iter().zip(face.corners.iter().cycle().skip(1)) {
            if !open.remove(&(b, a)) {
                open.insert((a, b));
            }
        }
    }
    for (a, b) in open {
        mesh.face(&[b, a, a + back, b + back]);
    }
    mesh
}

/// The front of the glass: a vertex for each cell that holds some glass, a quad for each grid point in the glass.
fn front(drawing: &Drawing) -> Mesh {
    let (columns, rows) = ((1.1 / CELL) as usize, (1.3 / CELL) as usize);
    let corner =
        |x: usize, y: usize| Vec2::new((x as f32 + 0.5) * CELL - 0.55, (y as f32 + 0.5) * CELL - 0.05);
    let grid = |x: usize, y: usize| drawing.distance(corner(x, y)) < 0.0;
    let mut inside: Vec<Vec<bool>> =
        (0..=rows).map(|y| (0..=columns).map(|x| grid(x, y)).collect()).collect();
    join_diagonals(&mut inside);

    let mut mesh = Mesh::default();
    let mut vertex = vec![vec![u32::MAX; columns]; rows];
    for y in 0..rows {
        for x in 0..columns {
            let full = [inside[y][x], inside[y][x + 1], inside[y + 1][x], inside[y + 1][x + 1]];
            let center = (corner(x, y) + corner(x + 1, y + 1)) / 2.0;
            if full == [true; 4] {
                let p = ridge_point(drawing, center);
                vertex[y][x] = mesh.vertex(p.extend(drawing.height(p).max(EDGE)));
            } else if full.contains(&true) {
                vertex[y][x] = mesh.vertex(outline_point(drawing, center).extend(EDGE));
            }
        }
    }
    for y in 1..rows {
        for x in 1..columns {
            if inside[y][x] {
                mesh.face(&[vertex[y - 1][x - 1], vertex[y - 1][x], vertex[y][x], vertex[y][x - 1]]);
            }
        }
    }
    mesh
}

/// Fills a corner of each cell in which glass meets glass across the diagonal only: one vertex cannot stand for two
/// outlines.
fn join_diagonals(inside: &mut [Vec<bool>]) {
    for y in 1..inside.len() {
        for x in 1..inside[y].len() {
            let [a, b, c, d] = [inside[y - 1][x - 1], inside[y - 1][x], inside[y][x - 1], inside[y][x]];
            if a == d && b == c && a != b {
                inside[y][x] = true;
                inside[y][x - 1] = true;
            }
        }
    }
}

/// The point of a cell on the outline that is nearest to its middle.
fn outline_point(drawing: &Drawing, center: Vec2) -> Vec2 {
    let h = CELL * 0.05;
    let mut p = center;
    for _ in 0..4 {
        let slope =
            |axis: Vec2| (drawing.distance(p + axis * h) - drawing.distance(p - axis * h)) / (2.0 * h);
        let gradient = Vec2::new(slope(Vec2::X), slope(Vec2::Y));
        p -= gradient * (drawing.distance(p) / gradient.length_squared().max(0.25));
        p = p.clamp(center - CELL * 0.5, center + CELL * 0.5);
    }
    p
}

/// Where the facets of a cell meet: the point with the least squared distance from the tangent planes at four places
/// of the cell. A weak pull to the middle settles it where the facets are one plane.
fn ridge_point(drawing: &Drawing, center: Vec2) -> Vec2 {
    const PULL: f32 = 0.02;
    let h = CELL * 0.02;
    let mut matrix = Mat3::from_diagonal(Vec3::new(PULL, PULL, 0.0));
    let mut right = Vec3::ZERO;
    for (dx, dy) in [(-0.42, -0.42), (0.42, -0.42), (-0.42, 0.42), (0.42, 0.42)] {
        let offset = Vec2::new(dx, dy) * CELL;
        let at = |d: Vec2| drawing.height(center + offset + d).max(EDGE);
        let slope = |axis: Vec2| (at(axis * h) - at(-axis * h)) / (2.0 * h);
        let normal = Vec3::new(-slope(Vec2::X), -slope(Vec2::Y), 1.0).normalize();
        matrix += Mat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
        right += normal * normal.dot(offset.extend(at(Vec2::ZERO)));
    }
    let found = (matrix.inverse() * right).truncate();
    center + found.clamp(Vec2::splat(-CELL * 0.5), Vec2::splat(CELL * 0.5))
}
