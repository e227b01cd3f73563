//! Where a render's pictures and report go.

use super::ready::display;
use super::{RenderArgs, Rendered};
use crate::cli::layers;
use crate::output::{self, Format, Frame, OutputError, Target};
use std::path::{Path, PathBuf};

/// Where the pictures go: what `-o` says, or the scene's name.
pub fn output_names(args: &RenderArgs) -> Vec<PathBuf> {
    let default = || match args.scene.to_str() {
        Some("-") => PathBuf::from("out.png"),
        _ => args.scene.with_extension("png"),
    };
    if args.outputs.is_empty() { vec![default()] } else { args.outputs.clone() }
}

/// Makes sure that the pictures can be written.
///
/// # Errors
/// Why one cannot, in a sentence.
pub fn open_targets(paths: &[PathBuf]) -> Result<Vec<Target>, String> {
    if paths.iter().any(|path| path.as_os_str() == "-") {
        return Err("a picture does not go to standard output: name a file with `-o`".to_owned());
    }
    paths.iter().map(|path| Target::open(path).map_err(|error| error.to_string())).collect()
}

/// Makes sure that a report can be written.
///
/// # Errors
/// Why it cannot, in a sentence.
pub fn writable(report: &Path) -> Result<(), String> {
    let folder = report.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let shown = report.display();
    match () {
        () if report.is_dir() => Err(format!("`{shown}` cannot be written: it is a folder")),
        () if !folder.is_dir() => Err(format!("`{shown}` cannot be written: there is no folder for it")),
        () => Ok(()),
    }
}

/// Writes the picture into all targets, which are still under their temporary names.
///
/// # Errors
/// When one cannot be written.
pub fn write(targets: &mut [Target], args: &RenderArgs, rendered: &Rendered) -> Result<(), OutputError> {
    let (outcome, ready) = (&rendered.outcome, &rendered.ready);
    let display = display(&ready.camera.film, ready.floor);
    let mut facts = rendered.summary().facts();
    facts.extend(display.facts());
    let wanted = if holds_layers(targets) { layers::chosen(&args.layers) } else { Vec::new() };
    let mut planes = layers::planes(&wanted, &ready.lowered.world, ready.settings.seed, outcome);
    if holds_layers(targets) {
        planes.extend(layers::errors(&outcome.film));
    }
    let region = outcome.film.region();
    let variance = outcome.film.variance().unwrap_or_default();
    let frame = Frame {
        width: region.width,
        height: region.height,
        radiance: outcome.film.mean(),
        planes,
        standard_error: variance.iter().map(|pixel| pixel.map(f32::sqrt)).collect(),
        sample_counts: vec![outcome.stats.passes; region.area()],
        facts,
    };
    targets.iter_mut().try_for_each(|target| target.write(&frame, &display))
}

/// Whether any of the files can hold more than colours.
pub fn holds_layers(targets: &[Target]) -> bool {
    targets.iter().any(|target| target.format() == Format::Exr)
}

/// Writes the facts where `--report` says.
///
/// # Errors
/// When the file cannot be written.
pub fn write_report(args: &RenderArgs, facts: &serde_json::Value) -> Result<(), OutputError> {
    match &args.report {
        Some(path) => output::replace(path, format!("{facts:#}\n").as_bytes()),
        None => Ok(()),
    }
}
