//! The outer forms of glTF: a binary file of chunks, and bytes written into a URI.

use crate::asset::model::MeshError;
use crate::asset::report::{About, ImportReport};

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// The text and the bytes of a file.
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: Option<&'a [u8]>,
}

/// Whether bytes begin as a binary glTF file does.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Takes a file apart (glTF 2.0, section 4.4).
pub(super) fn open<'a>(bytes: &'a [u8], report: &mut ImportReport) -> Result<Container<'a>, MeshError> {
    if !is_binary(bytes) {
        let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        return Ok(Container { json, binary: None });
    }
    let word = |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(MeshError::whole("it ends within its header of 12 bytes"));
    };
    if version != 2 {
        return Err(MeshError::whole(format!("it is glTF {version}, and only glTF 2 is read")));
    }
    let length = length as usize;
    if length > bytes.len() {
        let reason = format!("it is cut off: its header says {length} bytes, and it has {}", bytes.len());
        return Err(MeshError::Whole(reason));
    }
    if length < bytes.len() {
        let more = bytes.len() - length;
        report.passed_over(About::File, format!("{more} bytes after the length that its header says"));
    }
    let (mut json, mut binary, mut at) = (None, None, 12);
    while at < length {
        let (Some(size), Some(kind)) = (word(at), word(at + 4)) else {
            return Err(MeshError::whole("it ends within the header of a chunk"));
        };
        let chunk = (at + 8).checked_add(size as usize).filter(|end| *end <= length);
        let Some(end) = chunk else {
            let reason = format!("a chunk at byte {at} claims {size} bytes, more than the file has left");
            return Err(MeshError::Whole(reason));
        };
        let content = &bytes[at + 8..end];
        match kind {
            JSON if json.is_none() && binary.is_none() => json = Some(content),
            BIN if json.is_some() && binary.is_none() => binary = Some(content),
            _ => report.passed_over(About::File, "a chunk of an unknown kind"),
        }
        at = end;
    }
    let json = json.ok_or_else(|| MeshError::whole("its first chunk is not JSON"))?;
    Ok(Container { json, binary })
}

/// Where a URI points.
#[derive(PartialEq, Eq, Debug)]
pub(super) enum Uri {
    /// It holds the bytes itself.
    Data(Vec<u8>),
    /// To a file, as seen from this one.
    File(String),
}

/// Understands a URI (RFC 3986, RFC 2397), or says why it cannot be followed.
pub(super) fn uri(text: &str) -> Result<Uri, String> {
    if let Some(data) = text.strip_prefix("data:") {
        let (head, body) = data.split_once(',').ok_or("its `data:` URI has no comma")?;
        return match head.ends_with(";base64") {
            true => base64(body.as_bytes()).map(Uri::Data),
            false => Ok(Uri::Data(unescaped(body))),
        };
    }
    let scheme = text.split_once(':').map(|(scheme, _)| scheme).filter(|scheme| {
        scheme.len() > 1 && scheme.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"+-.".contains(&byte))
    });
    if let Some(scheme) = scheme {
        return Err(format!("`{scheme}:` URIs are not followed"));
    }
    match String::from_utf8(unescaped(text)) {
        Ok(file) if file.is_empty() => Err("its URI is empty".to_owned()),
        Ok(file) if file.contains('\0') => Err("its URI holds a zero byte".to_owned()),
        Ok(file) => Ok(Uri::File(file)),
        Err(_) => Err("its URI is not UTF-8".to_owned()),
    }
}

/// Bytes with `%20` and the like taken back.
fn unescaped(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).and_then(|byte| char::from(*byte).to_digit(16));
    let (mut out, mut at) = (Vec::with_capacity(bytes.len()), 0);
    while at < bytes.len() {
        match (bytes[at], digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                out.push((high * 16 + low) as u8);
                at += 3;
            }
            (byte, ..) => {
                out.push(byte);
                at += 1;
            }
        }
    }
    out
}

/// Bytes from their sixty-four signs (RFC 4648, section 4), with or without padding.
fn base64(text: &[u8]) -> Result<Vec<u8>, String> {
    let text = match text {
        [rest @ .., b'=', b'='] | [rest @ .., b'='] => rest,
        all => all,
    };
    if text.len() % 4 == 1 {
        return Err("its base64 ends in the middle of a byte".to_owned());
    }
    let mut out = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for four in text.chunks(4) {
        let mut bits = 0_u32;
        for &sign in four {
            let value = match sign {
                b'A'..=b'Z' => sign - b'A',
                b'a'..=b'z' => sign - b'a' + 26,
                b'0'..=b'9' => sign - b'0' + 52,
                b'+' | b'-' => 62,
                b'/' | b'_' => 63,
                _ => return Err(format!("its base64 holds `{}`", char::from(sign).escape_default())),
            };
            bits = bits << 6 | u32::from(value);
        }
        bits <<= 6 * (4 - four.len());
        out.extend_from_slice(&bits.to_be_bytes()[1..four.len()]);
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vectors of RFC 4648, section 10.
    #[test]
    fn base64_is_read_as_the_standard_says() {
        let cases = [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYg==", "foob")];
        for (signs, bytes) in cases {
            assert_eq!(base64(signs.as_bytes()).as_deref(), Ok(bytes.as_bytes()));
        }
        assert!(base64(b"Zm9vY").is_err() && base64(b"Zm9 v").is_err());
    }

    #[test]
    fn only_files_and_data_are_followed() {
        assert_eq!(uri("a%20b.bin"), Ok(Uri::File("a b.bin".to_owned())));
        assert_eq!(uri("data:;base64,Zm8="), Ok(Uri::Data(b"fo".to_vec())));
        assert_eq!(uri("data:text/plain,f%6f"), Ok(Uri::Data(b"fo".to_vec())));
        assert!(uri("https://example.org/a.bin").is_err() && uri("").is_err() && uri("a%00").is_err());
        assert!(uri("data:base64").is_err());
    }
}
