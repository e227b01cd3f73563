//! A plan, for people and for programs.

use super::by_line::ByLine;
use super::pilot::{Outlook, Price};
use super::progress::{duration, percent};
use super::session::Session;
use crate::ir::{Camera, Method};
use crate::load::Loaded;
use crate::plan::{Effect, EffectUse, Plan};
use serde_json::{Value, json};
use std::fmt::Write;

/// All that is known before the first ray of the picture.
pub struct Page<'a> {
    pub plan: &'a Plan,
    /// What the scene calls for and the command leaves out.
    pub left_out: &'a [EffectUse],
    pub loaded: &'a Loaded<'a>,
    pub camera: Option<&'a Camera>,
    /// What the picture will take.
    pub outlook: Option<Outlook>,
    pub prices: &'a [(Effect, Price)],
    /// What it would add to simulate everything.
    pub all_on: Option<Price>,
    /// What each line costs.
    pub by_line: Option<ByLine>,
    pub session: &'a Session,
}

impl Page<'_> {
    /// For people.
    pub fn human(&self) -> String {
        let mut out = String::new();
        let size = self.camera.map_or(String::new(), |camera| {
            let (width, height) = camera.film.size.value;
            format!(", {width} × {height}")
        });
        let _ = writeln!(out, "{}{size}", self.session.name);
        let _ = writeln!(out, "  method  {}: {}", method_name(self.plan.method), self.plan.why);
        self.outlook.iter().for_each(|outlook| self.write_outlook(outlook, &mut out));
        self.write_effects(&mut out);
        self.write_absent(&mut out);
        self.write_unread(&mut out);
        out.extend(self.by_line.as_ref().map(ByLine::human));
        out
    }

    fn write_outlook(&self, outlook: &Outlook, out: &mut String) {
        let Outlook { photon_seconds, camera_seconds, .. } = outlook;
        let pass = photon_seconds + camera_seconds;
        let photons = match self.plan.method {
            Method::Pt | Method::Classic => String::new(),
            _ => format!(", {} of it photons", percent(photon_seconds / pass)),
        };
        let _ = writeln!(
            out,
            "  time    {} to build, then {} of processor time a pass{photons}: {} for {} passes",
            duration(outlook.build_seconds),
            duration(pass),
            duration(outlook.build_seconds + pass * f64::from(self.passes())),
            self.passes()
        );
        let _ = writeln!(
            out,
            "  memory  {}{} of film, {} of photons",
            outlook
                .world_bytes
                .map_or(String::new(), |bytes| format!("{} of program and scene, ", megabytes(bytes))),
            megabytes(outlook.film_bytes),
            megabytes(outlook.photon_bytes)
        );
        let _ = writeln!(out, "  rays    {:.1} a path, those of photons included", outlook.rays_per_path);
    }

    /// Those of the scene, or as many as are usual.
    fn passes(&self) -> u32 {
        let written = self.loaded.scene.render.stop.passes;
        let usual = if self.plan.is_exact { 1 } else { super::render::DEFAULT_PASSES };
        written.map_or(usual, |passes| passes.value)
    }

    fn write_effects(&self, out: &mut String) {
        let places: Vec<String> = self.plan.effects.iter().map(|used| self.place(used)).collect();
        let width = places.iter().map(|place| place.chars().count()).max().unwrap_or(0);
        let priced = !self.prices.is_empty();
        let _ = write!(out, "\n  {:<17} {:<width$}  ", "effect", "called for by");
        let _ = writeln!(out, "{}adds", if priced { "price     " } else { "" });
        for (used, place) in self.plan.effects.iter().zip(&places) {
            let is_out = self.left_out.iter().any(|left| left.effect == used.effect);
            let adds = if is_out { "left out" } else { used.effect.adds() };
            let price = if priced { format!("{:<10}", self.price_text(used.effect)) } else { String::new() };
            let _ = writeln!(out, "  {:<17} {place:<width$}  {price}{adds}", used.effect.name());
        }
    }

    fn price(&self, effect: Effect) -> Option<&Price> {
        self.prices.iter().find(|(priced, _)| *priced == effect).map(|(_, price)| price)
    }

    /// What cannot be told from noise is said to be so.
    fn price_text(&self, effect: Effect) -> String {
        match self.price(effect) {
            Some(price) if price.share.abs() <= price.spread => {
                format!("< {}", percent(price.spread.max(0.001)))
            }
            Some(price) if price.share < 0.0 => format!("-{}", percent(-price.share)),
            Some(price) => percent(price.share),
            None => "–".to_owned(),
        }
    }

    fn write_absent(&self, out: &mut String) {
        if self.plan.absent.is_empty() {
            return;
        }
        let _ = writeln!(out, "\n  not simulated");
        for (effect, why) in &self.plan.absent {
            let forced = self.plan.simulates(*effect) && !self.plan.may_need(*effect);
            let saved = match self.price(*effect) {
                Some(price) if price.share > price.spread => {
                    format!("; it would add {}", percent(price.share))
                }
                _ => String::new(),
            };
            let note = if forced { "; forced on" } else { "" };
            let _ = writeln!(out, "  {:<17} {why}{saved}{note}", effect.name());
        }
        if let Some(price) = self.all_on {
            let least = price.share.max(0.0);
            let within = percent(price.spread.max(0.001));
            let _ = writeln!(
                out,
                "  all of these would make it {} slower, give or take {within}",
                percent(least)
            );
        }
    }

    /// What the scene names and nothing in it shows.
    fn write_unread(&self, out: &mut String) {
        let unread =
            || self.loaded.unread().map(|file| format!("{} ({})", file.value, self.session.line(file.span)));
        let unread: Vec<String> = unread().collect();
        if !unread.is_empty() {
            let _ = writeln!(out, "\n  not opened, as nothing shows it: {}", unread.join(", "));
        }
    }

    fn place(&self, used: &EffectUse) -> String {
        match used.count - 1 {
            0 => self.session.line(used.span),
            others => format!("{} and {others} more", self.session.line(used.span)),
        }
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let price_json = |price: &Price| json!({ "share": price.share, "spread": price.spread });
        let price = |effect| self.price(effect).map(price_json);
        let called = self.plan.effects.iter().map(|used| {
            json!({
                "effect": used.effect.name(),
                "called_for_by": self.session.line(used.span),
                "places": used.count,
                "adds": used.effect.adds(),
                "simulated": self.plan.simulates(used.effect),
                "price": price(used.effect),
            })
        });
        let absent = self.plan.absent.iter().map(|(effect, why)| {
            json!({
                "effect": effect.name(),
                "why": why,
                "simulated": self.plan.simulates(*effect),
                "price": price(*effect),
            })
        });
        json!({
            "scene": self.session.name,
            "method": method_name(self.plan.method),
            "why": self.plan.why,
            "passes": self.passes(),
            "effects": called.collect::<Vec<_>>(),
            "absent": absent.collect::<Vec<_>>(),
            "all_on": self.all_on.as_ref().map(price_json),
            "by_line": self.by_line.as_ref().map(ByLine::json),
            "expected": self.outlook.as_ref().map(|outlook| json!({
                "build_seconds": outlook.build_seconds,
                "photon_seconds_a_pass": outlook.photon_seconds,
                "camera_seconds_a_pass": outlook.camera_seconds,
                "rays_a_path": outlook.rays_per_path,
                "stored_photons_a_pass": outlook.stored_photons,
                "scene_bytes": outlook.world_bytes,
                "film_bytes": outlook.film_bytes,
                "photon_bytes": outlook.photon_bytes,
            })),
        })
    }
}

fn method_name(method: Method) -> &'static str {
    match method {
        Method::Pt => "pt",
        Method::Ppm => "ppm",
        Method::Hybrid => "hybrid",
        Method::Classic => "classic",
    }
}

fn megabytes(bytes: u64) -> String {
    match bytes as f64 / 1e6 {
        m if m >= 1000.0 => format!("{:.1} GB", m / 1000.0),
        m if m >= 9.95 || m == 0.0 => format!("{m:.0} MB"),
        m => format!("{m:.1} MB"),
    }
}
