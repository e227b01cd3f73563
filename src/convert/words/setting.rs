//! Keys of blocks that tell the original's renderer what to do, and of lists of pictures.

use super::Args::{Free, Numbers, Path};
use super::Values::Number;
use super::{Index, Vocabulary, row, stem};

/// `Model`, `Photon`, `Render` and the like.
pub static SETTINGS: Vocabulary = Vocabulary {
    rows: &[
        row("samples", Numbers(1), "SPP spp samples"),
        row("switch", Free, "tracing sampling rrProb OMP gamma tmin"),
    ],
    stems: &[stem("samples", Number, "sampleperpixel samplesperpixel spp")],
    index: Index::new(),
};

/// `Textures` and the blocks in it: any key with a word names a file.
pub static TEXTURES: Vocabulary = Vocabulary {
    rows: &[
        row("count", Numbers(1), "numTextures numTexture"),
        row("file", Path, "Texture texture imgFile file"),
    ],
    stems: &[],
    index: Index::new(),
};
