//! Cameras, lenses and film.

use crate::ir::camera::{Fov, Mapping};
use crate::ir::{Camera, Exposure, Film, Filter, Focus, Lens, Tone};
use crate::math::{DVec2, DVec3};
use crate::resolve::dimension::{Dimension, Quantity};
use crate::resolve::error::Error;
use crate::resolve::fields::Fields;
use crate::resolve::node::{compose, steps_of};
use crate::resolve::{Env, Resolver, Value};
use crate::schema;
use crate::source::Spanned;
use crate::syntax::ast::Object;

impl<'a> Resolver<'a> {
    /// `camera { .. }`, `camera front { .. }`.
    pub(in crate::resolve) fn camera(&mut self, object: &'a Object, env: &Env<'a>) {
        let block = schema::block("camera").expect("declared in the registry");
        let fields = self.read(block, object.kind.span, &object.body, env);
        self.scene.intent.camera.get_or_insert(object.span);
        self.unique_camera(object);
        if let Some(camera) = self.camera_of(&fields, object) {
            self.scene.cameras.push(camera);
        }
    }

    /// Two cameras need two names.
    fn unique_camera(&mut self, object: &'a Object) {
        let name = object.second.as_ref().map(|name| name.value.as_str());
        let same = |camera: &&Camera| camera.name.as_ref().map(|name| name.value.as_str()) == name;
        let Some(first) = self.scene.cameras.iter().find(same).map(|camera| camera.span) else { return };
        self.report(Error::SecondBlock { kind: "camera", second: object.kind.span, first });
    }

    fn camera_of(&mut self, fields: &Fields<'a>, object: &'a Object) -> Option<Camera> {
        let transform = steps_of(fields.value("transform").map(|slot| &slot.value));
        let moved = compose(&transform);
        let place = |p: DVec3| if transform.is_empty() { p } else { moved.transform_point3(p) };
        let turn = |v: DVec3| if transform.is_empty() { v } else { moved.transform_vector3(v) };
        let position = fields.triple("position")?.value;
        let towards = fields.triple("look_at").map(|target| target.map(|target| target - position));
        let direction = towards.or_else(|| fields.triple("direction"));
        let mut lens = match fields.value("lens").map(|slot| &slot.value) {
            Some(Value::Lens(lens)) => (**lens).clone(),
            _ => Lens::Pinhole { focal_length: None, shift: DVec2::ZERO },
        };
        // A lens that is told nothing is sharp where the camera looks.
        if let (
            Lens::Thin { focus: focus @ None, .. } | Lens::Prescription { focus: focus @ None, .. },
            Some(target),
        ) = (&mut lens, fields.triple("look_at"))
        {
            *focus = Some(target.map(place).map(Focus::Point));
        }
        Some(Camera {
            name: object.second.clone(),
            position: fields.triple("position")?.map(place),
            // What could not be read is as good as straight ahead.
            direction: direction.unwrap_or(Spanned::new(DVec3::NEG_Z, fields.head)).map(turn),
            up: fields.triple("up")?.map(turn),
            fov: self.fov(fields, &lens),
            lens,
            film: self.film(fields)?,
            shutter: fields.number("shutter")?,
            transform: transform.to_vec(),
            span: object.span,
        })
    }

    fn fov(&mut self, fields: &Fields<'a>, lens: &Lens) -> Option<Spanned<Fov>> {
        let focal_length = lens.focal_length();
        let name = ["fov", "fov_x"].into_iter().find(|name| fields.has(name));
        if !lens.has_fov() {
            if let Some((name, lens)) = name.zip(fields.span("lens")) {
                let (one, other, first) = (name.to_owned(), "lens".to_owned(), fields.span(name)?);
                let help = "this lens has a view of its own: leave the field of view out".to_owned();
                self.report(Error::ConflictingFields { help, one, other, first, second: lens });
            }
            return None;
        }
        match (name, focal_length) {
            (Some(name), Some(length)) => {
                let (one, other) = (name.to_owned(), "focal_length".to_owned());
                let first = fields.span(name)?;
                let help = "keep one of them".to_owned();
                self.report(Error::ConflictingFields { help, one, other, first, second: length.span });
                None
            }
            (Some("fov_x"), None) => fields.number("fov_x").map(|angle| angle.map(Fov::Horizontal)),
            (None, Some(_)) => None,
            (_, None) => fields
                .number("fov")
                .map(|angle| angle.map(Fov::Vertical))
                .or(Some(Spanned::new(Fov::Vertical(std::f64::consts::FRAC_PI_4), fields.head))),
        }
    }

