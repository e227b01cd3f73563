//! A study as one page of HTML: nothing is fetched, so that it can be mailed and kept.

pub mod plot;

use super::curve::{Curve, Spread, Step};
use super::findings::{Study, percent, short, signed};
use super::{heat, table};
use plot::{Axes, COLORS, Line, Mark, escaped};
use std::fmt::Write;

/// The pictures of a variant: for each step what was seen, and where it is wrong, as files of PNG.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Pictures {
    /// Pairs of picture and heat map.
    pub steps: Vec<(Vec<u8>, Vec<u8>)>,
}

/// The page of a study. `pictures` belong to the curves, `reference` is the truth as PNG.
pub fn html(study: &Study, pictures: &[Pictures], reference: &[u8]) -> String {
    let mut out = String::new();
    head(&mut out, study);
    found(&mut out, study);
    plots(&mut out, study);
    tables(&mut out, study);
    shown(&mut out, study, pictures, reference);
    method(&mut out, study);
    out.push_str("</body>\n</html>\n");
    out
}

fn head(out: &mut String, study: &Study) {
    let (scene, (width, height)) = (escaped(&study.scene), study.size);
    let _ = write!(
        out,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>What accuracy costs: {scene}</title>\n<style>\n{}</style>\n</head>\n<body>\n\
         <p class=\"soft\">snell study · {width} × {height} pixels · version {}</p>\n\
         <h1>What accuracy costs in {scene}</h1>\n",
        include_str!("style.css"),
        env!("CARGO_PKG_VERSION"),
    );
}

fn found(out: &mut String, study: &Study) {
    let mut sentences = study.sentences().into_iter();
    if let Some(first) = sentences.next() {
        let _ = writeln!(out, "<p class=\"lead\">{}</p>", with_code(&first));
    }
    out.push_str("<ul class=\"found\">\n");
    sentences.for_each(|sentence| {
        let _ = writeln!(out, "<li>{}</li>", with_code(&sentence));
    });
    out.push_str("</ul>\n");
}

/// Text whose words in backticks are code.
fn with_code(text: &str) -> String {
    let parts = escaped(text);
    let pieces = parts.split('`').enumerate();
    pieces
        .map(|(i, piece)| if i % 2 == 1 { format!("<code>{piece}</code>") } else { piece.to_owned() })
        .collect()
}

fn legend(out: &mut String, study: &Study) {
    out.push_str("<ul class=\"legend\">");
    for (curve, color) in study.curves.iter().zip(COLORS.iter().cycle()) {
        let _ = write!(out, "<li><i style=\"background:{color}\"></i>{}</li>", escaped(&curve.name));
    }
    out.push_str("</ul>\n");
}

/// The error plot of a study alone, such as for a README.
pub fn error_plot(study: &Study) -> String {
    let title = format!("Error against {} of {}", study.time_unit, study.scene);
    let axes = Axes { x: study.time_unit, y: "error (√relMSE)", in_percent: true };
    plot::svg(&title, &axes, &lines(study, |step| root(step.rel_mse)))
}

/// The same as a file of its own, on white, with its legend.
pub fn error_plot_alone(study: &Study) -> String {
    const STYLE: &str = "<style>text{font:13px sans-serif;fill:#5c6570}.axis{fill:#1b1f24;font-weight:600}\
                         .grid path{stroke:#d9dee4}</style><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>";
    let mut legend = String::new();
    for (i, (curve, color)) in study.curves.iter().zip(COLORS.iter().cycle()).enumerate() {
        let y = 52 + 18 * i;
        let _ = write!(
            legend,
            "<circle cx=\"340\" cy=\"{}\" r=\"5\" fill=\"{color}\"/><text x=\"352\" y=\"{y}\">{}</text>",
            y - 4,
            escaped(&curve.name)
        );
    }
    let drawn = error_plot(study);
    drawn.replacen("</title>", &format!("</title>{STYLE}"), 1).replacen(
        "</svg>",
        &format!("{legend}</svg>"),
        1,
    )
}

fn plots(out: &mut String, study: &Study) {
    out.push_str("<h2>Error against time</h2>\n");
    legend(out, study);
    out.push_str("<div class=\"plots\">\n");
    let _ = writeln!(
        out,
        "<figure>{}<figcaption>The error as a share of each pixel's brightness. Each step to the right down a straight \
         line costs the same factor of time. The line is the middle run, the band holds eight of ten; point at a mark for \
         its numbers.</figcaption></figure>",
        error_plot(study)
    );
    type Pick = fn(&Step) -> Spread;
    let others: [(&str, &str, bool, Pick); 3] = [
        (
            "error without the worst 0.1 % of pixels",
            "Where this lies far below the first plot, a few fireflies make the error.",
            true,
            |step| root(step.trimmed),
        ),
        (
            "FLIP",
            "The difference that a person sees when flipping between picture and reference, 67 pixels per degree \
             (Andersson et al. 2020): 0 is none, 1 is all.",
            false,
            |step| step.flip,
        ),
        (
            "RMSE",
            "The root of the mean squared difference, in the unit of the radiance. Bright pixels count most.",
            false,
            |step| step.rmse,
        ),
    ];
    for (name, words, in_percent, pick) in others {
        let title = format!("{name} against {} of {}", study.time_unit, study.scene);
        let drawn = plot::svg(&title, &Axes { x: study.time_unit, y: name, in_percent }, &lines(study, pick));
        let _ = writeln!(out, "<figure>{drawn}<figcaption>{words}</figcaption></figure>");
    }
    out.push_str("</div>\n");
}

