//! Transforms that flatten what they move.

use super::Check;
use super::error::CheckError;
use crate::ir::Object;
use crate::math::DAffine3;
use crate::source::Span;
use rustc_hash::FxHashSet;

impl Check<'_> {
    /// Reports singular transforms, each factor that is to blame once.
    pub(super) fn transforms(&mut self) {
        let mut blamed: FxHashSet<Span> = FxHashSet::default();
        for object in self.scene.objects.iter().filter(|object| is_singular(&object.world_from_object)) {
            let factor = blame(object);
            if blamed.insert(factor) {
                self.report(CheckError::SingularTransform { factor, object: object.span });
            }
        }
    }
}

/// Whether the determinant vanishes beside the product of the columns' lengths.
fn is_singular(transform: &DAffine3) -> bool {
    /// Below this the volume is rounding error (f64 has 2⁻⁵³; a few factors lose a few digits).
    const VANISHING: f64 = 1e-12;
    let m = transform.matrix3;
    let lengths = m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
    m.determinant().abs() <= VANISHING * lengths
}

/// The first factor that is singular alone, or else the last one.
fn blame(object: &Object) -> Span {
    let guilty = object.transforms.iter().find(|step| is_singular(&step.matrix));
    guilty.or(object.transforms.last()).map_or(object.span, |step| step.span)
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
}
