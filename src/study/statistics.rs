//! What is known of distributions: tails, quantiles, lines through points, resampling.

use libm::lgamma;

/// The probability that |t| of Student's distribution with `dof` degrees of freedom is at least `t`.
///
/// `dof` is positive and may be a fraction (Welch 1947). Accurate to about 1e-12 (Press et al. 2007, section 6.14).
pub fn student_two_sided(t: f64, dof: f64) -> f64 {
    if t.is_infinite() { 0.0 } else { incomplete_beta(0.5 * dof, 0.5, dof / (dof + t * t)) }
}

/// The t that |t| of Student's distribution stays below with probability `inside`, by bisection.
pub fn student_quantile(inside: f64, dof: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    while student_two_sided(high, dof) > 1.0 - inside && high < 1e6 {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if student_two_sided(middle, dof) > 1.0 - inside { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The regularised incomplete beta function I_x(a, b), by its continued fraction (Press et al. 2007, section 6.4).
fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    let front = (lgamma(a + b) - lgamma(a) - lgamma(b) + a * x.ln() + b * (1.0 - x).ln()).exp();
    if x < (a + 1.0) / (a + b + 2.0) {
        front * beta_fraction(a, b, x) / a
    } else {
        1.0 - front * beta_fraction(b, a, 1.0 - x) / b
    }
}

/// Lentz's evaluation of the continued fraction.
fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let away_from_zero = |value: f64| if value.abs() < 1e-300 { 1e-300 } else { value };
    let mut c = 1.0;
    let mut d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    let mut product = d;
    for m in (1..10_000).map(f64::from) {
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let before = product;
        for numerator in [even, odd] {
            d = 1.0 / away_from_zero(1.0 + numerator * d);
            c = away_from_zero(1.0 + numerator / c);
            product *= c * d;
        }
        if (product / before - 1.0).abs() < 1e-15 {
            break;
        }
    }
    product
}

/// The probability of a Kolmogorov–Smirnov distance at least that of `values` from the uniform distribution on [0, 1].
///
/// The asymptotic series with Stephens's correction for few values (Press et al. 2007, section 14.3.3).
pub fn uniform_p(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let n = sorted.len() as f64;
    if sorted.is_empty() {
        return 1.0;
    }
    let distance = sorted.iter().enumerate().fold(0.0_f64, |most, (i, x)| {
        let (below, above) = (i as f64 / n, (i + 1) as f64 / n);
        most.max(x - below).max(above - x)
    });
    let lambda = (n.sqrt() + 0.12 + 0.11 / n.sqrt()) * distance;
    if lambda < 0.2 {
        return 1.0; // the series converges slowly there, to 1 within 1e-12
    }
    let term = |k: i32| {
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        sign * (-2.0 * f64::from(k * k) * lambda * lambda).exp()
    };
    (2.0 * (1..100).map(term).sum::<f64>()).clamp(0.0, 1.0)
}

/// The probability that values from the uniform distribution on [0, 1] crowd towards 0 as much as `values` do: the
/// one-sided Kolmogorov–Smirnov test (Smirnov 1944).
pub fn crowded_p(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let excess = sorted.iter().enumerate().map(|(i, x)| (i + 1) as f64 / n - x).fold(0.0, f64::max);
    (-2.0 * n * excess * excess).exp()
}

/// The value below which the share `q` of sorted values lies, between neighbours in proportion. NaN of nothing.
pub fn quantile(sorted: &[f64], q: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let at = q.clamp(0.0, 1.0) * last as f64;
    let (below, above) = (at.floor() as usize, at.ceil() as usize);
    sorted[below] + (sorted[above] - sorted[below]) * (at - at.floor())
}

/// The middle value.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    quantile(&sorted, 0.5)
}