    /// A lens of a block.
    pub(super) fn lens(&mut self, fields: &Fields<'a>) -> Option<Lens> {
        match fields.block.kind {
            "orthographic" => {
                let height = fields.number("height").map(|size| Lens::Orthographic { size, is_width: false });
                return height
                    .or_else(|| Some(Lens::Orthographic { size: fields.number("width")?, is_width: true }));
            }
            "panorama" => {
                let (width, height) = (fields.number("width")?, fields.number("height")?);
                return Some(Lens::Panorama { width, height });
            }
            "fisheye" => return fisheye(fields),
            "prescription" => {
                let (file, aperture) = (fields.text("file")?, fields.number("aperture"));
                return Some(Lens::Prescription { file, aperture, focus: focus(fields) });
            }
            _ => {}
        }
        let focal_length = fields.number("focal_length");
        let shift = fields.triple("shift")?.value.truncate();
        if fields.block.kind == "pinhole" {
            return Some(Lens::Pinhole { focal_length, shift });
        }
        Some(Lens::Thin {
            focal_length,
            radius: opening(fields, focal_length)?,
            focus: focus(fields),
            blades: fields.count("blades")?,
            rotation: fields.number("rotation")?,
            anamorphic: fields.number("anamorphic")?,
            cat_eye: fields.number("cat_eye")?,
            shift,
            tilt: [fields.number("tilt")?, fields.number("swing")?],
        })
    }

    /// The steps of exposure of `photo { .. }`: what saturates its film becomes 1.
    ///
    /// The luminance that does is 1.2 · 2^EV cd/m² at ISO 100 (ISO 12232, saturation-based speed, lens factor 0.65), and
    /// EV = log₂(N²/t · 100/S).
    pub(in crate::resolve) fn photo(&mut self, object: &'a Object, env: &Env<'a>) -> Value<'a> {
        const LUMENS_A_WATT: f64 = 683.0;
        let block = schema::block("photo").expect("declared in the registry");
        let fields = self.read(block, object.kind.span, &object.body, env);
        let number = |name| fields.number(name).map(|number| number.value);
        let by_settings = || {
            let (stop, time, iso) = (number("f_stop")?, number("time")?, number("iso")?);
            Some(libm::log2(stop * stop / time * 100.0 / iso))
        };
        match number("ev").or_else(by_settings) {
            Some(ev) if !fields.poisoned => {
                Value::Number(Quantity::new(libm::log2(LUMENS_A_WATT / 1.2) - ev, Dimension::EXPOSURE))
            }
            _ => Value::Poison,
        }
    }

    fn film(&mut self, camera: &Fields<'a>) -> Option<Film> {
        let block = schema::block("film").expect("declared in the registry");
        let empty;
        let fields = match camera.nested("film") {
            Some(fields) => fields,
            None => {
                empty = Fields::empty(block, camera.head);
                &empty
            }
        };
        let size = match fields.value("size") {
            Some(Spanned { value: Value::Size(width, height), span }) => {
                Spanned::new((*width, *height), *span)
            }
            _ => fields.size("size")?,
        };
        let filter = match fields.value("filter") {
            Some(Spanned { value: Value::Filter(filter), span }) => Spanned::new(*filter, *span),
            _ => Spanned::new(Filter::Tent(1.0), fields.head),
        };
        let exposure = match fields.value("exposure") {
            Some(Spanned { value: Value::Word(_), span }) => Spanned::new(Exposure::Auto, *span),
            _ => fields.number("exposure")?.map(Exposure::Ev),
        };
        let tone = fields.word("tone")?.map(|tone| match tone {
            "linear" => Tone::Linear,
            "reinhard" => Tone::Reinhard,
            "agx" => Tone::Agx,
            _ => Tone::Srgb,
        });
        let crop = fields.nested("crop").and_then(|crop| {
            let edge = |name| crop.number(name).map(|edge| edge.value);
            let edges = [edge("left")?, edge("top")?, edge("right")?, edge("bottom")?];
            Some(Spanned::new(edges, fields.span("crop")?))
        });
        let pixel_aspect = fields.number("pixel_aspect")?;
        Some(Film { size, crop, filter, pixel_aspect, sensor: fields.number("sensor")?, exposure, tone })
    }
}

/// What a lens is focused on.
fn focus(fields: &Fields) -> Option<Spanned<Focus>> {
    match fields.value("focus") {
        Some(Spanned { value: Value::Focus(focus), span }) => Some(Spanned::new((**focus).clone(), *span)),
        _ => None,
    }
}

fn fisheye(fields: &Fields) -> Option<Lens> {
    let mapping = match fields.word("mapping")?.value {
        "equisolid" => Mapping::EquisolidAngle,
        "stereographic" => Mapping::Stereographic,
        "orthographic" => Mapping::Orthographic,
        _ => Mapping::Equidistant,
    };
    let full = fields.word("frame")?.value == "full";
    Some(Lens::Fisheye { angle: fields.number("angle")?, mapping, full })
}

/// The radius of the opening: said, or the focal length by twice the f-number.
fn opening(fields: &Fields, focal_length: Option<Spanned<f64>>) -> Option<Spanned<f64>> {
    fields.number("radius").or_else(|| {
        let length = focal_length?.value;
        Some(fields.number("aperture")?.map(|n| length / (2.0 * n)))
    })
}
