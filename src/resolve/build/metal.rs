//! The colours of metals, from measured optical constants.

use crate::math::Rgb;

/// A metal: its name, and at each wavelength in nanometres the index of refraction n and the extinction k.
type Metal = (&'static str, &'static [[f64; 3]]);

/// Johnson & Christy 1972 (silver, gold, copper) and 1974 (iron, chromium, nickel, titanium), Rakić 1995 (aluminium): the
/// rows of their tables that lie in the visible and one beyond each end.
#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "3.14 was measured")]
const METALS: [Metal; 8] = [
    ("silver", &[
        [381.5, 0.05, 1.864], [397.4, 0.05, 2.070], [413.3, 0.05, 2.275], [430.5, 0.04, 2.462], [450.9, 0.04, 2.657],
        [471.4, 0.05, 2.869], [495.9, 0.05, 3.093], [520.9, 0.05, 3.324], [548.6, 0.06, 3.586], [582.1, 0.05, 3.858],
        [616.8, 0.06, 4.152], [659.5, 0.05, 4.483], [704.5, 0.04, 4.838], [756.0, 0.03, 5.242],
    ]),
    ("gold", &[
        [381.5, 1.46, 1.933], [397.4, 1.47, 1.952], [413.3, 1.46, 1.958], [430.5, 1.45, 1.948], [450.9, 1.38, 1.914],
        [471.4, 1.31, 1.849], [495.9, 1.04, 1.833], [520.9, 0.62, 2.081], [548.6, 0.43, 2.455], [582.1, 0.29, 2.863],
        [616.8, 0.21, 3.272], [659.5, 0.14, 3.697], [704.5, 0.13, 4.103], [756.0, 0.14, 4.542],
    ]),
    ("copper", &[
        [381.5, 1.33, 2.045], [397.4, 1.32, 2.116], [413.3, 1.28, 2.207], [430.5, 1.25, 2.305], [450.9, 1.24, 2.397],
        [471.4, 1.25, 2.483], [495.9, 1.22, 2.564], [520.9, 1.18, 2.608], [548.6, 1.02, 2.577], [582.1, 0.70, 2.704],
        [616.8, 0.30, 3.205], [659.5, 0.22, 3.747], [704.5, 0.21, 4.205], [756.0, 0.24, 4.665],
    ]),
    ("aluminium", &[
        [364.7, 0.3988, 4.396], [413.3, 0.5214, 5.001], [442.8, 0.6079, 5.368], [476.9, 0.7278, 5.778],
        [516.6, 0.8734, 6.242], [563.6, 1.0728, 6.784], [619.9, 1.3660, 7.405], [652.3, 1.5724, 7.735],
        [688.8, 1.8301, 8.060], [729.3, 2.1606, 8.357],
    ]),
    ("iron", &[
        [381.0, 2.12, 2.50], [397.0, 2.24, 2.58], [413.0, 2.35, 2.65], [431.0, 2.48, 2.71], [451.0, 2.59, 2.77],
        [471.0, 2.67, 2.82], [496.0, 2.74, 2.88], [521.0, 2.86, 2.91], [549.0, 2.95, 2.93], [582.0, 2.94, 2.99],
        [617.0, 2.88, 3.05], [659.0, 2.92, 3.10], [704.0, 2.86, 3.19], [756.0, 2.87, 3.28],
    ]),
    ("chromium", &[
        [381.0, 1.92, 2.74], [397.0, 2.00, 2.83], [413.0, 2.08, 2.93], [431.0, 2.19, 3.04], [451.0, 2.33, 3.14],
        [471.0, 2.51, 3.24], [496.0, 2.75, 3.30], [521.0, 2.94, 3.33], [549.0, 3.18, 3.33], [582.0, 3.22, 3.30],
        [617.0, 3.17, 3.30], [659.0, 3.09, 3.34], [704.0, 3.05, 3.39], [756.0, 3.08, 3.42],
    ]),
    ("nickel", &[
        [381.0, 1.72, 2.48], [397.0, 1.72, 2.57], [413.0, 1.70, 2.69], [431.0, 1.71, 2.82], [451.0, 1.73, 2.95],
        [471.0, 1.78, 3.09], [496.0, 1.82, 3.25], [521.0, 1.85, 3.42], [549.0, 1.92, 3.61], [582.0, 1.96, 3.80],
        [617.0, 1.99, 4.02], [659.0, 1.99, 4.26], [704.0, 2.06, 4.50], [756.0, 2.13, 4.73],
    ]),
    ("titanium", &[
        [381.0, 1.99, 2.93], [397.0, 2.08, 2.95], [413.0, 2.14, 2.98], [431.0, 2.21, 3.01], [451.0, 2.27, 3.04],
        [471.0, 2.32, 3.10], [496.0, 2.36, 3.19], [521.0, 2.44, 3.30], [549.0, 2.54, 3.43], [582.0, 2.60, 3.58],
        [617.0, 2.67, 3.72], [659.0, 2.76, 3.84], [704.0, 2.86, 3.96], [756.0, 3.00, 4.01],
    ]),
];

/// Reflectance straight on, and the reflectance at 82° as a share of what Schlick's formula makes of the first; linear
/// Rec. 709, in [0, 1]. `None` for a metal that was not measured.
///
/// Fresnel's equations at each wavelength, lit by a black body of 6504 K, seen by the CIE 1931 observer, and divided by
/// what a white surface gives: a perfect mirror is white.
pub fn measured(name: &str) -> Option<(Rgb, Rgb)> {
    const COS_82: f64 = 1.0 / 7.0;
    let (_, table) = METALS.iter().find(|(known, _)| *known == name)?;
    let straight = color(|nm| reflectance(table, nm, 1.0));
    let slanted = color(|nm| reflectance(table, nm, COS_82));
    let by_schlick = |f0: f64| f0 + (1.0 - f0) * libm::pow(1.0 - COS_82, 5.0);
    let edge = [0, 1, 2].map(|i| (slanted[i] / by_schlick(straight[i])).clamp(0.0, 1.0) as f32);
    Some((Rgb::from(straight.map(|x| x.clamp(0.0, 1.0) as f32)), Rgb::from(edge)))
}

