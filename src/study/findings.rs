//! What several curves say about each other, in numbers and in plain words.

use super::curve::{Curve, Reach};

/// A study, ready to be told.
pub struct Study {
    /// The scene, as the user named it.
    pub scene: String,
    /// Pixels in a row, and rows.
    pub size: (u32, u32),
    /// What the reference is, in a sentence.
    pub reference: String,
    /// relMSE of the reference's own noise; `None` when it is not known.
    pub reference_noise: Option<f64>,
    /// What "seconds" are: `seconds` or `core seconds`.
    pub time_unit: &'static str,
    /// One for each variant.
    pub curves: Vec<Curve>,
    /// The command that makes the study again.
    pub command: String,
}

/// Where one curve overtakes another.
#[derive(Clone, PartialEq, Debug)]
pub struct Crossing {
    /// The one that is better from then on.
    pub winner: String,
    /// The other.
    pub loser: String,
    /// When.
    pub seconds: f64,
    /// √relMSE there.
    pub error: f64,
}

/// Errors that tables ask for: 20 %, 10 %, 5 %, 2 %, 1 %, 0.5 %, 0.2 %, 0.1 %.
const TARGETS: [f64; 8] = [0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001];

impl Study {
    /// The reference must be at least ten times as exact, squared, as the best picture that it judges.
    pub fn reference_is_too_noisy(&self) -> bool {
        let best = self.curves.iter().filter_map(Curve::last).map(|step| step.rel_mse.median);
        let best = best.fold(f64::INFINITY, f64::min);
        self.reference_noise.is_some_and(|noise| noise > 0.1 * best)
    }

    /// Times at which all curves were measured: the last, and halves of it.
    pub fn common_times(&self) -> Vec<f64> {
        let ends = |pick: fn(&Curve) -> Option<f64>| self.curves.iter().filter_map(pick);
        let last = ends(|curve| curve.last().map(|step| step.seconds)).fold(f64::INFINITY, f64::min);
        let first = ends(|curve| curve.steps.first().map(|step| step.seconds)).fold(0.0, f64::max);
        if !last.is_finite() {
            return Vec::new();
        }
        let times = (0..8).map(|i| last / 4.0_f64.powi(i)).take_while(|&time| time >= first);
        let mut times: Vec<f64> = times.collect();
        times.reverse();
        times
    }

    /// The errors worth a column: the three below what the best curve begins with that some curve comes near.
    pub fn targets(&self) -> Vec<f64> {
        let errors = || self.curves.iter().flat_map(|curve| &curve.steps).map(|step| step.error());
        let (worst, best) = (errors().fold(0.0, f64::max), errors().fold(f64::INFINITY, f64::min));
        TARGETS.into_iter().filter(|&target| target < worst && target > 0.3 * best).collect()
    }

    /// Where curves cross, in the order of time.
    pub fn crossings(&self) -> Vec<Crossing> {
        let mut out = Vec::new();
        for (i, a) in self.curves.iter().enumerate() {
            for b in &self.curves[i + 1..] {
                out.extend(crossings(a, b));
            }
        }
        out.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        out
    }

    /// The curve with the lowest error at the last common time.
    pub fn best(&self) -> Option<&Curve> {
        let time = self.common_times().last().copied();
        let error = |curve: &Curve| {
            let at = time.and_then(|time| curve.rel_mse_at(time));
            at.or_else(|| curve.last().map(|step| step.rel_mse.median)).unwrap_or(f64::INFINITY)
        };
        self.curves.iter().min_by(|a, b| error(a).total_cmp(&error(b)))
    }

