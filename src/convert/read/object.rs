//! Groups, shapes and transforms.

use super::shape::Anchor::{Corner, Middle};
use super::{Dialect, Mistake, Reader, vocab};
use crate::convert::fields::{Field, Part};
use crate::convert::model::{Look, Object, Shape, Step};
use crate::convert::parse::{Block, Span};
use crate::math::DVec3;
use std::collections::VecDeque;

/// Objects of dialects that are not read yet.
const UNREAD_OBJECTS: &[&str] = &[
    "Rectangle",
    "XYRectangle",
    "XZRectangle",
    "YZRectangle",
    "Square",
    "Area",
    "Cylinder",
    "Torus",
    "Parametric",
    "MovingSphere",
    "MotionSphere",
    "SphereMoving",
    "MovingObj",
    "TinyObj",
    "Bezier",
    "Grid",
];

impl Reader<'_> {
    /// The objects of a group. `MaterialIndex` changes the reader's state, which outlives the group.
    pub(super) fn group(&mut self, block: Block<'_>) -> Vec<Object> {
        self.log.mapped(&block.head, "objects, in their order");
        let (mut objects, mut counts, mut found) = (Vec::new(), Vec::new(), 0);
        for part in self.log.parts(block.body, vocab::GROUP) {
            match part {
                Part::Field(field) if field.key == "MaterialIndex" => self.set_material(&field),
                Part::Field(field) if field.known => counts.push(field),
                Part::Field(field) => self.log.unknown_field(&field, "Group", vocab::GROUP),
                Part::Block(block) if block.name() == "Material" => self.inline_material(block),
                Part::Block(block) => {
                    found += 1;
                    objects.extend(self.object(block));
                }
            }
        }
        for count in counts {
            self.log.check_counts(&count, found);
        }
        objects
    }

    /// The original admits the index one past the last material; a placeholder stands in for what it reads there.
    fn set_material(&mut self, field: &Field<'_>) {
        if !field.sound {
            self.log.dropped(&field.span, "malformed");
            self.material_index.get_or_insert(self.materials.len()); // the shapes that follow stay silent
            return;
        }
        self.log.mapped(&field.span, "`material` of the objects that follow");
        let (index, count) = (field.number(0).trunc() as i64, self.materials.len());
        let at = field.span.clone().into();
        match usize::try_from(index) {
            Ok(valid) if valid < count => self.material_index = Some(valid),
            Ok(end) if end == count => {
                self.log.notes.note(Mistake::IndexAtCount { index, at });
                self.material_index = Some(end);
            }
            _ => {
                self.log.notes.note(Mistake::IndexOutOfRange { index, count, at });
                self.material_index = Some(count); // so that the shapes that follow do not complain, too
            }
        }
    }

    /// The oldest dialect has no indices: a `Material { .. }` in a group holds for the objects that follow it.
    fn inline_material(&mut self, block: Block<'_>) {
        let material = self.material(block);
        self.material_index = Some(self.materials.len());
        self.materials.push(material);
    }

    fn object(&mut self, block: Block<'_>) -> Option<Object> {
        let span = block.head.clone();
        let name = block.name().to_string();
        let shape = match name.as_str() {
            "Group" => return Some(Object { shape: Shape::Group(self.group(block)), ..plain(span) }),
            "Transform" => return self.transform(block),
            "Sphere" => self.sphere(block)?,
            "Plane" => self.plane(block)?,
            "Triangle" => self.triangle(block)?,
            "Quad" => self.quad(block, ["origin", "u", "v"], Corner)?,
            "Rectangle" if block.after("point").is_some() => self.quad(block, ["point", "x", "y"], Corner)?,
            "Rectangle" if block.after("x_axis").is_some() => {
                self.quad(block, ["position", "x_axis", "y_axis"], Middle)?
            }
            "Disk" => self.disk(block)?,
            "Cube" => self.cuboid(block)?,
            "TriangleMesh" => return self.mesh(block),
            "RevSurface" => self.revolve(block)?,
            "BezierCurve" | "BsplineCurve" => {
                self.not_convertible(&block, "a curve has no surface");
                return None;
            }
            "FogSphere" | "Medium" => {
                self.not_convertible(&block, "there are no participating media");
                return None;
            }
            other if UNREAD_OBJECTS.contains(&other) => {
                self.not_read(&block, "left out, braces and all");
                return None;
            }
            _ => {
                self.log.unknown_block(&block, "in `Group`".into(), vocab::OBJECTS);
                return None;
            }
        };
        let material = self.material_of(&name, &span);
        let mut object = Object { shape, material, ..plain(span) };
        self.note_dark_lamp(&mut object);
        Some(object)
    }

    /// In the dialect of arsenal.txt only spheres that emit red 12 send photons; other lamps merely look bright.
    pub(super) fn note_dark_lamp(&mut self, object: &mut Object) {
        let material = object.material.and_then(|index| self.materials.get(index));
        let Some(Look::Emissive { radiance }) = material.map(|material| &material.look) else { return };
        let is_sphere = matches!(object.shape, Shape::Sphere { .. });
        if self.dialect == Dialect::Arsenal && !(is_sphere && (radiance.x - 12.0).abs() < 0.001) {
            let help = "it sends photons only from spheres whose `emissionColor` is 12 in red";
            self.differs("this lamp looks bright in the original but lights nothing", &object.span, help);
            object.notes.push("The original shows this lamp but sends no light from it.".into());
        }
    }

    /// The material in force; a shape before the first `MaterialIndex` is a mistake.
    pub(super) fn material_of(&mut self, shape: &str, at: &Span) -> Option<usize> {
        if self.material_index.is_none() {
            self.log.notes.note(Mistake::NoMaterial { shape: shape.into(), at: at.clone().into() });
        }
        self.material_index
    }

    fn not_convertible(&mut self, block: &Block<'_>, why: &'static str) {
        self.log.dropped(&block.span, why);
        let what = format!("`{}`", block.name());
        self.log.notes.note(Mistake::NotConvertible { what, why, at: block.head.clone().into() });
    }

    /// `Transform { operations object }`: each operation multiplies on the right, so the last one acts first.
    fn transform(&mut self, block: Block<'_>) -> Option<Object> {
        let span = block.head.clone();
        self.log.mapped(&span, "`transform`");
        let mut factors = VecDeque::new(); // as in a product of matrices, the leftmost acting last
        let mut objects: Vec<(Span, Option<Object>)> = Vec::new();
        for part in self.log.parts(block.body, vocab::TRANSFORM) {
            match part {
                Part::Field(field) if field.known && field.sound => self.operation(&field, &mut factors),
                Part::Field(field) => self.log.unknown_field(&field, "Transform", vocab::TRANSFORM),
                Part::Block(block) => {
                    let head = block.head.clone();
                    if let Some((first, _)) = objects.first() {
                        let (second, first) = (head.clone().into(), first.clone().into());
                        self.log.notes.note(Mistake::CrowdedTransform { second, first });
                    }
                    self.transform_depth += 1;
                    let object = self.object(block);
                    self.transform_depth -= 1;
                    objects.push((head, object));
                }
            }
        }
        let Some((_, object)) = objects.into_iter().next() else {
            self.log.notes.note(Mistake::EmptyTransform { at: span.into() });
            return None;
        };
        let mut object = object?;
        object.steps.extend(factors.into_iter().rev());
        if self.dialect == Dialect::Arsenal {
            self.differs(
                "the original does not show objects inside a `Transform`",
                &span,
                "its intersection with a `Transform` is switched off; delete the object to have the same picture",
            );
            object
                .notes
                .push("The original does not show this object: its `Transform` is switched off.".into());
        }
        Some(object)
    }

    fn operation(&mut self, field: &Field<'_>, factors: &mut VecDeque<Step>) {
        self.log.mapped(&field.span, "a step of `transform`");
        let step = match field.key {
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
        if let Step::Scale(by) = step {
            self.check_scale(by, &field.span);
        }
        match step {
            Step::Rotate(axis, _) if axis == DVec3::ZERO => {
                self.bad_value(
                    "the axis of this rotation is the zero vector",
                    &field.span,
                    "write the axis first",
                );
            }
            Step::Matrix(rows) if rows[12..] != [0.0, 0.0, 0.0, 1.0] => {
                let help = "the fourth row must be 0 0 0 1; `Matrix` lists rows, `Matrix4f` columns";
                self.bad_value("this matrix does not keep straight lines parallel", &field.span, help);
            }
            Step::Matrix(_) => factors.push_front(step), // the two matrix operations multiply on the left
            step => factors.push_back(step),
        }
    }
}

/// An object without transform, material and remarks, whose shape is still to be set.
fn plain(span: Span) -> Object {
    Object { shape: Shape::Group(Vec::new()), material: None, steps: Vec::new(), notes: Vec::new(), span }
}
