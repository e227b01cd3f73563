//! The reference of a study: given, made, or made before.

use super::prepare::{Prepared, Ready};
use super::{StudyArgs, say, sweep};
use crate::cli::progress::duration;
use crate::cli::session::{self, Fingerprint};
use crate::cli::{Exit, fail, interrupt};
use crate::ir;
use crate::output::{self, Picture};
use crate::render::{Monitor, Progress, Stop, render};
use crate::study::experiment::Reference;
use crate::study::metrics::{self, Relative};
use crate::study::record::{Folder, write_exr};
use std::path::Path;

/// The truth with what is known of it.
pub struct Truth {
    pub reference: Reference,
    /// In a sentence.
    pub words: String,
    /// Another picture, another key.
    pub key: String,
}

/// The seed of references; runs have 1, 2, 3, ….
const SEED: u64 = 0x7275_7468;

/// How many times as long as a run a reference takes: its noise is then a sixteenth.
const TIMES: f64 = 16.0;

/// The references, as variants number them.
///
/// # Errors
/// How the command ends without them.
pub fn references(args: &StudyArgs, prepared: &Prepared, folder: &Folder) -> Result<Vec<Truth>, Exit> {
    match &args.against {
        Some(path) => {
            let picture = given(path, prepared.size).map_err(fail)?;
            Ok(vec![truth(prepared, picture, format!("`{}`, given.", path.display()))])
        }
        None => prepared
            .references
            .iter()
            .map(|ready| {
                let (picture, words) = made(args, prepared, ready, folder)?;
                Ok(truth(prepared, picture, words))
            })
            .collect(),
    }
}

fn truth(prepared: &Prepared, picture: Picture, words: String) -> Truth {
    let relative = Relative::to(picture.mean_luminance());
    let noise = picture.standard_error.as_ref().map(|errors| {
        let terms = errors.iter().zip(&picture.radiance).map(|(&e, &r)| relative.of_standard_error(e, r));
        metrics::mean(&terms.collect::<Vec<_>>())
    });
    let mut key = Fingerprint::default();
    let numbers = picture.radiance.iter().flat_map(|pixel| pixel.to_array()).flat_map(f32::to_le_bytes);
    key.add(&numbers.collect::<Vec<u8>>());
    let factor = prepared.factor(&picture.radiance);
    Truth { reference: Reference { picture, noise, factor }, words, key: key.to_string() }
}

fn given(path: &Path, (width, height): (u32, u32)) -> Result<Picture, String> {
    let bytes = session::read_bytes(path)?;
    let picture = output::decode(path, &bytes).map_err(|error| error.to_string())?;
    if picture.is_display {
        return Err(format!(
            "`{}` holds display values: a reference holds radiance, as .exr and .hdr do",
            path.display()
        ));
    }
    if (picture.width, picture.height) != (width, height) {
        return Err(format!(
            "`{}` has {} × {} pixels and the scene {width} × {height}: use `--size {}x{}`",
            path.display(),
            picture.width,
            picture.height,
            picture.width,
            picture.height,
        ));
    }
    Ok(picture)
}

/// A reference of its own, or the one that was made before.
fn made(
    args: &StudyArgs,
    prepared: &Prepared,
    ready: &Ready,
    folder: &Folder,
) -> Result<(Picture, String), Exit> {
    let seconds = args.reference_time.unwrap_or(args.time * TIMES);
    let passes = args.reference_time.map_or(sweep::passes(&args.sweeps), |_| None);
    let passes = passes.map(|passes| passes.next_power_of_two().saturating_mul(TIMES as u32));
    let stop = match passes {
        Some(passes) => Stop { passes: Some(passes), ..Stop::default() },
        None => Stop { seconds: Some(seconds), ..Stop::default() },
    };
    let key = ready.key(&[&prepared.scene_key, &format!("{stop:?}")]);
    let path = folder.file(&format!("{key}.reference.exr"));
    let known = output::read(&path).ok().filter(|_| !args.fresh);
    let picture = match known {
        Some(picture) => picture,
        None => {
            let wait = passes.map_or(duration(seconds), |passes| format!("{passes} passes"));
            say(args, format_args!("reference: {}, {wait}\n", ready.name));
            let picture = long_render(ready, stop)?;
            write_exr(&path, &picture).map_err(fail)?;
            picture
        }
    };
    let passes = picture.fact("passes").unwrap_or("?");
    let seed = picture.fact("seed").unwrap_or("?");
    let blur = match ready.plan.method {
        ir::Method::Ppm => " It is made of photons itself: what blur it has is not seen.",
        _ => "",
    };
    let words =
        format!("Made by {} with {passes} passes and seed {seed}, which no run has.{blur}", ready.name);
    Ok((picture, words))
}

fn long_render(ready: &Ready, stop: Stop) -> Result<Picture, Exit> {
    struct Watch;
    impl Monitor for Watch {
        fn pass_done(&self, _: &Progress<'_>) {}
        fn cancelled(&self) -> bool {
            interrupt::asked()
        }
    }
    let outcome = render(&ready.lowered.world, &ready.settings(SEED, stop), &Watch);
    if interrupt::asked() {
        return Err(Exit::Interrupted);
    }
    let region = outcome.film.region();
    let variance = outcome.film.variance();
    let facts = [("passes", u64::from(outcome.stats.passes)), ("seed", SEED)];
    Ok(Picture {
        width: region.width,
        height: region.height,
        radiance: outcome.film.mean(),
        standard_error: variance.map(|variance| variance.iter().map(|v| v.map(f32::sqrt)).collect()),
        tile_error: None,
        is_display: false,
        facts: facts.map(|(name, value)| (name.to_owned(), value.to_string())).to_vec(),
    })
}
