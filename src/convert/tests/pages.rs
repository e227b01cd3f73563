//! The pages of the codes: each broken example is what its page is about, and each mended one is not.

use super::*;

/// What cannot be shown in a few lines.
const WITHOUT_EXAMPLES: &[&str] = &["more", "too_deep", "too_large"];

#[test]
fn every_code_has_a_page_whose_examples_hold() {
    let source = include_str!("../mistake.rs");
    let mut names: Vec<&str> =
        source.split("code(snell::convert::").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    names.sort_unstable();
    let pages = std::fs::read_dir(project("docs/codes/convert")).expect("the pages").count();
    assert_eq!(pages, names.len(), "a page for each code, and no other");
    for name in names {
        let page = std::fs::read_to_string(project(&format!("docs/codes/convert/{name}.md")));
        let page = page.unwrap_or_else(|_| panic!("no page for {name}")).replace("\r\n", "\n");
        assert!(page.starts_with(&format!("# snell::convert::{name}\n\n")), "{name}");
        if WITHOUT_EXAMPLES.contains(&name) {
            continue;
        }
        let example = |kind: &str| {
            let (_, rest) = page.split_once(&format!("```text {kind}\n")).unwrap_or_else(|| panic!("{name}"));
            rest.split_once("```").expect("a closing fence").0.to_string()
        };
        let has_code = |kind: &str| {
            let codes = codes(&convert_plainly(&example(kind)));
            codes.iter().any(|code| code.trim_start_matches('!') == name)
        };
        assert!(has_code("broken"), "{name}: the broken example is not broken");
        assert!(!has_code("mended"), "{name}: the mended example is broken");
    }
}
