//! Materials that say what share of light they reflect, by the angle of view.

use super::lobes::Lobes;
use crate::convert::fields::Fields;
use crate::convert::read::Reader;
use crate::convert::words::{FRESNEL, normalised};

impl Reader<'_> {
    /// `Fresnel { fbase b fscale s power p }`: the share `b + s (1 - cos)^p` is reflected, and the rest refracted where
    /// the material has an index of refraction, else scattered.
    ///
    /// Glass reflects by its index here. On an opaque surface the mean share over all directions, weighted by their
    /// cosine, stands for the law: `b + 2 s / ((p + 1) (p + 2))`.
    pub(super) fn lobes_of_fresnel(&mut self, fields: &mut Fields<'_>) -> Option<Lobes> {
        let block = fields.take_block(|name| normalised(name) == "fresnel")?;
        let head = block.head.clone();
        let mut law = self.log.fields(block, &FRESNEL);
        if fields.peek("index").is_some_and(|index| index.number(0) > 1.0) {
            self.log.put_aside(&mut law, &["base", "scale", "power"], "glass reflects by its index here");
            self.log.approximated(&head, "`glass`, which reflects by its index");
            self.log.finish(law);
            return Some(Lobes::glass());
        }
        let mut number = |role| {
            let field = self.log.take(&mut law, role);
            field
                .inspect(|field| self.log.approximated(&field.span, "the mean share of a `mirror`"))
                .map(|f| f.number(0))
        };
        let base = number("base").unwrap_or(0.0);
        let (scale, power) = (number("scale").unwrap_or(0.0), number("power").unwrap_or(1.0).max(0.0));
        self.log.approximated(&head, "the mean share of a `mirror`, the same at every angle");
        self.log.finish(law);
        let share = (base + 2.0 * scale / ((power + 1.0) * (power + 2.0))).clamp(0.0, 1.0);
        let is_said = share > 0.0 && share.is_finite();
        is_said.then(|| Lobes::mirrored(share))
    }
}
