//! Where things are: what is inside of what, what stands before what, and what nothing can reach.
//!
//! All of it is doubt, and only what is certain is said: a region that may stick out of a solid is not inside of it. What
//! loops place is doubted only where all of it is doubtful.

mod aim;
mod caustics;
mod error;
mod glass;
mod region;
mod room;
mod solid;
mod stuff;
mod surface;
mod view;

use super::{Check, Checked};
use crate::diag::Problems;
use crate::ir::{Handle, LightKind, Method, Object, Scene, Shape, ShapeKind};
use crate::math::{DVec3, Vec3};
use crate::source::Span;
use error::SpaceError;
use region::Extent;
pub use region::Region;
use rustc_hash::FxHashMap;
use solid::Solid;
use std::rc::Rc;
use stuff::{Stuff, Stuffs};
use surface::Surface;

/// Scenes with more objects than this are not surveyed: it would take longer than to render them.
const MOST_OBJECTS: usize = 50_000;

/// The triangles of meshes, for whoever has read them.
pub trait Meshes {
    /// The parts of a mesh; none when it was left out.
    fn parts(&self, shape: Handle<Shape>) -> Vec<MeshPart<'_>>;
}

/// Triangles of one material.
#[derive(Clone, Copy, Debug)]
pub struct MeshPart<'a> {
    /// Vertices in the file's units.
    pub positions: &'a [Vec3],
    /// Three vertex indices each.
    pub triangles: &'a [[u32; 3]],
    /// What the file says that it is made of.
    pub own: OwnMaterial,
}

/// What a mesh file says of a material, as far as it matters for where light can go.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum OwnMaterial {
    /// Lets no light through.
    Opaque,
    /// Lets light through into a body.
    Clear,
    /// Lets light through and has no inside: a pane, or what has holes.
    Pierced,
    /// Shines.
    Shining,
}

/// A scene without meshes.
pub(super) struct NoMeshes;

impl Meshes for NoMeshes {
    fn parts(&self, _: Handle<Shape>) -> Vec<MeshPart<'_>> {
        Vec::new()
    }
}

/// Notes what is doubtful about the places of things in a scene with meshes; in one without, [`check`](super::check) did.
pub fn survey(scene: &Checked, meshes: &dyn Meshes, problems: &mut Problems) {
    if scene.is_sound && places_meshes(scene) {
        let mut check = Check::new(scene, problems, true);
        check.moving_meshes(meshes);
        check.survey(meshes);
    }
}

/// What holds an object in its place; `None` for what has no end and for meshes that were left out.
pub fn region(object: &Object, scene: &Scene, meshes: &dyn Meshes) -> Option<Region> {
    let kind = &scene.shapes[object.shape].kind;
    let corners = || {
        let parts = meshes.parts(object.shape);
        Extent::of(parts.iter().flat_map(|part| corners(part, kind)).flatten())
    };
    Some(Region::of_shape(kind, corners)?.placed(object, longest_shutter(scene)))
}

/// The largest share of a frame for which one of the cameras looks.
fn longest_shutter(scene: &Scene) -> f64 {
    scene.cameras.iter().map(|camera| camera.shutter.value).fold(0.0, f64::max)
}

/// Notes the caustics that path tracing misses; `asked` is where the scene asks for that method, `None` where the command
/// does.
pub fn paths_miss(scene: &Scene, meshes: &dyn Meshes, asked: Option<Span>, problems: &mut Problems) {
    if scene.objects.len() <= MOST_OBJECTS {
        let missed = Survey::of(scene, meshes).caustics(asked);
        missed.into_iter().for_each(|doubt| problems.push(doubt));
    }
}

/// Whether some object is a mesh, so that a survey has to wait for its file.
pub(super) fn places_meshes(scene: &Scene) -> bool {
    scene.objects.iter().any(|object| matches!(scene.shapes[object.shape].kind, ShapeKind::Mesh { .. }))
}

/// Whether some object is a mesh in its own materials, which may shine.
pub(super) fn may_bring_light(scene: &Scene) -> bool {
    let is_unpainted = |object: &Object| {
        let shape = &scene.shapes[object.shape];
        matches!(shape.kind, ShapeKind::Mesh { .. }) && object.material.or(shape.material).is_none()
    };
    scene.objects.iter().any(is_unpainted)
}

