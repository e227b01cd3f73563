//! Effects that a picture is made without, though its scene calls for them: refused, or measured and told.

use super::pilot;
use super::session::Session;
use crate::ir::Camera;
use crate::load::Loaded;
use crate::plan::{EffectUse, Plan, Wanted};
use crate::source::SourceMap;

/// What a picture lacks.
pub struct Loss {
    /// The effects that were left out.
    pub effects: Vec<&'static str>,
    /// The share of the picture's light that is gone; less than 0 where there is more.
    pub energy: f64,
}

/// Why effects are not left out, if they are not: the scene calls for one, or no method can do without.
pub fn refusal(
    left_out: &[EffectUse],
    plan: &Plan,
    camera: &Camera,
    lossy: bool,
    sources: &SourceMap,
) -> Option<String> {
    let barred = |used: &EffectUse| crate::lower::can_leave_out(used.effect, plan, camera).err();
    if let Some(reason) = left_out.iter().find_map(barred) {
        return Some(reason);
    }
    let used = left_out.first().filter(|_| !lossy)?;
    let place = sources.location(used.span).map_or(String::new(), |place| place.to_string());
    let others = match used.count - 1 {
        0 => String::new(),
        1 => " and one more place".to_owned(),
        more => format!(" and {more} more places"),
    };
    let without = used.effect.without().unwrap_or("different");
    Some(format!(
        "the scene calls for `{}` at {place}{others}: without it the picture is {without}; `--lossy` makes such a picture",
        used.effect.name()
    ))
}

/// Passes of each.
const PASSES: u32 = 16;

impl Loss {
    /// Makes two small pictures, with and without the effects; both draw the same numbers.
    pub fn measure(
        left_out: &[EffectUse],
        loaded: &Loaded<'_>,
        plan: &Plan,
        camera: &Camera,
        session: &mut Session,
    ) -> Option<Self> {
        let mut whole = plan.clone();
        whole.want(&left_out.iter().map(|used| Wanted::With(used.effect)).collect::<Vec<_>>());
        let small = pilot::small(camera);
        let mut light = |plan: &Plan| {
            let lowered = crate::lower::lower(loaded, plan, &small, &session.files, &mut session.problems)?;
            let film = pilot::passes(&lowered, plan, PASSES, 0).film;
            Some(film.mean().iter().map(|pixel| f64::from(pixel.luminance())).sum::<f64>())
        };
        let (without, with) = (light(plan)?, light(&whole)?);
        let energy = if with > 0.0 { 1.0 - without / with } else { 0.0 };
        Some(Self { effects: left_out.iter().map(|used| used.effect.name()).collect(), energy })
    }
}
