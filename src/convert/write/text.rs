//! Numbers, points and colours as Snell writes them.

use crate::math::DVec3;

/// A number as short as it can be without changing its value.
pub fn number(x: f64) -> String {
    let x = x + 0.0; // no minus before zero
    if x != 0.0 && !(1e-5..1e15).contains(&x.abs()) { format!("{x:e}") } else { format!("{x}") }
}

/// A computed number, to the seven digits that single precision has.
pub fn rounded(x: f64) -> String {
    let single = x as f32;
    if single.is_finite() {
        single.to_string().parse().map(number).unwrap_or_else(|_| number(x))
    } else {
        number(x)
    }
}

/// `(x, y, z)`.
pub fn point(p: DVec3) -> String {
    format!("({}, {}, {})", number(p.x), number(p.y), number(p.z))
}

/// `(x, y, z)` of computed numbers.
pub fn rounded_point(p: DVec3) -> String {
    format!("({}, {}, {})", rounded(p.x), rounded(p.y), rounded(p.z))
}

/// A linear colour; greys are plain numbers.
pub fn color(c: DVec3) -> String {
    if c.x == c.y && c.y == c.z {
        return rounded(c.x);
    }
    format!("rgb({}, {}, {})", rounded(c.x), rounded(c.y), rounded(c.z))
}

/// `"path"`.
pub fn string(text: &str) -> String {
    format!("\"{text}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        for x in [0.0, -0.0, 0.8, -81.6, 1e-7, 1e-5, 123_456.789, 1e15, 1e300, -2.5e-12] {
            assert_eq!(number(x).parse::<f64>().expect("a number"), x);
        }
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(1e-7), "1e-7");
        assert_eq!(rounded(0.1 + 0.2), "0.3");
    }
}
