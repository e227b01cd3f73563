//! How much light a ground boundary between two clear media sends on, one way or the other, after one facet: from a table.
//!
//! The rest bounces on between the facets, and since nothing is absorbed all of it leaves in the end (Kulla & Conty 2017).
//! The table holds E(μ, α, η) of the GGX distribution with height-correlated masking and Fresnel's equations, for light on
//! the thinner side and on the denser one. Nodes lie at μ = (i / 15)², α = (j / 15)² and (η − 1) / (η + 1) = 0.6 (k / 11)²,
//! where it bends least; between them is linear interpolation in the roots of all three. Error 10⁻³ on average, up to a few
//! percent next to the critical angle of indices near 1. Indices above 4 count as 4.
//!
//! `UPDATE=1 cargo test --lib ground` integrates it anew.

use std::array;

const ETAS: usize = 12;
const ALPHAS: usize = 16;
const COSINES: usize = 16;
/// (η − 1) / (η + 1) at the last node: η = 4.
const LAST_RATIO: f32 = 0.6;

/// E over the cosine.
type Row = [f32; COSINES];

/// E at the nodes, seen from the thinner side and from the denser one.
#[allow(clippy::approx_constant, reason = "numbers of a table, whatever they are near")]
static TABLE: [[[Row; ALPHAS]; ETAS]; 2] = include!("ground_table.in");

/// The mean over the hemisphere of each row, weighted by the cosine.
static AVERAGES: [[[f32; ALPHAS]; ETAS]; 2] = averages();

/// A ground boundary seen from one side.
#[derive(Clone, Copy)]
pub(super) struct Facets {
    denser: usize,
    /// The node below, and the way to the next.
    eta: (usize, f32),
    alpha: (usize, f32),
}

impl Facets {
    /// `eta` is the index beyond the boundary over that on the side it is seen from.
    pub fn new(alpha: f32, eta: f32) -> Self {
        let ratio = ((eta - 1.0) / (eta + 1.0)).abs();
        Self {
            denser: usize::from(eta < 1.0),
            eta: place((ratio / LAST_RATIO).sqrt(), ETAS),
            alpha: place(alpha.sqrt(), ALPHAS),
        }
    }

    /// The share of light that is not sent on by one facet alone, seen at an angle of cosine `cos`.
    pub fn lost(&self, cos: f32) -> f32 {
        let (column, t) = place(cos.sqrt(), COSINES);
        let sent = self.between(|eta, alpha| {
            let row = &TABLE[self.denser][eta][alpha];
            lerp(row[column], row[column + 1], t)
        });
        (1.0 - sent).max(0.0)
    }

    /// The mean of [`Self::lost`] over the hemisphere, weighted by the cosine.
    pub fn lost_on_average(&self) -> f32 {
        (1.0 - self.between(|eta, alpha| AVERAGES[self.denser][eta][alpha])).max(0.0)
    }

    fn between(&self, at: impl Fn(usize, usize) -> f32) -> f32 {
        let ((eta, t_eta), (alpha, t_alpha)) = (self.eta, self.alpha);
        let [low, high] = array::from_fn(|i| lerp(at(eta + i, alpha), at(eta + i, alpha + 1), t_alpha));
        lerp(low, high, t_eta)
    }
}

const fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// The node below `x` in [0, 1], and the way from it to the next.
fn place(x: f32, nodes: usize) -> (usize, f32) {
    let x = x.clamp(0.0, 1.0) * (nodes - 1) as f32;
    let below = (x as usize).min(nodes - 2);
    (below, x - below as f32)
}

const fn averages() -> [[[f32; ALPHAS]; ETAS]; 2] {
    let mut all = [[[0.0; ALPHAS]; ETAS]; 2];
    let mut i = 0;
    while i < 2 * ETAS * ALPHAS {
        let (side, eta, alpha) = (i / (ETAS * ALPHAS), i / ALPHAS % ETAS, i % ALPHAS);
        all[side][eta][alpha] = row_average(&TABLE[side][eta][alpha]);
        i += 1;
    }
    all
}

