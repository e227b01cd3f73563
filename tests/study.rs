//! That a study says what it measured, and `compare` what is more than noise.

use std::path::Path;
use std::process::{Command, Output};

fn snell(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell"));
    command.current_dir(folder).args(args).output().expect("the command runs")
}

fn said(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const SCENE: &str = "snell 1
camera { position: (0m, 1m, 4m), look_at: (0m, 0.5m, 0m), film: { size: 24 x 16 } }
light sphere { center: (1m, 2m, 1m), radius: 20cm, power: 80W }
plane { y: 0m }
sphere { center: (0m, 50cm, 0m), radius: 50cm }
";

#[test]
fn a_study_is_written_kept_and_continued() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("s.snell"), SCENE).expect("written");
    let args =
        ["study", "s.snell", "--sweep", "method=pt,ppm", "--sweep", "photons=2000", "--sweep", "spp=8"];
    let run = |more: &[&str]| {
        let output = snell(folder.path(), &[&args[..], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", said(&output.stderr));
        output
    };
    let first = run(&["--seeds", "2"]);
    assert!(said(&first.stdout).contains("ppm photons=2000"), "{}", said(&first.stdout));
    let again = run(&["--seeds", "3", "--format", "json"]);
    assert!(said(&again.stderr).contains("4 of 6 runs were measured before"), "{}", said(&again.stderr));
    let facts: serde_json::Value = serde_json::from_slice(&again.stdout).expect("JSON");
    let curves = facts["curves"].as_array().expect("a list");
    assert_eq!(curves.len(), 2);
    for curve in curves {
        assert_eq!(curve["runs"], 3);
        let steps = curve["steps"].as_array().expect("a list");
        let passes: Vec<u64> = steps.iter().filter_map(|step| step["passes"].as_u64()).collect();
        assert_eq!(passes, [1, 2, 4, 8]);
    }
    let page = std::fs::read_to_string(folder.path().join("s.study.html")).expect("the page is there");
    assert!(page.contains("<svg") && page.contains("--sweep method=pt,ppm"));
    for extension in ["csv", "json", "svg"] {
        assert!(folder.path().join(format!("s.study.{extension}")).exists(), "{extension}");
    }
}

#[test]
fn a_study_says_what_it_cannot_do() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let exact = "snell 1
camera { position: (0m, 0m, 4m), look_at: (0m, 0m, 0m), film: { size: 8 x 8 } }
light point { position: (0m, 2m, 2m), power: 60W }
sphere { radius: 1m }
render { method: classic { pixel: center } }
";
    std::fs::write(folder.path().join("s.snell"), SCENE).expect("written");
    std::fs::write(folder.path().join("exact.snell"), exact).expect("written");
    std::fs::write(folder.path().join("a.ppm"), b"P6\n1 1\n255\nabc").expect("written");
    for (args, words) in [
        (vec!["s.snell", "--sweep", "methd=pt"], "did you mean `method`?"),
        (vec!["s.snell", "--sweep", "precision=f32"], "docs/hard-cases.md"),
        (vec!["s.snell", "--sweep", "tolerance=1mm"], "the scene has none"),
        (vec!["s.snell", "-o", "a.pdf"], "a report is a page"),
        (vec!["s.snell", "--against", "a.ppm"], "holds display values"),
        (vec!["s.snell", "--against", "b.exr"], "cannot be read"),
        (vec!["exact.snell"], "draws nothing at random"),
    ] {
        let output = snell(folder.path(), &[&["study"], &args[..]].concat());
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", said(&output.stderr));
        assert!(said(&output.stderr).contains(words), "{args:?}: {}", said(&output.stderr));
    }
}

/// The findings and curves of a study in a folder of its own.
fn findings(scene: &str, args: &[&str]) -> serde_json::Value {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("s.snell"), scene).expect("written");
    let output = snell(folder.path(), &[&["study", "s.snell", "--format", "json", "-q"], args].concat());
    assert_eq!(output.status.code(), Some(0), "{}", said(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn curve<'a>(study: &'a serde_json::Value, name: &str) -> &'a serde_json::Value {
    let curves = study["curves"].as_array().expect("a list");
    let named = curves.iter().find(|curve| curve["variant"] == name);
    named.unwrap_or_else(|| panic!("no curve is called {name}: {study:#}"))
}

