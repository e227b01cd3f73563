//! `snell compare`: how far a picture is from another, and whether noise explains it.

use super::args::Format;
use super::progress::percent;
use super::{Exit, fail, note, print, session};
use crate::math::Rgb;
use crate::output::{self, Exposure, Picture};
use crate::study::metrics::{self, Metrics, Relative};
use crate::study::{flip, heat, measure, welch};
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Arguments of `snell compare`.
#[derive(Args, Debug)]
pub struct CompareArgs {
    /// The picture to judge: .exr, .hdr, .png or .ppm
    #[arg(value_name = "PICTURE")]
    picture: PathBuf,
    /// The picture that is taken for the truth, of the same size
    #[arg(value_name = "REFERENCE")]
    reference: PathBuf,
    /// Write a picture of where the error is: .png or .ppm
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,
    /// What that picture shows
    #[arg(long, value_name = "METRIC", default_value = "relative")]
    heat: Heat,
    /// Fail with exit code 1 when the relative mean squared error is above this
    #[arg(long, value_name = "LIMIT", value_parser = limit, allow_hyphen_values = true)]
    max_relmse: Option<f64>,
    /// For SSIM and FLIP, show radiance times 2 to this power [default: as the reference needs it]
    #[arg(long, value_name = "EV", allow_hyphen_values = true)]
    exposure: Option<f32>,
    /// For FLIP, how many pixels an observer sees in one degree
    #[arg(long, value_name = "N", default_value_t = flip::PIXELS_PER_DEGREE, value_parser = pixels_per_degree)]
    pixels_per_degree: f64,
    /// The form of the result
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
}

/// What a heat map shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Heat {
    /// The relative error of each pixel, from 0.1 % (black) to 100 % (light yellow), even steps per factor.
    Relative,
    /// FLIP of each pixel, from 0 (black) to 1 (light yellow).
    Flip,
    /// The p-value of each tile of Welch's test, from 1 (black) down to 0.001 (light yellow), even steps per factor.
    Welch,
}

/// Compares two pictures.
pub fn run(args: &CompareArgs) -> Exit {
    compare(args).unwrap_or_else(fail)
}

fn compare(args: &CompareArgs) -> Result<Exit, String> {
    let target = args.output.as_deref().map(heat_target).transpose()?;
    let pair = Pair::read(args)?;
    let metrics = measure(&pair.picture, &pair.reference, pair.factor, args.pixels_per_degree);
    let welch = welch::test(&pair.picture, &pair.reference);
    if let Some((path, format)) = target {
        let colors = pair.heat(args, welch.as_ref())?;
        let size = (pair.reference.width, pair.reference.height);
        let bytes = output::encode_display(format, size, &colors).map_err(|error| error.to_string())?;
        output::replace(path, &bytes).map_err(|error| error.to_string())?;
    }
    match args.format {
        Format::Human => print(human(args, &pair, &metrics, welch.as_ref())),
        Format::Json => print(format_args!("{:#}\n", json(args, &pair, &metrics, welch.as_ref()))),
    }
    match args.max_relmse {
        // Not a number is over any limit.
        Some(limit) if metrics.rel_mse > limit || metrics.rel_mse.is_nan() => {
            note(format_args!("relMSE {} is above the limit {limit}\n", number(metrics.rel_mse)));
            Ok(Exit::OverLimit)
        }
        _ => Ok(Exit::Done),
    }
}

/// Two pictures of the same size.
struct Pair {
    picture: Picture,
    reference: Picture,
    /// What brings radiance to the display.
    factor: f32,
}

