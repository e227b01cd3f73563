//! A study as text for a terminal, as CSV, and as JSON.

use super::curve::{Curve, Reach, Spread};
use super::findings::{Study, percent, short, signed};
use serde_json::{Value, json};
use std::fmt::Write;

/// For a terminal: a row for each variant, then what was found.
pub fn text(study: &Study, width: usize) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}, {} × {}", study.scene, study.size.0, study.size.1);
    let _ = writeln!(out, "reference: {}\n", study.reference);
    let targets = study.targets();
    let unit = if study.time_unit == "seconds" { "s" } else { "core s" };
    let mut rows = vec![header(&targets, unit)];
    rows.extend(study.curves.iter().map(|curve| row(curve, &targets)));
    out.push_str(&aligned(&rows));
    out.push_str("\n~ extrapolated along the slope    — out of reach\n\n");
    for sentence in study.sentences() {
        out.push_str(&wrapped(&sentence, width));
    }
    out
}

/// The same as Markdown, for documents.
pub fn markdown(study: &Study) -> String {
    let mut out = String::new();
    let targets = study.targets();
    let unit = if study.time_unit == "seconds" { "s" } else { "core s" };
    let rows =
        std::iter::once(header(&targets, unit)).chain(study.curves.iter().map(|curve| row(curve, &targets)));
    for (i, row) in rows.enumerate() {
        let _ = writeln!(out, "| {} |", row.join(" | "));
        if i == 0 {
            let _ = writeln!(out, "|---|---|{}", "---:|".repeat(row.len() - 2));
        }
    }
    out.push('\n');
    study.sentences().iter().for_each(|sentence| {
        let _ = writeln!(out, "- {sentence}");
    });
    let _ = writeln!(out, "\n`{}`", study.command);
    out
}

fn header(targets: &[f64], unit: &str) -> Vec<String> {
    let mut cells = ["", "error by doublings", "last error", unit, "slope"].map(str::to_owned).to_vec();
    cells.extend(targets.iter().map(|&target| format!("{unit} to {}", percent(target))));
    cells
}

fn row(curve: &Curve, targets: &[f64]) -> Vec<String> {
    let last = curve.last();
    let mut cells = vec![
        curve.name.clone(),
        sparkline(curve),
        last.map_or(String::new(), |step| percent(step.error())),
        last.map_or(String::new(), |step| short(step.seconds)),
        curve.slope.map_or("—".to_owned(), |slope| signed(slope.value)),
    ];
    cells.extend(targets.iter().map(|&target| reach_text(curve.seconds_to(target * target))));
    cells
}

/// Seconds to a target: `1.2`, `<0.1` at the first step, `~90` extrapolated, `—` out of reach.
pub fn reach_text(reach: Reach) -> String {
    match reach {
        Reach::AtMost(seconds) => format!("<{}", short(seconds)),
        Reach::Measured(seconds) => short(seconds),
        Reach::Extrapolated(seconds) => format!("~{}", short(seconds)),
        Reach::Never => "—".to_owned(),
    }
}

/// The error at every doubling as bars, even steps per factor.
fn sparkline(curve: &Curve) -> String {
    const BARS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
    let logs: Vec<f64> = curve.steps.iter().map(|step| step.error().max(1e-9).ln()).collect();
    let (low, high) = logs.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| (l.min(x), h.max(x)));
    let bar = |x: f64| {
        let share = if high > low { (x - low) / (high - low) } else { 0.0 };
        BARS[((share * 8.0) as usize).min(7)]
    };
    logs.into_iter().map(bar).collect()
}

/// Columns of equal width, the first two to the left.
fn aligned(rows: &[Vec<String>]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let length = |cell: &String| cell.chars().count();
    let widths: Vec<usize> =
        (0..count).map(|c| rows.iter().filter_map(|row| row.get(c)).map(length).max().unwrap_or(0)).collect();
    let mut out = String::new();
    for row in rows {
        let cells = row.iter().zip(&widths).enumerate().map(|(c, (cell, width))| {
            let gap = " ".repeat(width - length(cell));
            if c < 2 { format!("{cell}{gap}") } else { format!("{gap}{cell}") }
        });
        let line = cells.collect::<Vec<_>>().join("  ");
        let _ = writeln!(out, "{}", line.trim_end());
    }
    out
}

/// A sentence as an item of a list.
fn wrapped(sentence: &str, width: usize) -> String {
    let mut out = String::from("•");
    let mut column = 1;
    for word in sentence.split_whitespace() {
        let length = word.chars().count();
        if column + 1 + length > width.max(40) {
            out.push_str("\n ");
            column = 1;
        }
        let _ = write!(out, " {word}");
        column += 1 + length;
    }
    out + "\n"
}

