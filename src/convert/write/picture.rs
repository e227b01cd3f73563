//! Pictures that are laid on planes by coordinates, pixel by pixel.

use super::layout::{Entry, Value};
use super::text::{color, number, rounded_point, string};
use crate::convert::model::{Look, Object, PlanePicture, Shape};
use crate::math::DVec3;

/// The sides that a picture is taken to have, in pixels, when its file could not be read.
const NOMINAL_SIZE: (u32, u32) = (1024, 1024);

/// Whether a picture can stand for the colour of such a material; lamps and glass have none that it could replace.
pub fn fits(look: &Look) -> bool {
    matches!(look, Look::Diffuse { .. } | Look::Phong { .. } | Look::Mirror { .. })
}

/// What a person should know of a picture: that its size was guessed.
pub fn note(picture: &PlanePicture) -> Option<String> {
    let (width, height) = NOMINAL_SIZE;
    let path = &picture.file.path;
    let note =
        format!("The size of {path} is not known; {width} x {height} pixels were assumed for `u` and `v`.");
    picture.file.size.is_none().then_some(note)
}

/// The object's material with its picture for the colour, and the colour around the picture; if it has one.
pub fn material(object: &Object, look: &Look) -> Option<Value> {
    let picture = object.laid_picture()?;
    let image = |name, border| {
        Entry::field(name, Value::Block("image ".into(), image_fields(picture, object, border)))
    };
    match look {
        Look::Diffuse { color } => Some(Value::Block("diffuse ".into(), vec![image("color", color.color)])),
        Look::Mirror { color } => Some(Value::Block("mirror ".into(), vec![image("color", color.color)])),
        Look::Phong { diffuse, specular, shininess } => {
            let specular = Entry::field("specular", color(*specular));
            let shininess = Entry::field("shininess", number(*shininess));
            Some(Value::Block("phong ".into(), vec![image("diffuse", diffuse.color), specular, shininess]))
        }
        Look::Glass { .. }
        | Look::Emissive { .. }
        | Look::Mix { .. }
        | Look::Metal { .. }
        | Look::Whitted { .. }
        | Look::Solid { .. }
        | Look::Placeholder => None,
    }
}

/// The image, its place in the plane, and the colour around it.
fn image_fields(picture: &PlanePicture, object: &Object, border: DVec3) -> Vec<Entry> {
    let frame = frame(picture, object);
    let projection =
        ["origin", "u", "v"].iter().zip(frame).map(|(name, p)| Entry::field(name, rounded_point(p)));
    let mut fields = vec![
        Entry::field("file", string(&picture.file.path)),
        Entry::field("projection", Value::Block("planar ".into(), projection.collect())),
        Entry::field("wrap", "border"),
        Entry::field("border", color(border)),
    ];
    if !picture.file.beside {
        fields.push(Entry::field("missing", "skip"));
    }
    fields
}

/// Origin, u and v of the projection that puts pixel `(x . p - xo, y . p - yo)` at p.
///
/// In units of the picture, u = (x . p - xo) / w; a projection has u = (p - o) . U / |U|^2. So U = w x / |x|^2, and the
/// origin solves x . o = xo and y . o = yo. Of its solutions the one in the plane of the picture is taken, which is
/// the picture's corner where both axes lie in the plane.
fn frame(picture: &PlanePicture, object: &Object) -> [DVec3; 3] {
    let (width, height) = picture.file.size.unwrap_or(NOMINAL_SIZE);
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
