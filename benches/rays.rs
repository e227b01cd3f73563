//! How fast rays are: millions a second on one thread, over two families of meshes; Embree beside it in the same run.
//!
//! `[EMBREE=path/to/libembree4.so.4] cargo bench --bench rays [-- MESH..]`, with meshes such as `blob10k` or `soup100k`.
//!
//! `blob` is a sphere displaced by a sum of sines, `soup` unordered triangles. Rays are, in this order: through the
//! pixels of a picture of 1024 × 1024; cosine-distributed bounces from where those meet the mesh, in their order; the
//! same as shadow rays; and rays from anywhere to anywhere in the box around the mesh, whose order says nothing.
//!
//! Times are those of the thread alone, the best of five runs. Embree (its library comes with `pip install embreex`)
//! gets the same rays through `benches/embree.cpp`, which needs a C++ compiler: once as it is by default, once with its
//! robust flag, both with AVX2, where it is faster than with AVX-512 on the machines at hand. The last line of each mesh
//! holds our rates divided by those of robust Embree, our seconds to build by those of its build that splits space
//! (with the robust flag it divides objects only), and our memory by its.

use cpu_time::ThreadTime;
use snell::math::{DAffine3, Ray, Vec3};
use snell::render::geometry::Geometry;
use snell::render::shape::{MaterialId, Mesh, SourceId};
use std::f64::consts::{FRAC_PI_4, TAU};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Meshes that are traced unless others are named.
const MESHES: [&str; 4] = ["blob10k", "blob100k", "blob1m", "soup1m"];
/// Runs of which the best counts.
const RUNS: usize = 5;

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let meshes: Vec<&str> =
        if named.is_empty() { MESHES.to_vec() } else { named.iter().map(String::as_str).collect() };
    let embree = std::env::var_os("EMBREE").map(|library| Embree::compile(library.into()));
    println!(
        "mesh       by              build s  bytes/tri   camera   bounce   shadow  any to any   (Mrays/s)"
    );
    // One thread builds the tree too, so that its seconds can be compared.
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
    one_thread.install(|| {
        for name in meshes {
            match mesh(name) {
                Some(mesh) => measure(name, mesh, embree.as_ref()),
                None => eprintln!("`{name}` is no mesh of this benchmark"),
            }
        }
    });
}

/// What a row of the table says.
struct Row {
    build: f64,
    bytes: f64,
    /// Millions of rays a second, by set.
    speed: [f64; 4],
    hits: [usize; 4],
}

impl Row {
    fn print(&self, mesh: &str, by: &str, triangles: usize) {
        let [camera, bounce, shadow, anywhere] = self.speed;
        println!(
            "{mesh:10} {by:14} {:8.2} {:10.0} {camera:8.2} {bounce:8.2} {shadow:8.2} {anywhere:11.2}",
            self.build,
            self.bytes / triangles as f64,
        );
    }
}

fn measure(name: &str, mesh: Mesh, embree: Option<&Embree>) {
    let triangles = mesh.triangles.len();
    let (positions, indices) = (mesh.positions.clone(), mesh.triangles.clone());
    let start = thread_seconds();
    let geometry = Geometry::build(vec![mesh], Vec::new());
    let build = thread_seconds() - start;

    let bounds = geometry.bounds();
    let camera = camera_rays(bounds.min, bounds.max);
    let bounces = bounce_rays(&geometry, &camera, bounds.size().length());
    let anywhere = any_rays(bounds.min, bounds.max);
    let sets = [&camera, &bounces, &bounces, &anywhere];
    let closest = |ray: &Ray| geometry.closest_hit(ray).is_some();
    let timed = [
        timed(&camera, closest),
        timed(&bounces, closest),
        timed(&bounces, |ray| geometry.any_hit(ray)),
        timed(&anywhere, closest),
    ];
    let ours = Row {
        build,
        bytes: geometry.tree_bytes() as f64,
        speed: timed.map(|(speed, _)| speed),
        hits: timed.map(|(_, hits)| hits),
    };
    ours.print(name, "snell", triangles);
    let Some(embree) = embree else { return };
    embree.write(&positions, &indices, sets).expect("the rays can be written");
    let split = embree.run("");
    split.print("", "embree", triangles);
    let robust = embree.run("robust");
    robust.print("", "embree robust", triangles);
    let [camera, bounce, shadow, anywhere] = [0, 1, 2, 3].map(|set| ours.speed[set] / robust.speed[set]);
    let missed = [0, 1, 2, 3].map(|set| ours.hits[set] as i64 - robust.hits[set] as i64);
    println!(
        "{:10} {:14} {:7.2}x {:9.2}x {camera:7.2}x {bounce:7.2}x {shadow:7.2}x {anywhere:10.2}x   hits that Embree lacks: {missed:?}",
        "",
        "ratio",
        ours.build / split.build,
        ours.bytes / robust.bytes,
    );
}

