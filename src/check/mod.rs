//! Ir → [`Checked`]: that the scene makes sense as a whole, by the laws of geometry and of light.
//!
//! A file per subject. Nothing stops at a mistake; what `resolve` could make sense of is checked even when there was
//! much it could not.

mod camera;
mod curve;
mod error;
mod light;
mod material;
mod motion;
mod render;
mod shape;
mod space;
mod transform;

use crate::diag::{Problems, Trail};
use crate::ir::{MaterialKind, Scene};
use crate::schema::Type;
use crate::source::{Span, Spanned};
pub use camera::{WIDEST_FILTER, camera};
pub use error::CheckError;
use miette::Diagnostic;
use rustc_hash::FxHashSet;
use space::NoMeshes;
pub use space::{MeshPart, Meshes, OwnMaterial, Region, paths_miss, region, survey};
use std::ops::Deref;

/// A scene that was checked. Only [`check`] makes one; it makes sense when no error was noted.
#[derive(Debug)]
pub struct Checked {
    scene: Scene,
    /// Whether all objects, lights and cameras are sound, so that it makes sense to ask where they are.
    is_sound: bool,
}

impl Checked {
    /// The scene without the objects and lights that were put into it at some places. What is left makes as much sense as
    /// before.
    pub fn without(&self, is_left_out: impl Fn(Span) -> bool) -> Self {
        let mut scene = self.scene.clone();
        scene.objects.retain(|object| !is_left_out(object.span));
        scene.lights.retain(|light| !is_left_out(light.span));
        Self { scene, is_sound: self.is_sound }
    }
}

impl Deref for Checked {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.scene
    }
}

/// Checks `scene` and notes what is wrong in `problems`.
///
/// `None`: something was wrong before, and nothing is left to check. Otherwise whoever goes on to render asks
/// [`Problems::has_errors`]; whoever only looks for more mistakes need not.
pub fn check(scene: Scene, problems: &mut Problems) -> Option<Checked> {
    if scene.is_empty() && problems.has_errors() {
        return None;
    }
    // What is missing may be what could not be resolved: then it is not worth a report of its own.
    let whole = !problems.has_errors();
    let mut check = Check::new(&scene, problems, whole);
    check.shapes();
    check.transforms();
    check.lights();
    check.cameras();
    check.motions();
    let is_sound = !check.problems.has_errors();
    check.materials();
    check.render();
    if !space::may_bring_light(&scene) {
        check.any_light(&NoMeshes);
    }
    if is_sound && !space::places_meshes(&scene) {
        check.survey(&NoMeshes);
    }
    Some(Checked { scene, is_sound })
}

/// The check of a scene.
struct Check<'a> {
    scene: &'a Scene,
    problems: &'a mut Problems,
    /// Whether everything that was written could be resolved.
    whole: bool,
    /// Reports that were made, by code and place: what a loop or a function made many times is wrong once.
    reported: FxHashSet<(String, usize)>,
    /// The calls that made what is looked at, the innermost first.
    calls: &'a [Spanned<String>],
}

impl<'a> Check<'a> {
    fn new(scene: &'a Scene, problems: &'a mut Problems, whole: bool) -> Self {
        Self { scene, problems, whole, reported: FxHashSet::default(), calls: &[] }
    }
}

impl Check<'_> {
    fn report(&mut self, error: impl Diagnostic + Send + Sync + 'static) {
        let code = error.code().map(|code| code.to_string()).unwrap_or_default();
        let place = error.labels().and_then(|mut labels| labels.next()).map_or(0, |label| label.offset());
        if self.reported.insert((code, place)) {
            let step = |call: &Spanned<String>| Trail {
                span: call.span,
                text: format!("in this call of `{}`", call.value),
            };
            self.problems.push_with_trail(error, self.calls.iter().map(step).collect());
        }
    }

    /// Notes a size that is not greater than 0.
    fn positive(&mut self, what: &'static str, size: Spanned<f64>, ty: Type) {
        if size.value <= 0.0 {
            let found = ty.write(size.value);
            self.report(CheckError::NotPositive { what, found, used: size.span, example: ty.example() });
        }
    }

    /// The materials of placed objects, through mixes, each with the object's span; some of them more than once.
    fn placed_materials(&self) -> impl Iterator<Item = (&MaterialKind, Span)> {
        let mut reached = vec![None; self.scene.materials.len()];
        for object in &self.scene.objects {
            if let Some(handle) = object.material {
                reached[handle.index()].get_or_insert(object.span);
            }
        }
        // A mix is written after its parts, so one pass from the back reaches them all.
        for (handle, material) in self.scene.materials.entries().collect::<Vec<_>>().into_iter().rev() {
            if let (MaterialKind::Mix { a, b, .. }, Some(span)) = (&material.kind, reached[handle.index()]) {
                reached[a.index()].get_or_insert(span);
                reached[b.index()].get_or_insert(span);
            }
        }
        self.scene
            .materials
            .entries()
            .filter_map(move |(handle, material)| reached[handle.index()].map(|span| (&material.kind, span)))
    }
}
