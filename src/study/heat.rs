//! Where a picture is wrong, as a picture.

/// Anchors of the colour scale at even steps from 0 to 1: dark to light without a break, also for the colour-blind
/// (the scale `magma` of Smith & van der Walt 2015, by nine of its colours).
const SCALE: [[f32; 3]; 9] = [
    [0.0, 0.0, 4.0],
    [29.0, 17.0, 71.0],
    [81.0, 18.0, 124.0],
    [131.0, 38.0, 129.0],
    [183.0, 55.0, 121.0],
    [230.0, 81.0, 100.0],
    [252.0, 137.0, 97.0],
    [254.0, 194.0, 135.0],
    [252.0, 253.0, 191.0],
];

/// The colour of a value in [0, 1].
pub fn color(value: f32) -> [u8; 3] {
    let at = value.clamp(0.0, 1.0) * (SCALE.len() - 1) as f32;
    let below = (at as usize).min(SCALE.len() - 2);
    let t = at - below as f32;
    [0, 1, 2].map(|c| (SCALE[below][c] * (1.0 - t) + SCALE[below + 1][c] * t).round() as u8)
}

/// The least and the largest relative error that the scale tells apart.
pub const RANGE: (f64, f64) = (1e-3, 1.0);

/// The colour of a relative error: black at 0.1 % and below, light yellow at 100 %, even steps per factor.
pub fn color_of_error(error: f64) -> [u8; 3] {
    let (low, high) = RANGE;
    color(((error.max(low) / low).ln() / (high / low).ln()) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_grows_lighter() {
        let lightness = |[r, g, b]: [u8; 3]| 2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b);
        let steps: Vec<u32> = (0..=64_u8).map(|i| lightness(color(f32::from(i) / 64.0))).collect();
        assert!(steps.windows(2).all(|w| w[0] < w[1]));
        assert_eq!(color_of_error(0.0), [0, 0, 4]);
        assert_eq!(color_of_error(7.0), [252, 253, 191]);
    }
}
