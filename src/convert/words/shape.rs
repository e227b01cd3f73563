//! Keys of groups, shapes and transforms.

use super::Args::{Flag, Free, Lists, Maybe, Numbers, Path};
use super::Values::{Number, Vector, Word};
use super::{Index, Vocabulary, row, stem};

/// `Group`.
pub static GROUP: Vocabulary = Vocabulary {
    rows: &[
        row("count", Numbers(1), "numObjects num_objects"),
        row("MaterialIndex", Numbers(1), "MaterialIndex materialIndex"),
        row("material file", Path, "MaterialPreset MaterialFile"),
        row("obj_file", Path, "ObjFile obj_file"),
    ],
    stems: &[stem("count", Number, "num"), stem("material file", Word, "mater preset")],
    index: Index::new(),
};

/// Any one shape.
pub static SHAPE: Vocabulary = Vocabulary {
    rows: &[
        row("center", Numbers(3), "center"),
        row("radius", Numbers(1), "radius"),
        row("normal", Free, "normal norm"),
        row("offset", Free, "offset"),
        row("position", Numbers(3), "position pos"),
        row("origin", Numbers(3), "origin point corner"),
        row("edge u", Numbers(3), "u x edge1 uvec sideOne dir1"),
        row("a", Numbers(3), "a"),
        row("b", Numbers(3), "b"),
        row("edge v", Numbers(3), "v y edge2 vvec sideTwo dir2"),
        row("half edge u", Numbers(3), "x_axis dirX"),
        row("half edge v", Numbers(3), "y_axis dirY"),
        row("axis u", Numbers(3), "U right"),
        row("axis v", Numbers(3), "V"),
        row("half length u", Numbers(1), "LU"),
        row("half length v", Numbers(1), "LV"),
        row("length u", Numbers(1), "width"),
        row("length v", Numbers(1), "height h"),
        row("size", Free, "size"),
        row("up", Numbers(3), "up"),
        row("points", Numbers(4), "points"),
        row("p1", Numbers(3), "vertex0 v0 p1 point1"),
        row("p2", Numbers(3), "vertex1 v1 p2 point2"),
        row("p3", Numbers(3), "vertex2 v2 p3 point3"),
        row("p4", Numbers(3), "vertex3 v3 p4 point4"),
        row("min", Numbers(3), "min_p min minPoint minp lower"),
        row("max", Numbers(3), "max_p max maxPoint maxp upper"),
        row("large radius", Numbers(1), "R"),
        row("small radius", Numbers(1), "r"),
        row("velocity", Numbers(3), "velocity moveVector motion speed"),
        row("center0", Numbers(3), "center0 origCenter"),
        row("center1", Numbers(3), "center1"),
        row("center2", Numbers(3), "center2"),
        row("time", Numbers(1), "time0 time1 time2 tStart tEnd"),
        row("obj_file", Path, "obj_file ObjFile"),
        row("scale", Numbers(1), "scale"),
        row("scaling", Numbers(3), "scaling"),
        row("Y_inverse", Flag, "Y_inverse"),
        row("smooth", Maybe, "smooth Smooth normalInterpolation"),
        row("interpolate", Numbers(1), "interpolate"),
        row("speed-up", Maybe, "use_BVH disableNormalTexture newton step"),
        row("material", Numbers(1), "MaterialIndex materialIndex"),
        row("texture", Path, "texture"),
        row("texture switch", Free, "useTexture"),
        row("x-axis", Numbers(3), "x-axis"),
        row("y-axis", Numbers(3), "y-axis"),
        row("x-offset", Numbers(1), "x-offset"),
        row("y-offset", Numbers(1), "y-offset"),
        row("picture frame", Numbers(3), "e1 e2 left_edge top_edge tex_orin"),
        row("axis", Numbers(3), "axis"),
        row("endpoint", Numbers(3), "endpoint"),
        row("profile", Flag, "profile"),
        row("controls", Lists, "controls"),
    ],
    stems: &[
        stem("velocity", Vector, "velo move motion speed"),
        stem("normal", Vector, "norm"),
        stem("min", Vector, "min"),
        stem("max", Vector, "max"),
        stem("center", Vector, "cent"),
        stem("position", Vector, "pos orig corner point"),
        stem("obj_file", Word, "obj mesh model file path"),
        stem("texture", Word, "tex map image"),
        stem("radius", Number, "radius"),
        stem("scale", Number, "scale"),
    ],
    index: Index::new(),
};

/// `Transform`: each key is an operation, their order matters.
pub static TRANSFORM: Vocabulary = Vocabulary {
    rows: &[
        row("Translate", Numbers(3), "Translate"),
        row("Scale", Numbers(3), "Scale"),
        row("UniformScale", Numbers(1), "UniformScale"),
        row("XRotate", Numbers(1), "XRotate RotateX"),
        row("YRotate", Numbers(1), "YRotate RotateY"),
        row("ZRotate", Numbers(1), "ZRotate RotateZ"),
        row("Rotate", Numbers(4), "Rotate"),
        row("Matrix", Numbers(16), "Matrix"),
        row("Matrix4f", Numbers(16), "Matrix4f"),
        row("MaterialIndex", Numbers(1), "MaterialIndex materialIndex"),
        row("velocity", Numbers(3), "velocity"),
    ],
    stems: &[],
    index: Index::new(),
};

/// `BezierCurve` and `BsplineCurve`.
pub static CURVE: Vocabulary =
    Vocabulary { rows: &[row("controls", Lists, "controls")], stems: &[], index: Index::new() };
