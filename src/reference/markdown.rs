//! The reference as one page of Markdown: `docs/reference.md`.

use super::terminal::signature;
use super::{choices_text, need_text, range_text, stands_in, type_text};
use crate::schema::{self, Area, Block, Field, Place, Topic, Type};
use std::fmt::Write;

/// The whole page.
pub fn markdown() -> String {
    let mut out = String::from(
        "# Reference of the scene language, version 1\n\n\
         Made by `snell doc --markdown` from the registry that the compiler reads; every example in it is compiled by a\n\
         test. Examples that name `goblet` take it as any object.\n",
    );
    for area in Area::ALL {
        let _ = writeln!(out, "\n## {}", capitalised(area.title()));
        for block in schema::blocks().filter(|block| block.area == area) {
            block_section(&mut out, block);
        }
    }
    forms(&mut out);
    functions(&mut out);
    types_and_units(&mut out);
    colors(&mut out);
    out
}

fn block_section(out: &mut String, block: &Block) {
    let _ = writeln!(out, "\n### {}\n\n{}", block.kind, block.doc);
    for sentence in choices_text(block) {
        let _ = writeln!(out, "{sentence}");
    }
    let places = stands_in(block);
    if !places.is_empty() && block.area != Area::Shape {
        let _ = writeln!(out, "It stands in {}.", places.join(", "));
    }
    let _ = writeln!(out, "\n```snell\n{}\n```", block.example);
    out.push_str("\n| field | type | range | default | | example |\n|---|---|---|---|---|---|\n");
    block.fields().for_each(|field| field_row(out, field));
}

fn field_row(out: &mut String, field: &Field) {
    let need = need_text(field);
    let default = need.strip_prefix("default ").map(code).unwrap_or(need.clone());
    let beside = field.beside.map(|name| format!(" Needs `{name}` beside it.")).unwrap_or_default();
    row(
        out,
        &[
            &code(field.name),
            &type_text(field.ty),
            &range_text(field),
            &default,
            &format!("{}{beside}", field.doc),
            &code(field.example()),
        ],
    );
}

fn forms(out: &mut String) {
    for (place, title) in [
        (Place::Item, "Definitions and other items"),
        (Place::Value, "Values"),
        (Place::Operator, "Operators, the loosest first"),
    ] {
        let _ = writeln!(out, "\n## {title}\n\n| | | example |\n|---|---|---|");
        for form in schema::FORMS.iter().filter(|form| form.place == place) {
            let words: Vec<String> = form.words.iter().map(|word| code(word)).collect();
            let lines: Vec<String> = form.example.lines().map(code).collect();
            row(out, &[&words.join(" "), form.doc, &lines.join("<br>")]);
        }
    }
}

fn functions(out: &mut String) {
    out.push_str("\n## Functions\n");
    for topic in Topic::ALL {
        let _ =
            writeln!(out, "\n### Of {}\n\n| call | gives | | example |\n|---|---|---|---|", topic.title());
        for function in schema::functions().filter(|function| function.topic == topic) {
            let method = function.method.map(|method| format!(" Computed as {method}.")).unwrap_or_default();
            let domain = function.domain.map(|domain| format!(" It is for {domain}.")).unwrap_or_default();
            let doc = format!("{}{domain}{method}", function.doc);
            row(out, &[&code(&signature(function)), function.result, &doc, &code(function.example)]);
        }
    }
}

fn types_and_units(out: &mut String) {
    out.push_str("\n## Types\n\nWhat a `param` and the arguments of a `fn` may be.\n");
    out.push_str("\n| type | | example |\n|---|---|---|\n");
    for ty in Type::NAMED {
        row(out, &[&code(ty.name), ty.doc, &code(ty.ty.example())]);
    }
    out.push_str("\n## Units\n\n| unit | of | |\n|---|---|---|\n");
    for unit in schema::UNITS {
        row(out, &[&code(unit.name), &type_text(unit.of), unit.doc]);
    }
}

fn colors(out: &mut String) {
    out.push_str("\n## Named colours\n\nThose of CSS, as display values.\n\n");
    for (name, code) in schema::COLORS {
        let _ = writeln!(out, "- `{name}` `#{code:06x}`");
    }
}

fn row(out: &mut String, cells: &[&str]) {
    let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
    let _ = writeln!(out, "| {} |", cells.join(" | "));
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|first| first.to_uppercase().collect::<String>() + chars.as_str()).unwrap_or_default()
}
