//! Shapes but for planes and surfaces of revolution.

use super::Reader;
use super::quad::is_flat;
use crate::convert::dialect::Dialect;
use crate::convert::fields::{Field, Fields};
use crate::convert::model::{Asset, Object, Shape, Step};
use crate::math::DVec3;

/// What some programs write after the file of a mesh.
#[derive(Default)]
struct Written {
    scale: Option<DVec3>,
    offset: Option<DVec3>,
}

impl Reader<'_> {
    /// A ball; one that moves between two centres stands half way.
    pub(super) fn sphere(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        self.log.mapped(&fields.head, "`sphere`");
        let centers = ["center0", "center", "center1", "center2"];
        let mut given = centers.into_iter().filter(|role| fields.has(role));
        let (first, second) = (given.next(), given.next());
        let other_names = || ["position", "origin"].into_iter().find(|role| fields.has(role));
        let role = first.or_else(other_names).unwrap_or("center");
        let center = self.log.need_vector(fields, role, "`center`");
        let end = second.and_then(|role| self.log.take(fields, role));
        let radius = self.positive(fields, "radius", "`radius`");
        let times = "the times of a motion, half way through which it stands";
        self.log.put_aside(fields, &["time"], times);
        let mut center = center?;
        if let Some(end) = end {
            self.log.approximated(&end.span, "stands still half way through its motion");
            self.note_not_read("motion", &end.span, "the object stands still half way");
            center = 0.5 * (center + end.vector());
        }
        Some(Shape::Sphere { center, radius: radius? })
    }

    /// A rectangle, or a parallelogram.
    pub(super) fn quad(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        self.log.mapped(&fields.head, "`quad`");
        let quad = self.parallelogram(fields)?;
        self.log.put_aside(fields, &["normal", "offset", "up"], "it follows from the edges");
        Some(Shape::Quad { origin: quad.origin, edge_u: quad.edge_u, edge_v: quad.edge_v })
    }

    pub(super) fn disk(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        self.log.mapped(&fields.head, "`disk`");
        let place = if fields.has("position") { "position" } else { "center" };
        let center = self.log.need_vector(fields, place, "`center`");
        let normal = self.log.need(fields, "normal");
        let radius = self.positive(fields, "radius", "`radius`");
        let normal = normal?;
        let direction = self.three(&normal)?;
        self.log.mapped(&normal.span, "`normal`");
        if direction == DVec3::ZERO {
            self.log.bad_value(
                "the normal of this disk is the zero vector",
                &normal.span,
                "write where it faces",
            );
            return None;
        }
        Some(Shape::Disk { center: center?, normal: direction, radius: radius? })
    }

    /// A box by two corners, or by its middle and size.
    pub(super) fn cuboid(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        let head = fields.head.clone();
        self.log.mapped(&head, "`box`");
        let (min, max) = if fields.has("center") && fields.has("size") {
            let center = self.log.need_vector(fields, "center", "the middle of the box")?;
            let size = self.log.take(fields, "size")?;
            self.log.mapped(&size.span, "the lengths of its edges");
            (center - 0.5 * size.vector(), center + 0.5 * size.vector())
        } else {
            let roles = if fields.has("a") && fields.has("b") { ["a", "b"] } else { ["min", "max"] };
            let corners = roles.map(|role| self.log.need_vector(fields, role, "a corner"));
            (corners[0]?, corners[1]?)
        };
        if (max - min).to_array().contains(&0.0) {
            let help = "write corners that differ in every coordinate";
            self.log.bad_value("this cube has no volume", &head, help);
            return None;
        }
        Some(Shape::Cuboid { min: min.min(max), max: max.max(min) })
    }

    pub(super) fn triangle(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        self.log.mapped(&fields.head, "`triangle`");
        let corners = [("p1", "vertex0", "`a`"), ("p2", "vertex1", "`b`"), ("p3", "vertex2", "`c`")].map(
            |(role, key, to)| {
                let role = if fields.has(role) { role } else { key };
                self.log.need_vector(fields, role, to)
            },
        );
        let [a, b, c] = corners;
        let (a, b, c) = (a?, b?, c?);
        if is_flat(b - a, c - a) {
            let head = fields.head.clone();
            let help = "it was left out; write corners that are not in one line";
            self.log.bad_value("this triangle has no area", &head, help);
            return None;
        }
        Some(Shape::Triangle { corners: [a, b, c] })
    }

    /// A tube without lids, between two points or from a foot upwards.
    pub(super) fn cylinder(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        let head = fields.head.clone();
        self.log.mapped(&head, "`cylinder`, without lids");
        let radius = self.positive(fields, "radius", "`radius`");
        let mut ends = self.log.take_all(fields, "endpoint");
        for end in &ends {
            self.log.mapped(&end.span, "`base` or `top`");
        }
        let end = ends.pop().map(|end| end.vector());
        let foot = self.log.take_any(fields, &["center", "position", "origin"]).or(ends.pop());
        let base = foot.map_or(DVec3::ZERO, |field| {
            self.log.mapped(&field.span, "`base`");
            field.vector()
        });
        let height = self.log.number(fields, "length v", "how far it reaches");
        let axis = self.log.vector(fields, "axis", "which way it stands").unwrap_or(DVec3::Y);
        let top = end.or(height.map(|height| base + axis.normalize_or_zero() * height));
        let is_long = |top: &DVec3| top.distance(base) > 1e-6 * top.length().max(base.length());
        let Some(top) = top.filter(is_long) else {
            self.log.not_convertible("this cylinder", &head, "where it ends is not said");
            return None;
        };
        Some(Shape::Cylinder { base, top, radius: radius? })
    }

    /// A ring around the y axis.
    pub(super) fn torus(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        let head = fields.head.clone();
        self.log.mapped(&head, "`torus`");
        let large = self.positive(fields, "large radius", "`radius`");
        let small = self.positive(fields, "small radius", "`tube`");
        let (radius, tube) = (large?, small?);
        if tube >= radius {
            let help = "write `R` greater than `r`";
            self.log.bad_value("the tube of this torus is as wide as its ring", &head, help);
            return None;
        }
        Some(Shape::Torus { radius, tube })
    }

    /// A mesh and its placement: `v scale + offset`, and in the dialect of arsenal.txt z mirrored by `Y_inverse`.
    pub(super) fn mesh(&mut self, fields: &mut Fields<'_>) -> Option<Object> {
        let head = fields.head.clone();
        self.log.mapped(&head, "`mesh`");
        let (file, written) = self.mesh_file(fields)?;
        let scale = self.mesh_scale(fields).or(written.scale).unwrap_or(DVec3::ONE);
        let offset_role = ["offset", "center", "position"].into_iter().find(|role| fields.has(role));
        let offset = offset_role.and_then(|role| self.log.vector(fields, role, "`translate`"));
        let offset = offset.or(written.offset).unwrap_or_default();
        let mut object = Object::new(Shape::Mesh { file, smooth: self.is_smooth(fields) }, head.clone());
        let mut mirror = DVec3::ONE;
        if let Some(flag) = self.log.take(fields, "Y_inverse") {
            self.log.mapped(&flag.span, "a mirrored z axis, which is what it does in spite of its name");
            object.notes.push("`Y_inverse` mirrors z in the original, not y.".into());
            mirror.z = -1.0;
        }
        object.steps = vec![Step::Scale(scale * mirror), Step::Translate(offset)];
        object.steps.retain(|step| !step.is_identity());
        if scale.to_array().contains(&0.0) {
            self.log.bad_value("a scale of 0 flattens the object", &head, "write a factor other than 0");
            return None;
        }
        Some(object)
    }

    /// The file after `obj_file`, or where a program has no key, the one word there is; and what is written after it.
    fn mesh_file(&mut self, fields: &mut Fields<'_>) -> Option<(Asset, Written)> {
        if fields.has("obj_file") {
            let field = self.log.take(fields, "obj_file")?;
            let file = self.obj_file(&field)?;
            return Some((file, self.after_mesh_file(&field)));
        }
        let is_path = |field: &&Field<'_>| field.role.is_empty() && field.key.contains('.');
        let keyless =
            fields.rest().iter().find(is_path).map(|field| (field.key.to_string(), field.span.clone()));
        match keyless {
            Some((key, span)) => {
                self.log.mapped(&span, "`file`");
                fields.forget(&key);
                Some((self.asset_at(&key, &span), Written::default()))
            }
            None => {
                self.log.need(fields, "obj_file");
                None
            }
        }
    }

    /// `obj_file FILE s x y z`: a factor and an offset without keys.
    fn after_mesh_file(&mut self, field: &Field<'_>) -> Written {
        let numbers: Vec<f64> = field.numbers.iter().map(|number| number.value).collect();
        let written = match numbers[..] {
            [] => return Written::default(),
            [s] => Written { scale: Some(DVec3::splat(s)), offset: None },
            [x, y, z] => Written { scale: None, offset: Some(DVec3::new(x, y, z)) },
            [s, x, y, z] => Written { scale: Some(DVec3::splat(s)), offset: Some(DVec3::new(x, y, z)) },
            _ => {
                self.log.differs("numbers after the file of a mesh", &field.span, "nothing was made of them");
                return Written::default();
            }
        };
        self.log.approximated(&field.span, "`file`, and the numbers as a factor and an offset");
        let help = "they were taken as a factor, an offset, or both in this order";
        self.log.differs("numbers after the file of a mesh", &field.span, help);
        written
    }

    fn mesh_scale(&mut self, fields: &mut Fields<'_>) -> Option<DVec3> {
        if let Some(field) = self.log.take(fields, "scale") {
            self.log.mapped(&field.span, "`scale`");
            return Some(DVec3::splat(field.number(0)));
        }
        self.log.vector(fields, "scaling", "`scale`")
    }

    /// Whether normals are interpolated. The course and MIT's edition of 2004 have flat triangles, that of 2016 smooth
    /// ones; that of 2010 has smooth ones from 120 vertices on, which only the file of the mesh could tell.
    fn is_smooth(&mut self, fields: &mut Fields<'_>) -> bool {
        let mut is_smooth = matches!(self.dialect, Dialect::Mit2010 | Dialect::Mit2016);
        if let Some(field) = self.log.take(fields, "smooth") {
            is_smooth = !field.text().eq_ignore_ascii_case("false")
                && field.numbers.first().is_none_or(|n| n.value != 0.0);
            self.log.mapped(&field.span, "`smooth`");
        }
        if let Some(field) = self.log.take(fields, "interpolate") {
            is_smooth = field.number(0) != 0.0;
            self.log.mapped(&field.span, "`smooth`");
        }
        is_smooth
    }

    pub(super) fn obj_file(&mut self, field: &Field<'_>) -> Option<Asset> {
        let Some(word) = &field.word else {
            self.log.dropped(&field.span, "no file");
            self.log.bad_value("a number is no mesh file", &field.span, "write the file's name");
            return None;
        };
        self.log.mapped(&field.span, "`file`");
        if !word.text.to_ascii_lowercase().ends_with(".obj") {
            let help = "the original refuses it; the renderer goes by the file's own format";
            self.log.differs("a mesh file that does not end in `.obj`", &word.span, help);
        }
        Some(self.asset(word))
    }

    /// `ObjFile FILE` among the objects of a group.
    pub(super) fn bare_mesh(&mut self, field: &Field<'_>) -> Option<Object> {
        if !field.sound {
            self.log.dropped(&field.span, "malformed");
            return None;
        }
        let file = self.obj_file(field)?;
        let mut object = Object::new(Shape::Mesh { file, smooth: false }, field.span.clone());
        object.material = self.material_of("mesh", &field.span);
        Some(object)
    }
}
