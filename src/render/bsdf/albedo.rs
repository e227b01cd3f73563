//! How much light a rough surface returns after one bounce off its microfacets, from a table.
//!
//! What single scattering loses is what other lobes have left to scatter (Kulla & Conty 2017). The table holds, for the
//! GGX distribution with height-correlated masking, E(μ, α) = ∫ f cos for a surface whose facets reflect everything, and
//! the part B of it that is weighted by Schlick's (1 − h·o)⁵ (Karis 2013): by Schlick's formula a surface of
//! reflectance F₀ returns F₀ (E − B) + F₉₀ B. Nodes lie at μ = (i / 31)² and α = (j / 31)⁴, where both functions bend
//! least; between them is linear interpolation in √μ and √√α. Error below 10⁻³.
//!
//! `UPDATE=1 cargo test --lib albedo` integrates it anew.

/// Nodes along each axis.
const SIZE: usize = 32;

/// E and B at the nodes: α by rows, μ by columns.
static TABLE: [[[f32; 2]; SIZE]; SIZE] = include!("albedo_table.in");

/// The share of light that rough facets return, for Schlick's formula.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Returned {
    /// All of it, if they reflect everything.
    pub all: f32,
    /// The part that is weighted by F₉₀.
    pub edge: f32,
}

impl Returned {
    /// For facets that reflect `f0` straight on and everything edge-on.
    pub fn by_schlick(self, f0: f32) -> f32 {
        f0 * (self.all - self.edge) + self.edge
    }

    fn lerp(self, other: Self, t: f32) -> Self {
        Self { all: self.all + (other.all - self.all) * t, edge: self.edge + (other.edge - self.edge) * t }
    }
}

/// Seen at an angle of cosine `cos`; `alpha` in [0, 1].
pub(super) fn directional(alpha: f32, cos: f32) -> Returned {
    let (row, t_row) = place(alpha.sqrt().sqrt());
    let (column, t_column) = place(cos.sqrt());
    let along = |row: usize| node(row, column).lerp(node(row, column + 1), t_column);
    along(row).lerp(along(row + 1), t_row)
}

/// The mean over the hemisphere weighted by the cosine, of what [`directional`] says.
pub(super) fn average(alpha: f32) -> Returned {
    let (row, t) = place(alpha.sqrt().sqrt());
    row_average(row).lerp(row_average(row + 1), t)
}

fn node(row: usize, column: usize) -> Returned {
    let [all, edge] = TABLE[row][column];
    Returned { all, edge }
}

/// The node below `x` in [0, 1], and the way from it to the next.
fn place(x: f32) -> (usize, f32) {
    let x = x.clamp(0.0, 1.0) * (SIZE - 1) as f32;
    let below = (x as usize).min(SIZE - 2);
    (below, x - below as f32)
}

/// 2 ∫ E μ dμ over a row, exact for what is interpolated: with t = √μ, 4 ∫ E t³ dt over each piece.
fn row_average(row: usize) -> Returned {
    let h = 1.0 / (SIZE - 1) as f32;
    let mut sum = Returned { all: 0.0, edge: 0.0 };
    for column in 0..SIZE - 1 {
        // ∫ t³ and ∫ t³ s over the piece, s running from 0 to 1.
        let a = column as f32 * h;
        let whole = h * (a * a * a + h * (1.5 * a * a + h * (a + 0.25 * h)));
        let slope = h * (0.5 * a * a * a + h * (a * a + h * (0.75 * a + 0.2 * h)));
        let (left, right) = (node(row, column), node(row, column + 1));
        sum.all += 4.0 * (left.all * (whole - slope) + right.all * slope);
        sum.edge += 4.0 * (left.edge * (whole - slope) + right.edge * slope);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::conductor::{sample_visible_normal, visibility, visible};
    use super::*;
    use crate::math::{Vec2, Vec3};
    use std::fmt::Write;

    /// E and B by integration over visible normals with `n × n` midpoints: the mean of G₂/G₁ above the horizon.
    fn integrate(alpha: f32, mu: f32, n: u32) -> [f64; 2] {
        // Edge-on and with no roughness at all the limits are what lies just beside.
        let (alpha, mu) = (alpha.max(1e-6), mu.max(1e-6));
        let wo = Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
        let mut sum = [0.0; 2];
        for i in 0..n {
            for j in 0..n {
                // The two halves about the plane of `wo` are alike.
                let u = Vec2::new((i as f32 + 0.5) / n as f32, 0.5 * (j as f32 + 0.5) / n as f32);
                let h = sample_visible_normal(alpha, wo, u);
                let wi = h * (2.0 * wo.dot(h)) - wo;
                if wi.z > 0.0 {
                    let share = f64::from(visibility(alpha, wo.z, wi.z) * wi.z / visible(alpha, wo.z));
                    sum[0] += share;
                    sum[1] += share * (1.0 - f64::from(wo.dot(h))).max(0.0).powi(5);
                }
            }
        }
        sum.map(|sum| sum / f64::from(n * n))
    }

    fn at(i: usize) -> f32 {
        i as f32 / (SIZE - 1) as f32
    }

    #[test]
    fn the_table_is_what_integration_gives() {
        if std::env::var_os("UPDATE").is_some() {
            write_table();
        }
        for row in (0..SIZE).step_by(6).chain([SIZE - 1]) {
            for column in (0..SIZE).step_by(5) {
                let [all, edge] = integrate(at(row).powi(4), at(column).powi(2), 128);
                let found = node(row, column);
                assert!((f64::from(found.all) - all).abs() < 1.5e-3, "{row} {column}: {found:?}, {all}");
                assert!((f64::from(found.edge) - edge).abs() < 1.5e-3, "{row} {column}: {found:?}, {edge}");
            }
        }
    }

    fn write_table() {
        let mut text = "[\n".to_owned();
        for row in 0..SIZE {
            text.push_str("    [\n");
            for column in 0..SIZE {
                let [all, edge] = integrate(at(row).powi(4), at(column).powi(2), 1_024);
                let _ = writeln!(text, "        [{all:.5}, {edge:.5}],");
            }
            text.push_str("    ],\n");
        }
        text.push_str("]\n");
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/render/bsdf/albedo_table.in");
        std::fs::write(path, text).expect("the table can be written");
    }

    #[test]
    fn averages_are_those_of_the_interpolated_table() {
        for alpha in [0.001, 0.03, 0.3, 0.77, 1.0] {
            let n = 4_000;
            let mut sum = 0.0;
            for i in 0..n {
                let mu = (i as f32 + 0.5) / n as f32;
                sum += f64::from(directional(alpha, mu).all * 2.0 * mu) / f64::from(n);
            }
            assert!((sum - f64::from(average(alpha).all)).abs() < 1e-5, "{alpha}: {sum}");
        }
    }
}