/// Millions of rays a second, the best of several runs; and how many hit.
fn timed(rays: &[Ray], trace: impl Fn(&Ray) -> bool) -> (f64, usize) {
    let mut hits = 0;
    let mut run = || {
        let start = thread_seconds();
        hits = std::hint::black_box(rays.iter().filter(|ray| trace(ray)).count());
        rays.len() as f64 / (thread_seconds() - start) * 1e-6
    };
    let speed = (0..RUNS).map(|_| run()).fold(0.0, f64::max);
    (speed, hits)
}

/// What this thread has used of its processor, in seconds.
fn thread_seconds() -> f64 {
    ThreadTime::now().as_duration().as_secs_f64()
}

/// The program that traces the same rays with Embree.
struct Embree {
    library: PathBuf,
    folder: tempfile::TempDir,
}

impl Embree {
    fn compile(library: PathBuf) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/embree.cpp");
        let mut compiler = Command::new("c++");
        compiler
            .args(["-O3", "-march=native", "-o"])
            .arg(folder.path().join("embree"))
            .arg(source)
            .arg("-ldl");
        assert!(compiler.status().is_ok_and(|status| status.success()), "{compiler:?} failed");
        Self { library, folder }
    }

    /// Writes the file that the program reads.
    fn write(&self, positions: &[Vec3], triangles: &[[u32; 3]], sets: [&Vec<Ray>; 4]) -> std::io::Result<()> {
        let mut file = std::io::BufWriter::new(std::fs::File::create(self.folder.path().join("rays"))?);
        let counts = [positions.len(), triangles.len()].into_iter().chain(sets.map(Vec::len));
        for count in counts {
            file.write_all(&(count as u32).to_le_bytes())?;
        }
        let mut words = |words: &[f32]| words.iter().try_for_each(|x| file.write_all(&x.to_le_bytes()));
        positions.iter().try_for_each(|p| words(&p.to_array()))?;
        words(&[0.0])?;
        triangles.iter().flatten().try_for_each(|index| file.write_all(&index.to_le_bytes()))?;
        let mut words = |words: &[f32]| words.iter().try_for_each(|x| file.write_all(&x.to_le_bytes()));
        sets.into_iter().flatten().try_for_each(|ray| {
            words(&ray.o.to_array())?;
            words(&ray.d.to_array())
        })?;
        file.flush()
    }

    fn run(&self, flags: &str) -> Row {
        let flags = if flags == "robust" { "4" } else { "0" };
        let mut program = Command::new(self.folder.path().join("embree"));
        program.arg(&self.library).arg(self.folder.path().join("rays"));
        let output = program.args(["threads=1,max_isa=avx2", flags]).output().expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let words: Vec<f64> = String::from_utf8_lossy(&output.stdout)
            .split_whitespace()
            .map(|word| word.parse().expect("the program prints numbers"))
            .collect();
        Row {
            build: words[0],
            bytes: words[1],
            speed: [0, 1, 2, 3].map(|set| words[2 + 2 * set]),
            hits: [0, 1, 2, 3].map(|set| words[3 + 2 * set] as usize),
        }
    }
}

/// `blob100k`: a family, and about how many triangles.
fn mesh(name: &str) -> Option<Mesh> {
    let digits = name.find(|c: char| c.is_ascii_digit())?;
    let (family, count) = name.split_at(digits);
    let scale = if count.ends_with('m') { 1_000_000 } else { 1_000 };
    let count: usize = count.trim_end_matches(['k', 'm']).parse::<usize>().ok()? * scale;
    match family {
        "blob" => Some(blob((count as f64 / 12.0).sqrt().round() as u32)),
        "soup" => Some(soup(count)),
        _ => None,
    }
}