impl Pair {
    fn read(args: &CompareArgs) -> Result<Self, String> {
        let read = |path: &Path| {
            output::decode(path, &session::read_bytes(path)?).map_err(|error| error.to_string())
        };
        let (picture, reference) = (read(&args.picture)?, read(&args.reference)?);
        let size = |p: &Picture| (p.width, p.height);
        if size(&picture) != size(&reference) {
            return Err(format!(
                "`{}` has {} × {} pixels and `{}` {} × {}: render both in one size, such as `--size {}x{}`",
                args.picture.display(),
                picture.width,
                picture.height,
                args.reference.display(),
                reference.width,
                reference.height,
                reference.width,
                reference.height,
            ));
        }
        if picture.is_display != reference.is_display {
            let display = if picture.is_display { &args.picture } else { &args.reference };
            note(format_args!(
                "note: `{}` holds display values, which are taken for sRGB without a tone curve; compare two .exr files to \
                 be sure\n",
                display.display()
            ));
        }
        let exposure = match args.exposure {
            Some(ev) => Exposure::Ev(ev),
            None if reference.is_display => Exposure::Ev(0.0),
            None => Exposure::Auto,
        };
        let factor = exposure.factor(&reference.radiance);
        Ok(Self { picture, reference, factor })
    }

    /// The mean of the picture over that of the reference, channel by channel.
    fn ratio(&self) -> [f64; 3] {
        let sum = |p: &Picture, c: usize| p.radiance.iter().map(|pixel| f64::from(pixel[c])).sum::<f64>();
        [0, 1, 2].map(|c| sum(&self.picture, c) / sum(&self.reference, c))
    }

    /// The relative mean squared error that the noise of both pictures explains, where both know it.
    fn expected(&self) -> Option<f64> {
        let relative = Relative::to(self.reference.mean_luminance());
        let of = |errors: &[Rgb]| {
            let terms = errors.iter().zip(&self.reference.radiance);
            let terms: Vec<f64> = terms.map(|(&e, &r)| relative.of_standard_error(e, r)).collect();
            metrics::mean(&terms)
        };
        let (a, b) = (self.picture.standard_error.as_deref()?, self.reference.standard_error.as_deref()?);
        Some(of(a) + of(b))
    }

    fn heat(&self, args: &CompareArgs, welch: Option<&welch::Welch>) -> Result<Vec<[u8; 3]>, String> {
        let width = self.reference.width as usize;
        Ok(match (args.heat, welch) {
            (Heat::Relative, _) => {
                let errors = metrics::relative_errors(&self.picture, &self.reference);
                errors.into_iter().map(|square| heat::color_of_error(square.sqrt())).collect()
            }
            (Heat::Flip, _) => {
                let shown = |p: &Picture| metrics::display(&p.radiance, self.factor);
                let (wanted, test) = (shown(&self.reference), shown(&self.picture));
                flip::map(&wanted, &test, width, args.pixels_per_degree)
                    .into_iter()
                    .map(heat::color)
                    .collect()
            }
            (Heat::Welch, Some(welch)) => (0..self.reference.radiance.len())
                .map(|i| welch.tiles[i / width / welch::TILE * welch.tiles_per_row + i % width / welch::TILE])
                .map(|p| heat::color(((1.0 / p.max(1e-3)).log10() / 3.0) as f32))
                .collect(),
            (Heat::Welch, None) => return Err(NO_WELCH.to_owned()),
        })
    }
}

const NO_WELCH: &str = "Welch's test needs the standard errors of both pictures: write both as .exr by this version, with two passes or more";

/// A heat map is made of display values, so its file must hold such.
fn heat_target(path: &Path) -> Result<(&Path, output::Format), String> {
    match output::Format::of(path) {
        Some(format @ (output::Format::Png | output::Format::Ppm)) => Ok((path, format)),
        _ => Err(format!("`{}`: a heat map is written as .png or .ppm", path.display())),
    }
}

