//! How glass bends each wavelength in its own way, and what colour one wavelength is.

use crate::math::{Rgb, float};

/// The wavelengths that paths are drawn from, in nanometres.
const SEEN: [f32; 2] = [390.0, 690.0];
/// The lines by which glass is measured, in micrometres: d (helium), F and C (hydrogen).
const D: f32 = 0.587_56;
const F: f32 = 0.486_13;
const C: f32 = 0.656_27;

/// One wavelength, drawn uniformly from those seen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Wavelength {
    nm: f32,
}

impl Wavelength {
    /// The one that `u` in [0, 1) leads to.
    pub fn sample(u: f32) -> Self {
        Self { nm: SEEN[0] + (SEEN[1] - SEEN[0]) * u }
    }

    /// The refractive index of a glass of index `ior` for the d line, whose indices for the F and C lines differ by
    /// `spread`, (n_d − 1) over the Abbe number. Cauchy's formula A + B / λ².
    pub fn ior(self, ior: f32, spread: f32) -> f32 {
        let b = spread / (1.0 / (F * F) - 1.0 / (C * C));
        let um = self.nm * 1e-3;
        ior + b * (1.0 / (um * um) - 1.0 / (D * D))
    }

    /// The colour of light of this wavelength alone: over all wavelengths its mean is white.
    ///
    /// The CIE 1931 observer in the fit of Wyman, Sloan & Shirley 2013, in Rec. 709; pure spectral colours lie outside of
    /// what these primaries can show, so what is below 0 is left out, and the rest scaled to the mean of 1.
    pub fn color(self) -> Rgb {
        shown(self.nm) * TO_WHITE
    }
}

/// One over the mean of [`shown`] over the wavelengths drawn.
const TO_WHITE: Rgb = Rgb::new(1.70573, 2.60173, 2.74816);

/// The linear colour of a wavelength without what cannot be shown.
fn shown(nm: f32) -> Rgb {
    let lobe = |height: f32, mean: f32, left: f32, right: f32| {
        let x = (nm - mean) / if nm < mean { left } else { right };
        height * float::exp(-0.5 * x * x)
    };
    let x = lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) - lobe(0.065, 501.1, 20.4, 26.2);
    let y = lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1);
    let z = lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8);
    Rgb::new(
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    )
    .map(|channel| channel.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_wavelengths_together_are_white() {
        let n = 4_096;
        let colors = (0..n).map(|i| Wavelength::sample((i as f32 + 0.5) / n as f32).color());
        let mean = colors.fold(Rgb::BLACK, |sum, color| sum + color) / n as f32;
        for channel in 0..3 {
            assert!((mean[channel] - 1.0).abs() < 2e-3, "{mean:?}");
        }
    }

    #[test]
    fn crown_glass_bends_as_its_catalogue_says() {
        // N-BK7 (Schott 2017): n_d 1.5168, Abbe number 64.17; at 435.8 nm 1.52668, at 643.8 nm 1.51472.
        let spread = 0.5168 / 64.17;
        for (nm, expected) in [(587.56, 1.5168), (435.8, 1.526_68), (643.8, 1.514_72)] {
            let found = Wavelength { nm }.ior(1.5168, spread);
            assert!((found - expected).abs() < 4e-4, "{nm}: {found}");
        }
    }
}
