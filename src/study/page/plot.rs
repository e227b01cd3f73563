//! A log–log plot as SVG: curves with their 10–90 % bands, values on hover, nothing from elsewhere.

use crate::study::findings::{percent, short};
use std::fmt::Write;

/// Colours that people with any colour vision tell apart (Okabe & Ito 2008), black left out.
pub const COLORS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31"];

/// A curve to draw.
pub struct Line {
    /// What the legend says.
    pub name: String,
    /// The points, in the order of x.
    pub points: Vec<Mark>,
}

/// A point with its band.
#[derive(Clone, Copy)]
pub struct Mark {
    /// Where, from 0 on.
    pub x: f64,
    /// The middle.
    pub y: f64,
    /// The lower edge of the band.
    pub low: f64,
    /// The upper edge.
    pub high: f64,
    /// Passes, for the words on hover.
    pub passes: u32,
}

/// What the axes are.
pub struct Axes<'a> {
    /// Below.
    pub x: &'a str,
    /// Above the plot, for the axis at its left.
    pub y: &'a str,
    /// Whether y is a share, written in percent.
    pub in_percent: bool,
}

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 330.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 46.0;

/// From logarithms to the place on the drawing.
struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// Covers all values, with some room at both ends.
    fn new(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let logs = values.filter(|&x| x > 0.0 && x.is_finite()).map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let room = 0.04 * (high - low).max(0.5);
        Self { low: low - room, high: high + room, from, to }
    }

    fn at(&self, value: f64) -> f64 {
        let log = value.max(10.0_f64.powf(self.low)).log10();
        self.from + (log - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Round values: powers of ten, and some times them where there is room.
    fn ticks(&self) -> Vec<f64> {
        let steps: &[f64] = match self.high - self.low {
            decades if decades > 3.0 => &[1.0],
            decades if decades > 1.0 => &[1.0, 2.0, 5.0],
            _ => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0],
        };
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        let all = (first..=last).flat_map(|e| steps.iter().map(move |s| s * 10.0_f64.powi(e)));
        all.filter(|value| (self.low..=self.high).contains(&value.log10())).collect()
    }
}

/// Draws the plot. `title` is for readers who cannot see it.
pub fn svg(title: &str, axes: &Axes<'_>, lines: &[Line]) -> String {
    let marks = || lines.iter().flat_map(|line| &line.points);
    let x = Scale::new(marks().map(|m| m.x), LEFT, WIDTH - RIGHT);
    let y = Scale::new(marks().flat_map(|m| [m.y, m.low, m.high]), HEIGHT - BOTTOM, TOP);
    let mut out = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\">\
         <title>{}</title>\n",
        escaped(title)
    );
    grid(&mut out, axes, &x, &y);
    lines.iter().zip(COLORS.iter().cycle()).for_each(|(line, color)| band(&mut out, line, color, &x, &y));
    lines
        .iter()
        .zip(COLORS.iter().cycle())
        .for_each(|(line, color)| curve(&mut out, axes, line, color, &x, &y));
    out.push_str("</svg>\n");
    out
}

fn grid(out: &mut String, axes: &Axes<'_>, x: &Scale, y: &Scale) {
    let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
    out.push_str("<g class=\"grid\">");
    for tick in x.ticks() {
        let at = x.at(tick);
        let _ = write!(
            out,
            "<path d=\"M{at:.1} {TOP}V{bottom}\"/><text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            bottom + 18.0,
            tick_text(tick)
        );
    }
    for tick in y.ticks() {
        let at = y.at(tick);
        let text = if axes.in_percent { format!("{} %", tick_text(tick * 100.0)) } else { tick_text(tick) };
        let _ = write!(
            out,
            "<path d=\"M{LEFT} {at:.1}H{right}\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
            LEFT - 7.0,
            at + 4.5
        );
    }
    let _ = writeln!(
        out,
        "<text class=\"axis\" x=\"{right}\" y=\"{}\" text-anchor=\"end\">{}</text>\
         <text class=\"axis\" x=\"4\" y=\"16\">{}</text></g>",
        HEIGHT - 6.0,
        escaped(axes.x),
        escaped(axes.y)
    );
}

