//! What can still go wrong when a checked scene is made ready for rays.

use crate::source::Span;
use miette::Diagnostic;
use thiserror::Error;

/// A mistake that only the objects in their places show.
#[derive(Debug, Error, Diagnostic)]
pub enum LowerError {
    /// Opened farther than it goes.
    #[error("this lens opens to {widest} at most")]
    #[diagnostic(code(snell::lower::too_wide), help("write `aperture: {widest}`, or leave it out"))]
    TooWide {
        /// The smallest f-number.
        widest: String,
        #[label("wider than that")]
        #[expect(missing_docs, reason = "the label says it")]
        aperture: Span,
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
