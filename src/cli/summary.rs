//! What a render says at its end: for people, and as JSON.

use super::lossy::Loss;
use super::progress::{duration, percent};
use crate::plan::Plan;
use crate::render::film::{BadSample, BlurBounds};
use crate::render::{GatherRadius, Method, Outcome, Settings, Stop, StoppedBy};
use serde_json::{Value, json};
use std::fmt::Write;

/// Everything that the closing words are made of.
pub struct Summary<'a> {
    /// The scene, as the user named it.
    pub scene: &'a str,
    /// The command that renders it, but for what the picture does not depend on.
    pub command: &'a str,
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
    /// What every random number and every path followed from.
    pub settings: &'a Settings,
    /// What the scene's texts and parameters amount to, as hexadecimal digits.
    pub scene_hash: &'a str,
    /// What the picture lacks.
    pub loss: Option<&'a Loss>,
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
        if let Some(loss) = self.loss {
            let (names, share) = (loss.effects.join(", "), 100.0 * loss.energy);
            let _ = writeln!(out, "  lossy   without {names}: about {share:.1} % of the light is missing");
        }
        if stats.bad_samples > 0 {
            let bad = self.outcome.film.bad_samples();
            let places: Vec<String> = bad.iter().map(|bad| self.replay(bad)).collect();
            let _ = writeln!(
                out,
                "  trouble {} samples were not numbers and count as 0; what happened on the first:\n          {}",
                count(stats.bad_samples),
                places.join("\n          ")
            );
        }
        if stats.counters.bad_light > 0 {
            let _ = writeln!(
                out,
                "  trouble {} photons and paths that look for light for many pixels brought no number; they count as 0",
                count(stats.counters.bad_light)
            );
        }
        out
    }

    /// The command that shows how a sample came about.
    fn replay(&self, bad: &BadSample) -> String {
        let ([x, y], pass) = (bad.pixel, bad.pass);
        format!("{} --pixel {x},{y} --sample {pass}", self.command)
    }

    /// For people, on one line.
    pub fn line(&self) -> String {
        let stats = &self.outcome.stats;
        let files = if self.files.is_empty() { "nothing written".to_owned() } else { self.files.join(", ") };
        let error = self.outcome.error.map_or(String::new(), |e| format!(", error {}", percent(e.total())));
        let seconds = duration(self.compile_seconds + self.build_seconds + stats.seconds);
        let passes = count(u64::from(stats.passes));
        format!("{files}, {passes} passes in {seconds}{error}{}", self.stop_text())
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let stats = &self.outcome.stats;
        let region = self.outcome.film.region();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": self.scene,
            "scene_hash": self.scene_hash,
            "files": self.files,
            "width": region.width,
            "height": region.height,
            "method": self.method_name(),
            "settings": self.settings_json(),
            "why": self.plan.why,
            "effects": self.plan.effects.iter().map(|used| used.effect.name()).collect::<Vec<_>>(),
            "simulated": self.plan.simulated.iter().map(|effect| effect.name()).collect::<Vec<_>>(),
            "left_out": self.loss.map(|loss| json!({ "effects": loss.effects, "energy": loss.energy })),
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
            "bad_light": stats.counters.bad_light,
            "bad_places": self.outcome.film.bad_samples().iter().map(|bad| json!({
                "pixel": bad.pixel, "pass": bad.pass, "replay": self.replay(bad),
            })).collect::<Vec<_>>(),
            "is_exact": self.plan.is_exact,
            "error": self.outcome.error.map(|e| json!({
                "rel": e.error,
                "low": e.interval.map(|(low, _)| low),
                "high": e.interval.map(|(_, high)| high),
                "rel_mse": e.error * e.error,
                "trimmed": e.trimmed,
                "firefly_share": e.firefly_share(),
                "steady_share": e.steady,
                "blur_at_least": e.blur.map(|blur| blur.least),
                "blur": e.blur.filter(BlurBounds::is_known).map(|blur| blur.likely),
                "blur_at_most": e.blur.filter(BlurBounds::is_known).map(|blur| blur.most),
                "total": e.total(),
                "half_takes_seconds": stats.seconds * self.effort_for_half(),
            })),
        })
    }

    /// What the same picture needs: with the scene, these give the same bits on any machine.
    fn settings_json(&self) -> Value {
        let region = self.outcome.film.region();
        let stop = self.settings.stop;
        let photons = match self.method {
            Method::Ppm(ppm) => json!({
                "count": ppm.photon_count, "k": ppm.k, "radius": ppm.radius, "shrink": ppm.shrink,
            }),
            _ => Value::Null,
        };
        json!({
            "seed": self.settings.seed,
            "depth": self.settings.max_depth,
            "crop": self.settings.crop.map(|_| [region.x, region.y, region.width, region.height]),
            "stop": { "passes": stop.passes, "seconds": stop.seconds, "error": stop.error },
            "photons": photons,
        })
    }

    /// Facts for files that can hold them: enough to make the same picture again.
    pub fn facts(&self) -> Vec<(String, String)> {
        let stats = &self.outcome.stats;
        let mut facts = vec![
            ("scene", self.scene.to_owned()),
            ("scene_hash", self.scene_hash.to_owned()),
            ("method", self.method_name().to_owned()),
            ("passes", stats.passes.to_string()),
            ("seed", self.settings.seed.to_string()),
            ("settings", self.settings_json().to_string()),
        ];
        if let Some(error) = self.outcome.film.whole_error() {
            facts.push(("whole_error", error.map(|error| format!("{error:e}")).join(" ")));
        }
        if let Some(loss) = self.loss {
            facts.push(("left_out", loss.effects.join(" ")));
            facts.push(("left_out_energy", format!("{:.4}", loss.energy)));
        }
        facts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
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

    fn stop_text(&self) -> String {
        let passes = self.outcome.stats.passes;
        match self.outcome.stopped_by {
            StoppedBy::Passes => String::new(),
            StoppedBy::Time => format!(", then time was up; `--passes {passes}` makes the same picture"),
            StoppedBy::Error => ", then the error was low enough".to_owned(),
            StoppedBy::Cancelled => ", then interrupted".to_owned(),
        }
    }

    /// How many times the work so far half the error takes. The error falls as 1/√passes; that of photons, whose
    /// discs shrink meanwhile, as passes^(−α/2) (Knaus & Zwicker 2011).
    fn effort_for_half(&self) -> f64 {
        match self.method {
            Method::Ppm(ppm) => 4.0_f64.powf(1.0 / ppm.shrink),
            // What of a hybrid's noise is that of its photons is not known.
            _ => 4.0,
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

    /// Photon maps also blur, by an amount that the spread between passes does not show.
    fn error_text(&self) -> String {
        if self.plan.is_exact {
            return "none: nothing was drawn at random".to_owned();
        }
        let Some(e) = self.outcome.error else { return "unknown below two passes".to_owned() };
        let stats = &self.outcome.stats;
        let half = duration(stats.seconds * self.effort_for_half());
        let asked = match self.settings.stop {
            Stop { error: Some(target), .. } if target < e.high() => {
                format!(
                    ", the {} asked for {}",
                    percent(target),
                    duration(stats.seconds * e.effort_to(target))
                )
            }
            _ => String::new(),
        };
        let (noise, blur) = match self.method {
            Method::Pt | Method::Classic(_) => ("", String::new()),
            Method::Ppm(_) | Method::Hybrid(_) => ("noise ", blur_text(e.blur)),
        };
        let interval = e.interval.map_or("no interval below four passes".to_owned(), |(low, high)| {
            format!("95 %: {} to {}", percent(low), percent(high))
        });
        let fireflies = match e.firefly_share() {
            share if share >= FIREFLIES => format!(
                "; {} of its square are the worst 0.1 % of pixels, {} without them",
                percent(share),
                percent(e.trimmed)
            ),
            _ => String::new(),
        };
        // Where a few specks are all of the error, what the rest of the picture is like comes first.
        if e.firefly_share() >= MOSTLY_FIREFLIES {
            // They would pass for blur as well.
            let blur = if blur.is_empty() { "" } else { "; blur not to be told from them" };
            return format!(
                "{noise}{} but for the worst 0.1 % of pixels, which are fireflies; {} with them ({interval}){blur}\n          \
                 half of it would take {half}{asked}",
                percent(e.trimmed),
                percent(e.error)
            );
        }
        format!(
            "{noise}{} ({interval}){fireflies}{blur}\n          half of it would take {half}{asked}",
            percent(e.error)
        )
    }
}

/// What is known of the error that photons make beside noise.
fn blur_text(blur: Option<BlurBounds>) -> String {
    match blur {
        None => String::new(),
        Some(blur) if !blur.is_known() => "; blur unknown below eight passes".to_owned(),
        Some(BlurBounds { least, most, .. }) if least > 0.0 => {
            format!("; blur {} to {}", percent(least), percent(most))
        }
        Some(BlurBounds { most, .. }) => format!("; blur at most {}", percent(most)),
    }
}

/// The share of the squared error above which the worst 0.1 % of pixels are worth a word. Even noise gives them 1 %.
const FIREFLIES: f64 = 0.1;
/// The share above which the error is that of a few specks.
const MOSTLY_FIREFLIES: f64 = 0.9;

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
