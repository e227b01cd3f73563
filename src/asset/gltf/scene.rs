//! A glTF file as a scene: what is placed where, and the cameras and lights, for whoever makes a scene of it.

use super::json::At;
use super::{MOST_PLACES, Pose, nodes, with_file};
use crate::asset::model::{MeshError, ModelMaterial, ModelPicture};
use crate::asset::report::{About, ImportReport};
use crate::math::DAffine3;

/// The scene of a file.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct SceneFile {
    /// What is placed, in the order of the nodes.
    pub placements: Vec<Placement>,
    /// The cameras.
    pub eyes: Vec<Eye>,
    /// The lights.
    pub lamps: Vec<Lamp>,
    /// The materials, by the index that placements have.
    pub materials: Vec<ModelMaterial>,
    /// The pictures, by the index that materials have.
    pub pictures: Vec<ModelPicture>,
    /// What was used, approximated, ignored and left out.
    pub report: ImportReport,
    /// The box around everything that is placed, in the world: lowest and highest corner.
    pub bounds: Option<(glam::DVec3, glam::DVec3)>,
}

/// A part of a mesh in its place.
#[derive(Clone, PartialEq, Debug)]
pub struct Placement {
    /// What the node is called.
    pub name: Option<String>,
    /// The name by which [`super::read`] finds the part.
    pub part: String,
    /// Index into the materials.
    pub material: Option<usize>,
    /// Where it is.
    pub world_from_mesh: DAffine3,
}

/// A camera in its place; it looks along −z.
#[derive(Clone, PartialEq, Debug)]
pub struct Eye {
    /// What it is called.
    pub name: Option<String>,
    /// Where it is.
    pub world_from_eye: DAffine3,
    /// What it sees.
    pub sight: Sight,
}

/// What a camera sees.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Sight {
    /// A perspective.
    Perspective {
        /// The vertical angle, in radians.
        fov: f64,
        /// Width over height.
        aspect: Option<f64>,
    },
    /// Parallel rays.
    Orthographic {
        /// Half of what it spans across and along, in metres.
        half: [f64; 2],
    },
}

/// A light in its place; it shines along −z.
#[derive(Clone, PartialEq, Debug)]
pub struct Lamp {
    /// What it is called.
    pub name: Option<String>,
    /// Where it is.
    pub world_from_lamp: DAffine3,
    /// Linear.
    pub color: [f64; 3],
    /// In lm/sr, or in lm/m² for a directional light.
    pub intensity: f64,
    /// Which.
    pub kind: LampKind,
}

/// The kinds of lights.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LampKind {
    /// In all directions.
    Point,
    /// From infinitely far.
    Directional,
    /// Within a cone.
    Spot {
        /// From the axis to where it begins to fade, in radians.
        inner: f64,
        /// From the axis to where it ends, in radians.
        outer: f64,
    },
}

