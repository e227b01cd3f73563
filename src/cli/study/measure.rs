//! The runs of a study: what is not known yet is measured, and kept at once.

use super::prepare::{Prepared, Ready};
use super::truth::Truth;
use super::{StudyArgs, say, sweep};
use crate::cli::progress::{duration, percent};
use crate::cli::{Exit, fail, interrupt};
use crate::math::Rgb;
use crate::output::{self, Format, Picture};
use crate::render::Stop;
use crate::study::experiment::{Length, Measured, frame_like, measure_run};
use crate::study::page::Pictures;
use crate::study::record::{Folder, Record};
use crate::study::{heat, metrics};

/// What is known of a variant, and what it is kept under.
pub struct Known {
    pub key: String,
    pub record: Record,
}

/// Measures a run of every variant, then the next seed, so that an interrupted study is even. Once interrupted, gives back
/// what there is.
///
/// # Errors
/// When the folder cannot be written.
pub fn measure_all(
    args: &StudyArgs,
    prepared: &Prepared,
    truths: &[Truth],
    folder: &Folder,
) -> Result<Vec<Known>, Exit> {
    let wanted = match sweep::passes(&args.sweeps) {
        Some(passes) => Length::Passes(passes.next_power_of_two()),
        None => Length::Seconds(args.time, args.clock.time()),
    };
    let read = |ready: &Ready| {
        let parts = [&prepared.scene_key, &truths[ready.judge].key, &format!("{wanted:?}")];
        let key = ready.key(&parts.map(String::as_str));
        let record = if args.fresh { Record::default() } else { folder.read(&key) };
        Known { key, record }
    };
    let mut all: Vec<Known> = prepared.variants.iter().map(read).collect();
    let seeds = args.seeds as usize;
    let mut done: usize = all.iter().map(|known| known.record.runs.len().min(seeds)).sum();
    let count = seeds * all.len();
    if done > 0 {
        say(args, format_args!("{done} of {count} runs were measured before and are kept\n"));
    }
    for run in 0..seeds {
        for (ready, known) in prepared.variants.iter().zip(&mut all) {
            if known.record.runs.len() > run {
                continue;
            }
            let truth = &truths[ready.judge];
            // The first run says how many passes fit into the time; the others make as many.
            let first = known.record.runs.first().and_then(|run| run.points.last());
            let length = first.map_or(wanted, |last| Length::Passes(last.passes));
            let settings = ready.settings(run as u64 + 1, Stop::default());
            let world = &ready.lowered.world;
            let measured = measure_run(world, &settings, length, &truth.reference, &interrupt::asked);
            let Some(measured) = measured else { return Ok(all) };
            done += 1;
            say(args, format_args!("run {done} of {count}: {}{}\n", ready.name, result(&measured)));
            if run == 0 {
                keep_pictures(folder, &known.key, prepared, truth, &measured.pictures).map_err(fail)?;
            }
            known.record.add(measured);
            folder.write(&known.key, &known.record, &truth.reference.picture).map_err(fail)?;
        }
    }
    Ok(all)
}

/// How far a run came, for people.
fn result(measured: &Measured) -> String {
    measured.run.points.last().map_or(String::new(), |last| {
        let (passes, error) = (last.passes, percent(last.metrics.rel_mse.sqrt()));
        format!(", {passes} passes in {}, error {error}", duration(last.seconds.wall))
    })
}

/// Keeps the pictures of the first run and where they are wrong.
fn keep_pictures(
    folder: &Folder,
    key: &str,
    prepared: &Prepared,
    truth: &Truth,
    pictures: &[Vec<Rgb>],
) -> Result<(), String> {
    let reference = &truth.reference.picture;
    for (step, radiance) in pictures.iter().enumerate() {
        let picture = Picture { radiance: radiance.clone(), ..frame_like(reference) };
        let errors = metrics::relative_errors(&picture, reference);
        let map: Vec<[u8; 3]> =
            errors.into_iter().map(|square| heat::color_of_error(square.sqrt())).collect();
        let shown = prepared.shown(truth.reference.factor).develop(radiance);
        for (pixels, name) in [(shown, picture_file(key, step)), (map, map_file(key, step))] {
            let bytes = output::encode_display(Format::Png, prepared.size, &pixels);
            let bytes = bytes.map_err(|error| error.to_string())?;
            output::replace(&folder.file(&name), &bytes).map_err(|error| error.to_string())?;
        }
    }
    Ok(())
}

/// The pictures of the first run that were kept.
pub fn kept_pictures(folder: &Folder, key: &str, steps: usize) -> Pictures {
    let file = |name: String| std::fs::read(folder.file(&name)).unwrap_or_default();
    let steps = (0..steps).map(|step| (file(picture_file(key, step)), file(map_file(key, step))));
    Pictures { steps: steps.collect() }
}

fn picture_file(key: &str, step: usize) -> String {
    format!("{key}.{}.png", 1_u64 << step)
}

fn map_file(key: &str, step: usize) -> String {
    format!("{key}.{}.error.png", 1_u64 << step)
}
