//! Groups and their objects: what kind each is, and what it is made of.

use super::light::is_light;
use super::{Dialect, Mistake, Reader};
use crate::convert::fields::{Field, Fields, Part};
use crate::convert::model::{Look, Material, Object, Shape};
use crate::convert::parse::{Block, Node, Span};
use crate::convert::words::{GROUP, SHAPE, blocks};
use crate::math::DVec3;

/// The index of no material, until it is known how many there are.
pub(super) const NO_MATERIAL: usize = usize::MAX;

impl Reader<'_> {
    /// The objects of a group. `MaterialIndex` changes the reader's state, which outlives the group.
    pub(super) fn group(&mut self, block: Block<'_>) -> Vec<Object> {
        self.log.mapped(&block.head, "objects, in their order");
        let parts = self.log.parts(block.body, &GROUP);
        let (objects, counts, found) = self.objects_of(parts);
        for count in counts {
            self.log.check_count(&count, found);
        }
        objects
    }

    /// Objects with the counts among them, which nobody checks where there is no group.
    pub(super) fn group_parts(&mut self, parts: Vec<Part<'_>>) -> (Vec<Object>, usize) {
        let (objects, counts, found) = self.objects_of(parts);
        for count in counts {
            self.log.ignored(&count.span, "counts nothing");
        }
        (objects, found)
    }

    fn objects_of<'t>(&mut self, parts: Vec<Part<'t>>) -> (Vec<Object>, Vec<Field<'t>>, usize) {
        let (mut objects, mut counts, mut found) = (Vec::new(), Vec::new(), 0);
        for part in parts {
            match part {
                Part::Field(field) if field.role == "MaterialIndex" => self.set_material(&field),
                Part::Field(field) if field.role == "material file" && field.word.is_some() => {
                    self.material_of_file(&field);
                }
                Part::Field(field) if field.role == "count" => counts.push(field),
                Part::Field(field) if field.role == "obj_file" && !field.guessed => {
                    found += 1;
                    objects.extend(self.bare_mesh(&field));
                }
                Part::Field(field) => self.log.unknown_field(&field, "Group", &GROUP),
                Part::Block(block) if is_inline_material(&block) => self.inline_material(block),
                Part::Block(block) if is_light(block.name()) => {
                    let light = self.light(block);
                    self.stray_lights.extend(light);
                }
                Part::Block(block) => {
                    found += 1;
                    objects.extend(self.object(block));
                }
            }
        }
        (objects, counts, found)
    }

    /// The original admits the index one past the last material; a placeholder stands in for what it reads there.
    pub(super) fn set_material(&mut self, field: &Field<'_>) {
        if !field.sound {
            self.log.dropped(&field.span, "malformed");
            self.material_index.get_or_insert(NO_MATERIAL); // the shapes that follow stay silent
            return;
        }
        self.log.mapped(&field.span, "`material` of the objects that follow");
        self.material_index = Some(self.valid_material(field));
    }

    /// The index of a material, or [`NO_MATERIAL`].
    fn valid_material(&mut self, field: &Field<'_>) -> usize {
        let (index, count) = (field.number(0).trunc() as i64, self.materials.len());
        let at = field.span.clone().into();
        match usize::try_from(index) {
            Ok(valid) if valid < count => return valid,
            Ok(end) if end == count && count > 0 => self.log.notes.note(Mistake::IndexAtCount { index, at }),
            _ => self.log.notes.note(Mistake::IndexOutOfRange { index, count, at }),
        }
        self.log.approximated(&field.span, "a grey placeholder");
        NO_MATERIAL
    }

    /// `MaterialPreset FILE`: a material that is described elsewhere. Each file has one placeholder, to be filled in.
    fn material_of_file(&mut self, field: &Field<'_>) {
        if field.guessed {
            self.log.guess(field.key, field.role, &field.span);
        }
        self.log.approximated(&field.span, "a grey placeholder, one for each file");
        let note = format!("The original takes this material from {}.", field.text());
        let known =
            self.materials.iter().position(|it| it.look == Look::Placeholder && it.notes == [note.as_str()]);
        self.material_index = Some(known.unwrap_or_else(|| {
            self.note_not_read("a file of materials", &field.span, "a grey placeholder stands in");
            let material = Material { span: field.span.clone(), look: Look::Placeholder, notes: vec![note] };
            self.materials.push(material);
            self.materials.len() - 1
        }));
    }

    /// The oldest dialect has no indices: a `Material { .. }` in a group holds for the objects that follow it.
    pub(super) fn inline_material(&mut self, block: Block<'_>) {
        let material = self.material(block);
        self.material_index = Some(self.materials.len());
        self.materials.push(material);
    }

    pub(super) fn object(&mut self, block: Block<'_>) -> Option<Object> {
        let span = block.span.clone();
        let object = self.object_of(block);
        if object.is_none() {
            self.log.lose(&span, "left out with its object");
        }
        object
    }

    fn object_of(&mut self, block: Block<'_>) -> Option<Object> {
        let (name, head) = (block.name().to_string(), block.head.clone());
        match blocks::object(&name) {
            Some(blocks::Object::Transform) => self.transform(block),
            Some(blocks::Object::Group) => Some(Object::new(Shape::Group(self.group(block)), head)),
            Some(blocks::Object::Curve) => self.leave_out(&block, "a curve has no surface"),
            Some(blocks::Object::Medium) => self.leave_out(&block, "there are no participating media"),
            Some(blocks::Object::Grid) => {
                self.log.drop_all(&block.span, "speeds up the original");
                None
            }
            Some(blocks::Object::Patch) => self.leave_out(&block, "it is a curved patch over control points"),
            Some(blocks::Object::Sky) => self.leave_out(&block, "pictures all around are not read"),
            Some(blocks::Object::Cage) => self.unbent(block),
            Some(blocks::Object::Formula) => {
                self.leave_out(&block, "its surface is a formula in one program")
            }
            Some(kind) => self.shape(block, kind),
            None if holds_objects(&block) => {
                self.guess_block(&name, "a group", &head);
                Some(Object::new(Shape::Group(self.group(block)), head))
            }
            None => self.unnamed_shape(block),
        }
    }

    /// A block of an unknown name is what its fields make of it.
    fn unnamed_shape(&mut self, block: Block<'_>) -> Option<Object> {
        let words: Vec<&str> = block.words().filter_map(|word| Some(SHAPE.find(word)?.role)).collect();
        let has = |roles: &[&str]| roles.iter().all(|role| words.contains(role));
        let kind = if has(&["obj_file"]) {
            (blocks::Object::Mesh, "a mesh")
        } else if has(&["p1", "p2", "p3"]) {
            (blocks::Object::Triangle, "a triangle")
        } else if has(&["center", "normal", "radius"]) {
            (blocks::Object::Disk, "a disk")
        } else if has(&["normal", "offset"]) {
            (blocks::Object::Plane, "a plane")
        } else if has(&["center", "radius"]) && !words.contains(&"length v") {
            (blocks::Object::Sphere, "a sphere")
        } else if has(&["min", "max"]) {
            (blocks::Object::Box, "a box")
        } else if has(&["profile"]) {
            (blocks::Object::Revolve, "a surface of revolution")
        } else {
            let usual = ["Group", "Sphere", "Plane", "Triangle", "TriangleMesh", "Transform", "RevSurface"];
            self.log.unknown_block(&block, "in `Group`".into(), &usual);
            return None;
        };
        self.guess_block(block.name(), kind.1, &block.head);
        self.shape(block, kind.0)
    }

    /// A shape with its material and all that else may stand in its block.
    fn shape(&mut self, block: Block<'_>, kind: blocks::Object) -> Option<Object> {
        let name = block.name().to_string();
        let mut fields = self.log.fields(block, &SHAPE);
        let own_material = fields.take_block(is_material);
        let head = fields.head.clone();
        let mut object = match kind {
            blocks::Object::Mesh => self.mesh(&mut fields),
            _ => self.surface(&mut fields, kind).map(|shape| Object::new(shape, head.clone())),
        };
        if let Some(object) = &mut object {
            self.object_picture(&mut fields, object);
            self.move_object(&mut fields, object);
        }
        let index = self.log.take(&mut fields, "material");
        let why = "how the original finds or draws it, not what it is";
        self.log.put_aside(&mut fields, &["speed-up"], why);
        let frame = "a frame of the picture, which is laid on by uv coordinates";
        self.log.put_aside(&mut fields, &["picture frame"], frame);
        let Some(mut object) = object else {
            if let Some(block) = own_material {
                self.log.dropped(&block.span, "left out with its object");
            }
            self.log.finish_lost(fields, "left out with its object");
            return None;
        };
        self.log.finish(fields);
        object.material = match (own_material, index) {
            (Some(block), _) => {
                let in_force = self.material_index;
                self.inline_material(block);
                std::mem::replace(&mut self.material_index, in_force)
            }
            (None, Some(field)) => {
                self.log.mapped(&field.span, "`material`");
                Some(self.valid_material(&field))
            }
            (None, None) => self.material_of(&name, &head),
        };
        self.note_dark_lamp(&mut object);
        if object.material.and_then(|index| self.materials.get(index)).is_some_and(|it| it.look.shines()) {
            self.bound(&mut object);
        }
        Some(object)
    }

    fn surface(&mut self, fields: &mut Fields<'_>, kind: blocks::Object) -> Option<Shape> {
        match kind {
            blocks::Object::Plane => self.plane(fields),
            blocks::Object::Triangle => self.triangle(fields),
            blocks::Object::Quad => self.quad(fields),
            blocks::Object::Disk => self.disk(fields),
            blocks::Object::Box => self.cuboid(fields),
            blocks::Object::Cylinder => self.cylinder(fields),
            blocks::Object::Torus => self.torus(fields),
            blocks::Object::Revolve => self.revolve(fields),
            _ => self.sphere(fields),
        }
    }

    /// A shape inside a light, which needs no material.
    pub(super) fn shape_of_light(&mut self, block: Block<'_>) -> Option<Object> {
        let in_force = self.material_index.replace(0);
        let object = self.object(block);
        self.material_index = in_force;
        object.map(without_material)
    }

    /// Motion, which stands still at the middle of the interval in which the shutter is open, usually 0 to 1.
    fn move_object(&mut self, fields: &mut Fields<'_>, object: &mut Object) {
        let Some(velocity) = self.log.take(fields, "velocity") else { return };
        let Some(way) = self.three(&velocity) else { return };
        self.log.approximated(&velocity.span, "stands still half way through its motion");
        self.still(object, 0.5 * way, &velocity.span);
    }

    /// Moves an object by half of its motion, and says so.
    pub(super) fn still(&mut self, object: &mut Object, by: DVec3, at: &Span) {
        if by == DVec3::ZERO {
            return;
        }
        self.note_not_read("motion", at, "the object stands still half way");
        object
            .notes
            .push("Moves in the original while the shutter is open; here it stands still half way.".into());
        match &mut object.shape {
            Shape::Sphere { center, .. } => *center += by,
            _ => object.steps.push(crate::convert::model::Step::Translate(by)),
        }
    }

    /// In the dialect of arsenal.txt only spheres that emit red 12 send photons; other lamps merely look bright.
    pub(super) fn note_dark_lamp(&mut self, object: &mut Object) {
        let material = object.material.and_then(|index| self.materials.get(index));
        let Some(Look::Emissive { radiance }) = material.map(|material| &material.look) else { return };
        let is_sphere = matches!(object.shape, Shape::Sphere { .. });
        if self.dialect == Dialect::Arsenal && !(is_sphere && (radiance.x - 12.0).abs() < 0.001) {
            let help = "it sends photons only from spheres whose `emissionColor` is 12 in red";
            self.log.differs("this lamp looks bright in the original but lights nothing", &object.span, help);
            object.notes.push("The original shows this lamp but sends no light from it.".into());
        }
    }

    /// The material in force; a shape before the first `MaterialIndex` is a mistake, and grey.
    pub(super) fn material_of(&mut self, shape: &str, at: &Span) -> Option<usize> {
        if self.material_index.is_none() {
            self.log.notes.note(Mistake::NoMaterial { shape: shape.into(), at: at.clone().into() });
        }
        self.material_index
    }

    /// Objects in a cage that bends them, as they were before.
    fn unbent(&mut self, mut block: Block<'_>) -> Option<Object> {
        self.log.not_convertible(
            format!("the bending by `{}`", block.name()),
            &block.head,
            "objects keep their form; what is inside stands as it was before it was bent",
        );
        let is_object = |node: &Node<'_>| match node {
            Node::Block(inner) => blocks::object(inner.name()).is_some(),
            _ => false,
        };
        for node in block.body.iter().filter(|node| !is_object(node)) {
            self.log.dropped(&node.span(), "the cage of a bending");
        }
        block.body.retain(is_object);
        let head = block.head.clone();
        Some(Object::new(Shape::Group(self.group(block)), head))
    }

    fn leave_out(&mut self, block: &Block<'_>, why: &'static str) -> Option<Object> {
        self.log.drop_all(&block.span, why);
        self.log.not_convertible(format!("`{}`", block.name()), &block.head, why);
        None
    }
}

/// A light's object has the light for its material.
fn without_material(mut object: Object) -> Object {
    object.material = None;
    if let Shape::Group(objects) = object.shape {
        object.shape = Shape::Group(objects.into_iter().map(without_material).collect());
    }
    object
}

fn is_material(name: &str) -> bool {
    blocks::material(name).is_some() && blocks::object(name).is_none()
}

/// Materials among objects; a name such as `Glass` could be anything, so the word must be there.
fn is_inline_material(block: &Block<'_>) -> bool {
    block.name().contains("Material") && is_material(block.name())
}

/// Whether a block has objects in it that belong to the format.
pub(super) fn holds_objects(block: &Block<'_>) -> bool {
    block.blocks().any(|inner| blocks::is_usual_object(inner.name()))
}
