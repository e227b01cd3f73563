//! What several tests share.

mod meshes;
mod random;
mod scenes;
mod textbook;
mod walk;

pub use meshes::*;
pub use random::Random;
pub use scenes::{film_bits, render_planned, render_text};
pub use textbook::{fresnel_by_angles, textbook_distribution, textbook_fresnel, textbook_sphere};
pub use walk::{Walk, conservative_slab, fused_slab, hasty_slab};
