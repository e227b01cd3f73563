//! Objects as values, and how they come into the picture.

use super::budget::{GROUPS, Limit};
use super::error::Error;
use super::{Resolver, Value};
use crate::ir::light::Daylight;
use crate::ir::{self, Handle, LightKind, TransformStep};
use crate::math::{DAffine3, Motion};
use crate::source::{Span, Spanned};
use std::cell::Cell;
use std::rc::Rc;

/// An object that may be placed any number of times.
pub struct Node {
    pub kind: NodeKind,
    /// Its own factors, applied from first to last.
    pub transform: Rc<[TransformStep]>,
    /// What its block or its `place` says it is made of.
    pub material: Option<Handle<ir::Material>>,
    /// Where it was written.
    pub span: Span,
    /// How many nodes are inside each other, this one counted.
    pub depth: u32,
    /// How many objects and groups come into the picture with it; known before any does, for groups of groups of groups
    /// are quickly written.
    pub count: u64,
}

/// The kinds of nodes.
pub enum NodeKind {
    /// A shape, which comes into the scene's list with the first object that has it.
    Shape(Box<ir::Shape>, Cell<Option<Handle<ir::Shape>>>),
    Light(Box<ir::Light>),
    Group(Vec<Rc<Node>>),
    /// A placed object: its own material gives way to that of the `place`.
    Place(Rc<Node>),
    /// An object under a name that `on NAME` finds.
    Named(Rc<Node>, u32),
}

/// What surrounds a node on its way into the picture.
#[derive(Clone)]
struct Surroundings<'n> {
    world: DAffine3,
    /// What surrounds the place or group around it, with that.
    outside: Option<(&'n Surroundings<'n>, &'n Node)>,
    /// What a `place` around it says, against the node's own material.
    forced: Option<Handle<ir::Material>>,
    /// What a group around it says, for nodes without a material.
    fallback: Option<Handle<ir::Material>>,
    /// The innermost `place` around it.
    placed: Option<Span>,
    /// The first motion around it.
    moves: Option<Span>,
    /// Places and groups around it, the outermost first.
    trail: Vec<Span>,
    names: Vec<u32>,
}

impl Node {
    /// `node`, found by `on NAME` as this name.
    pub fn named(node: Rc<Self>, id: u32, span: Span) -> Rc<Self> {
        let (depth, count) = (node.depth, node.count);
        let kind = NodeKind::Named(node, id);
        Rc::new(Self { kind, transform: Rc::new([]), material: None, span, depth, count })
    }

    /// The id of its outermost name.
    pub fn name(&self) -> Option<u32> {
        match &self.kind {
            NodeKind::Named(_, id) => Some(*id),
            _ => None,
        }
    }

    fn inner(&self) -> &[Rc<Self>] {
        match &self.kind {
            NodeKind::Group(members) => members,
            NodeKind::Place(node) | NodeKind::Named(node, _) => std::slice::from_ref(node),
            NodeKind::Shape(..) | NodeKind::Light(_) => &[],
        }
    }
}

impl<'a> Resolver<'a> {
    /// A node, unless too many are inside each other.
    pub(super) fn node(
        &mut self,
        kind: NodeKind,
        transform: Rc<[TransformStep]>,
        material: Option<Handle<ir::Material>>,
        span: Span,
    ) -> Option<Rc<Node>> {
        let own = u64::from(!matches!(kind, NodeKind::Place(_) | NodeKind::Named(..)));
        let mut node = Node { kind, transform, material, span, depth: 0, count: own };
        node.count = node.inner().iter().fold(own, |sum, inner| sum.saturating_add(inner.count));
        node.depth = 1 + node.inner().iter().map(|inner| inner.depth).max().unwrap_or(0);
        if node.depth > GROUPS {
            let help = "put fewer groups into each other".to_owned();
            self.over("objects inside objects", GROUPS.into(), span, help);
            return None;
        }
        Some(Rc::new(node))
    }

    /// Puts a node into the picture.
    pub(super) fn emit(&mut self, node: &Node) {
        if !self.spend(Limit::Objects, node.count, node.span) {
            return;
        }
        let outside = Surroundings {
            world: DAffine3::IDENTITY,
            outside: None,
            forced: None,
            fallback: None,
            placed: None,
            moves: None,
            trail: Vec::new(),
            names: Vec::new(),
        };
        self.emit_in(node, &outside);
    }

    fn emit_in(&mut self, node: &Node, around: &Surroundings<'_>) {
        match &node.kind {
            NodeKind::Shape(shape, handle) => self.emit_shape(shape, handle, node, around),
            NodeKind::Light(light) => self.emit_light(light, around),
            NodeKind::Group(members) => {
                let mut inside = around.with(node);
                inside.fallback = node.material.or(around.fallback);
                members.iter().for_each(|member| self.emit_in(member, &inside));
            }
            NodeKind::Place(placed) => {
                let mut inside = around.with(node);
                inside.forced = around.forced.or(node.material);
                inside.placed = Some(node.span);
                self.emit_in(placed, &inside);
            }
            NodeKind::Named(named, id) => {
                self.count_placement(*id, around.placed.unwrap_or(named.span));
                let mut inside = around.clone();
                inside.names.push(*id);
                self.emit_in(named, &inside);
            }
        }
    }

    fn count_placement(&mut self, id: u32, span: Span) {
        let named = &mut self.scene.names[id as usize];
        named.count += 1;
        // Two are enough to show that there is more than one.
        if named.placed.len() < 2 {
            named.placed.push(span);
        }
    }

