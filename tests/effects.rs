//! Only the effects that a scene calls for are simulated, and nothing is lost by it.

pub mod command;
mod wild;

use crate::support::film_bits;
use snell::diag::Problems;
use snell::ir::Method;
use snell::plan::{Effect, Plan, Wanted};
use snell::render::{Outcome, Settings};
use snell::source::{Disk, Files, Memory, Missing, SourceMap};
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Photons a pass: few are enough to tell whether a bit differs.
const PHOTONS: u32 = 1_000;
/// The width of the pictures, in pixels.
const WIDTH: u32 = 20;

/// Plans a scene and hands everything that a render takes to `then`; what is wrong with it otherwise.
fn with_plan<T>(
    path: &Path,
    text: &str,
    files: &dyn Files,
    method: Option<Method>,
    then: impl FnOnce(&Plan, &mut dyn FnMut(&Plan) -> Option<Outcome>) -> T,
) -> Result<T, String> {
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add(path.display().to_string(), path.to_path_buf(), text.into()).expect("it is small");
    let checked = snell::compile(&mut sources, files, main, &[], &mut problems);
    let loaded =
        checked.as_ref().and_then(|checked| snell::load::load(checked, &sources, files, &mut problems));
    let Some(loaded) = loaded.filter(|_| !problems.has_errors()) else {
        return Err(problems.into_report(&sources).render_short());
    };
    let Some(mut camera) = loaded.scene.cameras.first().cloned() else { return Err("no camera".to_owned()) };
    let (width, height) = camera.film.size.value;
    camera.film.size.value = (WIDTH, (WIDTH * height).div_ceil(width).min(2 * WIDTH));
    let mut plan = snell::plan::plan(&loaded, Some(&camera), method);
    plan.photon_count = PHOTONS;
    let mut problems = Problems::default();
    let mut render = |plan: &Plan| {
        let lowered = snell::lower::lower(&loaded, plan, &camera, files, &mut problems)?;
        let settings = Settings { seed: 3, ..Settings::new(lowered.method, 12, 2) };
        Some(snell::render::render(&lowered.world, &settings, &()))
    };
    Ok(then(&plan, &mut render))
}

/// The methods whose pictures may not depend on how much more than needed is simulated.
const METHODS: [Method; 3] = [Method::Pt, Method::Ppm, Method::Hybrid];

/// Whether forcing any effect on, or all of them, changes a bit; what did, if so.
pub fn changes(path: &Path, text: &str, files: &dyn Files) -> Result<String, String> {
    let mut said = String::new();
    for method in METHODS {
        let differing = with_plan(path, text, files, Some(method), |plan, render| {
            let auto = render(plan).map(|outcome| film_bits(&outcome.film))?;
            let absent = Effect::ALL.into_iter().filter(|&effect| !plan.simulates(effect));
            let one_more = absent.filter(|effect| effect.without().is_some()).map(Wanted::With);
            let words: Vec<Wanted> = [Wanted::All].into_iter().chain(one_more).collect();
            let differs = |word: &Wanted| {
                let mut more = plan.clone();
                more.want(&[*word]);
                render(&more).map(|outcome| film_bits(&outcome.film)).as_ref() != Some(&auto)
            };
            Some(words.into_iter().filter(differs).collect::<Vec<_>>())
        })?;
        match differing {
            Some(words) if words.is_empty() => {}
            Some(words) => drop(writeln!(said, "{}, {method:?}: {words:?}", path.display())),
            None => return Err("it cannot be lowered".to_owned()),
        }
    }
    Ok(said)
}

#[test]
fn no_shipped_scene_changes_when_more_is_simulated() {
    let mut said = String::new();
    for path in crate::doubts::scenes("scenes").iter().chain(&crate::doubts::scenes("tests/plan")) {
        let text = std::fs::read_to_string(path).expect("a scene can be read");
        let files = Disk::new(path, Vec::new(), false);
        match changes(path, &text, &files) {
            Ok(more) => said += &more,
            Err(reason) => panic!("{}: {reason}", path.display()),
        }
    }
    assert!(said.is_empty(), "{said}");
}

/// Renders wild scenes, and counts those that can be.
fn no_wild_scene_changes(numbers: std::ops::Range<u64>) {
    let (mut said, mut rendered) = (String::new(), 0);
    let total = numbers.end - numbers.start;
    for number in numbers {
        let text = wild::scene(number);
        match changes(Path::new("wild.snell"), &text, &wild::files()) {
            Ok(more) if more.is_empty() => rendered += 1,
            Ok(more) => drop(writeln!(said, "{number}: {more}{text}")),
            Err(reason) => drop(writeln!(said, "{number}: {reason}\n{text}")),
        }
    }
    assert!(said.is_empty(), "{said}");
    assert_eq!(rendered, total);
}

#[test]
fn a_few_wild_scenes_do_not_change_when_more_is_simulated() {
    no_wild_scene_changes(0..12);
}

