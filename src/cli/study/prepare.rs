//! Every variant of a study ready for rays, and what makes its references.

use super::StudyArgs;
use super::sweep;
use super::variant::{self, Variant};
use crate::cli::Exit;
use crate::cli::args::Method;
use crate::cli::fail;
use crate::cli::render::{display, wish};
use crate::cli::session::{Fingerprint, Session};
use crate::ir;
use crate::load::Loaded;
use crate::lower::Lowered;
use crate::output::{Display, Exposure};
use crate::plan::Plan;
use crate::render::{Sampling, Settings, Stop};

/// A variant, ready for rays.
pub struct Ready {
    pub name: String,
    pub plan: Plan,
    pub lowered: Lowered,
    sampling: Sampling,
    /// Which of the references judges it.
    pub judge: usize,
}

/// All that is rendered.
pub struct Prepared {
    pub variants: Vec<Ready>,
    /// What makes the references: one, or one for each pixel filter, for each means another picture. None where one is
    /// given.
    pub references: Vec<Ready>,
    pub size: (u32, u32),
    display: Display,
    /// Scene, files, camera and size.
    pub scene_key: String,
}

impl Prepared {
    /// The scene's own look, with the exposure that brings a reference to the display by `factor`.
    pub fn shown(&self, factor: f32) -> Display {
        Display { exposure: Exposure::Ev(factor.log2()), ..self.display }
    }

    /// What brings radiance to the display, for pictures like `radiance`.
    pub fn factor(&self, radiance: &[crate::math::Rgb]) -> f32 {
        self.display.exposure.factor(radiance)
    }
}

/// Compiles the scene and builds a world for each variant.
///
/// # Errors
/// How the command ends when the scene is wrong, or has nothing of what is varied; it is said why.
pub fn prepare(args: &StudyArgs, session: &mut Session) -> Result<Prepared, Exit> {
    let prepared = compile(args, session);
    let good = session.is_good();
    session.report_alone(&args.messages);
    match prepared.filter(|_| good) {
        None => Err(Exit::SceneWrong),
        Some(prepared) => prepared.map_err(fail),
    }
}

fn compile(args: &StudyArgs, session: &mut Session) -> Option<Result<Prepared, String>> {
    let checked = session.compile()?;
    let mut camera = session.camera(&checked, args.camera.as_deref())?.clone();
    if let Some(size) = args.size {
        camera.film.size.value = size;
    }
    let loaded = crate::load::load(&checked, &session.sources, &session.files, &mut session.problems)?;
    if !session.is_good() {
        return None;
    }
    if sweep::varies_tolerance(&args.sweeps) && !loaded.scene.shapes.iter().any(|shape| shape.has_tolerance())
    {
        return Some(Err(
            "`tolerance` changes nothing here: it is for shapes made by `revolve`, `sweep` and \
                         `extrude`, and the scene has none"
                .to_owned(),
        ));
    }
    let mut variants: Vec<Ready> = Vec::new();
    let mut judges: Vec<Variant> = Vec::new();
    for variant in sweep::variants(&args.sweeps) {
        let mut ready = make_ready(&variant, variant.method(), &loaded, &camera, session)?;
        // Without photons, variants that differ in their number are the same.
        if variants.iter().any(|known| known.name == ready.name) {
            continue;
        }
        crate::plan::warn(&ready.plan, &loaded, &mut session.problems);
        if args.against.is_none() {
            let judge = variant.judge();
            ready.judge = judges.iter().position(|known| *known == judge).unwrap_or(judges.len());
            if ready.judge == judges.len() {
                judges.push(judge);
            }
        }
        variants.push(ready);
    }
    let make = |judge: &Variant| make_ready(judge, Some(args.reference_method), &loaded, &camera, session);
    let references = judges.iter().map(make).collect::<Option<_>>()?;
    let mut key = Fingerprint::default();
    key.add(session.fingerprint().as_bytes());
    for path in &loaded.files {
        key.add(&std::fs::read(path).unwrap_or_default());
    }
    key.add(format!("{:?} {:?}", args.camera, camera.film.size.value).as_bytes());
    Some(Ok(Prepared {
        variants,
        references,
        size: camera.film.size.value,
        display: display(&camera.film, false),
        scene_key: key.to_string(),
    }))
}

fn make_ready(
    variant: &Variant,
    method: Option<Method>,
    loaded: &Loaded<'_>,
    camera: &ir::Camera,
    session: &mut Session,
) -> Option<Ready> {
    let camera = variant.seen_through(camera);
    let mut plan = crate::plan::plan(loaded, Some(&camera), wish(method));
    variant.apply(&mut plan);
    let name = variant.name(plan.method);
    let lowered = crate::lower::lower(loaded, &plan, &camera, &session.files, &mut session.problems)?;
    Some(Ready { name, plan, lowered, sampling: variant.sampling(), judge: 0 })
}

impl Ready {
    /// The settings of a run.
    pub fn settings(&self, seed: u64, stop: Stop) -> Settings {
        let (method, max_depth, sampling) = (self.lowered.method, self.plan.depth, self.sampling);
        Settings { method, max_depth, seed, sampling, stop, crop: None }
    }

    /// Whether photons are gathered, whose discs blur.
    pub fn has_photons(&self) -> bool {
        variant::has_photons(self.plan.method)
    }

    /// What its measurements are kept under: other settings, another name.
    pub fn key(&self, parts: &[&str]) -> String {
        let mut hash = Fingerprint::default();
        parts.iter().for_each(|part| hash.add(part.as_bytes()));
        let (version, method, depth) = (env!("CARGO_PKG_VERSION"), self.lowered.method, self.plan.depth);
        hash.add(format!("{version} {method:?} {depth} {}", self.name).as_bytes());
        let word = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        format!("{}-{hash}", self.name.chars().map(word).collect::<String>())
    }
}
