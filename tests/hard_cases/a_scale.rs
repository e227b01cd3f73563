//! Case 12 for all that the language has: every length times a power of two, and no bit of the picture changes.

use crate::support::*;
use snell::source::Memory;
use std::fmt::Write;

/// Lengths are multiples of `u`, and the powers of lamps of `w`.
const START: &str = "
snell 1
param s: number = 1
let u = s * 1m
let w = s * s * 1W
fn at(x: number, y: number, z: number) -> point { (x * u, y * u, z * u) }
fn by(x: number, y: number, z: number) -> transform { translate(x * u, y * u, z * u) }
";
const CAMERA: &str = "camera { position: at(0.3, 1, 4), look_at: at(0, 0.5, 0), fov: 40deg, FILM }";
const FILM: &str = "film: { size: 14 x 10 }";
const LAMP: &str = "light sphere { center: at(1, 3, 2), radius: 0.25 * u, radiance: 40 }";
const FLOOR: &str = "plane { y: 0m }";
const BALL: &str = "sphere { center: at(0, 0.5, 0), radius: 0.5 * u, material: plastic { color: #aa6633 } }";
const GLASS_BALL: &str =
    "sphere { center: at(0.75, 0.5, 0.5), radius: 0.25 * u, material: glass { ior: 1.5 } }";

const CAMERAS: [&str; 9] = [
    "lens: pinhole { focal_length: 50mm, shift: (0.1, 0.25) }",
    "lens: thin { focal_length: 50mm * s, radius: 0.0625 * u, focus: 4 * u }, film_of: s",
    "lens: thin { focal_length: 50mm * s, aperture: f/2.8, blades: 5, cat_eye: 0.5, anamorphic: 1.5, tilt: 3deg, swing: 2deg }, film_of: s",
    "lens: orthographic { height: 2.5 * u }",
    "lens: panorama {}",
    "lens: fisheye { angle: 170deg }",
    "lens: fisheye { angle: 120deg, mapping: stereographic, frame: full }",
    "lens: prescription { file: \"lens.dat\", aperture: f/4 }, film_of: s",
    "lens: prescription { file: \"lens.dat\", focus: 3 * u }, film_of: s",
];

const LIGHTS: [&str; 12] = [
    "light point { position: at(1, 3, 2), power: 60 * w }",
    "light spot { position: at(1, 3, 2), look_at: at(0, 0.5, 0), angle: 40deg, power: 40 * w }",
    "light sphere { center: at(1, 3, 2), radius: 0.25 * u, power: 60 * w }",
    "light rect { origin: at(0.5, 3, 1), edge_u: (0.75 * u, 0m, 0m), edge_v: (0m, 0m, 0.5 * u), power: 60 * w }",
    "light disk { center: at(1, 3, 1), radius: 0.25 * u, power: 60 * w, two_sided: true }",
    "light mesh { object: torus { center: at(0, 2, 0), radius: 0.5 * u, tube: 0.0625 * u }, power: 60 * w }",
    "light mesh { object: mesh { file: \"it.obj\", scale: s, transform: by(0, 2, 0) }, power: 60 * w }",
    "light directional { direction: (-0.4, -1, -0.3), irradiance: 2 }",
    "light sun_sky { elevation: 40deg, azimuth: 120deg }",
    "environment { radiance: image(\"it.ppm\") }",
    "environment { radiance: rgb(0.3, 0.4, 0.5) }",
    "cone { base: at(-1, 1.5, 0), height: 0.5 * u, radius: 0.25 * u, material: emissive { power: 30 * w } }",
];

