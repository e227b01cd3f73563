//! What things are made of, as far as it matters for where light can go.

use super::OwnMaterial;
use crate::ir::{Handle, Input, Material, MaterialKind, Scene};
use crate::math::Rgb;

/// What a thing does to light, where that is certain.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Stuff {
    /// No light gets through anywhere.
    pub(super) is_opaque: bool,
    /// All of it is one smooth glass.
    pub(super) clear: Option<Glass>,
    /// Some of it shines.
    pub(super) shines: bool,
    /// It is mere glow: black where nothing shines.
    pub(super) is_lamp: bool,
}

/// What tells one glass from another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Glass {
    pub(super) ior: f64,
    tint: Rgb,
    absorption: Rgb,
}

impl Stuff {
    const OPAQUE: Self = Self { is_opaque: true, clear: None, shines: false, is_lamp: false };

    /// Of a mesh that nothing gives a material.
    pub(super) fn of_own(parts: impl Iterator<Item = OwnMaterial>) -> Self {
        parts.fold(Self::OPAQUE, |all, part| Self {
            is_opaque: all.is_opaque && part == OwnMaterial::Opaque,
            shines: all.shines || part == OwnMaterial::Shining,
            ..all
        })
    }
}

/// The stuff of every material.
pub(super) struct Stuffs(Vec<Stuff>);

impl Stuffs {
    pub(super) fn of(scene: &Scene) -> Self {
        let mut stuffs: Vec<Stuff> = Vec::with_capacity(scene.materials.len());
        for material in scene.materials.iter() {
            // A mix comes after its parts.
            let part = |handle: Handle<Material>| stuffs[handle.index()];
            stuffs.push(stuff(&material.kind, part));
        }
        Self(stuffs)
    }

    pub(super) fn get(&self, material: Handle<Material>) -> Stuff {
        self.0[material.index()]
    }
}

fn stuff(kind: &MaterialKind, part: impl Fn(Handle<Material>) -> Stuff) -> Stuff {
    match kind {
        MaterialKind::Diffuse { .. }
        | MaterialKind::Phong { .. }
        | MaterialKind::Mirror { .. }
        | MaterialKind::Metal { .. } => Stuff::OPAQUE,
        MaterialKind::Whitted { transmission: Input::Constant(color), .. } if color.is_black() => {
            Stuff::OPAQUE
        }
        MaterialKind::Whitted { .. } => Stuff::default(),
        MaterialKind::Glass { ior, tint, absorption } => {
            let glass = Glass { ior: ior.value, tint: tint.value, absorption: *absorption };
            Stuff { clear: Some(glass), ..Stuff::default() }
        }
        MaterialKind::Emissive { .. } => Stuff { shines: true, is_lamp: true, ..Stuff::default() },
        MaterialKind::Mix { a, b, .. } => {
            let (a, b) = (part(*a), part(*b));
            Stuff { is_opaque: a.is_opaque && b.is_opaque, shines: a.shines || b.shines, ..Stuff::default() }
        }
    }
}