impl Check<'_> {
    /// Notes what is doubtful about the places of things.
    pub(super) fn survey(&mut self, meshes: &dyn Meshes) {
        if self.scene.objects.len() > MOST_OBJECTS {
            return;
        }
        if may_bring_light(self.scene) {
            self.any_light(meshes);
        }
        let mut survey = Survey::of(self.scene, meshes);
        let is_classic = self.scene.render.method.is_some_and(|method| method.value == Method::Classic);
        let mut doubts = vec![survey.glass(), survey.open_glass(meshes), survey.views()];
        if is_classic {
            // There light may go through everything, and depth counts otherwise: only what is seen is certain.
            survey.lamps.clear();
        } else {
            doubts.extend([survey.aims(), survey.short_paths()]);
        }
        doubts.push(survey.rooms());
        doubts.into_iter().flatten().for_each(|doubt| self.report(doubt));
    }
}

/// Everything in its place.
struct Survey<'a> {
    scene: &'a Scene,
    things: Vec<Thing<'a>>,
    lamps: Vec<Lamp>,
    /// Where light enters each camera.
    eyes: Vec<Region>,
}

/// An object in its place.
struct Thing<'a> {
    object: &'a Object,
    kind: &'a ShapeKind,
    /// What holds it; `None` for endless planes.
    region: Option<Region>,
    /// Whether the scene gives it a material; otherwise a mesh brings its own.
    is_painted: bool,
    /// What it is made of.
    stuff: Stuff,
    /// Its inside, if it surely has one.
    solid: Option<Solid>,
    /// Whether it moves while a shutter is open.
    moves: bool,
}

/// A light in its place, and the place that wrote it.
struct Lamp {
    reach: Reach,
    span: Span,
}

/// Where light comes from.
#[derive(Clone, PartialEq, Debug)]
enum Reach {
    /// From here.
    Here(Region),
    /// From infinitely far, in this direction.
    Far(DVec3),
    /// From infinitely far, all around.
    Around,
}

impl Reach {
    /// The box around what is not infinitely far.
    fn extent(&self) -> Option<Extent> {
        if let Self::Here(region) = self { Some(region.extent()) } else { None }
    }
}

impl<'a> Survey<'a> {
    fn of(scene: &'a Scene, meshes: &dyn Meshes) -> Self {
        let mut gathering = Gathering {
            scene,
            meshes,
            stuffs: Stuffs::of(scene),
            surfaces: FxHashMap::default(),
            shutter: longest_shutter(scene),
        };
        let things: Vec<Thing> = scene.objects.iter().filter_map(|object| gathering.thing(object)).collect();
        let mut lamps: Vec<Lamp> = scene.lights.iter().filter_map(lamp).collect();
        let shining = things.iter().filter(|thing| thing.stuff.shines);
        lamps.extend(shining.filter_map(|thing| {
            Some(Lamp { reach: Reach::Here(thing.region.clone()?), span: thing.object.span })
        }));
        let lit = scene.environment.as_ref().filter(|environment| environment.is_lit());
        lamps.extend(lit.map(|environment| Lamp { reach: Reach::Around, span: environment.span }));
        Self { scene, things, lamps, eyes: scene.cameras.iter().map(Region::of_camera).collect() }
    }
}

fn lamp(light: &crate::ir::Light) -> Option<Lamp> {
    let reach = match light.kind {
        LightKind::Directional { direction } => Reach::Far(-direction.value.try_normalize()?),
        LightKind::SunSky(_) => Reach::Around,
        ref kind => Reach::Here(Region::of_light(kind)?),
    };
    Some(Lamp { reach, span: light.span })
}

/// What is at hand while the objects are gathered.
struct Gathering<'a, 'b> {
    scene: &'a Scene,
    meshes: &'b dyn Meshes,
    stuffs: Stuffs,
    /// The closed surfaces of meshes by shape, so that those placed often are welded once.
    surfaces: FxHashMap<usize, Option<Rc<Surface>>>,
    /// The longest that a shutter is open.
    shutter: f64,
}

