//! What can be wrong or doubtful in a file of the family, each with its place and its cure.

use super::notebook::MOST_OF_A_KIND;
use miette::{Diagnostic, SourceSpan};

/// A mistake in the file, or something a person should know about its conversion.
///
/// Which of them end the conversion depends on the mode, see [`Mistake::gravity`].
#[derive(Debug, Clone, PartialEq, thiserror::Error, Diagnostic)]
#[allow(missing_docs)] // the message of each variant says what it is, the labels what its places are
pub enum Mistake {
    #[error("the file has {bytes} bytes, and at most {limit} are read")]
    #[diagnostic(
        code(snell::convert::too_large),
        help("split the scene, or move its geometry into a mesh file")
    )]
    TooLarge { bytes: usize, limit: usize },

    #[error("blocks are nested more than {limit} deep")]
    #[diagnostic(
        code(snell::convert::too_deep),
        help("flatten the groups, or look for a `}}` that is missing further up")
    )]
    TooDeep {
        limit: usize,
        #[label("too deep from here")]
        at: SourceSpan,
    },

    #[error("the file holds no scene")]
    #[diagnostic(
        code(snell::convert::empty),
        help("a scene has at least a `PerspectiveCamera {{ .. }}` and a `Group {{ .. }}`")
    )]
    Empty,

    #[error("the `{{` of `{name}` is never closed")]
    #[diagnostic(code(snell::convert::unclosed_brace), help("write the `}}` where the block ends"))]
    UnclosedBrace {
        name: String,
        #[label("opened here")]
        open: SourceSpan,
    },

    #[error("this `[` is never closed")]
    #[diagnostic(code(snell::convert::unclosed_bracket), help("a control point is `[ x y z ]`"))]
    UnclosedBracket {
        #[label("opened here")]
        open: SourceSpan,
    },

    #[error("this `{what}` closes nothing")]
    #[diagnostic(
        code(snell::convert::stray_close),
        help("delete it, or look for an opening one that is missing further up")
    )]
    StrayClose {
        what: char,
        #[label("nothing is open here")]
        at: SourceSpan,
    },

    #[error("`{key}` wants {wanted}, and {found}")]
    #[diagnostic(code(snell::convert::missing_number))]
    MissingNumber {
        key: String,
        wanted: String,
        found: String,
        #[label("too few numbers")]
        at: SourceSpan,
        #[help]
        help: String,
    },

    #[error("`{word}` is no number, and `{key}` wants {wanted}")]
    #[diagnostic(code(snell::convert::not_a_number), help("a number is written `1`, `-.5` or `2e-3`"))]
    NotANumber {
        key: String,
        wanted: String,
        word: String,
        #[label("a number is due here")]
        at: SourceSpan,
    },

    #[error("`{key}` wants {wanted}")]
    #[diagnostic(code(snell::convert::missing_value))]
    MissingValue {
        key: String,
        wanted: &'static str,
        #[label("nothing that fits follows")]
        at: SourceSpan,
        #[help]
        help: String,
    },

    #[error("`{block}` has no `{field}`")]
    #[diagnostic(code(snell::convert::missing_field))]
    MissingField {
        block: String,
        field: &'static str,
        #[label("in this block")]
        at: SourceSpan,
        #[help]
        help: String,
    },

    #[error("{what}")]
    #[diagnostic(code(snell::convert::bad_value))]
    BadValue {
        what: String,
        #[label("this value")]
        at: SourceSpan,
        #[help]
        help: &'static str,
    },

    #[error("`MaterialIndex {index}` is out of range: the file has {count} materials")]
    #[diagnostic(
        code(snell::convert::index_out_of_range),
        help("a grey placeholder stands in. Indices count from 0, so the last one is {last}", last = count.saturating_sub(1))
    )]
    IndexOutOfRange {
        index: i64,
        count: usize,
        #[label("no such material")]
        at: SourceSpan,
    },

    #[error("`MaterialIndex {index}` is one past the last material")]
    #[diagnostic(
        code(snell::convert::index_at_count),
        help(
            "the original reads past the end of its array here; a grey placeholder stands in. Indices count from 0"
        )
    )]
    IndexAtCount {
        index: i64,
        #[label("no such material")]
        at: SourceSpan,
    },

    #[error("this `{shape}` has no material")]
    #[diagnostic(code(snell::convert::no_material), help("it is grey; write `MaterialIndex 0` before it"))]
    NoMaterial {
        shape: String,
        #[label("no `MaterialIndex` comes before it")]
        at: SourceSpan,
    },

    #[error("this `Transform` holds no object")]
    #[diagnostic(code(snell::convert::empty_transform), help("put exactly one object after the operations"))]
    EmptyTransform {
        #[label("nothing to transform")]
        at: SourceSpan,
    },

    #[error("a `Transform` holds exactly one object, and this is another one")]
    #[diagnostic(
        code(snell::convert::crowded_transform),
        help("put the objects into a `Group {{ .. }}` inside the `Transform`")
    )]
    CrowdedTransform {
        #[label("the second object")]
        second: SourceSpan,
        #[label("the first one")]
        first: SourceSpan,
    },

    #[error("a profile lies in the xy plane, and this control point has z = {z}")]
    #[diagnostic(code(snell::convert::profile_off_plane), help("write 0 for its third coordinate"))]
    ProfileOffPlane {
        z: f64,
        #[label("off the plane")]
        at: SourceSpan,
    },

    #[error("a `{curve}` needs at least 4 control points, and this one has {count}")]
    #[diagnostic(code(snell::convert::profile_too_short), help("add control points `[ x y z ]`"))]
    ProfileTooShort {
        curve: String,
        count: usize,
        #[label("too few points")]
        at: SourceSpan,
    },

    #[error("the file has no camera")]
    #[diagnostic(
        code(snell::convert::no_camera),
        help("the scene can be checked and included; add a `camera` before rendering it")
    )]
    NoCamera,

    #[error("`{key}` says {said}, and {found} follow")]
    #[diagnostic(
        code(snell::convert::count_mismatch),
        help("the braces were believed; the original stops here")
    )]
    CountMismatch {
        key: String,
        said: String,
        found: usize,
        #[label("this count")]
        at: SourceSpan,
    },

    #[error("`{key}` was taken as {meant}, by the look of it")]
    #[diagnostic(
        code(snell::convert::guessed),
        help(
            "no program of the family that the converter knows has this key; see whether the result is right"
        )
    )]
    Guessed {
        key: String,
        meant: String,
        #[label("a guess")]
        at: SourceSpan,
    },

    #[error("`{name}` was taken as {meant}, by the look of it")]
    #[diagnostic(
        code(snell::convert::guessed_block),
        help("the course's format has no such block; see whether the result is right")
    )]
    GuessedBlock {
        name: String,
        meant: &'static str,
        #[label("a guess")]
        at: SourceSpan,
    },

    #[error("the file holds {count} scenes")]
    #[diagnostic(
        code(snell::convert::several_scenes),
        help("each becomes a file of its own; the original would have shown the last one")
    )]
    SeveralScenes {
        count: usize,
        #[label("the second begins here")]
        at: SourceSpan,
    },

    #[error("`{field}` is no field of `{block}` that the converter knows")]
    #[diagnostic(code(snell::convert::unknown_field))]
    UnknownField {
        field: String,
        block: String,
        #[label("left out")]
        at: SourceSpan,
        #[help]
        help: Option<String>,
    },

    #[error("`{name}` is no block that the converter knows {place}")]
    #[diagnostic(code(snell::convert::unknown_block))]
    UnknownBlock {
        name: String,
        place: String,
        #[label("left out, braces and all")]
        at: SourceSpan,
        #[help]
        help: Option<String>,
    },

    #[error("`{text}` belongs to nothing")]
    #[diagnostic(code(snell::convert::stray_token), help("delete it"))]
    StrayToken {
        text: String,
        #[label("left out")]
        at: SourceSpan,
    },

    #[error("`{name}` stands here more than once, and the last one counts")]
    #[diagnostic(code(snell::convert::repeated), help("delete the others"))]
    Repeated {
        name: String,
        #[label("left out")]
        at: SourceSpan,
        #[label("this one counts")]
        last: SourceSpan,
    },

    #[error("`{written}` was read as `{meant}`")]
    #[diagnostic(
        code(snell::convert::letter_case),
        help("keys are case-sensitive in the original: write `{meant}`")
    )]
    LetterCase {
        written: String,
        meant: String,
        #[label("spelt differently")]
        at: SourceSpan,
    },

    #[error("the format has no comments")]
    #[diagnostic(
        code(snell::convert::comment),
        help("{count} skipped, from `//` or `#` to the end of the line; the original rejects them")
    )]
    Comment {
        count: usize,
        #[label("the first one")]
        first: SourceSpan,
    },

    #[error("the normal of this plane has length {length}")]
    #[diagnostic(
        code(snell::convert::normal_not_unit),
        help(
            "the plane was kept where `normal . p = offset` puts it; programs that normalise the normal alone put it elsewhere"
        )
    )]
    NormalNotUnit {
        length: f64,
        #[label("not a unit vector")]
        at: SourceSpan,
    },

    #[error("`up` is not perpendicular to `direction`")]
    #[diagnostic(code(snell::convert::up_not_perpendicular))]
    UpNotPerpendicular {
        #[label("leans along the view")]
        at: SourceSpan,
        #[help]
        help: String,
    },

    #[error("programs disagree on what `angle` means in a picture that is not square")]
    #[diagnostic(
        code(snell::convert::disputed_angle),
        help(
            "it was read as the vertical field of view, like the course's own; some read it as the horizontal one"
        )
    )]
    DisputedAngle {
        #[label("read as vertical")]
        at: SourceSpan,
    },

    #[error("`Lights` was left out: {why}")]
    #[diagnostic(
        code(snell::convert::lights_dropped),
        help("to keep the lights, convert with `--lights keep`")
    )]
    LightsDropped {
        why: &'static str,
        #[label("left out")]
        at: SourceSpan,
    },

    #[error("`{path}` was not found")]
    #[diagnostic(code(snell::convert::missing_asset))]
    MissingAsset {
        path: String,
        #[label("kept, with `missing: skip`")]
        at: SourceSpan,
        #[help]
        help: String,
    },

    #[error("`{path}` was not found where it should be, but `{found}` was")]
    #[diagnostic(
        code(snell::convert::asset_elsewhere),
        help("give its folder to the renderer with `--asset-dir`, or correct the path")
    )]
    AssetElsewhere {
        path: String,
        found: String,
        #[label("a file of this name lies elsewhere")]
        at: SourceSpan,
    },

    #[error("{what} is not read yet")]
    #[diagnostic(code(snell::convert::not_read_yet))]
    NotReadYet {
        what: String,
        #[label("{done}")]
        at: SourceSpan,
        done: &'static str,
    },

    #[error("{what} cannot be expressed: {why}")]
    #[diagnostic(code(snell::convert::not_convertible), help("it was left out"))]
    NotConvertible {
        what: String,
        why: &'static str,
        #[label("left out")]
        at: SourceSpan,
    },

    #[error("{count} more of the same kinds were found")]
    #[diagnostic(code(snell::convert::more), help("of each kind the first {MOST_OF_A_KIND} are listed"))]
    More { count: usize },

    #[error("{what}")]
    #[diagnostic(code(snell::convert::differs), help("{help}"))]
    Differs {
        what: String,
        #[label("converted all the same")]
        at: SourceSpan,
        help: &'static str,
    },
}
