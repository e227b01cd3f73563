//! Holds the code to the table "Who may use whom" of ARCHITECTURE.md.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// What a folder may use: other folders, and crates.
struct Allowed {
    folders: BTreeSet<String>,
    crates: BTreeSet<String>,
}

#[test]
fn every_folder_uses_only_what_the_table_allows() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = read_table(&root.join("ARCHITECTURE.md"));
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let crates = dependencies(&manifest);
    let mut faults = Vec::new();
    let sources = sources(&root.join("src"));
    let for_tests: Vec<PathBuf> = sources.iter().flat_map(|(_, file)| modules_for_tests(file)).collect();
    for (folder, file) in sources {
        if for_tests.contains(&file) {
            continue;
        }
        let Some(allowed) = table.get(&folder) else {
            faults.push(format!("{}: `{folder}` is not in the table", file.display()));
            continue;
        };
        let text = fs::read_to_string(&file).unwrap();
        let text = without_comments(text.split("#[cfg(test)]").next().unwrap());
        for used in used_folders(&text) {
            if used != folder && table.contains_key(&used) && !allowed.folders.contains(&used) {
                faults.push(format!("{}: `{folder}` must not use `{used}`", file.display()));
            }
        }
        for name in crates.iter().filter(|name| mentions(&text, name) && !allowed.crates.contains(*name)) {
            faults.push(format!("{}: `{folder}` must not use the crate `{name}`", file.display()));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_check_can_fail() {
    assert_eq!(used_folders("use crate::render::Film; crate::ir::Scene"), ["render", "ir"]);
    assert_eq!(used_folders("use crate::{diag::Problems, ir::{self, Scene}};"), ["diag", "ir"]);
    assert!(mentions("use pest::Parser;", "pest") && !mentions("use tempest::Parser;", "pest"));
    assert_eq!(without_comments("a // crate::b\nc"), "a \nc");
}

fn read_table(path: &Path) -> BTreeMap<String, Allowed> {
    let text = fs::read_to_string(path).unwrap();
    let (_, table) = text.split_once("## Who may use whom").expect("ARCHITECTURE.md has the table");
    let rows = table.lines().filter(|line| line.starts_with("| `"));
    let mut out: BTreeMap<String, Allowed> = BTreeMap::new();
    for row in rows.take_while(|row| row.matches('|').count() == 4) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let words = |cell: &str| {
            let words = cell.split_whitespace().map(|word| word.trim_matches('`').to_owned());
            words.filter(|word| word != "–").collect::<BTreeSet<_>>()
        };
        out.insert(
            cells[1].trim_matches('`').to_owned(),
            Allowed { folders: words(cells[2]), crates: words(cells[3]) },
        );
    }
    let all: BTreeSet<String> = out.keys().cloned().collect();
    for allowed in out.values_mut().filter(|allowed| allowed.folders.contains("all")) {
        allowed.folders = all.clone();
    }
    assert!(out.len() > 10, "the table was not understood");
    out
}

fn dependencies(manifest: &str) -> Vec<String> {
    let (_, rest) = manifest.split_once("[dependencies]\n").unwrap();
    let lines = rest.lines().take_while(|line| !line.starts_with('['));
    lines.filter_map(|line| line.split_once(" =")).map(|(name, _)| name.replace('-', "_")).collect()
}

/// Each file below `src`, with the folder it belongs to; `lib.rs` and `main.rs` see everything.
fn sources(src: &Path) -> Vec<(String, PathBuf)> {
    let mut out = Vec::new();
    let mut open = vec![src.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let inside = path.strip_prefix(src).unwrap();
                let first = inside.components().next().unwrap().as_os_str().to_string_lossy();
                let folder = first.trim_end_matches(".rs").to_owned();
                if folder != "lib" && folder != "main" {
                    out.push((folder, path));
                }
            }
        }
    }
    out.sort();
    out
}

/// The files of the modules that `file` declares for tests alone.
fn modules_for_tests(file: &Path) -> Vec<PathBuf> {
    let text = fs::read_to_string(file).unwrap();
    let after = text.split("#[cfg(test)]\nmod ").skip(1);
    let names = after.filter_map(|rest| rest.lines().next()?.strip_suffix(';'));
    names.map(|name| file.with_file_name(format!("{name}.rs"))).collect()
}

fn without_comments(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    lines.collect::<Vec<_>>().join("\n")
}

/// The folders that follow `crate::`, also in a list in braces.
fn used_folders(text: &str) -> Vec<String> {
    let word = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut out = Vec::new();
    for rest in text.split("crate::").skip(1) {
        let Some(list) = rest.strip_prefix('{') else {
            out.push(word(rest));
            continue;
        };
        let mut depth = 1;
        let mut at_start = true;
        for (at, c) in list.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' => at_start |= depth == 1,
                c if at_start && depth == 1 && c.is_alphanumeric() => {
                    out.push(word(&list[at..]));
                    at_start = false;
                }
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
    }
    out
}

/// Whether a path begins with the crate's name, and no module of that name stands in front of the crate.
fn mentions(text: &str, name: &str) -> bool {
    if text.contains(&format!("mod {name};")) {
        return false;
    }
    let prefix = format!("{name}::");
    let starts = |at: usize| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
    text.match_indices(&prefix).any(|(at, _)| starts(at))
}
