//! Effects on the command line: left out, forced on, priced.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SCENE: &str = "snell 1
camera {
    position: (0m, 1m, 4m), look_at: (0m, 0.5m, 0m), film: { size: 24 x 18 }
    lens: thin { focal_length: 50mm, radius: 6cm, focus: 4m }
}
light point { position: (1m, 3m, 2m), power: 60W }
plane { y: 0m }
sphere { center: (0m, 0.5m, 0m), radius: 50cm, material: glass { ior: 1.5 } }
render { stop: passes(2) }
";

fn snell(folder: &Path, args: &[&str]) -> Output {
    fs::write(folder.join("s.snell"), SCENE).expect("the scene can be written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell"));
    command.current_dir(folder).args(args).output().expect("the command runs")
}

/// How a command ends, and what it says.
fn said(args: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let output = snell(folder.path(), args);
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
pub fn an_effect_that_is_called_for_is_not_left_out() {
    let (code, said) = said(&["render", "s.snell", "--effects", "-lens_blur"]);
    assert_eq!(code, Some(2));
    assert!(said.contains("calls for `lens_blur` at s.snell:4:") && said.contains("--lossy"), "{said}");
}

#[test]
fn an_unknown_effect_gives_the_nearest_names() {
    let (code, said) = said(&["render", "s.snell", "--effects=-caustic"]);
    assert_eq!(code, Some(2));
    assert!(said.contains("did you mean `caustics`?"), "{said}");
}

#[test]
fn photons_bring_caustics_in_ppm_and_cannot_leave_them_out() {
    let (code, said) = said(&["render", "s.snell", "--method", "ppm", "--effects=-caustics", "--lossy"]);
    assert_eq!(code, Some(2));
    assert!(said.contains("photons bring all light"), "{said}");
}

#[test]
fn a_picture_that_lacks_something_says_so() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let args = ["render", "s.snell", "--effects=-caustics,-lens_blur", "--lossy", "--report", "r.json"];
    let output = snell(folder.path(), &[args.as_slice(), &["-o", "s.exr"]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("without lens_blur, caustics"), "{said}");
    let report = fs::read_to_string(folder.path().join("r.json")).expect("a report is written");
    let report: Value = serde_json::from_str(&report).expect("it is JSON");
    assert_eq!(report["left_out"]["effects"], serde_json::json!(["lens_blur", "caustics"]));
    let energy = report["left_out"]["energy"].as_f64().expect("a number");
    assert!(energy > 0.01 && energy < 0.9, "glass throws light onto the plane: {energy}");
    let picture = fs::read(folder.path().join("s.exr")).expect("a picture is written");
    let holds = |text: &[u8]| picture.windows(text.len()).any(|window| window == text);
    assert!(holds(b"left_out") && holds(b"lens_blur caustics"));
}

#[test]
fn a_plan_is_also_for_programs() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let output = snell(folder.path(), &["plan", "s.snell", "--format", "json", "--measure", "--by", "line"]);
    let plan: Value = serde_json::from_slice(&output.stdout).expect("it is JSON");
    assert_eq!((&plan["method"], &plan["passes"]), (&"hybrid".into(), &2.into()));
    let effects = plan["effects"].as_array().expect("there are effects");
    let lens = effects.iter().find(|effect| effect["effect"] == "lens_blur").expect("there is a lens");
    assert_eq!(lens["called_for_by"], "s.snell:4");
    assert!(lens["price"]["share"].is_number());
    let why = plan["absent"].as_array().expect("others are not").iter().map(|absent| absent["why"].clone());
    assert!(why.into_iter().any(|why| why == "no mask: nothing has holes"));
    assert!(plan["expected"]["film_bytes"].as_u64() > Some(1000));
    let lines = plan["by_line"]["objects"].as_array().expect("costs are booked");
    assert!(lines.iter().any(|line| line["place"] == "s.snell:8" && line["rays"].as_u64() > Some(0)));
    let without: Vec<bool> = lines.iter().map(|line| line["without"]["share"].is_number()).collect();
    assert!(without[0] && without.is_sorted_by(|dearer, cheaper| dearer >= cheaper), "{without:?}");
}
