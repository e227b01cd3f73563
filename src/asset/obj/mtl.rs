//! MTL, the material files of OBJ.
//!
//! MTL describes the terms of a shading formula; what they come to here: something shines (`Ke`), or is glass (`d` below a
//! half), or is matt (`Kd`) under a gloss (`Ks`, `Ns`), or is the metallic-roughness model (`Pr`, `Pm`), with holes (`d`,
//! `map_d`) and bent normals (`norm`).

use super::text::{Lines, float, in_utf8, name};
use crate::asset::look::{GlassLook, Look, Map, MapChannel, MapWrap, PrincipledLook, Shade};
use crate::asset::model::{ModelPicture, PictureSource};
use crate::asset::report::{About, ImportReport};
use crate::math::Rgb;
use std::collections::HashMap;

/// The albedo of what says nothing about its colour.
const GRAY: [f32; 3] = [0.5; 3];
/// The refractive index of something transparent that states none.
const GLASS_IOR: f32 = 1.5;

/// The materials of all MTL files of a mesh.
#[derive(Default)]
pub(super) struct Library {
    entries: HashMap<String, Entry>,
    /// The pictures that they name.
    pub(super) pictures: Vec<ModelPicture>,
}

/// What a file says of a material.
#[derive(Default)]
struct Entry {
    diffuse: Option<[f32; 3]>,
    specular: Option<[f32; 3]>,
    emission: Option<[f32; 3]>,
    shininess: Option<f32>,
    ior: Option<f32>,
    opacity: Option<f32>,
    roughness: Option<f32>,
    metallic: Option<f32>,
    diffuse_map: Option<Map>,
    opacity_map: Option<Map>,
    normal_map: Option<(Map, f32)>,
}

/// The bytes of a material file: one of the name as written, or of its first word, for a line may name several.
pub(super) fn open(file: &str, open: &dyn Fn(&str) -> Result<Vec<u8>, String>) -> Result<Vec<u8>, String> {
    let slashed = file.replace('\\', "/");
    open(file).or_else(|reason| if slashed == file { Err(reason) } else { open(&slashed) })
}

impl Library {
    /// Whether a file describes this material.
    pub(super) fn knows(&self, name: &str) -> bool {
        self.entries.contains_key(name)
    }

    /// Whether no file describes anything.
    pub(super) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// What a material comes to.
    pub(super) fn look(&self, name: &str) -> Option<Look> {
        self.entries.get(name).map(Entry::look)
    }

    /// Reads one more file.
    pub(super) fn read(&mut self, bytes: &[u8], report: &mut ImportReport) {
        let bytes = in_utf8(bytes);
        let (mut lines, mut current) = (Lines::new(&bytes), None);
        while let Some((number, line)) = lines.next() {
            let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            let Some(keyword) = words.next().filter(|word| word[0] != b'#') else { continue };
            if keyword == b"newmtl" {
                let name = name(&line, keyword);
                self.entries.insert(name.clone(), Entry::default());
                current = Some(name);
                continue;
            }
            let Some(material) = current.clone() else { continue };
            let said = String::from_utf8_lossy(keyword).into_owned();
            let mut entry = self.entries.remove(&material).unwrap_or_default();
            if let Err(trouble) = self.line(&mut entry, &said, &line, report) {
                let place = format!("`{said}` of the material `{material}` (line {number})");
                report.left_out(About::Material, format!("{place}, which {trouble}"));
            }
            self.entries.insert(material, entry);
        }
    }

    fn line(
        &mut self,
        entry: &mut Entry,
        keyword: &str,
        line: &[u8],
        report: &mut ImportReport,
    ) -> Result<(), &'static str> {
        let words = || line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).skip(1);
        let number = || words().next().and_then(float).filter(|x| x.is_finite()).ok_or("needs a number");
        match keyword {
            "Kd" => entry.diffuse = Some(color(words())?),
            "Ks" => entry.specular = Some(color(words())?),
            "Ke" => entry.emission = Some(color(words())?),
            "Ns" => entry.shininess = Some(number()?),
            "Ni" => entry.ior = Some(number()?),
            "d" => entry.opacity = Some(number()?),
            "Tr" => entry.opacity = Some(1.0 - number()?),
            "Pr" => entry.roughness = Some(number()?),
            "Pm" => entry.metallic = Some(number()?),
            "map_Kd" | "map_kd" => entry.diffuse_map = Some(self.map(line, keyword, report)?.0),
            "map_d" => {
                let map = self.map(line, keyword, report)?.0;
                entry.opacity_map = Some(map.only(MapChannel::Red));
            }
            "norm" | "map_Kn" => entry.normal_map = Some(self.map(line, keyword, report)?),
            // What the lights around do is simulated, and which terms count is seen from the numbers.
            "Ka" | "map_Ka" | "illum" | "sharpness" | "Tf" if keyword != "Tf" => {}
            "Tf" if color(words()).is_ok_and(|tf| tf == [1.0; 3] || tf == [0.0; 3]) => {}
            _ => report.ignored(About::Material, format!("`{keyword}` of materials")),
        }
        Ok(())
    }

    /// A picture with its options, and the factor on its relief.
    fn map(
        &mut self,
        line: &[u8],
        keyword: &str,
        report: &mut ImportReport,
    ) -> Result<(Map, f32), &'static str> {
        let text = name(line, keyword.as_bytes());
        let (mut rest, mut map, mut strength) = (text.as_str(), Map::plain(0), 1.0);
        while rest.starts_with('-') {
            let (option, mut after) = word(rest);
            let mut values = Vec::new();
            let most = OPTIONS.iter().find(|(name, _)| *name == option).map_or(0, |(_, most)| *most);
            while values.len() < most {
                let (value, further) = word(after);
                let is_word = values.is_empty() && !matches!(option, "-o" | "-s" | "-t");
                if value.is_empty() || !is_word && value.parse::<f32>().is_err() {
                    break;
                }
                values.push(value);
                after = further;
            }
            let number = |i: usize, or: f32| {
                values.get(i).and_then(|v| v.parse().ok()).filter(|x: &f32| x.is_finite()).unwrap_or(or)
            };
            match option {
                "-s" => map.uv_scale = [number(0, 1.0), number(1, 1.0)],
                "-o" => map.uv_offset = [number(0, 0.0), number(1, 0.0)],
                "-clamp" if values.first() == Some(&"on") => map.wrap = MapWrap::Clamp,
                "-bm" => strength = number(0, 1.0),
                "-clamp" | "-type" | "-texres" => {}
                _ => report.ignored(About::Material, format!("`{option}` of pictures")),
            }
            rest = after;
        }
        if rest.is_empty() {
            return Err("names no picture");
        }
        map.picture = self.picture(&rest.replace('\\', "/"));
        Ok((map, strength))
    }

    fn picture(&mut self, file: &str) -> usize {
        if let Some(known) = self.pictures.iter().position(|picture| picture.name == file) {
            return known;
        }
        let source = PictureSource::File(file.to_owned());
        self.pictures.push(ModelPicture { name: file.to_owned(), source });
        self.pictures.len() - 1
    }
}