/// A cube of 6 · `n`² squares, blown up to a sphere whose radius varies between about 0.8 and 1.2.
fn blob(n: u32) -> Mesh {
    let t: Vec<f64> =
        (0..=n).map(|i| (FRAC_PI_4 * (2.0 * f64::from(i) / f64::from(n) - 1.0)).tan()).collect();
    let faces: [fn(f64, f64) -> [f64; 3]; 6] = [
        |a, b| [1.0, a, b],
        |a, b| [-1.0, b, a],
        |a, b| [b, 1.0, a],
        |a, b| [a, -1.0, b],
        |a, b| [a, b, 1.0],
        |a, b| [b, a, -1.0],
    ];
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for face in faces {
        let base = positions.len() as u32;
        positions.extend(t.iter().flat_map(|&a| t.iter().map(move |&b| displaced(face(a, b)))));
        for q in (0..n).flat_map(|i| (0..n).map(move |j| base + i * (n + 1) + j)) {
            triangles.push([q, q + n + 1, q + n + 2]);
            triangles.push([q, q + n + 2, q + 1]);
        }
    }
    of_triangles(positions, triangles)
}

/// A point of the cube on the sphere, displaced by waves of five lengths.
fn displaced(p: [f64; 3]) -> Vec3 {
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = p.map(|x| x / length);
    let s = f64::sin;
    let waves = 0.50 * s(5.0 * x + 1.0) * s(6.0 * y + 0.5) * s(4.0 * z + 2.0)
        + 0.25 * s(13.0 * x + 3.0 * z) * s(11.0 * y + 1.7)
        + 0.15 * s(29.0 * x + 7.0 * y + 0.3) * s(31.0 * z - 5.0 * y)
        + 0.06 * s(71.0 * x + 13.0 * z) * s(67.0 * y + 2.2) * s(73.0 * z)
        + 0.02 * s(211.0 * x) * s(199.0 * y) * s(223.0 * z);
    let r = 1.0 + 0.18 * waves;
    Vec3::new((x * r) as f32, (y * r) as f32, (z * r) as f32)
}

/// `count` triangles anywhere in the unit cube, of mean edge about `count`^(−1/3).
fn soup(count: usize) -> Mesh {
    let mut random = Random(7);
    let size = 1.5 * (count as f64).powf(-1.0 / 3.0);
    let mut positions = Vec::with_capacity(3 * count);
    for _ in 0..count {
        let corners = [(); 3].map(|()| [random.next(), random.next(), random.next()]);
        let center = corners[0];
        positions.extend(corners.map(|corner| {
            let at = |axis: usize| (center[axis] + (corner[axis] - 0.5) * size) as f32;
            Vec3::new(at(0), at(1), at(2))
        }));
    }
    let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    of_triangles(positions, triangles)
}

fn of_triangles(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        triangles,
        positions,
        normals: None,
        uvs: None,
        material: MaterialId(0),
        object_from_world: DAffine3::IDENTITY,
        source: SourceId(0),
    }
}

const SIDE: u32 = 1024;

/// Rays through the pixels of a square picture with 40° of view, row by row, that the mesh fills.
fn camera_rays(min: Vec3, max: Vec3) -> Vec<Ray> {
    let eye = (min + max) / 2.0 + Vec3::Z * (0.95 * (max - min).length());
    let half = 20_f32.to_radians().tan();
    let at = |i: u32| ((i as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0) * half;
    let pixels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    pixels.map(|(x, y)| Ray::new(eye, Vec3::new(at(x), -at(y), -1.0).normalize())).collect()
}

/// A cosine-distributed ray from each hit, on the side it was hit from, off the surface by 10⁻⁴ of the box.
fn bounce_rays(geometry: &Geometry, camera: &[Ray], diagonal: f32) -> Vec<Ray> {
    let mut random = Random(2);
    let mut bounce = |ray: &Ray| {
        let hit = geometry.closest_hit(ray)?;
        let n = geometry.surface_point(ray, &hit).n;
        let n = if n.dot(ray.d) > 0.0 { -n } else { n };
        let dir = (n + random.direction()).try_normalize()?;
        Some(Ray::new(ray.at(hit.t) + n * (1e-4 * diagonal), dir))
    };
    camera.iter().filter_map(&mut bounce).collect()
}

/// Rays from points of the box in all directions.
fn any_rays(min: Vec3, max: Vec3) -> Vec<Ray> {
    let mut random = Random(1);
    let point = |random: &mut Random| {
        let u = [random.next(), random.next(), random.next()].map(|u| u as f32);
        min + (max - min) * Vec3::from_array(u)
    };
    (0..SIDE * SIDE).map(|_| Ray::new(point(&mut random), random.direction())).collect()
}

/// Numbers in [0, 1) that look random (Steele, Lea, Flood 2014: SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A unit vector, all directions alike.
    fn direction(&mut self) -> Vec3 {
        let (z, phi) = (1.0 - 2.0 * self.next(), TAU * self.next());
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new((r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32)
    }
}
