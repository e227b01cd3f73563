//! `--pixel`: every vertex of one pixel's paths, with the lines of the scene that they met.

use super::render::{self, RenderArgs};
use super::session::Session;
use super::{Exit, fail, print};
use crate::lower::Lowered;
use crate::math::{Rgb, Vec3};
use crate::render::bsdf::{Lobe, MaterialId};
use crate::render::geometry::SurfacePoint;
use crate::render::integrator::{End, Event};
use crate::render::{Replay, replay};
use crate::source::SourceMap;
use std::fmt::Write;

/// Passes of a pixel that are shown where nothing says how many there are.
const DEFAULT_SAMPLES: u32 = 64;

/// Shows what happens on the paths of a pixel.
pub fn run(args: &RenderArgs, session: &mut Session, pixel: [u32; 2], pool: &rayon::ThreadPool) -> Exit {
    let ready = match render::compile(args, session, pool) {
        Ok(ready) => ready,
        Err(exit) => return exit,
    };
    let camera = &ready.lowered.world.camera;
    if pixel[0] >= camera.width() || pixel[1] >= camera.height() {
        let (x, y, width, height) = (pixel[0], pixel[1], camera.width(), camera.height());
        return fail(format_args!(
            "the pixel {x},{y} lies outside the picture, which has {width} x {height}"
        ));
    }
    let all = 0..ready.settings.stop.passes.unwrap_or(DEFAULT_SAMPLES);
    let passes = args.sample.map_or(all, |sample| sample..sample + 1);
    let teller = Teller { lowered: &ready.lowered, sources: &session.sources };
    for pass in passes {
        let shown = pool.install(|| replay(&ready.lowered.world, &ready.settings, pixel, pass..pass + 1));
        shown.iter().for_each(|replay| print(teller.path(pixel, replay)));
    }
    Exit::Done
}

/// The command that renders what `args` do, with only what the picture depends on.
pub fn command(args: &RenderArgs) -> String {
    let mut words = vec!["snell render".to_owned(), quoted(&args.scene.display().to_string())];
    let mut flag = |name: &str, value: String| words.push(format!("{name} {}", quoted(&value)));
    let scene = &args.scene_args;
    scene.sets.iter().for_each(|(name, value)| flag("--set", format!("{name}={value}")));
    scene.asset_dirs.iter().for_each(|folder| flag("--asset-dir", folder.display().to_string()));
    scene.limits.iter().for_each(|(name, value)| flag("--limit", format!("{name}={value}")));
    args.camera.iter().for_each(|name| flag("--camera", name.clone()));
    args.size.iter().for_each(|(width, height)| flag("--size", format!("{width}x{height}")));
    args.seed.iter().for_each(|seed| flag("--seed", seed.to_string()));
    if let Some(method) = args.method.and_then(|method| clap::ValueEnum::to_possible_value(&method)) {
        flag("--method", method.get_name().to_owned());
    }
    if scene.allow_outside {
        words.push("--allow-outside".to_owned());
    }
    words.join(" ")
}

/// As a shell takes it for one word.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// Puts events into words.
struct Teller<'a> {
    lowered: &'a Lowered,
    sources: &'a SourceMap,
}

