//! `snell plan`: what a scene calls for and why, what it leaves alone, and what it will take.

use super::args::{Format, MessageArgs, Method, SceneArgs, size};
use super::by_line::ByLine;
use super::pilot::Pilot;
use super::plan_page::Page;
use super::render::wish;
use super::session::Session;
use super::{Exit, fail, print};
use crate::check::Checked;
use crate::diag::Problems;
use crate::lower::Lowered;
use crate::plan::{Plan, Wanted};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Arguments of `snell plan`.
#[derive(Args, Debug)]
pub struct PlanArgs {
    /// The scene; `-` is standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Look through this camera
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// How light is simulated [default: as the scene says]
    #[arg(long, value_name = "METHOD")]
    method: Option<Method>,
    /// The size of the picture in pixels, such as `640x480`
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// As for `render`: `auto`, `all`, `+NAME`, `-NAME`, with commas between
    #[arg(long, value_name = "WORDS", value_delimiter = ',', value_parser = Wanted::parse, allow_hyphen_values = true)]
    effects: Vec<Wanted>,
    /// Render small pictures with and without each effect, and say what it adds to the time
    #[arg(long)]
    measure: bool,
    /// What each line costs, in time, rays and noise, and what the scene takes without the dearest ones
    #[arg(long, value_name = "WHAT")]
    by: Option<By>,
    /// The form of the result
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
    #[command(flatten)]
    scene_args: SceneArgs,
    #[command(flatten)]
    messages: MessageArgs,
}

/// What costs are sorted by.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum By {
    /// Lines of the scene.
    Line,
}

/// Prints the plan of a scene.
pub fn run(args: &PlanArgs) -> Exit {
    let mut session = match Session::open(&args.scene, &args.scene_args) {
        Ok(session) => session,
        Err(reason) => return fail(reason),
    };
    let text = text(args, &mut session);
    let good = session.is_good();
    session.report_alone(&args.messages);
    match text {
        Some(text) if good => {
            print(text);
            Exit::Done
        }
        _ => Exit::SceneWrong,
    }
}

fn text(args: &PlanArgs, session: &mut Session) -> Option<String> {
    let checked = session.compile()?;
    let mut camera = session.camera(&checked, args.camera.as_deref()).cloned();
    if let (Some(camera), Some(size)) = (&mut camera, args.size) {
        camera.film.size.value = size;
    }
    let loaded = crate::load::load(&checked, &session.sources, &session.files, &mut session.problems)?;
    if session.problems.has_errors() {
        return None; // what follows from a mistake is not worth a warning
    }
    let mut plan = crate::plan::plan(&loaded, camera.as_ref(), wish(args.method));
    let left_out = plan.want(&args.effects);
    crate::plan::warn(&plan, &loaded, &mut session.problems);
    let mut pilot = match &camera {
        Some(camera) => Some(Pilot::new(&loaded, &plan, camera, session)?),
        None => None,
    };
    let outlook = pilot.as_ref().map(Pilot::outlook);
    let prices = match (&pilot, args.measure) {
        (Some(pilot), true) => pilot.prices(&loaded, session),
        _ => Vec::new(),
    };
    let all_on = pilot.as_ref().filter(|_| args.measure).and_then(|pilot| pilot.all_on(&loaded, session));
    let by_line = match (&mut pilot, args.by) {
        (Some(pilot), Some(By::Line)) => {
            let books = pilot.books()?;
            let mut by_line = ByLine::new(&books, pilot.spans(), loaded.scene, session);
            let fewer = |place: String| Some((without(&place, pilot, &checked, args, session)?, place));
            let (others, places): (Vec<_>, Vec<_>) = by_line.dearest().into_iter().filter_map(fewer).unzip();
            places.iter().zip(pilot.savings(&others)).for_each(|(place, saving)| by_line.note(place, saving));
            Some(by_line)
        }
        _ => None,
    };
    let page = Page {
        plan: &plan,
        left_out: &left_out,
        loaded: &loaded,
        camera: camera.as_ref(),
        outlook,
        prices: &prices,
        all_on,
        by_line,
        session,
    };
    Some(match args.format {
        Format::Human => page.human(),
        Format::Json => format!("{:#}\n", page.json()),
    })
}

/// The scene without what a line puts into it, planned anew and ready for the pilot.
fn without(
    place: &str,
    pilot: &Pilot<'_>,
    checked: &Checked,
    args: &PlanArgs,
    session: &Session,
) -> Option<(Lowered, Plan)> {
    let fewer = checked.without(|span| session.line(span) == place);
    // What is missed for its absence, such as the light, is not worth a word.
    let loaded = crate::load::load(&fewer, &session.sources, &session.files, &mut Problems::default())?;
    let mut plan = crate::plan::plan(&loaded, Some(pilot.camera()), wish(args.method));
    plan.want(&args.effects);
    Some((pilot.lowered(&loaded, &plan, session)?, plan))
}
