//! `Lights`: points and directions, which many programs read and never use.

use super::{Mistake, Reader, vocab};
use crate::convert::fields::{Fields, Part};
use crate::convert::model::{Light, Look};
use crate::convert::parse::Block;
use crate::math::DVec3;

impl Reader<'_> {
    pub(super) fn lights(&mut self, block: Block<'_>) -> Vec<Light> {
        let any_emission =
            self.materials.iter().any(|material| matches!(material.look, Look::Emissive { .. }));
        if let Some(why) = self.lights_inert(any_emission) {
            self.log.ignored(&block.span, why);
            if block.blocks().next().is_some() {
                self.log.notes.note(Mistake::LightsDropped { why, at: block.head.into() });
            }
            return Vec::new();
        }
        self.log.mapped(&block.head, "`light` items");
        let (mut lights, mut counts, mut found) = (Vec::new(), Vec::new(), 0);
        for part in self.log.parts(block.body, vocab::LIGHTS) {
            match part {
                Part::Field(field) if field.key == "numLights" => counts.push(field),
                Part::Field(field) => self.log.unknown_field(&field, "Lights", vocab::LIGHTS),
                Part::Block(block) => {
                    found += 1;
                    lights.extend(self.light(block));
                }
            }
        }
        for count in counts {
            self.log.check_counts(&count, found);
        }
        lights
    }

    fn light(&mut self, block: Block<'_>) -> Option<Light> {
        match block.name() {
            "PointLight" => self.point_light(block),
            "DirectionalLight" => self.directional_light(block),
            "SphereLight" => self.sphere_light(block),
            "AreaLight" if block.after("x_axis").is_some() => self.area_light(block, ["x_axis", "y_axis"]),
            "AreaLight" if block.after("dirX").is_some() => self.area_light(block, ["dirX", "dirY"]),
            "AreaLight" | "CircleLight" | "SpotLight" | "RoundDisk_Light" | "DiskLight" | "RecLight"
            | "RectLight" => {
                self.not_read(&block, "left out, braces and all");
                None
            }
            _ => {
                self.log.unknown_block(&block, "in `Lights`".into(), &["PointLight", "DirectionalLight"]);
                None
            }
        }
    }

    fn point_light(&mut self, block: Block<'_>) -> Option<Light> {
        let mut fields = self.log.fields(block, vocab::LIGHT);
        self.log.mapped(&fields.head, "`light point`");
        let position = self.log.need_vector(&mut fields, "position", "`position`");
        let color = self
            .light_color(&mut fields, "`intensity`, which falls off with distance; the original's does not");
        for key in ["attenuation", "falloff"] {
            if self.dialect.is_mit()
                && let Some(field) = self.log.take(&mut fields, key)
            {
                self.log.dropped(&field.span, "light falls off with the square of the distance");
                self.note_not_read(format!("`{key}` of a light"), &field.span, "left out");
            }
        }
        self.log.finish(fields);
        Some(Light::Point { position: position?, color: color? })
    }

    fn directional_light(&mut self, block: Block<'_>) -> Option<Light> {
        let mut fields = self.log.fields(block, vocab::LIGHT);
        self.log.mapped(&fields.head, "`light directional`");
        let direction = self.log.need(&mut fields, "direction");
        let color =
            self.light_color(&mut fields, "`irradiance` and `color`; the original's light casts no shadows");
        self.log.finish(fields);
        let direction = direction?;
        self.log.mapped(&direction.span, "`direction`, the way the light travels");
        if direction.vector() == DVec3::ZERO {
            self.bad_value(
                "a light cannot travel along the zero vector",
                &direction.span,
                "write where it shines",
            );
            return None;
        }
        Some(Light::Directional { direction: direction.vector(), color: color? })
    }

    fn sphere_light(&mut self, block: Block<'_>) -> Option<Light> {
        let mut fields = self.log.fields(block, vocab::LIGHT);
        self.log.mapped(&fields.head, "`light sphere`");
        let center = self.log.need_vector(&mut fields, "position", "`center`");
        let radius = self.positive(&mut fields, "radius", "`radius`");
        let radiance = self.light_color(&mut fields, "`radiance`");
        self.log.finish(fields);
        Some(Light::Sphere { center: center?, radius: radius?, radiance: radiance? })
    }

    /// A rectangle by its middle and two vectors, half its edges, as two programs have it.
    fn area_light(&mut self, block: Block<'_>, axes: [&'static str; 2]) -> Option<Light> {
        let mut fields = self.log.fields(block, vocab::LIGHT);
        let head = fields.head.clone();
        self.log.mapped(&head, "`light rect`");
        let middle = self.log.need_vector(&mut fields, "position", "the middle of the light");
        let [u, v] = axes.map(|key| self.log.need_vector(&mut fields, key, "half an edge"));
        let color = self.light_color(&mut fields, "`radiance`");
        let factor = self.log.take(&mut fields, "emission");
        if let Some(field) = &factor {
            self.log.mapped(&field.span, "a factor of `radiance`");
        }
        self.log.finish(fields);
        let (middle, u, v) = (middle?, u?, v?);
        if u.cross(v) == DVec3::ZERO {
            self.bad_value("the edges of this light are parallel", &head, "write two directions that differ");
            return None;
        }
        let radiance = color? * factor.map_or(1.0, |field| field.number(0).max(0.0));
        Some(Light::Rect { origin: middle - u - v, edge_u: 2.0 * u, edge_v: 2.0 * v, radiance })
    }

    fn light_color(&mut self, fields: &mut Fields<'_>, how: &str) -> Option<DVec3> {
        let field = self.log.need(fields, "color")?;
        self.log.approximated(&field.span, how);
        let color = field.vector();
        if color.min_element() < 0.0 {
            self.differs("a light takes light away", &field.span, "negative components were set to 0");
        }
        Some(color.max(DVec3::ZERO))
    }
}
