//! What other languages and renderers call the things of this one.

use super::Type;

impl Type {
    /// What other languages call a type of this one: `float` is a `number`.
    pub fn foreign(name: &str) -> Option<&'static str> {
        Some(match name.to_ascii_lowercase().as_str() {
            "float" | "double" | "real" | "f32" | "f64" | "scalar" | "num" | "decimal" => "number",
            "integer" | "uint" | "u32" | "i32" | "i64" | "u64" | "usize" | "count" => "int",
            "boolean" | "flag" => "bool",
            "str" | "text" | "char" | "filename" => "string",
            "vec3" | "vector3" | "vec3f" | "float3" | "normal" | "direction" => "vector",
            "point3" | "point3f" | "position" | "location" => "point",
            "colour" | "rgb" | "color3" | "spectrum" => "color",
            "distance" | "metres" | "meters" => "length",
            "degrees" | "radians" => "angle",
            "seconds" | "duration" => "time",
            "watts" => "power",
            "kelvin" => "temperature",
            "bsdf" | "shader" => "material",
            "shape" | "solid" | "group" | "node" => "object",
            "matrix" | "mat4" | "matrix4" => "transform",
            "array" | "vec" | "tuple" => "list",
            _ => return None,
        })
    }

    /// What other renderers call one of these words.
    pub fn foreign_word(name: &str, words: &[&'static str]) -> Option<&'static str> {
        let ours = match name.to_ascii_lowercase().replace(['_', '-'], "").as_str() {
            "path" | "pathtracing" | "pathtracer" | "unidirectional" => "pt",
            "photonmapping" | "photonmap" | "photons" | "sppm" | "pm" => "ppm",
            "whitted" | "raytracing" | "raytracer" | "recursive" => "classic",
            "filmic" | "aces" => "agx",
            "gamma" | "standard" => "srgb",
            "none" | "raw" => "linear",
            "tile" | "wraparound" => "repeat",
            "edge" | "clamptoedge" => "clamp",
            "mirrored" | "mirroredrepeat" => "mirror",
            "bilinear" | "smooth" => "linear",
            "point" | "closest" => "nearest",
            "aluminum" | "al" => "aluminium",
            "ag" => "silver",
            "au" => "gold",
            "cu" => "copper",
            _ => return None,
        };
        words.iter().copied().find(|&word| word == ours)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_foreign_leads_to_what_is_known() {
        for name in ["float", "Vec3", "colour", "boolean", "mat4"] {
            let ours = Type::foreign(name).expect("a type elsewhere");
            assert!(Type::named(ours).is_some() && Type::named(name).is_none(), "`{name}`");
        }
        assert_eq!(Type::foreign_word("path_tracing", Type::METHODS), Some("pt"));
        assert_eq!(Type::foreign_word("path_tracing", &["srgb"]), None);
    }
}
