//! An arsenal scene as it was meant: what the dialects have in common, with their differences resolved.
//!
//! Lengths are in the file's own unit, angles in degrees, colours linear.

use super::dialect::Detection;
use super::parse::Span;
use crate::math::DVec3;

/// A whole scene.
#[derive(Debug)]
pub struct Scene {
    pub detection: Detection,
    pub camera: Option<Camera>,
    pub background: Background,
    pub lights: Vec<Light>,
    pub materials: Vec<Material>,
    pub objects: Vec<Object>,
    pub settings: Settings,
    /// Whether it is to be shown by Phong's terms, as the original does.
    pub is_classic: bool,
    /// The folders, seen from the scene's, from which its files were found.
    pub asset_roots: Vec<String>,
}

/// What the file says to the renderer.
#[derive(Debug, Default)]
pub struct Settings {
    /// Samples in a pixel.
    pub samples: Option<u32>,
}

/// A camera: a pinhole, a lens or parallel rays.
#[derive(Debug)]
pub struct Camera {
    pub center: DVec3,
    pub direction: DVec3,
    pub up: DVec3,
    pub angle: f64,
    /// The height of what parallel rays see, of a camera that has those rather than an angle.
    pub parallel: Option<f64>,
    /// Whether `angle` is the horizontal field of view rather than the vertical one.
    pub is_across: bool,
    /// The width of a pixel by its height.
    pub pixel_aspect: f64,
    /// Width and height in pixels; some dialects leave them to the command line.
    pub size: Option<(u32, u32)>,
    pub lens: Option<Lens>,
    /// What is to be said of it as a whole, and of the angle.
    pub notes: Vec<String>,
    pub angle_notes: Vec<String>,
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
    /// Light on everything, apart from what is seen; only where Phong's terms are kept.
    pub ambient: DVec3,
    /// A picture of everything around, in its place.
    pub picture: Option<Asset>,
    pub notes: Vec<String>,
}

/// A light of the `Lights` block.
#[derive(Debug)]
pub enum Light {
    /// The original adds `color / (a + b d + e d^2)` at distance d, for `falloff` (a, b, e); in a cone, if it has one.
    Point {
        position: DVec3,
        cone: Option<Cone>,
        color: DVec3,
        falloff: DVec3,
        notes: Vec<String>,
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
        notes: Vec<String>,
    },
    /// `direction` is the way the light travels.
    Directional {
        direction: DVec3,
        color: DVec3,
    },
    /// An object that glows.
    Glowing {
        object: Box<Object>,
        radiance: DVec3,
    },
}

/// Where a spotlight shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The way its middle travels; not zero.
    pub direction: DVec3,
    /// From one edge to the other, in degrees, between 0 and 180.
    pub angle: f64,
    /// The share of the half-angle over which it fades at the edge.
    pub blend: f64,
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
        color: Texture,
        roughness: f64,
    },
    /// GGX with alpha = roughness squared.
    Glass {
        ior: f64,
        tint: DVec3,
        roughness: f64,
    },
    Emissive {
        radiance: DVec3,
    },
    /// The terms of the original, as they are.
    Whitted {
        diffuse: Texture,
        specular: DVec3,
        shininess: f64,
        reflection: DVec3,
        transmission: DVec3,
        ior: f64,
        /// Whether the angle of view shares light between reflection and transmission.
        fresnel: bool,
    },
    /// Lobes with their shares, which are above 0 and add up to 1.
    Mix(Vec<(f64, Look)>),
    /// Two materials of the scene, by their indices, blended by a function of space; evenly without one.
    Solid {
        parts: [usize; 2],
        pattern: Option<Pattern>,
    },
    /// Stands in for a material that is not read.
    Placeholder,
}

impl Look {
    /// The colour that a picture can stand for, of every lobe that has one.
    pub fn textures(&mut self) -> Vec<&mut Texture> {
        match self {
            Self::Diffuse { color } | Self::Mirror { color } | Self::Metal { color, .. } => vec![color],
            Self::Phong { diffuse, .. } | Self::Whitted { diffuse, .. } => vec![diffuse],
            Self::Mix(lobes) => lobes.iter_mut().flat_map(|(_, lobe)| lobe.textures()).collect(),
            Self::Glass { .. } | Self::Emissive { .. } | Self::Solid { .. } | Self::Placeholder => Vec::new(),
        }
    }

    /// The other materials of the scene that it is made of.
    pub fn parts(&self) -> impl Iterator<Item = usize> + use<> {
        let parts = match self {
            Self::Solid { parts, .. } => parts.to_vec(),
            _ => Vec::new(),
        };
        parts.into_iter()
    }

    /// Whether it sends out light.
    pub fn shines(&self) -> bool {
        matches!(self, Self::Emissive { .. })
    }
}

/// A function of space from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// Cells of this size.
    Checker { size: f64 },
    /// Clouds; the largest are as far apart as `size`.
    Noise { size: f64, octaves: u32 },
    /// Veins across x, this far apart and folded by this many of them.
    Marble { size: f64, turbulence: f64 },
    /// Rings around y, this wide and bent by this many of them.
    Wood { size: f64, turbulence: f64 },
}

/// A colour, perhaps with a picture or a pattern in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    pub color: DVec3,
    pub picture: Option<Asset>,
    /// Two colours and what blends them, where there is no picture; `color` is their mean.
    pub blend: Option<([DVec3; 2], Pattern)>,
}

impl Texture {
    pub fn plain(color: DVec3) -> Self {
        Self { color, picture: None, blend: None }
    }

    /// With all of its colours changed.
    pub fn map(self, change: impl Fn(DVec3) -> DVec3) -> Self {
        let blend = self.blend.map(|([a, b], pattern)| ([change(a), change(b)], pattern));
        Self { color: change(self.color), blend, ..self }
    }
}

/// A file that the scene names.
#[derive(Clone, Debug, PartialEq)]
pub struct Asset {
    /// As written, with slashes.
    pub path: String,
    /// Whether the renderer finds it without being told where to look.
    pub beside: bool,
    /// Width and height in pixels, if it is a picture whose header was read.
    pub size: Option<(u32, u32)>,
}

/// A shape with its place and material.
#[derive(Debug)]
pub struct Object {
    pub shape: Shape,
    /// Index into the scene's materials; groups have none of their own.
    pub material: Option<usize>,
    /// A picture for this object alone, in the place of its material's colour.
    pub picture: Option<Asset>,
    /// Applied from first to last.
    pub steps: Vec<Step>,
    pub notes: Vec<String>,
    pub span: Span,
}

impl Object {
    /// The shape where it was written, without material, transform and remarks.
    pub fn new(shape: Shape, span: Span) -> Self {
        Self { shape, material: None, picture: None, steps: Vec::new(), notes: Vec::new(), span }
    }

    /// The picture on a plane, if it has one that is laid out by coordinates.
    pub fn laid_picture(&self) -> Option<&PlanePicture> {
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
    /// A tube without lids.
    Cylinder {
        base: DVec3,
        top: DVec3,
        radius: f64,
    },
    /// A ring around the y axis.
    Torus {
        radius: f64,
        tube: f64,
    },
    Mesh {
        file: Asset,
        /// Whether normals are interpolated; unless it is said, the dialect decides.
        smooth: bool,
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
    /// Straight lines from point to point.
    Polyline,
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
