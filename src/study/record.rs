//! What has been measured already, in a folder beside the report, so that a study goes on where it was interrupted.
//!
//! For each variant there is a file of numbers, and for each of its checkpoints the mean picture of all runs. The numbers
//! are written last; if both do not agree, the variant is measured anew.

use super::clock::Seconds;
use super::experiment::{Measured, Point, Run};
use super::{Metrics, experiment::frame_like};
use crate::math::Rgb;
use crate::output::{self, Display, Exposure, Frame, Picture, Target, Tone};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What is known of a variant so far.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Record {
    /// The runs, in the order of their seeds.
    pub runs: Vec<Run>,
    /// The mean over all runs at each checkpoint.
    pub means: Vec<Vec<Rgb>>,
}

/// Why a record cannot be kept.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The folder cannot be made.
    #[error("`{}` cannot be made: {reason}", path.display())]
    NoFolder {
        /// Which.
        path: PathBuf,
        /// In the system's words.
        reason: String,
    },
    /// A file in it cannot be written.
    #[error(transparent)]
    Output(#[from] output::OutputError),
}

/// The folder of a study.
#[derive(Clone, PartialEq, Debug)]
pub struct Folder(PathBuf);

impl Folder {
    /// Makes the folder, if it is not there.
    ///
    /// # Errors
    /// [`RecordError::NoFolder`].
    pub fn open(path: PathBuf) -> Result<Self, RecordError> {
        match std::fs::create_dir_all(&path) {
            Ok(()) => Ok(Self(path)),
            Err(error) => Err(RecordError::NoFolder { path, reason: error.to_string() }),
        }
    }

    /// The file of a name.
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// What is known of the variant `key`; nothing where files are missing, damaged or disagree.
    pub fn read(&self, key: &str) -> Record {
        self.try_read(key).unwrap_or_default()
    }

    fn try_read(&self, key: &str) -> Option<Record> {
        let text = std::fs::read_to_string(self.file(&format!("{key}.json"))).ok()?;
        let value: Value = serde_json::from_str(&text).ok()?;
        let runs: Vec<Run> = value["runs"].as_array()?.iter().map(run_of).collect::<Option<_>>()?;
        let count = runs.len().to_string();
        let means = runs.first()?.points.iter().map(|point| {
            let picture = output::read(&self.mean_file(key, point.passes)).ok()?;
            (picture.fact("runs") == Some(&count)).then_some(picture.radiance)
        });
        Some(Record { means: means.collect::<Option<_>>()?, runs })
    }

    /// Keeps what is known.
    ///
    /// # Errors
    /// [`RecordError::Output`].
    pub fn write(&self, key: &str, record: &Record, like: &Picture) -> Result<(), RecordError> {
        let points = record.runs.first().map_or(&[][..], |run| &run.points);
        for (point, mean) in points.iter().zip(&record.means) {
            let facts = vec![("runs".to_owned(), record.runs.len().to_string())];
            let picture = Picture { radiance: mean.clone(), facts, ..frame_like(like) };
            write_exr(&self.mean_file(key, point.passes), &picture)?;
        }
        let runs: Vec<Value> = record.runs.iter().map(run_json).collect();
        let text = format!("{:#}\n", json!({ "runs": runs }));
        Ok(output::replace(&self.file(&format!("{key}.json")), text.as_bytes())?)
    }

    fn mean_file(&self, key: &str, passes: u32) -> PathBuf {
        self.file(&format!("{key}.{passes}.exr"))
    }
}

impl Record {
    /// Takes in another run. Runs of another length cannot be compared and are left out.
    pub fn add(&mut self, measured: Measured) {
        let Measured { run, pictures } = measured;
        if self.runs.is_empty() {
            self.means = pictures;
        } else if self.means.len() == pictures.len() {
            let count = self.runs.len() as f32;
            for (mean, picture) in self.means.iter_mut().zip(pictures) {
                let pairs = mean.iter_mut().zip(picture);
                pairs.for_each(|(mean, x)| *mean = (*mean * count + x) / (count + 1.0));
            }
        } else {
            return;
        }
        self.runs.push(run);
    }
}

