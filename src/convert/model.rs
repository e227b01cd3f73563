//! An arsenal scene as it was meant: what the dialects have in common, with their differences resolved.
//!
//! Lengths are in the file's own unit, angles in degrees, colours linear.

use super::dialect::Dialect;
use super::parse::Span;
use crate::math::DVec3;

/// A whole scene.
#[derive(Debug)]
pub struct Scene {
    pub dialect: Dialect,
    pub camera: Option<Camera>,
    pub background: Background,
    pub lights: Vec<Light>,
    pub materials: Vec<Material>,
    pub objects: Vec<Object>,
}

/// A pinhole camera, perhaps with a lens.
#[derive(Debug)]
pub struct Camera {
    pub center: DVec3,
    pub direction: DVec3,
    pub up: DVec3,
    /// The vertical field of view.
    pub angle: f64,
    /// Width and height in pixels; some dialects leave them to the command line.
    pub size: Option<(u32, u32)>,
    pub lens: Option<Lens>,
    pub notes: Vec<String>,
}

/// A thin lens.
#[derive(Debug)]
pub struct Lens {
    pub radius: f64,
    /// The distance in focus, along the view axis.
    pub focus: f64,
    pub note: String,
}

/// What rays see that meet nothing.
#[derive(Debug)]
pub struct Background {
    pub color: DVec3,
    pub notes: Vec<String>,
}

/// A light of the `Lights` block.
#[derive(Debug)]
pub enum Light {
    /// `color` is what the original adds at every distance.
    Point {
        position: DVec3,
        color: DVec3,
    },
    Sphere {
        center: DVec3,
        radius: f64,
        radiance: DVec3,
    },
    Rect {
        origin: DVec3,
        edge_u: DVec3,
        edge_v: DVec3,
        radiance: DVec3,
    },
    /// `direction` is the way the light travels.
    Directional {
        direction: DVec3,
        color: DVec3,
    },
}

/// A material and what is to be said about it.
#[derive(Debug)]
pub struct Material {
    /// Its whole block.
    pub span: Span,
    pub look: Look,
    pub notes: Vec<String>,
}

/// How a surface scatters or emits light.
#[derive(Clone, Debug, PartialEq)]
pub enum Look {
    Diffuse {
        color: Texture,
    },
    Phong {
        diffuse: Texture,
        specular: DVec3,
        shininess: f64,
    },
    Mirror {
        color: Texture,
    },
    /// GGX with alpha = roughness squared.
    Metal {
        color: DVec3,
        roughness: f64,
    },
    Glass {
        ior: f64,
        tint: DVec3,
    },
    Emissive {
        radiance: DVec3,
    },
    /// Weights, not all zero, of a diffuse, a mirror and a glass lobe of one colour.
    Mix {
        weights: [f64; 3],
        color: Texture,
        ior: f64,
    },
    /// Stands in for a material that is not read.
    Placeholder,
}

/// A colour, perhaps with a picture in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    pub color: DVec3,
    pub picture: Option<Asset>,
}

impl Texture {
    pub fn plain(color: DVec3) -> Self {
        Self { color, picture: None }
    }
}

/// A file that the scene names.
#[derive(Clone, Debug, PartialEq)]
pub struct Asset {
    /// As written, with slashes.
    pub path: String,
    /// Whether it is known not to be there.
    pub missing: bool,
    /// Width and height in pixels, if it is a picture whose header was read.
    pub size: Option<(u32, u32)>,
}

/// A shape with its place and material.
#[derive(Debug)]
pub struct Object {
    pub shape: Shape,
    /// Index into the scene's materials; groups have none of their own.
    pub material: Option<usize>,
    /// Applied from first to last.
    pub steps: Vec<Step>,
    pub notes: Vec<String>,
    pub span: Span,
}

impl Object {
    /// The picture on a plane, if it has one.
    pub fn picture(&self) -> Option<&PlanePicture> {
        match &self.shape {
            Shape::Plane { picture, .. } => picture.as_ref(),
            _ => None,
        }
    }

    /// Calls `visit` for every object that is no group, also inside groups. Nesting is bounded by the parser.
    pub fn each<'o>(objects: &'o [Self], visit: &mut dyn FnMut(&'o Self)) {
        for object in objects {
            match &object.shape {
                Shape::Group(inner) => Self::each(inner, visit),
                _ => visit(object),
            }
        }
    }
}

/// A shape in its own frame.
#[derive(Debug)]
pub enum Shape {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    /// The points with `normal . p = offset`; the normal has length 1.
    Plane {
        normal: DVec3,
        offset: f64,
        picture: Option<PlanePicture>,
    },
    Triangle {
        corners: [DVec3; 3],
    },
    /// A parallelogram.
    Quad {
        origin: DVec3,
        edge_u: DVec3,
        edge_v: DVec3,
    },
    Disk {
        center: DVec3,
        normal: DVec3,
        radius: f64,
    },
    Cuboid {
        min: DVec3,
        max: DVec3,
    },
    Mesh {
        file: Asset,
    },
    Revolve {
        profile: Profile,
    },
    Group(Vec<Object>),
}

/// A picture laid on a plane: pixel `(x_axis . p - x_offset, y_axis . p - y_offset)`, from the bottom left.
#[derive(Debug)]
pub struct PlanePicture {
    pub file: Asset,
    pub x_axis: DVec3,
    pub y_axis: DVec3,
    pub x_offset: f64,
    pub y_offset: f64,
}

/// The curve that a surface of revolution is made of.
#[derive(Debug)]
pub struct Profile {
    pub kind: Curve,
    /// Distance from the y axis and height.
    pub points: Vec<(f64, f64)>,
}

/// How control points make a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// One Bezier curve over all points.
    Bezier,
    /// Uniform cubic B-spline.
    Bspline,
}

/// One step of a transform.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    Scale(DVec3),
    Translate(DVec3),
    /// About the x, y or z axis (0, 1, 2), right-handed.
    RotateAxis(usize, f64),
    Rotate(DVec3, f64),
    /// Row-major.
    Matrix([f64; 16]),
}
