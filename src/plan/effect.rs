//! The effects by name, and what each of them adds to a render.

/// Something that a picture may need simulated.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Effect {
    /// A lens opening: depth of field.
    LensBlur,
    /// Things that move while the shutter is open, or the camera.
    Motion,
    /// Lights with a size.
    SoftShadows,
    /// Light from everywhere.
    Environment,
    /// Emissive objects.
    MeshLights,
    /// Colours looked up at points.
    Textures,
    /// Means of pictures where a pixel covers many of theirs.
    TextureFiltering,
    /// Normals bent by pictures.
    NormalMaps,
    /// Surfaces with holes.
    Alpha,
    /// Normals blended between vertices.
    SmoothNormals,
    /// Meshes that are kept once and placed often.
    Instances,
    /// Perfect mirrors and glass.
    Specular,
    /// Light that goes through.
    Dielectrics,
    /// Highlights with a width.
    RoughSpecular,
    /// Glass that colours light on its way.
    Absorption,
    /// Glass that bends each wavelength in its own way.
    Dispersion,
    /// Light that bounces between surfaces.
    Indirect,
    /// Light that reaches a matt surface by way of a mirror or through glass.
    Caustics,
}

impl Effect {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 18] = [
        Self::LensBlur,
        Self::Motion,
        Self::SoftShadows,
        Self::Environment,
        Self::MeshLights,
        Self::Textures,
        Self::TextureFiltering,
        Self::NormalMaps,
        Self::Alpha,
        Self::SmoothNormals,
        Self::Instances,
        Self::Specular,
        Self::Dielectrics,
        Self::RoughSpecular,
        Self::Absorption,
        Self::Dispersion,
        Self::Indirect,
        Self::Caustics,
    ];

    /// The name by which people know it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::LensBlur => "lens_blur",
            Self::Motion => "motion",
            Self::SoftShadows => "soft_shadows",
            Self::Environment => "environment",
            Self::MeshLights => "mesh_lights",
            Self::Textures => "textures",
            Self::TextureFiltering => "texture_filtering",
            Self::NormalMaps => "normal_maps",
            Self::Alpha => "alpha",
            Self::SmoothNormals => "smooth_normals",
            Self::Instances => "instances",
            Self::Specular => "specular",
            Self::Dielectrics => "dielectrics",
            Self::RoughSpecular => "rough_specular",
            Self::Absorption => "absorption",
            Self::Dispersion => "dispersion",
            Self::Indirect => "indirect",
            Self::Caustics => "caustics",
        }
    }

    /// The effect of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }

    /// What it adds to a render that has it.
    pub const fn adds(self) -> &'static str {
        match self {
            Self::LensBlur => "a point of the lens for each path",
            Self::Motion => "a moment for each path, a transform for each thing that moves",
            Self::SoftShadows => "a point of a light at each vertex",
            Self::Environment => "a table of the sky, a look at it by each ray that leaves",
            Self::MeshLights => "a light for each triangle that shines",
            Self::Textures => "pixels in memory, a look at them at each hit",
            Self::TextureFiltering => "a third more pixels in memory, a gradient and two looks at each hit",
            Self::NormalMaps => "a gradient and a bent normal at each hit",
            Self::Alpha => "a look at the opacity of each hit, shadow rays too",
            Self::SmoothNormals => "a normal for each vertex",
            Self::Instances => "a second tree, a ray into its frame",
            Self::Specular => "longer paths",
            Self::Dielectrics => "what each path is inside of, paths that branch by chance",
            Self::RoughSpecular => "a lobe to evaluate at each hit",
            Self::Absorption => "an exponential for each metre of glass",
            Self::Dispersion => "a wavelength for each path, noise in colour",
            Self::Indirect => "paths that go on after matt surfaces",
            Self::Caustics => "photons, their tree, a look into it at each matt hit",
        }
    }

    /// What a picture is like without it, for those that can be left out of one that calls for them.
    pub const fn without(self) -> Option<&'static str> {
        match self {
            Self::LensBlur => Some("sharp at every distance"),
            Self::Motion => Some("as it is when the shutter opens"),
            Self::Environment => Some("black around"),
            Self::TextureFiltering => Some("with more noise on pictures far away"),
            Self::NormalMaps => Some("flat where normals were bent"),
            Self::Alpha => Some("whole where there were holes"),
            Self::SmoothNormals => Some("faceted"),
            Self::Absorption => Some("clear where glass was coloured"),
            Self::Dispersion => Some("without rainbows"),
            Self::Indirect => Some("dark where only light from matt surfaces arrives"),
            Self::Caustics => Some("without light that was focused or mirrored onto matt surfaces"),
            Self::SoftShadows
            | Self::MeshLights
            | Self::Textures
            | Self::Instances
            | Self::Specular
            | Self::Dielectrics
            | Self::RoughSpecular => None,
        }
    }
}
