//! `--sweep KEY=VALUES` of `study`: what is varied, and the variants that come of it.

use crate::check::WIDEST_FILTER;
use crate::cli::args::Method;
use crate::diag::did_you_mean;
use crate::ir;
use crate::plan::{Plan, Tessellation};
use crate::render::Sampling;
use clap::ValueEnum;

/// One key with its values.
#[derive(Clone, PartialEq, Debug)]
pub struct Sweep {
    key: Key,
    /// Each as it was written.
    values: Vec<Setting>,
}

/// What can be varied.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Key {
    Method,
    Photons,
    K,
    Radius,
    Shrink,
    Depth,
    Sampler,
    Filter,
    Tolerance,
    Passes,
}

/// A key with one value.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Setting {
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

const KEYS: [(&str, Key); 11] = [
    ("method", Key::Method),
    ("photons", Key::Photons),
    ("k", Key::K),
    ("radius", Key::Radius),
    ("shrink", Key::Shrink),
    ("depth", Key::Depth),
    ("sampler", Key::Sampler),
    ("filter", Key::Filter),
    ("tolerance", Key::Tolerance),
    ("passes", Key::Passes),
    ("spp", Key::Passes),
];

/// What has a price, but only one form in the program.
const ALWAYS: [(&str, &str); 2] = [
    ("precision", "what must be in double precision always is"),
    ("watertight", "every triangle test is watertight"),
];

/// Reads `KEY=VALUE,VALUE…`.
///
/// # Errors
/// What to write instead.
pub fn parse(text: &str) -> Result<Sweep, String> {
    let (name, values) =
        text.split_once('=').ok_or_else(|| "write KEY=VALUE,VALUE, such as `method=pt,ppm`".to_owned())?;
    let name = name.trim();
    let key = KEYS.iter().find(|(known, _)| *known == name).map(|(_, key)| *key);
    let key = key.ok_or_else(|| unknown(name))?;
    let values: Vec<Setting> =
        values.split(',').map(|value| key.read(value.trim())).collect::<Result<_, _>>()?;
    Ok(Sweep { key, values })
}

fn unknown(name: &str) -> String {
    let names = KEYS.map(|(name, _)| name);
    if let Some((_, why)) = ALWAYS.iter().find(|(known, _)| *known == name) {
        return format!(
            "`{name}` cannot be varied: {why}, and docs/hard-cases.md has what that costs; what can be varied is {}",
            names.join(", ")
        );
    }
    did_you_mean(name, names).unwrap_or_else(|| format!("what can be varied is {}", names.join(", ")))
}

impl Key {
    fn read(self, value: &str) -> Result<Setting, String> {
        let count = |least: u32| {
            let number = value.replace('_', "").parse::<f64>().ok().filter(|x| x.fract() == 0.0);
            let whole = number.filter(|x| (f64::from(least)..=f64::from(u32::MAX)).contains(x));
            whole.map(|x| x as u32).ok_or_else(|| format!("`{value}` is no whole number from {least} on"))
        };
        Ok(match self {
            Self::Method => Setting::Method(method(value)?),
            Self::Photons => Setting::Photons(count(1)?),
            Self::K => Setting::K(count(2)?),
            Self::Depth => Setting::Depth(count(1)?.min(65_535)),
            Self::Passes => Setting::Passes(count(1)?),
            Self::Sampler => Setting::Sampler(word(value, "sampler", &SAMPLERS)?),
            Self::Filter => Setting::Filter(filter(value)?),
            Self::Tolerance if value == "exact" => Setting::Tolerance(Tessellation::Exact),
            Self::Tolerance => Setting::Tolerance(Tessellation::Within(length(value)?)),
            Self::Radius => Setting::Radius(length(value)?),
            Self::Shrink => {
                let share = value.parse().ok().filter(|x: &f64| 0.0 < *x && *x < 1.0);
                Setting::Shrink(share.ok_or_else(|| format!("`{value}` is no number between 0 and 1"))?)
            }
        })
    }
}

fn method(value: &str) -> Result<Method, String> {
    let names: Vec<String> = Method::value_variants()
        .iter()
        .filter_map(|method| Some(method.to_possible_value()?.get_name().to_owned()))
        .collect();
    Method::from_str(value, true).map_err(|_| {
        let near = did_you_mean(value, names.iter().map(String::as_str));
        format!("no method is called `{value}`: {}", near.unwrap_or_else(|| names.join(", ")))
    })
}

const SAMPLERS: [(&str, Sampling); 2] = [("sobol", Sampling::Sobol), ("independent", Sampling::Independent)];

/// Pixel filters, as wide as the language's examples make them.
const FILTERS: [(&str, ir::Filter); 5] = [
    ("box", ir::Filter::Box(0.5)),
    ("tent", ir::Filter::Tent(1.0)),
    ("gaussian", ir::Filter::Gaussian(1.5)),
    ("mitchell", ir::Filter::Mitchell(2.0)),
    ("blackman_harris", ir::Filter::BlackmanHarris(2.0)),
];

