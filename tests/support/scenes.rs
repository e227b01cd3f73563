//! From the text of a scene to a film, without a file system.

use snell::diag::Problems;
use snell::plan::Plan;
use snell::render::Settings;
use snell::render::film::Film;
use snell::source::{Memory, SourceMap};

/// What became of a text.
pub struct Told {
    /// The picture, unless something is wrong.
    pub film: Option<Film>,
    /// The report, a line for each problem.
    pub report: String,
}

/// Renders `passes` passes of a scene, from the seed 1 unless the scene has one, with parameters set as on the command line.
pub fn render_text(text: &str, files: &Memory, sets: &[(&str, &str)], passes: u32) -> Told {
    render_planned(text, files, sets, passes, &|_| {})
}

/// The same, with its plan changed by `replan`.
pub fn render_planned(
    text: &str,
    files: &Memory,
    sets: &[(&str, &str)],
    passes: u32,
    replan: &dyn Fn(&mut Plan),
) -> Told {
    let mut sources = SourceMap::default();
    let main = sources.add("scene.snell".into(), "scene.snell".into(), text.trim_start().into()).unwrap();
    let sets: Vec<_> = sets.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect();
    let mut problems = Problems::default();
    let film = film(&mut sources, files, main, &sets, passes, replan, &mut problems);
    let film = film.filter(|_| !problems.has_errors());
    let report = problems.into_report(&sources);
    Told { film, report: report.render_short() }
}

fn film(
    sources: &mut SourceMap,
    files: &Memory,
    main: snell::source::FileId,
    sets: &[(String, String)],
    passes: u32,
    replan: &dyn Fn(&mut Plan),
    problems: &mut Problems,
) -> Option<Film> {
    let scene = snell::compile(sources, files, main, sets, problems)?;
    let loaded = snell::load::load(&scene, sources, files, problems)?;
    let camera = scene.cameras.first()?;
    let mut plan = snell::plan::plan(&loaded, Some(camera), None);
    replan(&mut plan);
    let lowered = snell::lower::lower(&loaded, &plan, camera, files, problems)?;
    let seed = scene.render.seed.map_or(1, |seed| seed.value);
    let settings = Settings { seed, ..Settings::new(lowered.method, plan.depth, passes) };
    Some(snell::render::render(&lowered.world, &settings, &()).film)
}

/// The bits of every pixel's mean.
pub fn film_bits(film: &Film) -> Vec<[u32; 3]> {
    film.mean().iter().map(|pixel| pixel.to_array().map(f32::to_bits)).collect()
}