const SHAPES: [&str; 22] = [
    "plane { normal: (0.1, 1, 0.2), offset: 0.25 * u, material: m }",
    "disk { center: at(0, 0.75, 0), normal: (0.3, 1, 0.5), radius: 0.75 * u, material: m }",
    "quad { origin: at(-1, 0.25, 0), edge_u: (2 * u, 0m, 0m), edge_v: (0m, 1 * u, -0.5 * u), material: m }",
    "box { center: at(0, 0.5, 0), size: (0.75 * u, 1 * u, 0.5 * u), material: m }",
    "triangle { a: at(-1, 0.1, 0), b: at(1, 0.2, 0.3), c: at(0, 1.5, -0.2), material: m }",
    "sphere { radius: 0.5 * u, transform: scale(1, 1.5, 0.7) then rotate_z(30deg) then by(0, 0.75, 0), material: m }",
    "cylinder { base: at(0, 0.1, 0), top: at(0.3, 1, 0.2), radius: 0.3 * u, material: m }",
    "cylinder { base: at(0, 0.1, 0), height: 0.7 * u, radius: 0.3 * u, caps: false, material: m }",
    "cone { base: at(0, 0.1, 0), height: 1.1 * u, radius: 0.5 * u, top_radius: 0.2 * u, material: m }",
    "torus { center: at(0, 0.5, 0), normal: (0, 0.3, 1), radius: 0.4 * u, tube: 0.15 * u, material: m }",
    "mesh { file: \"it.obj\", scale: s, smooth: true, transform: by(0, 0.6, 0), material: m }",
    "mesh { file: \"it.gltf\", scale: s, transform: by(0, 0.4, 0), material: m }",
    "mesh { file: \"it.gltf\", scale: s, transform: by(0, 0.4, 0) }",
    "revolve { profile: polyline [(0m, 0m), (0.4 * u, 0.1 * u), (0.3 * u, 0.7 * u), (0m, 0.9 * u)], material: m }",
    "revolve { profile: bspline [(0m, 0m), (0.8 * u, 0m), (0.2 * u, 0.7 * u), (0.4 * u, 1.1 * u), (0.1 * u, 1.3 * u)], material: m }",
    "revolve { profile: bezier [(0.3 * u, 0m), (0.8 * u, 0.4 * u), (0.1 * u, 0.7 * u), (0.4 * u, 1 * u)], method: tessellated, material: m }",
    "extrude { outline: polygon [(-0.5 * u, 0.1 * u), (0.5 * u, 0.1 * u), (0.3 * u, 1 * u)], holes: [bspline [(-0.1 * u, 0.2 * u), (0.2 * u, 0.2 * u), (0.2 * u, 0.5 * u), (0m, 0.6 * u)]], depth: 0.3 * u, material: m }",
    "sweep { path: bspline [at(-1, 0.2, 0), at(-0.3, 1.5, 0.3), at(0.4, 0.1, 0), at(1, 1, -0.4)], radius: 0.15 * u, end_radius: 0.05 * u, caps: round, material: m }",
    "sweep { path: polyline [at(-0.6, 0.2, 0), at(0.6, 0.2, 0), at(0, 1.1, 0.3)], radius: 0.1 * u, closed: true, material: m }",
    "heightfield { heights: [[0, 0.2, 0], [0.1, 1, 0.3], [0, 0.4, 0]], size: (2 * u, 0.7 * u, 2 * u), transform: by(-1, 0.1, -1), material: m }",
    "for i in 0..3 { place group { sphere { radius: 0.2 * u } box { center: at(0.3, 0, 0), size: (0.2 * u, 0.2 * u, 0.2 * u) } } { transform: rotate_y(i * 40deg) then by(0.6 * i - 0.6, 0.4, 0), material: m } }",
    "for i in 0..3 { place mesh { file: \"it.obj\", scale: s } { transform: scale(0.5, 0.8, 0.6) then rotate_y(i * 40deg) then by(0.6 * i - 0.6, 0.5, 0), material: m } }",
];

const MATERIALS: [&str; 22] = [
    "diffuse { color: checker { a: 0.2, b: 0.8, size: 0.2 * u } }",
    "diffuse { color: noise { size: 0.3 * u } }",
    "diffuse { color: marble { size: 0.1 * u } }",
    "diffuse { color: wood { size: 0.05 * u } }",
    "diffuse { color: brick {} }",
    "diffuse { color: gradient { a: black, b: white, start: at(0, -0.5, 0), end: at(0, 0.5, 0) } }",
    "diffuse { color: image { file: \"it.ppm\", projection: planar { u: (1 * u, 0m, 0m), v: (0m, 1 * u, 0m) } } }",
    "diffuse { color: image { file: \"it.ppm\", projection: spherical { center: at(0, 1, 0) } } }",
    "diffuse { color: image { file: \"it.ppm\", projection: cubic { size: (1 * u, 1 * u, 1 * u) } } }",
    "phong { diffuse: #663311, specular: 0.2, shininess: 40 }",
    "mirror { color: 0.9 }",
    "metal { kind: gold, roughness: 0.2 }",
    "glass { ior: 1.5, absorption: #40c0a0 per 0.5 * u }",
    "glass { ior: 1.5, abbe: 30 }",
    "glass { ior: 1.5, roughness: 0.3 }",
    "glass { ior: 1.5, thin: true }",
    "layer { base: metal { kind: copper, roughness: 0.4 }, roughness: 0.05 }",
    "principled { color: #cc3311, metallic: 0.3, roughness: 0.3, transmission: 0.4, clearcoat: 1 }",
    "mask { material: diffuse { color: 0.7 }, opacity: checker { a: 0.3, b: 1, size: 0.2 * u } }",
    "bump { material: plastic { color: 0.4 }, height: noise { size: 0.2 * u }, depth: 0.02 * u }",
    "normal_map { material: diffuse { color: 0.7 }, map: image(\"it.ppm\") }",
    "mix { a: metal { kind: gold }, b: glass { ior: 1.3 }, amount: 0.3 }",
];

