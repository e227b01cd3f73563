//! Textures of glTF: pictures, and how they lie on things.
//!
//! glTF counts v downwards from the upper edge, Snell upwards from the lower; the texture points are turned over as they
//! are read, so the transforms of KHR_texture_transform are turned over with them.

use super::access::Buffers;
use super::container::{Uri, uri};
use super::json::At;
use crate::asset::look::{Map, MapWrap};
use crate::asset::model::{MeshError, ModelPicture, PictureSource};
use crate::asset::report::{About, ImportReport};

/// The pictures of a file, and which texture points the material at hand looks up.
pub(super) struct Textures<'a, 'b> {
    root: At<'a>,
    buffers: &'b Buffers<'a>,
    uv_set: Option<u32>,
    /// One for each of the file's images that is looked up, with the image's index.
    images: Vec<usize>,
    pub(super) pictures: Vec<ModelPicture>,
}

impl<'a, 'b> Textures<'a, 'b> {
    pub(super) fn new(root: At<'a>, buffers: &'b Buffers<'a>) -> Self {
        Self { root, buffers, uv_set: None, images: Vec::new(), pictures: Vec::new() }
    }

    /// Forgets which texture points the material before looked up.
    pub(super) fn begin_material(&mut self) {
        self.uv_set = None;
    }

    /// The set of texture points that the material looks up.
    pub(super) fn uv_set(&self) -> u32 {
        self.uv_set.unwrap_or(0)
    }

    /// The picture that a field names; `None` if there is none, or none that can be used.
    pub(super) fn map(
        &mut self,
        at: &At<'_>,
        name: &str,
        report: &mut ImportReport,
    ) -> Result<Option<Map>, MeshError> {
        let Some(info) = at.get(name) else { return Ok(None) };
        match self.read(&info, report) {
            Ok(map) => Ok(map),
            Err(error) => {
                report.left_out(About::Material, format!("a picture, as {error}"));
                Ok(None)
            }
        }
    }

    fn read(&mut self, info: &At<'_>, report: &mut ImportReport) -> Result<Option<Map>, MeshError> {
        let texture = info.refer("index", &self.root, "textures")?;
        let texture = self.root.element("textures", texture.ok_or_else(|| info.wrong("has no `index`"))?)?;
        let transform = info.extension("KHR_texture_transform");
        let set = match transform.as_ref().map(|at| at.whole("texCoord")).transpose()?.flatten() {
            Some(set) => Some(set),
            None => info.whole("texCoord")?,
        };
        let set = set.unwrap_or(0).min(u64::from(u32::MAX)) as u32;
        if *self.uv_set.get_or_insert(set) != set {
            report
                .approximated(About::Material, "pictures on another set of texture points, on the first one");
        }
        let Some(image) = texture.refer("source", &self.root, "images")? else {
            let how = texture.extensions().join(", ");
            let how = if how.is_empty() { "no picture".to_owned() } else { how };
            report.ignored(About::Material, format!("textures with {how}, which is not read"));
            return Ok(None);
        };
        let mut map = Map::plain(self.picture(image)?);
        if let Some(sampler) = texture.refer("sampler", &self.root, "samplers")? {
            self.sample(&self.root.element("samplers", sampler)?, &mut map, report)?;
        }
        if let Some(transform) = transform {
            report.used(About::Material, "KHR_texture_transform");
            turn_over(&transform, &mut map)?;
        }
        Ok(Some(map))
    }

    fn sample(&self, at: &At<'_>, map: &mut Map, report: &mut ImportReport) -> Result<(), MeshError> {
        let wrap = |name: &str| {
            Ok(match at.whole(name)? {
                None | Some(10_497) => MapWrap::Repeat,
                Some(33_071) => MapWrap::Clamp,
                Some(33_648) => MapWrap::Mirror,
                Some(_) => return Err(at.wrong(format!("has an unknown `{name}`"))),
            })
        };
        let (across, along) = (wrap("wrapS")?, wrap("wrapT")?);
        if across != along {
            let text = "pictures that go on differently across and along, by the first";
            report.approximated(About::Material, text);
        }
        map.wrap = across;
        map.is_blended = at.whole("magFilter")? != Some(9728);
        Ok(())
    }

    fn picture(&mut self, image: usize) -> Result<usize, MeshError> {
        if let Some(known) = self.images.iter().position(|known| *known == image) {
            return Ok(known);
        }
        let at = self.root.element("images", image)?;
        let called = at.name().map_or_else(|| format!("picture {image}"), str::to_owned);
        let picture = match at.text("uri")? {
            Some(text) => match uri(text) {
                Ok(Uri::File(name)) => ModelPicture { name: name.clone(), source: PictureSource::File(name) },
                Ok(Uri::Data(bytes)) => {
                    ModelPicture { name: called, source: PictureSource::Bytes(bytes.into()) }
                }
                Err(reason) => ModelPicture { name: called, source: PictureSource::Nowhere(reason) },
            },
            None => {
                let view = at.refer("bufferView", &self.root, "bufferViews")?;
                let view = self.buffers.view(view.ok_or_else(|| at.wrong("has no bytes"))?)?;
                ModelPicture { name: called, source: PictureSource::Bytes(view.as_slice().into()) }
            }
        };
        self.images.push(image);
        self.pictures.push(picture);
        Ok(self.pictures.len() - 1)
    }
}

/// Takes a transform over to texture points whose v goes upwards.
///
/// With (u, v) ↦ (u, 1 − v) on both sides, scale s, turn θ and offset o become s, θ and
/// (oᵤ + sᵥ sin θ, 1 − oᵥ − sᵥ cos θ): the same turn, seen in a picture that stands upright.
fn turn_over(at: &At<'_>, map: &mut Map) -> Result<(), MeshError> {
    let offset = at.numbers::<2>("offset")?.unwrap_or([0.0; 2]);
    let scale = at.numbers::<2>("scale")?.unwrap_or([1.0; 2]);
    let turn = at.number("rotation")?.unwrap_or(0.0);
    if offset.iter().chain(&scale).chain([&turn]).any(|x| x.abs() > 1e9) {
        return Err(at.wrong("moves pictures out of sight"));
    }
    let (sin, cos) = libm::sincos(turn);
    map.uv_scale = scale.map(|x| x as f32);
    map.uv_rotation = turn as f32;
    map.uv_offset = [offset[0] + scale[1] * sin, 1.0 - offset[1] - scale[1] * cos].map(|x| x as f32);
    Ok(())
}