fn band(out: &mut String, line: &Line, color: &str, x: &Scale, y: &Scale) {
    let upper = line.points.iter().map(|m| (m.x, m.high));
    let lower = line.points.iter().rev().map(|m| (m.x, m.low));
    let corners: Vec<String> =
        upper.chain(lower).map(|(a, b)| format!("{:.1},{:.1}", x.at(a), y.at(b))).collect();
    let _ = writeln!(out, "<polygon fill=\"{color}\" opacity=\".16\" points=\"{}\"/>", corners.join(" "));
}

fn curve(out: &mut String, axes: &Axes<'_>, line: &Line, color: &str, x: &Scale, y: &Scale) {
    let corners: Vec<String> =
        line.points.iter().map(|m| format!("{:.1},{:.1}", x.at(m.x), y.at(m.y))).collect();
    let _ = writeln!(
        out,
        "<polyline fill=\"none\" stroke=\"{color}\" stroke-width=\"2.2\" stroke-linejoin=\"round\" points=\"{}\"/>",
        corners.join(" ")
    );
    for mark in &line.points {
        let value = |v: f64| if axes.in_percent { percent(v) } else { short(v) };
        let passes = if mark.passes == 1 { "pass" } else { "passes" };
        let words = format!(
            "{}: {} after {} {} ({} {passes}); 8 of 10 runs from {} to {}",
            line.name,
            value(mark.y),
            short(mark.x),
            axes.x,
            mark.passes,
            value(mark.low),
            value(mark.high)
        );
        // The wide ring is for fingers and for the mouse.
        let _ = writeln!(
            out,
            "<g class=\"mark\"><circle cx=\"{0:.1}\" cy=\"{1:.1}\" r=\"12\" fill=\"transparent\"/>\
             <circle cx=\"{0:.1}\" cy=\"{1:.1}\" r=\"3.6\" fill=\"{color}\"/><title>{2}</title></g>",
            x.at(mark.x),
            y.at(mark.y),
            escaped(&words)
        );
    }
}

/// `0.001`, `1.5`, `20`, `10k`.
fn tick_text(value: f64) -> String {
    match value {
        v if v >= 9_999.5 => format!("{}k", short(v / 1000.0).trim_end_matches(".0")),
        v => {
            // As many digits as it takes to write it exactly.
            let exact = |digits: &usize| {
                ((v * 10.0_f64.powi(*digits as i32)).round() / 10.0_f64.powi(*digits as i32) / v - 1.0).abs()
                    < 1e-6
            };
            let digits = (0..8).find(exact).unwrap_or(8);
            format!("{v:.digits$}")
        }
    }
}

/// Text as HTML and XML take it.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let scale = Scale::new([0.03, 7.0].into_iter(), 0.0, 100.0);
        assert_eq!(
            scale.ticks().iter().map(|&t| tick_text(t)).collect::<Vec<_>>(),
            ["0.05", "0.1", "0.2", "0.5", "1", "2", "5"]
        );
        assert!(scale.at(0.03) > 0.0 && scale.at(7.0) < 100.0);
        assert_eq!([0.001, 0.02, 1.5, 10_000.0].map(tick_text), ["0.001", "0.02", "1.5", "10k"]);
    }

    #[test]
    fn values_that_cannot_be_on_a_logarithmic_axis_stay_inside_the_drawing() {
        let point = |x: f64, y: f64| Mark { x, y, low: -1.0, high: y, passes: 1 };
        let line = Line { name: "<a>".to_owned(), points: vec![point(0.1, 0.5), point(1.0, 0.0)] };
        let drawn = svg("t", &Axes { x: "s", y: "e", in_percent: true }, &[line]);
        assert!(!drawn.contains("NaN") && !drawn.contains("inf") && !drawn.contains("<a>"), "{drawn}");
    }
}