impl<'a> Gathering<'a, '_> {
    /// `None` for a mesh that was left out.
    fn thing(&mut self, object: &'a Object) -> Option<Thing<'a>> {
        let shape = &self.scene.shapes[object.shape];
        let parts = self.meshes.parts(object.shape);
        if matches!(shape.kind, ShapeKind::Mesh { .. }) && parts.is_empty() {
            return None;
        }
        let own = parts.iter().map(|part| part.own);
        let written = object.material.or(shape.material);
        let stuff = match written {
            Some(material) => self.stuffs.get(material),
            None => Stuff::of_own(own),
        };
        let corners = || Extent::of(parts.iter().flat_map(|part| corners(part, &shape.kind)).flatten());
        let region = Region::of_shape(&shape.kind, corners);
        let region = region.map(|region| region.placed(object, self.shutter));
        // Of what moves nothing is certain that is true of a moment: it is no wall, and has no inside.
        let moves = object.motion.is_some() && self.shutter > 0.0;
        let stuff = Stuff { is_opaque: stuff.is_opaque && !moves, ..stuff };
        let wanted = stuff.is_opaque || stuff.clear.is_some();
        let solid = (wanted && !moves).then(|| self.solid(object, &shape.kind, &parts)).flatten();
        Some(Thing { object, kind: &shape.kind, region, is_painted: written.is_some(), stuff, solid, moves })
    }

    fn solid(&mut self, object: &Object, kind: &ShapeKind, parts: &[MeshPart<'_>]) -> Option<Solid> {
        let surfaces = &mut self.surfaces;
        Solid::of(kind, &object.world_from_object, || {
            let surface = surfaces.entry(object.shape.index());
            surface.or_insert_with(|| closed_surface(parts, kind).map(Rc::new)).clone()
        })
    }
}

/// What the positions of a mesh are multiplied by; 1 of all else.
fn scale(kind: &ShapeKind) -> f64 {
    if let ShapeKind::Mesh { scale, .. } = kind { scale.value } else { 1.0 }
}

/// The triangles of a part of a mesh, in the shape's frame.
fn corners<'a>(part: &MeshPart<'a>, kind: &ShapeKind) -> impl Iterator<Item = [DVec3; 3]> + use<'a> {
    let scale = scale(kind);
    let positions = part.positions;
    part.triangles.iter().map(move |t| t.map(|i| positions[i as usize].as_dvec3() * scale))
}

/// The surface of a mesh, if it is closed: as it is, or with its triangles turned one way.
fn closed_surface(parts: &[MeshPart<'_>], kind: &ShapeKind) -> Option<Surface> {
    let surface = Surface::of_parts(parts, scale(kind));
    let seams = surface.seams();
    match (seams.open, seams.mixed) {
        (0, 0) => Some(surface),
        (0, _) => match surface.closed_parts().as_slice() {
            [(whole, _)] if whole.triangle_count() == surface.triangle_count() => Some(whole.clone()),
            _ => None,
        },
        _ => None,
    }
}

/// The plane of an object that is endless and stands still: its normal in the world, and the distance along it.
fn plane_of(thing: &Thing<'_>) -> Option<(DVec3, f64)> {
    let ShapeKind::Plane { normal, offset } = thing.kind else { return None };
    if thing.moves {
        return None;
    }
    let world_from_object = &thing.object.world_from_object;
    // Normals go by the inverse transpose.
    let to_world = world_from_object.matrix3.inverse().transpose();
    let n = (to_world * normal.value).try_normalize()?;
    let p = world_from_object.transform_point3(normal.value * *offset / normal.value.length_squared());
    Some((n, n.dot(p)))
}

/// The spans of things of which every one that was placed there is in doubt, with what was said of the first.
fn all_of_them<T>(things: impl Iterator<Item = (Span, Option<T>)>) -> Vec<(Span, T)> {
    let mut order = Vec::new();
    let mut said: FxHashMap<(u32, u32), Option<T>> = FxHashMap::default();
    for (span, doubt) in things {
        let key = (span.start, span.end);
        match said.entry(key) {
            std::collections::hash_map::Entry::Vacant(entry) => {
                order.push(span);
                entry.insert(doubt);
            }
            std::collections::hash_map::Entry::Occupied(mut entry) if doubt.is_none() => {
                entry.insert(None);
            }
            std::collections::hash_map::Entry::Occupied(_) => {}
        }
    }
    order
        .into_iter()
        .filter_map(|span| Some((span, said.remove(&(span.start, span.end)).flatten()?)))
        .collect()
}
