//! Section E: scattering. Laws that hold for every bsdf are in `laws/scattering.rs`; these are about single numbers.

use crate::support::*;
use snell::math::{Frame, Vec3};
use snell::render::bsdf::fresnel_dielectric;

const ETAS: [f64; 8] = [1.0, 1.0 + 1e-6, 1.0 - 1e-6, 1.0001, 1.5, 1.0 / 1.5, 2.42, 1.0 / 2.42];

/// Fresnel's reflectance with cos² θt = 1 − (1 − c²) / η² in single precision, as textbooks write it.
fn textbook_fresnel(cos: f32, eta: f32) -> f32 {
    let cos2_t = 1.0 - (1.0 - cos * cos) / (eta * eta);
    if cos2_t <= 0.0 {
        return 1.0;
    }
    let cos_t = cos2_t.sqrt();
    let parallel = (eta * cos - cos_t) / (eta * cos + cos_t);
    let perpendicular = (cos - eta * cos_t) / (cos + eta * cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// The reflectance by the laws of sines and tangents, an independent way to the same number.
fn fresnel_by_angles(cos: f64, eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    let (i, sin_t) = (cos.acos(), cos.acos().sin() / eta);
    if sin_t >= 1.0 {
        return 1.0;
    }
    if i < 1e-4 {
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let t = sin_t.asin();
    let (s, p) = ((i - t).sin() / (i + t).sin(), (i - t).tan() / (i + t).tan());
    0.5 * (s * s + p * p)
}

/// Case 34: Fresnel near total reflection and near η = 1: within 10⁻⁶ of the sine and tangent laws, within [0, 1]. The
/// textbook's form is off by 1 at grazing angles near η = 1.
#[test]
fn hard_case_34_fresnel_near_total_reflection() {
    let mut worst_naive = 0.0_f64;
    for eta in ETAS {
        for i in 0..=20_000 {
            let cos = f64::from(i) / 20_000.0;
            let (reflectance, cos_t) = fresnel_dielectric(cos, eta);
            assert!((0.0..=1.0).contains(&reflectance) && (0.0..=1.0).contains(&cos_t));
            let expected = fresnel_by_angles(cos, eta);
            assert!((reflectance - expected).abs() <= 1e-6, "η {eta}, cos {cos}: {reflectance}, {expected}");
            worst_naive =
                worst_naive.max((f64::from(textbook_fresnel(cos as f32, eta as f32)) - expected).abs());
        }
    }
    assert!(worst_naive > 0.5, "the textbook is off by only {worst_naive}");
}

/// Case 35: glass of index 1 reflects exactly nothing, at every angle, and does not bend light. (That its pictures are
/// those without it is a law: `what_loses_nothing_is_invisible_under_a_uniform_sky`.) In the textbook's form grazing
/// light is reflected.
#[test]
fn hard_case_35_glass_of_index_1() {
    let mut reflected_by_naive = 0;
    for i in 0..=20_000 {
        let cos = f64::from(i) / 20_000.0;
        assert_eq!(fresnel_dielectric(cos, 1.0), (0.0, cos));
        reflected_by_naive += usize::from(textbook_fresnel(cos as f32 * 1e-4, 1.0) > 0.0);
    }
    assert!(reflected_by_naive > 100, "the textbook reflects only {reflected_by_naive} times");
}

/// Case 36: 10⁴ bounces between turned frames leave a direction of length 1 ± 10⁻⁶, because each one normalises it. Without
/// that it drifts.
#[test]
fn hard_case_36_directions_keep_their_length() {
    let bounce = |d: Vec3, n: Vec3| {
        let frame = Frame::from_normal(n);
        let local = frame.to_local(d);
        frame.to_world(Vec3::new(local.x, local.y, -local.z))
    };
    let mut random = Random(136);
    let (mut d, mut naive) = (Vec3::X, Vec3::X);
    let mut worst = 0.0_f32;
    for _ in 0..10_000 {
        let n = random.direction();
        d = bounce(d, n).normalize();
        naive = bounce(naive, n);
        worst = worst.max((d.length() - 1.0).abs());
    }
    assert!(worst <= 1e-6, "{worst}");
    assert!((naive.length() - 1.0).abs() > 1e-6, "without normalising it is {}", naive.length());
}
