//! Course scenes with meshes and transforms as their original program shows them, against a second working-out of its
//! camera, its transforms and its shading: double precision, one triangle after the other, nothing of the engine.
//!
//! The two editions of the course's framework differ in one line, whether `direction x up` is normalised, which shows in
//! every silhouette where `up` leans.

use crate::classic::{Original, render_as_in_the_original};
use snell::convert::{Angle, Basis};
use snell::math::{DAffine3, DVec3};
use snell::source::Memory;

/// A triangle with its colour, in the world.
type Facet = ([DVec3; 3], DVec3);

/// A scene of the course: triangles under lights from afar.
struct Course {
    /// Columns and rows.
    size: (usize, usize),
    /// Whether the angle spans the width as well as the height, whatever the sides.
    spans_both: bool,
    center: DVec3,
    direction: DVec3,
    angle: f64,
    background: DVec3,
    /// The way the light travels, and its colour.
    suns: Vec<(DVec3, DVec3)>,
    /// Specular colour and exponent, of all facets.
    specular: (DVec3, f64),
    facets: Vec<Facet>,
}

/// Corners of the triangles of an OBJ text that holds nothing but `v x y z` and `f i j k`.
fn obj(text: &str) -> Vec<[DVec3; 3]> {
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let kind = words.next();
        let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
        match (kind, &numbers[..]) {
            (Some("v"), &[x, y, z]) => points.push(DVec3::new(x, y, z)),
            (Some("f"), &[i, j, k]) => triangles.push([i, j, k].map(|index| points[index as usize - 1])),
            _ => {}
        }
    }
    triangles
}

/// A mesh under a transform. Operations are written from the outermost to the innermost, so their matrices multiply in
/// the order in which they stand.
fn placed(mesh: &[[DVec3; 3]], operations: &[DAffine3], color: DVec3) -> Vec<Facet> {
    let matrix: DAffine3 = operations.iter().copied().fold(DAffine3::IDENTITY, |outer, inner| outer * inner);
    mesh.iter().map(|corners| (corners.map(|corner| matrix.transform_point3(corner)), color)).collect()
}

/// The distance to a triangle along a ray (Möller and Trumbore 1997).
fn distance_to([a, b, c]: [DVec3; 3], origin: DVec3, way: DVec3) -> Option<f64> {
    let (u, v) = (b - a, c - a);
    let across = way.cross(v);
    let volume = u.dot(across);
    let from = origin - a;
    let beta = from.dot(across) / volume;
    let gamma = way.dot(from.cross(u)) / volume;
    let t = v.dot(from.cross(u)) / volume;
    (beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0 && t > 0.0).then_some(t)
}

impl Course {
    /// The ray through a point of the picture, in pixels from the bottom left.
    fn way(&self, x: f64, y: f64, basis: Basis) -> DVec3 {
        let direction = self.direction.normalize();
        let mut right = direction.cross(DVec3::Y);
        if basis == Basis::Orthonormal {
            right = right.normalize();
        }
        let up = right.cross(direction);
        let (half_width, half_height) = (self.size.0 as f64 / 2.0, self.size.1 as f64 / 2.0);
        let tangent = (self.angle / 2.0).to_radians().tan();
        let focal = half_height / tangent;
        let focal_across = if self.spans_both { half_width / tangent } else { focal };
        ((x - half_width) / focal_across * right + (y - half_height) / focal * up + direction).normalize()
    }

