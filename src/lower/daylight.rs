//! The light of a clear day: sky and sun by formula (Preetham, Shirley, Smits 1999), as a picture and a disc.

use crate::ir::light::Daylight;
use crate::math::{DVec3, Rgb};
use crate::render::light::{EnvironmentRadiance, Sun};
use crate::render::texture::Image;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

/// Columns of the picture; it has half as many rows. Half a degree each: the glow about the sun is wider.
const WIDTH: u32 = 512;
/// Candela a square metre that are one W·m⁻²·sr⁻¹, where watts count by luminance.
const LUMENS_A_WATT: f64 = 683.0;
/// Illuminance of the sun outside the atmosphere, in lux (ASTM E490-00).
const SUN_ILLUMINANCE: f64 = 133_100.0;
/// The colour of the sun outside the atmosphere: a black body of 5772 K (IAU 2015), of luminance 1.
const SUN_COLOR: Rgb = Rgb::new(1.110, 0.976, 0.912);
/// Wavelengths that stand for the channels, in micrometres.
const WAVELENGTHS: [f64; 3] = [0.61, 0.55, 0.465];
/// Absorption by ozone there, per centimetre (after Leckner 1978).
const OZONE: [f64; 3] = [0.12, 0.085, 0.009];

/// The sky above, the ground below and the sun, in W·m⁻²·sr⁻¹.
pub fn radiance(day: &Daylight) -> EnvironmentRadiance {
    let to_sun = day.to_sun.value.normalize_or(DVec3::Y);
    let dome = Dome::new(to_sun, day.turbidity.value);
    let sun = sunlight(zenith_angle(to_sun), day.turbidity.value);
    let ground = day.ground * ((dome.irradiance() + sun * to_sun.y.max(0.0) as f32) * (1.0 / PI) as f32);
    let height = WIDTH / 2;
    let texel = |row: u32, column: u32| {
        let (theta, phi) = (angle(row, height, PI), angle(column, WIDTH, TAU) - PI);
        let (sin, cos) = libm::sincos(theta);
        let (sin_phi, cos_phi) = libm::sincos(phi);
        if cos > 0.0 { dome.radiance(DVec3::new(sin * sin_phi, cos, -sin * cos_phi)) } else { ground }
    };
    let texels = (0..height).flat_map(|row| (0..WIDTH).map(move |column| (row, column)));
    let texels = texels.map(|(row, column)| texel(row, column)).collect();
    let sky = Arc::new(Image::new(WIDTH, height, texels));
    let cos_angle = libm::cos(day.sun_size.value / 2.0);
    let solid_angle = TAU * (1.0 - cos_angle);
    let sun = day.sun.then(|| Sun {
        direction: to_sun.as_vec3().normalize(),
        sin2: (1.0 - cos_angle) * (1.0 + cos_angle),
        radiance: sun * (1.0 / solid_angle) as f32,
    });
    EnvironmentRadiance::Daylight { sky, sun }
}

/// The middle of a step out of `count` that make up `whole`.
fn angle(step: u32, count: u32, whole: f64) -> f64 {
    whole * (f64::from(step) + 0.5) / f64::from(count)
}

fn zenith_angle(to_sun: DVec3) -> f64 {
    libm::acos(to_sun.y.clamp(-1.0, 1.0)).min(FRAC_PI_2)
}

/// The sky with the sun at one place.
struct Dome {
    to_sun: DVec3,
    /// At the zenith: luminance in W·m⁻²·sr⁻¹, and chromaticity x, y.
    zenith: [f64; 3],
    /// Each of them over the function of Perez et al. 1993 at the zenith.
    scale: [f64; 3],
    coefficients: [[f64; 5]; 3],
}

