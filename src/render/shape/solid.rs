//! A solid in its place: intersected in double precision in its own frame, with `t` preserved.

#[cfg(feature = "naive")]
mod naive;

use super::revolve::Revolve;
use super::{Solid, SolidKind, sphere};
use crate::math::{Bounds, DAffine3, DMat3, DVec3, Frame, Ray, Vec2, Vec3, float, warp};
use crate::render::geometry::{AreaSample, DirectionSample, PrimId, Spread, SurfacePoint};
use std::borrow::Cow;
use std::f64::consts::PI;

/// Bound on the relative error of the double-precision work between a solid's frame and the world.
const FRAME_ERROR: f64 = 32.0 * (f64::EPSILON / 2.0);

/// A solid with what its intersection needs at hand.
pub struct PlacedSolid {
    solid: Solid,
    /// As it is when the shutter opens.
    placement: Placement,
    /// What a surface of revolution needs.
    revolve: Option<Revolve>,
    area: f64,
    #[cfg(feature = "naive")]
    naive: Option<naive::Sphere>,
}

/// Where a solid is, with what the intersection of rays needs at hand.
#[derive(Clone)]
struct Placement {
    world_from_object: DAffine3,
    object_from_world: DAffine3,
    /// Takes outward normals from the object to the world; not normalised.
    normal_from_object: DMat3,
    /// How areas grow when the transform scales all lengths alike: |det|.
    determinant: f64,
    /// At most the radius of the sharpest bend of a sphere or torus, in the world; infinite for what is flat or has corners.
    radius: f64,
}

impl Placement {
    /// The place of a solid by its transform, which must not be singular.
    fn new(kind: &SolidKind, world_from_object: DAffine3) -> Self {
        let object_from_world = world_from_object.inverse();
        Self {
            world_from_object,
            object_from_world,
            normal_from_object: object_from_world.matrix3.transpose(),
            determinant: world_from_object.matrix3.determinant().abs(),
            radius: match kind {
                SolidKind::Sphere => sharpest_bend(&world_from_object.matrix3),
                SolidKind::Torus(torus) => torus.minor * sharpest_bend(&world_from_object.matrix3),
                _ => f64::INFINITY,
            },
        }
    }

    /// The ray in the object's frame; its direction keeps its scale, so `t` means the same in both.
    fn ray_object(&self, ray: &Ray) -> (DVec3, DVec3) {
        let o = self.object_from_world.transform_point3(ray.o.as_dvec3());
        (o, self.object_from_world.transform_vector3(ray.d.as_dvec3()))
    }

    /// A point of the surface in the world, and the bound on its error per axis; `size` is the extent in the object's frame
    /// to which errors are in proportion where that is not the point's own.
    ///
    /// The first part of the bound is the rounding to single precision, the second that of the transforms.
    fn to_world(&self, p: DVec3, size: f64) -> (Vec3, Vec3) {
        let m = &self.world_from_object;
        let exact = m.transform_point3(p);
        // Roots along a profile are known in proportion to the whole of it.
        let extent = p.abs().max(DVec3::splat(size));
        let terms = m.matrix3.x_axis.abs() * extent.x
            + m.matrix3.y_axis.abs() * extent.y
            + m.matrix3.z_axis.abs() * extent.z
            + m.translation.abs();
        let error = exact.abs() * f64::from(float::gamma(2)) + terms * FRAME_ERROR;
        // A point that is off along the surface is off it, too: by the square of that over twice the radius of its bend.
        // Rays that leave are rounded once more, so that what counts is twice the error.
        let bend = 2.0 * error.length_squared() / self.radius;
        (exact.as_vec3(), (error + bend).as_vec3())
    }

    fn normal_to_world(&self, n: DVec3) -> Vec3 {
        (self.normal_from_object * n).normalize().as_vec3().normalize()
    }
}

/// Where a ray meets a solid.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SolidHit {
    /// The ray parameter.
    pub t: f32,
    /// The shape's own parameters: for a surface of revolution those of the profile, else 0.
    pub uv: Vec2,
}

