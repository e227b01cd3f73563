//! Small worlds with known answers.

use snell::math::{DAffine3, DMat3, DVec3, Rgb, Vec2, Vec3};
use snell::render::bsdf::{Glass, Input, Material};
use snell::render::camera::{Camera, CameraSpec, Filter};
use snell::render::film::Film;
use snell::render::shape::{MaterialId, Mesh, Solid, SolidKind, SourceId};
use snell::render::{Effects, Method, Parts, Settings, World, render};

/// A constant grey input.
pub fn gray(value: f32) -> Input {
    Input::Constant(Rgb::gray(value))
}

/// A constant colour.
pub fn color(r: f32, g: f32, b: f32) -> Input {
    Input::Constant(Rgb::new(r, g, b))
}

/// A diffuse material.
pub fn diffuse(albedo: f32) -> Material {
    Material::Diffuse { color: gray(albedo) }
}

/// A one-sided emitter.
pub fn emissive(radiance: f32) -> Material {
    Material::Emissive { radiance: Rgb::gray(radiance), two_sided: false }
}

/// A parallelogram with normal `u × v`.
pub fn quad(origin: Vec3, u: Vec3, v: Vec3, material: u32) -> Mesh {
    Mesh {
        positions: vec![origin, origin + u, origin + u + v, origin + v],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: None,
        uvs: Some(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]),
        material: MaterialId(material),
        object_from_world: DAffine3::IDENTITY,
        source: SourceId::default(),
    }
}

/// The six sides of a box, normals outwards, or inwards for a room.
pub fn cuboid(min: Vec3, max: Vec3, inwards: bool, material: u32) -> Vec<Mesh> {
    let size = max - min;
    let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
    let faces = [(min, y, x), (min, z, y), (min, x, z), (max, -x, -y), (max, -y, -z), (max, -z, -x)];
    let oriented =
        |(origin, u, v)| if inwards { quad(origin, v, u, material) } else { quad(origin, u, v, material) };
    faces.map(oriented).into()
}

/// A ball.
pub fn sphere(center: Vec3, radius: f64, material: u32) -> Solid {
    Solid {
        kind: SolidKind::Sphere,
        world_from_object: DAffine3::from_mat3_translation(
            DMat3::from_diagonal(DVec3::splat(radius)),
            center.as_dvec3(),
        ),
        texture_from_object: DAffine3::IDENTITY,
        material: MaterialId(material),
        source: SourceId::default(),
        motion: None,
    }
}

/// A square picture of `side` pixels, seen from `position` within a cone of 2·`tan` across.
pub fn camera(position: Vec3, direction: Vec3, tan: f32, side: u32) -> Camera {
    let up = if direction.cross(Vec3::Y).length() < 1e-3 * direction.length() { Vec3::Z } else { Vec3::Y };
    Camera::new(CameraSpec {
        position,
        direction,
        up,
        tan_half_fov_x: tan,
        tan_half_fov_y: tan,
        lens: None,
        width: side,
        height: side,
        filter: Filter::Box { radius: 0.5 },
        motion: None,
    })
}

/// A world of nothing but a camera.
pub fn empty(camera: Camera) -> Parts {
    Parts {
        meshes: Vec::new(),
        shared: Vec::new(),
        instances: Vec::new(),
        solids: Vec::new(),
        materials: Vec::new(),
        textures: Vec::new(),
        lights: Vec::new(),
        environment: None,
        camera,
        effects: Effects::ALL,
    }
}

/// The room of Cornell, 2 m wide, a lamp in its ceiling: a mirror ball and a glass ball, or two diffuse blocks.
pub fn cornell(side: u32, specular: bool) -> Parts {
    let mut parts = empty(camera(Vec3::new(0.0, 1.0, 3.9), Vec3::NEG_Z, 0.36, side));
    parts.materials = vec![
        diffuse(0.73),
        Material::Diffuse { color: color(0.63, 0.065, 0.05) },
        Material::Diffuse { color: color(0.14, 0.45, 0.091) },
        emissive(15.0),
        Material::Mirror { color: gray(0.95) },
        Material::Glass(Glass::of_ior(1.5)),
    ];
    let (x, y, z) = (Vec3::X * 2.0, Vec3::Y * 2.0, Vec3::Z * 2.0);
    let corner = Vec3::new(-1.0, 0.0, -1.0);
    parts.meshes = vec![
        quad(corner, z, x, 0),
        quad(corner + y, x, z, 0),
        quad(corner, x, y, 0),
        quad(corner, y, z, 1),
        quad(corner + x, z, y, 2),
        quad(Vec3::new(-0.25, 1.999, -0.25), Vec3::X * 0.5, Vec3::Z * 0.5, 3),
    ];
    if specular {
        parts.solids =
            vec![sphere(Vec3::new(-0.4, 0.4, -0.3), 0.4, 4), sphere(Vec3::new(0.4, 0.4, 0.3), 0.4, 5)];
    } else {
        parts.meshes.extend(cuboid(Vec3::new(-0.7, 0.0, -0.6), Vec3::new(-0.1, 1.2, 0.0), false, 0));
        parts.meshes.extend(cuboid(Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.7, 0.6, 0.6), false, 0));
    }
    parts
}

/// Path tracing for a number of passes.
pub fn path_tracing(passes: u32, max_depth: u32) -> Settings {
    Settings { seed: 1, ..Settings::new(Method::Pt, max_depth, passes) }
}

/// Renders by path tracing.
pub fn trace(parts: Parts, passes: u32, max_depth: u32) -> Film {
    render(&World::new(parts), &path_tracing(passes, max_depth), &()).film
}

/// The mean over all pixels of the mean channel.
pub fn mean(film: &Film) -> f64 {
    let pixels = film.mean();
    pixels.iter().map(|pixel| f64::from(pixel.mean())).sum::<f64>() / pixels.len() as f64
}
