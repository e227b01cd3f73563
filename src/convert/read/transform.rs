//! `Transform { operations object }`.

use super::{Dialect, Mistake, Reader};
use crate::convert::fields::{Field, Part};
use crate::convert::model::{Object, Shape, Step};
use crate::convert::parse::{Block, Span};
use crate::convert::step::flatten;
use crate::convert::words::TRANSFORM;
use crate::math::DVec3;
use std::collections::VecDeque;

impl Reader<'_> {
    /// Each operation multiplies on the right, so the last one acts first.
    pub(super) fn transform(&mut self, block: Block<'_>) -> Option<Object> {
        let span = block.head.clone();
        self.log.mapped(&span, "`transform`");
        let mut factors = VecDeque::new(); // as in a product of matrices, the leftmost acting last
        let mut heads: Vec<Span> = Vec::new();
        let mut objects = Vec::new();
        let mut velocity = None;
        for part in self.log.parts(block.body, &TRANSFORM) {
            match part {
                Part::Field(field) if field.role == "MaterialIndex" => self.set_material(&field),
                Part::Field(field) if field.role == "velocity" && field.sound => {
                    self.log.approximated(&field.span, "stands still half way through its motion");
                    velocity = Some(field);
                }
                Part::Field(field) if !field.role.is_empty() && field.sound => {
                    self.operation(&field, &mut factors);
                }
                Part::Field(field) => self.log.unknown_field(&field, "Transform", &TRANSFORM),
                Part::Block(block) if block.name().contains("Material") => self.inline_material(block),
                Part::Block(block) => {
                    heads.push(block.head.clone());
                    self.transform_depth += 1;
                    objects.extend(self.object(block));
                    self.transform_depth -= 1;
                }
            }
        }
        self.check_crowd(&heads, &span);
        if objects.is_empty() {
            return None;
        }
        let mut object = match objects.len() {
            1 => objects.remove(0),
            _ => Object::new(Shape::Group(objects), span.clone()),
        };
        object.steps.extend(factors.into_iter().rev());
        if let Some(field) = velocity {
            self.still(&mut object, 0.5 * field.vector(), &field.span);
        }
        self.check_volume(&object, &span)?;
        self.note_switched_off(&mut object, &span);
        Some(object)
    }

    /// Exactly one object is transformed; several are taken together.
    fn check_crowd(&mut self, heads: &[Span], span: &Span) {
        match heads {
            [] => self.log.notes.note(Mistake::EmptyTransform { at: span.clone().into() }),
            [_] => {}
            [first, others @ ..] => {
                for second in others {
                    let (second, first) = (second.clone().into(), first.clone().into());
                    self.log.notes.note(Mistake::CrowdedTransform { second, first });
                }
            }
        }
    }

    /// An object that is flattened to nothing cannot be shown.
    fn check_volume(&mut self, object: &Object, span: &Span) -> Option<()> {
        if !flatten(&object.steps) {
            return Some(());
        }
        let help = "the object was left out; write factors other than 0";
        self.log.bad_value("this transform flattens the object", span, help);
        None
    }

    /// The renderer of arsenal.txt has its transforms switched off.
    fn note_switched_off(&mut self, object: &mut Object, span: &Span) {
        if self.dialect != Dialect::Arsenal {
            return;
        }
        self.log.differs(
            "the original does not show objects inside a `Transform`",
            span,
            "its intersection with a `Transform` is switched off; delete the object to have the same picture",
        );
        let note = "The original does not show this object: its `Transform` is switched off.";
        object.notes.push(note.into());
    }

    fn operation(&mut self, field: &Field<'_>, factors: &mut VecDeque<Step>) {
        self.log.mapped(&field.span, "a step of `transform`");
        let step = match field.role {
            "Translate" => Step::Translate(field.vector()),
            "Scale" => Step::Scale(field.vector()),
            "UniformScale" => Step::Scale(DVec3::splat(field.number(0))),
            "XRotate" => Step::RotateAxis(0, field.number(0)),
            "YRotate" => Step::RotateAxis(1, field.number(0)),
            "ZRotate" => Step::RotateAxis(2, field.number(0)),
            "Rotate" => Step::Rotate(field.vector(), field.number(3)),
            "Matrix" => Step::Matrix(std::array::from_fn(|i| field.number(i))),
            // Columns in the file, rows here.
            _ => Step::Matrix(std::array::from_fn(|i| field.number(i % 4 * 4 + i / 4))),
        };
        match step {
            Step::Rotate(axis, _) if axis == DVec3::ZERO => {
                self.log.dropped(&field.span, "a rotation without an axis");
                let help = "it was left out; write the axis first";
                self.log.bad_value("the axis of this rotation is the zero vector", &field.span, help);
            }
            Step::Matrix(rows) if rows[12..] != [0.0, 0.0, 0.0, 1.0] => {
                self.log.dropped(&field.span, "a matrix that does not keep straight lines parallel");
                let help = "it was left out: the fourth row must be 0 0 0 1; `Matrix` lists rows, `Matrix4f` columns";
                self.log.bad_value("this matrix does not keep straight lines parallel", &field.span, help);
            }
            Step::Matrix(_) => factors.push_front(step), // the two matrix operations multiply on the left
            step => factors.push_back(step),
        }
    }
}
