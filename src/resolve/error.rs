//! What can be wrong with names, types, units and blocks.

use crate::source::Span;
use miette::{Diagnostic, LabeledSpan};
use thiserror::Error;

/// A mistake that `resolve` finds.
#[derive(Clone, Error, Diagnostic, Debug)]
#[expect(missing_docs, reason = "each variant says itself what it is about")]
pub enum Error {
    // ── Names ──────────────────────────────────────────────────────────────────────────────────────────────────
    #[error("nothing here is named `{name}`")]
    #[diagnostic(code(snell::resolve::unknown_name))]
    UnknownName {
        name: String,
        #[label("used here")]
        used: Span,
        #[help]
        help: Option<String>,
    },
    #[error("no material is named `{name}`")]
    #[diagnostic(code(snell::resolve::unknown_material))]
    UnknownMaterial {
        name: String,
        #[label("used here")]
        used: Span,
        #[help]
        help: Option<String>,
    },
    #[error("{owner} has nothing named `{name}`")]
    #[diagnostic(code(snell::resolve::unknown_member))]
    UnknownMember {
        owner: String,
        name: String,
        #[label("not found")]
        used: Span,
        #[help]
        help: Option<String>,
    },
    #[error("there is no block `{kind}`")]
    #[diagnostic(code(snell::resolve::unknown_block))]
    UnknownBlock {
        kind: String,
        #[label("this kind is not known")]
        used: Span,
        #[help]
        help: Option<String>,
    },
    #[error("`{block}` has no field `{field}`")]
    #[diagnostic(code(snell::resolve::unknown_field))]
    UnknownField {
        block: String,
        field: String,
        #[label("not a field of `{block}`")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("`{word}` is not {wanted}")]
    #[diagnostic(code(snell::resolve::unknown_word))]
    UnknownWord {
        word: String,
        wanted: String,
        #[label("not one of the words that may stand here")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("there is no unit `{unit}`")]
    #[diagnostic(code(snell::resolve::unknown_unit))]
    UnknownUnit {
        unit: String,
        #[label("not a unit")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("there is no type `{name}`")]
    #[diagnostic(code(snell::resolve::unknown_type))]
    UnknownType {
        name: String,
        #[label("not a type")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("the scene has no parameter `{name}`")]
    #[diagnostic(code(snell::resolve::unknown_parameter))]
    UnknownParameter {
        name: String,
        #[label("set here")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("`{name}` is defined twice")]
    #[diagnostic(
        code(snell::resolve::duplicate_name),
        help("give one of them another name, or take one away")
    )]
    DuplicateName {
        name: String,
        #[label("again here")]
        second: Span,
        #[label("first here")]
        first: Span,
    },
    #[error("`{name}` hides another `{name}`")]
    #[diagnostic(code(snell::resolve::shadowed), severity(warning), help("give the inner one another name"))]
    Shadowed {
        name: String,
        #[label("from here on, `{name}` is this one")]
        inner: Span,
        #[label("not this one")]
        outer: Span,
    },
    #[error("{kind} `{name}` is never used")]
    #[diagnostic(
        code(snell::resolve::unused),
        severity(warning),
        help("take it away, or call it `_{name}` to keep it")
    )]
    Unused {
        kind: &'static str,
        name: String,
        #[label("defined here")]
        defined: Span,
    },
    #[error("`{name}` needs itself")]
    #[diagnostic(code(snell::resolve::cycle), help("{help}"))]
    Cycle {
        name: String,
        help: String,
        #[label(collection)]
        steps: Vec<LabeledSpan>,
    },
    #[error("`{name}` calls itself")]
    #[diagnostic(
        code(snell::resolve::recursion),
        help("functions do not recurse; repeat with `for i in 0..n`")
    )]
    Recursion {
        name: String,
        #[label("called again here")]
        called: Span,
        #[label("while this is being worked out")]
        defined: Span,
    },

    // ── Fields ─────────────────────────────────────────────────────────────────────────────────────────────────
    #[error("`{block}` lacks its field `{field}`")]
    #[diagnostic(code(snell::resolve::missing_field))]
    MissingField {
        block: String,
        field: String,
        #[label("`{field}` is missing here")]
        head: Span,
        #[help]
        help: String,
    },
    #[error("the field `{field}` is given twice")]
    #[diagnostic(code(snell::resolve::duplicate_field), help("take one of them away"))]
    DuplicateField {
        field: String,
        #[label("again here")]
        second: Span,
        #[label("first here")]
        first: Span,
    },
    #[error("`{one}` and `{other}` say the same thing twice")]
    #[diagnostic(code(snell::resolve::conflicting_fields), help("{help}"))]
    ConflictingFields {
        help: String,
        one: String,
        other: String,
        #[label("and this")]
        second: Span,
        #[label("this")]
        first: Span,
    },
    #[error("{what} cannot stand {place}")]
    #[diagnostic(code(snell::resolve::misplaced))]
    Misplaced {
        what: String,
        place: &'static str,
        #[label("not here")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("there is a second `{kind}`")]
    #[diagnostic(code(snell::resolve::second_block), help("keep one of them"))]
    SecondBlock {
        kind: &'static str,
        #[label("the second")]
        second: Span,
        #[label("the first")]
        first: Span,
    },
    #[error("`{word}`: there is no constructive solid geometry in version 1")]
    #[diagnostic(
        code(snell::resolve::no_csg),
        help(
            "model the result as a `mesh`, a `revolve` or an `extrude` with `holes`; `group` joins objects"
        )
    )]
    NoCsg {
        word: String,
        #[label("not in this version")]
        used: Span,
    },

    // ── Types and units ────────────────────────────────────────────────────────────────────────────────────────
    #[error("{wanted} is wanted here, and `{text}` is {found}")]
    #[diagnostic(code(snell::resolve::wrong_type))]
    WrongType {
        wanted: String,
        text: String,
        found: String,
        #[label("{found}")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("{wanted} is wanted here, and `{text}` is {found}")]
    #[diagnostic(code(snell::resolve::wrong_dimension))]
    WrongDimension {
        wanted: String,
        text: String,
        found: String,
        #[label("{found}")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("{wanted} is wanted here, and `{text}` has no unit")]
    #[diagnostic(code(snell::resolve::missing_unit))]
    MissingUnit {
        wanted: String,
        text: String,
        #[label("a plain number")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("`{field}` must be {range}, and this is {found}")]
    #[diagnostic(code(snell::resolve::out_of_range))]
    OutOfRange {
        field: String,
        range: String,
        found: String,
        #[label("must be {range}")]
        used: Span,
        #[label("the range is said here")]
        said: Option<Span>,
        #[help]
        help: String,
    },
    #[error("`{operator}` cannot join {left_noun} and {right_noun}")]
    #[diagnostic(code(snell::resolve::incompatible))]
    Incompatible {
        operator: &'static str,
        left_noun: String,
        right_noun: String,
        #[label("{left_noun}")]
        left: Span,
        #[label("{right_noun}")]
        right: Span,
        #[help]
        help: Option<String>,
    },
    #[error("this comes to no number: {why}")]
    #[diagnostic(code(snell::resolve::not_finite), help("{help}"))]
    NotFinite {
        why: String,
        #[label("here")]
        used: Span,
        help: String,
    },
    #[error("the list has {elements}, and this asks for number {index}")]
    #[diagnostic(code(snell::resolve::out_of_bounds))]
    OutOfBounds {
        index: f64,
        elements: String,
        #[label("beyond the list")]
        used: Span,
        #[help]
        help: String,
    },

    // ── Calls ──────────────────────────────────────────────────────────────────────────────────────────────────
    #[error("`{function}` takes {wanted}, not {found}")]
    #[diagnostic(code(snell::resolve::argument_count))]
    ArgumentCount {
        function: String,
        wanted: String,
        found: usize,
        #[label("in this call")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("`{function}` needs a value for `{name}`")]
    #[diagnostic(code(snell::resolve::missing_argument))]
    MissingArgument {
        function: String,
        name: String,
        #[label("in this call")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("`{function}` has no parameter `{name}`")]
    #[diagnostic(code(snell::resolve::unknown_argument))]
    UnknownArgument {
        function: String,
        name: String,
        #[label("not a parameter")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("the argument `{name}` is given twice")]
    #[diagnostic(code(snell::resolve::duplicate_argument), help("take one of them away"))]
    DuplicateArgument {
        name: String,
        #[label("again here")]
        used: Span,
    },
    #[error("{what} gives no value")]
    #[diagnostic(code(snell::resolve::no_value))]
    NoValue {
        what: &'static str,
        #[label("a value is missing")]
        used: Span,
        #[help]
        help: &'static str,
    },
    #[error("more than one value stands here")]
    #[diagnostic(
        code(snell::resolve::several_values),
        help("put them into one `group {{ .. }}`, or name them with `let`")
    )]
    SeveralValues {
        #[label("the second")]
        second: Span,
        #[label("the first")]
        first: Span,
    },

    // ── Budgets and the rest ───────────────────────────────────────────────────────────────────────────────────
    #[error("more than {limit} {what}")]
    #[diagnostic(code(snell::resolve::budget))]
    Budget {
        what: &'static str,
        limit: u64,
        #[label("the limit is passed here")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("this glass lets nothing through")]
    #[diagnostic(
        code(snell::resolve::black_glass),
        severity(warning),
        help(
            "`absorption` names the colour that is left: for clear glass take it away, for smoke write `#808080 per 10cm`"
        )
    )]
    BlackGlass {
        #[label("black is left of the light")]
        used: Span,
    },
    #[error("`{text}` has no unit, and what stands beside it has one")]
    #[diagnostic(code(snell::resolve::mixed_units), severity(warning))]
    MixedUnits {
        text: String,
        #[label("taken as metres")]
        used: Span,
        #[label("this has a unit")]
        beside: Option<Span>,
        #[help]
        help: String,
    },
    #[error("a light cannot be stretched unevenly")]
    #[diagnostic(
        code(snell::resolve::uneven_light),
        help("scale a round light by one factor: `scale(2)`; a `light rect` may be stretched")
    )]
    UnevenLight {
        #[label("this light")]
        light: Span,
        #[label("is stretched here")]
        transform: Option<Span>,
    },
}
