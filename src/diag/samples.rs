//! A warning and an error, for tests of what is done with problems.

use crate::source::Span;
use miette::Diagnostic;
use thiserror::Error;

#[derive(Error, Diagnostic, Debug)]
#[error("something is odd")]
#[diagnostic(code(snell::test::odd), severity(Warning))]
pub struct Odd {
    #[label("here")]
    pub at: Span,
}

#[derive(Error, Diagnostic, Debug)]
#[error("something is wrong")]
#[diagnostic(code(snell::test::wrong))]
pub struct Wrong {
    #[label("here")]
    pub at: Span,
}
