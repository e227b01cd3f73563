//! Whether a plane is seen from its side, where it matters.

use super::{Dialect, Reader};
use crate::convert::Planes;
use crate::math::DVec3;

impl Reader<'_> {
    /// Whether the camera is behind a plane that can only be seen from the front.
    ///
    /// Planes of the dialect of weights have one side, and its cameras like to stand behind the front wall.
    pub(super) fn is_seen_through(&self, normal: DVec3, offset: f64) -> bool {
        let one_sided = match self.options.planes {
            Planes::Auto => self.dialect == Dialect::Weights,
            Planes::OneSided => true,
            Planes::TwoSided => false,
        };
        let is_behind = |camera: DVec3| normal.dot(camera) < offset;
        one_sided && self.transform_depth == 0 && self.camera_center.is_some_and(is_behind)
    }
}