#[test]
#[ignore = "takes minutes"]
fn five_hundred_wild_scenes_do_not_change_when_more_is_simulated() {
    no_wild_scene_changes(0..500);
}

#[test]
fn every_effect_that_can_be_left_out_changes_some_picture() {
    // Otherwise the tests above would show nothing.
    let mut waiting: Vec<Effect> =
        Effect::ALL.into_iter().filter(|effect| effect.without().is_some()).collect();
    for path in crate::doubts::scenes("tests/plan") {
        let text = std::fs::read_to_string(&path).expect("a scene can be read");
        let files = Disk::new(&path, Vec::new(), false);
        let method = Some(Method::Hybrid);
        let changed = with_plan(&path, &text, &files, method, |plan, render| {
            let whole = render(plan).map(|outcome| film_bits(&outcome.film));
            let changes = |effect: &Effect| {
                let mut less = plan.clone();
                less.want(&[Wanted::Without(*effect)]);
                plan.needs(*effect) && render(&less).map(|outcome| film_bits(&outcome.film)) != whole
            };
            waiting.iter().copied().filter(changes).collect::<Vec<_>>()
        });
        let changed = changed.unwrap_or_default();
        waiting.retain(|effect| !changed.contains(effect));
    }
    assert!(waiting.is_empty(), "{waiting:?}");
}

#[test]
fn plans_are_what_they_were() {
    let mut differences = String::new();
    for path in crate::doubts::scenes("tests/plan") {
        let text = std::fs::read_to_string(&path).expect("a scene can be read");
        let files = Disk::new(&path, Vec::new(), false);
        let said = with_plan(&path, &text, &files, None, |plan, _| told(plan, &text));
        let said = said.unwrap_or_else(|reason| panic!("{}: {reason}", path.display()));
        crate::meaning::compare(&path.with_extension("txt"), &said, &mut differences);
    }
    assert!(differences.is_empty(), "{differences}");
}

/// A plan as text: the method, then each effect with the first line that calls for it, or why none does.
fn told(plan: &Plan, text: &str) -> String {
    let mut out = format!("{:?}: {}\n", plan.method, plan.why);
    for effect in Effect::ALL {
        let _ = match plan.effects.iter().find(|used| used.effect == effect) {
            Some(used) => {
                let line = 1 + text[..used.span.start as usize].matches('\n').count();
                writeln!(out, "{:<15} line {line}, {} in all", effect.name(), used.count)
            }
            None => {
                let why = plan.absent.iter().find(|(absent, _)| *absent == effect);
                writeln!(out, "{:<15} - {}", effect.name(), why.map_or("", |(_, why)| why))
            }
        };
    }
    out
}

#[test]
fn no_photon_flies_where_there_are_no_caustics() {
    let scene = "snell 1
camera { position: (0m, 1m, 4m), look_at: (0m, 1m, 0m) }
light point { position: (1m, 3m, 2m), power: 60W }
plane { y: 0m }
sphere { center: (0m, 1m, 0m), radius: 1m, material: plastic { color: #aa2211, roughness: 0.7 } }
";
    for method in [None, Some(Method::Pt), Some(Method::Hybrid)] {
        let counters = with_plan(Path::new("s.snell"), scene, &Memory::default(), method, |plan, render| {
            render(plan).map(|outcome| outcome.stats.counters)
        });
        let counters = counters.expect("the scene is right").expect("it can be rendered");
        assert_eq!((counters.photons, counters.stored_photons), (0, 0), "{method:?}");
    }
}

/// Files that remember what was read.
struct Watched(Memory, Mutex<Vec<PathBuf>>);

impl Files for Watched {
    fn locate(&self, from: &Path, name: &str) -> Result<PathBuf, Missing> {
        self.0.locate(from, name)
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.1.lock().expect("no reader panics").push(path.to_path_buf());
        self.0.read(path)
    }
}

#[test]
fn what_nothing_shows_is_not_opened() {
    let scene = "snell 1
camera { position: (0m, 1m, 4m), look_at: (0m, 1m, 0m) }
light point { position: (1m, 3m, 2m), power: 60W }
let paper = diffuse { color: image(\"paper.ppm\") }
let tower = mesh { file: \"tower.obj\" }
sphere { center: (0m, 1m, 0m), radius: 1m, material: diffuse { color: image(\"shown.ppm\") } }
";
    let picture = b"P6 1 1 255 \x80\x80\x80".to_vec();
    let files = Memory::default().with("paper.ppm", picture.clone()).with("shown.ppm", picture);
    let files = Watched(files.with("tower.obj", "v 0 0 0"), Mutex::default());
    let planned = with_plan(Path::new("s.snell"), scene, &files, None, |plan, render| {
        render(plan).expect("it can be rendered");
    });
    assert_eq!(planned, Ok(()));
    let read = files.1.into_inner().expect("no reader panics");
    assert!(read.iter().all(|path| path.ends_with("shown.ppm")), "{read:?}");
    assert!(!read.is_empty());
}