/// The line through points that leaves the least squares in y: (slope, height at x = 0). `None` below two different x.
pub fn line_through(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = points.len() as f64;
    let (mx, my) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let sxx: f64 = points.iter().map(|p| (p.0 - mx) * (p.0 - mx)).sum();
    let sxy: f64 = points.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    (sxx > 0.0).then(|| (sxy / sxx, my - mx * sxy / sxx))
}

/// The 95 % interval of a statistic of `count` runs, by drawing them anew with repetition (Efron 1979): `statistic` takes
/// the indices that were drawn. The numbers drawn are always the same.
pub fn bootstrap(count: usize, statistic: impl Fn(&[usize]) -> Option<f64>) -> Option<(f64, f64)> {
    const DRAWS: usize = 1000;
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut next = || {
        // xorshift64* (Marsaglia 2003; Vigna 2016)
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize
    };
    let draw = |_| statistic(&(0..count).map(|_| next() % count).collect::<Vec<_>>());
    let mut values: Vec<f64> = (0..DRAWS).filter_map(draw).filter(|value| value.is_finite()).collect();
    values.sort_unstable_by(f64::total_cmp);
    (!values.is_empty()).then(|| (quantile(&values, 0.025), quantile(&values, 0.975)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn student_s_tails_are_those_of_the_tables() {
        // Quantiles of the two-sided 95 % (Abramowitz & Stegun 1972, table 26.10).
        for (dof, t) in [(1.0, 12.706), (7.0, 2.365), (15.0, 2.131), (120.0, 1.980)] {
            assert!((student_quantile(0.95, dof) - t).abs() < 1e-3, "{dof}");
            assert!((student_two_sided(t, dof) - 0.05).abs() < 1e-4, "{dof}");
        }
        assert_eq!(student_two_sided(0.0, 3.0), 1.0);
        assert_eq!(student_two_sided(f64::INFINITY, 3.0), 0.0);
    }

    #[test]
    fn even_values_look_uniform_and_crowded_ones_do_not() {
        let even: Vec<f64> = (0..200).map(|i| (f64::from(i) + 0.5) / 200.0).collect();
        assert!(uniform_p(&even) > 0.999);
        let crowded: Vec<f64> = even.iter().map(|x| x * x).collect();
        assert!(uniform_p(&crowded) < 1e-6 && crowded_p(&crowded) < 1e-6);
        let empty_near_0: Vec<f64> = even.iter().map(|x| x.sqrt()).collect();
        assert!(crowded_p(&even) > 0.9 && crowded_p(&empty_near_0) > 0.9);
        // A distance of 1.358 / √n has probability 0.05 (Smirnov 1948).
        let shift = 1.358 / (200.0_f64.sqrt() + 0.12);
        let shifted: Vec<f64> = even.iter().map(|x| (x + shift - 0.0025).min(1.0)).collect();
        assert!((uniform_p(&shifted) - 0.05).abs() < 0.01, "{}", uniform_p(&shifted));
    }

    #[test]
    fn quantiles_and_lines() {
        assert_eq!(quantile(&[1.0, 2.0, 4.0], 0.75), 3.0);
        assert_eq!(median(&[9.0, 1.0, 2.0]), 2.0);
        let (slope, height) = line_through(&[(0.0, 1.0), (1.0, 0.0), (2.0, -1.0)]).unwrap();
        assert!((slope + 1.0).abs() < 1e-12 && (height - 1.0).abs() < 1e-12);
        assert_eq!(line_through(&[(1.0, 1.0)]), None);
    }

    #[test]
    fn the_bootstrap_finds_the_spread_of_a_mean() {
        let values: Vec<f64> = (0..40).map(f64::from).collect();
        let mean = |drawn: &[usize]| Some(drawn.iter().map(|&i| values[i]).sum::<f64>() / 40.0);
        let (low, high) = bootstrap(40, mean).unwrap();
        // The standard error is 11.5 / √40 = 1.83.
        assert!((low - (19.5 - 3.6)).abs() < 0.5 && (high - (19.5 + 3.6)).abs() < 0.5, "{low} {high}");
    }
}
