//! Draws `boots.obj`: a pair of football boots.
//!
//! A boot is a field: a last of blended ellipsoids, hollowed out under a sloping collar; a sole plate with studs below;
//! on the instep laces that cross over a tongue, and the section of a lens on either side. The left boot is the
//! right one mirrored. Toes point to −x; a boot is 1 long and stands on the studs at y = 0.

mod common;

use std::io;

use common::field::{ellipsoid, smooth_cut, smooth_union, surface, taper};
use common::mesh::{Mesh, Normals};
use glam::{Affine3A, Vec3};

/// Edge of the meshing cells.
const CELL: f32 = 0.0125;

fn main() -> io::Result<()> {
    let (low, high) = (Vec3::new(-0.56, -0.02, -0.24), Vec3::new(0.56, 0.6, 0.24));
    let boot = surface(low, high, CELL, boot).weld(CELL / 12.0);
    let volume = boot.closed_volume().map_err(io::Error::other)?;
    println!("a boot: closed, volume {volume:.4}");

    // The right boot stands a little before the left one and turns its toe out.
    let turn = Affine3A::from_rotation_y(-0.12);
    let mirror = Affine3A::from_scale(Vec3::new(1.0, 1.0, -1.0));
    let mut pair = Mesh::default();
    pair.append(&boot, Affine3A::from_translation(Vec3::new(0.0, 0.0, 0.24)) * turn.inverse());
    pair.append(&boot, Affine3A::from_translation(Vec3::new(0.13, 0.0, -0.26)) * turn * mirror);
    pair.save("boots", "A pair of football boots, by examples/boots.rs", Normals::Absent, &[])
}

/// The whole boot, negative inside; the inner side of the foot is at −z.
fn boot(p: Vec3) -> f32 {
    let upper = smooth_union(collar(p), laces(p), 0.008);
    let bottom = smooth_union(sole(p), studs(p), 0.015);
    smooth_union(upper, bottom, 0.012)
}

/// The shape of the foot in the boot: toes, ball, waist, heel and ankle.
fn last(p: Vec3) -> f32 {
    let toe = ellipsoid(p, Vec3::new(-0.3, 0.145, 0.0), Vec3::new(0.195, 0.088, 0.13));
    let forefoot = ellipsoid(p, Vec3::new(-0.12, 0.165, 0.0), Vec3::new(0.27, 0.115, 0.14));
    let instep = taper(p, (Vec3::new(-0.13, 0.185, -0.01), 0.09), (Vec3::new(0.17, 0.33, 0.0), 0.1));
    let waist = ellipsoid(p, Vec3::new(0.1, 0.17, 0.0), Vec3::new(0.27, 0.1, 0.11));
    let heel = ellipsoid(p, Vec3::new(0.31, 0.18, 0.0), Vec3::new(0.145, 0.13, 0.105));
    let ankle = taper(p, (Vec3::new(0.3, 0.2, 0.0), 0.11), (Vec3::new(0.29, 0.46, 0.0), 0.11));
    let front = smooth_union(smooth_union(toe, forefoot, 0.1), instep, 0.14);
    let back = smooth_union(smooth_union(waist, heel, 0.08), ankle, 0.1);
    smooth_union(front, back, 0.1).max(0.085 - p.y)
}

/// The upper: the last with seams, cut off along the collar and hollowed out, with a padded edge.
fn collar(p: Vec3) -> f32 {
    let foot = last(p);

    // The section of a lens is raised on either side; a seam runs around the toe cap.
    let lens = ((p.x - 0.07) / 0.055).hypot((p.y - 0.215 - 0.25 * (p.x - 0.07)) / 0.085);
    let band = -0.012 * (1.0 - ((lens - 0.85).abs() * 7.0).powi(2)).max(0.0);
    let seam = 0.008 * (-((p.x + 0.285 + 0.5 * p.z * p.z / 0.1) / 0.009).powi(2)).exp();

    // The opening dips at the sides and rises at the heel.
    let level = 0.385 + 0.35 * (p.x - 0.28).powi(2) + 0.12 * (p.x - 0.28);
    let solid = smooth_cut(foot + band + seam, level - p.y, 0.015).max(p.y - level);
    let hollow = (foot + 0.028).max(0.13 - p.y);
    let shell = smooth_cut(solid, hollow, 0.012);
    let rim = (foot + 0.012).abs().hypot(p.y - level) - 0.02;
    smooth_union(shell, rim, 0.015)
}

/// Five laces over the instep and a bow's two ends: short bars that follow the surface of the last.
fn laces(p: Vec3) -> f32 {
    let skin = last(p).abs();
    let bar = |i: usize| {
        let t = i as f32 / 4.0;
        let middle = Vec3::new(-0.145 + 0.225 * t, 0.0, 0.0);
        let slant = if i.is_multiple_of(2) { 0.22 } else { -0.22 };
        let across = p.x + 0.12 * (p.y - 0.3) - middle.x - slant * p.z;
        let bar = across.hypot(skin) - 0.0135;
        bar.max(p.z.abs() - 0.075 + 0.01 * t).max(0.2 - p.y)
    };
    (0..5).map(bar).fold(f32::INFINITY, f32::min)
}

/// The outline of the foot as a plate that curves up at the toe.
fn sole(p: Vec3) -> f32 {
    let lift = 0.06 * ((-p.x - 0.2).max(0.0) / 0.3).powi(2);
    let fore = ellipsoid(p.with_y(0.0), Vec3::new(-0.21, 0.0, 0.0), Vec3::new(0.295, 1.0, 0.145));
    let rear = ellipsoid(p.with_y(0.0), Vec3::new(0.27, 0.0, 0.0), Vec3::new(0.19, 1.0, 0.11));
    let outline = smooth_union(fore, rear, 0.22);
    smooth_cut(outline, 0.03 - (p.y - 0.093 - lift).abs(), 0.02)
}

/// Conical studs: six under the ball of the foot, four under the heel.
fn studs(p: Vec3) -> f32 {
    let places = [
        (-0.36, 0.07),
        (-0.36, -0.07),
        (-0.23, 0.105),
        (-0.23, -0.105),
        (-0.09, 0.09),
        (-0.09, -0.09),
        (0.21, 0.07),
        (0.21, -0.07),
        (0.36, 0.055),
        (0.36, -0.055),
    ];
    let stud = |&(x, z): &(f32, f32)| {
        let cone = taper(p, (Vec3::new(x, 0.1, z), 0.04), (Vec3::new(x, 0.0, z), 0.021));
        cone.max(-p.y)
    };
    places.iter().map(stud).fold(f32::INFINITY, f32::min)
}
