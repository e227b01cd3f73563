//! Means over cells of space: what neighbouring paths of one pass found out, for all of them to use.
//!
//! Path space filtering (Keller, Dahm & Binder 2014), with cells found by hashing (Binder, Fricke & Keller 2018). A cell holds
//! points that lie close to each other on surfaces that face alike.

use crate::math::{Rgb, Vec3};
use rustc_hash::FxHashMap;

/// A cell is a fourth as thick as wide, so that it holds one of two surfaces above each other.
const THINNESS: f32 = 4.0;

/// How space is divided: into cells that are the wider the farther from the eye.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Grid {
    /// In metres.
    pub eye: Vec3,
    /// The width of a cell for each metre from the eye, at most; at least the half of it.
    pub angle: f32,
    /// Where cells begin, in widths of a cell.
    pub offset: Vec3,
    /// By what all cells are smaller, in (0, 1].
    pub shrunk: f32,
}

/// Which cell.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct CellId {
    side: u32,
    cell: [i32; 3],
    facing: [i8; 3],
    layer: i32,
    class: u32,
}

impl Grid {
    /// The width of the cells at `p`, in metres: a power of two, times what all have shrunk by.
    pub fn side(&self, p: Vec3) -> f32 {
        let side = self.angle * p.distance(self.eye);
        f32::from_bits(side.to_bits() & 0xff80_0000) * self.shrunk
    }

    /// The cell that holds a point of a surface with unit normal `n`; those of another `class` are apart.
    pub fn cell(&self, p: Vec3, n: Vec3, class: u32) -> CellId {
        let side = self.side(p);
        let at = p / side + self.offset;
        let facing = (n * 2.0).round();
        let layer = at.dot(facing.normalize_or_zero()) * THINNESS;
        CellId {
            side: side.to_bits(),
            cell: at.floor().to_array().map(|x| x as i32),
            facing: facing.to_array().map(|x| x as i8),
            layer: layer.floor() as i32,
            class,
        }
    }
}

/// The mean of what was found in each cell.
#[derive(Default)]
pub struct Cells {
    sums: FxHashMap<CellId, (Rgb, u32)>,
}

impl Cells {
    /// A cell must hold so many values to tell a mean.
    const LEAST: u32 = 4;

    /// Gathers values; their order decides on the last bits.
    pub fn new(values: impl Iterator<Item = (CellId, Rgb)>) -> Self {
        let mut sums = FxHashMap::default();
        for (cell, value) in values {
            let (sum, count) = sums.entry(cell).or_insert((Rgb::BLACK, 0));
            *sum += value;
            *count += 1;
        }
        Self { sums }
    }

    /// The mean of a cell; `None` if it holds too few values.
    pub fn mean(&self, cell: &CellId) -> Option<Rgb> {
        let &(sum, count) = self.sums.get(cell)?;
        (count >= Self::LEAST).then(|| sum / count as f32)
    }
}
