//! Mesh files with traps: what each gives, compared with what it gave before.
//!
//! To add a trap, add a file to `tests/assets/obj` or `tests/assets/gltf`, and run once with `UPDATE=1`. What is said of all
//! files of a folder stands in its `said.txt`.

use snell::diag::{Problems, Report};
use snell::load::{self, MeshImport};
use snell::source::{Disk, Files, Memory, SourceMap};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// What there is to say of a mesh: what was read of it, and what is wrong with it.
fn said(name: &str, files: &dyn Files, folder: &Path) -> String {
    let text = format!("snell 1\nmesh {{ file: \"{name}\" }}\nenvironment {{}}\n");
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add("x.snell".to_owned(), folder.join("x.snell"), text.as_str().into()).unwrap();
    let checked = snell::compile(&mut sources, files, main, &[], &mut problems).expect("the scene is right");
    let loaded = load::load(&checked, &sources, files, &mut problems);
    let imports: Vec<MeshImport> = loaded.iter().flat_map(|loaded| loaded.imports().cloned()).collect();
    assert!(loaded.is_some() || problems.has_errors(), "{name}: nothing came out, and nothing is wrong");
    let mut out = format!("── {name}\n");
    for import in imports {
        let _ = writeln!(out, "{} triangles, {} materials", import.triangle_count, import.material_count);
        import.lines.iter().for_each(|line| writeln!(out, "  {line}").unwrap());
    }
    let report: Report = problems.into_report(&sources);
    out + &report.render_short()
}

/// Compares what is said of all files of a folder with what was said before, or writes it there.
fn compare(path: &Path, said: &str) {
    let expected = std::fs::read_to_string(path).unwrap_or_default();
    if std::env::var_os("UPDATE").is_some() {
        return std::fs::write(path, said).expect("an expectation can be written");
    }
    let differing = said.split("── ").zip(expected.split("── ")).find(|(said, expected)| said != expected);
    assert!(expected == said, "{}: {differing:#?}", path.display());
}

fn meshes(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).expect("the folder is there").map(|entry| entry.unwrap().path());
    let is_mesh =
        |path: &PathBuf| path.extension().is_some_and(|e| endings.iter().any(|ending| e == *ending));
    let mut files: Vec<PathBuf> = files.filter(is_mesh).collect();
    files.sort();
    files
}

fn all_of(folder: &str, endings: &[&str]) {
    let folder = Path::new(folder);
    let files = Disk::new(&folder.join("x.snell"), Vec::new(), false);
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    let all: String = meshes(folder, endings).iter().map(|mesh| said(&name(mesh), &files, folder)).collect();
    compare(&folder.join("said.txt"), &all);
}

#[test]
fn traps_in_obj_files_are_told() {
    all_of("tests/assets/obj", &["obj"]);
}

#[test]
fn traps_in_gltf_files_are_told() {
    all_of("tests/assets/gltf", &["gltf"]);
}

/// A binary file of two chunks, as glTF 2.0, section 4.4, has it.
fn binary(json: &str, bytes: &[u8]) -> Vec<u8> {
    let padded = |content: &[u8], with: u8| {
        let mut content = content.to_vec();
        content.resize(content.len().next_multiple_of(4), with);
        content
    };
    let (json, bytes) = (padded(json.as_bytes(), b' '), padded(bytes, 0));
    let length = 12 + 8 + json.len() + 8 + bytes.len();
    let chunk =
        |kind: &[u8], content: &[u8]| [&(content.len() as u32).to_le_bytes()[..], kind, content].concat();
    let head = [&b"glTF"[..], &2_u32.to_le_bytes(), &(length as u32).to_le_bytes()].concat();
    [head, chunk(b"JSON", &json), chunk(b"BIN\0", &bytes)].concat()
}

const TRIANGLE: &str = r#"{"asset":{"version":"2.0"},
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}"#;

fn corners() -> Vec<u8> {
    [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[test]
fn broken_containers_are_told() {
    let good = binary(TRIANGLE, &corners());
    let with = |at: usize, value: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    let json_length = u32::from_le_bytes([good[12], good[13], good[14], good[15]]) as usize;
    let second = 20 + json_length;
    let without_bytes = [&good[..8], &(second as u32).to_le_bytes(), &good[12..second]].concat();
    let deep_json = format!("{{\"asset\":{}1{}}}", "[".repeat(100_000), "]".repeat(100_000));
    let node = |i: usize| format!("{{\"children\":[{}]}},", i + 1);
    let deep_nodes: String = (0..50_000).map(node).collect();
    let deep_nodes =
        TRIANGLE.replacen("\"meshes\"", &format!("\"nodes\":[{deep_nodes}{{\"mesh\":0}}],\"meshes\""), 1);
    let many = vec!["{\"mesh\":0}"; 20_000].join(",");
    let many = TRIANGLE.replacen("\"meshes\"", &format!("\"nodes\":[{many}],\"meshes\""), 1);
    let cases: Vec<(&str, Vec<u8>)> = vec![
        ("good.glb", good.clone()),
        ("header_cut.glb", good[..10].to_vec()),
        ("cut.glb", good[..good.len() - 7].to_vec()),
        ("version_1.glb", with(4, 1)),
        ("version_7.glb", with(4, 7)),
        ("length_short.glb", with(8, 60)),
        ("length_endless.glb", with(8, u32::MAX)),
        ("json_endless.glb", with(12, u32::MAX)),
        ("json_short.glb", with(12, 20)),
        ("json_renamed.glb", with(16, 0x1234_5678)),
        ("bytes_endless.glb", with(second, u32::MAX)),
        ("bytes_renamed.glb", with(second + 4, 0x1234_5678)),
        ("bytes_none.glb", without_bytes),
        ("more_behind.glb", [&good[..], b"more"].concat()),
        ("deep_json.glb", binary(&deep_json, &[])),
        ("deep_nodes.glb", binary(&deep_nodes, &corners())),
        ("many_nodes.glb", binary(&many, &corners())),
        ("no_json.glb", binary("", &corners())),
        ("named_obj.obj", good.clone()),
    ];
    let mut all = String::new();
    for (name, bytes) in cases {
        let files = Memory::default().with(name, bytes);
        all += &said(name, &files, Path::new(""));
    }
    compare(Path::new("tests/assets/glb.txt"), &all);
}

/// Every byte of a small file set to what makes numbers extreme, and every length: an answer or an error.
#[test]
fn broken_bytes_of_meshes_are_refused_or_read() {
    let mut files: Vec<Vec<u8>> = vec![binary(TRIANGLE, &corners())];
    for name in [
        "gltf/sparse.gltf",
        "gltf/skin.gltf",
        "gltf/glass_of_volume.gltf",
        "obj/zero_normals.obj",
        "obj/texture.mtl",
    ] {
        files.push(std::fs::read(Path::new("tests/assets").join(name)).unwrap());
    }
    let nothing = |_: &str| Err("there is no such file".to_owned());
    for bytes in &files {
        for at in 0..bytes.len() {
            for value in [0, b'9', b'-', b'"', b'{', 0xff] {
                let mut broken = bytes.clone();
                broken[at] = value;
                let _ = snell::asset::mesh::read("x.glb", &broken, &nothing, None);
                let _ = snell::asset::gltf::read_scene(&broken, &nothing);
            }
            let _ = snell::asset::mesh::read("x.glb", &bytes[..at], &nothing, None);
        }
    }
}
