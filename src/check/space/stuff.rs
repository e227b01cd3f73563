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
    /// Some of it is a mirror, or glass.
    pub(super) is_specular: bool,
    /// Some of it spreads light: caustics can fall on it.
    pub(super) is_rough: bool,
}

/// What tells one glass from another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Glass {
    pub(super) ior: f64,
    /// Of several that overlap, the highest fills the space.
    pub(super) priority: i32,
    tint: Rgb,
    absorption: Rgb,
}

impl Stuff {
    /// What light stops at, matt all over.
    const MATT: Self = Self {
        is_opaque: true,
        clear: None,
        shines: false,
        is_lamp: false,
        is_specular: false,
        is_rough: true,
    };

    /// Of a mesh that nothing gives a material.
    pub(super) fn of_own(parts: impl Iterator<Item = OwnMaterial>) -> Self {
        parts.map(Self::of_part).reduce(Self::and).unwrap_or(Self::MATT)
    }

    fn of_part(part: OwnMaterial) -> Self {
        match part {
            OwnMaterial::Opaque => Self::MATT,
            OwnMaterial::Clear => Self { is_specular: true, ..Self::default() },
            OwnMaterial::Pierced => Self { is_specular: true, is_rough: true, ..Self::default() },
            OwnMaterial::Shining => Self { shines: true, ..Self::default() },
        }
    }

    /// What is of the one and of the other.
    fn and(self, other: Self) -> Self {
        Self {
            is_opaque: self.is_opaque && other.is_opaque,
            clear: None,
            shines: self.shines || other.shines,
            is_lamp: self.is_lamp && other.is_lamp,
            is_specular: self.is_specular || other.is_specular,
            is_rough: self.is_rough || other.is_rough,
        }
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
        MaterialKind::Diffuse { .. } | MaterialKind::Phong { .. } | MaterialKind::Metal { .. } => Stuff::MATT,
        MaterialKind::Whitted { transmission: Input::Constant(color), .. } if color.is_black() => Stuff::MATT,
        MaterialKind::Whitted { .. } => Stuff { is_specular: true, is_rough: true, ..Stuff::default() },
        MaterialKind::Mirror { .. } => Stuff { is_specular: true, is_rough: false, ..Stuff::MATT },
        MaterialKind::Glass { thin: Some(_), roughness, .. } => clear(None, *roughness),
        MaterialKind::Glass { ior, tint, absorption, priority, roughness, .. } => {
            let (tint, absorption) = (tint.value, *absorption);
            clear(Some(Glass { ior: ior.value, priority: *priority, tint, absorption }), *roughness)
        }
        MaterialKind::Plastic { .. } => Stuff::MATT,
        MaterialKind::Principled(of) => {
            let base = if is_black(of.transmission) { Stuff::MATT } else { clear(None, of.roughness) };
            Stuff { shines: !of.emission.is_black(), is_rough: true, ..base }
        }
        MaterialKind::Layer { base, .. } => Stuff { is_rough: true, ..part(*base) },
        MaterialKind::Mask { base, .. } => Stuff { is_opaque: false, clear: None, ..part(*base) },
        MaterialKind::TwoSided { front, back } => part(*front).and(part(*back)),
        MaterialKind::NormalMap { base, .. } | MaterialKind::Bump { base, .. } => part(*base),
        MaterialKind::Emissive { .. } => Stuff { shines: true, is_lamp: true, ..Stuff::default() },
        MaterialKind::Mix { a, b, .. } => part(*a).and(part(*b)),
    }
}

/// Something that light goes through, as sharply as its roughness lets it.
fn clear(glass: Option<Glass>, roughness: Input) -> Stuff {
    let smooth = matches!(roughness, Input::Constant(color) if color.value.mean() < SHARP_ROUGHNESS);
    Stuff { clear: glass, is_specular: smooth, is_rough: !smooth, ..Stuff::default() }
}

/// Glass smoother than this still gathers light into caustics.
const SHARP_ROUGHNESS: f32 = 0.5;

fn is_black(input: Input) -> bool {
    matches!(input, Input::Constant(color) if color.is_black())
}
