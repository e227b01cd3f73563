//! From a hit to the full surface point, and rays that leave it.

use super::instance::{PlacedMesh, Placement};
use super::terminator::barycentrics;
use super::{AreaSample, Geometry, Hit, Prim, PrimId, Spread, SurfacePoint};
use crate::math::{DVec3, Ray, Vec2, Vec3, float};
#[cfg(feature = "naive")]
use crate::render::naive::{self, Remedy};
use crate::render::shape::Mesh;
use crate::render::shape::solid::{SolidHit, orthogonal_tangent};
use crate::render::shape::triangle::cross_of_edges;

impl Geometry {
    /// Everything about the point where `ray` met the geometry.
    pub fn surface_point(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        match self.prim(hit.prim) {
            Prim::Triangle(mesh, triangle) => {
                triangle_point(mesh, triangle, hit.uv, hit.prim).met_by(ray, hit.t)
            }
            Prim::Placed(placed, mesh, triangle) => {
                placed_point(placed, &placed.at(ray.time), mesh, triangle, hit).met_by(ray, hit.t)
            }
            Prim::Solid(solid) => {
                let solid_hit = SolidHit { t: hit.t, uv: hit.uv };
                solid.surface_point(ray, solid_hit, hit.prim).met_by(ray, hit.t)
            }
        }
    }
}

impl Geometry {
    /// The full point of a primitive, as it stands when the shutter opens, nearest to `p`, which is off it by rounding at
    /// most, with the unit normal `n` there; `None` where none is found.
    pub fn point_near(&self, prim: PrimId, p: Vec3, n: Vec3) -> Option<SurfacePoint> {
        let within = |[_, b1, b2]: [f64; 3]| Vec2::new(b1 as f32, b2 as f32);
        match self.prim(prim) {
            Prim::Triangle(mesh, triangle) => {
                let corners = mesh.corners(triangle).map(Vec3::as_dvec3);
                let b = within(barycentrics(corners, p.as_dvec3())?);
                Some(triangle_point(mesh, triangle, b, prim))
            }
            Prim::Placed(placed, mesh, triangle) => {
                let placement = placed.placement();
                let corners = mesh.corners(triangle).map(|corner| placement.corner(corner.as_dvec3()));
                let uv = within(barycentrics(corners, p.as_dvec3())?);
                Some(placed_point(placed, placement, mesh, triangle, &Hit { t: 0.0, prim, uv }))
            }
            Prim::Solid(solid) => {
                let lift = n * (1e-3 * solid.area().sqrt() as f32);
                let ray = Ray { t_max: 2.0, ..Ray::new(p + lift, -lift) };
                Some(solid.surface_point(&ray, solid.intersect(&ray)?, prim))
            }
        }
    }
}

impl SurfacePoint {
    /// The point as a ray met it that had come so far.
    fn met_by(self, ray: &Ray, t: f32) -> Self {
        Self { time: ray.time, footprint: ray.width + ray.angle * t, angle: ray.angle, ..self }
    }

    /// The ray that leaves along `dir`, from an origin that lies beyond the rounding errors of the surface.
    pub fn spawn(&self, dir: Vec3) -> Ray {
        Ray::new(self.origin(dir), dir).at_time(self.time).as_cone(self.footprint, self.angle)
    }

    /// Where rays start that leave it to the side of `dir`.
    pub fn origin(&self, dir: Vec3) -> Vec3 {
        offset(self.p, self.p_error, self.n, dir)
    }

    /// The open segment (0, 1) to `target` on a surface with normal `target_n`, both ends moved off their surfaces.
    ///
    /// A target that lies on no surface, a point light, has zero error and any normal. Any other is seen from afar as no
    /// better known than the segment is long: its direction is rounded, and so is what the tests make of it.
    pub fn spawn_to(&self, target: Vec3, target_error: Vec3, target_n: Vec3) -> Ray {
        segment(self.origin(target - self.p), target, target_error, target_n).at_time(self.time)
    }

    /// Such a segment that ends here, from the [`Self::origin`] of another surface.
    pub fn seen_from(&self, o: Vec3) -> Ray {
        segment(o, self.p, self.p_error, self.n).at_time(self.time)
    }
}

