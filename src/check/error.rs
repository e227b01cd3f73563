//! What can be wrong with a scene whose words all make sense.

use crate::source::Span;
use miette::{Diagnostic, LabeledSpan};
use thiserror::Error;

/// A mistake that `check` finds.
#[derive(Clone, Error, Diagnostic, Debug)]
#[expect(missing_docs, reason = "each variant says itself what it is about")]
pub enum CheckError {
    // ── Geometry ───────────────────────────────────────────────────────────────────────────────────────────────
    #[error("{what} is {found}, and must be greater than 0")]
    #[diagnostic(
        code(snell::check::not_positive),
        help("write something greater than 0, such as `{example}`")
    )]
    NotPositive {
        what: &'static str,
        found: String,
        #[label("not greater than 0")]
        used: Span,
        example: &'static str,
    },
    #[error("{what}")]
    #[diagnostic(code(snell::check::degenerate), help("{help}"))]
    Degenerate {
        what: String,
        #[label("nothing to see of it")]
        used: Span,
        help: &'static str,
    },
    #[error("`min` is beyond `max` along {axes}")]
    #[diagnostic(
        code(snell::check::inside_out_box),
        help("`min` takes the smaller coordinate of each axis, `max` the larger")
    )]
    InsideOutBox {
        axes: String,
        #[label("the larger coordinates belong here")]
        max: Span,
        #[label("the smaller ones here")]
        min: Span,
    },
    #[error("{what} is {found}: too far from the origin to be drawn")]
    #[diagnostic(code(snell::check::too_large), help("look for a missing unit; the limit is 1e15m"))]
    TooLarge {
        what: &'static str,
        found: String,
        #[label("too large")]
        used: Span,
    },
    #[error("{wanted}, and here {found}")]
    #[diagnostic(code(snell::check::curve_points), help("{help}"))]
    CurvePoints {
        wanted: &'static str,
        found: String,
        #[label("these points")]
        used: Span,
        help: String,
    },
    #[error("the profile reaches a radius of {found}")]
    #[diagnostic(
        code(snell::check::negative_radius),
        help("keep the profile on one side of the axis: no point (radius, height) left of 0")
    )]
    NegativeRadius {
        found: String,
        #[label("crosses the axis")]
        used: Span,
    },
    #[error("this hole {how} the outline that it is cut out of")]
    #[diagnostic(
        code(snell::check::hole_outside),
        help("move it inside: what lies outside cannot be cut out")
    )]
    HoleOutside {
        how: &'static str,
        #[label("the hole")]
        hole: Span,
        #[label("the outline")]
        outline: Span,
    },
    #[error("the outline crosses itself")]
    #[diagnostic(
        code(snell::check::crossing_outline),
        severity(warning),
        help("go round the outline in one direction; where it overlaps, it is not clear what is inside")
    )]
    CrossingOutline {
        #[label("crosses itself near point {near}")]
        used: Span,
        near: usize,
    },
    #[error("this transform flattens what it moves")]
    #[diagnostic(
        code(snell::check::singular_transform),
        help("no factor of a scale may be 0; for something flat use a `disk` or a `quad`")
    )]
    SingularTransform {
        /// What the factor does.
        said: String,
        #[label("{said}")]
        factor: Span,
        /// Where the object begins: all of it would run across the other label.
        #[label("of this object")]
        object: Span,
    },
    #[error("this transform squeezes what it moves to less than a ten-millionth of its width")]
    #[diagnostic(
        code(snell::check::squeezing_transform),
        severity(warning),
        help("for something flat use a `quad` or a `disk`: of this, rays cannot tell front and back apart")
    )]
    SqueezingTransform {
        #[label("too flat from here on")]
        factor: Span,
        #[label("this object")]
        object: Span,
    },
    #[error("this motion flattens what it moves, {percent} % of the way along")]
    #[diagnostic(
        code(snell::check::flattening_motion),
        help(
            "a scale on its way from one sign to the other passes 0: turn the thing over with `rotate_y(180deg)`"
        )
    )]
    FlatteningMotion {
        percent: u32,
        #[label("passes through something without volume")]
        motion: Span,
        /// Where the object begins.
        #[label("of this object")]
        object: Span,
    },
    #[error("this moves, and no shutter is open")]
    #[diagnostic(
        code(snell::check::closed_shutter),
        severity(warning),
        help("write `shutter: 50%` in the camera; without, all stands still as when the frame begins")
    )]
    ClosedShutter {
        #[label("stands still in the picture")]
        motion: Span,
        #[label("`shutter` is 0 here")]
        camera: Span,
    },
    #[error("the shutter is open, and nothing moves")]
    #[diagnostic(
        code(snell::check::idle_shutter),
        severity(warning),
        help("write `transform: moving(a, b)` for what is to move, or take the shutter away")
    )]
    IdleShutter {
        #[label("changes nothing")]
        shutter: Span,
    },
    #[error("a light moves")]
    #[diagnostic(
        code(snell::check::moving_light),
        help(
            "light from what moves is not in this version: let the light stand still, or close the shutter"
        )
    )]
    MovingLight {
        #[label("this shines")]
        light: Span,
        #[label("and moves while the shutter is open")]
        motion: Span,
    },
    #[error("a scene has one sky, and this is the second")]
    #[diagnostic(
        code(snell::check::second_sky),
        help("keep one of them: an `environment`, or a `light sun_sky`")
    )]
    SecondSky {
        #[label("another sky")]
        second: Span,
        #[label("the first")]
        first: Span,
    },

    // ── Light and matter ───────────────────────────────────────────────────────────────────────────────────────
    #[error("an index of refraction of {found} is not of this world")]
    #[diagnostic(
        code(snell::check::ior_below_one),
        help("light is fastest in vacuum, which has 1; water has 1.33, window glass 1.52, diamond 2.42")
    )]
    IorBelowOne {
        found: f64,
        #[label("below 1")]
        used: Span,
    },
    #[error("{what} sends back {found} times the light that arrives")]
    #[diagnostic(code(snell::check::creates_energy), help("{help}"))]
    CreatesEnergy {
        what: &'static str,
        found: f32,
        help: String,
        #[label("greater than 1")]
        used: Span,
    },
    #[error("this mix has {found} different parts, and at most {most} can lie at one point")]
    #[diagnostic(
        code(snell::check::too_many_parts),
        help("matt parts count as one, and so do mirrors; mix fewer glossy parts and glasses")
    )]
    TooManyParts {
        found: u32,
        most: u32,
        #[label("too many here")]
        used: Span,
    },
    #[error("{what} is {found}, and light is never negative")]
    #[diagnostic(code(snell::check::negative_light), help("write 0 for none at all"))]
    NegativeLight {
        what: &'static str,
        found: String,
        #[label("less than 0")]
        used: Span,
    },
    #[error("this mix comes down to {found} materials, and at most {most} may be mixed")]
    #[diagnostic(code(snell::check::too_deep_mix), help("mix fewer; shares can be multiplied beforehand"))]
    TooDeepMix {
        found: u32,
        most: u32,
        #[label("too many here")]
        used: Span,
    },
    #[error("{inner} cannot stand in {outer}")]
    #[diagnostic(code(snell::check::cannot_hold), help("{help}"))]
    CannotHold {
        inner: &'static str,
        outer: &'static str,
        help: &'static str,
        #[label("holds it")]
        outside: Span,
        #[label("this one")]
        used: Span,
    },
    #[error("this texture is made of {found} others, and at most {most} are looked up at a point")]
    #[diagnostic(
        code(snell::check::too_deep_texture),
        help(
            "make it of fewer: what is constant can be multiplied beforehand, the rest painted into one picture"
        )
    )]
    TooDeepTexture {
        found: u32,
        most: u32,
        #[label("too many here")]
        used: Span,
    },
    #[error("{what} may be as bright as {found}: where it is beyond 1 it counts as 1")]
    #[diagnostic(
        code(snell::check::may_create_energy),
        severity(warning),
        help("scale it so that no channel can be greater than 1")
    )]
    MayCreateEnergy {
        what: &'static str,
        found: f32,
        #[label("this sum or product")]
        used: Span,
    },
    #[error("a pane has no inside to {what}")]
    #[diagnostic(code(snell::check::thin_inside), help("{help}"))]
    ThinInside {
        what: &'static str,
        help: &'static str,
        #[label("so this means nothing")]
        used: Span,
    },
    #[error("an endless plane has no area to shine from")]
    #[diagnostic(
        code(snell::check::endless_light),
        help(
            "shine from a piece of it: `quad {{ origin: .., edge_u: .., edge_v: .., material: emissive {{ .. }} }}`"
        )
    )]
    EndlessLight {
        #[label("shines without end")]
        used: Span,
    },
    #[error("`diffuse` and `specular` together send back {found} times the light that arrives")]
    #[diagnostic(
        code(snell::check::phong_energy),
        severity(warning),
        help(
            "both are scaled down so that they share what there is; choose them so that they add up to at most 1"
        )
    )]
    PhongEnergy {
        found: f32,
        #[label("with this")]
        specular: Span,
        #[label("and this")]
        diffuse: Span,
    },
    #[error("{what} is {found}, and must be {range}")]
    #[diagnostic(code(snell::check::out_of_range), help("write for example `{example}`"))]
    OutOfRange {
        what: &'static str,
        found: String,
        range: String,
        example: String,
        #[label("must be {range}")]
        used: Span,
    },
    #[error("this light is dark")]
    #[diagnostic(code(snell::check::dark_light), severity(warning), help("{help}"))]
    DarkLight {
        #[label("shines with nothing")]
        used: Span,
        help: &'static str,
    },
    #[error("the scene has no light")]
    #[diagnostic(
        code(snell::check::no_light),
        severity(warning),
        help("add one, such as `light sphere {{ center: (0m, 3m, 0m), radius: 5cm, power: 60W }}`")
    )]
    NoLight {
        #[label("all that this camera sees is black")]
        camera: Span,
    },
    #[error("an error of {found} ends the picture after its first pass")]
    #[diagnostic(
        code(snell::check::loose_error),
        severity(warning),
        help("1 is 100%: write for example `error(1%)`")
    )]
    LooseError {
        found: String,
        #[label("far too much")]
        used: Span,
    },

    // ── Cameras ────────────────────────────────────────────────────────────────────────────────────────────────
    #[error("the camera looks at itself")]
    #[diagnostic(code(snell::check::camera_looks_nowhere), help("move `position` and `look_at` apart"))]
    CameraLooksNowhere {
        #[label("no direction in this")]
        target: Span,
        #[label("the camera is here")]
        position: Span,
    },
    #[error("the camera looks along its own `up`")]
    #[diagnostic(
        code(snell::check::up_along_view),
        help("say what is up in the picture, such as `up: (0, 0, -1)` for a view from above")
    )]
    UpAlongView {
        #[label("the view goes along `up`")]
        view: Span,
        /// What `up` points at says.
        said: &'static str,
        #[label("{said}")]
        up: Span,
    },
    #[error("a film of {width} x {height} pixels cannot be made")]
    #[diagnostic(
        code(snell::check::film_size),
        help("each side has from 1 to 65536 pixels: `size: 1024 x 768`")
    )]
    FilmSize {
        width: u32,
        height: u32,
        #[label("this size")]
        used: Span,
    },
    #[error("{message}")]
    #[diagnostic(code(snell::check::focus_not_once))]
    FocusNotOnce {
        message: String,
        #[label(collection)]
        labels: Vec<LabeledSpan>,
        #[help]
        help: String,
    },
    #[error("the lens is focused behind the camera")]
    #[diagnostic(code(snell::check::focus_behind), help("focus on what lies before the camera"))]
    FocusBehind {
        #[label("behind the camera")]
        focus: Span,
        #[label("the camera is here")]
        position: Span,
    },
    #[error("a lens of {focal} cannot focus at {found}: what is nearer than its focal length has no image")]
    #[diagnostic(
        code(snell::check::focus_too_near),
        help("focus further away than {focal}, or take a shorter focal length")
    )]
    FocusTooNear {
        focal: String,
        found: String,
        #[label("focused here")]
        focus: Span,
        #[label("the focal length")]
        focal_length: Span,
    },
    #[error("this transform stretches or mirrors the camera")]
    #[diagnostic(
        code(snell::check::stretched_camera),
        help("move it with `translate` and turn it with `rotate`; how much it sees is its `fov`")
    )]
    StretchedCamera {
        #[label("a camera keeps its size")]
        factor: Span,
    },
    #[error("the scene has no camera")]
    #[diagnostic(
        code(snell::check::no_camera),
        help("add one, such as `camera {{ position: (0m, 1m, 5m), look_at: (0m, 1m, 0m) }}`")
    )]
    NoCamera {
        #[label("nothing looks at this")]
        file: Span,
    },
    #[error("the scene has no camera `{name}`")]
    #[diagnostic(code(snell::check::unknown_camera))]
    UnknownCamera {
        name: String,
        #[label("nothing here has that name")]
        file: Span,
        #[help]
        help: String,
    },
}
