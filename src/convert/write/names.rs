//! Names for materials and meshes, from what they look like and what their files are called.

use crate::convert::model::{Look, Pattern, Texture};
use crate::math::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Gives names that are unique in a file.
#[derive(Debug, Default)]
pub struct Names {
    taken: BTreeSet<String>,
    /// How often each name was wished for.
    wishes: BTreeMap<String, usize>,
}

impl Names {
    /// `wish`, or `wish_2`, `wish_3`, .. if it is taken.
    pub fn unique(&mut self, wish: &str) -> String {
        let count = self.wishes.entry(wish.into()).or_default();
        loop {
            *count += 1;
            let name = if *count == 1 { wish.to_string() } else { format!("{wish}_{count}") };
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// A name for a material. All of them have an underscore, so none hides a colour, a block or a keyword.
pub fn of_look(look: &Look, index: usize) -> String {
    match look {
        Look::Diffuse { color } => surface("matte", color),
        Look::Phong { diffuse, .. } => surface("glossy", diffuse),
        Look::Whitted { transmission, diffuse, .. } if *transmission != DVec3::ZERO => {
            surface("clear", diffuse)
        }
        Look::Whitted { specular: DVec3::ZERO, diffuse, .. } => surface("matte", diffuse),
        Look::Whitted { diffuse, .. } => surface("glossy", diffuse),
        Look::Metal { color, .. } => surface("metal", color),
        Look::Mirror { color } => match hue(color.color) {
            None if color.color.max_element() > 0.8 => "silver_mirror".into(),
            None => format!("{}_mirror", grey(color.color.max_element())),
            Some("orange" | "yellow") => "gold_mirror".into(),
            Some(hue) => format!("{hue}_mirror"),
        },
        Look::Glass { tint, roughness, .. } => match hue(*tint) {
            None if tint.max_element() > 0.8 && *roughness > 0.0 => "frosted_glass".into(),
            None if tint.max_element() > 0.8 => "clear_glass".into(),
            None => format!("{}_glass", grey(tint.max_element())),
            Some(hue) => format!("{hue}_glass"),
        },
        Look::Emissive { radiance } => match hue(*radiance) {
            None => format!("light_{}", identifier(&super::text::rounded(radiance.max_element()))),
            Some(hue) => format!("{hue}_light"),
        },
        Look::Mix(lobes) => {
            let colors =
                lobes.iter().filter_map(|(_, lobe)| lobe.clone().textures().into_iter().next().cloned());
            surface("mixed", &colors.into_iter().next().unwrap_or(Texture::plain(DVec3::ONE)))
        }
        Look::Solid { pattern, .. } => match pattern {
            Some(Pattern::Checker { .. }) => "chequered_blend".into(),
            Some(Pattern::Noise { .. }) => "cloudy_blend".into(),
            Some(Pattern::Marble { .. }) => "marble_blend".into(),
            Some(Pattern::Wood { .. }) => "wood_blend".into(),
            None => "even_blend".into(),
        },
        Look::Placeholder => format!("unread_{index}"),
    }
}

/// A name for the mesh in a file: `mesh/ball1.obj` is `ball1_mesh`.
pub fn of_mesh(path: &str) -> String {
    match stem(path) {
        stem if stem.starts_with(|c: char| c.is_ascii_digit()) => format!("mesh_{stem}"),
        stem => format!("{stem}_mesh"),
    }
}

fn surface(kind: &str, texture: &Texture) -> String {
    match &texture.picture {
        Some(picture) => format!("{kind}_{}", stem(&picture.path)),
        None => format!("{kind}_{}", color_name(texture.color)),
    }
}

fn color_name(color: DVec3) -> String {
    let Some(hue) = hue(color) else { return grey(color.max_element()) };
    let (most, least) = (color.max_element(), color.min_element());
    if most < 0.3 {
        format!("dark_{hue}")
    } else if least > 0.65 * most {
        format!("pale_{hue}")
    } else {
        hue.into()
    }
}

/// `black`, `white`, or the percentage in between.
fn grey(value: f64) -> String {
    let percent = (100.0 * value).round();
    match percent {
        p if p < 1.0 => "black".into(),
        p if p > 98.0 => "white".into(),
        p => format!("grey_{p:.0}"),
    }
}

/// The hue's name, by its angle in the colour circle; `None` for colours without one.
fn hue(color: DVec3) -> Option<&'static str> {
    let (most, least) = (color.max_element(), color.min_element());
    let spread = most - least;
    if spread <= 0.08 * most {
        return None;
    }
    let sixth = if most == color.x {
        (color.y - color.z) / spread
    } else if most == color.y {
        2.0 + (color.z - color.x) / spread
    } else {
        4.0 + (color.x - color.y) / spread
    };
    let degrees = (60.0 * sixth).rem_euclid(360.0);
    const NAMES: [(f64, &str); 9] = [
        (15.0, "red"),
        (42.0, "orange"),
        (70.0, "yellow"),
        (165.0, "green"),
        (195.0, "cyan"),
        (260.0, "blue"),
        (290.0, "violet"),
        (345.0, "pink"),
        (360.0, "red"),
    ];
    NAMES.iter().find(|(end, _)| degrees <= *end).map(|(_, name)| *name)
}

/// The file's name without folder and ending.
fn stem(path: &str) -> String {
    let file = path.rsplit('/').next().unwrap_or(path);
    identifier(file.rsplit_once('.').map_or(file, |(stem, _)| stem))
}

/// The text with everything that cannot stand in a name replaced; Snell's names are ASCII.
pub fn identifier(text: &str) -> String {
    let fits = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let name: String = text.chars().map(fits).collect();
    if name.is_empty() { "unnamed".into() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_what_a_material_looks_like() {
        let name = |look| of_look(&look, 0);
        let glass = |r, g, b| Look::Glass { ior: 1.5, tint: DVec3::new(r, g, b), roughness: 0.0 };
        assert_eq!(name(glass(0.93, 0.07, 0.04)), "red_glass");
        assert_eq!(name(glass(0.999, 0.999, 0.999)), "clear_glass");
        assert_eq!(name(Look::Emissive { radiance: DVec3::splat(12.0) }), "light_12");
        assert_eq!(name(Look::Mirror { color: Texture::plain(DVec3::new(0.97, 0.6, 0.08)) }), "gold_mirror");
        assert_eq!(name(Look::Diffuse { color: Texture::plain(DVec3::splat(0.8)) }), "matte_grey_80");
        assert_eq!(of_mesh("models/3d-cube.obj"), "mesh_3d_cube");
    }

    #[test]
    fn no_name_is_given_twice() {
        let mut names = Names::default();
        let given = ["a", "a_2", "a", "a", "b"].map(|wish| names.unique(wish));
        assert_eq!(given, ["a", "a_2", "a_3", "a_4", "b"]);
    }
}
