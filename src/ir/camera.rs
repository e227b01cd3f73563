//! Cameras and film.

use super::TransformStep;
use crate::math::{DAffine3, DVec2, DVec3, Motion};
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
    /// The share of a frame for which the shutter is open, from the frame's beginning on; 0 takes what stands there then.
    pub shutter: Spanned<f64>,
    /// What moves it, the innermost first: applied to position, direction and up already, as they are when a frame begins.
    pub transform: Vec<TransformStep>,
    /// Its block.
    pub span: Span,
}

impl Camera {
    /// Where it is while its shutter is open, from where it is when a frame begins; `None` where it stands still.
    pub fn seen_motion(&self) -> Option<Motion> {
        let whole = Motion::new(self.transform.iter().map(|step| step.factor))?;
        whole.part(whole.at(0.0).inverse(), self.shutter.value, DAffine3::IDENTITY)
    }
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
        /// How far the picture is shifted to the right and upwards, in shares of its width and height.
        shift: DVec2,
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
        /// How many times as high as wide the opening is.
        anamorphic: Spanned<f64>,
        /// How far the barrel cuts the opening in the corners, in its radii.
        cat_eye: Spanned<f64>,
        /// As for a pinhole.
        shift: DVec2,
        /// How far the lens is turned upwards and to the right, in radians.
        tilt: [Spanned<f64>; 2],
    },
    /// Parallel rays.
    Orthographic {
        /// Width or height of what is seen, in metres.
        size: Spanned<f64>,
        /// Whether `size` is the width.
        is_width: bool,
    },
    /// All around: longitude to the right, latitude upwards.
    Panorama {
        /// From left to right, in radians.
        width: Spanned<f64>,
        /// From bottom to top, in radians.
        height: Spanned<f64>,
    },
    /// A round picture of a wide view.
    Fisheye {
        /// From rim to rim, in radians.
        angle: Spanned<f64>,
        /// From angle to radius.
        mapping: Mapping,
        /// Whether the corners of the film lie on the rim; otherwise its shorter sides do.
        full: bool,
    },
    /// Through the surfaces of a real lens.
    Prescription {
        /// The table of surfaces, as written.
        file: Spanned<String>,
        /// The f-number; `None`: as far open as the table says.
        aperture: Option<Spanned<f64>>,
        /// What is sharp.
        focus: Option<Spanned<Focus>>,
    },
}

/// How a fisheye lens maps the angle θ from its axis to the distance from the picture's middle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mapping {
    /// θ.
    Equidistant,
    /// sin θ/2.
    EquisolidAngle,
    /// tan θ/2.
    Stereographic,
    /// sin θ.
    Orthographic,
}

impl Lens {
    /// The focal length that gives the field of view, with its place.
    pub const fn focal_length(&self) -> Option<Spanned<f64>> {
        match self {
            Self::Pinhole { focal_length, .. } | Self::Thin { focal_length, .. } => *focal_length,
            _ => None,
        }
    }

    /// What is sharp.
    pub const fn focus(&self) -> Option<&Spanned<Focus>> {
        match self {
            Self::Thin { focus, .. } | Self::Prescription { focus, .. } => focus.as_ref(),
            _ => None,
        }
    }

    /// Whether the picture is a perspective whose field of view the camera says.
    pub const fn has_fov(&self) -> bool {
        matches!(self, Self::Pinhole { .. } | Self::Thin { .. })
    }
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
    /// The part that is rendered, in shares of the picture from its top left: left, top, right, bottom.
    pub crop: Option<Spanned<[f64; 4]>>,
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
    /// The part that is rendered, in pixels from the top left: column, row, width, height. `None`: all of it.
    pub fn crop_in_pixels(&self) -> Option<[u32; 4]> {
        let (width, height) = self.size.value;
        let [left, top, right, bottom] = self.crop?.value;
        let edge = |share: f64, count: u32| (share * f64::from(count)).round() as u32;
        let (x, y) = (edge(left, width), edge(top, height));
        Some([x, y, edge(right, width).saturating_sub(x), edge(bottom, height).saturating_sub(y)])
    }

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
    Mitchell(f64),
    BlackmanHarris(f64),
}

impl Filter {
    /// How far it reaches, in pixels.
    pub const fn radius(self) -> f64 {
        let (Self::Box(radius)
        | Self::Tent(radius)
        | Self::Gaussian(radius)
        | Self::Mitchell(radius)
        | Self::BlackmanHarris(radius)) = self;
        radius
    }

    /// The same, reaching `radius` pixels.
    #[must_use]
    pub const fn with_radius(self, radius: f64) -> Self {
        match self {
            Self::Box(_) => Self::Box(radius),
            Self::Tent(_) => Self::Tent(radius),
            Self::Gaussian(_) => Self::Gaussian(radius),
            Self::Mitchell(_) => Self::Mitchell(radius),
            Self::BlackmanHarris(_) => Self::BlackmanHarris(radius),
        }
    }
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
