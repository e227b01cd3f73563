//! Shapes but for planes and surfaces of revolution.

use super::{Reader, vocab};
use crate::convert::fields::Field;
use crate::convert::model::{Asset, Object, Shape, Step};
use crate::convert::parse::{Block, Span};
use crate::math::DVec3;

/// What the point of a rectangle is, and so what its two vectors are.
#[derive(Clone, Copy)]
pub enum Anchor {
    /// A corner; the vectors are its edges.
    Corner,
    /// The middle; the vectors are half its edges.
    Middle,
}

impl Reader<'_> {
    /// A rectangle, or a parallelogram, by a point and two vectors.
    pub(super) fn quad(
        &mut self,
        block: Block<'_>,
        keys: [&'static str; 3],
        anchor: Anchor,
    ) -> Option<Shape> {
        let mut fields = self.log.fields(block, vocab::QUAD);
        self.log.mapped(&fields.head, "`quad`");
        let tos = match anchor {
            Anchor::Corner => ["`origin`", "`edge_u`", "`edge_v`"],
            Anchor::Middle => ["the middle of the `quad`", "half of `edge_u`", "half of `edge_v`"],
        };
        let [point, u, v] = [0, 1, 2].map(|i| self.log.need_vector(&mut fields, keys[i], tos[i]));
        let head = fields.head.clone();
        self.log.finish(fields);
        let (point, u, v) = (point?, u?, v?);
        if u.cross(v) == DVec3::ZERO {
            self.bad_value(
                "the edges of this rectangle are parallel",
                &head,
                "write two directions that differ",
            );
            return None;
        }
        Some(match anchor {
            Anchor::Corner => Shape::Quad { origin: point, edge_u: u, edge_v: v },
            Anchor::Middle => Shape::Quad { origin: point - u - v, edge_u: 2.0 * u, edge_v: 2.0 * v },
        })
    }

    pub(super) fn disk(&mut self, block: Block<'_>) -> Option<Shape> {
        let mut fields = self.log.fields(block, vocab::DISK);
        self.log.mapped(&fields.head, "`disk`");
        let center = self.log.need_vector(&mut fields, "center", "`center`");
        let normal = self.log.need_vector(&mut fields, "normal", "`normal`");
        let radius = self.positive(&mut fields, "radius", "`radius`");
        let head = fields.head.clone();
        self.log.finish(fields);
        let normal = normal?;
        if normal == DVec3::ZERO {
            self.bad_value("the normal of this disk is the zero vector", &head, "write where it faces");
            return None;
        }
        Some(Shape::Disk { center: center?, normal, radius: radius? })
    }

    pub(super) fn cuboid(&mut self, block: Block<'_>) -> Option<Shape> {
        let mut fields = self.log.fields(block, vocab::CUBE);
        self.log.mapped(&fields.head, "`box`");
        let min = self.log.need_vector(&mut fields, "min_p", "`min`");
        let max = self.log.need_vector(&mut fields, "max_p", "`max`");
        let head = fields.head.clone();
        self.log.finish(fields);
        let (min, max) = (min?, max?);
        if (max - min).to_array().contains(&0.0) {
            self.bad_value("this cube has no volume", &head, "write corners that differ in every coordinate");
            return None;
        }
        Some(Shape::Cuboid { min: min.min(max), max: max.max(min) })
    }

    pub(super) fn sphere(&mut self, block: Block<'_>) -> Option<Shape> {
        let mut fields = self.log.fields(block, vocab::SPHERE);
        self.log.mapped(&fields.head, "`sphere`");
        let center = self.log.need_vector(&mut fields, "center", "`center`");
        let radius = self.positive(&mut fields, "radius", "`radius`");
        if let Some(velocity) = self.log.take(&mut fields, "velocity") {
            self.log.dropped(&velocity.span, "motion is not read yet");
            self.note_not_read("`velocity`".into(), &velocity.span, "left out");
        }
        self.log.finish(fields);
        Some(Shape::Sphere { center: center?, radius: radius? })
    }

    pub(super) fn triangle(&mut self, block: Block<'_>) -> Option<Shape> {
        let mut fields = self.log.fields(block, vocab::TRIANGLE);
        self.log.mapped(&fields.head, "`triangle`");
        let corners = [("vertex0", "`a`"), ("vertex1", "`b`"), ("vertex2", "`c`")]
            .map(|(key, to)| self.log.need_vector(&mut fields, key, to));
        self.log.finish(fields);
        let [a, b, c] = corners;
        Some(Shape::Triangle { corners: [a?, b?, c?] })
    }

    /// A mesh and, in the dialect of arsenal.txt, its placement: `v scale + offset`, and z mirrored by `Y_inverse`.
    pub(super) fn mesh(&mut self, block: Block<'_>) -> Option<Object> {
        let span = block.head.clone();
        let mut fields = self.log.fields(block, vocab::MESH);
        self.log.mapped(&fields.head, "`mesh`");
        let file = self.log.need(&mut fields, "obj_file");
        let scale = self.log.take(&mut fields, "scale");
        let offset = self.log.vector(&mut fields, "offset", "`translate`").unwrap_or_default();
        let mirrored = self.log.take(&mut fields, "Y_inverse");
        self.log.finish(fields);
        let material = self.material_of("TriangleMesh", &span);

        let factor = scale.as_ref().map_or(1.0, |field| field.number(0));
        if let Some(scale) = &scale {
            self.log.mapped(&scale.span, "`scale`");
            self.check_scale(DVec3::splat(factor), &scale.span);
        }
        let mut notes = Vec::new();
        if let Some(flag) = &mirrored {
            self.log.mapped(&flag.span, "a mirrored z axis, which is what it does in spite of its name");
            notes.push("`Y_inverse` mirrors z in the original, not y.".into());
        }
        let sign = if mirrored.is_some() { -1.0 } else { 1.0 };
        let mut steps = vec![Step::Scale(DVec3::new(factor, factor, sign * factor)), Step::Translate(offset)];
        steps.retain(|step| !step.is_identity());
        let file = self.obj_file(&file?)?;
        let mut object = Object { shape: Shape::Mesh { file }, material, steps, notes, span };
        self.note_dark_lamp(&mut object);
        Some(object)
    }

    fn obj_file(&mut self, field: &Field<'_>) -> Option<Asset> {
        let word = field.word.as_ref()?;
        self.log.mapped(&field.span, "`file`");
        if !word.text.ends_with(".obj") {
            let help = "the original refuses it; the renderer goes by the file's own format";
            self.differs("a mesh file that does not end in `.obj`", &word.span, help);
        }
        Some(self.asset(word))
    }

    pub(super) fn check_scale(&mut self, factors: DVec3, at: &Span) {
        if factors.to_array().contains(&0.0) {
            self.bad_value("a scale of 0 flattens the object", at, "write a factor other than 0");
        }
    }
}

impl Step {
    /// Whether the step leaves everything where it is.
    fn is_identity(&self) -> bool {
        match self {
            Self::Scale(by) => *by == DVec3::ONE,
            Self::Translate(by) => *by == DVec3::ZERO,
            _ => false,
        }
    }
}
