//! Mesh files of any format that is read: the bytes say which it is, not the name.

use super::model::{MeshError, Model};
use super::report::About;
use super::{gltf, obj};
use std::path::Path;

/// The largest mesh file that is read, in bytes.
pub const MAX_BYTES: u64 = 4 << 30;

/// The formats that are read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0.
    Gltf,
}

/// What a file of these bytes is.
///
/// # Errors
/// When it is nothing that is read: then what it is.
pub fn format_of(bytes: &[u8]) -> Result<MeshFormat, MeshError> {
    const OTHERS: [(&[u8], &str); 10] = [
        (b"Kaydara FBX", "an FBX file"),
        (b"; FBX", "an FBX file"),
        (b"ply", "a PLY file"),
        (b"solid ", "an STL file"),
        (b"<?xml", "an XML file, such as COLLADA"),
        (b"<COLLADA", "a COLLADA file"),
        (b"BLENDER", "a Blender file"),
        (b"PK\x03\x04", "a ZIP archive, such as USDZ or 3MF"),
        (b"\x89PNG", "a PNG picture"),
        (b"#usda", "a USD file"),
    ];
    if let Some((_, what)) = OTHERS.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Err(MeshError::whole(format!("it is {what}: export it as glTF or OBJ")));
    }
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(MeshError::whole("the file is empty"));
    }
    Ok(if gltf::is_gltf(bytes) { MeshFormat::Gltf } else { MeshFormat::Obj })
}

/// Reads a mesh file of this name; only one part of it, if `part` names one. `open` gives the bytes of a file that it
/// names, or says why there are none.
///
/// # Errors
/// [`MeshError`] with the place where that is known.
pub fn read(
    name: &str,
    bytes: &[u8],
    open: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    part: Option<&str>,
) -> Result<Model, MeshError> {
    if bytes.len() as u64 > MAX_BYTES {
        return Err(MeshError::whole("it is larger than 4 GiB"));
    }
    let format = format_of(bytes)?;
    let mut model = match format {
        MeshFormat::Obj => obj::read(bytes, open, part),
        MeshFormat::Gltf => gltf::read(bytes, open, part),
    }?;
    if let Some(said) = wrong_ending(name, format) {
        model.report.passed_over(About::File, said);
    }
    Ok(model)
}

/// What is to be said of a name that promises another format.
fn wrong_ending(name: &str, format: MeshFormat) -> Option<String> {
    let ending = Path::new(name).extension()?.to_str()?.to_ascii_lowercase();
    let (endings, what): (&[&str], _) = match format {
        MeshFormat::Obj => (&["obj"], "OBJ"),
        MeshFormat::Gltf => (&["gltf", "glb"], "glTF"),
    };
    let is_right = endings.contains(&ending.as_str());
    (!is_right).then(|| format!("the ending `.{ending}`, as the file is {what}"))
}