/// Writes a picture with its facts as EXR.
///
/// # Errors
/// When the file cannot be written.
pub fn write_exr(path: &Path, picture: &Picture) -> Result<(), output::OutputError> {
    let frame = Frame {
        width: picture.width,
        height: picture.height,
        radiance: picture.radiance.clone(),
        standard_error: picture.standard_error.clone().unwrap_or_default(),
        facts: picture.facts.clone(),
        ..Frame::default()
    };
    let mut target = Target::open(path)?;
    target.write(&frame, &Display { exposure: Exposure::Ev(0.0), tone: Tone::Srgb, floor: false })?;
    target.finish().map(drop)
}

fn run_json(run: &Run) -> Value {
    let points = run.points.iter().map(|point| {
        let m = &point.metrics;
        let interval = point.estimate.and_then(|(_, interval)| interval);
        json!({
            "passes": point.passes,
            "wall": point.seconds.wall,
            "cpu": point.seconds.cpu,
            "rmse": m.rmse,
            "rel_mse": m.rel_mse,
            "rel_mse_trimmed": m.rel_mse_trimmed,
            "ssim": m.ssim,
            "flip": m.flip,
            "estimate": point.estimate.map(|(error, _)| error),
            "estimate_low": interval.map(|(low, _)| low),
            "estimate_high": interval.map(|(_, high)| high),
        })
    });
    json!({ "seed": run.seed, "points": points.collect::<Vec<_>>() })
}

fn run_of(value: &Value) -> Option<Run> {
    let points = value["points"].as_array()?.iter().map(|point| {
        let number = |name: &str| point[name].as_f64();
        let interval = number("estimate_low").zip(number("estimate_high"));
        Some(Point {
            passes: point["passes"].as_u64()? as u32,
            seconds: Seconds { wall: number("wall")?, cpu: number("cpu")? },
            metrics: Metrics {
                rmse: number("rmse")?,
                rel_mse: number("rel_mse")?,
                rel_mse_trimmed: number("rel_mse_trimmed")?,
                ssim: number("ssim")?,
                flip: number("flip")?,
            },
            estimate: number("estimate").map(|error| (error, interval)),
        })
    });
    Some(Run { seed: value["seed"].as_u64()?, points: points.collect::<Option<_>>()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(seed: u64, level: f32) -> Measured {
        let metrics = Metrics { rmse: 0.1, rel_mse: 0.01, rel_mse_trimmed: 0.009, ssim: 0.9, flip: 0.05 };
        let point = |passes: u32| Point {
            passes,
            seconds: Seconds { wall: f64::from(passes) * 0.25, cpu: f64::from(passes) * 0.5 },
            metrics,
            estimate: Some((0.1, (passes > 1).then_some((0.09, 0.11)))),
        };
        let run = Run { seed, points: vec![point(1), point(2)] };
        Measured { run, pictures: vec![vec![Rgb::gray(level); 4]; 2] }
    }

    #[test]
    fn what_was_kept_is_found_again_and_what_disagrees_is_not() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path().join("a.study")).unwrap();
        let mut record = Record::default();
        record.add(measured(1, 1.0));
        record.add(measured(2, 3.0));
        assert_eq!(record.means[1], vec![Rgb::gray(2.0); 4]);
        let like = Picture::new(2, 2, Vec::new());
        folder.write("pt-1", &record, &like).unwrap();
        assert_eq!(folder.read("pt-1"), record);
        assert_eq!(folder.read("ppm-1"), Record::default());
        // A run more in the pictures than in the numbers: a run was cut off between both.
        let numbers = std::fs::read(folder.file("pt-1.json")).unwrap();
        record.add(measured(3, 5.0));
        folder.write("pt-1", &record, &like).unwrap();
        std::fs::write(folder.file("pt-1.json"), numbers).unwrap();
        assert_eq!(folder.read("pt-1"), Record::default());
    }
}