/// Reads the scene of a glTF file; `open` gives the bytes of a file that it names, or says why there are none.
///
/// # Errors
/// [`MeshError`] with the place where that is known.
pub fn read_scene(
    bytes: &[u8],
    open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<SceneFile, MeshError> {
    with_file(bytes, open, |mut file| {
        let mut scene = SceneFile::default();
        let names: rustc_hash::FxHashMap<_, _> = file.names()?.into_iter().collect();
        let places = nodes::placed(&file.root, &mut file.report)?;
        let worlds = nodes::worlds(&places);
        let mut placed: Vec<(usize, Option<String>, DAffine3)> = Vec::new();
        for place in &places {
            let (node, world) = (&place.node, place.world_from_node);
            let name = node.name().map(str::to_owned);
            if let Some((mesh, pose, _)) = file.pose(place, &worlds) {
                if !pose.is_rest() {
                    let text = "skins and morph targets, by the mesh at rest";
                    file.report.approximated(About::Shape, text);
                }
                placed.push((mesh, name.clone(), world));
            }
            let eye = eye(&file.root, node)
                .map(|sight| sight.map(|sight| Eye { name: name.clone(), world_from_eye: world, sight }));
            scene.eyes.extend(told(eye, "a camera", &mut file.report));
            let lamp = lamp(&file.root, node, world, name);
            scene.lamps.extend(told(lamp, "a light", &mut file.report));
        }
        if places.is_empty() && file.root.count("nodes") == 0 {
            placed.extend((0..file.root.count("meshes")).map(|mesh| (mesh, None, DAffine3::IDENTITY)));
        }
        for (mesh, name, world_from_mesh) in placed {
            for number in 0..file.root.element("meshes", mesh)?.count("primitives") {
                let part_name = &names[&(mesh, number)];
                let Some(part) = file.primitive((mesh, number), part_name, &Pose::default()) else {
                    continue;
                };
                if scene.placements.len() >= MOST_PLACES {
                    return Err(MeshError::whole(format!("it places more than {MOST_PLACES} things")));
                }
                for p in &part.positions {
                    let p = world_from_mesh.transform_point3(p.as_dvec3());
                    let (low, high) = scene.bounds.unwrap_or((p, p));
                    scene.bounds = Some((low.min(p), high.max(p)));
                }
                scene.placements.push(Placement {
                    name: name.clone(),
                    part: part_name.clone(),
                    material: part.material,
                    world_from_mesh,
                });
            }
        }
        if scene.placements.is_empty() {
            return Err(file.nothing_left());
        }
        file.lost.report(&mut file.report);
        scene.materials = file.materials.into_iter().map(|read| read.material).collect();
        (scene.pictures, scene.report) = (file.pictures, file.report);
        Ok(scene)
    })
}

/// What came of reading something; what is wrong with it is told.
fn told<T>(found: Result<Option<T>, MeshError>, what: &str, report: &mut ImportReport) -> Option<T> {
    found.unwrap_or_else(|error| {
        report.left_out(About::File, format!("{what}, as {error}"));
        None
    })
}

fn eye(root: &At<'_>, node: &At<'_>) -> Result<Option<Sight>, MeshError> {
    let Some(index) = node.refer("camera", root, "cameras")? else { return Ok(None) };
    let camera = root.element("cameras", index)?;
    let need = |at: &At<'_>, name: &str| {
        at.number(name)?.filter(|x| *x > 0.0).ok_or_else(|| at.wrong(format!("needs a `{name}` above 0")))
    };
    Ok(Some(match camera.text("type")? {
        Some("perspective") => {
            let at = camera.need("perspective")?;
            let aspect = at.number("aspectRatio")?.filter(|aspect| (0.01..=100.0).contains(aspect));
            let fov = need(&at, "yfov")?;
            if fov >= std::f64::consts::PI {
                return Err(at.wrong("needs a `yfov` below π"));
            }
            Sight::Perspective { fov, aspect }
        }
        Some("orthographic") => {
            let at = camera.need("orthographic")?;
            Sight::Orthographic { half: [need(&at, "xmag")?, need(&at, "ymag")?] }
        }
        _ => return Err(camera.wrong("has no known `type`")),
    }))
}

fn lamp(
    root: &At<'_>,
    node: &At<'_>,
    world_from_lamp: DAffine3,
    name: Option<String>,
) -> Result<Option<Lamp>, MeshError> {
    const LIGHTS: &str = "KHR_lights_punctual";
    let (Some(at), Some(all)) = (node.extension(LIGHTS), root.extension(LIGHTS)) else { return Ok(None) };
    let index = at.whole("light")?.and_then(|index| usize::try_from(index).ok());
    let light = index.and_then(|index| all.nth("lights", index));
    let count = all.count("lights");
    let light = light.ok_or_else(|| at.wrong(format!("names no light of the {count} there are")))?;
    let kind = match light.text("type")? {
        Some("point") => LampKind::Point,
        Some("directional") => LampKind::Directional,
        Some("spot") => {
            let spot = light.need("spot")?;
            let outer = spot.number("outerConeAngle")?.unwrap_or(std::f64::consts::FRAC_PI_4);
            let outer = outer.clamp(1e-3, std::f64::consts::FRAC_PI_2);
            let inner = spot.number("innerConeAngle")?.unwrap_or(0.0).clamp(0.0, outer);
            LampKind::Spot { inner, outer }
        }
        _ => return Err(light.wrong("has no known `type`")),
    };
    let color = light.numbers::<3>("color")?.unwrap_or([1.0; 3]).map(|x| x.max(0.0));
    let intensity = light.number("intensity")?.unwrap_or(1.0).max(0.0);
    let name = light.name().map(str::to_owned).or(name);
    Ok(Some(Lamp { name, world_from_lamp, color, intensity, kind }))
}
