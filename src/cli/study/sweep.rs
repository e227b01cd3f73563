//! `--sweep KEY=VALUES` of `study`: what is varied, and the variants that come of it.

use super::variant::{FILTERS, SAMPLERS, Setting, Variant};
use crate::check::WIDEST_FILTER;
use crate::cli::args::Method;
use crate::diag::did_you_mean;
use crate::ir;
use crate::plan::Tessellation;
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
