//! `Lights`: what kind each is, by its fields rather than by its name.

use super::{Dialect, Mistake, Reader, spot};
use crate::convert::fields::{Fields, Part};
use crate::convert::model::Light;
use crate::convert::parse::Block;
use crate::convert::words::{LIGHT, LIGHTS, blocks, normalised};
use crate::convert::{Falloff, Lights};
use crate::math::DVec3;

/// What a light is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Point,
    Directional,
    Spot,
    Sphere,
    Disk,
    /// A disk square to an axis that is named by a word.
    AxisDisk,
    Rect,
    Triangle,
    Mesh,
    /// A light with an area of which nothing is said.
    Unshaped,
}

impl Kind {
    /// By the fields that are there; the name decides only where they leave a choice.
    fn of(name: &str, fields: &Fields<'_>) -> Self {
        let name = normalised(name);
        let has = |role: &str| fields.has(role);
        let any = |roles: &[&str]| roles.iter().any(|role| fields.has(role));
        let is_round = has("radius") && has("position");
        let has_edges = any(&["edge u", "half edge u", "axis u", "p1"]) && !is_round;
        let faces = any(&["direction", "normal"]);
        let has_extent = any(&["size", "area", "length u", "length v"]);
        if has("direction") && name.contains("direct") {
            Self::Directional
        } else if has("p1") && name.contains("triang") {
            Self::Triangle
        } else if has("obj_file") && !has_edges {
            Self::Mesh
        } else if any(&["range x", "range y", "range z"]) {
            if has("radius") { Self::AxisDisk } else { Self::Rect }
        } else if has_edges || (faces && has_extent && has("position")) || name.contains("rect") {
            Self::Rect
        } else if has("position") && faces && (any(spot::SPREADS) || name.contains("spot")) {
            Self::Spot
        } else if is_round && faces {
            Self::Disk
        } else if is_round && !name.contains("point") {
            Self::Sphere
        } else if has("direction") && !has("position") {
            Self::Directional
        } else if name.contains("area") && !has("position") {
            Self::Unshaped
        } else {
            Self::Point
        }
    }
}

