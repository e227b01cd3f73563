//! `snell convert` as a person meets it: which files it writes, and how it ends.

use std::path::Path;
use std::process::{Command, Output};

fn snell(arguments: &[&str], folder: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell"));
    command.args(arguments).current_dir(folder).output().expect("the program runs")
}

fn ours(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/convert").join(name).display().to_string()
}

#[test]
fn each_scene_of_a_file_becomes_a_file_that_checks_and_is_laid_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let converted =
        snell(&["convert", &ours("several.txt"), "-o", "x.snell", "--report", "x.json"], folder.path());
    assert_eq!(converted.status.code(), Some(0));
    for file in ["x.snell", "x-2.snell"] {
        assert_eq!(
            snell(&["check", "--deny", "warnings", file], folder.path()).status.code(),
            Some(0),
            "{file}"
        );
        assert_eq!(snell(&["fmt", "--check", file], folder.path()).status.code(), Some(0), "{file}");
    }
    let report = std::fs::read_to_string(folder.path().join("x.json")).expect("the report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    assert_eq!(report["scenes"].as_array().map(Vec::len), Some(2));
    assert_eq!(report["token_count"], report["accounted"]);

    let second = snell(&["convert", &ours("several.txt"), "--scene", "2", "-q"], folder.path());
    let written = std::fs::read(folder.path().join("x-2.snell")).expect("the second scene");
    assert_eq!(String::from_utf8_lossy(&second.stdout), String::from_utf8_lossy(&written));
    assert_eq!(
        snell(&["convert", &ours("several.txt"), "--scene", "3"], folder.path()).status.code(),
        Some(2)
    );
}

#[test]
fn what_can_be_skipped_never_fails_but_strictly() {
    let folder = tempfile::tempdir().expect("a folder");
    for file in ["mistakes.txt", "doubts.txt", "guesses.txt"] {
        let lenient = snell(&["convert", &ours(file), "-o", "x.snell"], folder.path());
        assert_eq!(lenient.status.code(), Some(0), "{file}");
        let strict = snell(&["convert", &ours(file), "--strict", "-o", "y.snell"], folder.path());
        assert_eq!(strict.status.code(), Some(1), "{file}");
        assert!(!folder.path().join("y.snell").exists());
    }
}

/// Scenes from Windows and from abroad: UTF-16 with its mark, and bytes that are no UTF-8 in a remark.
#[test]
fn any_encoding_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "Background { color 0.5 0.5 0.5 }";
    let utf16: Vec<u8> =
        [0xff, 0xfe].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let foreign = [b"// \xb2\xe2\xca\xd4\n", text.as_bytes()].concat();
    for (name, bytes) in [("a.txt", utf16), ("b.txt", foreign)] {
        std::fs::write(folder.path().join(name), bytes).expect("a file");
        let converted = snell(&["convert", name, "-q"], folder.path());
        assert_eq!(converted.status.code(), Some(0), "{name}");
        assert!(String::from_utf8_lossy(&converted.stdout).contains("radiance: 0.5"), "{name}");
    }
}

#[test]
fn a_hyphen_is_standard_input_and_output() {
    let folder = tempfile::tempdir().expect("a folder");
    let plain = snell(&["convert", &ours("coursework.txt"), "-q"], folder.path());
    let hyphen = snell(&["convert", &ours("coursework.txt"), "-q", "-o", "-"], folder.path());
    assert_eq!(plain.stdout, hyphen.stdout);
    let report =
        snell(&["convert", &ours("coursework.txt"), "-q", "-o", "x.snell", "--report", "-"], folder.path());
    let report: serde_json::Value = serde_json::from_slice(&report.stdout).expect("JSON alone");
    assert_eq!(report["token_count"], report["accounted"]);
    assert!(folder.path().join("x.snell").exists() && !folder.path().join("-").exists());
}

#[test]
fn the_source_is_never_overwritten() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(ours("coursework.txt")).expect("a scene");
    std::fs::write(folder.path().join("a.txt"), &text).expect("a file");
    for arguments in [["convert", "a.txt", "-o", "./a.txt"], ["convert", "a.txt", "--report", "a.txt"]] {
        assert_eq!(snell(&arguments, folder.path()).status.code(), Some(2));
        assert_eq!(std::fs::read_to_string(folder.path().join("a.txt")).expect("still there"), text);
    }
}

