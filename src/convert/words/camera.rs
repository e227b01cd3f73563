//! Keys of cameras.

use super::Args::{Free, Numbers};
use super::Values::{Number, Vector};
use super::{Index, Vocabulary, row, stem};

/// `PerspectiveCamera`, `OrthographicCamera` and their relatives. The keys of lenses are their own roles, for what they
/// mean depends on which of them stand together.
pub static CAMERA: Vocabulary = Vocabulary {
    rows: &[
        row("center", Numbers(3), "center position eye"),
        row("direction", Numbers(3), "direction"),
        row("target", Numbers(3), "lookAt lookat target"),
        row("up", Numbers(3), "up"),
        row("angle", Numbers(1), "angle fov fovy"),
        row("angle across", Numbers(1), "w-angle angle1 fovx"),
        row("angle upwards", Numbers(1), "h-angle angle2"),
        row("width", Numbers(1), "width"),
        row("height", Numbers(1), "height"),
        row("size", Numbers(1), "size"),
        row("focal", Numbers(1), "focal"),
        row("focalLength", Numbers(1), "focalLength"),
        row("focal_length", Numbers(1), "focal_length"),
        row("focus", Numbers(1), "focus"),
        row("focusDist", Numbers(1), "focusDist"),
        row("focusDistance", Numbers(1), "focusDistance focalDistance"),
        row("focus_distance", Numbers(1), "focus_distance focal_distance"),
        row("focusPoint", Free, "focusPoint"),
        row("distance", Numbers(1), "distance"),
        row("dist", Numbers(1), "dist"),
        row("aperture", Numbers(1), "aperture"),
        row("aperture_size", Numbers(1), "aperture_size"),
        row("radius", Numbers(1), "radius"),
        row("lens_radius", Numbers(1), "lens_radius len_radius lensRadius"),
        row("lenRadius", Numbers(1), "lenRadius"),
        row("field", Numbers(1), "field"),
        row("defocusAngle", Numbers(1), "defocusAngle"),
        row("isDOF", Numbers(1), "isDOF"),
        row(
            "setting",
            Free,
            "photons maxNearbyPhoton maxNearbyDist_square sppm_iterate samples spp gamma lenSampleNum fstop \
             f_a f_u aspect scaling depth",
        ),
        row("time", Numbers(1), "tStart tEnd time0 time1 time2 start end shutter shutterOpen shutterClose"),
    ],
    stems: &[
        stem("target", Vector, "look target"),
        stem("direction", Vector, "dir forward view"),
        stem("up", Vector, "up"),
        stem("center", Vector, "cent pos eye origin from"),
        stem("angle", Number, "fov angle"),
        stem("width", Number, "width resx"),
        stem("height", Number, "height resy"),
        stem("focus_distance", Number, "focus focal"),
        stem("lens_radius", Number, "lensradius lenradius apert"),
    ],
    index: Index::new(),
};
