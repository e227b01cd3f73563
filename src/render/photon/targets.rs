//! What throws caustics, and where: the balls that photons are aimed at.

use super::gathers;
use crate::math::{Bounds, Vec2, Vec3};
use crate::render::bsdf::{MaterialId, Materials};
use crate::render::geometry::{Geometry, PrimId, Spread, SurfacePoint};
use crate::render::shape::{Mesh, Solid, SolidKind, SourceId};

/// The most balls: each is looked at for each photon, which the rays saved must pay for.
pub const MAX_BALLS: usize = 32;

/// What sends less than this share of the light on sharply throws no caustic that photons are worth.
const LEAST_ALBEDO: f32 = 0.01;
/// The same where the lobe has some width, so that paths find lights through it.
const LEAST_GLOSSY_ALBEDO: f32 = 0.1;

/// A ball that holds some of what throws caustics.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ball {
    /// In metres.
    pub center: Vec3,
    /// In metres.
    pub radius: f32,
    /// About how much of the light it sends on, in (0, 1].
    pub albedo: f32,
}

/// All that throws caustics: what mirrors, refracts, or reflects too sharply for [`gathers`].
///
/// Which materials count is a matter of cost only: light by way of the others is found by paths from the camera.
#[derive(Default)]
pub struct Targets {
    /// By material, the share of light that it sends on sharply; 0 for what is no target.
    albedos: Vec<f32>,
    /// Targets without end, and the largest of their albedos.
    endless: Vec<PrimId>,
    endless_albedo: f32,
    /// Around all others.
    balls: Vec<Ball>,
}

impl Targets {
    /// Finds the targets of a world and covers them by few balls.
    pub fn new(geometry: &Geometry, materials: &Materials) -> Self {
        let mut targets = Self::default();
        let mut items = Vec::new();
        for (mesh, _) in geometry.mesh_prims() {
            let albedo = targets.albedo_of(mesh.material, materials);
            if albedo > 0.0 {
                items.extend(mesh.triangles.iter().map(|corners| triangle_ball(mesh, *corners, albedo)));
            }
        }
        for (instance, bounds) in geometry.instance_bounds() {
            let albedo = targets.albedo_of(instance.material, materials);
            if albedo > 0.0 {
                items.push(Ball { center: bounds.center(), radius: bounds.radius(), albedo });
            }
        }
        for (solid, prim) in geometry.solid_prims() {
            let albedo = targets.albedo_of(solid.material, materials);
            if albedo > 0.0 {
                match geometry.prim_bounds(prim) {
                    Some(bounds) => items.push(solid_ball(solid, bounds, albedo)),
                    None => {
                        targets.endless.push(prim);
                        targets.endless_albedo = targets.endless_albedo.max(albedo);
                    }
                }
            }
        }
        targets.balls = cover(items);
        targets
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.balls.is_empty() && self.endless.is_empty()
    }

    /// Whether a primitive is one, for light from infinity (which cannot be aimed at what has no end) or from nearer.
    pub fn holds(&self, material: MaterialId, prim: PrimId, from_infinity: bool) -> bool {
        let albedo = self.albedos.get(material.0 as usize).copied().unwrap_or(0.0);
        albedo > 0.0 && !(from_infinity && self.endless.contains(&prim))
    }

    /// The balls around all but the endless ones, at most [`MAX_BALLS`].
    pub fn balls(&self) -> &[Ball] {
        &self.balls
    }

    /// The largest albedo among the endless ones; 0 without any.
    pub fn endless_albedo(&self) -> f32 {
        self.endless_albedo
    }

    /// The albedo that makes a material a target; 0 if it is none. Remembered.
    fn albedo_of(&mut self, id: MaterialId, materials: &Materials) -> f32 {
        let index = id.0 as usize;
        if self.albedos.len() <= index {
            self.albedos.resize(index + 1, f32::NAN);
        }
        if self.albedos[index].is_nan() {
            self.albedos[index] = sharp_albedo(id, materials);
        }
        self.albedos[index]
    }
}

/// How much light a material sends on sharply where it does so most, of sixteen points of its textures.
fn sharp_albedo(id: MaterialId, materials: &Materials) -> f32 {
    let at = |i: u32| {
        let uv = Vec2::new((i as f32 + 0.5) / 16.0, (i as f32 * 0.618_034).fract());
        let bsdf = materials.bsdf(&somewhere(id, uv));
        let sharp = bsdf.only(|lobe| !gathers(lobe));
        let least = if sharp.is_smooth() { LEAST_GLOSSY_ALBEDO } else { LEAST_ALBEDO };
        let albedo = sharp.albedo(Vec3::Z);
        if albedo >= least { albedo.min(1.0) } else { 0.0 }
    };
    (0..16).map(at).fold(0.0, f32::max)
}

/// A point of a level surface: enough to ask a material what it is like.
fn somewhere(material: MaterialId, uv: Vec2) -> SurfacePoint {
    SurfacePoint {
        p: uv.extend(0.0),
        p_error: Vec3::ZERO,
        n: Vec3::Z,
        ns: Vec3::Z,
        tangent: Vec3::X,
        uv,
        p_object: uv.extend(0.0),
        material,
        prim: PrimId(0),
        source: SourceId::default(),
        time: 0.0,
        footprint: 0.0,
        angle: 0.0,
        spread: Spread::NONE,
    }
}

