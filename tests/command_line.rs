//! The `snell` command, run as a user runs it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// What the command says in a folder.
fn snell(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell"));
    command.current_dir(folder).args(args).output().expect("the command runs")
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("the command ends by itself")
}

/// A folder with a scene that knows its frame.
fn sequence() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let scene = "snell 1
param frame: int = 0 in 0..10
camera { position: (0m, 0m, 4m), look_at: (0m, 0m, 0m), film: { size: 4 x 3 } }
light point { position: (0m, 2m, 2m), power: 60W }
let sizes = [for_frame(i) for i in 0..frame + 1]
fn for_frame(i: int) -> length { 1m / (i - 7) }
sphere { radius: abs(sizes[frame]) }
";
    fs::write(folder.path().join("s.snell"), scene).expect("the scene can be written");
    folder
}

#[test]
fn frames_are_rendered_one_after_the_other() {
    let folder = sequence();
    let run = |args: &[&str]| snell(folder.path(), &[&["render", "s.snell", "--passes", "1"], args].concat());
    let output = run(&["--frames", "2..4"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    assert!(folder.path().join("s.0002.png").exists() && folder.path().join("s.0003.png").exists());
    assert!(!folder.path().join("s.0004.png").exists());
    assert_eq!(errors(&output).lines().count(), 2, "a line for each frame: {}", errors(&output));
    let output = run(&["--frames", "5", "-o", "f-{frame:02}.ppm"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    assert!(folder.path().join("f-05.ppm").exists());
}

#[test]
fn a_mistake_in_the_last_frame_is_found_before_the_first_is_rendered() {
    let folder = sequence();
    let output = snell(folder.path(), &["render", "s.snell", "--passes", "1", "--frames", "5..=7"]);
    assert_eq!(code(&output), 1);
    let said = errors(&output);
    assert!(said.contains("in frame 7") && said.contains("`1m / 0` divides by 0"), "{said}");
    assert!(!folder.path().join("s.0005.png").exists());
}

#[test]
fn frames_need_their_parameter() {
    let folder = sequence();
    fs::write(folder.path().join("still.snell"), "snell 1\nsphere { radius: 1m }\n").expect("written");
    fs::write(folder.path().join("length.snell"), "snell 1\nparam frame: length = 1m\n").expect("written");
    for (args, said) in [
        (vec!["check", "still.snell", "--frames", "0..2"], "param frame: int = 0"),
        (vec!["check", "length.snell", "--frames", "0..2"], "is a `length`"),
        (vec!["check", "s.snell", "--frames", "0..2", "--set", "frame=3"], "--set frame"),
        (vec!["check", "s.snell", "--frames", "3..3"], "no frame lies in"),
        (vec!["render", "s.snell", "--frames", "0..2", "-o", "a.png", "-o", "a.png"], "twice"),
        (vec!["render", "s.snell", "--frames", "0..2", "-o", "{frme}.png"], "{frame:04}"),
    ] {
        let output = snell(folder.path(), &args);
        assert_eq!(code(&output), 2, "{args:?}");
        assert!(errors(&output).contains(said), "{args:?}: {}", errors(&output));
    }
    let output = snell(folder.path(), &["check", "s.snell", "--frames", "9..12"]);
    assert_eq!(code(&output), 1);
    assert!(
        errors(&output).contains("out_of_range") && errors(&output).contains("`10`"),
        "{}",
        errors(&output)
    );
}

#[test]
fn doc_explains_words_and_scenes() {
    let folder = sequence();
    let said = |args: &[&str]| {
        let output = snell(folder.path(), args);
        (code(&output), String::from_utf8_lossy(&output.stdout).into_owned(), errors(&output))
    };
    let (exit, sphere, _) = said(&["doc", "sphere"]);
    assert!(exit == 0 && sphere.contains("sphere { center: (0m, 1m, 0m), radius: 30cm }"), "{sphere}");
    let (exit, radius, _) = said(&["doc", "radius"]);
    assert!(exit == 0 && radius.contains("of `disk`"), "{radius}");
    let (exit, _, spheer) = said(&["doc", "spheer"]);
    assert!(exit == 2 && spheer.contains("did you mean `sphere`?"), "{spheer}");
    let (exit, scene, _) = said(&["doc", "s.snell"]);
    assert!(exit == 0 && scene.contains("frame: int = 0 in 0..10"), "{scene}");
    assert!(scene.contains("for_frame(i: int) -> length") && scene.contains("sizes: a list"), "{scene}");
}

/// A ball of glass on a floor, and a lamp so strong that what it sends to the floor cannot be held in a number.
fn glare() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let scene = "snell 1
param watts: number = 60
camera wide { position: (0m, 1m, 4m), look_at: (0m, 0m, 0m), film: { size: 8 x 8 } }
camera near { position: (0m, 1m, 2m), look_at: (0m, 0m, 1m), fov: 20deg, film: { size: 8 x 8 } }
light point { position: (0m, 5cm, 1m), power: watts * 1W }
let clear = glass { ior: 1.5 }
sphere { radius: 50cm, material: clear, transform: translate(0m, 50cm, 0m) }
plane { y: 0m, material: diffuse { color: #808080 } }
render { method: pt, depth: 6 }
";
    fs::write(folder.path().join("s.snell"), scene).expect("the scene can be written");
    folder
}

#[test]
fn a_pixel_tells_every_vertex_of_its_paths() {
    let folder = glare();
    let run = |args: &[&str]| snell(folder.path(), &[&["render", "s.snell"], args].concat());
    let output = run(&["--pixel", "4,3", "--sample", "2"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    for word in [
        "pixel 4,3 sample 2: rgb(",
        "s.snell:7:1 (sphere), material `clear` (s.snell:6:13)",
        "clear boundary",
    ] {
        assert!(said.contains(word), "no {word:?} in {said}");
    }
    let all = run(&["--pixel", "4,3", "--passes", "3"]);
    let all = String::from_utf8_lossy(&all.stdout);
    assert_eq!(all.matches("pixel 4,3 sample ").count(), 3, "{all}");
    assert!(all.ends_with(&*said), "a sample alone is what it is among others");
    assert!(!folder.path().join("s.png").exists());
    assert_eq!(code(&run(&["--pixel", "8,3"])), 2);
    assert_eq!(code(&run(&["--sample", "8"])), 2);
    assert_eq!(code(&run(&["--pixel", "4,3", "-o", "s.png"])), 2);
}

#[test]
fn a_sample_that_is_not_a_number_names_the_command_that_replays_it() {
    let folder = glare();
    let args = ["render", "s.snell", "--set", "watts=3e38", "--camera", "near", "--passes", "1"];
    let output = snell(folder.path(), &args);
    let said = errors(&output);
    let command = said.lines().find_map(|line| line.trim().strip_prefix("snell ")).expect(&said);
    assert!(command.starts_with("render s.snell --set watts=3e38 --camera near --pixel "), "{command}");
    let replayed = snell(folder.path(), &command.split(' ').collect::<Vec<_>>());
    let told = String::from_utf8_lossy(&replayed.stdout);
    assert!(told.contains("rgb(NaN, NaN, NaN)") && told.contains("inf"), "{told}");
    assert!(told.contains("s.snell:8:1 (plane)"), "{told}");
}
