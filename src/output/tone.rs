//! From linear radiance to the display: exposure, then a tone curve.

use crate::math::{Rgb, float, rgb};

/// How bright the picture becomes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Exposure {
    /// Radiance times 2 to this power.
    Ev(f32),
    /// So that the log-average luminance of the picture becomes 0.18 (Reinhard et al. 2002, eq. 1 and 2).
    Auto,
}

impl std::fmt::Display for Exposure {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ev(ev) => write!(out, "{ev}EV"),
            Self::Auto => out.write_str("auto"),
        }
    }
}

impl std::str::FromStr for Exposure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ev = || text.strip_suffix("EV").unwrap_or(text).trim().parse::<f32>().ok();
        match text {
            "auto" => Ok(Self::Auto),
            _ => match ev().filter(|ev| ev.abs() <= Self::MOST_STOPS) {
                Some(ev) => Ok(Self::Ev(ev)),
                None => Err("write `auto`, or stops such as `1.5EV` or `-2`, at most 100 of them".to_owned()),
            },
        }
    }
}

impl Exposure {
    /// Stops beyond which nothing but black or white is left of any picture.
    const MOST_STOPS: f32 = 100.0;

    /// What brings radiance to the display: radiance times this is shown.
    pub fn factor(self, radiance: &[Rgb]) -> f32 {
        match self {
            Self::Ev(ev) => float::pow(2.0, ev),
            Self::Auto => auto_factor(radiance),
        }
    }
}

/// Tone curves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Tone {
    /// The display's own curve; what is above 1 is cut off.
    Srgb,
    /// No curve: linear values, cut off at 1.
    Linear,
    /// L / (1 + L) on luminance (Reinhard et al. 2002, eq. 3), then the display's curve.
    Reinhard,
    /// A film-like curve that desaturates highlights (Sobotka's AgX, in the polynomial fit of Wrensch 2023).
    Agx,
}

/// How a picture is shown.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Display {
    /// Brightness.
    pub exposure: Exposure,
    /// Curve.
    pub tone: Tone,
    /// Whether display values lose their fraction, rather than being rounded to the nearest of 256 steps.
    pub floor: bool,
}

impl Display {
    /// What a file tells of how its picture is meant to be shown: what [`Exposure`] and [`Tone`] are read back from.
    pub fn facts(&self) -> [(String, String); 2] {
        [("exposure".to_owned(), self.exposure.to_string()), ("tone".to_owned(), self.tone.name().to_owned())]
    }

    /// Display values of linear radiance.
    pub fn develop(&self, radiance: &[Rgb]) -> Vec<[u8; 3]> {
        let factor = self.exposure.factor(radiance);
        let half = if self.floor { 0.0 } else { 0.5 };
        let quantise = |color: Rgb| color.to_array().map(|x| (x * 255.0 + half) as u8);
        radiance.iter().map(|&pixel| quantise(self.tone.curve(pixel * factor))).collect()
    }
}

impl Tone {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Srgb, Self::Linear, Self::Reinhard, Self::Agx];

    /// The name by which scenes know it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Srgb => "srgb",
            Self::Linear => "linear",
            Self::Reinhard => "reinhard",
            Self::Agx => "agx",
        }
    }

    /// The curve of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|tone| tone.name() == name)
    }

    /// The display value in [0, 1] of an exposed linear colour.
    pub fn curve(self, color: Rgb) -> Rgb {
        let clamp = |c: Rgb| c.map(|x| x.clamp(0.0, 1.0));
        match self {
            Self::Linear => clamp(color),
            Self::Srgb => clamp(color).map(rgb::linear_to_srgb),
            Self::Reinhard => clamp(color / (1.0 + color.luminance().max(0.0))).map(rgb::linear_to_srgb),
            Self::Agx => agx(color),
        }
    }
}

