//! The metrics of `study` against the tools of those who proposed them. `tests/metrics/make.py` makes the pictures.

use snell::output::{Picture, read};
use snell::study::{flip, measure, metrics};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/metrics")
}

fn picture(name: &str) -> Picture {
    read(&folder().join(name)).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn flip_and_ssim_are_those_of_the_official_tools() {
    let expected = std::fs::read_to_string(folder().join("expected.json")).expect("it is committed");
    let expected: serde_json::Value = serde_json::from_str(&expected).expect("it is JSON");
    let pairs = expected.as_object().expect("a map of pairs");
    assert!(pairs.len() >= 6);
    for (name, expected) in pairs {
        let reference = picture(&format!("{name}.reference.png"));
        let test = picture(&format!("{name}.test.png"));
        let got = measure(&test, &reference, 1.0, flip::PIXELS_PER_DEGREE);
        let [shown, wanted] = [&test, &reference].map(|picture| metrics::display(&picture.radiance, 1.0));
        let map = flip::map(&wanted, &shown, reference.width as usize, flip::PIXELS_PER_DEGREE);
        let largest = f64::from(map.into_iter().fold(0.0, f32::max));
        // The tools work in single precision, and ours reads the files through linear light.
        for (what, got, tolerance) in
            [("flip", got.flip, 2e-5), ("flip_max", largest, 1e-4), ("ssim", got.ssim, 1e-5)]
        {
            let expected = expected[what].as_f64().expect("a number");
            assert!((got - expected).abs() < tolerance, "{name}: {what} is {got}, the tool says {expected}");
        }
    }
}

fn snell(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell"));
    command.current_dir(folder).args(args).output().expect("the command runs")
}

fn said(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn compare_prints_the_metrics_for_programs() {
    let args = ["compare", "shift.test.png", "shift.reference.png", "--format", "json"];
    let output = snell(&folder(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output.stderr));
    let facts: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    for name in ["rmse", "rel_mse", "rel_mse_trimmed", "ssim", "flip"] {
        assert!(facts[name].as_f64().is_some_and(|x| x > 0.0), "{name}: {facts}");
    }
}

#[test]
fn compare_fails_above_the_limit_and_draws_where() {
    let out = tempfile::tempdir().expect("a folder");
    let heat = out.path().join("heat.png");
    let run = |limit: &str| {
        let heat = heat.to_str().expect("a name");
        let args = ["compare", "shift.test.png", "shift.reference.png", "--max-relmse", limit, "-o", heat];
        snell(&folder(), &args).status.code()
    };
    assert_eq!((run("1e-6"), run("1e3")), (Some(1), Some(0)));
    let map = read(&heat).expect("a picture");
    assert_eq!((map.width, map.height), (56, 40));
    assert!(
        map.radiance.iter().any(|pixel| pixel.r > 0.5) && map.radiance.iter().any(|pixel| pixel.r == 0.0)
    );
}

#[test]
fn compare_says_what_it_cannot_compare() {
    let out = tempfile::tempdir().expect("a folder");
    std::fs::write(out.path().join("small.ppm"), b"P6\n1 1\n255\nabc").expect("written");
    std::fs::write(out.path().join("cut.ppm"), b"P6\n9 9\n255\nabc").expect("written");
    std::fs::write(out.path().join("two.ppm"), b"P6\n2 1\n255\nabcdef").expect("written");
    for (args, words) in [
        (vec!["smal.ppm", "small.ppm"], "did you mean `small.ppm`?"),
        (vec!["small.ppm", "two.ppm"], "--size 2x1"),
        (vec!["cut.ppm", "two.ppm"], "cannot be decoded"),
        (vec!["small.ppm", "small.ppm", "-o", "heat.exr"], "written as .png or .ppm"),
        (vec!["small.ppm", "small.ppm", "-o", "heat.png", "--heat", "welch"], "standard errors of both"),
        (vec!["small.ppm", "small.ppm", "--max-relmse", "-1"], "a number from 0 on"),
    ] {
        let output = snell(out.path(), &[&["compare"], &args[..]].concat());
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(said(&output.stderr).contains(words), "{args:?}: {}", said(&output.stderr));
    }
}