    /// Which facet a ray meets first, and where.
    fn hit(&self, way: DVec3) -> Option<(usize, f64)> {
        let distance = |(_, (corners, _)): &(usize, &Facet)| distance_to(*corners, self.center, way);
        let hits = self.facets.iter().enumerate().filter_map(|facet| Some((facet.0, distance(&facet)?)));
        hits.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The original's sum over the lights: no shadows, and dark where a facet turns its back.
    fn shade(&self, facet: usize, way: DVec3) -> DVec3 {
        let ([a, b, c], diffuse) = self.facets[facet];
        let n = (b - a).cross(c - a).normalize();
        let (specular, exponent) = self.specular;
        let of_sun = |&(travels, color): &(DVec3, DVec3)| {
            let l = -travels.normalize();
            let r = 2.0 * l.dot(n) * n - l;
            color * (diffuse * l.dot(n).max(0.0) + specular * (-way).dot(r).max(0.0).powf(exponent))
        };
        self.suns.iter().map(of_sun).sum()
    }

    /// Holds a picture against the formulas, pixel for pixel. Left out are pixels whose ray passes so close to an edge
    /// that single precision cannot tell the sides.
    fn assert_is(&self, picture: &[[u8; 3]], basis: Basis) {
        let (mut on_edges, mut hits) = (0, 0);
        for (i, &pixel) in picture.iter().enumerate() {
            let (width, height) = self.size;
            let (x, y) = ((i % width) as f64, (height - 1 - i / width) as f64);
            let hit = self.hit(self.way(x, y, basis)).map(|hit| hit.0);
            let near = [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)];
            let is_near =
                |&(dx, dy): &(f64, f64)| self.hit(self.way(x + dx, y + dy, basis)).map(|hit| hit.0) != hit;
            if near.iter().any(is_near) {
                on_edges += 1;
                continue;
            }
            hits += usize::from(hit.is_some());
            let color = hit.map_or(self.background, |facet| self.shade(facet, self.way(x, y, basis)));
            let expected = color.clamp(DVec3::ZERO, DVec3::ONE) * 255.0;
            for (channel, expected) in expected.to_array().into_iter().enumerate() {
                let is_near_whole = (expected - expected.round()).abs() < 5e-3;
                let wanted = if is_near_whole { expected.round() } else { expected.floor() };
                let off = (f64::from(pixel[channel]) - wanted).abs();
                assert!(
                    off == 0.0 || (is_near_whole && off <= 1.0),
                    "({x}, {y}) {channel}: {pixel:?}, {expected}"
                );
            }
        }
        assert!(hits > picture.len() / 20, "only {hits} pixels show something");
        assert!(on_edges < picture.len() / 50, "{on_edges} pixels are left out");
    }

    /// Both editions of the original, and that they differ where they should.
    fn assert_both_editions(&self, text: &str, files: &dyn Fn() -> Memory) {
        let show = |basis| {
            let original = Original { files: files(), basis: Some(basis), angle: None };
            render_as_in_the_original(text, original)
        };
        let (raw, orthonormal) = (show(Basis::Raw), show(Basis::Orthonormal));
        self.assert_is(&raw, Basis::Raw);
        self.assert_is(&orthonormal, Basis::Orthonormal);
        let differing = raw.iter().zip(&orthonormal).filter(|(a, b)| a != b).count();
        assert!(differing > raw.len() / 100, "the editions differ in {differing} pixels only");
    }
}

fn turn(axis: DVec3, degrees: f64) -> DAffine3 {
    DAffine3::from_axis_angle(axis, degrees.to_radians())
}

fn stretch(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_scale(DVec3::new(x, y, z))
}

fn shift(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, y, z))
}

/// A wedge with a roof, of our own.
const WEDGE: &str = "
v 0 0 0
v 2 0 0
v 0 1 0
v 0 0 1.5
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
";

const SCENE: &str = "
PerspectiveCamera { center 4 3 6 direction -0.6 -0.45 -1 up 0 1 0 angle 40 width 120 height 120 }
Lights {
    numLights 2
    DirectionalLight { direction -0.3 -1 -0.5 color 0.7 0.6 0.5 }
    DirectionalLight { direction -1 -0.2 -0.6 color 0.2 0.3 0.4 }
}
Background { color 0.1 0.2 0.3 }
Materials {
    numMaterials 2
    Material { diffuseColor 0.8 0.3 0.2 specularColor 0.4 0.5 0.6 shininess 12 }
    PhongMaterial { diffuseColor 0.2 0.7 0.4 specularColor 0.4 0.5 0.6 shininess 12 }
}
Group {
    numObjects 2
    MaterialIndex 0
    Transform {
        Translate -1 0.5 0
        YRotate 35
        Scale 1 1.5 0.8
        XRotate -20
        TriangleMesh { obj_file wedge.obj }
    }
    MaterialIndex 1
    Transform {
        Scale 1.2 1.2 1.2
        Translate 0.5 -0.8 0
        Group {
            numObjects 1
            Transform { ZRotate 25 UniformScale 1.1 TriangleMesh { obj_file wedge.obj } }
        }
    }
}
";

/// [`SCENE`], worked out by hand.
fn two_wedges() -> Course {
    let wedge = obj(WEDGE);
    let first = [shift(-1.0, 0.5, 0.0), turn(DVec3::Y, 35.0), stretch(1.0, 1.5, 0.8), turn(DVec3::X, -20.0)];
    let second =
        [stretch(1.2, 1.2, 1.2), shift(0.5, -0.8, 0.0), turn(DVec3::Z, 25.0), stretch(1.1, 1.1, 1.1)];
    let mut facets = placed(&wedge, &first, DVec3::new(0.8, 0.3, 0.2));
    facets.extend(placed(&wedge, &second, DVec3::new(0.2, 0.7, 0.4)));
    Course {
        size: (120, 120),
        spans_both: false,
        center: DVec3::new(4.0, 3.0, 6.0),
        direction: DVec3::new(-0.6, -0.45, -1.0),
        angle: 40.0,
        background: DVec3::new(0.1, 0.2, 0.3),
        suns: vec![
            (DVec3::new(-0.3, -1.0, -0.5), DVec3::new(0.7, 0.6, 0.5)),
            (DVec3::new(-1.0, -0.2, -0.6), DVec3::new(0.2, 0.3, 0.4)),
        ],
        specular: (DVec3::new(0.4, 0.5, 0.6), 12.0),
        facets,
    }
}

