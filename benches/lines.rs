//! Whether what `snell plan --by line` says is so, as the last section of `docs/effects.md`.
//!
//! ```text
//! cargo bench --bench lines [-- SCENE...]
//! ```
//!
//! For each scene: what watching adds to the time of a render, how much of the time finds an account, and what the scene
//! takes without its dearest line, as it is foretold and as it is when that line is deleted from a copy of the text. With
//! scenes named, the table is printed and no page is written. Seconds are those of one thread's processor time, of renders
//! that take turns.

use cpu_time::ThreadTime;
use serde_json::Value;
use snell::diag::Problems;
use snell::lower::Lowered;
use snell::plan::Plan;
use snell::render::ledger::{self, TIMED};
use snell::render::{Settings, render};
use snell::source::{Disk, SourceMap};
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// Where nothing else is asked for.
const SCENES: [&str; 6] = [
    "scenes/arsenal.snell",
    "scenes/cornell.snell",
    "scenes/focus.snell",
    "scenes/wheel.snell",
    "scenes/bench/S1.snell",
    "scenes/bench/S2.snell",
];
/// Pixels in a row of the pictures.
const WIDTH: u32 = 320;
/// Renders each way; an odd number has a middle.
const ROUNDS: u32 = 5;
/// What a render takes at least, in seconds.
const LEAST_SECONDS: f64 = 1.0;

const PAGE: &str = "docs/effects.md";
const HEADING: &str = "\n## What each line costs\n";

