//! What can be wrong with the files that a scene names.

use crate::diag::where_it_was_sought;
use crate::source::{Missing, Span};
use miette::Diagnostic;
use thiserror::Error;

/// A mistake, or a doubt, about a file that the scene names.
#[derive(Debug, Error, Diagnostic)]
pub enum LoadError {
    /// There is no such file.
    #[error("there is no file `{name}`")]
    #[diagnostic(code(snell::load::missing_file))]
    MissingFile {
        /// As written.
        name: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
        #[help]
        #[expect(missing_docs, reason = "the help says it")]
        help: String,
    },
    /// There is no such file, and the scene says that this is all right.
    #[error("there is no file `{name}`: {left_out}")]
    #[diagnostic(code(snell::load::skipped_file), severity(warning))]
    SkippedFile {
        /// As written.
        name: String,
        /// What is left out.
        left_out: &'static str,
        #[label("named here, with `missing: skip`")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
        #[help]
        #[expect(missing_docs, reason = "the help says it")]
        help: String,
    },
    /// It lies outside the scene's folder.
    #[error("`{name}` lies outside the scene's folder")]
    #[diagnostic(
        code(snell::load::outside),
        help(
            "move it beside the scene, name its folder with `--asset-dir`, or allow it with `--allow-outside`"
        )
    )]
    Outside {
        /// As written.
        name: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
    },
    /// The system refuses.
    #[error("`{name}` cannot be read: {reason}")]
    #[diagnostic(code(snell::load::unreadable), help("check that it is a file and that you may read it"))]
    Unreadable {
        /// As written.
        name: String,
        /// In the system's words.
        reason: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
    },
    /// Not a mesh that can be rendered.
    #[error("`{name}` is not a mesh that can be rendered: {reason}")]
    #[diagnostic(
        code(snell::load::bad_mesh),
        help(
            "a mesh is an OBJ file with `v` and `f` lines, or glTF 2 (.gltf, .glb); mend it, or export it again"
        )
    )]
    BadMesh {
        /// As written.
        name: String,
        /// What is wrong with it.
        reason: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
    },
    /// A mesh without the part that the scene asks for.
    #[error("`{name}` has no part that is named `{part}`")]
    #[diagnostic(code(snell::load::no_part))]
    NoPart {
        /// As written.
        name: String,
        /// The name of the part.
        part: String,
        #[label("asked for here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
        #[help]
        #[expect(missing_docs, reason = "the help says it")]
        help: String,
    },
    /// Not a table of lens surfaces.
    #[error("`{name}` is not a lens: {reason}")]
    #[diagnostic(
        code(snell::load::bad_lens),
        help(
            "a line holds radius, distance to the next surface, index and diameter in mm; one begins with `stop`"
        )
    )]
    BadLens {
        /// As written.
        name: String,
        /// What is wrong with it, and in which line.
        reason: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
    },
    /// Not a picture that can be read.
    #[error("`{name}` cannot be used as a picture: {reason}")]
    #[diagnostic(
        code(snell::load::bad_picture),
        help("save it again as PNG, JPEG, BMP, TGA, PPM, HDR or EXR, with at most 32,768 pixels a side")
    )]
    BadPicture {
        /// As written.
        name: String,
        /// What is wrong with it.
        reason: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
    },
    /// Read, but not quite as the file says.
    #[error("`{name}` is read {note}")]
    #[diagnostic(code(snell::load::mesh_note), severity(warning))]
    MeshNote {
        /// As written.
        name: String,
        /// What was read differently.
        note: String,
        #[label("named here")]
        #[expect(missing_docs, reason = "the label says it")]
        used: Span,
        #[help]
        #[expect(missing_docs, reason = "the help says it")]
        help: &'static str,
    },
}

impl LoadError {
    /// The report for a file that could not be found.
    pub fn not_found(name: &str, used: Span, missing: Missing) -> Self {
        let name = name.to_owned();
        match missing {
            Missing::Outside { .. } => Self::Outside { name, used },
            Missing::NotFound { tried, near } => {
                let help = where_it_was_sought(&name, &tried, &near);
                Self::MissingFile { name, used, help }
            }
        }
    }
}
