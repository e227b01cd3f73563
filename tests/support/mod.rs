//! What several tests share.

mod meshes;
mod random;
mod scenes;
mod walk;

pub use meshes::*;
pub use random::Random;
pub use scenes::{film_bits, render_planned, render_text};
pub use walk::{Walk, conservative_slab, fused_slab, hasty_slab};
