//! Mistakes in how a scene is written, and in the files it names.

use crate::source::Span;
use miette::Diagnostic;
use thiserror::Error;

/// A mistake of the syntax phase.
#[derive(Error, Diagnostic, Clone, Debug)]
#[expect(
    missing_docs,
    reason = "each variant's message says what it is, each field's label what it points at"
)]
pub enum SyntaxError {
    #[error("the first line does not say which version of the language this is")]
    #[diagnostic(code(snell::syntax::missing_version), help("{hint}"))]
    MissingVersion {
        hint: &'static str,
        #[label("`snell 1` belongs here")]
        at: Span,
    },

    #[error("version `{written}` of the language is not known")]
    #[diagnostic(
        code(snell::syntax::unsupported_version),
        help("this program reads version 1: write `snell 1`")
    )]
    UnsupportedVersion {
        written: String,
        #[label("this version")]
        at: Span,
    },

    #[error("the version of the language is said once, before everything else")]
    #[diagnostic(
        code(snell::syntax::misplaced_version),
        help("remove this line, or make it the first of the file")
    )]
    MisplacedVersion {
        #[label("too late here")]
        at: Span,
    },

    #[error("{what} is missing")]
    #[diagnostic(code(snell::syntax::missing_value), help("{hint}"))]
    MissingValue {
        what: String,
        hint: String,
        #[label("expected here")]
        at: Span,
    },

    #[error("`{operator}` has nothing on its right")]
    #[diagnostic(
        code(snell::syntax::missing_operand),
        help("write a value after `{operator}`, or remove it")
    )]
    MissingOperand {
        operator: String,
        #[label("a value belongs after this")]
        at: Span,
    },

    #[error("{what} has no name")]
    #[diagnostic(code(snell::syntax::missing_name), help("write a name here, such as `{example}`"))]
    MissingName {
        what: &'static str,
        example: &'static str,
        #[label("a name belongs here")]
        at: Span,
    },

    #[error("`{word}` is a word of the language and names nothing else")]
    #[diagnostic(code(snell::syntax::reserved_word), help("choose another name, such as `{word}_1`"))]
    ReservedWord {
        word: String,
        #[label("used as a name")]
        at: Span,
    },

    #[error("`{name}` has no type")]
    #[diagnostic(code(snell::syntax::missing_type), help("write {example}"))]
    MissingType {
        name: String,
        example: String,
        #[label("the type belongs here")]
        at: Span,
    },

    #[error("a `let` takes no type: it has that of its value")]
    #[diagnostic(code(snell::syntax::typed_let), help("write `let {name} = ..`"))]
    TypedLet {
        name: String,
        #[label("remove this")]
        at: Span,
    },

    #[error("`{sign}` is missing {place}")]
    #[diagnostic(code(snell::syntax::missing_sign), help("{hint}"))]
    MissingSign {
        sign: &'static str,
        place: String,
        hint: String,
        #[label("`{sign}` belongs here")]
        at: Span,
    },

    #[error("`{written}` stands where `{wanted}` belongs")]
    #[diagnostic(code(snell::syntax::wrong_sign), help("{hint}"))]
    WrongSign {
        written: String,
        wanted: &'static str,
        hint: String,
        #[label("write `{wanted}`")]
        at: Span,
    },

    #[error("a comma is missing between two {what}")]
    #[diagnostic(code(snell::syntax::missing_comma), help("{hint}"))]
    MissingComma {
        what: &'static str,
        hint: &'static str,
        #[label("`,` belongs here")]
        at: Span,
        #[label("this begins the next one")]
        next: Span,
    },

    #[error("`{sign}` stands here twice")]
    #[diagnostic(code(snell::syntax::doubled_sign), help("remove one of them"))]
    DoubledSign {
        sign: String,
        #[label("one `{sign}` too many")]
        at: Span,
    },

    #[error("this comma has nothing before it")]
    #[diagnostic(code(snell::syntax::extra_comma), help("remove it, or write what is missing"))]
    ExtraComma {
        #[label("one comma too many")]
        at: Span,
    },

    #[error("`;` separates nothing in this language{others}")]
    #[diagnostic(
        code(snell::syntax::semicolon),
        help("remove it: a line end is enough, and on one line write `,`")
    )]
    Semicolon {
        others: String,
        #[label("remove this")]
        at: Span,
    },

    #[error("`{sign}` begins no comment in this language{others}")]
    #[diagnostic(code(snell::syntax::foreign_comment), help("begin it with `//`"))]
    ForeignComment {
        sign: &'static str,
        others: String,
        #[label("write `//`")]
        at: Span,
    },

    #[error("a line that begins with `{sign}` could continue the line before or be a value of its own")]
    #[diagnostic(
        code(snell::syntax::sign_at_line_start),
        help(
            "to continue, end the line before with `{sign}`; for a value of its own, put a comma before it"
        )
    )]
    SignAtLineStart {
        sign: String,
        #[label("which of the two?")]
        at: Span,
    },

    #[error("{what} has no block")]
    #[diagnostic(code(snell::syntax::missing_block), help("write `{{ .. }}` here"))]
    MissingBlock {
        what: &'static str,
        #[label("`{{` belongs here")]
        at: Span,
    },

    #[error("`{open}` is never closed")]
    #[diagnostic(code(snell::syntax::unclosed_bracket), help("write `{close}` here"))]
    UnclosedBracket {
        open: char,
        close: char,
        #[label("`{close}` is missing here")]
        at: Span,
        #[label("opened here")]
        opened: Span,
    },

    #[error("`{close}` closes nothing")]
    #[diagnostic(code(snell::syntax::stray_bracket), help("remove it, or write the `{open}` that it closes"))]
    StrayBracket {
        open: char,
        close: char,
        #[label("nothing is open here")]
        at: Span,
    },

    #[error("`{close}` cannot close `{open}`")]
    #[diagnostic(code(snell::syntax::mismatched_bracket), help("write `{wanted}` instead"))]
    MismatchedBracket {
        open: char,
        close: char,
        wanted: char,
        #[label("`{wanted}` belongs here")]
        at: Span,
        #[label("opened here")]
        opened: Span,
    },

    #[error("this text has no closing quote")]
    #[diagnostic(
        code(snell::syntax::unclosed_quote),
        help("write `\"` here; a text ends on the line where it begins")
    )]
    UnclosedQuote {
        #[label("`\"` is missing here")]
        at: Span,
        #[label("the text begins here")]
        opened: Span,
    },

    #[error("a text stands between straight double quotes")]
    #[diagnostic(code(snell::syntax::wrong_quotes), help("write `\"{text}\"`"))]
    WrongQuotes {
        text: String,
        #[label("quotes of another kind")]
        at: Span,
    },

    #[error("this comment is never closed")]
    #[diagnostic(
        code(snell::syntax::unclosed_comment),
        help("write `*/` where it ends: every `/*` inside a comment needs one of its own")
    )]
    UnclosedComment {
        #[label("opened here")]
        at: Span,
    },

    #[error("no comment is open here")]
    #[diagnostic(
        code(snell::syntax::stray_comment_end),
        help("remove `*/`, or write `/*` where the comment begins")
    )]
    StrayCommentEnd {
        #[label("closes nothing")]
        at: Span,
    },

    #[error("the character {shown} means nothing here")]
    #[diagnostic(code(snell::syntax::unknown_character), help("{hint}"))]
    UnknownCharacter {
        shown: String,
        hint: String,
        #[label("not a character of the language")]
        at: Span,
    },

    #[error("{what} cannot be read here")]
    #[diagnostic(code(snell::syntax::unreadable), help("{hint}"))]
    Unreadable {
        what: String,
        hint: String,
        #[label("from here on")]
        at: Span,
    },

    #[error("no item begins with `{word}`")]
    #[diagnostic(code(snell::syntax::unknown_item), help("{hint}"))]
    UnknownItem {
        word: String,
        hint: String,
        #[label("not a word that begins an item")]
        at: Span,
    },

    #[error("`{name}` stands outside any block")]
    #[diagnostic(
        code(snell::syntax::stray_field),
        help("to name a value write `let {name} = ..`; a field stands between braces")
    )]
    StrayField {
        name: String,
        #[label("a field of nothing")]
        at: Span,
    },

    #[error("this is {language}, not a scene in Snell")]
    #[diagnostic(code(snell::syntax::foreign), help("{hint}"))]
    Foreign {
        language: &'static str,
        hint: String,
        #[label("{language}")]
        at: Span,
    },

    #[error("a colour has three or six hexadecimal digits")]
    #[diagnostic(code(snell::syntax::bad_color), help("write for example `#f80` or `#ff8800`"))]
    BadColor {
        #[label("{problem}")]
        at: Span,
        problem: String,
    },

    #[error("a blank parts a number from its unit")]
    #[diagnostic(code(snell::syntax::apart_unit), help("a unit is glued to its number: write `{glued}`"))]
    ApartUnit {
        glued: String,
        #[label("write `{glued}`")]
        at: Span,
    },

    #[error("this number is too large")]
    #[diagnostic(code(snell::syntax::huge_number), help("numbers reach to about 1.8e308"))]
    HugeNumber {
        #[label("beyond every finite number")]
        at: Span,
    },

    #[error("`data` holds plain numbers only")]
    #[diagnostic(
        code(snell::syntax::bad_data),
        help("write numbers without units, with blanks or commas between: `data [0.5 1 2e-3]`")
    )]
    BadData {
        #[label("not a number")]
        at: Span,
    },

    #[error("`allow` takes the code of a warning and the reason")]
    #[diagnostic(
        code(snell::syntax::bad_allow),
        help("write `allow(unused, \"why it may stay\")` before the item it is about")
    )]
    BadAllow {
        #[label("{problem}")]
        at: Span,
        problem: &'static str,
    },

    #[error("the nesting is deeper than {limit} levels")]
    #[diagnostic(code(snell::syntax::too_deep), help("give the inner parts names with `let`"))]
    TooDeep {
        limit: usize,
        #[label("too deep from here on")]
        at: Span,
    },

    #[error("there is no file `{path}`")]
    #[diagnostic(code(snell::syntax::file_not_found))]
    FileNotFound {
        path: String,
        #[label("named here")]
        at: Span,
        #[help]
        hint: String,
    },

    #[error("`{path}` lies outside the scene's folder")]
    #[diagnostic(
        code(snell::syntax::file_outside),
        help("move it beside the scene, name its folder with `--asset-dir`, or say `--allow-outside`")
    )]
    FileOutside {
        path: String,
        #[label("named here")]
        at: Span,
    },

    #[error("`{path}` cannot be read: {reason}")]
    #[diagnostic(
        code(snell::syntax::file_unreadable),
        help("check that it is a file and that you may read it")
    )]
    FileUnreadable {
        path: String,
        reason: String,
        #[label("named here")]
        at: Span,
    },

    #[error("`{path}` is not a text: byte {offset} is not UTF-8")]
    #[diagnostic(
        code(snell::syntax::not_utf8),
        help("save it as UTF-8; meshes and images are named by `mesh` and `image`")
    )]
    NotUtf8 {
        path: String,
        offset: usize,
        #[label("named here")]
        at: Span,
    },

    #[error("`{path}` is too large: {size} bytes, and a scene text has at most {limit}")]
    #[diagnostic(
        code(snell::syntax::file_too_large),
        help("keep bulk geometry in a mesh file and name it with `mesh`")
    )]
    FileTooLarge {
        path: String,
        size: usize,
        limit: usize,
        #[label("this file")]
        at: Span,
    },

    #[error("these files need each other: {cycle}")]
    #[diagnostic(
        code(snell::syntax::file_cycle),
        help("move what they share into a file that names neither")
    )]
    FileCycle {
        cycle: String,
        #[label("closes the circle")]
        at: Span,
        #[label(collection, "on the way round")]
        steps: Vec<Span>,
    },

    #[error("files are included more than {limit} deep")]
    #[diagnostic(code(snell::syntax::include_depth), help("include the inner files from the main one"))]
    IncludeDepth {
        limit: usize,
        #[label("one level too many")]
        at: Span,
    },
}

impl SyntaxError {
    /// The place of the mistake.
    pub(super) fn at(&self) -> u32 {
        let label = self.labels().and_then(|mut labels| labels.next());
        label.map_or(0, |label| label.offset() as u32)
    }
}
