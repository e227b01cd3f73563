//! Paints `wood.jpg`: the top of a walnut table, five boards wide, 90 cm by 60 cm.
//!
//! A board is a slice through a tree: the rings are nested cylinders about an axis that lies a little askew under the
//! board, bent by noise. Streaks drawn out along the grain, pores, and a narrow gap between boards do the rest.

mod common;

use std::io;

use common::noise::{fractal, hash, perlin, ramp};
use common::paint::{save, srgb};
use common::smoothstep;
use glam::{Vec2, Vec3};

/// The picture in pixels, and its scale.
const SIZE: (u32, u32) = (1350, 900);
const PIXELS_PER_CM: f32 = 15.0;

/// Width of a board in centimetres.
const BOARD: f32 = 12.0;

fn main() -> io::Result<()> {
    save("wood.jpg", SIZE, 2, |pixel| walnut(pixel / PIXELS_PER_CM))
}

/// The colour of the table at a point, in centimetres.
fn walnut(at: Vec2) -> Vec3 {
    let board = (at.y / BOARD).floor();
    let random = |salt: i32| hash(board as i32, salt, 5);
    let seed = 100 + 10 * board as u32;

    // Depth of the tree's axis under the board, and where it runs: the flatter the cut, the wider the cathedrals.
    let along = at.x + 300.0 * random(0);
    let across = at.y - (board + 0.2 + 0.6 * random(1)) * BOARD + 0.03 * (random(2) - 0.5) * at.x;
    let depth = 1.2 + 3.0 * random(3) + 0.028 * at.x;
    let wave = 1.5 * fractal(Vec2::new(along * 0.035, across * 0.16), 4, seed);
    let radius = across.hypot(depth) + wave;
    let ring =
        (radius * 1.15 + 0.12 * fractal(Vec2::new(along * 0.2, across * 3.0), 3, seed + 1)).rem_euclid(1.0);

    // Late wood darkens slowly towards the edge of a ring and ends at once.
    let late = smoothstep(0.1, 0.93, ring) * (1.0 - smoothstep(0.93, 1.0, ring));
    let streak = fractal(Vec2::new(along * 0.12, at.y * 5.0), 5, seed + 2);
    let tone = 0.5 - 0.34 * late + 0.32 * streak + 0.22 * (random(4) - 0.5);
    let stops = [(0.0, srgb(0x2a160d)), (0.3, srgb(0x4a2a18)), (0.6, srgb(0x7a4a2b)), (1.0, srgb(0xa9713f))];
    let wood = ramp(&stops, tone);

    // Pores: short dark dashes along the grain, thickest in early wood.
    let pore = perlin(Vec2::new(along * 0.9, at.y * 16.0), seed + 3);
    let pores = 1.0 - 0.45 * smoothstep(0.38, 0.7, pore) * (1.0 - 0.6 * late);
    let gap = ((at.y / BOARD - board - 0.5).abs() - 0.5).abs() * BOARD;
    wood * pores * (0.12 + 0.88 * smoothstep(0.015, 0.09, gap))
}
