//! Local frames with the normal along +z.

use super::Vec3;

/// A right-handed orthonormal frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frame {
    /// The local x axis, in the outer frame.
    pub x: Vec3,
    /// The local y axis.
    pub y: Vec3,
    /// The local z axis: the normal.
    pub z: Vec3,
}

impl Frame {
    /// A frame about the unit vector `n`, without branches near the poles (Duff et al. 2017, listing 3).
    pub fn from_normal(n: Vec3) -> Self {
        let sign = 1.0_f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        let x = Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
        let y = Vec3::new(b, sign + n.y * n.y * a, -n.y);
        Self { x, y, z: n }
    }

    /// A vector of the outer frame, seen from this one.
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }

    /// A vector of this frame, seen from the outer one.
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}
