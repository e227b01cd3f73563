//! Whole files: ours with what is expected of them, and real ones where they are at hand.

use super::*;

/// Compares with an expected file, or writes it when `UPDATE` is set.
fn assert_expected(path: &Path, actual: &str) {
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, actual).expect("the folder of expected files can be written");
        return;
    }
    let expected = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert_eq!(actual, expected, "{} differs; UPDATE=1 writes it", path.display());
}

#[test]
fn scenes_convert_to_what_is_expected() {
    let scenes = scenes_below(&project("tests/convert"));
    assert!(!scenes.is_empty());
    for path in scenes {
        let text = std::fs::read_to_string(&path).expect("a scene");
        let name = path.file_name().and_then(|name| name.to_str()).expect("a plain name");
        let conversion = convert(&text, name, &Options::default(), Some(&Shelf));
        assert_accounted(&text, &conversion, name);
        for (index, scene) in conversion.scenes.iter().enumerate() {
            let doubts = assert_compiles(&scene.snell, name);
            // One has a quad of glass, as files of that family do: that is doubted, and nothing else.
            let is_quad =
                |doubt: &String| name == "kinds.txt" && doubt.starts_with("snell::check::lone_glass:");
            assert!(
                doubts.iter().all(is_quad) || ["doubts.txt", "mistakes.txt"].contains(&name),
                "{name}: {doubts:?}"
            );
            let ending = if index == 0 { "snell".into() } else { format!("{}.snell", index + 1) };
            assert_expected(&path.with_extension(ending), &scene.snell);
        }
        assert_expected(&path.with_extension("report"), &account(&conversion, name, &text));
    }
}

/// Real files of many programs, where they are at hand. Nothing in them passes without a word, and what becomes of them
/// is a scene.
#[test]
fn real_scenes_convert() {
    let scenes = scenes_below(&project("../shared/corpus"));
    if scenes.is_empty() {
        println!("skipped: no corpus beside the project");
    }
    for path in scenes {
        let text = std::fs::read_to_string(&path).expect("a scene");
        let finder = DiskFinder::new(&path, Vec::new());
        let conversion = convert(&text, "corpus.txt", &Options::default(), Some(&finder));
        let name = path.display().to_string();
        assert_accounted(&text, &conversion, &name);
        assert!(!conversion.scenes.is_empty(), "{name}: {:?}", codes(&conversion));
        for scene in &conversion.scenes {
            assert_compiles(&scene.snell, &name);
        }
    }
}

/// The malformed ones among them are diagnosed where they are malformed.
#[test]
fn malformed_scenes_are_diagnosed_at_the_right_token() {
    let cases = [
        ("hzt1__scene01_basic.txt", "count_mismatch", "numObjects 6"),
        ("yao-jz__scene06_bunny_1k.txt", "stray_token", "qwefqwef"),
        ("liuydd__mov.txt", "missing_number", "refr"),
        ("lst627__test_wine_bottle.txt", "several_scenes", "PerspectiveCamera {"),
    ];
    for (file, code, token) in cases {
        let Ok(text) = std::fs::read_to_string(project("../shared/corpus/arsenal").join(file)) else {
            println!("skipped: {file} is not beside the project");
            continue;
        };
        let conversion = convert(&text, file, &Options::default(), None);
        let wanted = format!("snell::convert::{code}");
        let problem = conversion.problems.iter().find(|problem| {
            use miette::Diagnostic;
            problem.code().is_some_and(|code| code.to_string() == wanted)
        });
        let problem = problem.unwrap_or_else(|| panic!("{file}: no {code} in {:?}", codes(&conversion)));
        let label = miette::Diagnostic::labels(problem).and_then(|mut labels| labels.next());
        let label = label.expect("a place");
        assert_eq!(&text[label.offset()..label.offset() + label.len()], token, "{file}");
        assert!(!problem.is_error() && !conversion.scenes.is_empty(), "{file}");
    }
}
