//! The reference of the language, made from the registry: as text for a terminal, and as the pages in `docs`.

mod embed;
mod entry;
mod markdown;
mod scene;
mod terminal;

pub use embed::{field_scene, form_scene, scene};
pub use entry::{Entry, lookup, names};
pub use markdown::markdown;
pub use scene::offers;
pub use terminal::{entry, overview};

use crate::schema::{Block, Field, Need, Type};

/// What may stand in a field, with the unit in which it is usually written: "length (m)".
fn type_text(ty: Type) -> String {
    match ty {
        Type::Choice(words) => crate::schema::quoted(words),
        Type::Block(kind) => format!("block `{kind}`"),
        _ => {
            let noun = ty.noun();
            let plain = ["a ", "an "].into_iter().find_map(|article| noun.strip_prefix(article));
            let unit = match ty.usual_unit() {
                "" => String::new(),
                unit => format!(" ({unit})"),
            };
            format!("{}{unit}", plain.unwrap_or(&noun).replace(" or a ", " or ").replace(", a ", ", "))
        }
    }
}

/// "default 1m", "required", or nothing.
fn need_text(field: &Field) -> String {
    match (field.need, field.default_text()) {
        (Need::Required, _) => "required".to_owned(),
        (_, Some(default)) => format!("default {default}"),
        _ => String::new(),
    }
}

/// "greater than 0m", or nothing.
fn range_text(field: &Field) -> String {
    field.range.map(|range| range.describe(field.ty)).unwrap_or_default()
}

/// What a block says about fields that exclude one another, a sentence each.
fn choices_text(block: &Block) -> Vec<String> {
    let way = |way: &&[&str]| way.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" with ");
    let sentence = |choice: &crate::schema::Choice| {
        let ways: Vec<String> = choice.ways.iter().map(way).collect();
        let (last, rest) = ways.split_last().expect("a choice has ways");
        let how_many = if choice.required { "One of" } else { "At most one of" };
        format!("{how_many} {} and {last}.", rest.join(", "))
    };
    block.choices.iter().map(sentence).collect()
}

/// Where a block stands that is no item: the fields that take it.
fn stands_in(block: &Block) -> Vec<String> {
    let owners = crate::schema::blocks().flat_map(|owner| {
        // What every object has is said of objects, not of each.
        let fields = owner.fields().filter(|field| field.ty.takes(block));
        fields.map(move |field| (owner, field.name))
    });
    let mut all: Vec<String> = Vec::new();
    for (owner, field) in owners {
        let place = match (owner.area, field) {
            (crate::schema::Area::Shape, "material") => "`material` of every object".to_owned(),
            _ => format!("`{field}` of `{}`", owner.kind),
        };
        if !all.contains(&place) {
            all.push(place);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema;

    #[test]
    fn types_are_said_with_their_units() {
        let of = |block, field| schema::block(block).and_then(|b| b.field(field)).map(|f| type_text(f.ty));
        assert_eq!(of("sphere", "radius").as_deref(), Some("length (m)"));
        assert_eq!(of("mesh", "missing").as_deref(), Some("`error` or `skip`"));
        assert_eq!(of("camera", "film").as_deref(), Some("block `film`"));
    }

    #[test]
    fn what_is_no_item_stands_somewhere() {
        for block in schema::blocks().filter(|block| {
            use schema::Area::{Camera, Material, Render, Texture};
            matches!(block.area, Camera | Material | Render | Texture) && block.kind != "render"
        }) {
            assert!(!stands_in(block).is_empty() || block.kind == "film", "`{}`", block.kind);
        }
    }
}
