//! The lines, words and numbers of OBJ and MTL files.

use std::borrow::Cow;

/// The text in UTF-8, without a mark of its encoding; other bytes stay as they are, for they stand in names only.
pub(super) fn in_utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let units = |from: fn([u8; 2]) -> u16| -> Vec<u8> {
        let units = bytes[2..].chunks_exact(2).map(|pair| from([pair[0], pair[1]]));
        let text = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER));
        text.collect::<String>().into_bytes()
    };
    match bytes {
        [0xff, 0xfe, ..] => Cow::Owned(units(u16::from_le_bytes)),
        [0xfe, 0xff, ..] => Cow::Owned(units(u16::from_be_bytes)),
        [0xef, 0xbb, 0xbf, text @ ..] => Cow::Borrowed(text),
        _ => Cow::Borrowed(bytes),
    }
}

/// Lines with their numbers: ended by LF, CR LF or CR; a backslash at the end continues one.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text, number: 0 }
    }

    /// The next line that is not empty, and the number of its first.
    pub(super) fn next(&mut self) -> Option<(usize, Cow<'a, [u8]>)> {
        let line = self.physical()?;
        let first = self.number;
        let Some(head) = line.strip_suffix(b"\\") else { return Some((first, Cow::Borrowed(line))) };
        let mut joined = head.to_vec();
        while let Some(line) = self.physical() {
            joined.push(b' ');
            match line.strip_suffix(b"\\") {
                Some(more) => joined.extend_from_slice(more),
                None => {
                    joined.extend_from_slice(line);
                    break;
                }
            }
        }
        Some((first, Cow::Owned(joined)))
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|&byte| byte == b'\n' || byte == b'\r');
        let end = end.unwrap_or(self.rest.len());
        let (line, after) = self.rest.split_at(end);
        self.rest = match after {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => after,
        };
        Some(line)
    }
}

/// What follows the keyword, to the end of the line: names may hold blanks, and signs that elsewhere begin comments.
pub(super) fn name(line: &[u8], keyword: &[u8]) -> String {
    let line = line.trim_ascii_start();
    String::from_utf8_lossy(line.get(keyword.len()..).unwrap_or(b"").trim_ascii()).into_owned()
}

/// A number in single precision. What the C library of old programs prints for numbers that are none is not finite.
pub(super) fn float(word: &[u8]) -> Option<f32> {
    let text = std::str::from_utf8(word).ok()?;
    text.parse().ok().or_else(|| text.contains(".#").then_some(f32::NAN))
}

/// A whole number with or without a sign.
pub(super) fn integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || digits.len() > 18 {
        // Far beyond what any file counts, and no number at all.
        return (!digits.is_empty() && digits.iter().all(u8::is_ascii_digit)).then_some(i64::MAX);
    }
    let value = digits
        .iter()
        .try_fold(0_i64, |value, byte| byte.is_ascii_digit().then(|| value * 10 + i64::from(byte - b'0')))?;
    Some(if negative { -value } else { value })
}
