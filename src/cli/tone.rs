//! `snell tone`: a picture of radiance, shown anew.

use super::{Exit, fail, note};
use crate::diag::did_you_mean;
use crate::output::{self, Display, Exposure, Format, Picture, Tone, is_linear};
use clap::Args;
use std::path::{Path, PathBuf};

/// Arguments of `snell tone`.
#[derive(Args, Debug)]
pub struct ToneArgs {
    /// A picture that holds radiance: .exr or .hdr
    #[arg(value_name = "PICTURE")]
    picture: PathBuf,
    /// Write the result here: .png or .ppm; may be repeated [default: the picture's name with .png]
    #[arg(short, long = "output", value_name = "FILE")]
    outputs: Vec<PathBuf>,
    /// How bright: stops such as `1.5EV`, or `auto` for a mean of 0.18 [default: as the picture says, or `0EV`]
    #[arg(long, value_name = "EV", allow_hyphen_values = true)]
    exposure: Option<Exposure>,
    /// The curve: srgb, linear, reinhard or agx [default: as the picture says, or `srgb`]
    #[arg(long, value_name = "CURVE", value_parser = curve)]
    tone: Option<Tone>,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

/// Writes the picture as display values.
pub fn run(args: &ToneArgs) -> Exit {
    match tone(args) {
        Ok(said) => {
            if !args.quiet {
                note(said);
            }
            Exit::Done
        }
        Err(reason) => fail(reason),
    }
}

fn tone(args: &ToneArgs) -> Result<String, String> {
    let outputs = match args.outputs.as_slice() {
        [] => vec![args.picture.with_extension("png")],
        outputs => outputs.to_vec(),
    };
    let formats = outputs.iter().map(|path| format(path)).collect::<Result<Vec<_>, _>>()?;
    let picture = output::read(&args.picture).map_err(|error| error.to_string())?;
    if picture.is_display {
        let shown = args.picture.display();
        return Err(format!("`{shown}` holds display values, whose light is lost: give an .exr or .hdr"));
    }
    let display = display(args, &picture);
    let pixels = display.develop(&picture.radiance);
    for (path, format) in outputs.iter().zip(formats) {
        let bytes = output::encode_display(format, (picture.width, picture.height), &pixels)
            .map_err(|error| error.to_string())?;
        output::replace(path, &bytes).map_err(|error| error.to_string())?;
    }
    let names: Vec<String> = outputs.iter().map(|path| path.display().to_string()).collect();
    Ok(format!("{}, exposure {}, {}\n", names.join(", "), display.exposure, display.tone.name()))
}

/// What the command says, what the picture says, or what a scene has by default.
fn display(args: &ToneArgs, picture: &Picture) -> Display {
    let exposure = || picture.fact("exposure").and_then(|said| said.parse().ok());
    let tone = || picture.fact("tone").and_then(Tone::named);
    Display {
        exposure: args.exposure.or_else(exposure).unwrap_or(Exposure::Ev(0.0)),
        tone: args.tone.or_else(tone).unwrap_or(Tone::Srgb),
        floor: false,
    }
}

/// The format of a file of display values.
fn format(path: &Path) -> Result<Format, String> {
    match Format::of(path) {
        Some(format) if !is_linear(path) => Ok(format),
        _ => Err(format!("`{}`: display values are written as .png or .ppm", path.display())),
    }
}

fn curve(name: &str) -> Result<Tone, String> {
    let names = Tone::ALL.map(Tone::name);
    Tone::named(name).ok_or_else(|| {
        did_you_mean(name, names).unwrap_or_else(|| format!("the curves are {}", names.join(", ")))
    })
}
