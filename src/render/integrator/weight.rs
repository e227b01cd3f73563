//! Weights of strategies, and of paths that chance spared.

/// The weight of a strategy of density `a` where another has density `b`: the power heuristic a² / (a² + b²).
///
/// The ratio is formed first, so that no square overflows (Veach 1997, eq. 9.20). A density that is infinite belongs to
/// a direction that only its own strategy can find, and weighs 1; of two such, each counts half.
pub fn mis_weight(a: f32, b: f32) -> f32 {
    if a == b {
        return if a == 0.0 { 0.0 } else { 0.5 };
    }
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}

/// Bounces before a path may be ended by chance; specular ones scatter nothing and wait longer.
const SAFE_BOUNCES: u32 = 3;
const SAFE_SPECULAR_BOUNCES: u32 = 32;
/// After so many bounces even paths that lose nothing end sooner or later.
const ENDLESS_BOUNCES: u32 = 8;

/// The probability with which a path of the given worth (its largest throughput) was allowed to go on; `None` if it ends.
pub fn roulette(worth: f32, depth: u32, specular: bool, u: impl FnOnce() -> f32) -> Option<f32> {
    if worth.is_nan() || worth < 1e-30 {
        return None;
    }
    let safe = if specular { SAFE_SPECULAR_BOUNCES } else { SAFE_BOUNCES };
    if depth < safe {
        return Some(1.0);
    }
    let most = if depth < ENDLESS_BOUNCES { 1.0 } else { 0.95 };
    let survival = worth.clamp(0.05, most);
    (u() < survival).then_some(survival)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::sampler::{Dim, Sampler};

    #[test]
    fn weights_of_two_strategies_add_up_to_one_at_the_extremes() {
        let densities = [0.0, 1e-38, 1.0, 1e38, f32::INFINITY];
        for a in densities {
            for b in densities {
                let (wa, wb) = (mis_weight(a, b), mis_weight(b, a));
                assert!((0.0..=1.0).contains(&wa), "{a} against {b}: {wa}");
                assert!(
                    a == 0.0 && b == 0.0 || (wa + wb - 1.0).abs() <= f32::EPSILON,
                    "{a} and {b}: {wa} + {wb}"
                );
            }
        }
        assert_eq!(mis_weight(f32::INFINITY, 1e38), 1.0);
        assert_eq!(mis_weight(0.0, 1.0), 0.0);
    }

    #[test]
    fn roulette_gives_back_what_it_takes() {
        // A chain of mirrors that reflect 0.9, each bounce adding what it carries: 1 / (1 − 0.9) = 10 on average.
        for specular in [false, true] {
            let n = 20_000;
            let mut total = 0.0;
            for i in 0..n {
                let sampler = Sampler::new(7, 0, i, 0);
                let mut beta = 1.0_f32;
                for depth in 0..10_000 {
                    total += f64::from(beta);
                    beta *= 0.9;
                    let u = || sampler.get_1d(Dim::Roulette(depth));
                    let Some(survival) = roulette(beta, depth, specular, u) else { break };
                    beta /= survival;
                }
            }
            let mean = total / n as f64;
            assert!((mean - 10.0).abs() < 0.1, "specular {specular}: {mean}");
        }
    }
}
