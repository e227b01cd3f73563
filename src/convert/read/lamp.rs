//! Lights that are shapes which glow: triangles, disks, meshes, and any other object.

use super::Reader;
use super::quad::axis_of;
use crate::convert::fields::Fields;
use crate::convert::model::{Light, Object, Shape};
use crate::convert::parse::{Block, Span};
use crate::math::DVec3;

impl Reader<'_> {
    pub(super) fn triangle_light(&mut self, fields: &mut Fields<'_>, radiance: DVec3) -> Option<Light> {
        let head = fields.head.clone();
        let shape = self.triangle(fields)?;
        self.log.mapped(&head, "a `triangle` of `emissive`");
        Some(Light::Glowing { object: Box::new(Object::new(shape, head)), radiance })
    }

    /// A disk that glows is a disk made of light.
    pub(super) fn disk_light(&mut self, fields: &mut Fields<'_>, radiance: DVec3) -> Option<Light> {
        self.log.mapped(&fields.head, "a `disk` of `emissive`");
        let center = self.log.need_vector(fields, "position", "`center`");
        let radius = self.positive(fields, "radius", "`radius`");
        let role = if fields.has("direction") { "direction" } else { "normal" };
        let normal = self.log.need(fields, role)?;
        self.log.mapped(&normal.span, "`normal`, the way it shines");
        let normal = self.three(&normal)?;
        self.glowing_disk(fields, center?, normal, radius?, radiance)
    }

    fn glowing_disk(
        &mut self,
        fields: &Fields<'_>,
        center: DVec3,
        normal: DVec3,
        radius: f64,
        radiance: DVec3,
    ) -> Option<Light> {
        let head = fields.head.clone();
        if normal == DVec3::ZERO {
            self.log.bad_value("the normal of this light is the zero vector", &head, "write where it faces");
            return None;
        }
        let object = Object::new(Shape::Disk { center, normal, radius }, head);
        Some(Light::Glowing { object: Box::new(object), radiance })
    }

    /// `normal Y- position 3 X 0 Z 1 radius 2`: a disk square to an axis.
    pub(super) fn axis_disk(&mut self, fields: &mut Fields<'_>, radiance: DVec3) -> Option<Light> {
        self.log.mapped(&fields.head, "a `disk` of `emissive`");
        let radius = self.positive(fields, "radius", "`radius`")?;
        let normal = self.log.need(fields, "normal")?;
        let (fixed, sign) = axis_of(normal.text())?;
        self.log.mapped(&normal.span, "`normal`, the way it shines");
        let mut center = DVec3::ZERO;
        center[fixed] = self.log.need_number(fields, "position", "`center`")?;
        for axis in [(fixed + 1) % 3, (fixed + 2) % 3] {
            let role = ["range x", "range y", "range z"][axis];
            center[axis] = self.log.number(fields, role, "`center`").unwrap_or(0.0);
        }
        self.glowing_disk(fields, center, DVec3::AXES[fixed] * sign, radius, radiance)
    }

    /// `AreaLight { .. TinyObj { FILE } }`, or any other object: it glows.
    pub(super) fn glowing_object(
        &mut self,
        block: Block<'_>,
        fields: &mut Fields<'_>,
        radiance: DVec3,
    ) -> Option<Light> {
        self.log.mapped(&fields.head, "an object of `emissive`");
        self.log.put_aside(fields, &["two_sided"], "materials of light shine to one side");
        let mut object = self.shape_of_light(block)?;
        self.bound(&mut object);
        Some(Light::Glowing { object: Box::new(object), radiance })
    }

    pub(super) fn glowing_mesh(&mut self, fields: &mut Fields<'_>, radiance: DVec3) -> Option<Light> {
        self.log.mapped(&fields.head, "a `mesh` of `emissive`");
        let file = self.log.take(fields, "obj_file")?;
        let head: Span = fields.head.clone();
        let file = self.obj_file(&file)?;
        let object = Object::new(Shape::Mesh { file, smooth: false }, head);
        Some(Light::Glowing { object: Box::new(object), radiance })
    }
}
