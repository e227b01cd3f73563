//! Keys of lights and of the background.

use super::Args::{Color, Flag, Free, Numbers, Path};
use super::Values::{Number, Vector, Word};
use super::{Index, Vocabulary, row, stem};

/// `Background`.
pub static BACKGROUND: Vocabulary = Vocabulary {
    rows: &[
        row("color", Color, "color bg_color backgroundColor"),
        row("ambient", Color, "ambientLight ambient am_color ambientColor"),
        row("cube map", Path, "cubeMap cubemap skybox"),
        row("picture", Path, "texture image envMap environment hdr"),
    ],
    stems: &[
        stem("ambient", Vector, "amb"),
        stem("color", Vector, "col sky bg"),
        stem("cube map", Word, "cube box"),
        stem("picture", Word, "tex map env image sky hdr file"),
    ],
    index: Index::new(),
};

/// `Lights` and blocks of one kind of light.
pub static LIGHTS: Vocabulary = Vocabulary {
    rows: &[
        row("count", Numbers(1), "numLights numDiskLights numSurfaceLights num_lights"),
        row("MaterialIndex", Numbers(1), "MaterialIndex"),
        row("setting", Free, "maxNearbyDist_square maxNearbyPhoton"),
    ],
    stems: &[stem("count", Number, "num")],
    index: Index::new(),
};

/// Any one light. `u` and `v` are edges or half edges, see the reader.
pub static LIGHT: Vocabulary = Vocabulary {
    rows: &[
        row("position", Free, "position center pos location dposition origin"),
        row("corner", Numbers(3), "corner"),
        row("direction", Numbers(3), "direction dir"),
        row("normal", Free, "normal norm"),
        row("color", Color, "color emitColor lightColor radiance Le"),
        row("emission", Free, "emission"),
        row("factor", Free, "flux brightness power intensity scale energy strength multiplier"),
        row("attenuation", Numbers(3), "attenuation"),
        row("falloff", Numbers(1), "falloff"),
        row("radius", Numbers(1), "radius"),
        row("spread", Numbers(1), "angle outerAngle maxAngle falloffDegree cutoff cutOff outerCutOff"),
        row("inner spread", Numbers(1), "innerAngle innerCutOff"),
        row("whole spread", Numbers(1), "falloffAngle"),
        row("whole inner spread", Numbers(1), "hotspotAngle"),
        row("exponent", Numbers(1), "exponent"),
        row("area", Numbers(1), "area"),
        row("size", Free, "size"),
        row("edge u", Numbers(3), "dir1 uvec edge1 sideOne u"),
        row("edge v", Numbers(3), "dir2 vvec edge2 sideTwo v"),
        row("half edge u", Numbers(3), "x_axis dirX"),
        row("half edge v", Numbers(3), "y_axis dirY"),
        row("axis u", Numbers(3), "U right left"),
        row("axis v", Numbers(3), "V"),
        row("half length u", Numbers(1), "LU"),
        row("half length v", Numbers(1), "LV"),
        row("length u", Numbers(1), "dx x_len width"),
        row("length v", Numbers(1), "dy y_len height"),
        row("up", Numbers(3), "up"),
        row("p1", Numbers(3), "p1 vertex0 point1 A"),
        row("p2", Numbers(3), "p2 vertex1 point2 B"),
        row("p3", Numbers(3), "p3 vertex2 point3 C"),
        row("p4", Numbers(3), "p4 vertex3 point4 D"),
        row("range x", Free, "X"),
        row("range y", Free, "Y"),
        row("range z", Free, "Z"),
        row("obj_file", Path, "obj_file mesh obj objFile"),
        row("two_sided", Flag, "DoubleSided"),
        row("setting", Free, "photonAmount samples numSamples sampleNum photons"),
    ],
    stems: &[
        stem("direction", Vector, "dir"),
        stem("normal", Vector, "norm"),
        stem("color", Vector, "col emi rad flux intens power"),
        stem("position", Vector, "pos cent orig loc"),
        stem("factor", Number, "intens power bright flux energy scale strength emi"),
        stem("radius", Number, "rad"),
        stem("spread", Number, "ang cut"),
        stem("setting", Number, "sampl photon num"),
        stem("obj_file", Word, "obj mesh file"),
    ],
    index: Index::new(),
};