impl PlacedSolid {
    /// Prepares a solid. Its transform must not be singular.
    pub fn new(solid: Solid) -> Self {
        Self {
            area: area(&solid.kind, &solid.world_from_object),
            #[cfg(feature = "naive")]
            naive: naive::Sphere::of(&solid),
            placement: Placement::new(&solid.kind, solid.world_from_object),
            revolve: match &solid.kind {
                SolidKind::Revolve(profile) => Some(Revolve::new(profile)),
                _ => None,
            },
            solid,
        }
    }

    /// Its place at a time.
    #[inline]
    fn at(&self, time: f32) -> Cow<'_, Placement> {
        match &self.solid.motion {
            None => Cow::Borrowed(&self.placement),
            Some(motion) => Cow::Owned(Placement::new(&self.solid.kind, motion.at(time.into()))),
        }
    }

    /// The solid as it was given.
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Its area in square metres; infinite for planes.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The first intersection with `t` in the open interval (0, `ray.t_max`).
    pub fn intersect(&self, ray: &Ray) -> Option<SolidHit> {
        #[cfg(feature = "naive")]
        if let Some(sphere) = self.naive() {
            return sphere.intersect(ray);
        }
        let (o, d) = self.at(ray.time).ray_object(ray);
        let within = |t: f64| (0.0 < t as f32 && (t as f32) < ray.t_max).then_some(t as f32);
        let plain = |t: f32| SolidHit { t, uv: Vec2::ZERO };
        match &self.solid.kind {
            SolidKind::Sphere => sphere::intersect(o, d)?.into_iter().find_map(within).map(plain),
            SolidKind::Plane => within(-o.z / d.z).map(plain),
            SolidKind::Disk => {
                let t = -o.z / d.z;
                let p = o + d * t;
                if p.x * p.x + p.y * p.y <= 1.0 { within(t).map(plain) } else { None }
            }
            SolidKind::Revolve(_) => {
                let (t, uv) = self.revolve().intersect(o, d, within)?;
                Some(SolidHit { t, uv })
            }
            SolidKind::Frustum(frustum) => frustum.intersect(o, d, within).map(plain),
            SolidKind::Torus(torus) => torus.intersect(o, d, within).map(plain),
        }
    }

    /// Everything about the point where `ray` met this solid.
    pub fn surface_point(&self, ray: &Ray, hit: SolidHit, prim: PrimId) -> SurfacePoint {
        #[cfg(feature = "naive")]
        if let Some(sphere) = self.naive() {
            return sphere.surface_point(&self.solid, ray, hit, prim);
        }
        let placement = self.at(ray.time);
        let (o, d) = placement.ray_object(ray);
        let at = |t: f64| o + d * t;
        let t = f64::from(hit.t);
        let flat = |p: DVec3| DVec3::new(p.x, p.y, 0.0);
        let (p, n, tangent, uv) = match &self.solid.kind {
            SolidKind::Sphere => {
                let roots = sphere::intersect(o, d).unwrap_or([t; 2]);
                let exact = if (roots[0] - t).abs() <= (roots[1] - t).abs() { roots[0] } else { roots[1] };
                let p = at(exact).normalize();
                (p, p, sphere::tangent(p), sphere::uv(p))
            }
            SolidKind::Disk => {
                let p = flat(at(-o.z / d.z));
                (p, DVec3::Z, DVec3::X, (p.truncate() * 0.5 + 0.5).as_vec2())
            }
            SolidKind::Plane => {
                let p = flat(at(-o.z / d.z));
                (p, DVec3::Z, DVec3::X, p.truncate().as_vec2())
            }
            SolidKind::Revolve(_) => {
                let (p, n, uv) = self.revolve().surface(hit.uv, at(t));
                (p, n, sphere::tangent(p), uv)
            }
            SolidKind::Frustum(frustum) => {
                let (p, n, uv) = frustum.surface(o, d, t);
                let is_end = n.x == 0.0 && n.z == 0.0;
                (p, n, if is_end { DVec3::X } else { sphere::tangent(p) }, uv)
            }
            SolidKind::Torus(torus) => {
                let (p, n, uv) = torus.surface(o, d, t);
                (p, n, sphere::tangent(p), uv)
            }
        };
        let (p_world, p_error) = placement.to_world(p, self.size());
        let n = placement.normal_to_world(n);
        SurfacePoint {
            p: p_world,
            p_error,
            n,
            ns: n,
            tangent: orthogonal_tangent(placement.world_from_object.transform_vector3(tangent), n),
            uv,
            p_object: self.solid.texture_from_object.transform_point3(p).as_vec3(),
            material: self.solid.material,
            prim,
            source: self.solid.source,
            time: ray.time,
            footprint: 0.0,
            angle: 0.0,
            spread: Spread::NONE,
        }
    }

    /// Draws a point with the density [`Self::pdf_area`].
    ///
    /// # Panics
    /// For planes and surfaces of revolution.
    pub fn sample_area(&self, u: Vec2) -> AreaSample {
        let (p, n, uv) = match &self.solid.kind {
            SolidKind::Sphere => {
                let p = warp::square_to_uniform_sphere(u).as_dvec3().normalize();
                (p, p, sphere::uv(p))
            }
            SolidKind::Disk => {
                let p = warp::square_to_uniform_disk(u);
                (p.extend(0.0).as_dvec3(), DVec3::Z, p * 0.5 + 0.5)
            }
            SolidKind::Frustum(frustum) => frustum.sample(u),
            SolidKind::Torus(torus) => torus.sample(u),
            SolidKind::Plane | SolidKind::Revolve(_) => {
                unreachable!("what cannot be sampled is no lamp")
            }
        };
        let (p_world, p_error) = self.placement.to_world(p, self.size());
        let pdf_area = self.pdf_area_at(p, n);
        AreaSample { p: p_world, p_error, n: self.placement.normal_to_world(n), uv, pdf_area }
    }

    /// The density of [`Self::sample_area`] at a point on the solid with the unit normal `n`, both in world space, per
    /// square metre.
    pub fn pdf_area(&self, p: Vec3, n: Vec3) -> f32 {
        let p_object = self.placement.object_from_world.transform_point3(p.as_dvec3());
        let n_object = self.solid.world_from_object.matrix3.transpose() * n.as_dvec3();
        self.pdf_area_at(p_object, n_object.normalize())
    }

    /// By a point and a unit normal in the object's frame, where points are drawn uniformly by area.
    fn pdf_area_at(&self, p_object: DVec3, n_object: DVec3) -> f32 {
        match &self.solid.kind {
            SolidKind::Sphere => {
                let scale = self.area_scale(p_object.normalize());
                (1.0 / (4.0 * PI * scale)) as f32
            }
            SolidKind::Frustum(frustum) => (1.0 / (frustum.area() * self.area_scale(n_object))) as f32,
            SolidKind::Torus(torus) => (1.0 / (torus.area() * self.area_scale(n_object))) as f32,
            _ => (1.0 / self.area) as f32,
        }
    }

    /// Draws a point of a round sphere, uniform in the cone that it fills seen from `from`; `None` from inside.
    ///
    /// The angle at the centre follows from that at `from` without cancellation (Pharr et al. 2023, section 6.2.4).
    pub fn sample_cone(&self, from: Vec3, u: Vec2) -> Option<DirectionSample> {
        let cone = self.cone(from)?;
        let below = f64::from(u.x) * cone.one_minus_cos;
        let sin2 = below * (2.0 - below);
        let ratio = sin2 / cone.sin2;
        let cos_center = ratio * cone.sin2.sqrt() + (1.0 - below) * (1.0 - ratio).max(0.0).sqrt();
        let sin_center = (1.0 - cos_center * cos_center).max(0.0).sqrt();
        let (sin_phi, cos_phi) = float::sin_cos64(2.0 * PI * f64::from(u.y));
        let frame = Frame::from_normal(cone.axis.as_vec3().normalize());
        let (x, y) = (frame.x.as_dvec3(), frame.y.as_dvec3());
        let n = ((x * cos_phi + y * sin_phi) * sin_center - cone.axis * cos_center).normalize();
        let center = self.solid.world_from_object.translation;
        let exact = center + n * cone.radius;
        let error = exact.abs() * f64::from(float::gamma(2)) + (center.abs() + cone.radius) * FRAME_ERROR;
        let to = exact - from.as_dvec3();
        Some(DirectionSample {
            p: exact.as_vec3(),
            p_error: error.as_vec3(),
            n: n.as_vec3().normalize(),
            wi: to.normalize().as_vec3(),
            distance: to.length() as f32,
            pdf: cone.pdf(),
        })
    }

    /// The density of [`Self::sample_cone`] per steradian; `None` where it draws nothing.
    pub fn pdf_cone(&self, from: Vec3) -> Option<f32> {
        self.cone(from).map(|cone| cone.pdf())
    }

    fn cone(&self, from: Vec3) -> Option<Cone> {
        let radius = self.sphere_radius()?;
        let axis = self.solid.world_from_object.translation - from.as_dvec3();
        let distance = axis.length();
        let sin2 = (radius / distance) * (radius / distance);
        // A point of the sphere itself may lie outside by its rounding, yet it looks at the inner side.
        let rounding =
            16.0 * f64::from(float::UNIT_ROUND_OFF) * (f64::from(from.abs().max_element()) + distance);
        let outside = distance - radius > rounding && sin2 < 1.0;
        let cos = (1.0 - sin2).sqrt();
        let cone = Cone { axis: axis / distance, radius, sin2, one_minus_cos: sin2 / (1.0 + cos) };
        (outside && cone.pdf().is_finite()).then_some(cone)
    }

    /// A box that holds the solid at every time; `None` for planes.
    pub fn swept_bounds(&self) -> Option<Bounds> {
        let Some(motion) = &self.solid.motion else {
            return bounds(&self.solid.kind, &self.solid.world_from_object);
        };
        let (low, high) = match &self.solid.kind {
            SolidKind::Sphere => motion.sweep_ball(),
            kind => {
                let own = bounds(kind, &DAffine3::IDENTITY)?;
                motion.sweep_box(own.min.as_dvec3(), own.max.as_dvec3())
            }
        };
        let slack = (low.abs().max(high.abs())) * FRAME_ERROR;
        Some(Bounds::enclosing(low - slack, high + slack))
    }

    /// The sphere that this is, if spheres are to be tested in single precision.
    #[cfg(feature = "naive")]
    fn naive(&self) -> Option<&naive::Sphere> {
        self.naive.as_ref().filter(|_| crate::render::naive::lacks(crate::render::naive::Remedy::Spheres))
    }

    fn revolve(&self) -> &Revolve {
        self.revolve.as_ref().expect("`new` prepares each surface of revolution")
    }

    /// The extent in the object's frame to which the errors of its points are in proportion, where that is not their own.
    fn size(&self) -> f64 {
        match &self.solid.kind {
            SolidKind::Revolve(_) => self.revolve().size(),
            SolidKind::Frustum(frustum) => frustum.size(),
            SolidKind::Torus(torus) => torus.size(),
            SolidKind::Plane | SolidKind::Sphere | SolidKind::Disk => 0.0,
        }
    }

    /// World area per object area where the unit object normal is `n`.
    fn area_scale(&self, n: DVec3) -> f64 {
        self.placement.determinant * (self.placement.normal_from_object * n).length()
    }

    /// The world radius if this is a sphere that its transform leaves round.
    fn sphere_radius(&self) -> Option<f64> {
        let is_sphere = matches!(self.solid.kind, SolidKind::Sphere);
        is_sphere.then(|| round_radius(&self.solid.world_from_object.matrix3)).flatten()
    }
}