#[test]
fn meshes_under_transforms_look_as_in_both_editions_of_the_original() {
    two_wedges().assert_both_editions(SCENE, &|| Memory::default().with("wedge.obj", WEDGE));
}

/// Programs in which the angle spans the width as well show what is in a wide picture by pixels that are not square.
#[test]
fn an_angle_that_spans_both_sides_stretches_the_picture() {
    for (width, height) in [(150, 100), (80, 120)] {
        let course = Course { size: (width, height), spans_both: true, ..two_wedges() };
        let text = SCENE.replace("width 120 height 120", &format!("width {width} height {height}"));
        let files = Memory::default().with("wedge.obj", WEDGE);
        let original = Original { files, basis: Some(Basis::Orthonormal), angle: Some(Angle::Both) };
        course.assert_is(&render_as_in_the_original(&text, original), Basis::Orthonormal);
    }
}

/// A text of the corpus beside the project, if there is one.
fn corpus(file: &str) -> Option<String> {
    let text = std::fs::read_to_string(format!("../shared/corpus/arsenal/{file}")).ok();
    if text.is_none() {
        println!("skipped: {file} is not beside the project");
    }
    text
}

#[test]
fn the_axes_of_the_course_look_as_in_both_editions() {
    let files = [corpus("KMing-L__pa1_scene04_axes.txt"), corpus("mesh/cube.obj")];
    let [Some(text), Some(cube)] = files else { return };
    let mesh = obj(&cube);
    let beams = [
        ([shift(5.0, 0.0, 0.0), stretch(5.0, 0.2, 0.2)], DVec3::X),
        ([shift(0.0, 5.0, 0.0), stretch(0.2, 5.0, 0.2)], DVec3::Y),
        ([shift(0.0, 0.0, 5.0), stretch(0.2, 0.2, 5.0)], DVec3::Z),
    ];
    let mut facets: Vec<Facet> =
        beams.iter().flat_map(|(steps, color)| placed(&mesh, steps, *color)).collect();
    let turned = [
        shift(4.0, 3.0, 1.0),
        turn(DVec3::X, 10.0),
        turn(DVec3::Y, 20.0),
        turn(DVec3::Z, 30.0),
        stretch(2.0, 0.5, 3.0),
    ];
    facets.extend(placed(&mesh, &turned, DVec3::ONE));
    let course = Course {
        size: (200, 200),
        spans_both: false,
        center: DVec3::new(13.0, 11.0, 30.0),
        direction: DVec3::new(-0.16, -0.12, -0.5),
        angle: 30.0,
        background: DVec3::ZERO,
        suns: vec![(DVec3::new(-0.2, -0.4, -0.8), DVec3::splat(0.8))],
        specular: (DVec3::ZERO, 0.0),
        facets,
    };
    course.assert_both_editions(&text, &|| Memory::default().with("mesh/cube.obj", cube.clone()));
}

#[test]
fn the_rabbit_of_the_course_looks_as_in_both_editions() {
    let files = [corpus("KMing-L__pa1_scene05_bunny_200.txt"), corpus("mesh/bunny_200.obj")];
    let [Some(text), Some(rabbit)] = files else { return };
    let course = Course {
        size: (200, 200),
        spans_both: false,
        center: DVec3::new(0.35, 0.6, 0.8),
        direction: DVec3::new(-0.5, -0.5, -1.0),
        angle: 25.0,
        background: DVec3::new(0.1, 0.7, 0.2),
        suns: vec![
            (DVec3::new(0.2, -1.0, -0.4), DVec3::splat(0.7)),
            (DVec3::new(-7.0, -5.0, -5.0), DVec3::splat(0.3)),
        ],
        specular: (DVec3::ONE, 20.0),
        facets: placed(&obj(&rabbit), &[], DVec3::new(0.79, 0.66, 0.44)),
    };
    course.assert_both_editions(&text, &|| Memory::default().with("mesh/bunny_200.obj", rabbit.clone()));
}
