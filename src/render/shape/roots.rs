//! All real roots in [0, 1], none of them missed: monotone intervals and bracketed Newton (Yuksel 2022).

/// Roots of polynomials up to degree 6, in increasing order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Roots {
    values: [f64; 6],
    count: usize,
}

impl Roots {
    /// The roots in increasing order.
    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.count]
    }

    fn push(&mut self, root: f64) {
        self.values[self.count] = root;
        self.count += 1;
    }
}

/// The roots in [0, 1] of a polynomial with `coefficients` of rising powers, degree at most 6.
///
/// Between neighbouring roots of its derivative it is monotone, so a change of sign brackets exactly one root. A root
/// that only touches zero is found where rounding lets it cross.
pub fn polynomial(coefficients: &[f64]) -> Roots {
    let value = |u: f64| evaluate(coefficients, u);
    let ends = [value(0.0).0, value(1.0).0];
    monotone(critical_points(coefficients), ends, value)
}

/// Where the derivative of a polynomial is 0 in [0, 1].
pub fn critical_points(coefficients: &[f64]) -> Roots {
    let mut derivative = [0.0; 6];
    let degree = coefficients.len().saturating_sub(1);
    for (i, slot) in derivative[..degree].iter_mut().enumerate() {
        *slot = coefficients[i + 1] * (i + 1) as f64;
    }
    match degree {
        0 | 1 => Roots::default(),
        _ => polynomial(&derivative[..degree]),
    }
}

/// The roots in [0, 1] of a function that is monotone between neighbouring points of `turns`.
///
/// `value` gives the function and its derivative; `ends` holds its values at 0 and 1. Zero counts as positive
/// everywhere, so that curves which share an end, and thus its value, never both disown a root there.
pub fn monotone(turns: Roots, ends: [f64; 2], value: impl Fn(f64) -> (f64, f64)) -> Roots {
    let mut roots = Roots::default();
    let (mut a, mut positive) = (0.0, ends[0] >= 0.0);
    for (i, &b) in turns.as_slice().iter().chain(&[1.0]).enumerate() {
        let at_b = if i == turns.count { ends[1] } else { value(b).0 };
        if (at_b >= 0.0) != positive {
            roots.push(bracketed(a, b, positive, &value));
            positive = !positive;
        }
        a = b;
    }
    roots
}

/// The root between `a` and `b`, where the function is `positive` at `a` only or at `b` only.
///
/// Newton's method, replaced by bisection whenever it leaves the bracket or does not halve the step.
fn bracketed(mut a: f64, mut b: f64, positive: bool, value: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut root = 0.5 * (a + b);
    let mut last_step = b - a;
    while b - a > f64::EPSILON * b {
        let (f, slope) = value(root);
        if (f >= 0.0) == positive {
            a = root;
        } else {
            b = root;
        }
        let newton = root - f / slope;
        let next = if a < newton && newton < b && (newton - root).abs() < 0.5 * last_step {
            newton
        } else {
            0.5 * (a + b)
        };
        last_step = (next - root).abs();
        if last_step <= f64::EPSILON * root {
            return next;
        }
        root = next;
    }
    root
}

/// A polynomial and its derivative at `u`, by Horner's rule.
pub fn evaluate(coefficients: &[f64], u: f64) -> (f64, f64) {
    coefficients.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * u + c, slope * u + value))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of rising powers of the monic polynomial with these roots.
    fn with_roots(roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![1.0], |p, root| {
            let shifted = std::iter::once(&0.0).chain(&p);
            let scaled = p.iter().chain(&[0.0]);
            shifted.zip(scaled).map(|(high, low)| high - root * low).collect()
        })
    }

    #[test]
    fn every_root_in_the_unit_interval_is_found() {
        for roots in [
            vec![0.5],
            vec![0.1, 0.9],
            vec![0.05, 0.2, 0.21, 0.5, 0.77, 0.99],
            vec![-1.0, 0.3, 0.300_01, 2.0],
        ] {
            let found = polynomial(&with_roots(&roots));
            let inside: Vec<_> = roots.iter().filter(|root| (0.0..=1.0).contains(*root)).collect();
            assert_eq!(found.as_slice().len(), inside.len(), "{roots:?} gave {found:?}");
            for (root, found) in inside.iter().zip(found.as_slice()) {
                assert!((*root - found).abs() < 1e-9, "{root} found as {found}");
            }
        }
    }

    #[test]
    fn constants_have_no_roots() {
        assert!(polynomial(&[0.0, 0.0, 0.0]).as_slice().is_empty());
        assert!(polynomial(&[3.0]).as_slice().is_empty());
    }
}
