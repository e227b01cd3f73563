//! Items that are not objects.

use super::{Area, Block, Field, Type, field};

/// The units that a bare length may stand for.
const LENGTHS: Type = Type::Choice(&["nm", "um", "mm", "cm", "m", "km", "in", "ft"]);

const UNITS: &[Field] =
    &[field("length", LENGTHS, "What a bare number means where a length is wanted.").or_word("m").like("cm")];

const PLACE: &[Field] = &[
    field("transform", Type::Transform, "Where it is put, applied after its own transform."),
    field("material", Type::Material, "What it is made of, in place of its own material."),
];

pub(super) const BLOCKS: &[Block] = &[
    Block {
        kind: "units",
        area: Area::Item,
        doc: "What bare numbers mean in this file.",
        example: "units { length: cm }",
        own: UNITS,
        choices: &[],
    },
    Block {
        kind: "place",
        area: Area::Item,
        doc: "Puts an object into the scene once more, sharing its memory.",
        example: "place goblet { transform: translate(1m, 0m, 0m) }",
        own: PLACE,
        choices: &[],
    },
];
