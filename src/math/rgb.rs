//! Linear colours.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Index, Mul, MulAssign, Sub};

/// Three channels, linear, Rec. 709 primaries: a reflectance, a radiance, a throughput.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

impl Rgb {
    /// Nothing.
    pub const BLACK: Self = Self::gray(0.0);
    /// One in each channel.
    pub const WHITE: Self = Self::gray(1.0);

    /// A colour from its channels.
    pub const fn new(r: f32, g: f32, b: f32) -> Self {
        Self { r, g, b }
    }

    /// The same value in each channel.
    pub const fn gray(value: f32) -> Self {
        Self::new(value, value, value)
    }

    /// The CIE luminance Y of linear Rec. 709 (ITU-R BT.709, table 3).
    pub fn luminance(self) -> f32 {
        0.2126 * self.r + 0.7152 * self.g + 0.0722 * self.b
    }

    /// The largest channel.
    pub fn max_component(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }

    /// The smallest channel.
    pub fn min_component(self) -> f32 {
        self.r.min(self.g).min(self.b)
    }

    /// The mean of the channels.
    pub fn mean(self) -> f32 {
        (self.r + self.g + self.b) / 3.0
    }

    /// Whether every channel is exactly 0.
    pub fn is_black(self) -> bool {
        self == Self::BLACK
    }

    /// Whether every channel is finite and not negative: what a radiance must be.
    pub fn is_valid(self) -> bool {
        let ok = |x: f32| x.is_finite() && x >= 0.0;
        ok(self.r) && ok(self.g) && ok(self.b)
    }

    /// Whether every channel is finite.
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// `f` applied to each channel.
    pub fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Self::new(f(self.r), f(self.g), f(self.b))
    }

    /// `self` at 0, `other` at 1.
    pub fn lerp(self, other: Self, t: f32) -> Self {
        self * (1.0 - t) + other * t
    }

    /// The linear colour of display values in [0, 1] (IEC 61966-2-1).
    pub fn from_srgb(r: f32, g: f32, b: f32) -> Self {
        Self::new(r, g, b).map(srgb_to_linear)
    }

    /// The channels in order.
    pub const fn to_array(self) -> [f32; 3] {
        [self.r, self.g, self.b]
    }
}

/// Display value in [0, 1] to linear value in [0, 1] (IEC 61966-2-1).
pub fn srgb_to_linear(x: f32) -> f32 {
    if x <= 0.04045 { x / 12.92 } else { super::float::pow((x + 0.055) / 1.055, 2.4) }
}

/// Linear value in [0, 1] to display value in [0, 1] (IEC 61966-2-1).
pub fn linear_to_srgb(x: f32) -> f32 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * super::float::pow(x, 1.0 / 2.4) - 0.055 }
}

impl From<[f32; 3]> for Rgb {
    fn from([r, g, b]: [f32; 3]) -> Self {
        Self::new(r, g, b)
    }
}

impl Index<usize> for Rgb {
    type Output = f32;
    fn index(&self, channel: usize) -> &f32 {
        match channel {
            0 => &self.r,
            1 => &self.g,
            _ => &self.b,
        }
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.r + other.r, self.g + other.g, self.b + other.b)
    }
}

impl Sub for Rgb {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.r - other.r, self.g - other.g, self.b - other.b)
    }
}

impl Mul for Rgb {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.r * other.r, self.g * other.g, self.b * other.b)
    }
}

impl Mul<f32> for Rgb {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        self.map(|x| x * factor)
    }
}

impl Div<f32> for Rgb {
    type Output = Self;
    fn div(self, divisor: f32) -> Self {
        self.map(|x| x / divisor)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl MulAssign for Rgb {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl MulAssign<f32> for Rgb {
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

impl DivAssign<f32> for Rgb {
    fn div_assign(&mut self, divisor: f32) {
        *self = *self / divisor;
    }
}

impl Sum for Rgb {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::BLACK, Add::add)
    }
}
