//! Keys of materials, of all dialects at once: a key that two of them use differently takes what follows it freely, and
//! the reader decides by dialect and by the number of its values.

use super::Args::{Color, Flag, Free, Maybe, Numbers, Path};
use super::Values::{Nothing, Number, Vector, Word};
use super::{Index, Vocabulary, row, stem};

/// `Materials`.
pub static MATERIALS: Vocabulary = Vocabulary {
    rows: &[row("count", Numbers(1), "numMaterials num_materials")],
    stems: &[stem("count", Number, "num")],
    index: Index::new(),
};

/// One material. `diffuse`, `mirror` and `glass` are colours or shares of a lobe, or flags where nothing follows them.
pub static MATERIAL: Vocabulary = Vocabulary {
    rows: &[
        row(
            "color",
            Color,
            "color diffuseColor mColor albedo baseColor attenuation attenuationColor Kd base_color",
        ),
        row("diffuse", Maybe, "diff diffuse diff_factor w_diffusion diffuseRate perDiffuse diffidx rho_d"),
        row("diffuse factor", Free, "kd"),
        row("specular factor", Free, "ks"),
        row("specular", Color, "specularColor Ks F0"),
        row("specular or share", Maybe, "specular rho_s"),
        row("mirror", Color, "reflectiveColor reflectColor mirrorColor"),
        row(
            "mirror",
            Maybe,
            "refl reflect spec_factor w_reflection specularRate perReflect reflidx reflective \
             reflectiveCoefficient reflectance reflectivity",
        ),
        row("glass", Color, "transparentColor transmissiveColor refractColor transColor"),
        row(
            "glass",
            Maybe,
            "refract refr_factor w_transmission perRefract refridx refractiveCoefficient transmittance \
             transmissive transparent transparency",
        ),
        row(
            "emission",
            Color,
            "emission emissionColor emitColor light lightColor luminance Energy emittance emissive",
        ),
        row("ambient", Color, "ambientColor Ka ambient"),
        row("shininess", Numbers(1), "shininess exponent Ns"),
        row("roughness", Numbers(1), "roughness alpha alpha_g alpha_x alpha_y fuzz fuzziness FUZZ"),
        row("gloss", Numbers(1), "glossiness"),
        row("metallic", Numbers(1), "metallic metalness"),
        row("refr", Numbers(1), "refr"),
        row("refractRate", Numbers(1), "refractRate"),
        row(
            "index",
            Numbers(1),
            "refractive refractive_rate refractiveIndex refractionIndex refractive_index indexOfRefraction \
             refractIndex refraction_rate ref_index refIndex refrN reflectRate refractiveRate ior IOR Ni n N eta \
             iota index",
        ),
        row("refraction", Free, "refraction"),
        row("reflection", Free, "reflection"),
        row("type", Free, "type"),
        row("kind", Free, "surfaceType kind mode"),
        row("prop", Free, "prop"),
        row("DIFF", Flag, "DIFF DIFFUSE LAMBERT"),
        row("SPEC", Flag, "SPEC SPECULAR MIRROR METAL"),
        row("REFR", Flag, "REFR GLASS dielectric TRANSPARENT"),
        row("texture", Path, "texture texture_file albedoTexture diffuseTexture textureFile"),
        row("bump", Path, "bump bumps"),
        row(
            "normal map",
            Path,
            "normal normal_file normalMap nTexture normalTexture normal_texture normal_map",
        ),
        row("specular map", Path, "specularMap specularTexture"),
        row(
            "aside",
            Free,
            "absorb R0 d boost cookTorrence textDir textcoff textureScale textureSize \
             textureLuminance enableReflect enableRefract rate decay_rate dispersion cauchy subsurface tangent0 \
             materialType",
        ),
    ],
    stems: &[
        stem("REFR", Nothing, "refr trans glass dielec"),
        stem("SPEC", Nothing, "spec refl mirr"),
        stem("DIFF", Nothing, "diffus lamb matte"),
        stem("normal map", Word, "norm"),
        stem("bump", Word, "bump height disp"),
        stem("specular map", Word, "spec rough metal mask"),
        stem("texture", Word, "tex map image pic albedo diffuse color file"),
        stem("emission", Vector, "emi light lumin radian glow"),
        stem("glass", Vector, "refr trans"),
        stem("mirror", Vector, "refl mirror"),
        stem("specular", Vector, "spec"),
        stem("ambient", Vector, "amb"),
        stem("color", Vector, "col albedo diff base"),
        stem("index", Number, "index ior eta"),
        stem("glass", Number, "refr trans glass"),
        stem("mirror", Number, "refl mirror"),
        stem("roughness", Number, "rough fuzz alpha"),
        stem("shininess", Number, "shin expo"),
        stem("diffuse", Number, "diff"),
    ],
    index: Index::new(),
};

/// `Fresnel` inside a material: the share that is reflected, `fbase + fscale (1 - cos)^power`.
pub static FRESNEL: Vocabulary = Vocabulary {
    rows: &[
        row("base", Numbers(1), "fbase"),
        row("scale", Numbers(1), "fscale"),
        row("power", Numbers(1), "power"),
    ],
    stems: &[],
    index: Index::new(),
};

/// `Checkerboard`, `Noise`, `Marble` and `Wood`.
pub static SOLID: Vocabulary = Vocabulary {
    rows: &[
        row("material", Numbers(1), "materialIndex MaterialIndex"),
        row("color", Color, "color"),
        row("octaves", Numbers(1), "octaves"),
        row("frequency", Numbers(1), "frequency"),
        row("amplitude", Numbers(1), "amplitude"),
        row("size", Numbers(1), "size"),
    ],
    stems: &[],
    index: Index::new(),
};
