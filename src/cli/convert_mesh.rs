//! `snell convert` of a mesh file: glTF or OBJ to a `.snell` scene with its pictures beside it.

use super::convert::{ConvertArgs, file, is_standard};
use super::{Exit, fail, note, print};
use crate::asset::{Fate, ImportReport};
use crate::convert::{MeshConversion, Places, convert_mesh};
use crate::load;
use crate::output;
use crate::source::Disk;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Converts a mesh file of these bytes.
pub fn run(args: &ConvertArgs, bytes: &[u8], name: &str) -> Exit {
    if let Some(option) = args.arsenal_option() {
        return fail(format_args!("`{option}` is for scenes of the arsenal family, and `{name}` is a mesh"));
    }
    let disk = Disk::new(&args.input, args.asset_dirs.clone(), false);
    let open = |name: &str| load::open_beside(&disk, &args.input, name).map(|(_, bytes)| bytes);
    let (places, elsewhere) = places(args, name);
    let mut conversion = match convert_mesh(bytes, name, &places, &open) {
        Ok(conversion) => conversion,
        Err(error) => {
            note(format_args!("error: `{}` cannot be converted: {error}\n", args.input.display()));
            return Exit::SceneWrong;
        }
    };
    if let Some(folder) = elsewhere {
        let said =
            format!("// Its mesh lies elsewhere: render it with `--asset-dir {}`.\n", folder.display());
        conversion.snell = conversion.snell.replacen("\n\n//", &format!("\n\n{said}//"), 1);
    }
    let differs = conversion.report.remarks().iter().any(|remark| remark.matters);
    let is_broken = conversion.report.remarks().iter().any(|remark| remark.fate == Fate::LeftOut);
    let refused = args.denies_warnings() && differs || args.strict && is_broken;
    tell(args, &conversion.report, differs);
    if let Err(reason) = write_report(args, &conversion) {
        return fail(reason);
    }
    if refused {
        note("nothing is written: what the scene would lack is an error here\n");
        return Exit::SceneWrong;
    }
    match write(args, &conversion) {
        Ok(()) => {
            summarise(args, &conversion);
            Exit::Done
        }
        Err(reason) => fail(reason),
    }
}

/// What the scene calls its files, and the folder to name on the command line where the mesh does not lie below the scene.
fn places(args: &ConvertArgs, name: &str) -> (Places, Option<PathBuf>) {
    let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let output = file(&args.output).map_or_else(|| absolute(Path::new("scene.snell")), absolute);
    let input = absolute(&args.input);
    let folder = output.parent().map(Path::to_path_buf).unwrap_or_default();
    let stem = output.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy().into_owned());
    let below = input.strip_prefix(&folder).ok().map(|path| path.display().to_string().replace('\\', "/"));
    let elsewhere = below.is_none().then(|| args.input.parent().map(Path::to_path_buf)).flatten();
    let pictures = format!("{stem}-pictures");
    (Places { mesh: below.unwrap_or_else(|| name.to_owned()), pictures }, elsewhere)
}

/// Says what became of what the file holds: all of it with `-v`, else what the picture lacks.
fn tell(args: &ConvertArgs, report: &ImportReport, differs: bool) {
    if args.verbose {
        report.lines().iter().for_each(|line| note(format_args!("  {line}\n")));
    } else if differs && !args.messages.quiet {
        for remark in report.remarks().iter().filter(|remark| remark.matters) {
            note(format_args!("  {}: {}\n", remark.fate.word(), remark.sentence()));
        }
    }
}

fn write_report(args: &ConvertArgs, conversion: &MeshConversion) -> Result<(), String> {
    let Some(path) = &args.report else { return Ok(()) };
    let remarks = conversion.report.remarks().iter().map(|remark| {
        json!({ "fate": remark.fate.word(), "text": remark.text, "count": remark.count, "matters": remark.matters })
    });
    let [placements, materials, cameras, lights] = conversion.counts;
    let pictures = conversion.pictures.iter().map(|(name, _)| name);
    let json = json!({
        "output": file(&args.output).map(|path| path.display().to_string()),
        "counts": { "placements": placements, "materials": materials, "cameras": cameras, "lights": lights },
        "pictures": pictures.collect::<Vec<_>>(),
        "remarks": remarks.collect::<Vec<_>>(),
        "untold": conversion.report.untold(),
    });
    let json = format!("{json:#}\n");
    match is_standard(path) {
        true => print(&json),
        false => output::replace(path, json.as_bytes()).map_err(|error| error.to_string())?,
    }
    Ok(())
}

/// Writes the pictures, then the scene, which names them.
fn write(args: &ConvertArgs, conversion: &MeshConversion) -> Result<(), String> {
    let Some(output) = file(&args.output) else {
        if !conversion.pictures.is_empty() {
            return Err("the file holds pictures, which need a place: name the scene with `-o`".to_owned());
        }
        if !args.report.as_deref().is_some_and(is_standard) {
            print(&conversion.snell);
        }
        return Ok(());
    };
    let beside = output.parent().unwrap_or(Path::new(""));
    let paths: Vec<PathBuf> = conversion.pictures.iter().map(|(name, _)| beside.join(name)).collect();
    for (path, (_, bytes)) in paths.iter().zip(&conversion.pictures) {
        let is_other = std::fs::read(path).is_ok_and(|there| there[..] != bytes[..]);
        if is_other && !args.force {
            return Err(format!("`{}` is there already: `--force` replaces it", path.display()));
        }
    }
    for (path, (_, bytes)) in paths.iter().zip(&conversion.pictures) {
        if let Some(folder) = path.parent() {
            let failed = |error| format!("`{}` cannot be made: {error}", folder.display());
            std::fs::create_dir_all(folder).map_err(failed)?;
        }
        output::replace(path, bytes).map_err(|error| error.to_string())?;
    }
    output::replace(output, conversion.snell.as_bytes()).map_err(|error| error.to_string())
}

fn summarise(args: &ConvertArgs, conversion: &MeshConversion) {
    if args.messages.quiet {
        return;
    }
    let to = file(&args.output).map_or("standard output".into(), |path| path.display().to_string());
    let [placements, materials, cameras, lights] = conversion.counts;
    let count = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let said = [
        count(placements, "placement"),
        count(materials, "material"),
        count(cameras, "camera"),
        count(lights, "light"),
        count(conversion.pictures.len(), "picture"),
    ];
    note(format_args!("{} → {to}: {}\n", args.input.display(), said.join(", ")));
}
