//! Objects: shapes with their places and materials.

use super::glossary::Glossary;
use super::layout::{Entry, Value};
use super::material::material_value;
use super::picture;
use super::text::{number, point, rounded, rounded_point, string};
use crate::convert::model::{Asset, Curve, Look, Object, Profile, Scene, Shape, Step};
use crate::math::DVec3;

/// The objects in their order.
pub fn entries(objects: &[Object], scene: &Scene, names: &Glossary) -> Vec<Entry> {
    objects.iter().map(|object| entry(object, scene, names)).collect()
}

fn entry(object: &Object, scene: &Scene, names: &Glossary) -> Entry {
    let look = look_of(object, scene);
    let made_of = material_field(object, look, names);
    shown(object, look, made_of, scene, names)
}

/// An object of a light, which glows.
pub fn glowing(object: &Object, glow: Value, scene: &Scene, names: &Glossary) -> Entry {
    let look = Look::Emissive { radiance: DVec3::ONE };
    shown(object, Some(&look), Some(Entry::field("material", glow)), scene, names)
}

fn shown(
    object: &Object,
    look: Option<&Look>,
    made_of: Option<Entry>,
    scene: &Scene,
    names: &Glossary,
) -> Entry {
    let placement: Vec<Entry> = transform_field(object).into_iter().chain(made_of).collect();
    let mut notes = object.notes.clone();
    notes.extend(object.laid_picture().and_then(picture::note));
    let value = match (&object.shape, names.shape(&object.shape)) {
        (Shape::Group(objects), _) => {
            let inner = entries(objects, scene, names);
            Value::Group("group ".into(), placement.into_iter().chain(inner).collect())
        }
        (_, Some(name)) => Value::Block(format!("place {name} "), placement),
        (shape, None) => shape_value(shape, look, placement),
    };
    Entry::item(value).noted(&notes)
}

/// A shape with its own fields and then those of its place. Groups have none of their own.
pub fn shape_value(shape: &Shape, look: Option<&Look>, placement: Vec<Entry>) -> Value {
    let points = |fields: &[(&str, &DVec3)]| -> Vec<Entry> {
        fields.iter().map(|(name, p)| Entry::field(name, point(**p))).collect()
    };
    let (head, mut fields) = match shape {
        Shape::Sphere { center, radius } => {
            let center = Entry::field("center", point(*center));
            ("sphere ", vec![center, Entry::field("radius", number(*radius))])
        }
        Shape::Plane { normal, offset, .. } => ("plane ", plane_fields(*normal, *offset, look)),
        Shape::Triangle { corners: [a, b, c] } => ("triangle ", points(&[("a", a), ("b", b), ("c", c)])),
        Shape::Quad { origin, edge_u, edge_v } => {
            ("quad ", points(&[("origin", origin), ("edge_u", edge_u), ("edge_v", edge_v)]))
        }
        Shape::Disk { center, normal, radius } => {
            let mut fields = points(&[("center", center), ("normal", normal)]);
            fields.push(Entry::field("radius", number(*radius)));
            ("disk ", fields)
        }
        Shape::Cuboid { min, max } => ("box ", points(&[("min", min), ("max", max)])),
        Shape::Cylinder { base, top, radius } => {
            let mut fields = points(&[("base", base), ("top", top)]);
            fields.extend([Entry::field("radius", number(*radius)), Entry::field("caps", "false")]);
            ("cylinder ", fields)
        }
        Shape::Torus { radius, tube } => {
            ("torus ", vec![Entry::field("radius", number(*radius)), Entry::field("tube", number(*tube))])
        }
        Shape::Mesh { file, smooth } => ("mesh ", mesh_fields(file, *smooth)),
        Shape::Revolve { profile } => ("revolve ", vec![Entry::field("profile", profile_value(profile))]),
        Shape::Group(_) => ("group ", Vec::new()),
    };
    fields.extend(placement);
    Value::Block(head.into(), fields)
}

