//! How much error a second of rendering takes away: the scenes of `scenes/bench` against references.
//!
//! ```text
//! cargo run --release --example bench_meshes
//! cargo bench --bench scenes -- [S1 S2 ..] [--spp 32,128] [--repeat 3] [--method pt] [--references FOLDER]
//! ```
//!
//! Each render has a process of its own, with one thread, and its own seed. Of the repeats it prints the least CPU time
//! of the render alone, and medians of
//! relMSE = mean((x − r)² / (r² + 0.01)) over pixels and channels, the same without the worst 0.1 % of pixels, and
//! E = 1 / (relMSE × CPU seconds); the ratio of the pictures' means by channel; and the resident size at its largest.
//! `own` is what the streams of a picture say of its noise, as relMSE by the same measure, and the E of that. What relMSE has
//! beside it is the reference's noise, and bias: two pictures with different seeds have it in common.
//! `foot` is the mean under the foot of S4's glass, rows 320 to 383 and columns 128 to 255: by path tracing 0.274.

use cpu_time::ProcessTime;
use snell::diag::Problems;
use snell::math::Rgb;
use snell::plan::Plan;
use snell::render::{Outcome, Settings};
use snell::source::{Disk, SourceMap};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

const SCENES: [&str; 4] = ["S1", "S2", "S3", "S4"];
/// Where references are sought unless a folder is named.
const REFERENCES: &str = "../shared/bench/ref";
/// The argument that makes this program render once, in a process of its own.
const CHILD: &str = "--render-one";

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    if arguments.first().is_some_and(|first| first == CHILD) {
        return render_one(&arguments[1..]);
    }
    let job = Job::of(&arguments)?;
    println!(
        "scene  spp   CPU s    relMSE   trimmed        E       own        E   mean ratio r g b        foot  RSS MB"
    );
    for scene in &job.scenes {
        for &spp in &job.passes {
            let runs: Result<Vec<Run>, _> =
                (0..job.repeats).map(|seed| run(&job, scene, spp, seed)).collect();
            print(scene, spp, &runs?);
        }
    }
    Ok(())
}

/// What to render.
struct Job {
    scenes: Vec<String>,
    passes: Vec<u32>,
    repeats: u64,
    method: String,
    references: PathBuf,
}

impl Job {
    fn of(arguments: &[String]) -> Result<Self, Box<dyn Error>> {
        let mut job = Self {
            scenes: Vec::new(),
            passes: vec![32],
            repeats: 3,
            method: "auto".to_owned(),
            references: REFERENCES.into(),
        };
        let mut rest = arguments.iter();
        while let Some(argument) = rest.next() {
            let mut value = || rest.next().ok_or_else(|| format!("`{argument}` wants a value"));
            match argument.as_str() {
                "--spp" => job.passes = value()?.split(',').map(str::parse).collect::<Result<_, _>>()?,
                "--repeat" => job.repeats = value()?.parse()?,
                "--method" => job.method = value()?.clone(),
                "--references" => job.references = value()?.into(),
                scene => job.scenes.push(scene.to_owned()),
            }
        }
        if job.scenes.is_empty() {
            job.scenes = SCENES.map(str::to_owned).into();
        }
        Ok(job)
    }
}

/// What one render gave.
#[derive(Clone, Copy, Default)]
struct Run {
    cpu_seconds: f64,
    rss_mb: f64,
    foot: f64,
    /// Against the reference, if there is one.
    error: Option<ErrorOf>,
}

#[derive(Clone, Copy)]
struct ErrorOf {
    rel_mse: f64,
    trimmed: f64,
    own: f64,
    ratio: [f64; 3],
}

/// Renders in a process of its own, whose memory is that of this scene alone.
fn run(job: &Job, scene: &str, spp: u32, seed: u64) -> Result<Run, Box<dyn Error>> {
    let mut child = Command::new(std::env::current_exe()?);
    child.args([CHILD, scene, &spp.to_string(), &seed.to_string(), &job.method]).arg(&job.references);
    let output = child.env("RAYON_NUM_THREADS", "1").output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    let numbers: Vec<f64> = String::from_utf8_lossy(&output.stdout)
        .split_whitespace()
        .map(str::parse)
        .collect::<Result<_, _>>()?;
    let [cpu_seconds, rss_mb, foot, ref error @ ..] = numbers[..] else {
        return Err("a render reported less than it should".into());
    };
    let error = match *error {
        [rel_mse, trimmed, own, r, g, b] => Some(ErrorOf { rel_mse, trimmed, own, ratio: [r, g, b] }),
        _ => None,
    };
    Ok(Run { cpu_seconds, rss_mb, foot, error })
}

