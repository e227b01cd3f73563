//! Tables of lens surfaces: a line for each surface, from the front of the lens to its back.
//!
//! Four numbers a line, parted by blanks, in millimetres: the radius of curvature (positive when the surface bulges to the
//! front, 0 for a flat one), the distance along the axis to the next surface, the refractive index of what lies between
//! (1 for air), and the diameter of the opening. The stop is a line that begins with `stop` in place of a radius. What
//! follows `#` is a comment. The last distance is that to the film, and is replaced when the lens is focused.

use std::fmt::Write;
use thiserror::Error;

/// More surfaces than any lens has.
const MOST: usize = 200;

/// A lens as its table says.
#[derive(Clone, PartialEq, Debug)]
pub struct LensTable {
    /// From the front to the back.
    pub surfaces: Vec<LensSurface>,
    /// Which of them is the stop.
    pub stop: usize,
}

/// A surface, in metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LensSurface {
    /// Of curvature; 0 for a flat one and for the stop.
    pub radius: f64,
    /// To the next one.
    pub thickness: f64,
    /// The refractive index of what lies behind it.
    pub ior: f64,
    /// The radius of its opening.
    pub aperture: f64,
}

/// What is wrong with a table.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum LensError {
    /// A line that is not as it must be.
    #[error("line {line}: {reason}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// Why.
        reason: String,
    },
    /// Something about all of it.
    #[error("{0}")]
    Whole(&'static str),
}

/// Reads a table.
pub fn read(bytes: &[u8]) -> Result<LensTable, LensError> {
    let text = std::str::from_utf8(bytes).map_err(|_| LensError::Whole("it is no text"))?;
    let (mut surfaces, mut stop) = (Vec::new(), None);
    for (index, line) in text.lines().enumerate() {
        let wrong = |reason| LensError::Line { line: index + 1, reason };
        let words: Vec<&str> = line.split('#').next().unwrap_or("").split_whitespace().collect();
        if words.is_empty() {
            continue;
        }
        let (surface, is_stop) = surface(&words).map_err(wrong)?;
        if is_stop && stop.replace(surfaces.len()).is_some() {
            return Err(wrong("a lens has one stop, and this is the second".to_owned()));
        }
        surfaces.push(surface);
        if surfaces.len() > MOST {
            return Err(wrong(format!("more than {MOST} surfaces")));
        }
    }
    let is_powerless = surfaces.iter().all(|surface: &LensSurface| surface.radius == 0.0);
    match (surfaces.as_slice(), stop) {
        ([], _) => Err(LensError::Whole("it has no surfaces")),
        (_, None) => Err(LensError::Whole("it has no line that begins with `stop`")),
        _ if is_powerless => Err(LensError::Whole("none of its surfaces is curved")),
        (_, Some(stop)) => Ok(LensTable { surfaces, stop }),
    }
}

/// The surface of a line, and whether it is the stop.
fn surface(words: &[&str]) -> Result<(LensSurface, bool), String> {
    let [radius, rest @ ..] = words else { unreachable!("empty lines are passed over") };
    let is_stop = *radius == "stop";
    let columns = ["radius", "distance", "index", "diameter"];
    if words.len() != columns.len() {
        let mut reason =
            format!("{} numbers where four are wanted: radius, distance, index, diameter", words.len());
        if words.len() == 1 {
            reason = reason.replacen("numbers", "number", 1);
        }
        return Err(reason);
    }
    let number = |word: &str| {
        let value: f64 = word.parse().map_err(|_| format!("`{word}` is no number"))?;
        if value.is_finite() { Ok(value) } else { Err(format!("`{word}` is not finite")) }
    };
    let radius = if is_stop { 0.0 } else { number(radius)? };
    let [thickness, ior, diameter] = [number(rest[0])?, number(rest[1])?, number(rest[2])?];
    let mut wrong = String::new();
    if thickness < 0.0 {
        let _ = write!(wrong, "the distance {thickness} is negative");
    } else if !(1.0..=4.0).contains(&ior) {
        let _ = write!(wrong, "the index {ior} is not from 1 to 4");
    } else if diameter <= 0.0 {
        let _ = write!(wrong, "the diameter {diameter} is not greater than 0");
    } else if radius != 0.0 && diameter > 2.0 * radius.abs() {
        let _ = write!(wrong, "the diameter {diameter} is wider than a ball of the radius {}", radius.abs());
    }
    const MILLIMETRE: f64 = 1e-3;
    let surface = LensSurface {
        radius: radius * MILLIMETRE,
        thickness: thickness * MILLIMETRE,
        ior,
        aperture: diameter * 0.5 * MILLIMETRE,
    };
    if wrong.is_empty() { Ok((surface, is_stop)) } else { Err(wrong) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read() {
        let lens = read(b"# a lens\n50 4 1.5 20 # front\n-50 1 1 20\n\nstop 40 1 10\n").expect("it is sound");
        assert_eq!((lens.surfaces.len(), lens.stop), (3, 2));
        assert_eq!(
            lens.surfaces[0],
            LensSurface { radius: 0.05, thickness: 0.004, ior: 1.5, aperture: 0.01 }
        );
    }

    #[test]
    fn every_mistake_is_told_with_its_line() {
        for (text, said) in [
            ("", "it has no surfaces"),
            ("50 4 1.5 20", "it has no line that begins with `stop`"),
            ("stop 4 1 20", "none of its surfaces is curved"),
            (
                "50 4 1.5 20\n50 4 1.5",
                "line 2: 3 numbers where four are wanted: radius, distance, index, diameter",
            ),
            ("\n50", "line 2: 1 number where four are wanted: radius, distance, index, diameter"),
            ("50 4 glass 20", "line 1: `glass` is no number"),
            ("50 inf 1.5 20", "line 1: `inf` is not finite"),
            ("50 -4 1.5 20", "line 1: the distance -4 is negative"),
            ("50 4 0.5 20", "line 1: the index 0.5 is not from 1 to 4"),
            ("50 4 1.5 0", "line 1: the diameter 0 is not greater than 0"),
            ("5 4 1.5 20", "line 1: the diameter 20 is wider than a ball of the radius 5"),
            ("stop 1 1 2\nstop 1 1 2", "line 2: a lens has one stop, and this is the second"),
        ] {
            assert_eq!(read(text.as_bytes()).expect_err(text).to_string(), said);
        }
        assert_eq!(read(&[0xff, 0xfe]).expect_err("no text").to_string(), "it is no text");
    }
}