/// A box that holds a solid in its place; `None` for planes, which nothing holds.
fn bounds(kind: &SolidKind, m: &DAffine3) -> Option<Bounds> {
    let (x, y, z) = (m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis);
    // The support of a round set along a world axis is the length of that axis seen from the object.
    let norm2 = |a: DVec3, b: DVec3| (a * a + b * b).map(f64::sqrt);
    let (low, high) = match kind {
        SolidKind::Plane => return None,
        SolidKind::Sphere => {
            let reach = (x * x + y * y + z * z).map(f64::sqrt);
            (m.translation - reach, m.translation + reach)
        }
        SolidKind::Disk => (m.translation - norm2(x, y), m.translation + norm2(x, y)),
        SolidKind::Revolve(profile) => {
            let ring = norm2(x, z);
            let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for point in profile.pieces.iter().flatten() {
                let (center, reach) = (m.translation + y * point.y, ring * point.x.abs());
                low = low.min(center - reach);
                high = high.max(center + reach);
            }
            (low, high)
        }
        SolidKind::Frustum(frustum) => {
            let (ring, end) = (norm2(x, z), m.translation + y * frustum.height);
            let (bottom, top) = (ring * frustum.base, ring * frustum.top);
            ((m.translation - bottom).min(end - top), (m.translation + bottom).max(end + top))
        }
        SolidKind::Torus(torus) => {
            let tube = (x * x + y * y + z * z).map(f64::sqrt) * torus.minor;
            let reach = norm2(x, z) * torus.major + tube;
            (m.translation - reach, m.translation + reach)
        }
    };
    let slack = (low.abs().max(high.abs())) * FRAME_ERROR;
    Some(Bounds::enclosing(low - slack, high + slack))
}