/// √relMSE of a curve's last step.
fn last_error(curve: &serde_json::Value) -> f64 {
    let step = curve["steps"].as_array().and_then(|steps| steps.last()).expect("steps");
    step["rel_mse"]["mean"].as_f64().expect("a number").sqrt()
}

#[test]
fn evenly_spread_samples_are_worth_something() {
    let study =
        findings(SCENE, &["--sweep", "sampler=sobol,independent", "--sweep", "spp=32", "--seeds", "4"]);
    let [sobol, independent] =
        ["pt sampler=sobol", "pt sampler=independent"].map(|name| last_error(curve(&study, name)));
    assert!(sobol < 0.95 * independent, "{sobol} {independent}");
}

#[test]
fn each_filter_has_a_reference_of_its_own() {
    // Against the reference of the other filter, edges alone would be wrong by many percent.
    let study =
        findings(SCENE, &["--sweep", "filter=box(0.5px),tent(4px)", "--sweep", "spp=64", "--seeds", "4"]);
    for name in ["pt filter=box", "pt filter=tent(4px)"] {
        assert_eq!(curve(&study, name)["steps"][6]["is_biased"], false, "{name}: {study:#}");
    }
}

#[test]
fn coarse_triangles_are_a_bias_that_no_pass_removes() {
    let vase = "snell 1
camera { position: (0m, 0.5m, 3m), look_at: (0m, 0.5m, 0m), film: { size: 24 x 16 } }
environment { radiance: 1 }
revolve { profile: bezier [(0cm, 0cm), (120cm, 0cm), (-40cm, 60cm), (60cm, 100cm)], material: diffuse { color: 0.1 } }
";
    let sweeps =
        ["--sweep", "method=pt", "--sweep", "tolerance=exact,30cm", "--sweep", "spp=64", "--seeds", "4"];
    let study = findings(vase, &sweeps);
    let [exact, coarse] =
        ["pt tolerance=exact", "pt tolerance=30cm"].map(|name| last_error(curve(&study, name)));
    assert!(coarse > 3.0 * exact, "{coarse} {exact}");
    let sentences = study["findings"].to_string();
    assert!(
        sentences.contains("pt tolerance=30cm") && sentences.contains("It is bias, not noise"),
        "{sentences}"
    );
}

#[test]
fn photons_whose_discs_do_not_shrink_keep_a_bias_that_is_named() {
    let sweeps = ["method=ppm", "photons=20000", "radius=1m", "shrink=0.999", "spp=32"];
    let args: Vec<&str> =
        sweeps.iter().flat_map(|sweep| ["--sweep", sweep]).chain(["--seeds", "4"]).collect();
    let study = findings(SCENE, &args);
    let sentences = study["findings"].to_string();
    assert!(sentences.contains("It is bias, not noise, the blur of photons"), "{sentences}");
}

#[test]
fn half_a_percent_of_energy_is_found_by_compare() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    for (name, power, seed) in [("a", "80W", "1"), ("same", "80W", "2"), ("brighter", "80.4W", "2")] {
        let scene = SCENE.replace("80W", power);
        std::fs::write(folder.path().join("s.snell"), scene).expect("written");
        let file = format!("{name}.exr");
        let args =
            ["render", "s.snell", "--size", "48x32", "--passes", "192", "--seed", seed, "-o", &file, "-q"];
        let output = snell(folder.path(), &args);
        assert_eq!(output.status.code(), Some(0), "{}", said(&output.stderr));
    }
    for (name, words) in
        [("same.exr", "noise explains the difference"), ("brighter.exr", "the difference is more than noise")]
    {
        let output = snell(folder.path(), &["compare", name, "a.exr"]);
        assert!(said(&output.stdout).contains(words), "{name}: {}", said(&output.stdout));
    }
}
