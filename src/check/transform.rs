//! Transforms that flatten what they move.

use super::Check;
use super::error::CheckError;
use crate::ir::{Object, is_singular};
use crate::source::Span;

impl Check<'_> {
    /// Reports singular transforms, by the factor that is to blame.
    pub(super) fn transforms(&mut self) {
        for object in self.scene.objects.iter().filter(|object| is_singular(&object.world_from_object)) {
            let start = Span::new(object.span.start, object.span.start + 1);
            self.report(CheckError::SingularTransform { factor: blame(object), object: start });
        }
    }
}

/// The first factor that is singular alone, or else the last one.
fn blame(object: &Object) -> Span {
    let guilty = object.transforms.iter().find(|step| is_singular(&step.matrix));
    guilty.or(object.transforms.last()).map_or(object.span, |step| step.span)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{DAffine3, DVec3};

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
}
