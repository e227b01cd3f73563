//! Objects, and the names that they use.

use super::layout::{Entry, Value};
use super::names::{self, Names};
use super::text::{color, number, point, rounded, rounded_point, string};
use super::{material_value, texture_field};
use crate::convert::model::{
    Asset, Curve, Look, Material, Object, PlanePicture, Profile, Scene, Shape, Step, Texture,
};
use crate::math::DVec3;
use crate::math::float::sin_cos64;
use std::collections::{BTreeMap, BTreeSet};

/// The side that a picture is taken to have, in pixels, when its file could not be read.
const NOMINAL_PICTURE: (u32, u32) = (1024, 1024);

/// The names of a scene's materials and of the meshes that stand in it more than once.
pub struct Glossary {
    /// A name for each material, and one more for the index past the last.
    materials: Vec<String>,
    meshes: BTreeMap<String, String>,
}

/// How a scene's objects use its materials and meshes.
#[derive(Default)]
struct Uses {
    /// Materials that objects name.
    named: BTreeSet<usize>,
    /// Materials that only go into the picture on a plane.
    inlined: BTreeSet<usize>,
    /// How often each mesh file is used.
    meshes: BTreeMap<String, usize>,
}

impl Glossary {
    pub fn of(scene: &Scene) -> Self {
        let mut names = Names::default();
        let mut materials: Vec<String> = scene
            .materials
            .iter()
            .enumerate()
            .map(|(index, material)| names.unique(&names::of_look(&material.look, index)))
            .collect();
        materials.push(names.unique("missing_material"));
        let meshes = Uses::of(scene)
            .meshes
            .into_iter()
            .filter(|(_, count)| *count > 1)
            .map(|(path, _)| {
                let name = names.unique(&names::of_mesh(&path));
                (path, name)
            })
            .collect();
        Self { materials, meshes }
    }

    /// The `let` bindings: materials in their order, then the meshes that are placed several times.
    ///
    /// Materials that no object uses are kept as remarks: the compiler would warn about them.
    pub fn bindings(&self, scene: &Scene) -> Vec<Entry> {
        let uses = Uses::of(scene);
        let mut entries = Vec::new();
        let mut said = BTreeSet::new(); // what holds for several materials is said at the first
        for (index, material) in scene.materials.iter().enumerate() {
            let entry = Entry::binding(&self.materials[index], material_value(material));
            if uses.named.contains(&index) {
                let news: Vec<String> =
                    material.notes.iter().filter(|&note| said.insert(note)).cloned().collect();
                entries.push(entry.noted(&news));
            } else if !uses.inlined.contains(&index) {
                entries.push(remark(&entry));
            }
        }
        if uses.named.contains(&scene.materials.len()) {
            let missing = Material {
                span: 0..0,
                look: Look::Placeholder,
                notes: vec!["Its index is past the last material.".into()],
            };
            let name = &self.materials[scene.materials.len()];
            entries.push(Entry::binding(name, material_value(&missing)).noted(&missing.notes));
        }
        let mut files = BTreeMap::new();
        Object::each(&scene.objects, &mut |object| {
            if let Shape::Mesh { file } = &object.shape {
                files.insert(file.path.clone(), file.clone());
            }
        });
        let mesh =
            |(path, name): (&String, &String)| Entry::binding(name, mesh_value(&files[path], Vec::new()));
        entries.extend(self.meshes.iter().map(mesh));
        entries
    }

    fn material(&self, index: usize) -> &str {
        &self.materials[index.min(self.materials.len() - 1)]
    }
}

impl Uses {
    fn of(scene: &Scene) -> Self {
        let mut uses = Self::default();
        Object::each(&scene.objects, &mut |object| {
            if let Shape::Mesh { file } = &object.shape {
                *uses.meshes.entry(file.path.clone()).or_default() += 1;
            }
            if let Some(index) = object.material {
                let look = scene.materials.get(index).map(|material| &material.look);
                let is_inlined = picture_of(object).is_some() && look.is_some_and(takes_picture);
                let set = if is_inlined { &mut uses.inlined } else { &mut uses.named };
                set.insert(index);
            }
        });
        uses
    }
}

/// An unused binding as a comment.
fn remark(entry: &Entry) -> Entry {
    let mut plain = entry.clone();
    plain.notes.clear();
    let text = plain.render(0);
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    Entry { notes: Vec::new(), ..Entry::item(format!("// {} (no object uses it)", lines.join(" "))) }
}

/// The objects in their order.
pub fn entries(objects: &[Object], scene: &Scene, names: &Glossary) -> Vec<Entry> {
    objects.iter().map(|object| entry(object, scene, names)).collect()
}

