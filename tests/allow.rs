//! What scenes silence, and what is said when they silence what they should not.

use crate::explain::Example;
use snell::diag::{Problems, Style};
use snell::explain::{Level, Page, pages};
use snell::source::{Disk, SourceMap};
use std::path::Path;

/// The report of `snell check`.
fn check(path: &Path) -> String {
    let text = std::fs::read_to_string(path).expect("a scene of a test can be read");
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add(path.display().to_string(), path.to_path_buf(), text.into());
    let main = main.expect("a scene of a test is small");
    let files = Disk::new(path, Vec::new(), false);
    let checked = snell::compile(&mut sources, &files, main, &[], &mut problems);
    let loaded = checked
        .as_ref()
        .and_then(|checked| snell::load::load(checked, &sources, &files, &mut problems))
        .filter(|_| !problems.has_errors());
    if let Some(loaded) = loaded {
        let plan = snell::plan::plan(&loaded, loaded.scene.cameras.first(), None);
        snell::plan::warn(&plan, &loaded, &mut problems);
        snell::allow::doubt_idle(&sources, &mut problems);
    }
    problems.into_report(&sources).render_human(&Style::default())
}

#[test]
fn what_is_silenced_wrongly_is_reported_so() {
    for name in ["idle", "not_a_warning", "silenced", "unknown_code"] {
        let scene = Path::new("tests/diagnostics/allow").join(name).with_extension("snell");
        let (said, expected) = (check(&scene), scene.with_extension("txt"));
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(&expected, said).expect("an expectation can be written");
        } else {
            let expected = std::fs::read_to_string(expected).unwrap_or_default();
            assert_eq!(said, expected, "{}", scene.display());
        }
    }
    let silenced = std::fs::read_to_string("tests/diagnostics/allow/silenced.txt");
    assert_eq!(silenced.expect("it was written"), "");
}

/// Whichever phase gives a warning: an `allow` before the item that it is about silences it, by any end of its code.
#[test]
fn every_warning_can_be_silenced() {
    let warnings = pages().iter().filter(|page| page.level == Level::Warning);
    // An idle `allow` has no item of its own, and what is converted has no `allow`.
    let has_item = |page: &&Page| page.code != "snell::allow::idle" && page.phase() != "convert";
    for page in warnings.filter(has_item) {
        for code in [page.code, &page.code["snell::".len()..], page.name()] {
            let mut example = Example::of(page, "broken");
            let at = example.first_item(page);
            example.text.insert_str(at, &format!("allow({code}, \"a test\")\n"));
            let (codes, report) = example.run(page);
            assert!(codes.is_empty(), "{report}");
        }
    }
}