/// Options of pictures, and how many values each takes at most.
const OPTIONS: [(&str, usize); 13] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-bm", 1),
    ("-boost", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-o", 3),
    ("-s", 3),
    ("-t", 3),
    ("-texres", 1),
    ("-type", 1),
];

/// The first word, and what follows it.
fn word(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (&text[..end], text[end..].trim_start())
}

/// Three numbers, or one for all channels.
fn color<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<[f32; 3], &'static str> {
    let mut next = || words.next().and_then(float);
    let red = next().ok_or("needs three numbers")?;
    let color = match (next(), next()) {
        (Some(green), Some(blue)) => [red, green, blue],
        _ => [red; 3],
    };
    if color.iter().all(|x| x.is_finite()) { Ok(color) } else { Err("needs finite numbers") }
}

impl Entry {
    fn look(&self) -> Look {
        let base = self.base();
        let base = match &self.normal_map {
            Some((map, strength)) => {
                Look::NormalMap { base: Box::new(base), map: map.clone(), strength: *strength }
            }
            None => base,
        };
        let opacity = self.opacity.unwrap_or(1.0);
        let is_glass = matches!(base.innermost(), Look::Glass(_));
        if base.shines() || is_glass || opacity >= 1.0 && self.opacity_map.is_none() {
            return base;
        }
        let opacity = Shade::number(opacity).times(self.opacity_map.clone());
        Look::Mask { base: Box::new(base), opacity, cutoff: None }
    }

    fn base(&self) -> Look {
        let lit = |written: Option<[f32; 3]>| {
            written.map(Rgb::from).filter(|c| c.is_valid() && !c.is_black()).map(|c| c.to_array())
        };
        if let Some(radiance) = lit(self.emission) {
            return Look::Emissive { radiance };
        }
        if self.opacity_map.is_none() && self.opacity.is_some_and(|opacity| opacity < 0.5) {
            let ior = self.ior.filter(|ior| *ior >= 1.0).unwrap_or(GLASS_IOR);
            let (roughness, tint) = (Shade::number(0.0), [1.0; 3]);
            return Look::Glass(GlassLook {
                ior,
                roughness,
                tint,
                attenuation: None,
                abbe: None,
                thin: false,
            });
        }
        let diffuse = self.diffuse_shade();
        if self.roughness.is_some() || self.metallic.is_some() {
            return Look::Principled(Box::new(PrincipledLook {
                emission_map: None,
                color: diffuse,
                metallic: Shade::number(self.metallic.unwrap_or(0.0)),
                roughness: Shade::number(self.roughness.unwrap_or(0.5)),
                transmission: Shade::number(0.0),
                ior: self.ior.filter(|ior| (1.0..=4.0).contains(ior)).unwrap_or(GLASS_IOR),
                clearcoat: Shade::number(0.0),
                clearcoat_roughness: Shade::number(0.0),
                emission: [0.0; 3],
            }));
        }
        match (lit(self.specular), self.shininess) {
            (Some(specular), Some(shininess)) if shininess >= 1.0 => Look::Phong {
                diffuse,
                specular: specular.map(|x| x.clamp(0.0, 1.0)),
                shininess: shininess.min(1e5),
            },
            _ => Look::Diffuse { color: diffuse },
        }
    }

    /// The colour, or the picture alone: exporters write any colour beside one.
    fn diffuse_shade(&self) -> Shade {
        let color = Shade::color(self.diffuse.unwrap_or(GRAY));
        match &self.diffuse_map {
            Some(map) => Shade { factor: [1.0; 3], map: Some(map.clone()), ..color },
            None => color,
        }
    }
}
