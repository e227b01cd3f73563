//! What a scene defines, for whoever renders or imports it.

use super::terminal::wrapped;
use crate::resolve::{Offer, Offered};
use crate::source::{SourceMap, Span};
use std::fmt::Write;

/// The definitions of a scene, kind by kind, with the comments above them.
pub fn offers(offers: &[Offer], sources: &SourceMap, width: usize) -> String {
    let mut out = String::new();
    type IsOfKind = fn(&Offered) -> bool;
    let sections: [(&str, IsOfKind); 5] = [
        ("parameters, for `--set NAME=VALUE`", |what| matches!(what, Offered::Param { .. })),
        ("cameras, for `--camera NAME`", |what| matches!(what, Offered::Camera)),
        ("functions", |what| matches!(what, Offered::Function(_))),
        ("values", |what| matches!(what, Offered::Value(_))),
        ("imports", |what| matches!(what, Offered::Import(_))),
    ];
    for (title, is_of_kind) in sections {
        let mut found = offers.iter().filter(|offer| is_of_kind(&offer.what)).peekable();
        if found.peek().is_none() {
            continue;
        }
        let _ = writeln!(out, "{}{title}", if out.is_empty() { "" } else { "\n" });
        for offer in found {
            let _ = writeln!(out, "  {}", line(offer, sources));
            if let Some(doc) = &offer.doc {
                wrapped(&mut out, doc, 6, width);
            }
        }
    }
    if out.is_empty() { "the scene defines nothing\n".to_owned() } else { out }
}

/// A definition on one line.
fn line(offer: &Offer, sources: &SourceMap) -> String {
    let name = &offer.name.value;
    match &offer.what {
        Offered::Param { ty, default, range } => {
            let range = range.map(|range| format!(" in {}", on_one_line(sources, range)));
            format!("{name}: {ty} = {}{}", on_one_line(sources, *default), range.unwrap_or_default())
        }
        Offered::Function(head) => on_one_line(sources, *head),
        Offered::Value(noun) => format!("{name}: {noun}"),
        Offered::Import(path) => format!("{name}: `{path}`"),
        Offered::Camera => name.clone(),
    }
}

fn on_one_line(sources: &SourceMap, span: Span) -> String {
    sources.text(span).split_whitespace().collect::<Vec<_>>().join(" ")
}
