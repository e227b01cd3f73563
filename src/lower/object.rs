//! Objects: what can be exact stays exact, the rest becomes triangles.

use super::light::radiance;
use super::place::{is_similarity, object_bounds};
use super::tessellate::Triangles;
use super::{Lowering, curve, heightfield, sweep};
use crate::ir::{self, Object, RevolveMethod, ShapeKind};
use crate::load::LoadedMesh;
use crate::math::{DAffine3, DMat3, DVec2, DVec3, Vec3};
use crate::plan::Tessellation;
use crate::render::shape::{Frustum, MaterialId, Mesh, Profile, Solid, SolidKind, SourceId, Torus};
use crate::source::{Span, Spanned};
use std::f64::consts::PI;
use std::sync::Arc;

/// Where a tessellation may leave its shape, as a share of the shape's size, unless the scene says otherwise.
const RELATIVE_TOLERANCE: f64 = 1e-3;
/// The same for tubes, as a share of their radius.
const TUBE_TOLERANCE: f64 = 5e-3;
/// The same for outlines, whose facets show at the silhouette of every pixel row.
const OUTLINE_TOLERANCE: f64 = 1e-4;

/// A shape as the engine takes it, in the object's own frame.
enum Form {
    Exact { kind: SolidKind, object_from_solid: DAffine3 },
    Triangles(Triangles),
    Parts(Arc<LoadedMesh>, f64, Option<bool>),
}