    /// What was found, a sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let mut out = Vec::new();
        let unit = self.time_unit;
        if let (Some(best), Some(time), true) =
            (self.best(), self.common_times().last(), self.curves.len() > 1)
        {
            let others = self.curves.iter().filter(|curve| curve.name != best.name);
            let best_error = best.rel_mse_at(*time);
            let gains = others.filter_map(|curve| {
                let times = match curve.seconds_to(best_error?) {
                    Reach::Never => format!("{} does not get there at all", curve.name),
                    reach => {
                        let sign = if matches!(reach, Reach::Extrapolated(_)) { "about " } else { "" };
                        format!("{} takes {sign}{} × as long", curve.name, short(reach.seconds()? / time))
                    }
                };
                Some(times)
            });
            let gains: Vec<String> = gains.collect();
            if let Some(error) = best_error {
                out.push(format!(
                    "After {} {unit}, {} is best with an error of {}: to get as far, {}.",
                    short(*time),
                    best.name,
                    percent(error.max(0.0).sqrt()),
                    gains.join(", and "),
                ));
            }
        }
        for crossing in self.crossings() {
            out.push(format!(
                "{} overtakes {} after {} {unit}, at an error of {}.",
                crossing.winner,
                crossing.loser,
                short(crossing.seconds),
                percent(crossing.error),
            ));
        }
        out.extend(self.curves.iter().map(price));
        out.extend(self.curves.iter().filter_map(|curve| {
            let last = curve.last().filter(|step| step.is_biased)?;
            let nature = if curve.has_photons {
                "It is bias, not noise, the blur of photons: averaging more runs does not remove it, more passes do, as their \
                 discs are smaller."
            } else {
                "It is bias, not noise, what the settings leave out or bend: neither more runs nor more passes remove it."
            };
            Some(format!(
                "{}: {} of the squared error is the same in every run, an error of {} after {} passes. {nature}",
                curve.name,
                percent((last.bias / last.rel_mse.mean).clamp(0.0, 1.0)),
                percent(last.bias.sqrt()),
                last.passes,
            ))
        }));
        out.extend(self.curves.iter().filter_map(|curve| {
            let last = curve.last()?;
            let share = 1.0 - last.trimmed.mean / last.rel_mse.mean;
            (share > 0.2).then(|| {
                format!(
                    "{}: the worst 0.1 % of pixels hold {} of the squared error; these are fireflies.",
                    curve.name,
                    percent(share.min(1.0)),
                )
            })
        }));
        out.extend(self.curves.iter().filter_map(|curve| {
            let honesty = curve.honesty.filter(|honesty| honesty.count >= 8)?;
            Some(format!(
                "{}: the error that Snell printed by itself was {} × the true one in the middle of {} pictures, and its 95 % \
                 intervals held the true one in {} of them.",
                curve.name,
                short(honesty.ratio),
                honesty.count,
                percent(honesty.coverage),
            ))
        }));
        if self.reference_is_too_noisy() {
            out.push(
                "The reference is too noisy to judge the best pictures: its noise is subtracted, but what is left is \
                 uncertain. `--reference-time` makes a better one."
                    .to_owned(),
            );
        }
        out
    }
}

/// "Half the error costs 4.0 × the time; one more digit costs 98 ×."
fn price(curve: &Curve) -> String {
    let name = &curve.name;
    let Some(slope) = curve.slope else { return format!("{name}: too few steps for a slope.") };
    match (slope.price_of(2.0), slope.price_of(10.0)) {
        (Some(half), Some(digit)) => format!(
            "{name}: half the error costs {} × the time, one more digit {} × (slope of relMSE {}, 95 %: {} to {}).",
            short(half),
            short(digit),
            signed(slope.value),
            signed(slope.interval.0),
            signed(slope.interval.1),
        ),
        _ => format!("{name}: more time does not lower the error (slope of relMSE {}).", signed(slope.value)),
    }
}

