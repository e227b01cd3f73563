//! What each line of a scene costs: the time of the paths that meet its object, their rays, the noise of what is seen of it.

use super::pilot::Books;
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
}

/// All costs by line, the dearest first.
pub struct ByLine {
    objects: Vec<Line>,
    materials: Vec<Line>,
    /// What no line is to blame for.
    camera: f64,
    photons: f64,
    interrupted: f64,
    /// Seconds of the whole.
    total: f64,
    noise: f64,
}

/// The longest piece of a line that is shown.
const LONGEST: usize = 50;

impl ByLine {
    /// Shares out what was booked. `spans` leads from objects to where they were written.
    pub fn new(books: &Books, spans: &[Span], scene: &Scene, session: &Session) -> Self {
        let ledger = &books.ledger;
        // Photons are as many as for the whole picture, camera paths are fewer.
        let photons = ledger.photons.nanos as f64 * 1e-9;
        let total = photons + (books.seconds - photons) * books.larger;
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
            interrupted: seconds_of(&ledger.interrupted),
            photons,
            total,
            noise,
        }
    }

    /// The share of the whole time that has found its account.
    fn attributed(&self) -> f64 {
        let objects: f64 = self.objects.iter().map(|line| line.seconds).sum();
        (objects + self.camera + self.photons + self.interrupted) / self.total
    }

    /// For people: labels on the scene's text.
    pub fn human(&self) -> String {
        let mut out = String::new();
        self.write_lines("object", &self.objects, &mut out);
        self.write_lines("material", &self.materials, &mut out);
        let share = |seconds: f64| 100.0 * seconds / self.total;
        let _ = writeln!(
            out,
            "\n  {:>5.1} %  to the camera, {:.1} % to photons, {:.1} % to other programs; {:.1} % found their account",
            share(self.camera),
            share(self.photons),
            share(self.interrupted),
            100.0 * self.attributed()
        );
        out
    }

    fn write_lines(&self, what: &str, lines: &[Line], out: &mut String) {
        /// What takes less is not worth a line.
        const LEAST: f64 = 0.005;
        let shown =
            || lines.iter().filter(|l| l.seconds > LEAST * self.total || l.noise > LEAST * self.noise);
        let width = shown().map(|line| line.place.chars().count()).max().unwrap_or(0);
        let _ = writeln!(out, "\n     time    noise   rays  {what}");
        for Line { place, text, seconds, rays, noise } in shown() {
            let time = 100.0 * seconds / self.total;
            let noise = 100.0 * noise / self.noise.max(f64::MIN_POSITIVE);
            let _ = writeln!(
                out,
                "  {time:>5.1} %  {noise:>5.1} %  {:>5}  {place:<width$} │ {text}",
                thousands(*rays)
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
                })
            };
            lines.iter().map(line).collect::<Vec<_>>()
        };
        json!({
            "objects": lines(&self.objects),
            "materials": lines(&self.materials),
            "camera": self.camera / self.total,
            "photons": self.photons / self.total,
            "interrupted": self.interrupted / self.total,
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
            self.lines.push(Line { place, text, seconds: 0.0, rays: 0, noise: 0.0 });
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