/// `tent` or `tent(2px)`.
fn filter(value: &str) -> Result<ir::Filter, String> {
    let (name, radius) = match value.strip_suffix(')').and_then(|value| value.split_once('(')) {
        None => (value, None),
        Some((name, radius)) => {
            let pixels =
                radius.trim().strip_suffix("px").and_then(|number| number.trim().parse::<f64>().ok());
            let pixels = pixels.filter(|pixels| *pixels > 0.0 && *pixels <= WIDEST_FILTER);
            (name.trim(), Some(pixels.ok_or_else(|| format!("`{radius}` is no radius such as `1px`"))?))
        }
    };
    let filter = word(name, "filter", &FILTERS)?;
    Ok(radius.map_or(filter, |radius| filter.with_radius(radius)))
}

/// What one of a few words stands for.
fn word<T: Copy>(value: &str, kind: &str, words: &[(&str, T)]) -> Result<T, String> {
    let known = words.iter().find(|(known, _)| *known == value);
    known.map(|(_, meaning)| *meaning).ok_or_else(|| {
        let names: Vec<&str> = words.iter().map(|(name, _)| *name).collect();
        let near = did_you_mean(value, names.iter().copied());
        format!("no {kind} is called `{value}`: {}", near.unwrap_or_else(|| names.join(", ")))
    })
}

/// `5cm`, `2mm`, `0.1m`.
fn length(value: &str) -> Result<f64, String> {
    const UNITS: [(&str, f64); 4] = [("mm", 1e-3), ("cm", 1e-2), ("km", 1e3), ("m", 1.0)];
    let unit = UNITS.iter().find_map(|(unit, factor)| Some((value.strip_suffix(unit)?, factor)));
    let metres = unit.and_then(|(number, factor)| Some(number.trim().parse::<f64>().ok()? * factor));
    metres
        .filter(|metres| *metres > 0.0 && metres.is_finite())
        .ok_or_else(|| format!("`{value}` is no length such as `5cm`"))
}

/// One way to render the scene.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Variant {
    settings: Vec<Setting>,
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
        m => format!("{}mm", (m * 1e5).round() / 100.0),
    }
}

/// Every combination of the values, in the order in which they were given.
pub fn variants(sweeps: &[Sweep]) -> Vec<Variant> {
    let mut out = vec![Variant::default()];
    for sweep in sweeps.iter().filter(|sweep| sweep.key != Key::Passes) {
        let with = |variant: &Variant, value: &Setting| {
            let settings = variant.settings.iter().copied().chain([*value]).collect();
            Variant { settings }
        };
        out = out
            .iter()
            .flat_map(|variant| sweep.values.iter().map(move |value| with(variant, value)))
            .collect();
    }
    out
}

/// Whether the shapes that triangles stand for are varied.
pub fn varies_tolerance(sweeps: &[Sweep]) -> bool {
    sweeps.iter().any(|sweep| sweep.key == Key::Tolerance)
}

/// The most passes that are asked for: all doublings up to there are measured anyway.
pub fn passes(sweeps: &[Sweep]) -> Option<u32> {
    let values = sweeps.iter().flat_map(|sweep| &sweep.values);
    let passes = values.filter_map(|value| match value {
        Setting::Passes(passes) => Some(*passes),
        _ => None,
    });
    passes.max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sweeps_multiply() {
        let sweeps = ["method=pt,ppm", "k=20,60", "spp=16,64"].map(|text| parse(text).unwrap());
        let all = variants(&sweeps);
        assert_eq!(all.len(), 4);
        assert_eq!(all[1].name(ir::Method::Pt), "pt");
        assert_eq!(all[3].name(ir::Method::Ppm), "ppm k=60");
        assert_eq!(passes(&sweeps), Some(64));
        assert_eq!(variants(&[]).len(), 1);
    }

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

    #[test]
    fn values_have_units_and_limits() {
        assert_eq!(parse("radius=5cm").unwrap().values, [Setting::Radius(0.05)]);
        assert_eq!(parse("photons=1e5,200_000").unwrap().values.len(), 2);
        for (text, words) in [
            ("methd=pt", "did you mean `method`?"),
            ("watertight=on", "docs/hard-cases.md"),
            ("sampler=sobl", "did you mean `sobol`?"),
            ("filter=tent(1)", "such as `1px`"),
            ("filter=hat", "box, tent, gaussian"),
            ("tolerance=fine", "such as `5cm`"),
            ("method=ptt", "did you mean `pt`?"),
            ("k=1", "from 2 on"),
            ("radius=5", "such as `5cm`"),
            ("shrink=2", "between 0 and 1"),
            ("method", "KEY=VALUE"),
            ("depth=", "no whole number"),
        ] {
            let said = parse(text).unwrap_err();
            assert!(said.contains(words), "{text}: {said}");
        }
    }
}