impl Teller<'_> {
    /// A paragraph for a path, its vertices numbered from 1.
    fn path(&self, [x, y]: [u32; 2], replay: &Replay) -> String {
        let mut out = format!("pixel {x},{y} sample {}: {}\n", replay.pass, color(replay.sample));
        let mut vertex = 0;
        for event in &replay.events {
            match event {
                Event::Vertex { .. } => vertex += 1,
                Event::Branch { depth } => vertex = *depth as usize,
                _ => {}
            }
            self.event(vertex, event, &mut out);
        }
        out
    }

    fn event(&self, vertex: usize, event: &Event, out: &mut String) {
        let mut line = |name: &str, text: String| {
            let _ = writeln!(out, "      {name:<8} {text}");
        };
        match event {
            Event::Vertex { surface, wo, t, beta } => {
                let p = (surface.p.as_dvec3() + self.lowered.center).to_array();
                let _ = writeln!(out, "  {vertex:>3} {p:?} m, {t:?} m on: {}", self.place(surface));
                let side = if wo.dot(surface.n) > 0.0 { "outside" } else { "inside" };
                let (n, ns) = (vector(surface.n), vector(surface.ns));
                let _ = writeln!(out, "      seen     from {} ({side}), n {n}, shading n {ns}", vector(*wo));
                let _ = writeln!(out, "      beta     {}", color(*beta));
            }
            Event::Emitted { added } | Event::Lit { added } | Event::Photons { added }
                if *added == Rgb::BLACK => {}
            Event::Branch { depth } => {
                let _ = writeln!(out, "  the other way from vertex {depth}:");
            }
            Event::Emitted { added } => line("shines", format!("adds {}", color(*added))),
            Event::Lobes(lobes) if lobes.is_empty() => line("lobes", "none: it is black".to_owned()),
            Event::Lobes(lobes) => {
                line("lobes", lobes.iter().map(Lobe::name).collect::<Vec<_>>().join(", "));
            }
            Event::Light { wi, distance, arriving, pdf, pdf_bsdf, blocked } => {
                let (wi, arriving) = (vector(*wi), color(*arriving));
                let shadow = if *blocked { ", in shadow" } else { "" };
                line(
                    "light",
                    format!(
                        "{arriving} along {wi}, {distance:?} m, pdf {pdf:?}, by the bsdf {pdf_bsdf:?}{shadow}"
                    ),
                );
            }
            Event::Lit { added } => line("lit", format!("adds {}", color(*added))),
            Event::Gathered { added } => line("gathered", format!("adds {}, and it ends", color(*added))),
            Event::Sends => line("shared", "with pixels beside; from here on it counts by itself".to_owned()),
            Event::Shared { paths, added } => {
                let _ = writeln!(out, "  shared by {paths} paths: adds {}", color(*added));
            }
            Event::Photons { added } => line("photons", format!("add {}", color(*added))),
            Event::Scattered { lobe, wi, weight, pdf, through } => {
                let lobe = lobe.as_ref().map_or("no lobe", Lobe::name);
                let through = if *through { ", through the surface" } else { "" };
                let (wi, weight) = (vector(*wi), color(*weight));
                line("goes on", format!("{wi} by {lobe}{through}, weight {weight}, pdf {pdf:?}"));
            }
            Event::Sky { dir, added } => {
                let _ = writeln!(out, "    - the sky along {}: adds {}", vector(*dir), color(*added));
            }
            Event::Ended(end) => line("ends", reason(*end).to_owned()),
        }
    }

    /// What was met, as the scene has it: `scene.snell:6:1 (sphere), material `gold` (scene.snell:3:12)`.
    fn place(&self, surface: &SurfacePoint) -> String {
        let span = self.lowered.sources.get(surface.source.0 as usize);
        let object = span.and_then(|span| Some((self.sources.location(*span)?, self.sources.text(*span))));
        let object =
            object.map_or("an object".to_owned(), |(at, text)| format!("{at} ({})", first_word(text)));
        format!("{object}{}", self.material(surface.material))
    }

    fn material(&self, id: MaterialId) -> String {
        let Some(origin) = self.lowered.materials.get(&id) else { return String::new() };
        let name = origin.name.as_ref().map_or(String::new(), |name| format!(" `{name}`"));
        let at = origin.span.and_then(|span| self.sources.location(span));
        let at = at.map_or(String::new(), |at| format!(" ({at})"));
        format!(", material{name}{at}")
    }
}

/// The word that an object begins with.
fn first_word(text: &str) -> &str {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()
}

fn reason(end: End) -> &'static str {
    match end {
        End::Depth => "it may have no more vertices",
        End::Absorbed => "nothing is sent on",
        End::Roulette => "by chance, being worth little",
    }
}

/// All digits there are: what is printed can be typed in again.
fn vector(v: Vec3) -> String {
    let [x, y, z] = v.to_array();
    format!("({x:?}, {y:?}, {z:?})")
}

fn color(c: Rgb) -> String {
    format!("rgb({:?}, {:?}, {:?})", c.r, c.g, c.b)
}
