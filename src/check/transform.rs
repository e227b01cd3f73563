//! Transforms that flatten what they move, or nearly do.

use super::Check;
use super::error::CheckError;
use crate::ir::{Object, ShapeKind, TransformStep, is_singular, is_squeezing};
use crate::math::DAffine3;
use crate::source::Span;

impl Check<'_> {
    /// Reports singular transforms, and nearly singular ones of what has a volume, by the factor that is to blame.
    pub(super) fn transforms(&mut self) {
        let scene = self.scene;
        for object in scene.objects.iter().filter(|object| !object.transforms.is_empty()) {
            let start = Span::new(object.span.start, object.span.start + 1);
            if is_singular(&object.world_from_object) {
                let (factor, said) = blame(object, is_singular);
                self.report(CheckError::SingularTransform { factor, said, object: start });
            } else if has_volume(&scene.shapes[object.shape].kind) && is_squeezing(&object.world_from_object)
            {
                let (factor, _) = blame(object, is_squeezing);
                self.report(CheckError::SqueezingTransform { factor, object: start });
            }
        }
    }
}

/// The factor by which a chain of transforms becomes what it must not be, and what to say of it.
fn blame(object: &Object, is_bad: fn(&DAffine3) -> bool) -> (Span, String) {
    let mut product = DAffine3::IDENTITY;
    let guilty = object.transforms.iter().find(|step| {
        product = step.matrix() * product;
        is_bad(&step.matrix()) || is_bad(&product)
    });
    let guilty = guilty.or(object.transforms.last());
    (guilty.map_or(object.span, |step| step.span), guilty.map_or_else(String::new, vanishing))
}

/// The axes along which a scale has the factor 0.
fn vanishing(step: &TransformStep) -> String {
    let diagonal = step.matrix().matrix3;
    let axes = ["x", "y", "z"].into_iter().enumerate().filter(|&(i, _)| diagonal.col(i).length() == 0.0);
    let axes: Vec<&str> = axes.map(|(_, name)| name).collect();
    match axes.as_slice() {
        [] => "leaves no volume".to_owned(),
        axes => format!("its factor along {} is 0", axes.join(" and ")),
    }
}

/// Whether a shape has two sides that can be too near to each other.
fn has_volume(kind: &ShapeKind) -> bool {
    match kind {
        ShapeKind::Sphere { .. }
        | ShapeKind::Box { .. }
        | ShapeKind::Cone { .. }
        | ShapeKind::Torus { .. }
        | ShapeKind::Sweep { .. }
        | ShapeKind::Mesh { .. }
        | ShapeKind::Revolve { .. }
        | ShapeKind::Extrude { .. } => true,
        ShapeKind::Plane { .. }
        | ShapeKind::Disk { .. }
        | ShapeKind::Quad { .. }
        | ShapeKind::Heightfield { .. }
        | ShapeKind::Triangle { .. } => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::DVec3;

    #[test]
    fn only_vanishing_volume_is_singular() {
        assert!(is_singular(&DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0))));
        assert!(!is_singular(&DAffine3::from_scale(DVec3::new(1e-20, 1e20, 1.0))));
        assert!(!is_singular(&DAffine3::from_scale(DVec3::splat(1e-9))));
        let mut sheared = DAffine3::IDENTITY;
        sheared.matrix3.y_axis = DVec3::new(1.0, 1e-13, 0.0);
        assert!(is_singular(&sheared));
        sheared.matrix3.y_axis = DVec3::new(1.0, 1e-10, 0.0);
        assert!(!is_singular(&sheared));
    }

    #[test]
    fn only_uneven_scales_squeeze() {
        assert!(!is_squeezing(&DAffine3::from_scale(DVec3::splat(1e-12))));
        assert!(!is_squeezing(&DAffine3::from_scale(DVec3::new(1.0, -1e-6, 1.0))));
        assert!(is_squeezing(&DAffine3::from_scale(DVec3::new(1.0, 1e-9, 1.0))));
    }
}