#[test]
fn a_scene_of_this_language_and_a_folder_are_told_so() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("x.snell"), "// A scene.\n\nsnell 1\nenvironment {}\n")
        .expect("there is room");
    let told = |arguments: &[&str]| {
        let output = snell(arguments, folder.path());
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, said) = told(&["convert", "x.snell"]);
    assert!(code == Some(2) && said.contains("is a Snell scene already"), "{said}");
    let (code, said) = told(&["check", "."]);
    assert!(code == Some(2) && said.contains("such as `./x.snell`"), "{said}");
    let (code, said) = told(&["render", "x.snell", "--size", "-5x4"]);
    assert!(code == Some(2) && said.contains("such as `640x480`"), "{said}");
}

/// Mesh files become scenes that check, are laid out, and name only files that are there.
#[test]
fn mesh_files_become_scenes() {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/assets");
    let files = [
        "gltf/good.gltf",
        "gltf/picture_inside.gltf",
        "gltf/cameras_and_lights.gltf",
        "gltf/glass_of_volume.gltf",
        "gltf/matrix_mirrored.gltf",
        "gltf/two_uv_sets.gltf",
        "gltf/odd_names.gltf",
        "gltf/no_nodes.gltf",
        "obj/missing_mtl.obj",
        "obj/quoted_name.obj",
        "obj/missing_texture.obj",
        "obj/nan_vertex.obj",
    ];
    for file in files {
        let folder = tempfile::tempdir().expect("a folder");
        let name = Path::new(file).file_name().unwrap().to_str().unwrap();
        std::fs::copy(assets.join(file), folder.path().join(name)).expect("a copy");
        let library = "texture.mtl";
        std::fs::copy(assets.join("obj").join(library), folder.path().join(library)).expect("a copy");
        let converted = snell(&["convert", name, "-o", "x.snell", "--report", "x.json"], folder.path());
        let said = String::from_utf8_lossy(&converted.stderr).into_owned();
        assert_eq!(converted.status.code(), Some(0), "{file}: {said}");
        for command in [&["check", "x.snell"][..], &["fmt", "--check", "x.snell"]] {
            let checked = snell(command, folder.path());
            let text = std::fs::read_to_string(folder.path().join("x.snell")).unwrap();
            let said = String::from_utf8_lossy(&checked.stderr).into_owned();
            assert_eq!(checked.status.code(), Some(0), "{file}: {said}\n{text}");
        }
        let report = std::fs::read_to_string(folder.path().join("x.json")).expect("the report");
        let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
        assert!(report["counts"]["placements"].as_u64() > Some(0), "{file}");
    }
}

/// A picture that is there stays, unless `--force` says otherwise; without a place for it nothing is written.
#[test]
fn pictures_of_a_mesh_replace_nothing_unasked() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/assets/gltf/picture_inside.gltf");
    std::fs::copy(mesh, folder.path().join("x.gltf")).expect("a copy");
    let picture = folder.path().join("x-pictures/four_dots.png");
    std::fs::create_dir(folder.path().join("x-pictures")).expect("a folder");
    std::fs::write(&picture, "mine").expect("a picture");
    let code = |arguments: &[&str]| snell(arguments, folder.path()).status.code();
    assert_eq!(code(&["convert", "x.gltf", "-o", "x.snell"]), Some(2));
    assert_eq!(std::fs::read(&picture).expect("the picture"), b"mine");
    assert!(!folder.path().join("x.snell").exists());
    assert_eq!(code(&["convert", "x.gltf"]), Some(2));
    assert_eq!(code(&["convert", "x.gltf", "--dialect", "arsenal", "-o", "x.snell"]), Some(2));
    assert_eq!(code(&["convert", "x.gltf", "--deny", "warnings", "-o", "x.snell"]), Some(1));
    assert_eq!(code(&["convert", "x.gltf", "--force", "-o", "x.snell"]), Some(0));
    assert!(std::fs::read(&picture).expect("the picture").starts_with(b"\x89PNG"));
    let render = ["render", "x.snell", "--size", "32x24", "--passes", "2", "-q"];
    assert_eq!(code(&render), Some(0));
}