impl Dome {
    /// Preetham et al. 1999, appendix A.2.
    fn new(to_sun: DVec3, turbidity: f64) -> Self {
        let (t, theta) = (turbidity, zenith_angle(to_sun));
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * theta);
        let kilocandela = (4.0453 * t - 4.9710) * libm::tan(chi) - 0.2155 * t + 2.4192;
        let cubic = |c: [[f64; 4]; 3]| {
            let at = |c: [f64; 4]| ((c[0] * theta + c[1]) * theta + c[2]) * theta + c[3];
            (at(c[0]) * t + at(c[1])) * t + at(c[2])
        };
        let x = cubic([
            [0.00166, -0.00375, 0.00209, 0.0],
            [-0.02903, 0.06377, -0.03202, 0.00394],
            [0.11693, -0.21196, 0.06052, 0.25886],
        ]);
        let y = cubic([
            [0.00275, -0.00610, 0.00317, 0.0],
            [-0.04214, 0.08970, -0.04153, 0.00516],
            [0.15346, -0.26756, 0.06670, 0.26688],
        ]);
        let line = |c: [[f64; 2]; 5]| c.map(|[slope, rest]| slope * t + rest);
        let coefficients = [
            line([
                [0.17872, -1.46303],
                [-0.35540, 0.42749],
                [-0.02266, 5.32505],
                [0.12064, -2.57705],
                [-0.06696, 0.37027],
            ]),
            line([
                [-0.01925, -0.25922],
                [-0.06651, 0.00081],
                [-0.00041, 0.21247],
                [-0.06409, -0.89887],
                [-0.00325, 0.04517],
            ]),
            line([
                [-0.01669, -0.26078],
                [-0.09495, 0.00921],
                [-0.00792, 0.21023],
                [-0.04405, -1.65369],
                [-0.01092, 0.05291],
            ]),
        ];
        let zenith = [kilocandela.max(0.0) * 1e3 / LUMENS_A_WATT, x, y];
        let scale = coefficients.map(|c| 1.0 / perez(&c, 1.0, theta));
        Self { to_sun, zenith, scale, coefficients }
    }

    /// The radiance from a unit direction above the horizon.
    fn radiance(&self, dir: DVec3) -> Rgb {
        let gamma = libm::acos(dir.dot(self.to_sun).clamp(-1.0, 1.0));
        let value =
            |i: usize| self.zenith[i] * self.scale[i] * perez(&self.coefficients[i], dir.y.max(0.01), gamma);
        from_chromaticity(value(0).max(0.0), value(1), value(2))
    }

    /// What falls on the ground from all of it, in W·m⁻².
    fn irradiance(&self) -> Rgb {
        const STEPS: u32 = 64;
        let mut sum = Rgb::BLACK;
        for i in 0..STEPS {
            // Equal steps of sin² are equal shares of cos θ dω.
            let sin = ((f64::from(i) + 0.5) / f64::from(STEPS)).sqrt();
            for j in 0..STEPS {
                let (sin_phi, cos_phi) = libm::sincos(angle(j, STEPS, TAU));
                let dir = DVec3::new(sin * sin_phi, (1.0 - sin * sin).sqrt(), sin * cos_phi);
                sum += self.radiance(dir);
            }
        }
        sum * (PI / f64::from(STEPS * STEPS)) as f32
    }
}

/// The function of Perez et al. 1993 at the cosine of the angle from the zenith and the angle from the sun.
fn perez([a, b, c, d, e]: &[f64; 5], cos_theta: f64, gamma: f64) -> f64 {
    let cos_gamma = libm::cos(gamma);
    (1.0 + a * libm::exp(b / cos_theta)) * (1.0 + c * libm::exp(d * gamma) + e * cos_gamma * cos_gamma)
}

/// Linear Rec. 709 of a luminance and a chromaticity; channels outside are cut to 0.
fn from_chromaticity(luminance: f64, x: f64, y: f64) -> Rgb {
    let (big_x, big_z) = (luminance * x / y, luminance * (1.0 - x - y) / y);
    Rgb::new(
        (3.240_969_94 * big_x - 1.537_383_18 * luminance - 0.498_610_76 * big_z) as f32,
        (-0.969_243_64 * big_x + 1.875_967_5 * luminance + 0.041_555_06 * big_z) as f32,
        (0.055_630_08 * big_x - 0.203_976_96 * luminance + 1.056_971_51 * big_z) as f32,
    )
    .map(|channel| channel.max(0.0))
}

