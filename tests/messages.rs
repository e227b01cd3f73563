//! What programs hear: JSON lines and SARIF, from the command itself.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn snell(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_snell")).args(args).output().expect("the command was built")
}

fn check(form: &str, args: &[&str]) -> (String, Option<i32>) {
    let output = snell(&[&["check", "--message-format", form], args].concat());
    (String::from_utf8(output.stdout).expect("UTF-8"), output.status.code())
}

/// Every scene whose report is a test.
fn scenes() -> Vec<String> {
    let mut scenes = Vec::new();
    let mut open = vec![PathBuf::from("tests/diagnostics")];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).expect("the folder of scenes is there") {
            let path = entry.expect("a folder can be listed").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "snell") {
                scenes.push(path.to_str().expect("a name in ASCII").to_owned());
            }
        }
    }
    scenes.sort();
    scenes
}

/// The only run of a document.
fn run_of(text: &str) -> Value {
    let mut document: Value = serde_json::from_str(text).expect("one document");
    assert_eq!(document["version"], "2.1.0");
    assert!(document["$schema"].as_str().is_some_and(|schema| schema.ends_with("sarif-schema-2.1.0.json")));
    let runs = document["runs"].as_array_mut().expect("runs are a list");
    assert_eq!(runs.len(), 1);
    runs.remove(0)
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("`{key}` is no list in {value}"))
}

#[test]
fn sarif_holds_what_the_standard_requires() {
    let scenes = scenes();
    let (text, code) = check("sarif", &scenes.iter().map(String::as_str).collect::<Vec<_>>());
    // One of the scenes is not a text in UTF-8, which ends with 2, as wrong usage does.
    assert_eq!(code, Some(2));
    let run = run_of(&text);
    let driver = &run["tool"]["driver"];
    assert_eq!((&driver["name"], &run["columnKind"]), (&"snell".into(), &"unicodeCodePoints".into()));
    for rule in list(driver, "rules") {
        for text in ["shortDescription", "fullDescription", "help"] {
            assert!(rule[text]["text"].as_str().is_some_and(|text| !text.is_empty()), "{rule}");
        }
        assert!(rule["help"]["markdown"].as_str().is_some_and(|text| text.starts_with("# snell::")));
    }
    let results = list(&run, "results");
    assert!(results.len() > 200, "{} results", results.len());
    for result in results {
        let rule = result["ruleIndex"].as_u64().expect("each result has its rule") as usize;
        assert_eq!(list(driver, "rules")[rule]["id"], result["ruleId"]);
        assert_eq!(list(driver, "rules")[rule]["defaultConfiguration"]["level"], result["level"]);
        assert!(result["message"]["text"].is_string());
        let places = list(result, "locations").iter().chain(list(result, "relatedLocations"));
        places.for_each(|place| check_place(place, &run));
        for (id, place) in list(result, "relatedLocations").iter().enumerate() {
            assert_eq!(place["id"], id);
        }
    }
    let invocation = &list(&run, "invocations")[0];
    assert_eq!(invocation["executionSuccessful"], false);
    let trouble = invocation["toolExecutionNotifications"][0]["message"]["text"].as_str();
    assert!(trouble.is_some_and(|text| text.contains("latin1.snell")), "{invocation}");
}

/// A place lies in a file that is listed, and its region is one of that file's text.
fn check_place(place: &Value, run: &Value) {
    let physical = &place["physicalLocation"];
    let (file, region) = (&physical["artifactLocation"], &physical["region"]);
    let index = file["index"].as_u64().expect("a file is named by its index") as usize;
    let artifact = &list(run, "artifacts")[index];
    assert_eq!(artifact["location"]["uri"], file["uri"]);
    let path = Path::new(file["uri"].as_str().expect("these scenes are files"));
    let text = std::fs::read_to_string(path).expect("a relative name without strange characters");
    assert_eq!(artifact["length"], text.len());

    let number = |key: &str| region[key].as_u64().unwrap_or_else(|| panic!("`{key}` in {region}")) as usize;
    let start = number("byteOffset");
    let end = start + number("byteLength");
    assert_eq!((number("startLine"), number("startColumn")), line_and_column(&text, start));
    assert_eq!((number("endLine"), number("endColumn")), line_and_column(&text, end));
}