/// The area of a solid in its place, in m²: closed forms where the transform allows, else a product rule over the
/// parameters; infinite for planes.
pub fn area(kind: &SolidKind, world_from_object: &DAffine3) -> f64 {
    let m = world_from_object.matrix3;
    let (determinant, normal_from_object) = (m.determinant().abs(), m.inverse().transpose());
    let scale = |n: DVec3| determinant * (normal_from_object * n).length();
    let sum = |(n, area): (DVec3, f64)| area * scale(n);
    match kind {
        SolidKind::Plane => f64::INFINITY,
        SolidKind::Disk => PI * scale(DVec3::Z),
        SolidKind::Sphere => match round_radius(&m) {
            Some(radius) => 4.0 * PI * radius * radius,
            None => integrate_sphere(scale),
        },
        SolidKind::Revolve(profile) => Revolve::new(profile).elements().map(sum).sum(),
        SolidKind::Frustum(frustum) => frustum.elements().map(sum).sum(),
        SolidKind::Torus(torus) => torus.elements().map(sum).sum(),
    }
}

/// A lower bound on the radius of the sharpest bend of the ellipsoid that a unit sphere becomes: the shortest half-axis
/// squared over the longest. With the sum of squares F² = Σ sᵢ² of the half-axes, each is below F, and the shortest is
/// above |det| / F².
fn sharpest_bend(m: &DMat3) -> f64 {
    let square: f64 = m.to_cols_array().iter().map(|x| x * x).sum();
    let shortest = m.determinant().abs() / square;
    shortest * shortest / square.sqrt()
}

