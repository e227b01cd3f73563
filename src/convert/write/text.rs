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

/// A number that is approximate anyway, to five digits.
pub fn rough(x: f64) -> String {
    format!("{x:.4e}").parse().map(number).unwrap_or_else(|_| number(x))
}

/// A coordinate, to twelve digits: more than any file has, and fewer than sums get wrong.
pub fn coordinate(x: f64) -> String {
    format!("{x:.11e}").parse().map(number).unwrap_or_else(|_| number(x))
}

/// `(x, y, z)`.
pub fn point(p: DVec3) -> String {
    format!("({}, {}, {})", coordinate(p.x), coordinate(p.y), coordinate(p.z))
}

/// `(x, y, z)` of computed numbers.
pub fn rounded_point(p: DVec3) -> String {
    format!("({}, {}, {})", rounded(p.x), rounded(p.y), rounded(p.z))
}

/// A linear colour; greys are plain numbers.
pub fn color(c: DVec3) -> String {
    grey_or_rgb(c.to_array().map(rounded))
}

/// A linear colour that is approximate anyway.
pub fn rough_color(c: DVec3) -> String {
    grey_or_rgb(c.to_array().map(rough))
}

fn grey_or_rgb([r, g, b]: [String; 3]) -> String {
    if r == g && g == b { r } else { format!("rgb({r}, {g}, {b})") }
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
        assert_eq!(coordinate(-3.817 - 0.5 * 3.345), "-5.4895");
    }
}
