//! Renders that lack remedies, for `benches/hard_cases`, which shows what each one costs. Only the feature `naive` has them.

use std::sync::atomic::{AtomicU8, Ordering};

/// What can be left out of a render.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum Remedy {
    /// Boxes wider than they are by what rounding may do (Ize 2013); without, a fused multiply-add a face.
    Boxes = 1,
    /// The watertight test of triangles (Woop, Benthin, Wald 2013); without, that of Möller and Trumbore (1997).
    Triangles = 2,
    /// Rays leave surfaces by error bounds (Pharr, Jakob, Humphreys 2023); without, by 10⁻⁴.
    Origins = 4,
    /// Spheres in double precision; without, b² − 4ac in single.
    Spheres = 8,
}

impl Remedy {
    /// All that can be left out.
    pub const ALL: [Self; 4] = [Self::Boxes, Self::Triangles, Self::Origins, Self::Spheres];
}

static LEFT_OUT: AtomicU8 = AtomicU8::new(0);

/// From now on, all threads do without these, and have all others.
pub fn leave_out(remedies: &[Remedy]) {
    LEFT_OUT.store(remedies.iter().fold(0, |all, remedy| all | *remedy as u8), Ordering::Relaxed);
}

/// Whether a remedy is left out.
#[inline(always)]
pub fn lacks(remedy: Remedy) -> bool {
    LEFT_OUT.load(Ordering::Relaxed) & remedy as u8 != 0
}

/// Where a ray that lacks error bounds starts, in lengths of its direction: metres, or shares of a shadow segment.
pub const FIXED_OFFSET: f32 = 1e-4;