fn entry(object: &Object, scene: &Scene, names: &Glossary) -> Entry {
    let placement = placement(object, scene, names);
    let shape = |head: &str, own: Vec<Entry>| {
        Value::Block(format!("{head} "), own.into_iter().chain(placement.clone()).collect())
    };
    let mut notes = object.notes.clone();
    let value = match &object.shape {
        Shape::Sphere { center, radius } => {
            let center = Entry::field("center", point(*center));
            shape("sphere", vec![center, Entry::field("radius", number(*radius))])
        }
        Shape::Plane { normal, offset, .. } => {
            if let Some(picture) = picture_of(object) {
                notes.extend(picture_notes(picture));
            }
            shape("plane", plane_fields(*normal, *offset, look_of(object, scene)))
        }
        Shape::Triangle { corners: [a, b, c] } => shape(
            "triangle",
            [("a", a), ("b", b), ("c", c)].map(|(name, p)| Entry::field(name, point(*p))).into(),
        ),
        Shape::Mesh { file } => match names.meshes.get(&file.path) {
            Some(name) => Value::Block(format!("place {name} "), placement),
            None => mesh_value(file, placement),
        },
        Shape::Revolve { profile } => shape("revolve", vec![Entry::field("profile", profile_value(profile))]),
        Shape::Group(objects) => {
            let inner = entries(objects, scene, names);
            Value::Group("group ".into(), placement.into_iter().chain(inner).collect())
        }
    };
    Entry::item(value).noted(&notes)
}

/// The fields that every object has: `transform` and `material`.
fn placement(object: &Object, scene: &Scene, names: &Glossary) -> Vec<Entry> {
    let mut fields = Vec::new();
    if !object.steps.is_empty() {
        let steps = object.steps.iter().map(step).collect(); // applied from left to right
        fields.push(Entry::field("transform", Value::Chain(steps)));
    }
    let is_group = matches!(object.shape, Shape::Group(_));
    let material = object.material.filter(|_| !is_group);
    if let Some(index) = material {
        let value = match (picture_of(object), look_of(object, scene)) {
            (Some(picture), Some(look)) if takes_picture(look) => pictured(picture, object, look),
            _ => names.material(index).into(),
        };
        fields.push(Entry::field("material", value));
    }
    fields
}

fn look_of<'a>(object: &Object, scene: &'a Scene) -> Option<&'a Look> {
    Some(&scene.materials.get(object.material?)?.look)
}

