//! Cameras and film.

use crate::math::DVec3;
use crate::source::{Span, Spanned};

/// A camera.
#[derive(Clone, PartialEq, Debug)]
pub struct Camera {
    /// `camera front { .. }`.
    pub name: Option<Spanned<String>>,
    /// The pinhole, or the centre of the lens.
    pub position: Spanned<DVec3>,
    /// The way it looks; not necessarily a unit vector.
    pub direction: Spanned<DVec3>,
    /// What is up.
    pub up: Spanned<DVec3>,
    /// The field of view; `None` when the lens's focal length decides.
    pub fov: Option<Spanned<Fov>>,
    /// The lens.
    pub lens: Lens,
    /// The film.
    pub film: Film,
    /// Its block.
    pub span: Span,
}

/// A full angle, in radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Fov {
    /// From the bottom to the top of the picture.
    Vertical(f64),
    /// From its left to its right.
    Horizontal(f64),
}

/// How light gets in.
#[derive(Clone, PartialEq, Debug)]
pub enum Lens {
    /// Through a point: everything is sharp.
    Pinhole {
        /// In metres; gives the field of view together with the sensor.
        focal_length: Option<Spanned<f64>>,
    },
    /// Through a thin lens.
    Thin {
        /// In metres.
        focal_length: Option<Spanned<f64>>,
        /// Radius of the opening in metres: given, or focal length / (2 · f-number).
        radius: Spanned<f64>,
        /// What is sharp.
        focus: Option<Spanned<Focus>>,
        /// Blades of the iris; 0 is round.
        blades: Spanned<u32>,
        /// Turn of the iris, in radians.
        rotation: Spanned<f64>,
    },
}

/// What is in focus.
#[derive(Clone, PartialEq, Debug)]
pub enum Focus {
    /// The plane at this distance along the view axis, in metres.
    Distance(f64),
    /// The plane through a point.
    Point(DVec3),
    /// The middle of an object: the id that its `names` hold, and its name for reports.
    On(u32, String),
}

/// What the light falls on, and what is done with it.
#[derive(Clone, PartialEq, Debug)]
pub struct Film {
    /// Pixels, width by height.
    pub size: Spanned<(u32, u32)>,
    /// The pixel filter.
    pub filter: Spanned<Filter>,
    /// The width of a pixel by its height.
    pub pixel_aspect: Spanned<f64>,
    /// The width in metres; the height follows from the pixels.
    pub sensor: Spanned<f64>,
    /// Brightness of the picture.
    pub exposure: Spanned<Exposure>,
    /// From linear radiance to display values.
    pub tone: Spanned<Tone>,
}

impl Film {
    /// The width of the picture by its height.
    pub fn aspect(&self) -> f64 {
        let (width, height) = self.size.value;
        self.pixel_aspect.value * f64::from(width) / f64::from(height)
    }
}

/// Pixel filters, with their radius in pixels.
#[derive(Clone, Copy, PartialEq, Debug)]
#[expect(missing_docs, reason = "the field's names")]
pub enum Filter {
    Box(f64),
    Tent(f64),
    Gaussian(f64),
}

/// How bright the picture becomes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Exposure {
    /// Radiance times 2 to this power.
    Ev(f64),
    /// So that the log-average luminance becomes 0.18.
    Auto,
}

/// Tone curves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "the field's names")]
pub enum Tone {
    Srgb,
    Linear,
    Reinhard,
    Agx,
}
