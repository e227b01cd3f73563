//! Meshes that are placed more than once, or move: read once, kept once, in a frame of their own.

use super::tessellate::Triangles;
use super::{Lowering, object};
use crate::ir::{Object, Shape, ShapeKind};
use crate::load::{Loaded, LoadedMesh};
use crate::math::{DAffine3, DVec3, Motion};
use crate::plan::LEAST_SHARED;
use crate::render::shape::{Instance, MaterialId, Mesh, SourceId};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// A mesh as shapes place it: the file, the scale's bits, and how its normals are made.
type Key = (usize, u64, Option<bool>);

/// What is known of meshes that are placed more than once.
#[derive(Default)]
pub(super) struct Instances {
    /// How many objects place each mesh.
    counts: FxHashMap<Key, usize>,
    /// The parts that have been placed, each by its number among the shared meshes and the middle of its box, about which
    /// it is kept: there single precision is finest.
    parts: FxHashMap<(Key, usize), (usize, DVec3)>,
}

impl Instances {
    /// Counts what the objects of a scene place.
    pub(super) fn count(loaded: &Loaded<'_>) -> Self {
        let mut counts = FxHashMap::default();
        for object in &loaded.scene.objects {
            let shape = &loaded.scene.shapes[object.shape];
            if let Some(key) = loaded.mesh(object.shape).and_then(|mesh| key(mesh, shape)) {
                *counts.entry(key).or_default() += 1;
            }
        }
        Self { counts, ..Self::default() }
    }
}

fn key(mesh: &Arc<LoadedMesh>, shape: &Shape) -> Option<Key> {
    let ShapeKind::Mesh { scale, smooth, .. } = &shape.kind else { return None };
    Some((Arc::as_ptr(mesh) as usize, scale.value.to_bits(), *smooth))
}

impl Lowering<'_> {
    /// Whether a part of the mesh that `object` places is better shared than copied.
    pub(super) fn is_shared(&self, object: &Object, mesh: &Arc<LoadedMesh>, part: usize) -> bool {
        let key = key(mesh, &self.loaded.scene.shapes[object.shape]);
        let count = key.and_then(|key| self.instances.counts.get(&key)).copied().unwrap_or(0);
        // A transform that flattens has no inverse to take a ray through.
        let inverse = object.world_from_object.inverse();
        count >= 2
            && mesh.model.parts[part].triangles.len() >= LEAST_SHARED
            && inverse.is_finite()
            && object.world_from_object.matrix3.determinant() != 0.0
    }

    /// Places a part of a mesh once more.
    pub(super) fn instance(
        &mut self,
        object: &Object,
        mesh: &Arc<LoadedMesh>,
        index: usize,
        source: SourceId,
        material: MaterialId,
    ) {
        let Some(key) = key(mesh, &self.loaded.scene.shapes[object.shape]) else { return };
        let known = self.instances.parts.get(&(key, index)).copied();
        let (number, middle) = known.unwrap_or_else(|| self.share(key, mesh, index));
        let world_from_mesh = DAffine3::from_translation(-self.center)
            * object.world_from_object
            * DAffine3::from_translation(middle);
        let motion = self.motion(object, DAffine3::from_translation(middle));
        self.shapes.instances.push(Instance { mesh: number, world_from_mesh, material, source, motion });
    }

    /// Whether an object moves while the shutter is open.
    pub(super) fn moves(&self, object: &Object) -> bool {
        self.motion(object, DAffine3::IDENTITY).is_some()
    }

    /// How an object moves about the scene's middle while the shutter is open; `inner` leads to its own frame.
    pub(super) fn motion(&self, object: &Object, inner: DAffine3) -> Option<Arc<Motion>> {
        let motion = object.motion.as_ref()?;
        motion.part(inner, self.shutter, DAffine3::from_translation(-self.center)).map(Arc::new)
    }

    /// Places triangles that move.
    pub(super) fn moving(
        &mut self,
        object: &Object,
        triangles: &Triangles,
        material: MaterialId,
        source: SourceId,
    ) {
        let (mesh, middle) = self.keep(triangles);
        let to_middle = DAffine3::from_translation(middle);
        let world_from_mesh = DAffine3::from_translation(-self.center) * object.world_from_object * to_middle;
        let motion = self.motion(object, to_middle);
        self.shapes.instances.push(Instance { mesh, world_from_mesh, material, source, motion });
    }

    /// Adds a part of a mesh to what is shared.
    fn share(&mut self, key: Key, mesh: &Arc<LoadedMesh>, index: usize) -> (usize, DVec3) {
        let (_, scale, smooth) = key;
        let triangles = Triangles::part(&mesh.model.parts[index], f64::from_bits(scale), smooth);
        let shared = self.keep(&triangles);
        self.instances.parts.insert((key, index), shared);
        shared
    }

    /// Keeps triangles in a frame of their own: their number among the shared meshes, and the middle of their box.
    fn keep(&mut self, triangles: &Triangles) -> (usize, DVec3) {
        let (low, high) = triangles
            .positions
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let middle = (low + high) / 2.0;
        let positions: Vec<_> = triangles.positions.iter().map(|&p| (p - middle).as_vec3()).collect();
        let normals = triangles.normals.as_ref().filter(|_| self.is_smooth);
        self.shapes.shared.push(Mesh {
            triangles: object::solid_triangles(&positions, &triangles.indices),
            positions,
            normals: normals.map(|all| all.iter().map(|n| n.as_vec3()).collect()),
            uvs: triangles.uvs.clone(),
            material: MaterialId(0),
            object_from_world: DAffine3::from_translation(middle),
            source: SourceId(0),
        });
        (self.shapes.shared.len() - 1, middle)
    }
}