/// Both from 1; a column is a character.
fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or_default();
    (before.matches('\n').count() + 1, line.chars().count() + 1)
}

#[test]
fn sarif_is_written_where_nothing_is_wrong() {
    let (text, code) = check("sarif", &["scenes/beads.snell"]);
    let run = run_of(&text);
    assert_eq!(code, Some(0));
    assert!(list(&run, "results").is_empty());
    assert_eq!(list(&run, "artifacts")[0]["location"]["uri"], "scenes/beads.snell");
    assert_eq!(list(&run, "invocations")[0]["executionSuccessful"], true);
}

#[test]
fn what_is_typed_on_the_command_line_has_its_text_in_the_document() {
    let (text, _) = check("sarif", &["--set", "seats=600", "tests/diagnostics/resolve/out_of_range.snell"]);
    let run = run_of(&text);
    let typed = list(&run, "artifacts").iter().find(|artifact| artifact["location"].is_null());
    let typed = typed.expect("the value is an artifact");
    assert_eq!(typed["contents"]["text"], "600");
    assert_eq!(typed["description"]["text"], "--set seats");
}

#[test]
fn json_has_an_object_a_line_with_its_place_and_code() {
    let scenes = ["tests/diagnostics/resolve/trail.snell", "tests/diagnostics/syntax/included_from.snell"];
    let (text, code) = check("json", &scenes);
    assert_eq!(code, Some(1));
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("an object")).collect();
    let said: Vec<(&str, &str, u64, u64)> = lines
        .iter()
        .map(|line| {
            let number = |key: &str| line[key].as_u64().expect("a number");
            let text = |key: &str| line[key].as_str().expect("a text");
            (text("code"), text("file"), number("line"), number("column"))
        })
        .collect();
    let broken = "tests/diagnostics/syntax/parts/broken.snell";
    let expected =
        [("snell::resolve::not_finite", scenes[0], 5, 58), ("snell::syntax::missing_operand", broken, 3, 12)];
    assert_eq!(said, expected);
}

#[test]
fn denied_warnings_end_with_1() {
    let scene = "tests/diagnostics/check/no_light.snell";
    assert_eq!(snell(&["check", scene]).status.code(), Some(0));
    for command in ["check", "plan", "render"] {
        let output = snell(&[command, scene, "--deny", "warnings"]);
        assert_eq!(output.status.code(), Some(1), "{command}");
    }
    let output = snell(&["check", scene, "--deny", "warnings"]);
    assert!(String::from_utf8_lossy(&output.stderr).ends_with("warnings are denied by `--deny warnings`\n"));
}

#[test]
fn explain_finds_pages_and_says_what_is_near() {
    let said = |asked: &[&str]| {
        let output = snell(&[&["explain"], asked].concat());
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let (code, page, _) = said(&["Resolve::unknown_NAME"]);
    assert_eq!(code, Some(0));
    assert!(page.starts_with("snell::resolve::unknown_name (error)\n\nNothing that can be seen"), "{page}");
    assert!(said(&["union"]).1.starts_with("snell::resolve::no_csg (error)"));
    assert!(said(&["out_of_range"]).1.starts_with("2 codes end in `out_of_range`:\n\nsnell::check::"));
    assert!(said(&["plan"]).1.starts_with("snell::plan\n  classic_only\n"));
    let (code, page, near) = said(&["unkown_name"]);
    assert_eq!((code, page.as_str()), (Some(2), ""));
    assert!(near.contains("did you mean `unknown_name`"), "{near}");
    let all = said(&[]).1;
    assert!(snell::explain::pages().iter().all(|page| all.contains(&format!("\n  {}\n", page.name()))));
}
