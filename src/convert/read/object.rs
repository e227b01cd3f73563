//! Groups, shapes and transforms.

use super::{Dialect, Mistake, Reader, vocab};
use crate::convert::fields::{Field, Fields, Part};
use crate::convert::model::{Asset, Curve, Look, Object, PlanePicture, Profile, Shape, Step};
use crate::convert::parse::{Block, List, Node, Span};
use crate::math::DVec3;

/// Normals within this distance of unit length count as unit vectors.
const UNIT_TOLERANCE: f64 = 1e-3;

/// Objects of dialects that are not read yet.
const UNREAD_OBJECTS: &[&str] = &[
    "Rectangle",
    "XYRectangle",
    "XZRectangle",
    "YZRectangle",
    "Quad",
    "Square",
    "Area",
    "Disk",
    "Cube",
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
        self.log.mapped(&field.span, "`material` of the objects that follow");
        if !field.sound {
            return;
        }
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
    fn note_dark_lamp(&mut self, object: &mut Object) {
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
    fn material_of(&mut self, shape: &str, at: &Span) -> Option<usize> {
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

    fn sphere(&mut self, block: Block<'_>) -> Option<Shape> {
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

    /// `normal . p = offset`, with the normal as long as it was written.
    fn plane(&mut self, block: Block<'_>) -> Option<Shape> {
        let (span, head) = (block.span.clone(), block.head.clone());
        let mut fields = self.log.fields(block, vocab::PLANE);
        self.log.mapped(&fields.head, "`plane`");
        let normal = self.log.need(&mut fields, "normal");
        let offset = self.log.need_number(&mut fields, "offset", "offset of the plane");
        let picture = self.plane_picture(&mut fields);
        self.log.finish(fields);

        let normal = normal?;
        let length = normal.vector().length();
        self.log.mapped(&normal.span, "`normal`");
        if length == 0.0 {
            self.bad_value(
                "the normal of this plane is the zero vector",
                &normal.span,
                "write the plane's normal",
            );
            return None;
        }
        if (length - 1.0).abs() > UNIT_TOLERANCE {
            let length = (length * 1e4).round() / 1e4;
            self.log.notes.note(Mistake::NormalNotUnit { length, at: normal.span.clone().into() });
        }
        let (normal, offset) = (normal.vector() / length, offset? / length);
        if self.is_seen_through(normal, offset) {
            self.log.drop_all(&span, "the camera is behind it, where this dialect's planes cannot be seen");
            let what = "a plane between the camera and the scene".into();
            let why = "programs of this dialect see through a plane from behind";
            self.log.notes.note(Mistake::NotConvertible { what, why, at: head.into() });
            return None;
        }
        Some(Shape::Plane { normal, offset, picture })
    }

    /// Planes of the dialect of weights have one side, and its cameras like to stand behind the front wall.
    fn is_seen_through(&self, normal: DVec3, offset: f64) -> bool {
        let is_behind = |camera: DVec3| normal.dot(camera) < offset;
        self.dialect == Dialect::Weights
            && self.transform_depth == 0
            && self.camera_center.is_some_and(is_behind)
    }

    fn plane_picture(&mut self, fields: &mut Fields<'_>) -> Option<PlanePicture> {
        let texture = self.log.take(fields, "texture")?;
        let axes = ["x-axis", "y-axis", "x-offset", "y-offset"];
        if !axes.iter().any(|key| fields.has(key)) {
            self.log.dropped(&texture.span, "without axes it is not read yet");
            self.note_not_read("a picture on a plane without axes".into(), &texture.span, "left out");
            return None;
        }
        self.log.approximated(
            &texture.span,
            "`image`, smooth between pixels, decoded as sRGB; the original does neither",
        );
        let file = texture.word.as_ref().map(|word| self.asset(word));
        let x_axis = self.log.need(fields, "x-axis");
        let y_axis = self.log.need(fields, "y-axis");
        let x_offset = self.log.need_number(fields, "x-offset", "`origin` of the picture");
        let y_offset = self.log.need_number(fields, "y-offset", "`origin` of the picture");
        for axis in [&x_axis, &y_axis].into_iter().flatten() {
            self.log.mapped(&axis.span, "`u` and `v` of the picture");
        }
        let (x_axis, y_axis) = (x_axis?, y_axis?);
        if x_axis.vector().cross(y_axis.vector()) == DVec3::ZERO {
            self.bad_value(
                "the axes of this picture are parallel",
                &y_axis.span,
                "write the direction of its height",
            );
            return None;
        }
        Some(PlanePicture {
            file: file?,
            x_axis: x_axis.vector(),
            y_axis: y_axis.vector(),
            x_offset: x_offset?,
            y_offset: y_offset?,
        })
    }

    fn triangle(&mut self, block: Block<'_>) -> Option<Shape> {
        let mut fields = self.log.fields(block, vocab::TRIANGLE);
        self.log.mapped(&fields.head, "`triangle`");
        let corners = [("vertex0", "`a`"), ("vertex1", "`b`"), ("vertex2", "`c`")]
            .map(|(key, to)| self.log.need_vector(&mut fields, key, to));
        self.log.finish(fields);
        let [a, b, c] = corners;
        Some(Shape::Triangle { corners: [a?, b?, c?] })
    }

    /// A mesh and, in the dialect of arsenal.txt, its placement: `v scale + offset`, and z mirrored by `Y_inverse`.
    fn mesh(&mut self, block: Block<'_>) -> Option<Object> {
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

    fn check_scale(&mut self, factors: DVec3, at: &Span) {
        if factors.to_array().contains(&0.0) {
            self.bad_value("a scale of 0 flattens the object", at, "write a factor other than 0");
        }
    }

    /// `Transform { operations object }`: each operation multiplies on the right, so the last one acts first.
    fn transform(&mut self, block: Block<'_>) -> Option<Object> {
        let span = block.head.clone();
        self.log.mapped(&span, "`transform`");
        let mut factors: Vec<Step> = Vec::new(); // as in a product of matrices, the leftmost acting last
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

    fn operation(&mut self, field: &Field<'_>, factors: &mut Vec<Step>) {
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
            Step::Matrix(_) => factors.insert(0, step), // the two matrix operations multiply on the left
            step => factors.push(step),
        }
    }

    /// `RevSurface { profile CURVE { controls [..] .. } }`, rotated about the y axis.
    fn revolve(&mut self, block: Block<'_>) -> Option<Shape> {
        let span = block.head.clone();
        self.log.mapped(&span, "`revolve`");
        let (mut profile, mut has_curve) = (None, false);
        for part in self.log.parts(block.body, vocab::REV_SURFACE) {
            match part {
                Part::Field(field) if field.known => self.log.mapped(&field.span, "`profile`"),
                Part::Field(field) => self.log.unknown_field(&field, "RevSurface", vocab::REV_SURFACE),
                Part::Block(block) => {
                    has_curve = true;
                    profile = self.profile(block).or(profile);
                }
            }
        }
        if !has_curve {
            self.log.notes.note(Mistake::MissingField {
                block: "RevSurface".into(),
                field: "profile",
                at: span.into(),
                help: "add `profile BezierCurve { controls [ 1 0 0 ] .. }`".into(),
            });
        }
        profile.map(|profile| Shape::Revolve { profile })
    }

    fn profile(&mut self, block: Block<'_>) -> Option<Profile> {
        let kind = match block.name() {
            "BezierCurve" => Curve::Bezier,
            "BsplineCurve" => Curve::Bspline,
            _ => {
                self.log.unknown_block(&block, "in `RevSurface`".into(), &["BezierCurve", "BsplineCurve"]);
                return None;
            }
        };
        let mut fields = self.log.fields(block, vocab::CURVE);
        let (curve, head) = (fields.block.clone(), fields.head.clone());
        self.log.mapped(&head, "the kind of profile");
        let controls = self.log.take(&mut fields, "controls");
        self.log.finish(fields);
        let lists = controls.map(|field| {
            self.log.mapped(&field.span, "points of the profile");
            field.lists
        });
        let lists = lists.unwrap_or_default();
        if lists.len() < 4 {
            self.log.notes.note(Mistake::ProfileTooShort { curve, count: lists.len(), at: head.into() });
            return None;
        }
        if kind == Curve::Bezier && lists.len() % 3 != 1 {
            let help =
                "it was read as one curve over all its points; the original wants 4, 7, 10, .. of them";
            self.differs(format!("a Bezier curve of {} points", lists.len()), &head, help);
        }
        let points: Vec<_> = lists.iter().map(|list| self.control_point(list)).collect();
        let points: Option<Vec<_>> = points.into_iter().collect(); // after the mistakes of all of them
        Some(Profile { kind, points: self.outward(points?, &head) })
    }

    /// `[ x y 0 ]`: distance from the axis and height.
    fn control_point(&mut self, list: &List<'_>) -> Option<(f64, f64)> {
        let numbers: Vec<f64> = list
            .items
            .iter()
            .filter_map(|item| match item {
                Node::Number(number) => Some(number.value),
                _ => None,
            })
            .collect();
        let at = list.span.clone().into();
        let found = match list.items.iter().find(|item| !matches!(item, Node::Number(_))) {
            Some(Node::Word(word)) => format!("`{}` is none", word.text),
            _ => format!("this one has {}", list.items.len()),
        };
        match numbers[..] {
            [x, y, 0.0] if list.items.len() == 3 => Some((x, y)),
            [_, _, z] if list.items.len() == 3 => {
                self.log.notes.note(Mistake::ProfileOffPlane { z, at });
                None
            }
            _ => {
                self.log.notes.note(Mistake::MissingNumber {
                    key: "[ .. ]".into(),
                    wanted: "3 numbers".into(),
                    found,
                    at,
                    help: "a control point is `[ x y 0 ]`".into(),
                });
                None
            }
        }
    }

    /// Turns a profile on the left of the axis to the right, which makes the same surface.
    fn outward(&mut self, mut points: Vec<(f64, f64)>, at: &Span) -> Vec<(f64, f64)> {
        let (left, right) = (points.iter().any(|p| p.0 < 0.0), points.iter().any(|p| p.0 > 0.0));
        if left && right {
            let help = "a radius below 0 has no meaning in a `revolve`; move the points to one side";
            self.differs("this profile crosses its axis", at, help);
        }
        if left && !right {
            for point in &mut points {
                point.0 = 0.0 - point.0;
            }
        }
        points
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

/// An object without transform, material and remarks, whose shape is still to be set.
fn plain(span: Span) -> Object {
    Object { shape: Shape::Group(Vec::new()), material: None, steps: Vec::new(), notes: Vec::new(), span }
}