/// The files that the scenes name; a lens is a table of millimetres, and so scales with the rest.
fn files(s: f64) -> Memory {
    let lens: String = [
        ("stop", 8.0, 1.0, 25.0),
        ("44.756", 9.0, 1.5168, 38.0),
        ("-44.756", 4.0, 1.62, 38.0),
        ("-817", 95.0, 1.0, 38.0),
    ]
    .map(|(radius, distance, index, diameter)| {
        let radius = radius.parse::<f64>().map_or(radius.to_owned(), |radius| format!("{}", radius * s));
        format!("{radius} {} {index} {}\n", distance * s, diameter * s)
    })
    .concat();
    let picture =
        b"P6 3 2 255 \x10\xf0\x80\xf0\xa0\xc8\x5a\x14\xff\xff\xff\xff\x30\x60\x90\x90\x80\x70".to_vec();
    let mesh = "v -1 0 0.3\nv 1 0 0.1\nv 0 0.9 0.5\nv 0 -0.5 0.7\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0.3 0 1\nvn -0.3 0 1\n\
                vn 0 0.2 1\nf 1/1/1 2/2/2 3/3/3\nf 2/1/1 1/2/2 4/3/3\n";
    let gltf = std::fs::read("tests/assets/gltf/good.gltf").expect("it is kept with the project");
    Memory::default()
        .with("lens.dat", lens)
        .with("it.ppm", picture)
        .with("it.obj", mesh)
        .with("it.gltf", gltf)
}

/// The scenes whose picture is not the same at another scale, and what was told of those that could not be rendered.
fn scenes_that_change(scenes: &[(&str, String)], method: &str) -> String {
    let mut said = String::new();
    for (name, scene) in scenes {
        let render = |s: f64| {
            let film = if scene.contains(", film_of: s") {
                "film: { size: 14 x 10, sensor: 36mm * s }"
            } else {
                FILM
            };
            let text = format!("{START}{scene}\n{method}").replace(", film_of: s", "").replace("FILM", film);
            let told = render_text(&text, &files(s), &[("s", &format!("{s}"))], 2);
            told.film.map(|film| film_bits(&film)).ok_or(told.report)
        };
        match render(1.0) {
            Ok(one) => {
                let black = one.iter().filter(|pixel| **pixel == [0; 3]).count();
                if black == one.len() {
                    let _ = writeln!(said, "{name}: all black");
                }
                for k in [-20, -10, 10, 20] {
                    match render(2_f64.powi(k)) {
                        Ok(bits) => {
                            let differing = one.iter().zip(&bits).filter(|(a, b)| a != b).count();
                            if differing > 0 {
                                let _ = writeln!(said, "{name}: {differing} pixels differ, k = {k}");
                            }
                        }
                        Err(report) => drop(writeln!(said, "{name}, k = {k}: {report}")),
                    }
                }
            }
            Err(report) => drop(writeln!(said, "{name}: {report}")),
        }
    }
    said
}

const PATHS: &str = "render { method: pt, depth: 6 }";
const PHOTONS: &str = "render { method: ppm, depth: 6, photons: { count: 1000, k: 20, radius: 0.25 * u } }";
const BOTH: &str = "render { method: hybrid, depth: 6, photons: { count: 1000 } }";
const CLASSIC: &str = "render { method: classic }";

/// Case 12 for every lens.
#[test]
fn hard_case_12_scale_changes_no_bit_through_any_lens() {
    let scene = |lens: &&'static str| {
        let camera = CAMERA.replace("fov: 40deg", lens);
        (*lens, [camera.as_str(), LAMP, FLOOR, BALL, GLASS_BALL].join("\n"))
    };
    let scenes: Vec<_> = CAMERAS.iter().map(scene).collect();
    assert_eq!(scenes_that_change(&scenes, PATHS), "");
}

/// Case 12 for every light, by every method.
#[test]
fn hard_case_12_scale_changes_no_bit_by_any_light() {
    let scene = |light: &&'static str| (*light, [CAMERA, light, FLOOR, BALL, GLASS_BALL].join("\n"));
    let scenes: Vec<_> = LIGHTS.iter().map(scene).collect();
    for method in [PATHS, PHOTONS, BOTH, CLASSIC] {
        // Photons from infinity miss an endless plane for ever, which is a warning, and the plane stays.
        assert_eq!(scenes_that_change(&scenes, method), "", "{method}");
    }
}

/// Case 12 for every shape, matt and of glass.
#[test]
fn hard_case_12_scale_changes_no_bit_of_any_shape() {
    for material in ["let m = diffuse { color: #c0a080 }", "let m = glass { ior: 1.5 }"] {
        let scene = |shape: &&'static str| (*shape, [CAMERA, LAMP, FLOOR, material, shape].join("\n"));
        let scenes: Vec<_> = SHAPES.iter().map(scene).collect();
        assert_eq!(scenes_that_change(&scenes, BOTH), "", "{material}");
    }
}

/// Case 12 for every material and texture, the solid ones by lengths of their own.
#[test]
fn hard_case_12_scale_changes_no_bit_of_any_material() {
    let scene = |material: &&'static str| {
        let ball = format!("sphere {{ radius: 0.5 * u, transform: by(0, 0.5, 0), material: {material} }}");
        (*material, [CAMERA, LAMP, FLOOR, &ball].join("\n"))
    };
    let scenes: Vec<_> = MATERIALS.iter().map(scene).collect();
    for method in [PATHS, PHOTONS] {
        assert_eq!(scenes_that_change(&scenes, method), "", "{method}");
    }
}
