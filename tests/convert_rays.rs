//! What a camera sees of a converted scene is what it sees of the source.
//!
//! The source is read a second time here, by a reader that knows no dialects and no tolerance, only words and what the
//! family's programs make of them, and its rays try every shape. Ten thousand of them per scene must hit what the
//! converted scene's rays hit, at the same point.

mod naive;

use naive::{Scene, read};
use snell::convert::{DiskFinder, Options, convert};
use snell::diag::Problems;
use snell::math::{DVec3, Vec2};
use snell::source::{Disk, SourceMap};
use std::path::{Path, PathBuf};

/// Rays along each side of the picture.
const SIDE: u32 = 100;

/// How far two hits may be apart, as a share of the distance to them: what single precision leaves of a far one.
const TOLERANCE: f64 = 2e-4;

/// How many of the rays may disagree: those that graze an edge.
const GRAZING: usize = 10;

/// The same where a mesh has polygons: the original takes them for fans of triangles, which for one with a dent stand over
/// its edge; here such a polygon is filled as it should be.
const GRAZING_FANS: usize = 100;

#[test]
fn converted_scenes_of_ours_are_hit_where_the_source_is() {
    let compared = compare_all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/convert"));
    assert!(compared >= 4, "only {compared} scenes were compared");
}

#[test]
fn converted_scenes_of_others_are_hit_where_the_source_is() {
    let compared = compare_all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/corpus"));
    if compared == 0 {
        println!("skipped: no corpus beside the project");
    }
}

/// Compares every scene below a folder, and says how many there were.
fn compare_all(folder: &Path) -> usize {
    let mut compared = 0;
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let mut entries: Vec<PathBuf> =
            std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
        entries.sort();
        for path in entries {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "txt") {
                compared += compare(&path);
            }
        }
    }
    compared
}

/// Compares the scenes of a file; those that the naive reader cannot read, for they are malformed, count for nothing.
fn compare(path: &Path) -> usize {
    let text = std::fs::read_to_string(path).expect("a text");
    let conversion =
        convert(&text, "scene.txt", &Options::default(), Some(&DiskFinder::new(path, Vec::new())));
    let sources = read(&text, path);
    assert_eq!(sources.len(), conversion.scenes.len(), "{}", path.display());
    let mut compared = 0;
    for (source, converted) in sources.iter().zip(&conversion.scenes) {
        let Some(source) = source else { continue };
        let (misses, hits) = disagreements(source, &converted.snell, path);
        println!("{}: {hits} hits, {} disagree", path.display(), misses.len());
        assert!(
            misses.len() <= if source.has_polygons { GRAZING_FANS } else { GRAZING },
            "{}: {} rays disagree, such as {}\n{}",
            path.display(),
            misses.len(),
            misses[0],
            converted.snell
        );
        compared += 1;
    }
    compared
}

/// The rays that disagree, in words, and how many of all hit anything.
fn disagreements(source: &Scene, snell: &str, path: &Path) -> (Vec<String>, usize) {
    let folders = path.ancestors().skip(1).take(3).map(Path::to_path_buf).collect();
    let files = Disk::new(&path.with_extension("snell"), folders, true);
    let mut sources = SourceMap::default();
    let name = path.with_extension("snell");
    let main = sources.add("scene.snell".into(), name, snell.into()).expect("a short text");
    let mut problems = Problems::default();
    let scene = snell::compile(&mut sources, &files, main, &[], &mut problems).expect("a scene");
    let formatted = snell::format::format(&sources, main, &mut problems).expect("a scene that compiles");
    assert_eq!(snell, formatted, "{} is not laid out as `snell fmt` would", path.display());
    let loaded = snell::load::load(&scene, &sources, &files, &mut problems).expect("its files");
    let camera = scene.cameras.first().expect("a camera");
    let plan = snell::plan::plan(&loaded, Some(camera), None);
    let lowered = snell::lower::lower(&loaded, &plan, camera, &files, &mut problems).expect("a world");

    let (middle, lens_center) = (Vec2::splat(0.5), Vec2::ZERO);
    let (mut misses, mut hits) = (Vec::new(), 0);
    for y in 0..SIDE {
        for x in 0..SIDE {
            let pixel = [x * source.size[0] / SIDE, y * source.size[1] / SIDE];
            let (origin, way) = source.ray(pixel);
            let expected = source.closest_hit(origin, way).map(|t| origin + way * t);
            let ray = lowered.world.camera.ray(pixel, middle, lens_center).expect("it sees all around").ray;
            let hit = lowered.world.closest_hit(&ray);
            let found = hit.map(|hit| lowered.center + (ray.o + ray.d * hit.t).as_dvec3());
            hits += usize::from(expected.is_some());
            if !agree(expected, found, origin) {
                misses.push(format!("pixel {pixel:?}: {expected:?} in the source, {found:?} in the result"));
            }
        }
    }
    (misses, hits)
}

fn agree(expected: Option<DVec3>, found: Option<DVec3>, origin: DVec3) -> bool {
    match (expected, found) {
        (None, None) => true,
        (Some(a), Some(b)) => a.distance(b) <= TOLERANCE * a.distance(origin),
        // What is farther than single precision reaches may be there or not.
        (Some(far), None) | (None, Some(far)) => far.distance(origin) > 1e6,
    }
}
