//! Colours by name, by hue and by temperature; always linear Rec. 709 in the end.

use crate::math::Rgb;
use crate::schema::COLORS;

/// The linear colour of a CSS name.
pub fn named(name: &str) -> Option<Rgb> {
    let &(_, code) = COLORS.iter().find(|(known, _)| *known == name)?;
    let [_, r, g, b] = code.to_be_bytes();
    Some(from_bytes([r, g, b]))
}

/// The linear colour of display values in 0..=255.
pub fn from_bytes([r, g, b]: [u8; 3]) -> Rgb {
    Rgb::from_srgb(f32::from(r) / 255.0, f32::from(g) / 255.0, f32::from(b) / 255.0)
}

/// The linear colour of a hue in radians, a saturation and a value in [0, 1] (Smith 1978).
///
/// The three name display values, as in a colour picker.
pub fn from_hsv(hue: f64, saturation: f64, value: f64) -> Rgb {
    let sextant = (hue / std::f64::consts::TAU).rem_euclid(1.0) * 6.0;
    let channel = |offset: f64| {
        let k = (offset + sextant) % 6.0;
        (value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0)) as f32
    };
    Rgb::from_srgb(channel(5.0), channel(3.0), channel(1.0))
}

/// The colour of a black body at `kelvin`, with luminance 1; channels outside Rec. 709 are cut to 0.
///
/// Planck's law, weighted by the CIE 1931 functions every 5 nm from 380 nm to 780 nm.
pub fn black_body(kelvin: f64) -> Rgb {
    let mut xyz = [0.0; 3];
    for step in 0..=80 {
        let nanometres = 380.0 + 5.0 * f64::from(step);
        let radiance = planck(nanometres, kelvin);
        let weights = cie_1931(nanometres);
        for (sum, weight) in xyz.iter_mut().zip(weights) {
            *sum += weight * radiance;
        }
    }
    // XYZ to linear Rec. 709 (ITU-R BT.709, inverse of the primaries' matrix with a D65 white).
    let [x, y, z] = xyz.map(|sum| sum / xyz[1]);
    let rgb = Rgb::new(
        (3.240_969_94 * x - 1.537_383_18 * y - 0.498_610_76 * z) as f32,
        (-0.969_243_64 * x + 1.875_967_5 * y + 0.041_555_06 * z) as f32,
        (0.055_630_08 * x - 0.203_976_96 * y + 1.056_971_51 * z) as f32,
    )
    .map(|channel| channel.max(0.0));
    rgb / rgb.luminance()
}

/// Planck's law up to a constant: the spectral radiance at a wavelength, relative to that at 560 nm.
fn planck(nanometres: f64, kelvin: f64) -> f64 {
    /// The second radiation constant hc/k, in nm·K (CODATA 2018).
    const C2: f64 = 1.438_776_877e7;
    /// A wavelength where no temperature a scene may name underflows the ratio.
    const PIVOT: f64 = 560.0;
    let exponent = |nm: f64| C2 / (nm * kelvin);
    // (e^a − 1) / (e^b − 1) with the larger exponent divided out, so that cold bodies do not overflow.
    let (a, b) = (exponent(PIVOT), exponent(nanometres));
    let ratio = libm::exp(a - b) * (-libm::expm1(-a)) / (-libm::expm1(-b));
    ratio * (PIVOT / nanometres).powi(5)
}

/// The colour-matching functions of the CIE 1931 observer: the multi-lobe fit of Wyman, Sloan & Shirley 2013, eq. 4.
fn cie_1931(nanometres: f64) -> [f64; 3] {
    let lobe = |peak: f64, below: f64, above: f64| {
        let t = (nanometres - peak) * if nanometres < peak { below } else { above };
        libm::exp(-0.5 * t * t)
    };
    [
        1.056 * lobe(599.8, 0.0264, 0.0323) + 0.362 * lobe(442.0, 0.0624, 0.0374)
            - 0.065 * lobe(501.1, 0.0490, 0.0382),
        0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
        1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_black_body_at_6500_kelvin_is_nearly_white() {
        let white = black_body(6500.0);
        for channel in white.to_array() {
            assert!((channel - 1.0).abs() < 0.08, "{white:?}");
        }
    }

    #[test]
    fn a_black_body_has_luminance_one_and_reddens_as_it_cools() {
        let mut last = 0.0;
        for kelvin in [40_000.0, 10_000.0, 6_500.0, 3_200.0, 1_900.0, 1_000.0, 600.0] {
            let color = black_body(kelvin);
            assert!((color.luminance() - 1.0).abs() < 1e-5, "{kelvin} K");
            assert!(color.is_valid() && last < color.r, "{kelvin} K: {color:?}");
            last = color.r;
        }
    }

    #[test]
    fn names_and_hues_agree() {
        let close = |a: Rgb, b: Rgb| (a - b).map(f32::abs).max_component() < 1e-6;
        assert!(close(from_hsv(0.0, 1.0, 1.0), named("red").expect("listed")));
        assert!(close(from_hsv(std::f64::consts::PI, 1.0, 1.0), named("cyan").expect("listed")));
        assert!(close(from_hsv(1.0, 0.0, 1.0), Rgb::WHITE));
        assert_eq!(named("tomatoe"), None);
    }
}