/// What brings the log-average luminance to 0.18. Black pixels say nothing about the exposure and are left out.
fn auto_factor(radiance: &[Rgb]) -> f32 {
    const MIDDLE_GRAY: f64 = 0.18;
    let mut sum = 0.0;
    let mut count = 0_u32;
    for luminance in radiance.iter().map(|pixel| f64::from(pixel.luminance())).filter(|&y| y > 0.0) {
        sum += libm::log(luminance);
        count += 1;
    }
    if count == 0 { 1.0 } else { (MIDDLE_GRAY / libm::exp(sum / f64::from(count))) as f32 }
}

/// AgX: into its own primaries, a log₂ range of 16.5 stops, a polynomial S-curve, and back (Wrensch 2023).
fn agx(color: Rgb) -> Rgb {
    const IN: [[f32; 3]; 3] = [
        [0.842_479, 0.078_433_6, 0.079_223_745],
        [0.042_328_242, 0.878_468_6, 0.079_166_13],
        [0.042_375_655, 0.078_433_6, 0.879_143],
    ];
    const OUT: [[f32; 3]; 3] = [
        [1.196_879, -0.098_020_88, -0.099_029_74],
        [-0.052_896_85, 1.151_903_1, -0.098_961_18],
        [-0.052_971_635, -0.098_043_45, 1.151_073_7],
    ];
    const MIN_EV: f32 = -12.473_93;
    const MAX_EV: f32 = 4.026_069;
    let log = apply(&IN, color).map(|x| {
        let stops = float::ln(x.max(1e-10)) / std::f32::consts::LN_2;
        ((stops - MIN_EV) / (MAX_EV - MIN_EV)).clamp(0.0, 1.0)
    });
    apply(&OUT, log.map(agx_contrast)).map(|x| x.clamp(0.0, 1.0))
}

/// The S-curve on [0, 1], by Horner's scheme.
fn agx_contrast(x: f32) -> f32 {
    let coefficients = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.002_32];
    coefficients.into_iter().fold(0.0, |sum, c| sum * x + c)
}

fn apply(m: &[[f32; 3]; 3], c: Rgb) -> Rgb {
    let row = |r: &[f32; 3]| r[0] * c.r + r[1] * c.g + r[2] * c.b;
    Rgb::new(row(&m[0]), row(&m[1]), row(&m[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_exposure_brings_an_even_picture_to_middle_gray() {
        let display = Display { exposure: Exposure::Auto, tone: Tone::Linear, floor: false };
        for level in [1e-3, 1.0, 500.0] {
            assert_eq!(display.develop(&[Rgb::gray(level); 4])[0], [46; 3], "at {level}"); // 0.18 · 255
        }
        assert_eq!(display.develop(&[Rgb::BLACK; 4])[0], [0; 3]);
    }

    #[test]
    fn every_curve_rises_and_ends_at_the_display_s_range() {
        for tone in Tone::ALL {
            let levels: Vec<f32> = (0..200).map(|i| tone.curve(Rgb::gray(0.02 * i as f32)).g).collect();
            assert!(levels.windows(2).all(|w| w[0] <= w[1] + 1e-6), "{tone:?}");
            assert!(levels.iter().all(|x| (0.0..=1.0).contains(x)), "{tone:?}");
            assert!(levels[0] < 0.01 && levels[199] > 0.7, "{tone:?}");
        }
    }

    #[test]
    fn what_a_file_tells_of_its_display_is_read_back() {
        for exposure in [Exposure::Auto, Exposure::Ev(-2.5), Exposure::Ev(0.0)] {
            assert_eq!(exposure.to_string().parse(), Ok(exposure));
        }
        for tone in Tone::ALL {
            assert_eq!(Tone::named(tone.name()), Some(tone));
        }
        for wrong in ["", "bright", "nanEV", "1e9", "infEV"] {
            assert!(wrong.parse::<Exposure>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn one_stop_doubles() {
        let linear = |ev| Display { exposure: Exposure::Ev(ev), tone: Tone::Linear, floor: false };
        assert_eq!(linear(1.0).develop(&[Rgb::gray(0.2)]), [[102; 3]]);
    }
}