/// The open segment (0, 1) from a ray's origin to `target`, as [`SurfacePoint::spawn_to`] says.
fn segment(o: Vec3, target: Vec3, target_error: Vec3, target_n: Vec3) -> Ray {
    let reach = (target - o).abs().max_element() * float::gamma(8);
    let target_error = if target_error == Vec3::ZERO { target_error } else { target_error + reach };
    let end = offset(target, target_error, target_n, o - target);
    Ray { t_max: 1.0, ..Ray::new(o, end - o) }
}

impl AreaSample {
    /// The ray that leaves along `dir`, from an origin that lies beyond the rounding errors of the surface.
    pub fn spawn(&self, dir: Vec3) -> Ray {
        Ray::new(offset(self.p, self.p_error, self.n, dir), dir)
    }
}

/// `p` moved along the normal, to the side of `dir`, until it is surely off the surface.
///
/// The shift is the extent of the error box along `n`; the result is rounded away from the surface
/// (Pharr, Jakob, Humphreys 2023, section 6.8.6).
fn offset(p: Vec3, p_error: Vec3, n: Vec3, dir: Vec3) -> Vec3 {
    #[cfg(feature = "naive")]
    if naive::lacks(Remedy::Origins) {
        return p + dir * naive::FIXED_OFFSET;
    }
    if p_error == Vec3::ZERO {
        return p;
    }
    let side = if n.dot(dir) < 0.0 { -n } else { n };
    let shift = side * side.abs().dot(p_error);
    let moved = p + shift;
    Vec3::new(beyond(moved.x, shift.x), beyond(moved.y, shift.y), beyond(moved.z, shift.z))
}

/// The next number after the finite `x` to the side that `by` points to; `x` itself where `by` is 0.
///
/// As [`f32::next_up`] and [`f32::next_down`], the sign of zero aside, but without a branch, which no processor could
/// foresee. The bits of numbers of one sign are in order as integers; those of negative ones are turned about.
#[inline]
fn beyond(x: f32, by: f32) -> f32 {
    let turned = |bits: i32| if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits };
    let step = i32::from(by > 0.0) - i32::from(by < 0.0);
    f32::from_bits(turned(turned(x.to_bits() as i32) + step) as u32)
}

/// The corners of a triangle in double precision.
pub(super) type Corners = [DVec3; 3];

/// The point with barycentrics `b` (of the second and third vertex) on a triangle.
pub(super) fn triangle_point(mesh: &Mesh, triangle: [u32; 3], b: Vec2, prim: PrimId) -> SurfacePoint {
    let corners = mesh.corners(triangle).map(|p| p.as_dvec3());
    let (p, p_error) = interpolate_point(corners, b);
    let p = p.as_vec3();
    let n = cross_of_edges(mesh.corners(triangle)).normalize().as_vec3().normalize();
    let ns = shading_normal(mesh, triangle, b, n, |normal| normal);
    let (uv, tangent) = texture_frame(mesh, triangle, corners, b);
    SurfacePoint {
        p,
        p_error: p_error.as_vec3(),
        n,
        ns,
        tangent: orthogonal_tangent(tangent, ns),
        uv,
        p_object: mesh.object_from_world.transform_point3(p.as_dvec3()).as_vec3(),
        material: mesh.material,
        prim,
        source: mesh.source,
        time: 0.0,
        footprint: 0.0,
        angle: 0.0,
        spread: Spread::NONE,
    }
}

/// The same on a triangle of a mesh that is placed.
fn placed_point(
    placed: &PlacedMesh,
    placement: &Placement,
    mesh: &Mesh,
    triangle: [u32; 3],
    hit: &Hit,
) -> SurfacePoint {
    let b = hit.uv;
    let corners = mesh.corners(triangle).map(|p| p.as_dvec3());
    let (p, p_error) = placement.point(mesh, triangle, b);
    let n = placement.normal(cross_of_edges(mesh.corners(triangle))).as_vec3().normalize();
    let ns = shading_normal(mesh, triangle, b, n, |normal| placement.normal(normal.as_dvec3()).as_vec3());
    let (uv, tangent) = texture_frame(mesh, triangle, corners, b);
    SurfacePoint {
        p,
        p_error,
        n,
        ns,
        tangent: orthogonal_tangent(placement.vector(tangent), ns),
        uv,
        // The frame of the mesh is the world as far as the mesh knows.
        p_object: mesh.object_from_world.transform_point3(interpolate_point(corners, b).0).as_vec3(),
        material: placed.instance.material,
        prim: hit.prim,
        source: placed.instance.source,
        time: 0.0,
        footprint: 0.0,
        angle: 0.0,
        spread: Spread::NONE,
    }
}