    fn emit_shape(
        &mut self,
        shape: &ir::Shape,
        handle: &Cell<Option<Handle<ir::Shape>>>,
        node: &Node,
        around: &Surroundings<'_>,
    ) {
        let shapes = &mut self.scene.shapes;
        let shape_handle = handle.get().unwrap_or_else(|| shapes.push(shape.clone()));
        handle.set(Some(shape_handle));
        let world_from_object = around.world * compose(&node.transform);
        let transforms = if ir::is_singular(&world_from_object) || ir::is_squeezing(&world_from_object) {
            node.transform.iter().copied().chain(around.steps()).collect()
        } else {
            Vec::new()
        };
        let motion = ir::first_moving(&node.transform).or(around.moves).and_then(|span| {
            let factors = node.transform.iter().copied().chain(around.steps()).map(|step| step.factor);
            Some(Spanned::new(Motion::new(factors)?, span))
        });
        self.scene.objects.push(ir::Object {
            shape: shape_handle,
            material: around.forced.or(node.material).or(around.fallback),
            world_from_object,
            motion,
            transforms,
            span: around.placed.unwrap_or(node.span),
            trail: around.trail_without_innermost_place(),
            names: around.names.clone(),
        });
    }

    fn emit_light(&mut self, light: &ir::Light, around: &Surroundings<'_>) {
        let Some(kind) = self.moved(light, around) else { return };
        let trail = around.trail.iter().rev().copied().collect();
        self.scene.lights.push(ir::Light { kind, trail, moves: around.moves, ..light.clone() });
    }

    /// The light in world space.
    fn moved(&mut self, light: &ir::Light, around: &Surroundings<'_>) -> Option<LightKind> {
        let world = around.world;
        Some(match light.kind {
            LightKind::Point { position, falloff } => {
                LightKind::Point { position: world.transform_point3(position), falloff }
            }
            LightKind::Sphere { center, radius } => {
                let Some(scale) = uniform_scale(&world) else {
                    let transform = around.steps().next().map(|step| step.span);
                    self.report(Error::UnevenLight { light: light.span, transform });
                    return None;
                };
                let radius = Spanned::new(radius.value * scale, radius.span);
                LightKind::Sphere { center: world.transform_point3(center), radius }
            }
            LightKind::Rect { origin, edge_u, edge_v, two_sided } => {
                // Mirroring turns a cross product over: trading the edges keeps the side that shines.
                let mirrored = world.matrix3.determinant() < 0.0;
                let (u, v) = (world.transform_vector3(edge_u), world.transform_vector3(edge_v));
                let (edge_u, edge_v) = if mirrored { (v, u) } else { (u, v) };
                LightKind::Rect { origin: world.transform_point3(origin), edge_u, edge_v, two_sided }
            }
            LightKind::Spot { position, direction, angle, blend, falloff } => LightKind::Spot {
                position: world.transform_point3(position),
                direction: direction.map(|d| world.transform_vector3(d)),
                angle,
                blend,
                falloff,
            },
            LightKind::Disk { center, edge_u, edge_v, radius, two_sided } => {
                let mirrored = world.matrix3.determinant() < 0.0;
                let (u, v) = (world.transform_vector3(edge_u), world.transform_vector3(edge_v));
                let (edge_u, edge_v) = if mirrored { (v, u) } else { (u, v) };
                LightKind::Disk { center: world.transform_point3(center), edge_u, edge_v, radius, two_sided }
            }
            LightKind::SunSky(ref day) => LightKind::SunSky(Daylight {
                to_sun: day.to_sun.map(|d| world.transform_vector3(d)),
                ..day.clone()
            }),
            LightKind::Directional { direction } => {
                LightKind::Directional { direction: direction.map(|d| world.transform_vector3(d)) }
            }
        })
    }
}

impl<'n> Surroundings<'n> {
    /// What surrounds the parts of `node`.
    fn with(&'n self, node: &'n Node) -> Self {
        let mut inside = Self { outside: Some((self, node)), ..self.clone() };
        if !node.transform.is_empty() {
            inside.world = self.world * compose(&node.transform);
            inside.moves = ir::first_moving(&node.transform).or(self.moves);
        }
        inside.trail.push(node.span);
        inside
    }

    /// Factors around it, the innermost first.
    fn steps(&self) -> impl Iterator<Item = TransformStep> {
        let around = std::iter::successors(self.outside, |(outside, _)| outside.outside);
        around.flat_map(|(_, node)| node.transform.iter().copied())
    }

    /// The way here, the innermost first; the innermost `place` is where the object itself points.
    fn trail_without_innermost_place(&self) -> Vec<Span> {
        self.trail.iter().rev().copied().filter(|&span| Some(span) != self.placed).collect()
    }
}

/// The product of factors that are applied from first to last.
pub fn compose(steps: &[TransformStep]) -> DAffine3 {
    steps.iter().fold(DAffine3::IDENTITY, |product, step| step.matrix() * product)
}

/// The factor by which all lengths grow, unless they grow differently.
fn uniform_scale(world: &DAffine3) -> Option<f64> {
    /// Rotations of a few factors stay within this of perfect.
    const ROUNDING: f64 = 1e-9;
    let m = world.matrix3;
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let scale = x.length();
    let even = |a: f64, b: f64| (a - b).abs() <= ROUNDING * scale * scale;
    let square = even(x.dot(y), 0.0) && even(y.dot(z), 0.0) && even(z.dot(x), 0.0);
    let same = even(y.length_squared(), scale * scale) && even(z.length_squared(), scale * scale);
    (square && same).then_some(scale)
}

/// The transform that a field holds, or none.
pub fn steps_of(value: Option<&Value>) -> Rc<[TransformStep]> {
    match value {
        Some(Value::Transform(steps)) => Rc::clone(steps),
        _ => Rc::new([]),
    }
}
