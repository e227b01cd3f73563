use super::*;
use crate::asset::polygon::triangulate_face;

fn obj(text: &str) -> Result<Model, MeshError> {
    read(text.as_bytes(), &|_| Err("there is no such file".to_owned()), None)
}

/// What was left out, ignored or approximated.
fn said(model: &Model) -> Vec<String> {
    model.report.remarks().iter().filter(|remark| remark.matters).map(|remark| remark.sentence()).collect()
}

#[test]
fn names_survive_a_missing_mtl_file() {
    let text = "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue #2\nf 3 2 1\n";
    let model = obj(text).unwrap();
    let names: Vec<&str> = model.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["red", "blue #2"]);
    assert_eq!(model.parts.iter().map(|p| p.material).collect::<Vec<_>>(), [Some(0), Some(1)]);
    assert!(said(&model)[0].contains("`gone.mtl`"), "{:?}", said(&model));
}

#[test]
fn one_material_can_be_asked_for() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\nf 1 2 3\n";
    let nothing = |_: &str| Err(String::new());
    assert_eq!(read(text, &nothing, Some("b")).unwrap().triangle_count(), 2);
    let error = read(text, &nothing, Some("c")).unwrap_err();
    assert_eq!(error, MeshError::NoPart { wanted: "c".into(), known: vec!["a".into(), "b".into()] });
}

#[test]
fn an_error_names_its_line() {
    let error = obj("v 0 0 0\nv 1 0 0\n# a comment\nv 0 one 0\nf 1 2 3\n").unwrap_err();
    assert!(matches!(error, MeshError::Line { line: 4, .. }), "{error}");
    let error = obj("v 0 0 0\nv 1 0 \\\n0\nv 0 1 0\nf 1 2 x\n").unwrap_err();
    assert!(matches!(error, MeshError::Line { line: 5, .. }), "{error}");
}

#[test]
fn comments_and_continued_lines_are_read() {
    let model = obj("v 0 0 0 # origin\r\nv 1 0 \\\r\n0\r\nv 0 1 0\rf 1 2 3").unwrap();
    assert_eq!(model.triangle_count(), 1);
    assert!(said(&model).is_empty());
}

#[test]
fn what_cannot_be_rendered_is_left_out_with_its_first_line() {
    assert_eq!(obj("v 0 0 0\n"), Err(MeshError::Empty));
    let text =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 9\nf 4 2 1\nf 1 2\nf -1 -2 -9\n";
    let model = obj(text).unwrap();
    assert_eq!(model.triangle_count(), 1);
    let said = said(&model).join("\n");
    for (what, line) in [("no area", 6), ("2 faces that name vertices", 7), ("not finite", 8), ("fewer", 9)] {
        let found = said.lines().find(|text| text.contains(what)).unwrap_or_else(|| panic!("{what}: {said}"));
        assert!(found.contains(&format!("line {line}")), "{found}");
    }
    assert!(matches!(obj("v 0 0 0\nv 1 0 0\nf 1 2 3\n"), Err(MeshError::NothingLeft(_))));
}

#[test]
fn faces_without_normals_are_flat_beside_smooth_ones() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1 2 3\nf 1//2 2//1 3//1\n";
    let model = obj(text).unwrap();
    let has_normals: Vec<(usize, bool)> =
        model.parts.iter().map(|part| (part.triangles.len(), part.normals.is_some())).collect();
    assert_eq!(has_normals, [(2, false), (1, true)]);
    assert!(said(&model)[0].contains("no directions"));
}

/// The corners of all triangles, as bits, in an order of their own.
fn corners(parts: impl Iterator<Item = [Vec3; 3]>) -> Vec<[u32; 9]> {
    let mut all: Vec<[u32; 9]> = parts
        .map(|t| {
            let mut bits = t.into_iter().flat_map(|p| p.to_array().map(f32::to_bits));
            std::array::from_fn(|_| bits.next().expect("a triangle has nine coordinates"))
        })
        .collect();
    all.sort_unstable();
    all
}

/// `tobj`, a reader that others wrote, finds the same triangles in every mesh of this project.
#[test]
fn another_reader_finds_the_same_triangles() {
    let files = ["scenes/assets/boots.obj", "scenes/assets/football.obj", "scenes/bench/goblet.obj"];
    for file in files {
        let bytes = std::fs::read(file).expect("the mesh is there");
        let model = read(&bytes, &|_| Err(String::new()), None).unwrap();
        let ours = model
            .parts
            .iter()
            .flat_map(|part| part.triangles.iter().map(|t| t.map(|i| part.positions[i as usize])));
        let no_materials = |_: &std::path::Path| Ok(Default::default());
        let options = tobj::LoadOptions { single_index: true, ..Default::default() };
        let (others, _) = tobj::load_obj_buf(&mut &bytes[..], &options, no_materials).unwrap();
        let mut theirs = Vec::new();
        for mesh in others.iter().map(|other| &other.mesh) {
            let mut rest = &mesh.indices[..];
            let threes = vec![3; mesh.indices.len() / 3];
            let arities = if mesh.face_arities.is_empty() { &threes } else { &mesh.face_arities };
            for &arity in arities {
                let (face, after) = rest.split_at(arity as usize);
                rest = after;
                let points: Vec<Vec3> =
                    face.iter().map(|&i| Vec3::from_slice(&mesh.positions[3 * i as usize..][..3])).collect();
                theirs.extend(triangulate_face(&points).iter().map(|t| t.map(|i| points[i as usize])));
            }
        }
        theirs.retain(|t| !crate::asset::model::is_degenerate(*t));
        assert_eq!(corners(ours), corners(theirs.into_iter()), "{file}");
    }
}
