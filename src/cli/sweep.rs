//! `--sweep KEY=VALUES` of `study`: what is varied, and the variants that come of it.

use super::args::Method;
use crate::diag::did_you_mean;
use crate::ir;
use crate::plan::Plan;
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
    Passes(u32),
}

const KEYS: [(&str, Key); 8] = [
    ("method", Key::Method),
    ("photons", Key::Photons),
    ("k", Key::K),
    ("radius", Key::Radius),
    ("shrink", Key::Shrink),
    ("depth", Key::Depth),
    ("passes", Key::Passes),
    ("spp", Key::Passes),
];

/// What will be possible to vary, but is not yet.
const NOT_YET: [&str; 5] = ["tolerance", "filter", "precision", "watertight", "sampler"];

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
    if NOT_YET.contains(&name) {
        return format!("`{name}` cannot be varied yet; what can is {}", names.join(", "));
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
                Setting::Method(_) | Setting::Passes(_) => {}
                Setting::Photons(count) => plan.photon_count = count,
                Setting::K(k) => plan.photon_k = k,
                Setting::Radius(radius) => plan.photon_radius = Some(radius),
                Setting::Shrink(shrink) => plan.photon_shrink = shrink,
                Setting::Depth(depth) => plan.depth = depth,
            }
        }
    }

    /// What it is called in tables, under a method: `ppm k=60`. What the method has no use for is left out.
    pub fn name(&self, method: ir::Method) -> String {
        let has_photons = !matches!(method, ir::Method::Pt | ir::Method::Classic);
        let words = self.settings.iter().filter_map(|setting| match *setting {
            Setting::Photons(count) if has_photons => Some(format!("photons={count}")),
            Setting::K(k) if has_photons => Some(format!("k={k}")),
            Setting::Radius(radius) if has_photons => Some(format!("radius={}", length_text(radius))),
            Setting::Shrink(shrink) if has_photons => Some(format!("shrink={shrink}")),
            Setting::Depth(depth) => Some(format!("depth={depth}")),
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
    fn values_have_units_and_limits() {
        assert_eq!(parse("radius=5cm").unwrap().values, [Setting::Radius(0.05)]);
        assert_eq!(parse("photons=1e5,200_000").unwrap().values.len(), 2);
        for (text, words) in [
            ("methd=pt", "did you mean `method`?"),
            ("tolerance=1mm", "cannot be varied yet"),
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
