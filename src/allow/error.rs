//! What can be wrong with an `allow`.

use crate::source::Span;
use miette::Diagnostic;
use thiserror::Error;

/// A mistake in what a scene silences.
#[derive(Clone, Error, Diagnostic, Debug)]
#[expect(missing_docs, reason = "each variant says itself what it is about")]
pub enum AllowError {
    #[error("no warning about a scene has the code `{code}`")]
    #[diagnostic(code(snell::allow::unknown_code))]
    UnknownCode {
        code: String,
        #[label("not a code")]
        used: Span,
        #[help]
        help: String,
    },
    #[error("`{code}` is an error, and errors cannot be silenced")]
    #[diagnostic(
        code(snell::allow::not_a_warning),
        help("take the `allow` away, and mend what it was to hide")
    )]
    NotAWarning {
        code: String,
        #[label("not a warning")]
        used: Span,
    },
    #[error("`allow({code}, ..)` silences nothing")]
    #[diagnostic(
        code(snell::allow::idle),
        severity(warning),
        help("take it away, or put it before the item that the warning is about")
    )]
    Idle {
        code: String,
        #[label("no such warning is given in the item that follows")]
        used: Span,
    },
}
