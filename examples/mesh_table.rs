//! Reads every mesh file below a folder and prints a Markdown table of what each gave: names and numbers only.
//!
//! ```sh
//! cargo run --release --example mesh_table -- /usr/share/assimp/models
//! ```

use snell::asset::{About, Fate, mesh};
use snell::load;
use snell::source::Disk;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

fn main() {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let mut files = Vec::new();
    collect(Path::new(&folder), &mut files);
    files.sort();
    println!("| file | triangles | parts | materials | pictures | left out, approximated or ignored |");
    println!("|---|--:|--:|--:|--:|---|");
    let mut counts = [0; 4];
    for file in &files {
        let name = file.strip_prefix(&folder).unwrap_or(file).display();
        let row = catch_unwind(AssertUnwindSafe(|| row(file)));
        let (kind, text) = row.unwrap_or((3, "| | | | | **panic** |".to_owned()));
        counts[kind] += 1;
        println!("| `{name}` {text}");
    }
    let [whole, noted, refused, panics] = counts;
    println!(
        "\n{} files: {whole} read whole, {noted} read with a word, {refused} refused with a reason, {panics} panics.",
        files.len()
    );
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
        if path.is_dir() {
            collect(&path, files);
        } else if ending.is_some_and(|ending| ["obj", "gltf", "glb"].iter().any(|known| ending == *known)) {
            files.push(path);
        }
    }
}

/// Which kind of outcome a file has, and the rest of its row.
fn row(file: &Path) -> (usize, String) {
    let disk = Disk::new(file, Vec::new(), false);
    let open = |name: &str| load::open_beside(&disk, file, name).map(|(_, bytes)| bytes);
    let bytes = std::fs::read(file).unwrap_or_default();
    let name = file.display().to_string();
    match mesh::read(&name, &bytes, &open, None) {
        Ok(model) => {
            let matters = model.report.remarks().iter().filter(|remark| remark.matters);
            let said = matters.map(|remark| match (remark.fate, remark.about) {
                (Fate::LeftOut, About::Shape) => format!("without {}", remark.sentence()),
                (fate, _) => format!("{}: {}", fate.word(), remark.sentence()),
            });
            let said = said.collect::<Vec<_>>().join("; ");
            let counts =
                [model.triangle_count(), model.parts.len(), model.materials.len(), model.pictures.len()];
            let counts = counts.map(|count| count.to_string()).join(" | ");
            (usize::from(!said.is_empty()), format!("| {counts} | {} |", said.replace('|', "\\|")))
        }
        Err(error) => (2, format!("| | | | | refused: {} |", error.to_string().replace('|', "\\|"))),
    }
}
