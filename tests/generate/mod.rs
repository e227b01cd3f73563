//! Random scenes without mistakes of form: items, blocks, fields and functions as the registry declares them, every kind
//! of expression, long lists, and comments, blanks and line ends wherever the language lets them stand.
//!
//! What a scene says may still be nonsense to physics; that is for others to test.

mod items;
mod values;
mod writer;

use crate::robust_syntax::SplitMix;
use items::Scene;

/// The scene of this number.
pub fn scene(number: u64) -> String {
    Scene::new(SplitMix(number << 20)).write()
}

/// Files that the scenes include and import.
pub const FILES: [(&str, &str); 2] = [
    ("lib.snell", "snell 1\nlet red = diffuse { color: #aa2211 }\nlet width = 30cm\n"),
    ("room.snell", "snell 1\nplane { y: -2m }\n"),
];