impl Lowering<'_> {
    /// Adds an object to the world; a mesh that was left out adds nothing.
    pub(super) fn object(&mut self, object: &Object) {
        let Some(form) = self.form(object) else { return };
        let source = self.source(object.span);
        let shape = &self.loaded.scene.shapes[object.shape];
        let written = object.material.or(shape.material);
        match form {
            Form::Parts(mesh, scale, smooth) => self.parts(object, &mesh, scale, smooth, written, source),
            Form::Exact { kind, object_from_solid } => {
                let move_to_center = DAffine3::from_translation(-self.center);
                let mut solid = Solid {
                    kind,
                    world_from_object: move_to_center * object.world_from_object * object_from_solid,
                    texture_from_object: object_from_solid,
                    material: MaterialId(0),
                    source,
                    motion: self.motion(object, object_from_solid),
                };
                solid.material = self.material(written, || solid.area());
                self.shapes.solids.push(solid);
            }
            Form::Triangles(triangles) => {
                let material = self.material(written, || area(&triangles, &object.world_from_object));
                match self.moves(object) {
                    true => self.moving(object, &triangles, material, source),
                    false => self.mesh(&triangles, &object.world_from_object, material, source),
                }
            }
        }
    }

    fn form(&mut self, object: &Object) -> Option<Form> {
        let scene = self.loaded.scene;
        let shape = &scene.shapes[object.shape];
        let emits = object.material.or(shape.material).is_some_and(|m| self.materials.emits(m));
        let similar = is_similarity(&object.world_from_object);
        Some(match &shape.kind {
            ShapeKind::Sphere { center, radius } => {
                let object_from_solid = DAffine3::from_scale_rotation_translation(
                    DVec3::splat(radius.value),
                    glam::DQuat::IDENTITY,
                    *center,
                );
                Form::Exact { kind: SolidKind::Sphere, object_from_solid }
            }
            ShapeKind::Plane { normal, offset } => {
                let normal = normal.value.normalize();
                let object_from_solid =
                    DAffine3::from_mat3_translation(frame_about(normal), normal * *offset);
                Form::Exact { kind: SolidKind::Plane, object_from_solid }
            }
            ShapeKind::Disk { center, normal, radius } if similar || !emits => {
                let frame = frame_about(normal.value.normalize()) * radius.value;
                Form::Exact {
                    kind: SolidKind::Disk,
                    object_from_solid: DAffine3::from_mat3_translation(frame, *center),
                }
            }
            ShapeKind::Disk { center, normal, radius } => {
                Form::Triangles(round_plate(*center, normal.value.normalize(), radius.value))
            }
            ShapeKind::Quad { origin, edge_u, edge_v } => {
                Form::Triangles(Triangles::quad(*origin, edge_u.value, edge_v.value))
            }
            ShapeKind::Box { min, max } => Form::Triangles(Triangles::cuboid(min.value, max.value)),
            ShapeKind::Triangle { corners } => {
                Form::Triangles(Triangles::triangle(corners.map(|corner| corner.value)))
            }
            ShapeKind::Cone { base, axis, radius, top_radius, caps } => {
                let top = top_radius.unwrap_or(*radius).value;
                let (base_radius, height) = (radius.value, axis.value.length());
                let frustum = Frustum { base: base_radius, top, height, caps: *caps };
                let object_from_solid = ir::shape::upright(axis.value, *base);
                Form::Exact { kind: SolidKind::Frustum(frustum), object_from_solid }
            }
            ShapeKind::Sweep { path, radius, end_radius, caps, closed, tolerance } => {
                let radii = [radius.value, end_radius.unwrap_or(*radius).value];
                let tube = sweep::Tube { path, radii, caps: *caps, closed: *closed };
                // A tube is seen by its width, however long it is.
                let width = radii[0].max(radii[1]) * TUBE_TOLERANCE;
                Form::Triangles(sweep::tube(&tube, self.within(*tolerance).unwrap_or(width)))
            }
            ShapeKind::Heightfield { heights, size, smooth } => {
                let grid = match heights {
                    ir::Heights::Grid { width, values, .. } => (*width, values.clone()),
                    ir::Heights::Image(texture) => self.materials.heights(texture.value)?,
                };
                let heights = heightfield::Heights { width: grid.0, values: &grid.1, size: size.value };
                Form::Triangles(heightfield::surface(&heights, *smooth))
            }
            ShapeKind::Torus { center, normal, radius, tube } => {
                let kind = SolidKind::Torus(Torus { major: radius.value, minor: tube.value });
                Form::Exact { kind, object_from_solid: ir::shape::upright(normal.value, *center) }
            }
            ShapeKind::Mesh { scale, smooth, .. } => {
                Form::Parts(self.loaded.mesh(object.shape)?.clone(), scale.value, *smooth)
            }
            ShapeKind::Revolve { profile, method } => {
                let mut pieces = curve::cubics(profile);
                if curve::signed_area(&pieces) < 0.0 {
                    pieces = pieces.iter().rev().map(|c| [c[3], c[2], c[1], c[0]]).collect();
                }
                match self.method_of_revolve(*method, shape.span) {
                    RevolveMethod::Exact if !emits => {
                        let kind = SolidKind::Revolve(Profile { pieces });
                        Form::Exact { kind, object_from_solid: DAffine3::IDENTITY }
                    }
                    // Light is drawn from triangles: an exact surface of revolution has no formula for it.
                    RevolveMethod::Exact => {
                        Form::Triangles(Triangles::revolve(&pieces, self.tolerance(object, None)))
                    }
                    RevolveMethod::Tessellated(tolerance) => {
                        let tolerance = self.tolerance(object, tolerance.map(|tolerance| tolerance.value));
                        Form::Triangles(Triangles::revolve(&pieces, tolerance))
                    }
                }
            }
            ShapeKind::Extrude { outline, holes, depth, tolerance } => {
                let usual = self.size(object) * OUTLINE_TOLERANCE;
                let tolerance = self.within(*tolerance).unwrap_or(usual);
                Form::Triangles(Triangles::extrude(outline, holes, depth.value, tolerance))
            }
        })
    }

    /// How a surface of revolution is made that says `written`.
    fn method_of_revolve(&self, written: RevolveMethod, span: Span) -> RevolveMethod {
        match self.tessellation {
            Tessellation::AsWritten => written,
            Tessellation::Exact => RevolveMethod::Exact,
            Tessellation::Within(tolerance) => {
                RevolveMethod::Tessellated(Some(Spanned::new(tolerance, span)))
            }
        }
    }

    /// The tolerance of a shape that has no other form than triangles and says `written`.
    fn within(&self, written: Option<Spanned<f64>>) -> Option<f64> {
        match self.tessellation {
            Tessellation::Within(tolerance) => Some(tolerance),
            Tessellation::AsWritten | Tessellation::Exact => written.map(|tolerance| tolerance.value),
        }
    }

    fn tolerance(&self, object: &Object, written: Option<f64>) -> f64 {
        written.unwrap_or_else(|| self.size(object) * RELATIVE_TOLERANCE)
    }

    /// The longest edge of the shape's box in its own frame.
    fn size(&self, object: &Object) -> f64 {
        let unplaced = Object { world_from_object: DAffine3::IDENTITY, ..object.clone() };
        object_bounds(&unplaced, self.loaded).map_or(1.0, |(min, max)| (max - min).max_element())
    }

    fn parts(
        &mut self,
        object: &Object,
        mesh: &Arc<LoadedMesh>,
        scale: f64,
        smooth: Option<bool>,
        written: Option<ir::Handle<ir::Material>>,
        source: SourceId,
    ) {
        // The power of a lamp is that of all its parts.
        let whole = || {
            let parts = mesh.model.parts.iter();
            parts.map(|part| area(&Triangles::part(part, scale, smooth), &object.world_from_object)).sum()
        };
        for (i, part) in mesh.model.parts.iter().enumerate() {
            let material = match (written, part.material) {
                (None, Some(index)) => self.materials.of_model(mesh, index),
                _ => self.material(written, whole),
            };
            if self.moves(object) || self.is_shared(object, mesh, i) {
                self.instance(object, mesh, i, source, material);
                continue;
            }
            let triangles = Triangles::part(part, scale, smooth);
            self.mesh(&triangles, &object.world_from_object, material, source);
        }
    }

    /// Adds triangles to the world.
    pub(super) fn mesh(
        &mut self,
        shape: &Triangles,
        world_from_object: &DAffine3,
        material: MaterialId,
        source: SourceId,
    ) {
        let to_world = DAffine3::from_translation(-self.center) * *world_from_object;
        let positions: Vec<_> =
            shape.positions.iter().map(|&p| to_world.transform_point3(p).as_vec3()).collect();
        let mirrored = to_world.matrix3.determinant() < 0.0;
        let turn = |t: [u32; 3]| if mirrored { [t[0], t[2], t[1]] } else { t };
        let indices: Vec<_> = shape.indices.iter().map(|&t| turn(t)).collect();
        let triangles = solid_triangles(&positions, &indices);
        if triangles.is_empty() {
            return;
        }
        let normals = shape.normals.as_ref().filter(|_| self.is_smooth);
        let normals = normals.map(|normals| world_normals(normals, &to_world.matrix3));
        let object_from_world = to_world.inverse();
        let uvs = shape.uvs.clone();
        self.shapes.meshes.push(Mesh {
            positions,
            triangles,
            normals,
            uvs,
            material,
            object_from_world,
            source,
        });
    }

    /// The material of a shape with this area, which only a lamp asks for.
    fn material(&mut self, written: Option<ir::Handle<ir::Material>>, area: impl Fn() -> f64) -> MaterialId {
        match written {
            Some(handle) => {
                self.materials.of_scene(handle, &|brightness, color| radiance(brightness, color, area()))
            }
            None => self.materials.gray(),
        }
    }
}