fn lines(study: &Study, pick: impl Fn(&Step) -> Spread) -> Vec<Line> {
    let mark = |step: &Step| {
        let Spread { median, low, high, .. } = pick(step);
        Mark { x: step.seconds, y: median, low, high, passes: step.passes }
    };
    let line = |curve: &Curve| {
        let points = curve.steps.iter().map(mark).filter(|mark| mark.x > 0.0 && mark.y > 0.0).collect();
        Line { name: curve.name.clone(), points }
    };
    study.curves.iter().map(line).collect()
}

fn root(spread: Spread) -> Spread {
    let [mean, median, low, high] =
        [spread.mean, spread.median, spread.low, spread.high].map(|x| x.max(0.0).sqrt());
    Spread { mean, median, low, high }
}

fn tables(out: &mut String, study: &Study) {
    let unit = study.time_unit;
    let _ = writeln!(out, "<h2>Equal error: how many {unit} it takes</h2>\n<div class=\"scroll\"><table>");
    let targets = study.targets();
    let heads = targets.iter().map(|&target| format!("<th>{}</th>", percent(target)));
    let _ = writeln!(
        out,
        "<tr><th>error</th>{}<th>half the error</th><th>one more digit</th></tr>",
        heads.collect::<String>()
    );
    let best_of = |target: f64| {
        let seconds = study.curves.iter().filter_map(|curve| curve.seconds_to(target * target).seconds());
        seconds.fold(f64::INFINITY, f64::min)
    };
    for curve in &study.curves {
        let cells = targets.iter().map(|&target| {
            let reach = curve.seconds_to(target * target);
            cell(&table::reach_text(reach), reach.seconds() == Some(best_of(target)))
        });
        let price = |factor: f64| {
            let price = curve.slope.and_then(|slope| slope.price_of(factor));
            cell(&price.map_or("—".to_owned(), |price| format!("{} ×", short(price))), false)
        };
        let (half, digit) = (price(2.0), price(10.0));
        let cells = cells.collect::<String>();
        let _ = writeln!(out, "<tr><td>{}</td>{cells}{half}{digit}</tr>", escaped(&curve.name));
    }
    out.push_str("</table></div>\n<p class=\"soft\">~ extrapolated along the slope, — out of reach: it hardly falls any more, or its bias is larger.</p>\n");

    let times = study.common_times();
    let _ =
        writeln!(out, "<h2>Equal time: the error after so many {unit}</h2>\n<div class=\"scroll\"><table>");
    let heads = times.iter().map(|&time| format!("<th>{}</th>", short(time)));
    let _ = writeln!(
        out,
        "<tr><th>{unit}</th>{}<th>bias</th><th>slope of relMSE</th></tr>",
        heads.collect::<String>()
    );
    for curve in &study.curves {
        let cells = times.iter().map(|&time| {
            let at = curve.rel_mse_at(time);
            let best = study.curves.iter().filter_map(|c| c.rel_mse_at(time)).fold(f64::INFINITY, f64::min);
            cell(&at.map_or("—".to_owned(), |e| percent(e.sqrt())), at == Some(best))
        });
        let cells = cells.collect::<String>();
        let bias = curve.last().map_or("—".to_owned(), |step| match step.is_biased {
            true => percent(step.bias.sqrt()),
            false => "none found".to_owned(),
        });
        let slope = curve.slope.map_or("—".to_owned(), |s| {
            format!("{} ({} to {})", signed(s.value), signed(s.interval.0), signed(s.interval.1))
        });
        let _ = writeln!(
            out,
            "<tr><td>{}</td>{cells}{}{}</tr>",
            escaped(&curve.name),
            cell(&bias, false),
            cell(&slope, false)
        );
    }
    out.push_str("</table></div>\n");
}

fn cell(text: &str, is_best: bool) -> String {
    format!("<td{}>{}</td>", if is_best { " class=\"best\"" } else { "" }, escaped(text))
}