/// Fresnel reflectance of unpolarised light on a metal in air (Born & Wolf 1999, section 14.2); `cos` in (0, 1].
fn reflectance(table: &[[f64; 3]], nm: f64, cos: f64) -> f64 {
    let [n, k] = constants(table, nm);
    let (cos2, sin2) = (cos * cos, 1.0 - cos * cos);
    let t = n * n - k * k - sin2;
    let sum = libm::sqrt(t * t + 4.0 * n * n * k * k); // a² + b²
    let a = libm::sqrt(0.5 * (sum + t));
    let perpendicular = (sum + cos2 - 2.0 * a * cos) / (sum + cos2 + 2.0 * a * cos);
    let (even, odd) = (cos2 * sum + sin2 * sin2, 2.0 * a * cos * sin2);
    let parallel = perpendicular * (even - odd) / (even + odd);
    0.5 * (perpendicular + parallel)
}

/// n and k at a wavelength, by straight lines between rows.
fn constants(table: &[[f64; 3]], nm: f64) -> [f64; 2] {
    let next = table.partition_point(|row| row[0] < nm).clamp(1, table.len() - 1);
    let ([x0, n0, k0], [x1, n1, k1]) = (table[next - 1], table[next]);
    let t = ((nm - x0) / (x1 - x0)).clamp(0.0, 1.0);
    [n0 + (n1 - n0) * t, k0 + (k1 - k0) * t]
}

/// The linear Rec. 709 colour of a spectrum of reflectances, against that of a white one.
fn color(spectrum: impl Fn(f64) -> f64) -> [f64; 3] {
    let (mut seen, mut white) = ([0.0; 3], [0.0; 3]);
    for i in 0..=64 {
        let nm = 380.0 + 5.0 * f64::from(i);
        let (share, light) = (spectrum(nm), daylight(nm));
        for (channel, matched) in rec_709(observer(nm)).into_iter().enumerate() {
            seen[channel] += share * light * matched;
            white[channel] += light * matched;
        }
    }
    [0, 1, 2].map(|i| seen[i] / white[i])
}

/// A black body of 6504 K by Planck's law, in units of its own.
fn daylight(nm: f64) -> f64 {
    /// h c / k, in nanometres times kelvin.
    const HC_BY_K: f64 = 1.438_776_877e7;
    libm::pow(nm / 560.0, -5.0) / libm::expm1(HC_BY_K / (nm * 6504.0))
}

/// The CIE 1931 observer, as fitted by Wyman, Sloan & Shirley 2013, eq. 4.
fn observer(nm: f64) -> [f64; 3] {
    let lobe = |height: f64, mean: f64, left: f64, right: f64| {
        let x = (nm - mean) / if nm < mean { left } else { right };
        height * libm::exp(-0.5 * x * x)
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) - lobe(0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

/// XYZ in the primaries of Rec. 709 (IEC 61966-2-1).
fn rec_709([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema;

    #[test]
    fn every_metal_of_the_registry_is_measured_and_the_other_way_round() {
        let words =
            schema::block("metal").and_then(|block| block.field("kind")).and_then(|kind| kind.ty.words());
        assert!(words.expect("a choice").iter().copied().eq(METALS.iter().map(|(name, _)| *name)));
        for (name, table) in METALS {
            assert!(table.is_sorted_by(|a, b| a[0] < b[0]), "{name}");
            assert!(table[0][0] <= 382.0 && table[table.len() - 1][0] >= 700.0, "{name}");
        }
    }

    #[test]
    fn colours_are_those_that_others_computed_from_such_constants() {
        // Lagarde 2014, "Feeding a physically based shading model", from other measurements and observers.
        let published: [(&str, [f32; 3]); 6] = [
            ("silver", [0.972, 0.960, 0.915]),
            ("gold", [1.0, 0.766, 0.336]),
            ("copper", [0.955, 0.637, 0.538]),
            ("aluminium", [0.913, 0.922, 0.924]),
            ("iron", [0.562, 0.565, 0.578]),
            ("chromium", [0.549, 0.556, 0.554]),
        ];
        for (name, expected) in published {
            let (straight, edge) = measured(name).expect("measured");
            for channel in 0..3 {
                assert!((straight[channel] - expected[channel]).abs() < 0.09, "{name}: {straight:?}");
                assert!((0.6..=1.0).contains(&edge[channel]), "{name}: {edge:?}");
            }
        }
    }

    #[test]
    fn without_extinction_the_equations_are_those_of_glass() {
        let glass = [[300.0, 1.5, 0.0], [800.0, 1.5, 0.0]];
        for cos in [1.0, 0.7, 0.3, 0.05] {
            let cos_t = libm::sqrt(1.0 - (1.0 - cos * cos) / 2.25);
            let (s, p) =
                ((cos - 1.5 * cos_t) / (cos + 1.5 * cos_t), (1.5 * cos - cos_t) / (1.5 * cos + cos_t));
            assert!((reflectance(&glass, 550.0, cos) - 0.5 * (s * s + p * p)).abs() < 1e-12, "{cos}");
        }
    }
}