/// A line for each variant and step. Times are medians, errors those of [`Spread`].
pub fn csv(study: &Study) -> String {
    const METRICS: [&str; 5] = ["rel_mse", "rel_mse_trimmed", "rmse", "flip", "ssim"];
    let mut out = String::from("variant,runs,passes,seconds");
    for metric in METRICS {
        for part in ["mean", "median", "p10", "p90"] {
            let _ = write!(out, ",{metric}_{part}");
        }
    }
    out.push_str(",bias\n");
    for curve in &study.curves {
        for step in &curve.steps {
            let name = curve.name.replace('"', "\"\"");
            let _ = write!(out, "\"{name}\",{},{},{}", curve.run_count, step.passes, step.seconds);
            for spread in [step.rel_mse, step.trimmed, step.rmse, step.flip, step.ssim] {
                let Spread { mean, median, low, high } = spread;
                let _ = write!(out, ",{mean},{median},{low},{high}");
            }
            let _ = writeln!(out, ",{}", step.bias);
        }
    }
    out
}

/// All that was found, for programs.
pub fn json(study: &Study) -> Value {
    let spread = |s: Spread| json!({ "mean": s.mean, "median": s.median, "p10": s.low, "p90": s.high });
    let targets = study.targets();
    let curves = study.curves.iter().map(|curve| {
        let steps = curve.steps.iter().map(|step| {
            json!({
                "passes": step.passes,
                "seconds": step.seconds,
                "rel_mse": spread(step.rel_mse),
                "rel_mse_trimmed": spread(step.trimmed),
                "rmse": spread(step.rmse),
                "flip": spread(step.flip),
                "ssim": spread(step.ssim),
                "bias": step.bias,
                "is_biased": step.is_biased,
            })
        });
        let reach = targets.iter().map(|&target| {
            let reach = curve.seconds_to(target * target);
            json!({
                "error": target,
                "seconds": reach.seconds(),
                "is_extrapolated": matches!(reach, Reach::Extrapolated(_)),
            })
        });
        json!({
            "variant": curve.name,
            "runs": curve.run_count,
            "slope": curve.slope.map(|s| json!({
                "value": s.value,
                "low": s.interval.0,
                "high": s.interval.1,
                "half_the_error_costs": s.price_of(2.0),
                "one_more_digit_costs": s.price_of(10.0),
            })),
            "efficiency": curve.efficiency(),
            "time_to": reach.collect::<Vec<_>>(),
            "printed_errors": curve.honesty.map(|h| json!({
                "ratio": h.ratio, "coverage": h.coverage, "count": h.count,
            })),
            "steps": steps.collect::<Vec<_>>(),
        })
    });
    let crossings = study.crossings().into_iter().map(|crossing| {
        json!({
            "winner": crossing.winner,
            "loser": crossing.loser,
            "seconds": crossing.seconds,
            "error": crossing.error,
        })
    });
    json!({
        "scene": study.scene,
        "width": study.size.0,
        "height": study.size.1,
        "reference": study.reference,
        "reference_noise": study.reference_noise,
        "time": study.time_unit,
        "curves": curves.collect::<Vec<_>>(),
        "crossings": crossings.collect::<Vec<_>>(),
        "findings": study.sentences(),
        "command": study.command,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::findings::tests::study;

    #[test]
    fn the_table_has_a_row_for_each_variant() {
        let text = text(&study(), 80);
        assert!(text.lines().any(|line| line.starts_with("pt   █") && line.contains(" 6.2 %")), "{text}");
        assert!(text.lines().any(|line| line.starts_with("ppm  ") && line.ends_with('—')), "{text}");
        assert!(text.lines().all(|line| line.chars().count() <= 120), "{text}");
    }

    #[test]
    fn csv_and_json_hold_every_step() {
        let csv = csv(&study());
        assert_eq!(csv.lines().count(), 1 + 2 * 9);
        let columns = csv.lines().next().map(|line| line.split(',').count());
        assert!(csv.lines().all(|line| Some(line.split(',').count()) == columns));
        assert_eq!(markdown(&study()).lines().filter(|line| line.starts_with('|')).count(), 4);
        let json = json(&study());
        assert_eq!(json["curves"][1]["steps"].as_array().map(Vec::len), Some(9));
        assert_eq!(json["crossings"][0]["winner"], "pt");
    }
}