/// The sun's irradiance on a surface that faces it, in W·m⁻², through the air.
///
/// Rayleigh scattering, aerosol and ozone as in Preetham et al. 1999, appendix A.1, at one wavelength a channel; what
/// mixed gases and water vapour take of visible light, a few per cent, is left out.
fn sunlight(theta: f64, turbidity: f64) -> Rgb {
    const OZONE_LAYER: f64 = 0.35; // centimetres
    let mass = 1.0 / (libm::cos(theta) + 0.15 * libm::pow(93.885 - theta.to_degrees(), -1.253));
    let haze = 0.04608 * turbidity - 0.04586;
    let left = |i: usize| {
        let rayleigh = 0.008735 * libm::pow(WAVELENGTHS[i], -4.08);
        let aerosol = haze.max(0.0) * libm::pow(WAVELENGTHS[i], -1.3);
        libm::exp(-mass * (rayleigh + aerosol + OZONE[i] * OZONE_LAYER)) as f32
    };
    SUN_COLOR * Rgb::new(left(0), left(1), left(2)) * (SUN_ILLUMINANCE / LUMENS_A_WATT) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(elevation: f64) -> DVec3 {
        let (sin, cos) = libm::sincos(elevation.to_radians());
        DVec3::new(0.0, sin, -cos)
    }

    #[test]
    fn the_zenith_is_as_bright_as_the_formula_says() {
        // T = 3, the sun 45° high: Yz = 7.1649 · tan(0.41944 · π/2) + 1.7727 kcd/m².
        let dome = Dome::new(at(45.0), 3.0);
        let expected = (7.1649 * libm::tan((4.0 / 9.0 - 0.025) * PI / 2.0) + 1.7727) * 1e3 / 683.0;
        let found = f64::from(dome.radiance(DVec3::Y).luminance());
        assert!((found / expected - 1.0).abs() < 0.02, "{found} for {expected}");
    }

    #[test]
    fn the_sky_is_blue_and_the_low_sun_red() {
        let dome = Dome::new(at(50.0), 2.5);
        let blue = dome.radiance(DVec3::new(0.0, 0.8, 0.6));
        assert!(blue.b > blue.g && blue.g > blue.r, "{blue:?}");
        let low = sunlight((90.0_f64 - 2.0).to_radians(), 3.0);
        let high = sunlight(0.3, 3.0);
        assert!(low.r > 2.0 * low.g && low.g > 2.0 * low.b && high.luminance() > 5.0 * low.luminance());
    }

    #[test]
    fn the_brightest_of_the_sky_is_about_the_sun() {
        let sun = at(30.0);
        let dome = Dome::new(sun, 4.0);
        let around = f64::from(dome.radiance(sun).luminance());
        for i in 0..100 {
            let (sin, cos) = libm::sincos(f64::from(i) * 0.5);
            let dir = DVec3::new(sin * 0.8, 0.6, cos * 0.8);
            assert!(f64::from(dome.radiance(dir).luminance()) <= around);
        }
    }

    #[test]
    fn noon_gives_about_a_hundred_thousand_lux() {
        // A clear day at 60°: some 85 klx from the sun and 15 klx from the sky (Preetham et al. 1999, section 2).
        let sun = f64::from(sunlight(30.0_f64.to_radians(), 2.5).luminance()) * 683.0;
        let sky = f64::from(Dome::new(at(60.0), 2.5).irradiance().luminance()) * 683.0;
        assert!((70_000.0..110_000.0).contains(&sun) && (8_000.0..30_000.0).contains(&sky), "{sun} {sky}");
    }
}