fn human(args: &CompareArgs, pair: &Pair, m: &Metrics, welch: Option<&welch::Welch>) -> String {
    let mut out = String::new();
    let (picture, reference) = (args.picture.display(), args.reference.display());
    let _ =
        writeln!(out, "{picture} against {reference}, {} × {}", pair.reference.width, pair.reference.height);
    let _ = writeln!(out, "  rmse     {}", number(m.rmse));
    let _ = match m.rel_mse {
        e if e.is_infinite() => writeln!(out, "  relMSE   infinite: the reference is black"),
        e => writeln!(
            out,
            "  relMSE   {}: an error of {}; {} without the worst 0.1 % of pixels",
            number(e),
            percent(e.sqrt()),
            number(m.rel_mse_trimmed),
        ),
    };
    if let Some(expected) = pair.expected() {
        let _ = writeln!(out, "           the noise of both explains {}", number(expected));
    }
    let _ = writeln!(out, "  ssim     {:.5}", m.ssim);
    let _ = writeln!(
        out,
        "  flip     {:.5} at exposure {:+.2} EV, {} pixels per degree",
        m.flip,
        pair.factor.log2(),
        args.pixels_per_degree
    );
    let ratio = pair.ratio().map(|ratio| format!("{ratio:.5}")).join(", ");
    let _ = writeln!(out, "  means    {ratio} of the reference's red, green and blue");
    let _ = writeln!(out, "  welch    {}", welch.map_or(NO_WELCH.to_owned(), welch_text));
    out
}

fn welch_text(welch: &welch::Welch) -> String {
    if welch.tests == 0 {
        return "nothing to test: no noise and no difference".to_owned();
    }
    let largest = *welch.histogram.iter().max().unwrap_or(&1);
    let bars = welch.histogram.iter().map(|&n| super::spark(n as f64 / largest.max(1) as f64));
    let verdict = match welch {
        w if w.differs() => "the difference is more than noise",
        w if w.uniform_p < 0.01 => "more alike than independent noise allows: do they share their seed?",
        _ => "noise explains the difference",
    };
    format!(
        "{verdict}\n           {} of {} tests of {} × {} pixels reject at 1 % for all together; the whole pictures' means: \
         p = {:.2}\n           p-values from 0 to 1: {}, evenly spread with p = {:.2}",
        welch.rejected,
        welch.tests,
        welch::TILE,
        welch::TILE,
        welch.whole_p,
        bars.collect::<String>(),
        welch.uniform_p,
    )
}

fn json(args: &CompareArgs, pair: &Pair, m: &Metrics, welch: Option<&welch::Welch>) -> Value {
    json!({
        "picture": args.picture.display().to_string(),
        "reference": args.reference.display().to_string(),
        "width": pair.reference.width,
        "height": pair.reference.height,
        "rmse": m.rmse,
        "rel_mse": m.rel_mse,
        "rel_mse_trimmed": m.rel_mse_trimmed,
        "rel_mse_of_noise": pair.expected(),
        "ssim": m.ssim,
        "flip": m.flip,
        "exposure": pair.factor.log2(),
        "pixels_per_degree": args.pixels_per_degree,
        "mean_ratio": pair.ratio(),
        "welch": welch.map(|w| json!({
            "tests": w.tests,
            "rejected": w.rejected,
            "uniform_p": w.uniform_p,
            "crowded_p": w.crowded_p,
            "whole_p": w.whole_p,
            "histogram": w.histogram,
            "differs": w.differs(),
        })),
    })
}

/// A number for people: four digits that count.
pub fn number(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        x if (1e-3..1e5).contains(&x.abs()) => {
            let digits = (3 - x.abs().log10().floor() as i32).max(0) as usize;
            format!("{x:.digits$}")
        }
        x => format!("{x:.3e}"),
    }
}

fn limit(text: &str) -> Result<f64, String> {
    text.trim()
        .parse()
        .ok()
        .filter(|limit: &f64| *limit >= 0.0)
        .ok_or_else(|| "write a number from 0 on, such as `1e-3`".to_owned())
}

fn pixels_per_degree(text: &str) -> Result<f64, String> {
    text.trim().parse().ok().filter(|n: &f64| (1.0..=1000.0).contains(n)).ok_or_else(|| {
        "write a number from 1 to 1000; 67 is a 4K display of 0.7 m seen from 0.7 m".to_owned()
    })
}