fn triangle_ball(mesh: &Mesh, corners: [u32; 3], albedo: f32) -> Ball {
    let corners = mesh.corners(corners);
    let center = Bounds::of(corners).center();
    let radius = corners.map(|corner| corner.distance(center)).into_iter().fold(0.0, f32::max);
    Ball { center, radius, albedo }
}

fn solid_ball(solid: &Solid, bounds: Bounds, albedo: f32) -> Ball {
    match solid.kind {
        SolidKind::Sphere | SolidKind::Disk if solid.motion.is_none() => {
            // The unit ball grows by at most √‖MᵀM‖∞, and by exactly that where the axes stay orthogonal.
            let m = &solid.world_from_object.matrix3;
            let axes = [m.x_axis, m.y_axis, m.z_axis];
            let rows = axes.map(|a| axes.iter().map(|b| a.dot(*b).abs()).sum::<f64>());
            let radius = rows.into_iter().fold(0.0, f64::max).sqrt() as f32;
            Ball { center: solid.world_from_object.translation.as_vec3(), radius: radius.next_up(), albedo }
        }
        _ => Ball { center: bounds.center(), radius: bounds.radius(), albedo },
    }
}

/// At most [`MAX_BALLS`] balls that hold all of `items`: halved where that makes the balls smaller, the largest first.
fn cover(items: Vec<Ball>) -> Vec<Ball> {
    // What mirrors weakly gets balls of its own, or it would be aimed at as if it were strong.
    let (strong, weak): (Vec<_>, Vec<_>) = items.into_iter().partition(|ball| ball.albedo >= 0.5);
    let mut clusters: Vec<_> = [strong, weak].into_iter().filter_map(Cluster::new).collect();
    while clusters.len() < MAX_BALLS {
        let area = |i: &usize| clusters[*i].ball.radius;
        let splittable = (0..clusters.len()).filter(|&i| !clusters[i].is_done);
        let Some(largest) = splittable.max_by(|a, b| area(a).total_cmp(&area(b))) else { break };
        match clusters[largest].halves() {
            Some([low, high]) => {
                clusters[largest] = low;
                clusters.push(high);
            }
            None => clusters[largest].is_done = true,
        }
    }
    clusters.into_iter().map(|cluster| cluster.ball).collect()
}

/// Some items and a ball around them.
struct Cluster {
    items: Vec<Ball>,
    ball: Ball,
    /// Whether halving it gains nothing.
    is_done: bool,
}

impl Cluster {
    /// Halving must make the balls' area smaller by this factor.
    const GAIN: f32 = 0.9;

    fn new(items: Vec<Ball>) -> Option<Self> {
        let reach = |ball: &Ball| [ball.center - ball.radius, ball.center + ball.radius];
        let center = Bounds::of(items.iter().flat_map(reach)).center();
        let albedo = items.iter().map(|ball| ball.albedo).fold(0.0, f32::max);
        let reach = items.iter().map(|ball| ball.center.distance(center) + ball.radius);
        let radius = reach.fold(0.0, f32::max);
        (!items.is_empty()).then_some(Self { items, ball: Ball { center, radius, albedo }, is_done: false })
    }

    /// Two parts, at the middle of the longest side; `None` if nothing is gained.
    fn halves(&self) -> Option<[Self; 2]> {
        let size = Bounds::of(self.items.iter().map(|ball| ball.center)).size();
        let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b]))?;
        let middle = Bounds::of(self.items.iter().map(|ball| ball.center)).center()[axis];
        let (low, high) = self.items.iter().partition(|ball| ball.center[axis] < middle);
        let (low, high) = (Self::new(low)?, Self::new(high)?);
        let area = |cluster: &Self| cluster.ball.radius * cluster.ball.radius;
        (area(&low) + area(&high) <= Self::GAIN * area(self)).then_some([low, high])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_hold_every_item_and_are_smaller_than_one_around_all() {
        // A long row of small balls.
        let item = |i: u32| Ball { center: Vec3::X * i as f32, radius: 0.25, albedo: 1.0 };
        let items: Vec<_> = (0..200).map(item).collect();
        let balls = cover(items.clone());
        assert!(balls.len() <= MAX_BALLS);
        for item in &items {
            let holds =
                |ball: &Ball| ball.center.distance(item.center) + item.radius <= ball.radius * 1.000_1;
            assert!(balls.iter().any(holds), "{item:?}");
        }
        let area: f32 = balls.iter().map(|ball| ball.radius * ball.radius).sum();
        assert!(area < 100.0 * 100.0 / 20.0, "{area}");
    }

    #[test]
    fn one_ball_stays_itself() {
        let ball = Ball { center: Vec3::new(1.0, 2.0, 3.0), radius: 0.5, albedo: 0.9 };
        assert_eq!(cover(vec![ball]), [ball]);
        assert!(cover(Vec::new()).is_empty());
    }
}
