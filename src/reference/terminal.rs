//! The reference as plain text, wrapped to the width of a terminal.

use super::entry::Entry;
use super::{choices_text, need_text, range_text, stands_in, type_text};
use crate::schema::{self, Area, Block, Field, Form, Function, Place, Topic, Type};
use std::fmt::Write;

/// What there is, area by area.
pub fn overview(width: usize) -> String {
    let mut out = String::new();
    wrapped(&mut out, "The language, area by area. `snell doc WORD` shows more of any of them.", 0, width);
    for area in Area::ALL {
        let blocks = schema::blocks().filter(|block| block.area == area);
        section(&mut out, area.title(), blocks.map(|block| (block.kind.to_owned(), block.doc)), width);
    }
    for (place, title) in [
        (Place::Item, "definitions and other items"),
        (Place::Value, "values"),
        (Place::Operator, "operators, the loosest first"),
    ] {
        let forms = schema::FORMS.iter().filter(|form| form.place == place);
        section(&mut out, title, forms.map(|form| (form.words.join(" "), form.doc)), width);
    }
    for topic in Topic::ALL {
        let functions = schema::functions().filter(|function| function.topic == topic);
        let title = format!("functions: {}", topic.title());
        section(&mut out, &title, functions.map(|function| (signature(function), function.doc)), width);
    }
    section(&mut out, "types", Type::NAMED.iter().map(|ty| (ty.name.to_owned(), ty.doc)), width);
    section(&mut out, "units", schema::UNITS.iter().map(|unit| (unit.name.to_owned(), unit.doc)), width);
    let names: Vec<&str> = schema::COLORS.iter().map(|(name, _)| *name).collect();
    out.push_str("\nnamed colours\n");
    wrapped(&mut out, &names.join(" "), 2, width);
    out
}

/// All about one thing.
pub fn entry(entry: &Entry, width: usize) -> String {
    match entry {
        Entry::Block(block) => block_text(block, width),
        Entry::Function(function) => function_text(function, width),
        Entry::Form(form) => form_text(form, width),
        Entry::Unit(unit) => titled(unit.name, &format!("a unit of {}", type_text(unit.of)), unit.doc, width),
        Entry::Type(ty) => {
            let mut out = titled(ty.name, "a type", ty.doc, width);
            let units: Vec<&str> =
                schema::UNITS.iter().filter(|unit| unit.of == ty.ty).map(|unit| unit.name).collect();
            if !units.is_empty() {
                let _ = writeln!(out, "\n  units: {}", units.join(" "));
            }
            example(&mut out, ty.ty.example());
            out
        }
        Entry::Color(name, code) => {
            titled(name, "a colour", &format!("The display value #{code:06x}, as CSS has it."), width)
        }
        Entry::Field(places) => field_text(places, width),
    }
}

fn block_text(block: &Block, width: usize) -> String {
    let mut out = titled(block.kind, block.area.noun(), block.doc, width);
    for sentence in choices_text(block) {
        wrapped(&mut out, &sentence, 2, width);
    }
    let places = stands_in(block);
    if !places.is_empty() && block.area != Area::Shape {
        wrapped(&mut out, &format!("It stands in {}.", places.join(", ")), 2, width);
    }
    example(&mut out, block.example);
    if block.holds_items() {
        wrapped(&mut out, "\nItems may stand in it beside its fields.", 2, width);
    }
    out.push_str("\nfields\n");
    for field in block.fields() {
        fields_line(&mut out, field.name, field, width);
    }
    out
}

/// A field: its name, what may stand there, what it is and an example.
fn fields_line(out: &mut String, name: &str, field: &Field, width: usize) {
    let beside = field.beside.map(|name| format!("needs `{name}` beside it")).unwrap_or_default();
    let facts = [type_text(field.ty), range_text(field), need_text(field), beside];
    let facts: Vec<String> = facts.into_iter().filter(|fact| !fact.is_empty()).collect();
    let line = format!("  {name:<12} {}", facts.join("; "));
    if line.chars().count() <= width {
        let _ = writeln!(out, "{line}");
    } else {
        let _ = writeln!(out, "  {name}");
        wrapped(out, &facts.join("; "), 6, width);
    }
    wrapped(out, field.doc, 6, width);
    let _ = writeln!(out, "      {}: {}", field.name, field.example());
}

fn field_text(places: &[(&Block, &Field)], width: usize) -> String {
    let name = places[0].1.name;
    let mut out = format!("{name}: a field of these blocks\n\n");
    for (block, field) in places {
        fields_line(&mut out, &format!("of `{}`", block.kind), field, width);
    }
    out
}

fn function_text(function: &Function, width: usize) -> String {
    let kind = format!("a function that gives {}", function.result);
    let mut out = titled(&signature(function), &kind, function.doc, width);
    for arg in function.forms.iter().copied().flatten() {
        let _ = writeln!(out, "  {:<12} {}", arg.name, arg.takes.noun());
    }
    if let Some(domain) = function.domain {
        wrapped(&mut out, &format!("It is for {domain}."), 2, width);
    }
    if let Some(method) = function.method {
        out.push('\n');
        wrapped(&mut out, &format!("How it is computed: {method}."), 2, width);
    }
    example(&mut out, function.example);
    out
}

fn form_text(form: &Form, width: usize) -> String {
    let kind = match form.place {
        Place::Item => "an item",
        Place::Value => "a value",
        Place::Operator => "an operator",
    };
    let mut out = titled(&form.words.join(" "), kind, form.doc, width);
    example(&mut out, form.example);
    out
}

/// A function as it is called, in each of its forms.
pub(super) fn signature(function: &Function) -> String {
    let forms: Vec<String> = function.forms.iter().map(|form| function.signature(form)).collect();
    forms.join(" or ")
}

/// A heading and a sentence.
fn titled(name: &str, kind: &str, doc: &str, width: usize) -> String {
    let mut out = format!("{name}: {kind}\n\n");
    wrapped(&mut out, doc, 2, width);
    out
}

fn example(out: &mut String, text: &str) {
    out.push('\n');
    for line in text.lines() {
        let _ = writeln!(out, "      {line}");
    }
}

/// A heading, and a line or more for each name.
fn section(out: &mut String, title: &str, lines: impl Iterator<Item = (String, &'static str)>, width: usize) {
    /// Names longer than this have their sentence on the next line.
    const COLUMN: usize = 18;
    let _ = writeln!(out, "\n{title}");
    for (name, doc) in lines {
        let mut text = String::new();
        wrapped(&mut text, doc, COLUMN + 2, width);
        if name.chars().count() < COLUMN {
            let _ = write!(out, "  {name:<COLUMN$}{}", text.trim_start());
        } else {
            let _ = write!(out, "  {name}\n{text}");
        }
    }
}

/// Appends a paragraph, each line indented and no longer than `width` where its words allow.
pub(super) fn wrapped(out: &mut String, text: &str, indent: usize, width: usize) {
    let mut column = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > width {
            out.push('\n');
            column = 0;
        }
        if column == 0 {
            out.extend(std::iter::repeat_n(' ', indent));
            column = indent;
        } else {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += length;
    }
    out.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_keep_to_the_width() {
        for width in [60, 80] {
            let docs = super::super::names().into_iter().flat_map(super::super::lookup);
            let texts = docs.map(|found| entry(&found, width)).chain([overview(width)]);
            let prose = |line: &str| !line.starts_with("      ") && !line.contains(": a function");
            for text in texts {
                for line in text.lines().filter(|line| prose(line)) {
                    assert!(line.chars().count() <= width, "{width}: {line}");
                }
            }
        }
    }
}
