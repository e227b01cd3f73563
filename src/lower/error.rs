//! What can still go wrong when a checked scene is made ready for rays.

use crate::source::Span;
use miette::Diagnostic;
use thiserror::Error;

/// A mistake that only the pixels of a picture, or the objects in their places, show.
#[derive(Debug, Error, Diagnostic)]
pub enum LowerError {
    /// The header was fine, the pixels are not.
    #[error("`{name}` cannot be used as a picture: {reason}")]
    #[diagnostic(code(snell::lower::bad_picture), help("save it again as PNG, JPEG, PPM, HDR or EXR"))]
    BadPicture {
        /// As written.
        name: String,
        /// What is wrong with it.
        reason: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
    },
    /// Nothing to focus on, or behind the lens.
    #[error("the lens cannot focus there: {reason}")]
    #[diagnostic(
        code(snell::lower::bad_focus),
        help("focus on something in front of the camera, or give a distance: `focus: 2m`")
    )]
    BadFocus {
        /// Why not.
        reason: String,
        #[label("focused here")]
        #[expect(missing_docs, reason = "the label says it")]
        focus: Span,
    },
}
