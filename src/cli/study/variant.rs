//! One of the ways to render a scene that a study compares, and what it is called.

use crate::cli::args::Method;
use crate::ir;
use crate::plan::{Plan, Tessellation};
use crate::render::Sampling;

/// A key with one value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Setting {
    Method(Method),
    Photons(u32),
    K(u32),
    Radius(f64),
    Shrink(f64),
    Depth(u32),
    Sampler(Sampling),
    Filter(ir::Filter),
    Tolerance(Tessellation),
    Passes(u32),
}

/// Samplers by name.
pub const SAMPLERS: [(&str, Sampling); 2] =
    [("sobol", Sampling::Sobol), ("independent", Sampling::Independent)];

/// Pixel filters, as wide as the language's examples make them.
pub const FILTERS: [(&str, ir::Filter); 5] = [
    ("box", ir::Filter::Box(0.5)),
    ("tent", ir::Filter::Tent(1.0)),
    ("gaussian", ir::Filter::Gaussian(1.5)),
    ("mitchell", ir::Filter::Mitchell(2.0)),
    ("blackman_harris", ir::Filter::BlackmanHarris(2.0)),
];

/// One way to render the scene.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Variant {
    pub settings: Vec<Setting>,
}

impl Variant {
    /// The method, where it is varied.
    pub fn method(&self) -> Option<Method> {
        self.settings.iter().find_map(|setting| match setting {
            Setting::Method(method) => Some(*method),
            _ => None,
        })
    }

    /// The plan with this variant's values.
    pub fn apply(&self, plan: &mut Plan) {
        for setting in &self.settings {
            match *setting {
                Setting::Method(_) | Setting::Passes(_) | Setting::Sampler(_) | Setting::Filter(_) => {}
                Setting::Tolerance(tessellation) => plan.tessellation = tessellation,
                Setting::Photons(count) => plan.photon_count = count,
                Setting::K(k) => plan.photon_k = k,
                Setting::Radius(radius) => plan.photon_radius = Some(radius),
                Setting::Shrink(shrink) => plan.photon_shrink = shrink,
                Setting::Depth(depth) => plan.depth = depth,
            }
        }
    }

    /// How its samples are spread.
    pub fn sampling(&self) -> Sampling {
        let sampling = self.settings.iter().find_map(|setting| match setting {
            Setting::Sampler(sampling) => Some(*sampling),
            _ => None,
        });
        sampling.unwrap_or_default()
    }

    /// The camera with this variant's filter.
    pub fn seen_through(&self, camera: &ir::Camera) -> ir::Camera {
        let mut camera = camera.clone();
        for setting in &self.settings {
            if let Setting::Filter(filter) = *setting {
                camera.film.filter.value = filter;
            }
        }
        camera
    }

    /// What makes the reference that judges it: a picture by the same filter, for a filter says what the picture is to be,
    /// and of shapes as exact as they can be. All else is the scene's own.
    pub fn judge(&self) -> Self {
        let settings = self.settings.iter().filter_map(|setting| match setting {
            Setting::Filter(_) => Some(*setting),
            Setting::Tolerance(_) => Some(Setting::Tolerance(Tessellation::Exact)),
            _ => None,
        });
        Self { settings: settings.collect() }
    }

    /// What it is called in tables, under a method: `ppm k=60`. What the method has no use for is left out.
    pub fn name(&self, method: ir::Method) -> String {
        let has_photons = has_photons(method);
        let words = self.settings.iter().filter_map(|setting| match *setting {
            Setting::Photons(count) if has_photons => Some(format!("photons={count}")),
            Setting::K(k) if has_photons => Some(format!("k={k}")),
            Setting::Radius(radius) if has_photons => Some(format!("radius={}", length_text(radius))),
            Setting::Shrink(shrink) if has_photons => Some(format!("shrink={shrink}")),
            Setting::Depth(depth) => Some(format!("depth={depth}")),
            Setting::Sampler(sampling) => Some(format!("sampler={}", name_of(sampling, &SAMPLERS)?)),
            Setting::Filter(filter) => Some(format!("filter={}", filter_text(filter)?)),
            Setting::Tolerance(Tessellation::Within(tolerance)) => {
                Some(format!("tolerance={}", length_text(tolerance)))
            }
            Setting::Tolerance(_) => Some("tolerance=exact".to_owned()),
            _ => None,
        });
        let name = method_name(method);
        std::iter::once(name).chain(words).collect::<Vec<_>>().join(" ")
    }
}

/// The name of a method, as it is asked for.
pub fn method_name(method: ir::Method) -> String {
    format!("{method:?}").to_lowercase()
}

/// Whether a method gathers photons.
pub fn has_photons(method: ir::Method) -> bool {
    !matches!(method, ir::Method::Pt | ir::Method::Classic)
}

fn name_of<T: PartialEq>(value: T, words: &[(&'static str, T)]) -> Option<&'static str> {
    words.iter().find(|(_, known)| *known == value).map(|(name, _)| *name)
}

/// As it is written; a usual radius is left out.
fn filter_text(filter: ir::Filter) -> Option<String> {
    let usual = name_of(filter, &FILTERS).map(str::to_owned);
    usual.or_else(|| {
        let same = |known: ir::Filter| known.with_radius(filter.radius()) == filter;
        let (name, _) = FILTERS.iter().find(|(_, known)| same(*known))?;
        Some(format!("{name}({}px)", filter.radius()))
    })
}

fn length_text(metres: f64) -> String {
    match metres {
        m if m >= 1.0 => format!("{m}m"),
        m if m >= 0.01 => format!("{}cm", (m * 1e4).round() / 100.0),
        m => format!("{}mm", (m * 1e7).round() / 1e4),
    }
}

#[cfg(test)]
mod tests {
    use super::super::sweep::{parse, variants};
    use super::*;

    #[test]
    fn a_reference_has_the_filter_of_its_variants_and_exact_shapes() {
        let sweeps = ["filter=box,tent(2px)", "tolerance=exact,1mm", "sampler=sobol,independent"];
        let all = variants(&sweeps.map(|text| parse(text).unwrap()));
        assert_eq!(all.len(), 8);
        let judges: Vec<String> = all.iter().map(|variant| variant.judge().name(ir::Method::Pt)).collect();
        assert_eq!(judges[0], "pt filter=box tolerance=exact");
        assert!(judges[..4].iter().all(|judge| *judge == judges[0]), "{judges:?}");
        assert_eq!(all[7].name(ir::Method::Pt), "pt filter=tent(2px) tolerance=1mm sampler=independent");
        assert_eq!((all[0].sampling(), all[1].sampling()), (Sampling::Sobol, Sampling::Independent));
    }
}
