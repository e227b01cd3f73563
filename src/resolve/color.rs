//! Colours by name, by hue and by temperature; always linear Rec. 709 in the end.

use crate::math::Rgb;

/// The colours of CSS Color Module Level 4, as `0xrrggbb`.
#[rustfmt::skip]
pub const NAMED: &[(&str, u32)] = &[
    ("aliceblue", 0xf0f8ff), ("antiquewhite", 0xfaebd7), ("aqua", 0x00ffff), ("aquamarine", 0x7fffd4),
    ("azure", 0xf0ffff), ("beige", 0xf5f5dc), ("bisque", 0xffe4c4), ("black", 0x000000),
    ("blanchedalmond", 0xffebcd), ("blue", 0x0000ff), ("blueviolet", 0x8a2be2), ("brown", 0xa52a2a),
    ("burlywood", 0xdeb887), ("cadetblue", 0x5f9ea0), ("chartreuse", 0x7fff00), ("chocolate", 0xd2691e),
    ("coral", 0xff7f50), ("cornflowerblue", 0x6495ed), ("cornsilk", 0xfff8dc), ("crimson", 0xdc143c),
    ("cyan", 0x00ffff), ("darkblue", 0x00008b), ("darkcyan", 0x008b8b), ("darkgoldenrod", 0xb8860b),
    ("darkgray", 0xa9a9a9), ("darkgreen", 0x006400), ("darkgrey", 0xa9a9a9), ("darkkhaki", 0xbdb76b),
    ("darkmagenta", 0x8b008b), ("darkolivegreen", 0x556b2f), ("darkorange", 0xff8c00), ("darkorchid", 0x9932cc),
    ("darkred", 0x8b0000), ("darksalmon", 0xe9967a), ("darkseagreen", 0x8fbc8f), ("darkslateblue", 0x483d8b),
    ("darkslategray", 0x2f4f4f), ("darkslategrey", 0x2f4f4f), ("darkturquoise", 0x00ced1), ("darkviolet", 0x9400d3),
    ("deeppink", 0xff1493), ("deepskyblue", 0x00bfff), ("dimgray", 0x696969), ("dimgrey", 0x696969),
    ("dodgerblue", 0x1e90ff), ("firebrick", 0xb22222), ("floralwhite", 0xfffaf0), ("forestgreen", 0x228b22),
    ("fuchsia", 0xff00ff), ("gainsboro", 0xdcdcdc), ("ghostwhite", 0xf8f8ff), ("gold", 0xffd700),
    ("goldenrod", 0xdaa520), ("gray", 0x808080), ("green", 0x008000), ("greenyellow", 0xadff2f),
    ("grey", 0x808080), ("honeydew", 0xf0fff0), ("hotpink", 0xff69b4), ("indianred", 0xcd5c5c),
    ("indigo", 0x4b0082), ("ivory", 0xfffff0), ("khaki", 0xf0e68c), ("lavender", 0xe6e6fa),
    ("lavenderblush", 0xfff0f5), ("lawngreen", 0x7cfc00), ("lemonchiffon", 0xfffacd), ("lightblue", 0xadd8e6),
    ("lightcoral", 0xf08080), ("lightcyan", 0xe0ffff), ("lightgoldenrodyellow", 0xfafad2), ("lightgray", 0xd3d3d3),
    ("lightgreen", 0x90ee90), ("lightgrey", 0xd3d3d3), ("lightpink", 0xffb6c1), ("lightsalmon", 0xffa07a),
    ("lightseagreen", 0x20b2aa), ("lightskyblue", 0x87cefa), ("lightslategray", 0x778899),
    ("lightslategrey", 0x778899), ("lightsteelblue", 0xb0c4de), ("lightyellow", 0xffffe0), ("lime", 0x00ff00),
    ("limegreen", 0x32cd32), ("linen", 0xfaf0e6), ("magenta", 0xff00ff), ("maroon", 0x800000),
    ("mediumaquamarine", 0x66cdaa), ("mediumblue", 0x0000cd), ("mediumorchid", 0xba55d3), ("mediumpurple", 0x9370db),
    ("mediumseagreen", 0x3cb371), ("mediumslateblue", 0x7b68ee), ("mediumspringgreen", 0x00fa9a),
    ("mediumturquoise", 0x48d1cc), ("mediumvioletred", 0xc71585), ("midnightblue", 0x191970), ("mintcream", 0xf5fffa),
    ("mistyrose", 0xffe4e1), ("moccasin", 0xffe4b5), ("navajowhite", 0xffdead), ("navy", 0x000080),
    ("oldlace", 0xfdf5e6), ("olive", 0x808000), ("olivedrab", 0x6b8e23), ("orange", 0xffa500),
    ("orangered", 0xff4500), ("orchid", 0xda70d6), ("palegoldenrod", 0xeee8aa), ("palegreen", 0x98fb98),
    ("paleturquoise", 0xafeeee), ("palevioletred", 0xdb7093), ("papayawhip", 0xffefd5), ("peachpuff", 0xffdab9),
    ("peru", 0xcd853f), ("pink", 0xffc0cb), ("plum", 0xdda0dd), ("powderblue", 0xb0e0e6), ("purple", 0x800080),
    ("rebeccapurple", 0x663399), ("red", 0xff0000), ("rosybrown", 0xbc8f8f), ("royalblue", 0x4169e1),
    ("saddlebrown", 0x8b4513), ("salmon", 0xfa8072), ("sandybrown", 0xf4a460), ("seagreen", 0x2e8b57),
    ("seashell", 0xfff5ee), ("sienna", 0xa0522d), ("silver", 0xc0c0c0), ("skyblue", 0x87ceeb),
    ("slateblue", 0x6a5acd), ("slategray", 0x708090), ("slategrey", 0x708090), ("snow", 0xfffafa),
    ("springgreen", 0x00ff7f), ("steelblue", 0x4682b4), ("tan", 0xd2b48c), ("teal", 0x008080),
    ("thistle", 0xd8bfd8), ("tomato", 0xff6347), ("turquoise", 0x40e0d0), ("violet", 0xee82ee),
    ("wheat", 0xf5deb3), ("white", 0xffffff), ("whitesmoke", 0xf5f5f5), ("yellow", 0xffff00),
    ("yellowgreen", 0x9acd32),
];

/// The linear colour of a CSS name.
pub fn named(name: &str) -> Option<Rgb> {
    let &(_, code) = NAMED.iter().find(|(known, _)| *known == name)?;
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