fn print(scene: &str, spp: u32, runs: &[Run]) {
    let cpu = runs.iter().map(|run| run.cpu_seconds).fold(f64::INFINITY, f64::min);
    let rss = runs.iter().map(|run| run.rss_mb).fold(0.0, f64::max);
    let foot =
        if scene == "S4" { format!("{:.3}", median(runs.iter().map(|run| run.foot))) } else { "-".into() };
    let errors: Vec<ErrorOf> = runs.iter().filter_map(|run| run.error).collect();
    if errors.len() < runs.len() {
        println!("{scene:5} {spp:4} {cpu:7.2}  no reference to compare with {:>34} {rss:7.0}", foot);
        return;
    }
    let rel_mse = median(errors.iter().map(|error| error.rel_mse));
    let trimmed = median(errors.iter().map(|error| error.trimmed));
    let own = median(errors.iter().map(|error| error.own));
    let [r, g, b] = [0, 1, 2].map(|channel| median(errors.iter().map(|error| error.ratio[channel])));
    let (efficiency, of_own) = (1.0 / (rel_mse * cpu), 1.0 / (own * cpu));
    print!("{scene:5} {spp:4} {cpu:7.2} {rel_mse:9.5} {trimmed:9.5} {efficiency:8.2} {own:9.5} {of_own:8.2}");
    println!("   {r:.4} {g:.4} {b:.4} {foot:>9} {rss:7.0}");
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Renders, and writes what [`Run`] holds to standard output.
fn render_one(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    let [scene, spp, seed, method, references] = arguments else {
        return Err("a render wants a scene, passes, a seed, a method and a folder".into());
    };
    let file = Path::new("scenes/bench").join(scene).with_extension("snell");
    let (outcome, cpu_seconds) = render(&file, spp.parse()?, seed.parse()?, method)?;
    let rss_mb = status("VmHWM:").unwrap_or(f64::NAN) / 1024.0;
    let (picture, width) = (outcome.film.mean(), outcome.film.region().width as usize);
    print!("{cpu_seconds} {rss_mb} {}", foot(&picture, width));
    if let Ok(reference) = image::open(Path::new(references).join(scene).with_extension("exr")) {
        let reference = reference.into_rgb32f();
        let reference: Vec<Rgb> = reference.pixels().map(|pixel| Rgb::from(pixel.0)).collect();
        let variance = outcome.film.variance().ok_or("one pass says nothing of its noise")?;
        let ErrorOf { rel_mse, trimmed, own, ratio: [r, g, b] } = error(&picture, &variance, &reference)?;
        print!(" {rel_mse} {trimmed} {own} {r} {g} {b}");
    }
    println!();
    Ok(())
}

/// The picture of a scene after so many passes, and the CPU seconds of the render alone.
fn render(file: &Path, passes: u32, seed: u64, method: &str) -> Result<(Outcome, f64), Box<dyn Error>> {
    let text = std::fs::read_to_string(file)?;
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add(file.display().to_string(), file.into(), text.into()).ok_or("too large")?;
    let files = Disk::new(file, Vec::new(), false);
    let scene = snell::compile(&mut sources, &files, main, &[], &mut problems).ok_or("the scene is wrong")?;
    let loaded = snell::load::load(&scene, &sources, &files, &mut problems).ok_or("a file is missing")?;
    if skips_mesh(file) {
        return Err("a mesh is missing: run `cargo run --release --example bench_meshes` first\n".into());
    }
    let camera = scene.cameras.first().ok_or("there is no camera")?;
    let method = match method {
        "pt" => Some(snell::ir::Method::Pt),
        "ppm" => Some(snell::ir::Method::Ppm),
        _ => None,
    };
    let plan: Plan = snell::plan::plan(&loaded, Some(camera), method);
    let lowered =
        snell::lower::lower(&loaded, &plan, camera, &files, &mut problems).ok_or("a picture is broken")?;
    drop(loaded);
    let settings = Settings { seed, ..Settings::new(lowered.method, plan.depth, passes) };
    let start = ProcessTime::now();
    let outcome = snell::render::render(&lowered.world, &settings, &());
    Ok((outcome, start.elapsed().as_secs_f64()))
}

/// Whether the mesh that is made, not kept, is missing.
fn skips_mesh(file: &Path) -> bool {
    file.ends_with("S3.snell") && !file.with_file_name("blob1m.obj").exists()
}

/// The mean under the foot of S4's glass.
fn foot(picture: &[Rgb], width: usize) -> f64 {
    let block = (320..384).flat_map(|row| (128..256).map(move |column| row * width + column));
    let values: Vec<f64> = block.filter_map(|i| Some(f64::from(picture.get(i)?.mean()))).collect();
    values.iter().sum::<f64>() / values.len() as f64
}

fn error(picture: &[Rgb], variance: &[Rgb], reference: &[Rgb]) -> Result<ErrorOf, Box<dyn Error>> {
    if picture.len() != reference.len() {
        return Err("the reference has another size".into());
    }
    let relative = |square: f64, r: f32| square / (f64::from(r) * f64::from(r) + 0.01);
    let term = |x: f32, r: f32| relative((f64::from(x) - f64::from(r)).powi(2), r);
    let pairs = || picture.iter().zip(reference);
    let mut terms: Vec<f64> =
        pairs().map(|(x, r)| [0, 1, 2].map(|c| term(x[c], r[c])).iter().sum::<f64>() / 3.0).collect();
    terms.sort_by(f64::total_cmp);
    let mean = |terms: &[f64]| terms.iter().sum::<f64>() / terms.len() as f64;
    let noise = variance.iter().zip(reference);
    let noise =
        noise.map(|(v, r)| [0, 1, 2].map(|c| relative(f64::from(v[c]), r[c])).iter().sum::<f64>() / 3.0);
    let own = noise.sum::<f64>() / reference.len() as f64;
    let kept = (terms.len() as f64 * 0.999) as usize;
    let sum = |picture: &[Rgb], c| picture.iter().map(|pixel| f64::from(pixel[c])).sum::<f64>();
    let ratio = [0, 1, 2].map(|c| sum(picture, c) / sum(reference, c));
    Ok(ErrorOf { rel_mse: mean(&terms), trimmed: mean(&terms[..kept]), own, ratio })
}

/// A line of what the system says about this process, in kB.
fn status(name: &str) -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    text.lines().find_map(|line| line.strip_prefix(name)?.split_whitespace().next()?.parse().ok())
}
