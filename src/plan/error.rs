//! What is doubtful about simulating a scene with the method at hand.

use crate::source::Span;
use miette::Diagnostic;
use thiserror::Error;

/// A doubt about a method.
#[derive(Debug, Error, Diagnostic)]
pub enum PlanWarning {
    /// Terms of recursive ray tracing that no simulation of light can honour.
    #[error("{what} means something to `method: classic` alone")]
    #[diagnostic(
        code(snell::plan::classic_only),
        help(
            "write `render {{ method: classic }}`, or say what is physical: `phong`, `mirror`, `glass`, `falloff: physical`"
        )
    )]
    ClassicOnly {
        /// In words.
        what: &'static str,
        /// Where.
        #[label("is not how light behaves")]
        used: Span,
    },
    /// Photons are finite in number, the plane is not.
    #[error("photons from infinitely far cannot cover a plane without end: `ppm` would leave it dark")]
    #[diagnostic(
        code(snell::plan::endless_photons),
        help("use `hybrid`, `pt` or `auto`, or a `quad` instead of the plane")
    )]
    EndlessPhotons {
        /// The light.
        #[label("this light comes from infinitely far")]
        light: Span,
        /// The plane.
        #[label("and this has no end")]
        plane: Span,
    },
    /// Photons are kept where light is spread, and here nothing spreads it.
    #[error("there is no surface that photons could land on")]
    #[diagnostic(
        code(snell::plan::photons_without_receiver),
        severity(warning),
        help("use `pt` or `auto`: mirrors and glass keep no photons")
    )]
    PhotonsWithoutReceiver {
        /// What is there instead.
        #[label("light goes on from here as it came")]
        specular: Span,
    },
}