/// Where the better of two curves changes, within the time that both were measured.
fn crossings(a: &Curve, b: &Curve) -> Vec<Crossing> {
    let mut times: Vec<f64> = a.steps.iter().chain(&b.steps).map(|step| step.seconds).collect();
    times.sort_by(f64::total_cmp);
    // Positive where `a` is worse.
    let gap = |time: f64| Some(a.rel_mse_at(time)?.ln() - b.rel_mse_at(time)?.ln());
    let known = times.into_iter().filter_map(|time| Some((time, gap(time)?)));
    let known: Vec<(f64, f64)> = known.filter(|(_, gap)| gap.is_finite()).collect();
    let crossing = |w: &[(f64, f64)]| {
        let [(t0, g0), (t1, g1)] = [w[0], w[1]];
        if g0 == 0.0 || g0.signum() == g1.signum() {
            return None;
        }
        let seconds = (t0.ln() + g0 / (g0 - g1) * (t1.ln() - t0.ln())).exp();
        let (winner, loser) = if g1 > 0.0 { (b, a) } else { (a, b) };
        let error = a.rel_mse_at(seconds)?.sqrt();
        Some(Crossing { winner: winner.name.clone(), loser: loser.name.clone(), seconds, error })
    };
    known.windows(2).filter_map(crossing).collect()
}

/// A number in two or three digits.
pub fn short(x: f64) -> String {
    match x {
        x if !x.is_finite() => "—".to_owned(),
        0.0 => "0".to_owned(),
        x if x.abs() >= 9.95e6 || x.abs() < 1e-4 => format!("{x:.1e}"),
        x if x.abs() >= 9.95 => {
            let digits = x.round().abs().to_string();
            let grouped: Vec<String> = digits
                .as_bytes()
                .rchunks(3)
                .rev()
                .map(|group| String::from_utf8_lossy(group).into_owned())
                .collect();
            format!("{}{}", if x < 0.0 { "−" } else { "" }, grouped.join(","))
        }
        x if x.abs() >= 0.995 => format!("{x:.1}"),
        x => format!("{x:.*}", (1.0 - x.abs().log10()).ceil() as usize),
    }
}

/// A slope, with a minus that is as wide as a plus.
pub fn signed(x: f64) -> String {
    format!("{x:.2}").replace('-', "−")
}

/// A share for people.
pub fn percent(share: f64) -> String {
    format!("{} %", short(share * 100.0))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::study::curve::tests::curve;

    /// Paths, and photons that are quick at first and blurred for ever.
    pub fn study() -> Study {
        Study {
            scene: "a.snell".to_owned(),
            size: (2, 2),
            reference: "made".to_owned(),
            reference_noise: Some(1e-7),
            time_unit: "seconds",
            curves: vec![curve("pt", 0.1, |n| 1.0 / n), curve("ppm", 0.1, |n| 0.1 / n + 0.02)],
            command: "snell study a.snell".to_owned(),
        }
    }

    #[test]
    fn curves_cross_where_they_are_equal() {
        // 1/n = 0.1/n + 0.02 at n = 45.
        let crossings = study().crossings();
        assert_eq!(crossings.len(), 1, "{crossings:?}");
        assert_eq!(crossings[0].winner, "pt");
        assert!((crossings[0].seconds / 4.5 - 1.0).abs() < 0.2, "{crossings:?}");
    }

    #[test]
    fn the_best_is_the_one_with_the_least_error_in_the_same_time() {
        let study = study();
        assert_eq!(study.best().unwrap().name, "pt");
        let times = study.common_times();
        assert!((times.last().unwrap() - 25.6).abs() < 1e-9 && times[0] >= 0.1);
        assert!(study.targets().contains(&0.1) && !study.targets().contains(&0.001));
    }

    #[test]
    fn sentences_name_the_price_and_the_crossing() {
        let all = study().sentences().join("\n");
        assert!(all.contains("pt overtakes ppm after 4"), "{all}");
        assert!(all.contains("pt: half the error costs 4.0 × the time, one more digit 1"), "{all}");
    }

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 0.01234, 0.5, 4.04, 97.6, 12_345.0, -3.0, 2e9].map(short);
        assert_eq!(shown, ["0", "0.012", "0.50", "4.0", "98", "12,345", "-3.0", "2.0e9"]);
        assert_eq!(percent(0.0123), "1.2 %");
    }
}
