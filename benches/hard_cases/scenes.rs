//! The scenes of `scenes/bench`, ready for rays.

use snell::diag::Problems;
use snell::lower::Lowered;
use snell::math::{Ray, Vec2};
use snell::render::Settings;
use snell::source::{Disk, SourceMap};
use std::path::Path;

/// Their names.
pub const NAMES: [&str; 4] = ["S1", "S2", "S3", "S4"];
/// The side of their pictures, in pixels.
pub const SIDE: u32 = 192;

/// A scene, and how it is rendered.
pub struct Scene {
    pub lowered: Lowered,
    pub settings: Settings,
}

impl Scene {
    /// Reads and builds a scene, to be rendered in so many passes.
    ///
    /// # Panics
    /// When a file is missing: S3 has a mesh that is made, not kept.
    pub fn new(name: &str, passes: u32) -> Self {
        let file = Path::new("scenes/bench").join(name).with_extension("snell");
        let blob = Path::new("scenes/bench/blob1m.obj");
        assert!(name != "S3" || blob.exists(), "run `cargo run --release --example bench_meshes` first");
        let text = std::fs::read_to_string(&file).expect("the scene is kept with the project");
        let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
        let main = sources.add(name.to_owned(), file.clone(), text.into()).expect("it is small");
        let files = Disk::new(&file, Vec::new(), false);
        let checked = snell::compile(&mut sources, &files, main, &[], &mut problems).expect("it is right");
        let loaded =
            snell::load::load(&checked, &sources, &files, &mut problems).expect("its files are there");
        let mut camera = checked.cameras.first().expect("it has a camera").clone();
        camera.film.size.value = (SIDE, SIDE);
        let plan = snell::plan::plan(&loaded, Some(&camera), None);
        let lowered =
            snell::lower::lower(&loaded, &plan, &camera, &files, &mut problems).expect("it is right");
        let settings = Settings { seed: 1, ..Settings::new(lowered.method, plan.depth, passes) };
        Self { lowered, settings }
    }

    /// The rays through the middles of all pixels.
    pub fn camera_rays(&self) -> Vec<Ray> {
        let camera = &self.lowered.world.camera;
        let pixels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [x, y]));
        pixels.filter_map(|pixel| Some(camera.ray(pixel, Vec2::splat(0.5), Vec2::ZERO)?.ray)).collect()
    }
}