/// The pictures, of which a slider shows one step at a time.
fn shown(out: &mut String, study: &Study, pictures: &[Pictures], reference: &[u8]) {
    let count = pictures.iter().map(|pictures| pictures.steps.len()).max().unwrap_or(0);
    if count == 0 {
        return;
    }
    let _ = write!(
        out,
        "<h2>The pictures</h2>\n<div class=\"slider\"><label>passes: <b id=\"passes\">{}</b>\
         <input type=\"range\" min=\"0\" max=\"{}\" value=\"{}\" id=\"step\"></label></div>\n<div class=\"pictures\">\n",
        1_u64 << (count - 1),
        count - 1,
        count - 1,
    );
    for ((curve, pictures), color) in study.curves.iter().zip(pictures).zip(COLORS.iter().cycle()) {
        let _ = write!(out, "<figure style=\"border-top:4px solid {color}\">");
        let last = pictures.steps.len().saturating_sub(1);
        for (i, (picture, map)) in pictures.steps.iter().enumerate() {
            let hidden = if i == last { "" } else { " hidden" };
            let step = curve.steps.get(i);
            let words = step.map_or(String::new(), |step| {
                format!("{} in {} {}", percent(step.error()), short(step.seconds), study.time_unit)
            });
            let name = escaped(&curve.name);
            let _ = write!(
                out,
                "<div class=\"step\" data-step=\"{i}\"{hidden}><img alt=\"{name} after {0} passes\" src=\"{1}\">\
                 <img alt=\"where {name} is wrong after {0} passes\" src=\"{2}\">\
                 <figcaption><b>{name}</b>, {0} passes: {words}</figcaption></div>",
                1_u64 << i,
                png_url(picture),
                png_url(map),
            );
        }
        out.push_str("</figure>\n");
    }
    let stops: Vec<String> = (0..=8_u8)
        .map(|i| {
            let [r, g, b] = heat::color(f32::from(i) / 8.0);
            format!("rgb({r},{g},{b})")
        })
        .collect();
    let (low, high) = heat::RANGE;
    let _ = write!(
        out,
        "<figure><img alt=\"the reference\" src=\"{}\"><figcaption><b>reference</b></figcaption>\
         <div class=\"scale\" style=\"background:linear-gradient(90deg,{})\"></div>\
         <figcaption>error of a pixel: {} to {}, even steps per factor</figcaption></figure>\n</div>\n",
        png_url(reference),
        stops.join(","),
        percent(low),
        percent(high),
    );
    out.push_str(SCRIPT);
}

/// A variant with fewer steps stays at its last.
const SCRIPT: &str = r#"<script>
const slider = document.getElementById("step");
slider.addEventListener("input", () => {
  const wanted = Number(slider.value);
  document.getElementById("passes").textContent = 2 ** wanted;
  for (const figure of document.querySelectorAll(".pictures figure")) {
    const steps = figure.querySelectorAll(".step");
    steps.forEach((step, i) => { step.hidden = i !== Math.min(wanted, steps.length - 1); });
  }
});
</script>
"#;

fn method(out: &mut String, study: &Study) {
    let noise = study.reference_noise.map_or(
        "Its own noise is not known, and nothing is subtracted for it.".to_owned(),
        |noise| {
            format!(
                "Its own noise amounts to an error of {}; relMSE of {} is subtracted from every measured one.",
                percent(noise.sqrt()),
                short(noise)
            )
        },
    );
    let runs = study.curves.iter().map(|curve| curve.run_count).min().unwrap_or(0);
    let _ = write!(
        out,
        "<h2>How this was measured</h2>\n\
         <p><b>Reference.</b> {} {}</p>\n\
         <p><b>Runs.</b> At least {runs} of each variant, each with another seed, looked at after 1, 2, 4, … passes. Times are {}, \
         without the measuring itself; that of the middle run counts.</p>\n\
         <p><b>Error</b> is √relMSE; relMSE is the mean of (x − r)² / (r² + 0.01 m²) over pixels and channels, m the mean \
         luminance of the reference. Steps whose error is not above that of the reference are left out. <b>Slopes</b> are fitted in log–log from 4 passes on; their 95 % intervals come from \
         drawing the runs anew. <b>Blur</b> is what the mean of all runs still has: an error that is the same in every run.</p>\n\
         <h2>To repeat it</h2>\n<pre>{}</pre>\n",
        with_code(&study.reference),
        escaped(&noise),
        study.time_unit,
        escaped(&study.command),
    );
}

fn png_url(bytes: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64(bytes))
}

/// Bytes as text (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let at = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for i in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * i) & 63) as usize] as char;
            out.push(if i <= group.len() { digit } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::findings::tests::study;

    #[test]
    fn base64_is_that_of_the_standard() {
        let cases = ["", "f", "fo", "foo", "foob", "fooba", "foobar"].map(|text| base64(text.as_bytes()));
        assert_eq!(cases, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
    }

    #[test]
    fn the_page_stands_alone_and_its_tags_are_closed() {
        let pictures = vec![Pictures { steps: vec![(vec![1, 2], vec![3]); 9] }; 2];
        let page = html(&study(), &pictures, &[7]);
        for far in ["http://", "https://", "@import", "url(", "src=\"/"] {
            let found = page.replace("http://www.w3.org/2000/svg", "");
            assert!(!found.contains(far), "{far}");
        }
        for tag in ["svg", "figure", "table", "tr", "td", "div", "ul", "li", "p", "g", "text"] {
            let opened =
                page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
        }
        assert!(page.matches("data:image/png;base64,").count() == 2 * 9 * 2 + 1 && !page.contains("NaN"));
    }
}
