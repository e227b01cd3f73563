//! Snell as a library: from a text in memory to a picture, without a file system.
//!
//!     cargo run --release --example library > ball.ppm

use snell::diag::Problems;
use snell::output::{Display, Exposure, Format, Frame, Tone};
use snell::render::Settings;
use snell::source::{Memory, SourceMap};
use std::io::{Cursor, Write};

const SCENE: &str = r#"
snell 1
camera { position: (0m, 0.6m, 3m), look_at: (0m, 0.3m, 0m), film: { size: 320 x 240 } }
light sphere { center: (1m, 2m, 1m), radius: 20cm, power: 80W, color: 3800K }
environment { radiance: rgb(0.05, 0.06, 0.09) }
plane { y: 0m }
sphere { center: (0m, 0.4m, 0m), radius: 40cm, material: metal { kind: copper, roughness: 0.3 } }
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Any text and any files will do: `Files` is a trait, and editors bring their own.
    let mut sources = SourceMap::default();
    let main = sources
        .add("ball.snell".into(), "ball.snell".into(), SCENE.trim_start().into())
        .ok_or("too large")?;
    let files = Memory::default();

    // Every phase notes what it finds, and the next one goes on.
    let mut problems = Problems::default();
    let scene = snell::compile(&mut sources, &files, main, &[], &mut problems).ok_or("the scene is wrong")?;
    let loaded = snell::load::load(&scene, &sources, &files, &mut problems).ok_or("a file is missing")?;
    let camera = scene.cameras.first().ok_or("there is no camera")?;
    let plan = snell::plan::plan(&loaded, Some(camera), None);
    let lowered =
        snell::lower::lower(&loaded, &plan, camera, &files, &mut problems).ok_or("a picture is broken")?;

    let settings = Settings::new(lowered.method, plan.depth, 64);
    let outcome = snell::render::render(&lowered.world, &settings, &());

    let region = outcome.film.region();
    let (width, height, radiance) = (region.width, region.height, outcome.film.mean());
    let frame = Frame { width, height, radiance, ..Frame::default() };
    let mut bytes = Cursor::new(Vec::new());
    let display = Display { exposure: Exposure::Auto, tone: Tone::Agx, floor: false };
    snell::output::encode(&mut bytes, Format::Ppm, &frame, &display)?;
    std::io::stdout().write_all(bytes.get_ref())?;
    Ok(())
}
