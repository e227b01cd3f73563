//! Section G: photons.

use crate::support::*;
use snell::math::{Rgb, Vec3};
use snell::render::photon::{Disc, Photon, PhotonMap, Schedule};

fn photon(p: Vec3) -> Photon {
    Photon { p, wi: Vec3::Z, n: Vec3::Z, power: Rgb::WHITE, depth: 2 }
}

/// Case 53: density from the k nearest of uniform photons: (k − 1) / (π r²) has the mean of the density within 1 %
/// (its standard error is 0.3 % here). k / (π r²) is too bright by k / (k − 1), 11 % at k = 10. Photons that coincide
/// give something finite to divide by, or a radius of 0 that is told apart.
#[test]
fn hard_case_53_density_of_the_nearest() {
    let mut random = Random(153);
    let count = 20_000;
    for k in [10, 50] {
        let (mut sum, mut queries) = (0.0, 0.0);
        for _ in 0..6 {
            let photons: Vec<_> =
                (0..count).map(|_| photon(Vec3::new(random.unit(), random.unit(), 0.0))).collect();
            let map = PhotonMap::new(&photons);
            let mut found = Vec::new();
            for _ in 0..3_000 {
                let p = Vec3::new(0.1 + 0.8 * random.unit(), 0.1 + 0.8 * random.unit(), 0.0);
                map.nearest(&Disc { p, n: Vec3::Z, radius: 1.0, k }, |_| true, &mut found);
                let radius2 = found.iter().map(|neighbor| neighbor.radius2).fold(0.0, f32::max);
                sum += 1.0 / (std::f64::consts::PI * f64::from(radius2) * f64::from(count));
                queries += 1.0;
            }
        }
        let density = |used: f64| used * sum / queries;
        assert!((density(k as f64 - 1.0) - 1.0).abs() < 0.01, "k = {k}: {}", density(k as f64 - 1.0));
        assert!(density(k as f64) - 1.0 > 0.8 / k as f64, "k / (π r²) is as good");
    }
    let map = PhotonMap::new(&vec![photon(Vec3::ONE); 1_000]);
    let mut found = Vec::new();
    map.nearest(&Disc { p: Vec3::ONE, n: Vec3::Z, radius: 0.5, k: 10 }, |_| true, &mut found);
    assert!(found.len() == 10 && found.iter().all(|neighbor| neighbor.radius2 == 0.0));
}

/// Case 54: radii over a million passes follow the closed form, within 10⁻⁸ of r² (Knaus, Zwicker 2011). The recursion in
/// single precision has drifted by half a percent by then.
#[test]
fn hard_case_54_radii_over_a_long_run() {
    let alpha = 2.0 / 3.0;
    let mut schedule = Schedule::new(1.0, alpha);
    let passes = 1_000_000_u32;
    let log = libm::lgamma(f64::from(passes) + alpha)
        - libm::lgamma(1.0 + alpha)
        - libm::lgamma(f64::from(passes) + 1.0);
    let expected = libm::exp(log);
    let found = schedule.radius2(passes - 1);
    assert!((found / expected - 1.0).abs() < 1e-8, "{found}, {expected}");
    let naive = (1..passes).fold(1.0_f32, |r2, i| r2 * ((i as f32 + alpha as f32) / (i as f32 + 1.0)));
    assert!((f64::from(naive) / expected - 1.0).abs() > 1e-3, "single precision drifts to {naive} only");
}
