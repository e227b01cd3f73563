//! Normals that are bent by a picture of normals or of heights.

use super::{Materials, Relief};
use crate::math::Vec3;
use crate::render::geometry::{Gradient, SurfacePoint};

impl Materials {
    /// The unit normal that a relief makes of the shading normal.
    pub fn bent_normal(&self, surface: &SurfacePoint, relief: Relief, gradient: &Gradient) -> Vec3 {
        let bitangent = surface.ns.cross(surface.tangent);
        let bent = match relief {
            Relief::NormalMap { map, strength } => {
                let color = self.textures().eval(map, surface);
                let local = Vec3::new(color.r, color.g, color.b) * 2.0 - 1.0;
                // Where the picture lies mirrored on the surface, its v runs against the bitangent.
                let flip = if gradient.uv[1].y < 0.0 { -1.0 } else { 1.0 };
                let (x, y) = (local.x * strength, local.y * strength * flip);
                surface.tangent * x + bitangent * y + surface.ns * local.z.max(0.0)
            }
            Relief::Bump { height, depth } => {
                let [along, across] = self.slopes(surface, height, gradient).map(|slope| slope * depth);
                surface.ns - surface.tangent * along - bitangent * across
            }
        };
        bent.try_normalize().unwrap_or(surface.ns)
    }

    /// The change of a height for each metre along the tangent and the bitangent, by differences.
    fn slopes(&self, surface: &SurfacePoint, height: super::TextureId, gradient: &Gradient) -> [f32; 2] {
        let detail = self.textures().detail(height);
        let here = self.textures().eval(height, surface).mean();
        [0, 1].map(|axis| {
            let (uv, p_object) = (gradient.uv[axis], gradient.p_object[axis]);
            // Half a detail of the texture, whichever of its two frames is the finer there.
            let steps = [detail.uv / uv.abs().max_element(), detail.space / p_object.length()];
            let step = 0.5 * steps[0].min(steps[1]);
            if !step.is_finite() || step <= 0.0 {
                return 0.0;
            }
            let beside = SurfacePoint {
                uv: surface.uv + uv * step,
                p_object: surface.p_object + p_object * step,
                ..*surface
            };
            (self.textures().eval(height, &beside).mean() - here) / step
        })
    }
}

/// `ns` bent back towards the geometric normal `n` until the mirror direction of `wo` lies above the surface: what a
/// relief hides from itself would otherwise be black.
///
/// The share of `n` is found by halving; 0 for most.
pub fn facing(ns: Vec3, n: Vec3, wo: Vec3) -> Vec3 {
    /// The least sine of the mirror direction above the surface, as a share of the viewer's.
    const LEAST: f32 = 0.05;
    let n = if wo.dot(n) < 0.0 { -n } else { n };
    let turned = if ns.dot(n) < 0.0 { -ns } else { ns };
    let seen = wo.dot(n);
    let fits = |m: Vec3| {
        let cos = wo.dot(m);
        cos > 0.0 && (m * (2.0 * cos) - wo).dot(n) >= LEAST * seen
    };
    let side = if ns.dot(n) < 0.0 { -1.0 } else { 1.0 };
    if fits(turned) {
        return ns;
    }
    let at = |share: f32| turned.lerp(n, share).normalize_or(n);
    let (mut low, mut high) = (0.0_f32, 1.0_f32);
    for _ in 0..8 {
        let middle = 0.5 * (low + high);
        if fits(at(middle)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    at(high) * side
}
