//! `--frames`: which frames of a sequence, what they set, and how their pictures are called.

use super::session::Session;
use crate::resolve::Offered;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The parameter that counts frames.
pub const PARAMETER: &str = "frame";
/// The most frames of one run.
const MOST: i64 = 1_000_000;

/// The frames from the first to the last, both taken in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Frames {
    first: i64,
    last: i64,
}

impl Frames {
    /// Each of them.
    pub fn iter(self) -> impl Iterator<Item = i64> + Clone {
        self.first..=self.last
    }

    /// How many there are.
    pub const fn count(self) -> usize {
        (self.last - self.first + 1) as usize
    }
}

/// `0..48` without its end, `0..=48` with it, `17` alone.
pub fn parse(text: &str) -> Result<Frames, String> {
    let number = |text: &str| text.trim().parse::<i64>().ok().filter(|n| n.abs() <= i64::from(i32::MAX));
    let frames = match (text.split_once("..="), text.split_once("..")) {
        (Some((first, last)), _) => number(first).zip(number(last)),
        (None, Some((first, end))) => number(first).zip(number(end).map(|end| end - 1)),
        (None, None) => number(text).map(|frame| (frame, frame)),
    };
    let Some((first, last)) = frames else {
        return Err("write frames such as `0..48`, `0..=47` or `17`".to_owned());
    };
    match last - first + 1 {
        count if count < 1 => Err(format!("no frame lies in {text}; the end of `A..B` is left out")),
        count if count > MOST => Err(format!("{count} frames are more than {MOST}")),
        _ => Ok(Frames { first, last }),
    }
}

/// Why the scene cannot be told its frame.
///
/// # Errors
/// A sentence that says what to write.
pub fn check_parameter(session: &mut Session, sets: &[(String, String)]) -> Result<(), String> {
    if sets.iter().any(|(name, _)| name == PARAMETER) {
        return Err("`--frames` sets `frame` already: leave `--set frame=..` away".to_owned());
    }
    let offers = session.survey();
    session.problems = Default::default(); // they are told by the frames
    let declared = offers.iter().find_map(|offer| match &offer.what {
        Offered::Param { ty, .. } if offer.name.value == PARAMETER => Some(ty.as_str()),
        _ => None,
    });
    match declared {
        Some("int") => Ok(()),
        Some(ty) => {
            Err(format!("`param frame` is a `{ty}`: for `--frames` declare it `param frame: int = 0`"))
        }
        None => Err(format!(
            "`{}` has no parameter `frame`: declare it, such as `param frame: int = 0 in 0..48`",
            session.name
        )),
    }
}

/// The name of each frame's picture: `{frame}`, or `{frame:04}` with at least four digits. Without that the number comes
/// before the extension, with four digits.
fn name_of(template: &Path, frame: i64) -> Result<PathBuf, String> {
    let text = template.to_str().ok_or("a template is a text in UTF-8")?;
    if !text.contains('{') {
        let extension = template.extension().map_or(String::new(), |e| format!(".{}", e.to_string_lossy()));
        let stem = text.strip_suffix(&extension).unwrap_or(text);
        return Ok(PathBuf::from(format!("{stem}.{}{extension}", padded(frame, 4))));
    }
    let mut name = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let wrong = || format!("in `{text}` write `{{frame}}`, or `{{frame:04}}` for at least four digits");
        let (field, after) = after.split_once('}').ok_or_else(wrong)?;
        let width = match field.strip_prefix(PARAMETER) {
            Some("") => 1,
            Some(width) => {
                let digits = width.strip_prefix(':').and_then(|width| width.parse::<usize>().ok());
                digits.filter(|&digits| digits <= 20).ok_or_else(wrong)?
            }
            None => return Err(wrong()),
        };
        name.extend([before, &padded(frame, width)]);
        rest = after;
    }
    name.push_str(rest);
    Ok(PathBuf::from(name))
}

fn padded(frame: i64, width: usize) -> String {
    let sign = if frame < 0 { "-" } else { "" };
    format!("{sign}{:0width$}", frame.unsigned_abs())
}

/// The pictures of each frame; two of one name are an error.
///
/// # Errors
/// A sentence that says what to write.
pub fn outputs(templates: &[PathBuf], frames: Frames) -> Result<Vec<(i64, Vec<PathBuf>)>, String> {
    let mut owners: BTreeMap<PathBuf, i64> = BTreeMap::new();
    let mut all = Vec::with_capacity(frames.count());
    for frame in frames.iter() {
        let paths: Vec<PathBuf> =
            templates.iter().map(|template| name_of(template, frame)).collect::<Result<_, _>>()?;
        for path in &paths {
            if let Some(other) = owners.insert(path.clone(), frame) {
                let which = if other == frame {
                    format!("frame {frame} twice")
                } else {
                    format!("frames {other} and {frame}")
                };
                return Err(format!(
                    "`{}` would be written for {which}: put `{{frame:04}}` into its name",
                    path.display()
                ));
            }
        }
        all.push((frame, paths));
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_ranges_or_one_number() {
        assert_eq!(parse("0..48"), Ok(Frames { first: 0, last: 47 }));
        assert_eq!(parse("0..=48"), Ok(Frames { first: 0, last: 48 }));
        assert_eq!(parse("-2..=2").map(Frames::count), Ok(5));
        assert_eq!(parse("17"), Ok(Frames { first: 17, last: 17 }));
        for wrong in ["", "a..b", "3..3", "5..2", "0..99999999", "1..2..3", "1.5"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn names_hold_the_number() {
        let name = |template: &str, frame| {
            name_of(Path::new(template), frame).map(|path| path.display().to_string())
        };
        assert_eq!(name("out.png", 7).as_deref(), Ok("out.0007.png"));
        assert_eq!(name("a/f-{frame}.exr", 7).as_deref(), Ok("a/f-7.exr"));
        assert_eq!(name("{frame:03}/x.png", -7).as_deref(), Ok("-007/x.png"));
        assert!(name("x{frme}.png", 7).is_err() && name("x{frame.png", 7).is_err());
    }

    #[test]
    fn two_pictures_have_two_names() {
        let frames = parse("0..3").expect("a range");
        let of = |names: &[&str]| outputs(&names.iter().map(PathBuf::from).collect::<Vec<_>>(), frames);
        assert_eq!(of(&["a.png", "a.exr"]).map(|all| all.len()), Ok(3));
        assert!(of(&["a.png", "a.png"]).is_err());
        assert!(of(&["a{frame}.png", "a.{frame}.png"]).is_ok());
    }
}