/// The point of a triangle with barycentrics `b`, and the bound γ(7)·(Σ|bᵢ·vᵢ| + size) on its error once it is rounded.
///
/// The sum is the rounding of coordinates, axis by axis. The size of the triangle is what its test rounds by, once it
/// has sheared the axes into each other: a point of the plane z = 0, where no z is ever rounded, still needs that room.
pub(super) fn interpolate_point(corners: Corners, b: Vec2) -> (DVec3, DVec3) {
    #[cfg(feature = "naive")]
    if naive::lacks(Remedy::Origins) {
        let [p0, p1, p2] = corners.map(|p| p.as_vec3());
        return ((p0 * (1.0 - b.x - b.y) + p1 * b.x + p2 * b.y).as_dvec3(), DVec3::ZERO);
    }
    let low = corners[0].min(corners[1]).min(corners[2]);
    let high = corners[0].max(corners[1]).max(corners[2]);
    let b = weights(b);
    let terms = [0, 1, 2].map(|i| corners[i] * b[i]);
    let p = terms[0] + terms[1] + terms[2];
    let size = (high - low).max_element();
    let error = (terms[0].abs() + terms[1].abs() + terms[2].abs() + size) * f64::from(float::gamma(7));
    (p, error)
}

/// All three barycentrics from the last two.
fn weights(b: Vec2) -> [f64; 3] {
    let (b1, b2) = (f64::from(b.x), f64::from(b.y));
    [1.0 - b1 - b2, b1, b2]
}

/// The interpolated normal on the side of `n`; `n` itself where there is none.
fn shading_normal(
    mesh: &Mesh,
    triangle: [u32; 3],
    b: Vec2,
    n: Vec3,
    to_world: impl Fn(Vec3) -> Vec3,
) -> Vec3 {
    let Some(normals) = &mesh.normals else { return n };
    let [n0, n1, n2] = triangle.map(|vertex| to_world(normals[vertex as usize]));
    let ns = (n0 * (1.0 - b.x - b.y) + n1 * b.x + n2 * b.y).try_normalize().unwrap_or(n);
    if ns.dot(n) < 0.0 { -ns } else { ns }
}

/// The texture point, and the direction in which its u grows; zero where the texture is degenerate.
fn texture_frame(mesh: &Mesh, triangle: [u32; 3], [p0, p1, p2]: Corners, b: Vec2) -> (Vec2, DVec3) {
    let Some(uvs) = &mesh.uvs else { return (b, p1 - p0) };
    let [t0, t1, t2] = triangle.map(|vertex| uvs[vertex as usize]);
    let uv = t0 * (1.0 - b.x - b.y) + t1 * b.x + t2 * b.y;
    // Solve dp = dp/du·du + dp/dv·dv along two edges; only the direction of dp/du matters.
    let (d1, d2) = ((t1 - t0).as_dvec2(), (t2 - t0).as_dvec2());
    let determinant = d1.perp_dot(d2);
    let along_u = ((p1 - p0) * d2.y - (p2 - p0) * d1.y) * determinant.signum();
    (uv, if determinant == 0.0 { DVec3::ZERO } else { along_u })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_beyond_is_the_next_one_on_that_side() {
        let mut all =
            vec![0.0, f32::from_bits(1), f32::MIN_POSITIVE, 1.0, 1.0 - f32::EPSILON, 3e38, f32::MAX];
        all.extend((0..1_000_u32).map(|i| f32::from_bits(i.wrapping_mul(0x9e37_79b9) >> 1) % 1e9));
        for x in all.into_iter().filter(|x| x.is_finite()).flat_map(|x| [x, -x]) {
            assert_eq!(beyond(x, 0.1), x.next_up(), "above {x:e}");
            assert_eq!(beyond(x, -0.1), x.next_down(), "below {x:e}");
            assert_eq!(beyond(x, 0.0), x);
        }
    }
}
