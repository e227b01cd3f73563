//! The chessboard, on a surface or cut from a block.

use super::Detail;
use crate::math::{Vec2, Vec3};
use crate::render::geometry::SurfacePoint;

/// What the cells of a checker are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum CheckerKind {
    /// So many cells along each side of the unit square of texture space.
    Cells(Vec2),
    /// Cubes of this edge length in metres, in object space.
    Solid(f32),
}

impl CheckerKind {
    /// Whether the point lies in a cell of the first colour.
    pub(super) fn is_even(self, surface: &SurfacePoint) -> bool {
        match self {
            Self::Cells(cells) => is_even((surface.uv * cells).extend(0.5)),
            Self::Solid(edge) => is_even(surface.p_object / edge),
        }
    }
}

impl CheckerKind {
    /// The size of what is finest in it.
    pub(super) fn detail(self) -> Detail {
        match self {
            Self::Cells(cells) => Detail::of_uv(Vec2::splat(0.1) / cells),
            Self::Solid(edge) => Detail::of_space(0.1 * edge),
        }
    }
}

/// Whether the cell of unit edge around `p` is an even number of steps from the one at the origin.
fn is_even(p: Vec3) -> bool {
    let cell = p.floor();
    (cell.x + cell.y + cell.z).rem_euclid(2.0) < 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_cells_differ_also_across_zero() {
        assert!(is_even(Vec3::new(0.5, 0.5, 0.5)));
        assert!(!is_even(Vec3::new(-0.5, 0.5, 0.5)));
        assert!(is_even(Vec3::new(-0.5, -0.5, 0.5)));
        assert!(!is_even(Vec3::new(1.5, 0.5, 2.5)));
    }
}
