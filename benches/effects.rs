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
use std::path::PathBuf;
use std::process::Command;

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
    std::fs::write("docs/effects.md", page)?;
    Ok(())
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