fn main() -> Result<(), Box<dyn Error>> {
    let asked: Vec<String> = std::env::args().skip(1).filter(|word| word.ends_with(".snell")).collect();
    let scenes: Vec<&str> = match asked[..] {
        [] => SCENES.to_vec(),
        _ => asked.iter().map(String::as_str).collect(),
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut rows = String::new();
    for scene in scenes {
        let row = pool.install(|| measure(scene).map_err(|error| format!("{scene}: {error}")))?;
        eprint!("{row}");
        rows.push_str(&row);
    }
    let section = section(&rows);
    if !asked.is_empty() {
        print!("{section}");
        return Ok(());
    }
    let page = std::fs::read_to_string(PAGE)?;
    let before = page.split(HEADING).next().unwrap_or_default();
    std::fs::write(PAGE, before.to_owned() + &section)?;
    Ok(())
}

fn section(rows: &str) -> String {
    format!(
        "{HEADING}
`snell plan SCENE --by line` renders a small picture and books what each object costs: the time from a vertex of a path on it
to the next vertex, its rays, and the noise of what is seen of it. One path in {TIMED} is timed. This table says what comes of
it, for pictures {WIDTH} pixels wide, in processor time of one thread, as the median of {ROUNDS} pairs of renders that
took turns, ± half their range; `cargo bench --bench lines` writes it.

- *watching*: how much longer a render takes that is booked, the quickest of {ROUNDS} beside the quickest of as many others.
- *accounts*: all accounts together, as a share of the time of the render.
- *dearest line*: the object that costs most, and its share.
- *foretold*, *deleted*: how much longer (+) or less (−) the scene takes without that line: as the command says, and as it is
  when the line is deleted from a copy of the scene.

What a line costs is not what its deletion saves. The rays that an object stops go on without it, and pay at what is behind it,
or leave the room and pay no more; a lamp is met by few rays, and decides what all of them do. So the command does not foretell
from shares: for the three dearest lines it renders the small picture without them, planned anew, and says what that takes.

| scene | watching | accounts | dearest line | foretold | deleted |
|---|---|---|---|---|---|
{rows}"
    )
}

/// The row of a scene.
fn measure(scene: &str) -> Result<String, Box<dyn Error>> {
    let text = std::fs::read_to_string(scene)?;
    let (mut whole, plan, size) = built(scene, &text)?;
    let by_line = by_line(scene, size)?;
    let first = &by_line["objects"][0];
    let (place, line) = place(&first["place"])?;
    let (fewer, other_plan, _) = built(scene, &deleted(&text, line)?)?;

    let passes = (LEAST_SECONDS / seconds(&whole, &plan, 1)).ceil().clamp(1.0, 256.0) as u32;
    let mut deletion = Vec::new();
    let (mut alone, mut watched) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..ROUNDS {
        let own = seconds(&whole, &plan, passes);
        deletion.push(seconds(&fewer, &other_plan, passes) / own - 1.0);
        whole.world.is_watched = true;
        ledger::open();
        watched = watched.min(seconds(&whole, &plan, passes));
        ledger::close();
        whole.world.is_watched = false;
        alone = alone.min(own);
    }

    let number = |value: &Value| 100.0 * value.as_f64().unwrap_or(f64::NAN);
    let mut row = String::new();
    writeln!(
        row,
        "| `{scene}` | {:+.1} % | {:.1} % | {place}, {:.1} % | {:+.1} ± {:.1} % | {} |",
        100.0 * (watched / alone - 1.0),
        number(&by_line["attributed"]),
        number(&first["time"]),
        number(&first["without"]["share"]),
        number(&first["without"]["spread"]),
        middle(deletion),
    )?;
    Ok(row)
}

/// A scene ready to be rendered, its plan, and the size of its picture.
type Built = (Lowered, Plan, (u32, u32));

fn built(scene: &str, text: &str) -> Result<Built, Box<dyn Error>> {
    let path = Path::new(scene);
    let files = Disk::new(path, Vec::new(), false);
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add(scene.to_owned(), path.to_owned(), text.into()).ok_or("the scene is too large")?;
    let checked = snell::compile(&mut sources, &files, main, &[], &mut problems);
    let loaded =
        checked.as_ref().and_then(|checked| snell::load::load(checked, &sources, &files, &mut problems));
    let Some(loaded) = loaded.filter(|_| !problems.has_errors()) else {
        return Err(problems.into_report(&sources).render_short().into());
    };
    let mut camera = loaded.scene.cameras.first().ok_or("there is no camera")?.clone();
    let (width, height) = camera.film.size.value;
    let size = (WIDTH, (WIDTH * height).div_ceil(width));
    camera.film.size.value = size;
    let plan = snell::plan::plan(&loaded, Some(&camera), None);
    let lowered = snell::lower::lower(&loaded, &plan, &camera, &files, &mut problems);
    Ok((lowered.ok_or("it cannot be lowered")?, plan, size))
}

/// What the command says of the lines of a scene.
fn by_line(scene: &str, (width, height): (u32, u32)) -> Result<Value, Box<dyn Error>> {
    let output = Command::new(env!("CARGO_BIN_EXE_snell"))
        .args(["plan", scene, "--by", "line", "--format", "json", "-q", "--size"])
        .arg(format!("{width}x{height}"))
        .env("RAYON_NUM_THREADS", "1")
        .output()?;
    let mut plan: Value = serde_json::from_slice(&output.stdout)?;
    Ok(plan["by_line"].take())
}

/// A place as `scene.snell:12`, and the number of its line.
fn place(place: &Value) -> Result<(String, usize), Box<dyn Error>> {
    let place = place.as_str().ok_or("no line has a cost")?;
    let (file, line) = place.rsplit_once(':').ok_or("a place has a line")?;
    let name = file.rsplit('/').next().unwrap_or(file);
    Ok((format!("{name}:{line}"), line.parse()?))
}

/// The text without the item that begins in a line, counted from 1: up to the end of the line in which its brackets close.
fn deleted(text: &str, line: usize) -> Result<String, Box<dyn Error>> {
    let mut rest = text.split_inclusive('\n');
    let mut left: String = rest.by_ref().take(line - 1).collect();
    let mut depth = 0_i32;
    for line in rest.by_ref() {
        let code = line.split("//").next().unwrap_or_default();
        depth += code.matches(['{', '(', '[']).count() as i32 - code.matches(['}', ')', ']']).count() as i32;
        if depth <= 0 {
            left.extend(rest);
            return Ok(left);
        }
    }
    Err("an item does not end".into())
}

/// Seconds of this thread for some passes.
fn seconds(lowered: &Lowered, plan: &Plan, passes: u32) -> f64 {
    let settings = Settings::new(lowered.method, plan.depth, passes);
    let start = ThreadTime::now();
    render(&lowered.world, &settings, &());
    start.elapsed().as_secs_f64()
}

/// The middle of some shares, and how far they spread.
fn middle(mut shares: Vec<f64>) -> String {
    shares.sort_by(f64::total_cmp);
    let spread = (shares[shares.len() - 1] - shares[0]) / 2.0;
    format!("{:+.1} ± {:.1} %", 100.0 * shares[shares.len() / 2], 100.0 * spread)
}
