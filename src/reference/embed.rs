//! Whole scenes around the examples of the reference, as small as the registry allows: what proves that they compile.

use crate::schema::{self, Area, Block, Field, Need, Place, Type};

/// The file that every example may name, and what they take from it.
const GIVEN: &str = "let goblet = sphere { radius: 4cm }\n";

/// A scene that holds a block's example.
pub fn scene(block: &Block) -> String {
    // A block without a head is written with the field that it belongs to.
    let written = block.example.strip_prefix(&format!("{}: ", block.kind)).unwrap_or(block.example);
    with_camera(&around(block, written), block)
}

/// A scene that holds a field's example.
pub fn field_scene(block: &Block, field: &Field) -> String {
    with_camera(&around(block, &smallest(block, Some((field, field.example())))), block)
}

/// A scene that holds a value or an item.
pub fn form_scene(place: Place, example: &str) -> String {
    match place {
        Place::Item if example.starts_with("snell") => format!("{example}\n"),
        Place::Item => format!("snell 1\n{example}\n"),
        Place::Value | Place::Operator => {
            // What lenses focus on has to be placed.
            format!("snell 1\nplace sphere {{ radius: 4cm }} as hero\nlet _example = {example}\n")
        }
    }
}

fn with_camera(item: &str, block: &Block) -> String {
    let camera = if block.kind == "camera" || item.contains("camera {") {
        String::new()
    } else {
        smallest(schema::block("camera").expect("declared"), None)
    };
    format!("snell 1\n{camera}\n{GIVEN}{item}\n")
}

/// The item that holds a block: itself, or the block around it.
fn around(block: &Block, written: &str) -> String {
    if matches!(block.area, Area::Item | Area::Shape | Area::Light) && !is_headless(block) {
        return written.to_owned();
    }
    let owners = schema::blocks().filter(|owner| owner.kind != block.kind);
    let takes = |owner: &'static Block| Some((owner, owner.fields().find(|field| field.ty.takes(block))?));
    match owners.filter_map(takes).next() {
        Some((owner, field)) => around(owner, &smallest(owner, Some((field, written)))),
        None => written.to_owned(),
    }
}

/// A block with what it has to have, and one field more.
fn smallest(block: &Block, with: Option<(&Field, &str)>) -> String {
    let mut names: Vec<&str> = Vec::new();
    let mut add = |name: &'static str| {
        if !names.contains(&name) {
            names.push(name);
        }
    };
    for field in block.fields().filter(|field| field.need == Need::Required) {
        add(field.name);
    }
    let wanted = with.map(|(field, _)| field.name);
    for choice in block.choices {
        let taken = choice.ways.iter().find(|way| wanted.is_some_and(|wanted| way.contains(&wanted)));
        let way = taken.or(choice.ways.first().filter(|_| choice.required));
        way.into_iter().flat_map(|way| way.iter()).for_each(|name| add(name));
    }
    wanted.and_then(|wanted| block.field(wanted)).into_iter().for_each(|field| add(field.name));
    let beside: Vec<_> = names.iter().filter_map(|name| block.field(name)?.beside).collect();
    for name in beside.into_iter().filter(|name| !names.contains(name)).collect::<Vec<_>>() {
        names.push(name);
    }
    let field = |name: &&str| {
        let field = block.field(name).expect("a block's own names are declared");
        let value = match (with, field.ty) {
            (Some((with, value)), _) if with.name == *name => value.to_owned(),
            (_, Type::Block(kind)) => smallest(schema::block(kind).expect("types name blocks"), None),
            _ => field.example().to_owned(),
        };
        format!("{name}: {value}")
    };
    let fields: Vec<String> = names.iter().map(field).collect();
    let head = if is_headless(block) { String::new() } else { format!("{} ", block.kind) };
    let target = if block.kind == "place" { "goblet " } else { "" };
    format!("{head}{target}{{ {} }}", fields.join(", "))
}

/// Whether a block is written without its kind, after the name of a field.
fn is_headless(block: &Block) -> bool {
    block.example.starts_with(&format!("{}:", block.kind))
}
