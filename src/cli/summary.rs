//! What a render says at its end: for people, and as JSON.

use super::progress::{duration, percent};
use crate::plan::Plan;
use crate::render::{GatherRadius, Method, Outcome, StoppedBy};
use serde_json::{Value, json};
use std::fmt::Write;

/// Everything that the closing words are made of.
pub struct Summary<'a> {
    /// The scene, as the user named it.
    pub scene: &'a str,
    /// The files that were written.
    pub files: &'a [String],
    /// What was planned.
    pub plan: &'a Plan,
    /// The integrator with its settings.
    pub method: &'a Method,
    /// What came out.
    pub outcome: &'a Outcome,
    /// Seconds from text to plan.
    pub compile_seconds: f64,
    /// Seconds for meshes, pictures and trees.
    pub build_seconds: f64,
}

impl Summary<'_> {
    /// For people.
    pub fn human(&self) -> String {
        let mut out = String::new();
        let stats = &self.outcome.stats;
        let region = self.outcome.film.region();
        let files = if self.files.is_empty() { "nothing written".to_owned() } else { self.files.join(", ") };
        let _ = writeln!(out, "{} → {files}, {} × {}", self.scene, region.width, region.height);
        let _ = writeln!(out, "  method  {}: {}", self.method_text(), self.plan.why);
        let _ = writeln!(out, "  passes  {}{}", count(u64::from(stats.passes)), self.stop_text());
        let _ = writeln!(
            out,
            "  time    {}: compile {}, build {}, {}camera {}",
            duration(self.compile_seconds + self.build_seconds + stats.seconds),
            duration(self.compile_seconds),
            duration(self.build_seconds),
            self.photon_time(),
            duration(stats.camera_seconds),
        );
        let photons = stats.counters.photons;
        let _ = write!(out, "  rays    {}", count(stats.counters.rays));
        let _ = if photons > 0 {
            writeln!(out, ", {} photons, {} stored", count(photons), count(stats.counters.stored_photons))
        } else {
            writeln!(out)
        };
        let _ = writeln!(out, "  error   {}", self.error_text());
        if stats.bad_samples > 0 {
            let places = self.outcome.film.bad_samples().iter();
            let places: Vec<String> = places
                .map(|bad| format!("({}, {}) in pass {}", bad.pixel[0], bad.pixel[1], bad.pass))
                .collect();
            let _ = writeln!(
                out,
                "  trouble {} samples were not numbers and count as 0: pixels {}",
                count(stats.bad_samples),
                places.join(", ")
            );
        }
        out
    }

    /// For people, on one line.
    pub fn line(&self) -> String {
        let stats = &self.outcome.stats;
        let files = if self.files.is_empty() { "nothing written".to_owned() } else { self.files.join(", ") };
        let error = self.outcome.error.map_or(String::new(), |e| format!(", error {}", percent(e.error)));
        let seconds = duration(self.compile_seconds + self.build_seconds + stats.seconds);
        let passes = count(u64::from(stats.passes));
        format!("{files}, {passes} passes in {seconds}{error}{}", self.stop_text())
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let stats = &self.outcome.stats;
        let region = self.outcome.film.region();
        json!({
            "scene": self.scene,
            "files": self.files,
            "width": region.width,
            "height": region.height,
            "method": self.method_name(),
            "why": self.plan.why,
            "effects": self.plan.effects.iter().map(|used| used.effect.name()).collect::<Vec<_>>(),
            "passes": stats.passes,
            "stopped_by": match self.outcome.stopped_by {
                StoppedBy::Passes => "passes",
                StoppedBy::Time => "time",
                StoppedBy::Error => "error",
                StoppedBy::Cancelled => "interrupt",
            },
            "seconds": {
                "compile": self.compile_seconds,
                "build": self.build_seconds,
                "photons": stats.prepare_seconds,
                "camera": stats.camera_seconds,
                "render": stats.seconds,
            },
            "samples": stats.samples,
            "rays": stats.counters.rays,
            "photons": stats.counters.photons,
            "stored_photons": stats.counters.stored_photons,
            "bad_samples": stats.bad_samples,
            "error": self.outcome.error.map(|e| json!({
                "rel": e.error, "low": e.low, "high": e.high, "trimmed": e.trimmed,
            })),
        })
    }

    fn method_name(&self) -> &'static str {
        match self.method {
            Method::Pt => "pt",
            Method::Ppm(_) => "ppm",
            Method::Hybrid(_) => "hybrid",
            Method::Classic(_) => "classic",
        }
    }

    fn method_text(&self) -> String {
        match self.method {
            Method::Pt => "pt".to_owned(),
            Method::Classic(_) => "classic".to_owned(),
            Method::Ppm(ppm) => format!(
                "ppm, {} photons a pass, up to {} within {}",
                count(u64::from(ppm.photon_count)),
                ppm.k,
                length(f64::from(ppm.radius))
            ),
            Method::Hybrid(hybrid) => format!(
                "hybrid, {} photons a pass, aimed, gathered within {}",
                count(u64::from(hybrid.photon_count)),
                match hybrid.radius {
                    GatherRadius::Meters(radius) => length(f64::from(radius)),
                    GatherRadius::Pixels(pixels) => format!("{pixels} px"),
                }
            ),
        }
    }

    fn stop_text(&self) -> &'static str {
        match self.outcome.stopped_by {
            StoppedBy::Passes => "",
            StoppedBy::Time => ", then time was up",
            StoppedBy::Error => ", then the error was low enough",
            StoppedBy::Cancelled => ", then interrupted",
        }
    }

    fn photon_time(&self) -> String {
        match self.method {
            Method::Pt | Method::Classic(_) => String::new(),
            Method::Ppm(_) | Method::Hybrid(_) => {
                format!("photons {}, ", duration(self.outcome.stats.prepare_seconds))
            }
        }
    }

    /// The error falls as 1/√passes, so half of it takes four times as long. Photon maps also blur, by an amount that
    /// the spread between passes does not show.
    fn error_text(&self) -> String {
        if self.plan.is_exact {
            return "none: nothing was drawn at random".to_owned();
        }
        let Some(e) = self.outcome.error else { return "unknown below two passes".to_owned() };
        let half = duration(self.outcome.stats.seconds * 4.0);
        let (noise, blur) = match self.method {
            Method::Pt | Method::Classic(_) => ("", ""),
            Method::Ppm(_) => ("noise ", "; blur by the gather radius not counted"),
            Method::Hybrid(_) => ("noise ", "; blur of caustics not counted"),
        };
        format!(
            "{noise}{} (95 %: {} to {}; {} without the worst 0.1 % of pixels){blur}; half of it would take {half}",
            percent(e.error),
            percent(e.low),
            percent(e.high),
            percent(e.trimmed),
        )
    }
}

/// A count for people: `950`, `12,345`, `3.2 M`.
fn count(n: u64) -> String {
    match n {
        0..1_000 => n.to_string(),
        1_000..1_000_000 => format!("{},{:03}", n / 1_000, n % 1_000),
        _ => format!("{:.1} M", n as f64 / 1e6),
    }
}

/// A length in metres for people.
fn length(metres: f64) -> String {
    match metres {
        m if m >= 1.0 => format!("{m:.2} m"),
        m if m >= 0.01 => format!("{:.1} cm", m * 100.0),
        m => format!("{:.2} mm", m * 1000.0),
    }
}
