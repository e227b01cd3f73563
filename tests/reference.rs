//! The reference of the language is up to date, and every example in it compiles.

use snell::diag::{Problems, Style};
use snell::reference;
use snell::schema::{self, Need};
use snell::source::{Memory, SourceMap};
use std::fs;
use std::io::Cursor;
use std::path::PathBuf;

#[test]
fn the_page_in_docs_is_what_the_registry_says() {
    let path = "docs/reference.md";
    let made = reference::markdown();
    if std::env::var_os("UPDATE").is_some() {
        fs::write(path, &made).expect("the page can be written");
    }
    let written = fs::read_to_string(path).unwrap_or_default();
    assert!(written == made, "`snell doc --markdown > {path}` brings the page up to date");
}

#[test]
fn every_block_example_compiles() {
    let faults: Vec<String> = schema::blocks().filter_map(|block| fault(&reference::scene(block))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_field_example_compiles() {
    let fields = schema::blocks().flat_map(|block| block.fields().map(move |field| (block, field)));
    let faults: Vec<String> =
        fields.filter_map(|(block, field)| fault(&reference::field_scene(block, field))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_default_compiles() {
    let fields = schema::blocks().flat_map(|block| block.fields().map(move |field| (block, field)));
    let with_default = fields.filter(|(_, field)| matches!(field.need, Need::Default(_)));
    let faults: Vec<String> = with_default
        .filter_map(|(block, field)| {
            let scene = reference::field_scene(block, field);
            let written = format!("{}: {}", field.name, field.example());
            let default = format!("{}: {}", field.name, field.default_text()?);
            assert!(scene.contains(&written), "{scene}");
            fault(&scene.replace(&written, &default))
        })
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_other_example_compiles() {
    let functions = schema::functions().map(|function| (schema::Place::Value, function.example));
    let forms = schema::FORMS.iter().map(|form| (form.place, form.example));
    let types = schema::Type::NAMED.iter().map(|ty| (schema::Place::Value, ty.ty.example()));
    let faults: Vec<String> = functions
        .chain(forms)
        .chain(types)
        .filter_map(|(place, example)| fault(&reference::form_scene(place, example)))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_broken_example_would_be_found() {
    assert!(fault("snell 1\nsphere { radius: 30deg }").is_some());
}

/// What the compiler has against a scene.
fn fault(scene: &str) -> Option<String> {
    let files = Memory::default()
        .with("wood.png", picture(image::ImageFormat::Png))
        .with("sky.hdr", picture(image::ImageFormat::Hdr))
        .with("teapot.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lid\nf 1 2 3\n")
        .with("achromat.dat", "stop 2 1 10\n100 4 1.5 30\n-100 97 1 30\n")
        .with("room.snell", "snell 1\nplane { y: 0m }\n")
        .with("materials.snell", "snell 1\nlet gold = metal { kind: gold }\n");
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add("example.snell".into(), PathBuf::from("example.snell"), scene.into()).unwrap();
    if let Some(checked) = snell::compile(&mut sources, &files, main, &[], &mut problems) {
        let _ = snell::load::load(&checked, &sources, &files, &mut problems);
    }
    let is_wrong = problems.has_errors();
    let report = problems.into_report(&sources).render_human(&Style::default());
    is_wrong.then(|| format!("{scene}\n{report}"))
}

/// A picture of one pixel.
fn picture(format: image::ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let pixel = image::DynamicImage::ImageRgb32F(image::Rgb32FImage::new(1, 1));
    let pixel = if format == image::ImageFormat::Png { pixel.to_rgb8().into() } else { pixel };
    pixel.write_to(&mut bytes, format).expect("a pixel can be written");
    bytes.into_inner()
}
