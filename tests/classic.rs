//! Recursive ray tracing against its own formulas, worked out here a second time, in double precision.

use snell::convert::{Angle, Basis, Options, Rendition};
use snell::diag::{Problems, Report};
use snell::math::DVec3;
use snell::output::{Display, Exposure, Tone};
use snell::render::Settings;
use snell::source::{Memory, SourceMap};

/// The picture of a scene as bytes, without a tone curve; or what is wrong with the scene.
fn render(text: &str) -> Result<Vec<[u8; 3]>, String> {
    render_with(text, &Memory::default())
}

fn render_with(text: &str, files: &Memory) -> Result<Vec<[u8; 3]>, String> {
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add("scene".into(), "scene".into(), text.into()).expect("the text is small");
    let finished = (|| {
        let scene = snell::compile(&mut sources, files, main, &[], &mut problems)?;
        let loaded = snell::load::load(&scene, &sources, files, &mut problems)?;
        let camera = scene.cameras.first()?;
        let plan = snell::plan::plan(&loaded, Some(camera), None);
        snell::plan::warn(&plan, &loaded, &mut problems);
        let lowered = snell::lower::lower(&loaded, &plan, camera, files, &mut problems)?;
        let settings = Settings::new(lowered.method, plan.depth, 1);
        let outcome = snell::render::render(&lowered.world, &settings, &());
        let floor = scene.render.classic.floor;
        let display = Display { exposure: Exposure::Ev(0.0), tone: Tone::Linear, floor };
        Some(display.develop(&outcome.film.mean()))
    })();
    finished.ok_or_else(|| Report::new(problems, &sources).render_short())
}

/// A scene as the first task of many a course has it: balls and a floor under lights that do not fade.
struct Course {
    /// Rows and columns.
    side: usize,
    /// How far the camera is from the origin along z, looking back, and half its angle of view in degrees.
    distance: f64,
    half_angle: f64,
    background: DVec3,
    balls: Vec<(DVec3, f64, Matter)>,
    /// Its unit normal, its distance from the origin, its matter.
    floor: (DVec3, f64, Matter),
    /// The way to each light, or its place, and its colour.
    suns: Vec<(DVec3, DVec3)>,
    lamps: Vec<(DVec3, DVec3)>,
}

/// Diffuse, specular, exponent.
type Matter = (DVec3, DVec3, f64);