/// The radius that the unit sphere takes if `m` leaves it round (to 10⁻⁶).
fn round_radius(m: &DMat3) -> Option<f64> {
    let gram = m.transpose() * *m;
    let square = gram.x_axis.x;
    let skew = (gram - DMat3::from_diagonal(DVec3::splat(square))).abs();
    let largest = skew.to_cols_array().into_iter().fold(0.0, f64::max);
    (largest <= 1e-6 * square).then(|| square.sqrt())
}

/// The area of an ellipsoid by midpoints in height and longitude (error below 10⁻³ up to an aspect of 100).
fn integrate_sphere(area_scale: impl Fn(DVec3) -> f64) -> f64 {
    const STEPS: u32 = 256;
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let mut sum = 0.0;
    for i in 0..STEPS {
        let z = 2.0 * middle(i) - 1.0;
        for j in 0..STEPS {
            let (sin, cos) = float::sin_cos64(2.0 * PI * middle(j));
            let r = (1.0 - z * z).sqrt();
            sum += area_scale(DVec3::new(r * cos, r * sin, z));
        }
    }
    4.0 * PI * sum / f64::from(STEPS * STEPS)
}

/// The cone that a round sphere fills, seen from outside.
struct Cone {
    /// The unit direction to the centre.
    axis: DVec3,
    radius: f64,
    /// Square of the sine of its half-angle.
    sin2: f64,
    /// 1 − cos of its half-angle, as sin² / (1 + cos): exact however small.
    one_minus_cos: f64,
}

impl Cone {
    fn pdf(&self) -> f32 {
        (1.0 / (2.0 * PI * self.one_minus_cos)) as f32
    }
}

/// The unit vector along `tangent` that is orthogonal to the unit normal `n`; any where there is none.
#[inline]
pub fn orthogonal_tangent(tangent: DVec3, n: Vec3) -> Vec3 {
    let n64 = n.as_dvec3();
    let along = tangent - n64 * n64.dot(tangent);
    if along.length_squared() > 1e-12 * tangent.length_squared() {
        along.normalize().as_vec3()
    } else {
        Frame::from_normal(n).x
    }
}
