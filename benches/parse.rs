//! The speed of the front half on generated scenes: text → tree, text → checked scene, text → canonical text.
//!
//! One thread; the best of several runs. `cargo bench --bench parse`, with sizes in kB as arguments: `-- 100 1000`.

use snell::diag::{Problems, Style};
use snell::source::{Memory, SourceMap};
use std::fmt::Write;
use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

fn main() {
    let sizes: Vec<usize> = std::env::args().filter_map(|arg| arg.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![100, 1_000] } else { sizes };
    println!("{:>28} {:>10} {:>10} {:>10}", "", "parse", "compile", "format");
    for kilobytes in sizes {
        let text = mixture(kilobytes * 1_000);
        row(&format!("{kilobytes} kB, mixed"), &text);
    }
    row("a million places in a loop", &instances(1_000_000));
    row("data of a million numbers", &data(1_000_000));
    for (name, text) in [
        ("100,000 parentheses", format!("snell 1\nlet _a = {}", "(".repeat(100_000))),
        ("5 MB on a line", format!("snell 1\nlet _a = [{}1]", "1, ".repeat(5_000_000 / 3))),
        ("1 MB of garbage", garbage(1_000_000)),
        ("1 MB without line ends", garbage(1_000_000).replace('\n', " ")),
        ("1 MB of NUL", "\0".repeat(1_000_000)),
        ("1 MB of unknown names", unknown_names(1_000_000)),
    ] {
        row(name, &text);
    }
}

/// Milliseconds of each step.
fn row(name: &str, text: &str) {
    let parse = best(|| {
        let (mut sources, main) = open(text);
        black_box(snell::syntax::parse(&mut sources, &Memory::default(), main, &mut Problems::default()));
    });
    let compile = best(|| {
        let (mut sources, main) = open(text);
        let mut problems = Problems::default();
        black_box(snell::compile(&mut sources, &Memory::default(), main, &[], &mut problems));
        black_box(problems.into_report(&sources).render_human(&Style::default()));
    });
    let format = best(|| {
        let (sources, main) = open(text);
        black_box(snell::format::format(&sources, main, &mut Problems::default()));
    });
    println!("{name:>28} {parse:>7.1} ms {compile:>7.1} ms {format:>7.1} ms");
}

fn open(text: &str) -> (SourceMap, snell::source::FileId) {
    let mut sources = SourceMap::default();
    let main = sources.add("main.snell".into(), PathBuf::from("main.snell"), text.into());
    let main = main.expect("the text is smaller than what can be addressed");
    (sources, main)
}

/// The shortest time of up to five runs, in milliseconds; slow ones run once.
fn best(mut run: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        run();
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
        if best > 1_000.0 {
            break;
        }
    }
    best
}

/// What scenes consist of: objects with materials and transforms, definitions, functions, loops, curves, comments.
fn mixture(bytes: usize) -> String {
    let mut text = String::from(
        "snell 1\n\ncamera { position: (0m, 1.6m, 4m), look_at: (0m, 0.4m, 0m), film: { size: 640 x 480 } }\n\
         light sphere { center: (1m, 3m, 1m), radius: 5cm, power: 60W, color: 3200K }\n",
    );
    let mut i = 0;
    while text.len() < bytes {
        let _ = write!(
            text,
            "
// Group {i}: a table with what stands on it.
let wood_{i} = phong {{ diffuse: #66331{}, specular: 0.2, shininess: {} }}
/// A leg of the table.
fn leg_{i}(height: length, thick: length = 4cm) -> object {{
    box {{ center: (0m, height / 2, 0m), size: (thick, height, thick), material: wood_{i} }}
}}
group {{
    for x in 0..2 {{ for z in 0..2 {{ place leg_{i}(70cm) at (x * 80cm, 0m, z * 50cm) }} }}
    sphere {{ center: ({}m, 75cm, {}m), radius: {}cm, material: glass {{ ior: 1.5{} }} }}
    if {} > 3 {{ disk {{ center: (0m, 71cm, 0m), radius: 30cm }} }} else {{ quad {{ origin: (0m, 71cm, 0m), edge_u: (1m, 0m, 0m), edge_v: (0m, 0m, 1m) }} }}
    revolve {{
        profile: bezier [(0cm, 0cm), (4cm, 0cm), (4cm, 0.5cm), (0.6cm, 1cm), (0.6cm, 8cm), (5cm, 10cm), (4cm, 16cm)]
        material: diffuse {{ color: hsv({}deg, 0.5, 0.8) }}
    }}
    transform: scale(2) then rotate_y({}deg) then translate({}m, 0m, 0m)
}}
let heights_{i} = [sin(k * 10deg) * 20cm + 30cm for k in 0..12 if k != 5]
place sphere {{ radius: clamp(heights_{i}[3], 1cm, 40cm) }} at (min({i}m, 5m), lerp(0m, 2m, 25%), -{i}m)
",
            i % 10,
            i % 90 + 10,
            i % 7,
            i % 5,
            i % 9 + 1,
            i % 10,
            i % 8,
            i % 360,
            i * 7 % 360,
            i % 100,
        );
        i += 1;
    }
    text
}

fn instances(count: usize) -> String {
    format!(
        "snell 1\nlet ball = sphere {{ radius: 1cm }}\nlight point {{ position: (0m, 9m, 0m), power: 60W }}\n\
         for i in 0..{count} {{\n    place ball {{ transform: translate((i % 1000) * 3cm, 0m, floor(i / 1000) * 3cm) }}\n}}\n"
    )
}

fn data(count: usize) -> String {
    let numbers: String = (0..count).map(|i| format!("{}.{} ", i % 1000, i % 7)).collect();
    format!("snell 1\nlet _numbers = data [ {numbers}]\n")
}

/// Pieces of scenes in an order without sense, the same in every run.
fn garbage(bytes: usize) -> String {
    const PIECES: [&str; 16] = [
        "sphere", "{", "}", "(", ")", "radius:", "1m", "\"", ",", "\n", "let", "=", "§", "//x\n", "..", "#12",
    ];
    let mut state = 1_u64;
    let mut text = String::from("snell 1\n");
    while text.len() < bytes {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        text.push_str(PIECES[(state >> 60) as usize]);
        text.push(' ');
    }
    text
}

fn unknown_names(bytes: usize) -> String {
    let mut text = String::from("snell 1\n");
    for i in 0.. {
        let _ = writeln!(text, "sphere {{ radius: size_{i}, centre: (0m, 0m, 0m) }}");
        if text.len() > bytes {
            break;
        }
    }
    text
}