impl Course {
    /// What a ray meets first: the distance, the normal, the matter.
    fn hit(&self, o: DVec3, d: DVec3) -> Option<(f64, DVec3, Matter)> {
        let ball = |&(center, radius, matter): &(DVec3, f64, Matter)| {
            let to = o - center;
            let (b, c) = (to.dot(d), to.length_squared() - radius * radius);
            let t = -b - (b * b - c).max(0.0).sqrt();
            (b * b >= c && t > 0.0).then(|| (t, (o + d * t - center) / radius, matter))
        };
        let (normal, offset, matter) = self.floor;
        let t = (offset - normal.dot(o)) / normal.dot(d);
        let floor = (t > 0.0).then_some((t, normal, matter));
        self.balls.iter().filter_map(ball).chain(floor).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Phong's sum over the lights: the colour of a pixel, columns from the left, rows from the top.
    fn color(&self, x: usize, y: usize) -> DVec3 {
        let half = self.side as f64 / 2.0;
        let focal = half / self.half_angle.to_radians().tan();
        let from_bottom = (self.side - 1 - y) as f64;
        let d = DVec3::new((x as f64 - half) / focal, (from_bottom - half) / focal, -1.0).normalize();
        let o = DVec3::new(0.0, 0.0, self.distance);
        let Some((t, n, (diffuse, specular, exponent))) = self.hit(o, d) else { return self.background };
        let p = o + d * t;
        let lamps = self.lamps.iter().map(|&(at, color)| ((at - p).normalize(), color));
        let shade = |(l, color): (DVec3, DVec3)| {
            let r = 2.0 * l.dot(n) * n - l;
            color * (diffuse * l.dot(n).max(0.0) + specular * (-d).dot(r).max(0.0).powf(exponent))
        };
        self.suns.iter().copied().chain(lamps).map(shade).sum()
    }

    /// Holds a picture against the formula, pixel for pixel: each channel loses its fraction.
    fn assert_is(&self, picture: &[[u8; 3]]) {
        assert_eq!(picture.len(), self.side * self.side);
        let mut decided = 0;
        for (i, &pixel) in picture.iter().enumerate() {
            let (x, y) = (i % self.side, i / self.side);
            let color = self.color(x, y).clamp(DVec3::ZERO, DVec3::ONE) * 255.0;
            for (channel, expected) in color.to_array().into_iter().enumerate() {
                // Single precision cannot tell on which side of a whole number such a value lies.
                if (expected - expected.round()).abs() < 2e-3 {
                    assert!((f64::from(pixel[channel]) - expected).abs() < 1.01, "({x}, {y}): {expected}");
                } else {
                    decided += 1;
                    assert_eq!(pixel[channel], expected.floor() as u8, "({x}, {y}), {channel}: {expected}");
                }
            }
        }
        // Backgrounds and black channels are whole numbers; what is shaded hardly ever is.
        assert!(decided > picture.len() / 2, "only {decided} channels say anything");
    }
}

/// A red ball, a ball with a highlight of exponent 0, and a slanting floor.
fn course() -> Course {
    let reddish = (DVec3::new(0.79, 0.66, 0.44), DVec3::splat(0.5), 20.0);
    let greenish = (DVec3::new(0.0, 0.4, 0.1), DVec3::new(0.0, 0.0, 0.3), 0.0);
    Course {
        side: 120,
        distance: 10.0,
        half_angle: 15.0,
        background: DVec3::new(0.2, 0.0, 0.6),
        balls: vec![(DVec3::new(-0.4, 0.2, 0.0), 1.0, reddish), (DVec3::new(1.2, -0.6, 1.0), 0.5, greenish)],
        floor: (DVec3::new(0.0, 1.0, 0.2).normalize(), -1.5, (DVec3::splat(0.5), DVec3::ZERO, 0.0)),
        suns: vec![(DVec3::new(0.5, 0.5, 1.0).normalize(), DVec3::new(0.9, 0.8, 0.7))],
        lamps: vec![(DVec3::new(2.0, 3.0, 4.0), DVec3::new(0.2, 0.3, 0.4))],
    }
}

/// That scene in Snell.
const COURSE: &str = "snell 1
camera { position: (0m, 0m, 10m), direction: (0, 0, -1), fov: 30deg, film: { size: 120 x 120, tone: linear } }
light directional { direction: (-0.5, -0.5, -1), irradiance: 1, color: rgb(0.9, 0.8, 0.7) }
light point { position: (2m, 3m, 4m), intensity: rgb(0.2, 0.3, 0.4), falloff: none }
environment { radiance: rgb(0.2, 0, 0.6) }
sphere { center: (-0.4m, 0.2m, 0m), radius: 1m, material: whitted { diffuse: rgb(0.79, 0.66, 0.44), specular: 0.5, shininess: 20 } }
sphere { center: (1.2m, -0.6m, 1m), radius: 0.5m, material: whitted { diffuse: rgb(0, 0.4, 0.1), specular: rgb(0, 0, 0.3) } }
plane { normal: (0, 1, 0.2), offset: -1.5m, material: whitted { diffuse: 0.5 } }
render { method: classic { shadows: false, backs: dark, pixel: corner, quantise: floor } }
";

/// That scene as the course writes it. The floor's normal has length 1 there, or its offset would mean something else.
const COURSE_TEXT: &str = "
PerspectiveCamera { center 0 0 10 direction 0 0 -1 up 0 1 0 angle 30 width 120 height 120 }
Lights {
    numLights 2
    DirectionalLight { direction -0.5 -0.5 -1 color 0.9 0.8 0.7 }
    PointLight { position 2 3 4 color 0.2 0.3 0.4 }
}
Background { color 0.2 0 0.6 }
Materials {
    numMaterials 3
    Material { diffuseColor 0.79 0.66 0.44 specularColor 0.5 0.5 0.5 shininess 20 texture brick.png }
    PhongMaterial { diffuseColor 0 0.4 0.1 specularColor 0 0 0.3 }
    Material { diffuseColor 0.5 0.5 0.5 }
}
Group {
    numObjects 3
    MaterialIndex 0
    Sphere { center -0.4 0.2 0 radius 1 }
    MaterialIndex 1
    Sphere { center 1.2 -0.6 1 radius 0.5 }
    MaterialIndex 2
    Plane { normal 0 0.98058067569092 0.19611613513818 offset -1.5 }
}
";

#[test]
fn a_course_scene_is_its_closed_formula_pixel_for_pixel() {
    course().assert_is(&render(COURSE).expect("the scene is right"));
}

/// What a program of the course has beside its scene: files, and an edition.
#[derive(Default)]
pub struct Original {
    /// Meshes, by the names that the scene has for them.
    pub files: Memory,
    /// How its camera's basis is made.
    pub basis: Option<Basis>,
    /// What its angle spans.
    pub angle: Option<Angle>,
}

/// The picture of a converted text that is to look as in its original program.
pub fn render_as_in_the_original(text: &str, original: Original) -> Vec<[u8; 3]> {
    let Original { files, basis, angle } = original;
    let options = Options { rendition: Rendition::Original, basis, angle, ..Options::default() };
    let conversion = snell::convert::convert(text, "scene.txt", &options, None);
    let scene = conversion.scenes.first().expect("the text can be converted");
    render_with(&scene.snell, &files).unwrap_or_else(|report| panic!("{report}\n{}", scene.snell))
}

#[test]
fn a_converted_scene_looks_as_in_its_original_program_pixel_for_pixel() {
    course().assert_is(&render_as_in_the_original(COURSE_TEXT, Original::default()));
}

#[test]
fn the_first_scene_of_the_course_looks_as_in_its_original_program() {
    let path = "../shared/corpus/arsenal/KMing-L__pa1_scene01_basic.txt";
    let Ok(text) = std::fs::read_to_string(path) else { return eprintln!("skipped: {path} is not here") };
    let matt = |r: f64, g: f64, b: f64| (DVec3::new(r, g, b), DVec3::ZERO, 0.0);
    let glossy = |r: f64, g: f64, b: f64| (DVec3::new(r, g, b), DVec3::ONE, 20.0);
    let scene = Course {
        side: 200,
        distance: 10.0,
        half_angle: 15.0,
        background: DVec3::ZERO,
        balls: vec![
            (DVec3::ZERO, 1.0, glossy(1.0, 0.0, 0.0)),
            (DVec3::new(1.0, 1.0, 1.0), 0.75, matt(0.0, 1.0, 0.0)),
            (DVec3::new(-1.0, -1.0, 1.0), 0.75, matt(0.0, 1.0, 0.0)),
            (DVec3::new(-1.0, 1.0, -1.0), 0.75, matt(0.0, 0.0, 1.0)),
            (DVec3::new(1.0, -1.0, -1.0), 0.75, matt(0.0, 0.0, 1.0)),
        ],
        floor: (DVec3::Y, -2.0, glossy(1.0, 1.0, 1.0)),
        suns: Vec::new(),
        lamps: vec![(DVec3::new(0.0, 5.0, 5.0), DVec3::splat(0.9))],
    };
    scene.assert_is(&render_as_in_the_original(&text, Original::default()));
}

/// One pixel looking down at a slab of whatever `material` is, over a white floor, with one light above.
fn pixel_through(material: &str, settings: &str) -> [u8; 3] {
    let scene = format!(
        "snell 1
camera {{ position: (0m, 5m, 0m), direction: (0, -1, 0), up: (0, 0, -1), fov: 1deg, film: {{ size: 1 x 1 }} }}
light directional {{ direction: (0, -1, 0), irradiance: 0.5 }}
box {{ min: (-9m, 1m, -9m), max: (9m, 2m, 9m), material: {material} }}
plane {{ y: 0m, material: whitted {{ diffuse: 1 }} }}
environment {{ radiance: rgb(0, 0, 1) }}
render {{ method: classic {{ pixel: center, {settings} }} }}
"
    );
    render(&scene).expect("the scene is right")[0]
}

#[test]
fn each_term_adds_what_it_says() {
    // The environment is seen, and lights nothing.
    assert_eq!(pixel_through("whitted { diffuse: 1 }", ""), [128, 128, 128]);
    assert_eq!(pixel_through("whitted { diffuse: 1 }", "ambient: 0.25"), [191, 191, 191]);
    assert_eq!(pixel_through("whitted { diffuse: 0, specular: 0.4, shininess: 30 }", ""), [51, 51, 51]);
    assert_eq!(pixel_through("whitted { diffuse: 0, reflection: 0.5 }", ""), [0, 0, 128]);
    // Through both faces of the slab: 0.5² of a floor that is in its shadow, or is not.
    let clear = "whitted { diffuse: 0, transmission: 0.5, ior: 1.5 }";
    assert_eq!(pixel_through(clear, ""), [0, 0, 0]);
    assert_eq!(pixel_through(clear, "shadows: false"), [32, 32, 32]);
}

#[test]
fn fresnel_shares_light_between_the_two_rays() {
    // Straight on, ((1.5 − 1) / (1.5 + 1))² = 0.04 comes back from a face, and the sky is blue; of the inner tree
    // 0.96 · 0.04 · 0.96 and smaller terms follow. What goes through meets the lit floor: 0.96² · (1 + 0.04² + …) · 0.5.
    let slab = "whitted { diffuse: 0, reflection: 1, transmission: 1, ior: 1.5, fresnel: true }";
    let [red, green, blue] = pixel_through(slab, "shadows: false");
    let through = 0.96 * 0.96 / (1.0 - 0.04 * 0.04) * 0.5;
    let back = 0.04 + 0.96 * 0.96 * 0.04 / (1.0 - 0.04 * 0.04);
    assert_eq!((red, green), (red, red));
    assert!((f64::from(red) - 255.0 * through).abs() < 1.0, "{red}");
    assert!((f64::from(blue) - 255.0 * (through + back)).abs() < 1.5, "{blue}");
    assert_eq!(
        pixel_through("glass { ior: 1.5 }", "shadows: false"),
        [red, green, blue],
        "glass is the same"
    );
}

#[test]
fn what_only_this_method_knows_is_refused_by_the_others() {
    let scene = COURSE.replace("method: classic", "method: pt }\nfn _unused(n: int) -> int { n }\n// ");
    let report = render(&scene).expect_err("the scene is wrong");
    assert_eq!(report.matches("[snell::plan::classic_only]").count(), 4, "{report}");
}
