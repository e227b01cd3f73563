//! Arguments that several commands share, and how their values are written.

use crate::diag::did_you_mean;
use crate::resolve::Limits;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Which scene, and where its files are.
#[derive(Args, Default, Debug)]
pub struct SceneArgs {
    /// Set a parameter of the scene, type-checked; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = name_and_value)]
    pub sets: Vec<(String, String)>,
    /// Look for meshes and pictures here too; may be repeated
    #[arg(long = "asset-dir", value_name = "DIR")]
    pub asset_dirs: Vec<PathBuf>,
    /// Let the scene name files outside its folder
    #[arg(long)]
    pub allow_outside: bool,
    /// Raise a limit on what the scene may ask for: objects, turns, elements, steps or problems
    #[arg(long = "limit", value_name = "NAME=N", value_parser = limit)]
    pub limits: Vec<(String, u64)>,
    /// Treat warnings as errors
    #[arg(long, value_name = "WHAT")]
    pub deny: Option<Deny>,
}

/// What `--deny` denies.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Deny {
    /// Every warning.
    Warnings,
}

/// How messages look.
#[derive(Args, Debug)]
pub struct MessageArgs {
    /// The form of diagnostics
    #[arg(long, value_name = "FORM", default_value = "human")]
    pub message_format: MessageFormat,
    /// When to use colour
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub color: Color,
    /// Say nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

impl MessageArgs {
    /// Whether messages are read by programs, a line each.
    pub fn is_for_programs(&self) -> bool {
        self.message_format == MessageFormat::Json
    }
}

/// The forms of diagnostics.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum MessageFormat {
    /// With the source, labels and help.
    Human,
    /// One line each.
    Short,
    /// One JSON object a line.
    Json,
    /// One SARIF 2.1.0 document, for code scanners and editors.
    Sarif,
}

/// The form of a result.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Format {
    /// For people.
    Human,
    /// For programs.
    Json,
}

/// When to use colour.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Color {
    /// On a terminal, unless NO_COLOR is set.
    Auto,
    /// Also into a pipe.
    Always,
    /// Never.
    Never,
}

/// The methods that can be asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Method {
    /// What suits the scene, also against what it says.
    Auto,
    /// Path tracing.
    Pt,
    /// Progressive photon mapping.
    Ppm,
    /// Path tracing, with caustics from photons.
    Hybrid,
    /// Recursive ray tracing, with the scene's own settings if it has any.
    Classic,
}

fn name_and_value(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write NAME=VALUE, such as `seats=6` or `f_stop=f/8`".to_owned()),
    }
}

/// `objects=1e8`: a limit by name, and what it shall be.
fn limit(text: &str) -> Result<(String, u64), String> {
    let (name, value) =
        name_and_value(text).map_err(|_| "write NAME=N, such as `objects=100000000`".to_owned())?;
    if !Limits::NAMES.contains(&name.as_str()) {
        let near = did_you_mean(&name, Limits::NAMES);
        return Err(near.unwrap_or_else(|| format!("the limits are {}", Limits::NAMES.join(", "))));
    }
    let number = value.replace('_', "").parse::<f64>().ok();
    let whole = number.filter(|number| (1.0..=1e18).contains(number) && number.fract() == 0.0);
    whole.map(|number| (name, number as u64)).ok_or_else(|| format!("`{value}` is no whole number from 1 on"))
}

/// `640x480`: both at least 1 and at most 65,536.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let sides =
        text.split_once('x').and_then(|(w, h)| Some((w.trim().parse().ok()?, h.trim().parse().ok()?)));
    match sides {
        Some((w, h)) if (1..=65_536).contains(&w) && (1..=65_536).contains(&h) => Ok((w, h)),
        Some(_) => Err("each side is from 1 to 65,536 pixels".to_owned()),
        None => Err("write WIDTHxHEIGHT, such as `640x480`".to_owned()),
    }
}

/// `90s`, `5min`, `2h`; a bare number counts seconds.
pub fn seconds(text: &str) -> Result<f64, String> {
    const UNITS: [(&str, f64); 4] = [("ms", 1e-3), ("min", 60.0), ("h", 3600.0), ("s", 1.0)];
    let unit = UNITS.iter().find_map(|(unit, factor)| Some((text.strip_suffix(unit)?, *factor)));
    let (number, factor) = unit.unwrap_or((text, 1.0));
    positive(number)
        .map(|value| value * factor)
        .ok_or_else(|| "write a time such as `90s` or `5min`".to_owned())
}

/// `1%` or `0.01`; 1 and more without a sign is likely to be meant in percent.
pub fn share(text: &str) -> Result<f64, String> {
    let (number, factor) = text.strip_suffix('%').map_or((text, 1.0), |number| (number, 0.01));
    match positive(number) {
        Some(value) if factor == 1.0 && value >= 1.0 => Err(format!("write `{text}%`, or a share below 1")),
        Some(value) => Ok(value * factor),
        None => Err("write an error such as `1%` or `0.01`".to_owned()),
    }
}

/// A whole number from 0.
pub fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "a seed is a whole number from 0 to 18446744073709551615".to_owned())
}

fn positive(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|value: &f64| *value > 0.0 && value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_with_their_units() {
        assert_eq!(size("1024x768"), Ok((1024, 768)));
        assert!(size("0x5").is_err() && size("640").is_err() && size("axb").is_err());
        assert_eq!(seconds("5min"), Ok(300.0));
        assert_eq!(seconds("250ms"), Ok(0.25));
        assert!(seconds("-1s").is_err() && seconds("nan").is_err() && seconds("soon").is_err());
        assert_eq!(share("2%"), Ok(0.02));
        assert!(share("0").is_err());
        assert_eq!(limit("objects=1e8"), Ok(("objects".to_owned(), 100_000_000)));
        assert_eq!(limit("objcts=5"), Err("did you mean `objects`?".to_owned()));
        assert!(limit("steps=-1").is_err() && limit("steps").is_err());
        assert!(name_and_value("seats").is_err() && name_and_value("=3").is_err());
    }
}
