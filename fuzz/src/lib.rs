//! What must hold of every text that anyone feeds to the program. The fuzzer looks for texts that break it; the tests hold
//! it over the texts that were found.

use snell::convert::{Options, convert as convert_text};
use snell::diag::{Problem, Problems, Severity, Style};
use snell::format::format;
use snell::source::{FileId, Memory, SourceMap};
use snell::syntax::{self, ast::Program};
use snell::{load, lower, plan};

/// Texts longer than this only repeat what shorter ones show.
const LONGEST: usize = 1 << 16;

/// Scenes with more objects are not made ready for rays: there are enough smaller ones.
const MOST_OBJECTS: usize = 16;

/// Any text ends in a tree and a report that can be shown.
pub fn parse(text: &str) {
    let Some((mut sources, main)) = source(text) else { return };
    let mut problems = Problems::default();
    syntax::parse(&mut sources, &files(), main, &mut problems);
    show(problems, &sources);
}

/// Any text ends in a world ready for rays or in a report, files and all.
pub fn compile(text: &str) {
    let Some((mut sources, main)) = source(text) else { return };
    let (files, mut problems) = (files(), Problems::default());
    let checked = snell::compile(&mut sources, &files, main, &[], &mut problems);
    assert!(checked.is_some() || problems.has_errors(), "nothing came out, and nothing is said to be wrong");
    if let Some(checked) = checked {
        let loaded = load::load(&checked, &sources, &files, &mut problems);
        if let Some(loaded) = loaded.filter(|_| !problems.has_errors()) {
            let camera = checked.cameras.first();
            let plan = plan::plan(&loaded, camera, None);
            plan::warn(&plan, &loaded, &mut problems);
            if let Some(camera) = camera.filter(|_| checked.objects.len() <= MOST_OBJECTS) {
                lower::lower(&loaded, &plan, camera, &files, &mut problems);
            }
        }
    }
    show(problems, &sources);
}

/// Formatting changes no tree and loses nothing, and done twice is done once.
pub fn fmt(text: &str) {
    let (Some(once), tree) = canonical_and_tree(text) else { return };
    let (twice, tree_of_canonical) = canonical_and_tree(&once);
    assert_eq!(twice.as_deref(), Some(once.as_str()), "formatted twice");
    assert_eq!(tree, tree_of_canonical, "formatted as {once:?}");
    assert_eq!(letters(text), letters(&once), "something was lost");
}

/// Any text of the arsenal family ends in a scene whose words all make sense, or in a report.
pub fn convert(text: &str) {
    if text.len() > LONGEST {
        return;
    }
    let conversion = convert_text(text, "fuzz.txt", &Options::default(), None);
    assert!(
        !conversion.scenes.is_empty() || conversion.has_errors(),
        "nothing came out, and nothing is wrong"
    );
    conversion.scenes.iter().for_each(|scene| makes_sense(&scene.snell));
}

/// Panics if the words of a scene that was written by a program make no sense. What it says may still be bad physics.
fn makes_sense(scene: &str) {
    let (mut sources, main) = source(scene).unwrap_or_else(|| panic!("the scene is far too long"));
    let mut problems = Problems::default();
    snell::compile(&mut sources, &Memory::default(), main, &[], &mut problems);
    let is_of_words = |problem: &&Problem| {
        let code = problem.code();
        problem.severity() == Severity::Error && !code.starts_with("snell::check::")
    };
    let nonsense: Vec<String> =
        problems.list().iter().filter(is_of_words).map(|p| p.error.to_string()).collect();
    assert!(nonsense.is_empty(), "{nonsense:?}\n{scene}");
}

/// What scenes may include, import or load.
fn files() -> Memory {
    Memory::default()
        .with("room.snell", "snell 1\nplane { y: 0m }\n")
        .with("lib.snell", include_str!("../../scenes/lib/materials.snell"))
        .with("broken.snell", "snell 1\nlet b = 3 *\n")
        .with("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
        .with("a.mtl", "newmtl a\nKd 1 0.5 0\n")
        .with("a.ppm", "P3\n2 1\n255\n255 0 0  0 0 255\n")
}

fn source(text: &str) -> Option<(SourceMap, FileId)> {
    let mut sources = SourceMap::default();
    let main = sources.add("main.snell".to_owned(), "main.snell".into(), text.into())?;
    (text.len() <= LONGEST).then_some((sources, main))
}

/// Shows a report in every form; panics if a label leaves its file or splits a character.
fn show(problems: Problems, sources: &SourceMap) {
    for label in problems.list().iter().flat_map(|problem| problem.error.labels().into_iter().flatten()) {
        let (start, end) = (label.offset(), label.offset() + label.len());
        let file = sources.find(start as u32).map(|id| sources.file(id));
        let file = file.unwrap_or_else(|| panic!("{label:?} lies in no file"));
        let base = file.span().start as usize;
        assert!(
            file.text.get(start - base..end - base).is_some(),
            "{label:?} leaves its file or splits a character"
        );
    }
    let report = problems.into_report(sources);
    assert!(!report.render_human(&Style::default()).contains("Failed to read"), "a report cannot be drawn");
    report.render_short();
    report.render_json();
}

/// The canonical form of a text without mistakes, and the tree of a text.
fn canonical_and_tree(text: &str) -> (Option<String>, String) {
    let Some((sources, id)) = source(text) else { return (None, String::new()) };
    let file = syntax::parse_file(&sources, id, &mut Problems::default());
    let canonical = format(&sources, id, &mut Problems::default());
    (canonical, syntax::dump::dump(&Program { files: vec![file], lacks_files: false }))
}

fn letters(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace() && *c != '\u{FEFF}').collect()
}

/// Any bytes end in a mesh whose indices are inside, or in an error.
pub fn mesh(bytes: &[u8]) {
    if bytes.len() > LONGEST {
        return;
    }
    let nothing = |_: &str| Err("there is no such file".to_owned());
    let Ok(model) = snell::asset::mesh::read("fuzz.glb", bytes, &nothing, None) else { return };
    assert!(model.triangle_count() > 0, "a mesh without triangles was read");
    for part in &model.parts {
        let count = part.positions.len();
        assert!(part.triangles.iter().flatten().all(|&i| (i as usize) < count), "an index is outside");
        assert!(part.positions.iter().all(|p| p.is_finite()), "a vertex is not finite");
        assert!(part.normals.as_ref().is_none_or(|all| all.len() == count), "normals are missing");
        assert!(part.uvs.as_ref().is_none_or(|all| all.len() == count), "texture points are missing");
        assert!(
            part.material.is_none_or(|material| material < model.materials.len()),
            "a material is missing"
        );
    }
    let pictures = model.materials.iter().flat_map(|material| material.look.pictures());
    assert!(pictures.into_iter().all(|picture| picture < model.pictures.len()), "a picture is missing");
    let _ = snell::asset::gltf::read_scene(bytes, &nothing);
}