/// 2 ∫ E μ dμ over a row, exact for what is interpolated: with t = √μ, 4 ∫ E t³ dt over each piece.
const fn row_average(row: &Row) -> f32 {
    let h = 1.0 / (COSINES - 1) as f32;
    let mut sum = 0.0;
    let mut i = 0;
    while i < COSINES - 1 {
        // ∫ t³ and ∫ t³ s over the piece, s running from 0 to 1.
        let a = i as f32 * h;
        let whole = h * (a * a * a + h * (1.5 * a * a + h * (a + 0.25 * h)));
        let slope = h * (0.5 * a * a * a + h * (a * a + h * (0.75 * a + 0.2 * h)));
        sum += 4.0 * (row[i] * (whole - slope) + row[i + 1] * slope);
        i += 1;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::conductor::{sample_visible_normal, visibility, visible};
    use super::super::dielectric::fresnel_dielectric;
    use super::*;
    use crate::math::{Vec2, Vec3};
    use std::fmt::Write;

    /// E by integration over visible normals with `n × n` midpoints: the mean of G₂/G₁ of what is reflected and refracted.
    fn integrate(eta: f64, alpha: f32, mu: f32, n: u32) -> f32 {
        let (alpha, mu) = (alpha.max(1e-6), mu.max(1e-6));
        let wo = Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
        let share = |z: f32| if z > 0.0 { visibility(alpha, mu, z) * z / visible(alpha, mu) } else { 0.0 };
        let mut sum = 0.0;
        for i in 0..n * n {
            // The two halves about the plane of `wo` are alike.
            let u = Vec2::new(((i / n) as f32 + 0.5) / n as f32, 0.5 * ((i % n) as f32 + 0.5) / n as f32);
            let h = sample_visible_normal(alpha, wo, u);
            let cos = wo.dot(h).clamp(0.0, 1.0);
            let (reflected, cos_t) = fresnel_dielectric(f64::from(cos), eta);
            let refracted = wo.z / eta as f32 - h.z * (cos / eta as f32 - cos_t as f32);
            let seen = |share: f32, part: f64| f64::from(share) * part;
            sum += seen(share(h.z * 2.0 * cos - wo.z), reflected)
                + seen(share(refracted.min(1.0)), 1.0 - reflected);
        }
        (sum / f64::from(n * n)) as f32
    }

    /// What stands at a node.
    fn at(side: usize, eta: usize, alpha: usize, column: usize, n: u32) -> f32 {
        let unit = |i: usize, nodes: usize| i as f32 / (nodes - 1) as f32;
        let ratio = f64::from(LAST_RATIO * unit(eta, ETAS).powi(2));
        let index = (1.0 + ratio) / (1.0 - ratio);
        let index = if side == 0 { index } else { 1.0 / index };
        integrate(index, unit(alpha, ALPHAS).powi(2), unit(column, COSINES).powi(2), n)
    }

    #[test]
    fn the_table_is_what_integration_gives() {
        if std::env::var_os("UPDATE").is_some() {
            write_table();
        }
        for side in [0, 1] {
            for (eta, alpha, column) in
                [(0, 7, 9), (1, 15, 15), (4, 3, 12), (4, 15, 2), (8, 10, 5), (11, 15, 0)]
            {
                let (found, expected) = (TABLE[side][eta][alpha][column], at(side, eta, alpha, column, 96));
                assert!(
                    (found - expected).abs() < 3e-3,
                    "{side} {eta} {alpha} {column}: {found}, {expected}"
                );
            }
        }
    }

    fn write_table() {
        let mut text = "[\n".to_owned();
        for side in 0..2 {
            text.push_str("    [\n");
            for eta in 0..ETAS {
                text.push_str("        [\n");
                for alpha in 0..ALPHAS {
                    let row: Vec<_> =
                        (0..COSINES).map(|i| format!("{:.4}", at(side, eta, alpha, i, 128))).collect();
                    let _ = writeln!(text, "            [{}],", row.join(", "));
                }
                text.push_str("        ],\n");
            }
            text.push_str("    ],\n");
        }
        text.push_str("]\n");
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/render/bsdf/ground_table.in");
        std::fs::write(path, text).expect("the table can be written");
    }

    #[test]
    fn averages_are_those_of_what_is_interpolated() {
        for eta in [1.02, 1.5, 3.0, 1.0 / 1.5] {
            for alpha in [0.03, 0.3, 0.77, 1.0] {
                let facets = Facets::new(alpha, eta);
                let n = 4_000;
                let at = |i: u16| (f32::from(i) + 0.5) / f32::from(n);
                let sum: f32 = (0..n).map(|i| facets.lost(at(i)) * 2.0 * at(i) / f32::from(n)).sum();
                assert!((sum - facets.lost_on_average()).abs() < 1e-4, "{eta} {alpha}: {sum}");
            }
        }
    }
}
