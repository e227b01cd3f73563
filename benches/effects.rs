//! What each effect costs in each shipped scene, as `docs/effects.md`.
//!
//! ```text
//! cargo bench --bench effects
//! ```
//!
//! Asks `snell plan --measure` about every scene of `scenes/`; prices are shares of the processor time of small pictures.

use serde_json::Value;
use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

const PAGE: &str = "docs/effects.md";
const HEAD: &str = "# What each effect costs

Snell simulates only the effects that a scene calls for. This page says, for each shipped scene, which these are, where they
are called for, and what they cost. `cargo bench --bench effects` writes it, by asking

```sh
snell plan SCENE --measure
```

which renders the scene at 160 pixels with and without each effect, in turns. A price is the share of the time that the effect
takes, as the median of four pairs, ± half the range of these. Below that range there is nothing to be told from noise. `–`
stands for what cannot be left out: a mirror is a mirror. *All on* is how much longer the scene takes when everything is
simulated that it does not call for, too; the picture is the same then, bit by bit, which `tests/effects.rs` proves.
`motion` may have a price below zero: where nothing moves, neighbouring pixels share what their paths find, which takes
longer and leaves much less noise.
";

fn main() -> Result<(), Box<dyn Error>> {
    let mut page = HEAD.to_owned();
    for scene in scenes()? {
        eprintln!("{}", scene.display());
        let output = Command::new(env!("CARGO_BIN_EXE_snell"))
            .args(["plan", "--measure", "--format", "json", "-q"])
            .arg(&scene)
            .env("RAYON_NUM_THREADS", "1")
            .output()?;
        let plan: Value = serde_json::from_slice(&output.stdout)?;
        write_scene(&plan, &mut page)?;
    }
    write_counts(&mut page)?;
    page.push_str(&lines()?);
    std::fs::write(PAGE, page)?;
    Ok(())
}

/// The section about lines, which `cargo bench --bench lines` writes.
fn lines() -> std::io::Result<String> {
    let old = std::fs::read_to_string(PAGE)?;
    let at = old.find("\n## What each line costs\n");
    Ok(at.map_or(String::new(), |at| old[at..].to_owned()))
}

/// Features that no object of a scene uses.
const UNUSED: &str = "
let _bumpy = bump { material: diffuse { color: 0.5 }, height: noise { size: 10cm }, depth: 1mm }
let _sparkling = glass { ior: 1.6, abbe: 30 }
let _holed = mask { material: diffuse { color: 0.5 }, opacity: checker { cells: 8 } }
";

/// What absent effects cost in instructions, which are the same for each run: by valgrind's callgrind, if it is there.
fn write_counts(page: &mut String) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    std::fs::create_dir(folder.path().join("lib"))?;
    for entry in std::fs::read_dir("scenes/lib")? {
        let entry = entry?;
        std::fs::copy(entry.path(), folder.path().join("lib").join(entry.file_name()))?;
    }
    let own = std::fs::read_to_string("scenes/cornell.snell")?;
    let (plain, more) = (folder.path().join("plain.snell"), folder.path().join("more.snell"));
    std::fs::write(&plain, &own)?;
    std::fs::write(&more, own + UNUSED)?;
    let mut rows = String::new();
    for method in ["pt", "hybrid"] {
        let Some(base) = instructions(&plain, method, "auto")? else {
            eprintln!("no valgrind: instructions are not counted");
            return Ok(());
        };
        let percent = |path, effects| -> Result<f64, Box<dyn Error>> {
            let count = instructions(path, method, effects)?.ok_or("valgrind is gone")?;
            Ok(100.0 * (count as f64 / base as f64 - 1.0))
        };
        let (unused, all) = (percent(&more, "auto")?, percent(&plain, "all")?);
        writeln!(rows, "| `{method}` | {:.0} M | +{unused:.2} % | +{all:.1} % |", base as f64 * 1e-6)?;
    }
    page.push_str(
        "
## What is absent

Instructions of the whole program (callgrind, 32 × 32 pixels, 2 passes, one thread) for `scenes/cornell.snell`, for the same
scene with a relief, a glass that spreads colours and a mask which no object uses, and for the same picture with all effects on.
What asks for an effect looks at a bit of a word that is the same for a whole render: there is one kernel for each method,
and a copy of it for each set of effects could save no more than the last column.

| method | as it is | with what nobody uses | all on |
|---|---|---|---|
",
    );
    page.push_str(&rows);
    Ok(())
}

/// How many instructions it takes to render a scene; `None` without valgrind.
fn instructions(scene: &Path, method: &str, effects: &str) -> Result<Option<u64>, Box<dyn Error>> {
    let folder = scene.parent().ok_or("a scene lies in a folder")?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", env!("CARGO_BIN_EXE_snell"), "render"])
        .arg(scene)
        .args(["--size", "32x32", "--passes", "2", "--threads", "1", "-q"])
        .args(["--method", method, "--effects", effects, "-o"])
        .arg(folder.join("picture.png"))
        .output();
    let Ok(output) = output else { return Ok(None) };
    let told = String::from_utf8_lossy(&output.stderr);
    let count = told.lines().find_map(|line| line.split_once("Collected : ")?.1.trim().parse().ok());
    count.map(Some).ok_or_else(|| format!("no count of instructions:\n{told}").into())
}

fn scenes() -> std::io::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir("scenes")?.map(|entry| entry.map(|entry| entry.path()));
    let mut scenes = entries.collect::<Result<Vec<_>, _>>()?;
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "snell"));
    scenes.sort();
    Ok(scenes)
}

fn write_scene(plan: &Value, page: &mut String) -> Result<(), Box<dyn Error>> {
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    writeln!(page, "\n## {}\n", text(&plan["scene"]))?;
    writeln!(page, "`{}`: {}.\n", text(&plan["method"]), text(&plan["why"]))?;
    writeln!(page, "| effect | called for by | price | adds |\n|---|---|---|---|")?;
    for effect in plan["effects"].as_array().into_iter().flatten() {
        let others = effect["places"].as_u64().unwrap_or(1) - 1;
        let more = if others == 0 { String::new() } else { format!(" and {others} more") };
        let (name, by, adds) =
            (text(&effect["effect"]), text(&effect["called_for_by"]), text(&effect["adds"]));
        writeln!(page, "| `{name}` | {by}{more} | {} | {adds} |", price(&effect["price"]))?;
    }
    let absent = plan["absent"].as_array().into_iter().flatten();
    let absent: Vec<String> = absent.map(|effect| format!("`{}`", text(&effect["effect"]))).collect();
    writeln!(page, "\nNot simulated: {}. All on: {}.", absent.join(", "), price(&plan["all_on"]))?;
    Ok(())
}

fn price(price: &Value) -> String {
    match (price["share"].as_f64(), price["spread"].as_f64()) {
        (Some(share), Some(spread)) => format!("{:.1} ± {:.1} %", 100.0 * share, 100.0 * spread),
        _ => "–".to_owned(),
    }
}