fn transform_field(object: &Object) -> Option<Entry> {
    let steps: Vec<String> = object.steps.iter().map(step).collect(); // applied from left to right
    (!steps.is_empty()).then(|| Entry::field("transform", Value::Chain(steps)))
}

/// The material by its name, or in full where the object has a picture of its own.
fn material_field(object: &Object, look: Option<&Look>, names: &Glossary) -> Option<Entry> {
    let index = object.material?;
    let laid = look.and_then(|look| picture::material(object, look));
    let value = laid.or_else(|| own_picture(object, look?, names));
    Some(Entry::field("material", value.unwrap_or_else(|| names.material(index).into())))
}

/// The object's material with the object's own picture.
fn own_picture(object: &Object, look: &Look, names: &Glossary) -> Option<Value> {
    let mut look = look.clone();
    let mut slots = look.textures();
    let picture = object.picture.as_ref().filter(|_| !slots.is_empty())?;
    for slot in &mut slots {
        slot.picture = Some(picture.clone());
    }
    Some(material_value(&look, names))
}

fn look_of<'a>(object: &Object, scene: &'a Scene) -> Option<&'a Look> {
    Some(&scene.materials.get(object.material?)?.look)
}

/// The normals of the file, if any, are skipped where the original's are flat.
fn mesh_fields(file: &Asset, smooth: bool) -> Vec<Entry> {
    let smooth = if smooth { "true" } else { "false" };
    let mut fields = vec![Entry::field("file", string(&file.path)), Entry::field("smooth", smooth)];
    if !file.beside {
        fields.push(Entry::field("missing", "skip"));
    }
    fields
}

/// `y: 0` where the plane is square to an axis and its sides do not matter, else `normal` and `offset`.
fn plane_fields(normal: DVec3, offset: f64, look: Option<&Look>) -> Vec<Entry> {
    let has_sides = matches!(look, Some(Look::Emissive { .. } | Look::Glass { .. } | Look::Mix { .. }));
    for (axis, n) in [("x", normal.x), ("y", normal.y), ("z", normal.z)] {
        if n == 1.0 || (n == -1.0 && !has_sides) {
            return vec![Entry::field(axis, rounded_or_exact(n * offset))];
        }
    }
    vec![Entry::field("normal", rounded_point(normal)), Entry::field("offset", rounded_or_exact(offset))]
}

/// Short where the file was short, rounded where the number was computed.
fn rounded_or_exact(x: f64) -> String {
    let (exact, short) = (number(x), rounded(x));
    if exact.len() <= short.len() { exact } else { short }
}

/// Four points make one cubic, whichever way they are read.
fn profile_value(profile: &Profile) -> Value {
    let points = profile
        .points
        .iter()
        .map(|&(radius, height)| format!("({}, {})", rounded_or_exact(radius), rounded_or_exact(height)));
    let (open, close) = match profile.kind {
        Curve::Bspline => ("bspline [", "]"),
        Curve::Polyline => ("polyline [", "]"),
        Curve::Bezier if profile.points.len() == 4 => ("bezier [", "]"),
        Curve::Bezier => ("bezier(degree: all, [", "])"),
    };
    Value::List(open.into(), points.collect(), close.into())
}

fn step(step: &Step) -> String {
    match step {
        Step::Scale(by) if by.x == by.y && by.y == by.z => format!("scale({})", number(by.x)),
        Step::Scale(by) => format!("scale{}", point(*by)),
        Step::Translate(by) => format!("translate{}", point(*by)),
        Step::RotateAxis(axis, degrees) => {
            format!("rotate_{}({}deg)", ["x", "y", "z"][*axis], number(*degrees))
        }
        Step::Rotate(axis, degrees) => format!("rotate({}, {}deg)", point(*axis), number(*degrees)),
        Step::Matrix(rows) => format!("matrix([{}])", rows.map(rounded).join(", ")),
    }
}
