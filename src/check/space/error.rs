//! What can be wrong with where things are.

use super::super::error::CheckError;
use crate::source::Span;
use miette::Diagnostic;
use thiserror::Error;

/// A mistake that the survey of a scene finds.
#[derive(Clone, Error, Diagnostic, Debug)]
pub enum SpaceError {
    // ── Light that goes nowhere ─────────────────────────────────────────────────────────────────────────────────────
    #[error("this light is sealed in {noun}")]
    #[diagnostic(
        code(snell::check::light_sealed),
        severity(warning),
        help(
            "move the light out of it, or make it of `glass {{ ior: 1.5 }}` or `emissive {{ power: 60W }}`"
        )
    )]
    LightSealed {
        noun: &'static str,
        #[label("nothing of this light gets out")]
        light: Span,
        #[label("of this")]
        object: Span,
    },
    #[error("no camera sees anything of this light: it is {place} {noun}")]
    #[diagnostic(
        code(snell::check::light_hidden),
        severity(warning),
        help("move it to where the cameras are, or take it away")
    )]
    LightHidden {
        place: &'static str,
        noun: &'static str,
        #[label("all of its light stays {place}")]
        light: Span,
        #[label("this")]
        wall: Span,
    },
    #[error("no camera sees anything of this object{others}: it is {place} {noun}")]
    #[diagnostic(
        code(snell::check::object_hidden),
        severity(warning),
        help("move it to where the cameras see it, or take it away; look for a sign or a unit that slipped")
    )]
    ObjectHidden {
        /// Of how many more.
        others: String,
        place: &'static str,
        noun: &'static str,
        #[label("all of it is {place}")]
        object: Span,
        #[label("this")]
        wall: Span,
    },
    #[error("{said}")]
    #[diagnostic(code(snell::check::camera_sealed), severity(warning), help("{help}"))]
    CameraSealed {
        said: String,
        #[label("the camera is here")]
        camera: Span,
        #[label("no light gets through this")]
        object: Span,
        help: &'static str,
    },
    #[error("this light shines away from everything")]
    #[diagnostic(code(snell::check::light_faces_away), severity(warning), help("{help}"))]
    LightFacesAway {
        #[label("nothing is on the side that shines")]
        light: Span,
        help: &'static str,
    },
    #[error("this light shines straight into a wall")]
    #[diagnostic(code(snell::check::light_against_wall), severity(warning), help("{help}"))]
    LightAgainstWall {
        #[label("hardly any light gets out")]
        light: Span,
        #[label("of the gap before this")]
        wall: Span,
        help: &'static str,
    },

    // ── Glass ───────────────────────────────────────────────────────────────────────────────────────────────────────
    #[error("the camera is inside of glass")]
    #[diagnostic(
        code(snell::check::camera_in_glass),
        severity(warning),
        help(
            "move the camera out; if a view from within is meant, `allow(camera_in_glass, \"..\")` before the camera says so"
        )
    )]
    CameraInGlass {
        #[label("the camera is here")]
        camera: Span,
        #[label("the picture is seen from the inside of this")]
        glass: Span,
    },
    #[error("two different glasses overlap, and neither is inside the other")]
    #[diagnostic(
        code(snell::check::glass_overlap),
        severity(warning),
        help(
            "move them apart, or put one wholly into the other: what both claim is filled by whichever light enters last"
        )
    )]
    GlassOverlap {
        #[label("this glass sticks out of")]
        second: Span,
        #[label("and into this one")]
        first: Span,
    },
    #[error("the surfaces of two glasses lie in the very same place")]
    #[diagnostic(
        code(snell::check::coincident_glass),
        severity(warning),
        help(
            "leave a hair's breadth between them, or make one solid of both: which surface light meets first is left open"
        )
    )]
    CoincidentGlass {
        #[label("a surface of this")]
        second: Span,
        #[label("is one of this")]
        first: Span,
    },
    #[error("`{name}` is of glass, and its surface is not closed: it has {edges}")]
    #[diagnostic(
        code(snell::check::open_glass),
        severity(warning),
        help("close the holes in the file: light that enters glass has to meet a surface where it leaves")
    )]
    OpenGlass {
        name: String,
        edges: String,
        #[label("named here")]
        used: Span,
    },
    #[error("this {what} is of glass, and its ends are open")]
    #[diagnostic(code(snell::check::open_ends), severity(warning), help("{help}"))]
    OpenEnds {
        what: &'static str,
        #[label("light that enters here has to meet a surface where it leaves")]
        object: Span,
        help: &'static str,
    },
    #[error("this {what} is of glass, and has no inside")]
    #[diagnostic(code(snell::check::lone_glass), severity(warning), help("{help}"))]
    LoneGlass {
        what: &'static str,
        #[label("light that enters here never meets a surface where it leaves")]
        object: Span,
        help: &'static str,
    },
    #[error("`{name}` is of glass, and {said}")]
    #[diagnostic(
        code(snell::check::inside_out_glass),
        severity(warning),
        help("turn its triangles in the file so that all are counter-clockwise seen from outside")
    )]
    InsideOutGlass {
        name: String,
        said: String,
        #[label("named here")]
        used: Span,
    },
    #[error("path tracing cannot see the caustics that this light throws")]
    #[diagnostic(
        code(snell::check::caustics_invisible),
        severity(warning),
        help(
            "use the method `auto`, which sends photons, or give the light a size: `light sphere {{ .. }}`"
        )
    )]
    CausticsInvisible {
        #[label("no path can find a light without size")]
        light: Span,
        #[label("by way of this")]
        object: Span,
        #[label("with this method")]
        method: Option<Span>,
    },
    #[error("path tracing finds the caustics that this light throws only by luck")]
    #[diagnostic(
        code(snell::check::caustics_by_luck),
        severity(warning),
        help(
            "use the method `auto`, which sends photons, or make the light larger: what one path in {paths} finds are specks"
        )
    )]
    CausticsByLuck {
        /// How many paths it takes to find the light once.
        paths: u64,
        #[label("too small a light to be found")]
        light: Span,
        #[label("by way of this")]
        object: Span,
        #[label("with this method")]
        method: Option<Span>,
    },
    #[error("paths of at most {depth} vertices {end}")]
    #[diagnostic(
        code(snell::check::short_paths),
        severity(warning),
        help("write `depth: {wanted}` or more, or leave `depth` out")
    )]
    ShortPaths {
        depth: u32,
        wanted: u32,
        end: &'static str,
        #[label("too few")]
        used: Span,
        #[label("to get past this")]
        object: Span,
    },

    // ── Pictures of nothing ─────────────────────────────────────────────────────────────────────────────────────────
    #[error("nothing of the scene is in view")]
    #[diagnostic(
        code(snell::check::nothing_in_view),
        severity(warning),
        help("turn the camera to the objects with `look_at`, or move it back")
    )]
    NothingInView {
        #[label("there is nothing this way")]
        view: Span,
        #[label("the camera is here")]
        position: Span,
    },
    #[error("all of the scene is smaller than a pixel from here")]
    #[diagnostic(
        code(snell::check::too_small_to_see),
        severity(warning),
        help("look for a unit that slipped, such as metres for centimetres, or move the camera nearer")
    )]
    TooSmallToSee {
        #[label("the camera is here")]
        position: Span,
    },

    // ── What is checked of points, too ─────────────────────────────────────────────────────────────────────────
    #[error(transparent)]
    #[diagnostic(transparent)]
    Same(#[from] CheckError),
}