impl Reader<'_> {
    /// The lights of a block; points and directions may be inert, see [`Reader::lights_inert`].
    pub(super) fn lights(&mut self, block: Block<'_>) -> Vec<Light> {
        let (head, name) = (block.head.clone(), block.name().to_string());
        self.log.mapped(&head, "`light` items");
        let (mut lights, mut counts, mut found) = (Vec::new(), Vec::new(), 0);
        let mut inert = None;
        for part in self.log.parts(block.body, &LIGHTS) {
            match part {
                Part::Field(field) if field.role == "count" => counts.push(field),
                Part::Field(field) if field.role == "MaterialIndex" => {
                    self.log.ignored(&field.span, "a light has no material but its own");
                }
                Part::Field(field) if field.role == "setting" => {
                    self.log.dropped(&field.span, "a setting of the original's renderer, not of the scene");
                }
                Part::Field(field) => self.log.unknown_field(&field, &name, &LIGHTS),
                Part::Block(block) => {
                    found += 1;
                    match self.lights_inert(&block) {
                        Some(why) => {
                            inert = Some(why);
                            self.log.ignored(&block.span, why);
                        }
                        None => lights.extend(self.light(block)),
                    }
                }
            }
        }
        if let Some(why) = inert {
            self.log.notes.note(Mistake::LightsDropped { why, at: head.into() });
        }
        for count in counts {
            self.log.check_count(&count, found);
        }
        lights
    }

    /// Why this light is inert, if it is: in many programs points and directions only light where nothing else does.
    fn lights_inert(&self, block: &Block<'_>) -> Option<&'static str> {
        let is_bare = ["PointLight", "DirectionalLight", "SpotLight"].contains(&block.name());
        let any_emission = self.materials.iter().any(|material| material.look.shines());
        match (self.options.lights, self.dialect) {
            (Lights::Keep, _) => None,
            (Lights::Drop, _) => Some("the options say so"),
            (Lights::Auto, Dialect::Arsenal) => Some("in this dialect only emissive spheres shine"),
            (Lights::Auto, Dialect::Weights | Dialect::Enum | Dialect::Flags | Dialect::Implied)
                if any_emission && is_bare =>
            {
                Some("programs of this dialect ignore it where materials emit light")
            }
            _ => None,
        }
    }

    pub(super) fn light(&mut self, block: Block<'_>) -> Option<Light> {
        let name = block.name().to_string();
        let mut fields = self.log.fields(block, &LIGHT);
        let light = self.light_of(&name, &mut fields);
        let aside = "a setting of the original's renderer, not of the scene";
        self.log.put_aside(&mut fields, &["setting"], aside);
        match light {
            Some(_) => self.log.finish(fields),
            None => self.log.finish_lost(fields, "left out with its light"),
        }
        light
    }

    fn light_of(&mut self, name: &str, fields: &mut Fields<'_>) -> Option<Light> {
        self.log.mapped(&fields.head, "a light");
        let color = self.light_color(fields);
        if let Some(inner) = fields.take_block(|name| blocks::object(name).is_some()) {
            if color.is_none() {
                self.log.dropped(&inner.span, "left out with its light");
            }
            return self.glowing_object(inner, fields, color?);
        }
        let kind = Kind::of(name, fields);
        if kind == Kind::Unshaped {
            let head = fields.head.clone();
            self.note_not_read(format!("this `{name}`"), &head, "left out");
            self.log.dropped(&head, "its shape is not understood");
            return None;
        }
        let color = color?;
        match kind {
            Kind::Directional => self.directional_light(fields, color),
            Kind::Mesh => self.glowing_mesh(fields, color),
            Kind::AxisDisk => self.axis_disk(fields, color),
            Kind::Rect => self.rect_light(fields, color),
            Kind::Triangle => self.triangle_light(fields, color),
            Kind::Spot => self.spot_light(fields, color),
            Kind::Disk => self.disk_light(fields, color),
            Kind::Sphere => self.sphere_light(fields, color),
            Kind::Point | Kind::Unshaped => self.point_light(name, fields, color),
        }
    }

    /// The colour, times the factors that some programs have beside it.
    fn light_color(&mut self, fields: &mut Fields<'_>) -> Option<DVec3> {
        let mut color = None;
        if let Some(field) = self.log.take(fields, "color") {
            self.log.mapped(&field.span, "its brightness");
            color = Some(self.light_colour(&field));
        }
        for role in ["emission", "factor"] {
            let Some(field) = self.log.take(fields, role) else { continue };
            self.log.mapped(&field.span, "a factor of its brightness");
            let value = match field.numbers.len() {
                0 => DVec3::ONE,
                1 | 2 => DVec3::splat(field.number(0).max(0.0)),
                _ => self.light_colour(&field),
            };
            color = Some(color.unwrap_or(DVec3::ONE) * value);
        }
        let at = fields.head.clone();
        match color {
            None => {
                self.log.need(fields, "color");
            }
            Some(color) if color == DVec3::ZERO || !color.is_finite() => {
                self.log.dropped(&at, "it is dark");
                self.log.differs("this light is dark", &at, "it was left out");
                return None;
            }
            Some(_) => {}
        }
        color
    }

    /// A point; `color` is what the original adds at every distance, but for the law of its edition.
    fn point_light(&mut self, name: &str, fields: &mut Fields<'_>, color: DVec3) -> Option<Light> {
        self.log.mapped(&fields.head, "`light point`");
        let is_usual = LIGHT_NAMES.contains(&name);
        let position = self.log.need(fields, "position");
        let falloff = self.falloff(fields);
        if let Some(radius) = self.log.take(fields, "radius") {
            self.log.dropped(&radius.span, "a point has no radius");
        }
        let position = position?;
        let place = self.three(&position)?;
        self.log.mapped(&position.span, "`position`");
        if !is_usual {
            self.guess_block(name, "a point light", &fields.head.clone());
        }
        Some(Light::Point { position: place, cone: None, color, falloff, notes: Vec::new() })
    }

    /// Coefficients a, b, e of `1 / (a + b d + e d^2)`.
    ///
    /// The course's own light does not fall off. MIT's of 2004 has all three as `attenuation`; that of 2010 is
    /// `1 / (1 + k d^2)`, and that of 2016 `1 / (k d^2)`, both with `falloff k`.
    pub(super) fn falloff(&mut self, fields: &mut Fields<'_>) -> DVec3 {
        let attenuation = self.log.take(fields, "attenuation");
        let falloff = self.log.take(fields, "falloff");
        let law = match self.options.falloff {
            Falloff::Auto if self.dialect == Dialect::Mit2016 => Falloff::InverseSquare,
            Falloff::Auto if attenuation.is_some() => Falloff::Polynomial,
            Falloff::Auto if falloff.is_some() => Falloff::OnePlus,
            Falloff::Auto => Falloff::Constant,
            chosen => chosen,
        };
        let k = falloff.as_ref().map_or(0.0, |field| field.number(0));
        let coefficients = match law {
            Falloff::InverseSquare => DVec3::new(0.0, 0.0, k),
            Falloff::OnePlus => DVec3::new(1.0, 0.0, k),
            Falloff::Polynomial => attenuation.as_ref().map_or(DVec3::X, |field| field.vector()),
            Falloff::Constant | Falloff::Auto => DVec3::X,
        };
        for field in [&attenuation, &falloff].into_iter().flatten() {
            self.log.approximated(&field.span, "`intensity` as it is at the middle of the scene");
        }
        if coefficients.min_element() < 0.0 || coefficients == DVec3::ZERO {
            if let Some(field) = attenuation.or(falloff) {
                self.log.bad_value(
                    "this light divides by zero, or grows with distance",
                    &field.span,
                    "it was taken as one that does not fall off",
                );
            }
            return DVec3::X;
        }
        coefficients
    }

    fn directional_light(&mut self, fields: &mut Fields<'_>, color: DVec3) -> Option<Light> {
        self.log.mapped(&fields.head, "`light directional`");
        let direction = self.log.need(fields, "direction")?;
        self.log.mapped(&direction.span, "`direction`, the way the light travels");
        self.log.put_aside(fields, &["position", "radius", "normal"], "a directional light comes from afar");
        if direction.vector() == DVec3::ZERO {
            self.log.bad_value(
                "a light cannot travel along the zero vector",
                &direction.span,
                "write where it shines",
            );
            return None;
        }
        Some(Light::Directional { direction: direction.vector(), color })
    }

    fn sphere_light(&mut self, fields: &mut Fields<'_>, radiance: DVec3) -> Option<Light> {
        self.log.mapped(&fields.head, "`light sphere`");
        let center = self.log.need_vector(fields, "position", "`center`");
        let radius = self.positive(fields, "radius", "`radius`");
        Some(Light::Sphere { center: center?, radius: radius?, radiance })
    }

    fn rect_light(&mut self, fields: &mut Fields<'_>, radiance: DVec3) -> Option<Light> {
        self.log.mapped(&fields.head, "`light rect`");
        let quad = self.parallelogram(fields)?;
        let why = "it shines to both sides";
        self.log.put_aside(fields, &["two_sided"], why);
        self.log.put_aside(fields, &["normal", "direction", "up"], "it follows from the edges");
        self.log.put_aside(fields, &["obj_file"], "the rectangle stands for it");
        let note = "Programs differ on which side such a light shines to; here it is both.";
        let (origin, edge_u, edge_v) = (quad.origin, quad.edge_u, quad.edge_v);
        Some(Light::Rect { origin, edge_u, edge_v, radiance, notes: vec![note.into()] })
    }
}

/// Names of lights that need no word where they are taken as points.
const LIGHT_NAMES: &[&str] = &["PointLight", "Light", "SpotLight"];

/// Whether a block among the objects is a light.
pub(super) fn is_light(name: &str) -> bool {
    normalised(name).contains("light") && blocks::object(name).is_none_or(|kind| kind == blocks::Object::Quad)
}
