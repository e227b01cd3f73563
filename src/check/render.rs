//! How long to render, and with how many photons.

use super::Check;
use super::error::CheckError;
use crate::schema::{Field, Type, block};
use crate::source::Spanned;

/// A relative error above this is that of a picture which has hardly begun.
const LOOSE: f64 = 0.5;

impl Check<'_> {
    /// Checks the `render` block.
    pub(super) fn render(&mut self) {
        let render = &self.scene.render;
        if let Some(passes) = render.stop.passes {
            self.positive("the number of passes", passes.map(f64::from), Type::Int);
        }
        if let Some(seconds) = render.stop.seconds {
            self.positive("the time to render", seconds, Type::Time);
        }
        if let Some(error) = render.stop.error {
            self.positive("the error to stop at", error, Type::Number);
            if error.value > LOOSE {
                let found = format!("{}%", 100.0 * error.value);
                self.report(CheckError::LooseError { found, used: error.span });
            }
        }
        let photons = render.photons;
        self.setting("the number of photons", "count", photons.count.map(|count| count.map(f64::from)));
        self.setting("`k`", "k", photons.k.map(|k| k.map(f64::from)));
        self.setting("the radius of an estimate", "radius", photons.radius);
        self.setting("`shrink`", "shrink", photons.shrink);
    }

    /// Notes a photon setting outside the range that the registry declares.
    fn setting(&mut self, what: &'static str, name: &str, value: Option<Spanned<f64>>) {
        let declared = block("photons").and_then(|photons| photons.field(name));
        let (Some(value), Some(field @ Field { ty, range: Some(range), .. })) = (value, declared) else {
            return;
        };
        if !range.contains(value.value) {
            let (found, range) = (ty.write(value.value), range.describe(*ty));
            let example = field.example().to_owned();
            self.report(CheckError::OutOfRange { what, found, range, example, used: value.span });
        }
    }
}
