//! What the programs of the family mean by the keys of their lenses.

use crate::math::float::tan64;

/// A pair of keys that means a focus distance and the opening of a lens.
#[derive(Clone, Copy)]
pub struct Rule {
    /// A part of the camera's name, for cameras that measure in their own way.
    pub camera: &'static str,
    pub focus: &'static str,
    pub opening: &'static str,
    /// Whether the opening stands before the distance; one program that writes it so means another size.
    pub opening_first: Option<bool>,
    /// The distance in focus, from what is written and the distance of the camera from the origin.
    pub distance: fn(f64, f64) -> f64,
    /// The radius of a round lens that blurs as much, from opening and focus distance.
    pub radius: fn(f64, f64) -> f64,
    pub note: &'static str,
}

const AS_WRITTEN: fn(f64, f64) -> f64 = |distance, _| distance;

/// A square of half side a blurs like a disc of its area, of radius 2a / sqrt(pi).
pub const DISC_OF_SQUARE: f64 = std::f64::consts::FRAC_2_SQRT_PI;

/// A rule for cameras of any name and keys in any order.
pub const fn rule(
    focus: &'static str,
    opening: &'static str,
    radius: fn(f64, f64) -> f64,
    note: &'static str,
) -> Rule {
    Rule { camera: "", focus, opening, opening_first: None, distance: AS_WRITTEN, radius, note }
}

/// What the programs of the family mean by their pairs of keys; the first that fits counts. None of the distances is a
/// focal length.
pub const RULES: &[Rule] = &[
    Rule {
        camera: "DepthCamera",
        distance: |written, _| written + 1.0,
        ..rule(
            "focalLength",
            "aperture",
            |width, _| 0.5 * width,
            "a round lens of this diameter, evenly open; the original's is denser at the centre, and focused 1 \
             further than it says",
        )
    },
    rule(
        "focalLength",
        "aperture",
        |half_side, _| DISC_OF_SQUARE * half_side,
        "a round lens of the area of the original's square one",
    ),
    Rule {
        opening_first: Some(true),
        ..rule(
            "focus",
            "aperture",
            |width, _| 0.5 * width,
            "a round lens of this diameter; the original's is open at its rim only",
        )
    },
    rule(
        "focus",
        "aperture",
        |half_side, _| DISC_OF_SQUARE * half_side,
        "a round lens of the area of the original's square one",
    ),
    rule(
        "focal_length",
        "aperture_size",
        |side, _| 0.5 * DISC_OF_SQUARE * side,
        "a round lens for the original's cube of this side",
    ),
    rule(
        "focusDistance",
        "aperture",
        |width, _| 0.5 * width,
        "a round lens of this diameter, as in the original",
    ),
    rule(
        "focusDist",
        "defocusAngle",
        |degrees, focus| focus * tan64((degrees / 2.0).to_radians()),
        "a round lens; the original measures the distance along each ray",
    ),
    rule("focusDist", "lenRadius", |radius, _| radius, "a round lens of this radius"),
    rule(
        "focus_distance",
        "lens_radius",
        |radius, _| radius,
        "a round lens, evenly open; the original's is a projected ball",
    ),
    rule("focal", "aperture", |radius, _| radius, "a round lens of this radius; programs differ"),
    Rule {
        distance: |_, from_origin| from_origin,
        ..rule(
            "distance",
            "aperture",
            |hundredths, _| 0.5 * DISC_OF_SQUARE * hundredths / 100.0,
            "a round lens of the area of the original's square one, whose side is in hundredths; the original is \
             focused at the world's origin, whatever its `distance` says",
        )
    },
    rule(
        "distance",
        "radius",
        |radius, _| radius,
        "a round lens, evenly open; the original's is denser at the centre",
    ),
    rule(
        "dist",
        "radius",
        |radius, _| radius,
        "a round lens, evenly open; the original's is denser at the centre",
    ),
    rule("focus", "field", |radius, _| radius, "a round lens, evenly open; the original's is a ball"),
];

/// All keys of lenses.
pub const KEYS: &[&str] = &[
    "focal",
    "focalLength",
    "focal_length",
    "focus",
    "focusDist",
    "focusDistance",
    "focus_distance",
    "focusPoint",
    "distance",
    "dist",
    "aperture",
    "aperture_size",
    "radius",
    "lens_radius",
    "lenRadius",
    "field",
    "defocusAngle",
    "isDOF",
];

/// Keys that mean a distance in focus, whatever stands beside them.
pub const DISTANCES: &[&str] = &[
    "focusDist",
    "focusDistance",
    "focus_distance",
    "focus",
    "focalLength",
    "focal_length",
    "focal",
    "distance",
    "dist",
];

/// Keys that mean the opening of a lens, whatever stands beside them.
pub const OPENINGS: &[&str] = &["lens_radius", "lenRadius", "aperture", "aperture_size", "radius", "field"];