fn mesh_value(file: &Asset, placement: Vec<Entry>) -> Value {
    // The original has flat normals; those of the file, if any, are skipped.
    let mut fields = vec![Entry::field("file", string(&file.path)), Entry::field("smooth", "false")];
    if file.missing {
        fields.push(Entry::field("missing", "skip"));
    }
    fields.extend(placement);
    Value::Block("mesh ".into(), fields)
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

/// The picture on a plane, if it has one.
fn picture_of(object: &Object) -> Option<&PlanePicture> {
    match &object.shape {
        Shape::Plane { picture, .. } => picture.as_ref(),
        _ => None,
    }
}

/// Lamps and glass have no colour that a picture could replace.
fn takes_picture(look: &Look) -> bool {
    matches!(look, Look::Diffuse { .. } | Look::Phong { .. } | Look::Mirror { .. })
}

fn picture_notes(picture: &PlanePicture) -> Vec<String> {
    if picture.file.size.is_some() {
        return Vec::new();
    }
    let (width, height) = NOMINAL_PICTURE;
    vec![format!(
        "The size of {} is not known; {width} x {height} pixels were assumed for `u` and `v`.",
        picture.file.path
    )]
}

/// The plane's material with the picture for its colour, and its colour around the picture.
fn pictured(picture: &PlanePicture, object: &Object, look: &Look) -> Value {
    let image = |border: DVec3| Value::Block("image ".into(), image_fields(picture, object, border));
    match look {
        Look::Phong { diffuse, specular, shininess } => Value::Block(
            "phong ".into(),
            vec![
                Entry::field("diffuse", image(diffuse.color)),
                Entry::field("specular", color(*specular)),
                Entry::field("shininess", number(*shininess)),
            ],
        ),
        Look::Mirror { color } => Value::Block("mirror ".into(), vec![Entry::field("color", image(*color))]),
        Look::Diffuse { color: Texture { color, .. } } => {
            Value::Block("diffuse ".into(), vec![Entry::field("color", image(*color))])
        }
        Look::Glass { .. } | Look::Emissive { .. } | Look::Mix { .. } | Look::Placeholder => {
            Value::Block("diffuse ".into(), vec![texture_field("color", &Texture::plain(DVec3::splat(0.5)))])
        }
    }
}

fn image_fields(picture: &PlanePicture, object: &Object, border: DVec3) -> Vec<Entry> {
    let frame = picture_frame(picture, object);
    let projection =
        ["origin", "u", "v"].iter().zip(frame).map(|(name, p)| Entry::field(name, rounded_point(p)));
    let mut fields = vec![
        Entry::field("file", string(&picture.file.path)),
        Entry::field("projection", Value::Block("planar ".into(), projection.collect())),
        Entry::field("wrap", "border"),
        Entry::field("border", color(border)),
    ];
    if picture.file.missing {
        fields.push(Entry::field("missing", "skip"));
    }
    fields
}

/// Origin, u and v of the projection that puts pixel `(x . p - xo, y . p - yo)` at p.
///
/// In units of the picture, u = (x . p - xo) / w; a projection has u = (p - o) . U / |U|^2. So U = w x / |x|^2, and the
/// origin solves x . o = xo and y . o = yo. Of its solutions the one in the plane of the picture is taken, which is
/// the picture's corner where both axes lie in the plane.
fn picture_frame(picture: &PlanePicture, object: &Object) -> [DVec3; 3] {
    let (width, height) = picture.file.size.unwrap_or(NOMINAL_PICTURE);
    let (x, y) = (picture.x_axis, picture.y_axis);
    let (xx, xy, yy) = (x.dot(x), x.dot(y), y.dot(y));
    let determinant = xx * yy - xy * xy;
    let a = (picture.x_offset * yy - picture.y_offset * xy) / determinant;
    let b = (picture.y_offset * xx - picture.x_offset * xy) / determinant;
    let mut origin = a * x + b * y;
    if let Shape::Plane { normal, offset, .. } = &object.shape {
        let is_across = |axis: DVec3| axis.dot(*normal).abs() <= 1e-9 * axis.length();
        if is_across(x) && is_across(y) {
            origin += *normal * (offset - normal.dot(origin));
        }
    }
    [origin, x * (f64::from(width) / xx), y * (f64::from(height) / yy)]
}

/// Four points make one cubic, whichever way they are read.
fn profile_value(profile: &Profile) -> Value {
    let points =
        profile.points.iter().map(|(radius, height)| format!("({}, {})", number(*radius), number(*height)));
    let (open, close) = match profile.kind {
        Curve::Bspline => ("bspline [", "]"),
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

/// The middle of the box around the middles of all bounded shapes; the origin where there are none.
pub fn middle(objects: &[Object]) -> DVec3 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    middles(objects, &mut Vec::new(), &mut |p| {
        low = low.min(p);
        high = high.max(p);
    });
    if low.is_finite() && high.is_finite() { 0.5 * (low + high) } else { DVec3::ZERO }
}

fn middles<'a>(objects: &'a [Object], outer: &mut Vec<&'a [Step]>, visit: &mut dyn FnMut(DVec3)) {
    for object in objects {
        outer.push(&object.steps);
        let own = match &object.shape {
            Shape::Group(inner) => {
                middles(inner, outer, visit);
                None
            }
            Shape::Plane { .. } => None,
            Shape::Sphere { center, .. } => Some(*center),
            Shape::Triangle { corners: [a, b, c] } => Some((*a + *b + *c) / 3.0),
            Shape::Mesh { .. } => Some(DVec3::ZERO),
            Shape::Revolve { profile } => {
                let heights = || profile.points.iter().map(|point| point.1);
                let sum =
                    heights().fold(f64::INFINITY, f64::min) + heights().fold(f64::NEG_INFINITY, f64::max);
                Some(0.5 * sum * DVec3::Y)
            }
        };
        if let Some(p) = own {
            visit(outer.iter().rev().flat_map(|steps| steps.iter()).fold(p, |p, step| step.apply(p)));
        }
        outer.pop();
    }
}

impl Step {
    /// Where the step takes a point.
    fn apply(&self, p: DVec3) -> DVec3 {
        match self {
            Self::Scale(by) => *by * p,
            Self::Translate(by) => *by + p,
            Self::RotateAxis(axis, degrees) => turn(DVec3::AXES[*axis], *degrees, p),
            Self::Rotate(axis, degrees) => turn(axis.normalize(), *degrees, p),
            Self::Matrix(m) => {
                let row = |i: usize| m[4 * i] * p.x + m[4 * i + 1] * p.y + m[4 * i + 2] * p.z + m[4 * i + 3];
                DVec3::new(row(0), row(1), row(2))
            }
        }
    }
}

/// Rotates p about a unit axis, right-handed (Rodrigues 1840).
fn turn(axis: DVec3, degrees: f64, p: DVec3) -> DVec3 {
    let (sin, cos) = sin_cos64(degrees.to_radians());
    p * cos + axis.cross(p) * sin + axis * (axis.dot(p) * (1.0 - cos))
}
