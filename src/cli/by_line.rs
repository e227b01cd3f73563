//! What each line of a scene costs: the time of the paths that meet its object, their rays, the noise of what is seen of it.
//!
//! For the dearest lines it also says how much less time the scene takes without them, which is measured: what an object
//! costs is no measure of that, as the rays that it stops go on to what is behind it, or out of a room into the dark.

use super::pilot::{Books, Price};
use super::session::Session;
use crate::ir::{Object, Scene};
use crate::render::ledger::Account;
use crate::source::Span;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::fmt::Write;

/// The costs of a place in the text.
struct Line {
    /// Where it is, as `FILE:LINE`.
    place: String,
    /// How it begins.
    text: String,
    seconds: f64,
    rays: u64,
    noise: f64,
    /// The share of the whole time that the scene takes less without it, where that was measured.
    saving: Option<Price>,
}

/// All costs by line, the dearest first.
pub struct ByLine {
    objects: Vec<Line>,
    materials: Vec<Line>,
    /// What no line is to blame for.
    camera: f64,
    photons: f64,
    film: f64,
    /// Seconds of the whole.
    total: f64,
    noise: f64,
}

/// The longest piece of a line that is shown.
const LONGEST: usize = 50;
/// For so many lines it is measured what the scene takes without them.
const MEASURED: usize = 3;

impl ByLine {
    /// Shares out what was booked. `spans` leads from objects to where they were written.
    pub fn new(books: &Books, spans: &[Span], scene: &Scene, session: &Session) -> Self {
        let ledger = &books.ledger;
        // Photons are as many as for the whole picture, camera paths are fewer.
        let seconds_whole = |account: &Account| account.nanos as f64 * 1e-9 * books.own;
        let photons = ledger.photons.nanos as f64 * 1e-9 + seconds_whole(&ledger.map);
        let total = photons + (books.seconds - ledger.clock_seconds() - photons) * books.larger;
        let seconds_of = |account| ledger.seconds(account) * books.larger;
        let by_span: HashMap<Span, &Object> = scene.objects.iter().map(|o| (o.span, o)).collect();
        let mut objects = Lines::new(session);
        let mut materials = Lines::new(session);
        for (account, &span) in ledger.objects.iter().zip(spans) {
            let seconds = seconds_of(account);
            objects.add(span, account, seconds);
            let of = by_span.get(&span).and_then(|o| o.material.or(scene.shapes[o.shape].material));
            if let Some(material) = of {
                materials.add(scene.materials[material].span, account, seconds);
            }
        }
        let noise = ledger.camera.noise + ledger.objects.iter().map(|account| account.noise).sum::<f64>();
        Self {
            objects: objects.dearest_first(),
            materials: materials.dearest_first(),
            camera: seconds_of(&ledger.camera),
            photons,
            film: seconds_whole(&ledger.film) * books.larger,
            total,
            noise,
        }
    }

    /// The places of the dearest lines, for which it is worth while to measure what the scene takes without them.
    pub fn dearest(&self) -> Vec<String> {
        self.objects.iter().take(MEASURED).map(|line| line.place.clone()).collect()
    }

    /// Notes what was measured for some of them.
    pub fn note(&mut self, place: &str, saving: Price) {
        let line = self.objects.iter_mut().find(|line| line.place == place);
        line.into_iter().for_each(|line| line.saving = Some(saving));
    }

    /// The share of the whole time that has found its account.
    fn attributed(&self) -> f64 {
        let objects: f64 = self.objects.iter().map(|line| line.seconds).sum();
        (objects + self.camera + self.photons + self.film) / self.total
    }

    /// For people: labels on the scene's text.
    pub fn human(&self) -> String {
        let mut out = String::new();
        self.write_lines("object", &self.objects, &mut out);
        self.write_lines("material", &self.materials, &mut out);
        let share = |seconds: f64| 100.0 * seconds / self.total;
        let _ = writeln!(
            out,
            "\n  {:>5.1} %  to the camera, {:.1} % to the film, {:.1} % to photons; {:.1} % found their account",
            share(self.camera),
            share(self.film),
            share(self.photons),
            100.0 * self.attributed()
        );
        out.push_str(
            "  `time` is spent at the object; `without` is what the scene takes less, or more, when the line is deleted\n",
        );
        out
    }

    fn write_lines(&self, what: &str, lines: &[Line], out: &mut String) {
        /// What takes less is not worth a line.
        const LEAST: f64 = 0.005;
        let shown =
            || lines.iter().filter(|l| l.seconds > LEAST * self.total || l.noise > LEAST * self.noise);
        let width = shown().map(|line| line.place.chars().count()).max().unwrap_or(0);
        let is_measured = lines.iter().any(|line| line.saving.is_some());
        let column = |text: String| if is_measured { format!("{text:<16}") } else { String::new() };
        let _ = writeln!(out, "\n     time    noise     rays  {}{what}", column("without".to_owned()));
        for Line { place, text, seconds, rays, noise, saving } in shown() {
            let time = 100.0 * seconds / self.total;
            let noise = 100.0 * noise / self.noise.max(f64::MIN_POSITIVE);
            let without = saving.map_or(String::new(), |Price { share, spread }| {
                format!("{:+.1} ± {:.1} %", -100.0 * share, 100.0 * spread)
            });
            let _ = writeln!(
                out,
                "  {time:>5.1} %  {noise:>5.1} %  {:>7}  {}{place:<width$} │ {text}",
                thousands(*rays),
                column(without)
            );
        }
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let lines = |lines: &[Line]| {
            let line = |line: &Line| {
                json!({
                    "place": line.place,
                    "text": line.text,
                    "time": line.seconds / self.total,
                    "noise": line.noise / self.noise.max(f64::MIN_POSITIVE),
                    "rays": line.rays,
                    "without": line.saving.map(|saving| json!({ "share": -saving.share, "spread": saving.spread })),
                })
            };
            lines.iter().map(line).collect::<Vec<_>>()
        };
        json!({
            "objects": lines(&self.objects),
            "materials": lines(&self.materials),
            "camera": self.camera / self.total,
            "photons": self.photons / self.total,
            "film": self.film / self.total,
            "attributed": self.attributed(),
            "seconds": self.total,
        })
    }
}

/// Costs on their way to lines.
struct Lines<'a> {
    session: &'a Session,
    lines: Vec<Line>,
    by_place: HashMap<String, usize>,
}

impl<'a> Lines<'a> {
    fn new(session: &'a Session) -> Self {
        Self { session, lines: Vec::new(), by_place: HashMap::default() }
    }

    fn add(&mut self, span: Span, account: &Account, seconds: f64) {
        let place = self.session.line(span);
        let index = *self.by_place.entry(place.clone()).or_insert_with(|| {
            let text = self.session.sources.text(span).lines().next().unwrap_or_default();
            let text = text.chars().take(LONGEST).collect();
            self.lines.push(Line { place, text, seconds: 0.0, rays: 0, noise: 0.0, saving: None });
            self.lines.len() - 1
        });
        let line = &mut self.lines[index];
        line.seconds += seconds;
        line.rays += account.rays;
        line.noise += account.noise;
    }

    fn dearest_first(mut self) -> Vec<Line> {
        self.lines.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
        self.lines
    }
}

fn thousands(n: u64) -> String {
    match n {
        0..10_000 => n.to_string(),
        10_000..10_000_000 => format!("{} k", n / 1_000),
        _ => format!("{} M", n / 1_000_000),
    }
}