/// The triangles that have an area: rounding to single precision may flatten what double precision kept apart.
pub(super) fn solid_triangles(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let is_solid = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
        (b - a).cross(c - a) != DVec3::ZERO
    };
    triangles.iter().filter(is_solid).copied().collect()
}

/// Normals by the cofactor matrix, which is the inverse transpose up to scale and also serves flat transforms.
fn world_normals(normals: &[DVec3], m: &DMat3) -> Vec<Vec3> {
    let cofactor =
        DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    let sign = m.determinant().signum();
    normals.iter().map(|&n| (cofactor * n * sign).normalize_or_zero().as_vec3()).collect()
}

/// A right-handed frame whose z axis is the unit vector `n`; for `n` along an axis, its own axes are axes too.
fn frame_about(n: DVec3) -> DMat3 {
    let reference = if n.y.abs() > 0.9 { DVec3::X } else { DVec3::Y };
    let x = if n.y.abs() > 0.9 {
        (reference - n * n.dot(reference)).normalize()
    } else {
        reference.cross(n).normalize()
    };
    DMat3::from_cols(x, n.cross(x), n)
}

fn round_plate(center: DVec3, normal: DVec3, radius: f64) -> Triangles {
    const EDGES: u32 = 256;
    let frame = frame_about(normal);
    let rim = |i: u32| {
        let (sin, cos) = libm::sincos(2.0 * PI * f64::from(i) / f64::from(EDGES));
        DVec2::new(cos, sin)
    };
    let points = std::iter::once(DVec2::ZERO).chain((0..EDGES).map(rim));
    let (positions, uvs) =
        points.map(|p| (center + frame * (p * radius).extend(0.0), (p.as_vec2() + 1.0) / 2.0)).unzip();
    let indices = (0..EDGES).map(|i| [0, 1 + i, 1 + (i + 1) % EDGES]).collect();
    Triangles { positions, indices, normals: None, uvs: Some(uvs) }
}

/// The area of triangles once they are placed, in m².
pub(super) fn area(shape: &Triangles, world_from_object: &DAffine3) -> f64 {
    let corner = |i: u32| world_from_object.transform_point3(shape.positions[i as usize]);
    let double = |t: &[u32; 3]| {
        let [a, b, c] = t.map(corner);
        (b - a).cross(c - a).length()
    };
    shape.indices.iter().map(double).sum::<f64>() / 2.0
}
