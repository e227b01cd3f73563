//! What a block is, by its name. Programs name what they add as they like, so a part of the name decides:
//! `DielecMaterial` and `RoughGlass` are glass.

use super::normalised;

/// Blocks of the top level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Top {
    Camera,
    Background,
    /// A cube of pictures around everything.
    Sky,
    Lights,
    Materials,
    Textures,
    Group,
    Settings,
    /// An object that stands outside every group.
    Object,
}

/// Kinds of material blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Material {
    /// `Material` and `PhongMaterial`: its fields tell.
    Plain,
    Diffuse,
    Glossy,
    Mirror,
    Metal,
    Glass,
    Light,
    Solid(Solid),
}

/// Solid textures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solid {
    Checkerboard,
    Noise,
    Marble,
    Wood,
}

/// Kinds of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Object {
    Group,
    Transform,
    Sphere,
    Plane,
    Triangle,
    Mesh,
    Quad,
    Disk,
    Box,
    Cylinder,
    Torus,
    Revolve,
    /// A curve, which has no surface.
    Curve,
    /// A participating medium.
    Medium,
    /// Bounds of a data structure.
    Grid,
    /// A surface by a formula of one program.
    Formula,
    /// A curved patch over a net of control points.
    Patch,
    /// Objects that are bent with a cage around them.
    Cage,
    /// Pictures all around.
    Sky,
}

/// The first row with a part of the name.
fn by_part<T: Copy>(name: &str, table: &[(&str, T)]) -> Option<T> {
    let name = normalised(name);
    let has = |parts: &str| parts.split(' ').any(|part| name.contains(part));
    table.iter().find(|(parts, _)| has(parts)).map(|(_, kind)| *kind)
}

/// What a block of the top level is.
pub fn top(name: &str) -> Option<Top> {
    let table = [
        ("camera", Top::Camera),
        ("light", Top::Lights),
        ("material", Top::Materials),
        ("texture", Top::Textures),
        ("background", Top::Background),
        ("sky environment", Top::Sky),
        ("group object", Top::Group),
        ("model photon render setting integrator tracer option", Top::Settings),
    ];
    if name == "Group" {
        return Some(Top::Group);
    }
    by_part(name, &table).or_else(|| object(name).map(|_| Top::Object))
}

/// What a block in `Materials` is.
pub fn material(name: &str) -> Option<Material> {
    if ["Material", "PhongMaterial"].contains(&name) {
        return Some(Material::Plain);
    }
    let table = [
        ("checker", Material::Solid(Solid::Checkerboard)),
        ("marble", Material::Solid(Solid::Marble)),
        ("wood", Material::Solid(Solid::Wood)),
        ("noise perlin", Material::Solid(Solid::Noise)),
        ("light emis lamp", Material::Light),
        ("glass refrac dielec transpar transmi fresnel water", Material::Glass),
        ("mirror reflec perfectspec", Material::Mirror),
        ("phongmaterial generic", Material::Plain), // before the glossy ones
        (
            "phong gloss plastic cook ward ggx microfacet uber principled disney blinn brdf bsdf pbr",
            Material::Glossy,
        ),
        ("metal conductor chrome steel gold silver copper", Material::Metal),
        ("lambert diffus matte", Material::Diffuse),
        ("material", Material::Plain),
    ];
    by_part(name, &table)
}

/// What a block in a `Group` is.
pub fn object(name: &str) -> Option<Object> {
    let table = [
        ("ffd lattice cage", Object::Cage),
        ("transform", Object::Transform),
        ("fog medium volume smoke", Object::Medium),
        ("revsurface revol lathe", Object::Revolve),
        ("patch beziersurface bsplinesurface nurbs", Object::Patch),
        ("skybox skydome skysphere", Object::Sky),
        ("curve", Object::Curve),
        ("parametric", Object::Formula),
        ("grid", Object::Grid),
        ("mesh tinyobj objfile", Object::Mesh),
        ("sphere ball movingobj", Object::Sphere),
        ("plane", Object::Plane),
        ("triangle", Object::Triangle),
        ("rectangle quad square parallelogram area", Object::Quad),
        ("disk disc circle", Object::Disk),
        ("cube cuboid box aabb", Object::Box),
        ("cylinder", Object::Cylinder),
        ("torus", Object::Torus),
        ("group objects", Object::Group),
    ];
    by_part(name, &table)
}

/// Whether an object belongs to the format of the course, so that nothing needs to be said of it.
pub fn is_usual_object(name: &str) -> bool {
    let usual = [
        "Group",
        "Transform",
        "Sphere",
        "Plane",
        "Triangle",
        "TriangleMesh",
        "RevSurface",
        "BezierCurve",
        "BsplineCurve",
    ];
    usual.contains(&name)
}
