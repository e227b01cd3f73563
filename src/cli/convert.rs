//! `snell convert`: from an arsenal.txt scene, or a mesh file, to a `.snell` scene.

use super::args::{Deny, MessageArgs};
use super::messages::Messages;
use super::{Exit, fail, note, print};
use super::{convert_mesh, session};
use crate::convert::{
    Angle, Basis, Conversion, Dialect, DiskFinder, Falloff, Lights, Options, PlaneSign, Planes, Rendition,
    report,
};
use crate::output;
use crate::source::SourceMap;
use clap::{Args, ValueEnum};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Arguments of `snell convert`.
#[derive(Args, Debug)]
pub struct ConvertArgs {
    /// The scene of the arsenal family or the mesh (.glb, .gltf, .obj) to convert; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
    /// Write the scene here instead of to standard output, `-`; further scenes of the file get a number
    #[arg(short, long, value_name = "OUT.snell")]
    pub(super) output: Option<PathBuf>,
    /// Of a file that holds several scenes, only this one, counted from 1
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    scene: Option<u32>,
    /// The dialect, instead of the one that the file seems to be in
    #[arg(long, value_name = "DIALECT", value_parser = dialect)]
    dialect: Option<Dialect>,
    /// Treat everything that is wrong or not understood as an error
    #[arg(long)]
    pub(super) strict: bool,
    /// Replace pictures that are there, of a mesh that holds its pictures itself
    #[arg(long)]
    pub(super) force: bool,
    /// Treat warnings as errors
    #[arg(long, value_name = "WHAT")]
    deny: Option<Deny>,
    /// What the picture is to look like: what it shows, or the original's pictures
    #[arg(long, value_name = "HOW", default_value = "physical")]
    look: LookArg,
    /// How the camera's basis is made where `up` leans
    #[arg(long, value_name = "HOW")]
    basis: Option<BasisArg>,
    /// What `angle` spans in a picture that is not square
    #[arg(long, value_name = "WHAT")]
    angle: Option<AngleArg>,
    /// What to do with the `Lights` block
    #[arg(long, value_name = "WHAT", default_value = "auto")]
    lights: LightsArg,
    /// How point lights fall off with distance
    #[arg(long, value_name = "LAW", default_value = "auto")]
    falloff: FalloffArg,
    /// Whether planes are seen from behind
    #[arg(long, value_name = "SIDES", default_value = "auto")]
    planes: PlanesArg,
    /// On which side of the origin the `offset` of a plane is
    #[arg(long, value_name = "SIGN", default_value = "auto")]
    plane_sign: PlaneSignArg,
    /// Look for meshes and pictures here too; may be repeated
    #[arg(long = "asset-dir", value_name = "DIR")]
    pub(super) asset_dirs: Vec<PathBuf>,
    /// Write what became of each word as JSON; `-` is standard output
    #[arg(long, value_name = "FILE.json")]
    pub(super) report: Option<PathBuf>,
    /// Say what became of each word, or of everything in the mesh
    #[arg(short, long)]
    pub(super) verbose: bool,
    #[command(flatten)]
    pub(super) messages: MessageArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum LookArg {
    /// Light is simulated.
    Physical,
    /// Phong's terms are added up where the original does so, by `method: classic`.
    Original,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum BasisArg {
    /// As it comes out of the cross product (the course's framework of 2020).
    Raw,
    /// Normalised (from 2021 on).
    Orthonormal,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum AngleArg {
    /// Its height.
    Vertical,
    /// Its width.
    Horizontal,
    /// Both, with pixels that are not square.
    Both,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum LightsArg {
    /// Keep it where programs of the dialect use it.
    Auto,
    /// Keep it.
    Keep,
    /// Leave it out.
    Drop,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum FalloffArg {
    /// As in the dialect.
    Auto,
    /// Not at all (the course).
    Constant,
    /// 1 / (1 + k d²) (MIT, 2010 to 2015).
    OnePlus,
    /// 1 / (k d²) (MIT, 2016 and later).
    InverseSquare,
    /// 1 / (a + b d + e d²) (MIT, 2004).
    Polynomial,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PlanesArg {
    /// As in the dialect.
    Auto,
    /// Those that the camera is behind are left out.
    OneSided,
    /// From both sides.
    TwoSided,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PlaneSignArg {
    /// As in the dialect.
    Auto,
    /// normal · p = offset.
    Same,
    /// normal · p + offset = 0.
    Opposite,
}

impl ConvertArgs {
    /// An option that only the arsenal family knows.
    pub(super) fn arsenal_option(&self) -> Option<&'static str> {
        let options = [
            ("--scene", self.scene.is_some()),
            ("--dialect", self.dialect.is_some()),
            ("--basis", self.basis.is_some()),
            ("--angle", self.angle.is_some()),
        ];
        options.into_iter().find(|(_, is_given)| *is_given).map(|(name, _)| name)
    }

    /// Whether warnings are errors.
    pub(super) fn denies_warnings(&self) -> bool {
        self.deny.is_some()
    }
}

/// Converts a scene.
pub fn run(args: &ConvertArgs) -> Exit {
    if let Some(conflict) = conflict(args) {
        return fail(conflict);
    }
    let name = args.input.file_name().map_or("scene".into(), |name| name.to_string_lossy().into_owned());
    let bytes = match session::read_bytes(&args.input) {
        Ok(bytes) => bytes,
        Err(reason) => return fail(reason),
    };
    if crate::convert::is_mesh(&name, &bytes) {
        return convert_mesh::run(args, &bytes, &name);
    }
    let text = decoded(&bytes);
    if text.contains('\0') {
        return fail(format_args!("`{}` is no text: nothing in it can be converted", args.input.display()));
    }
    if is_snell(&text) {
        let shown = args.input.display();
        return fail(format_args!(
            "`{shown}` is a Snell scene already; `snell fmt` brings one into canonical form"
        ));
    }
    let mut sources = SourceMap::default();
    if sources.add(args.input.display().to_string(), args.input.clone(), text.as_str().into()).is_none() {
        return fail("the scene is too large");
    }
    let mut finder = DiskFinder::new(&args.input, args.asset_dirs.clone());
    if let Some(output) = file(&args.output) {
        finder = finder.written_to(output);
    }
    let mut conversion = crate::convert::convert(&text, &name, &options(args), Some(&finder));
    let found = conversion.scenes.len();
    if let Some(wanted) = args.scene {
        let wanted = wanted as usize;
        if found > 0 && wanted > found {
            return fail(format_args!("there is no scene {wanted}: the file holds {found}"));
        }
        conversion.scenes = conversion.scenes.into_iter().skip(wanted - 1).take(1).collect();
    }
    if args.deny.is_some() && !conversion.problems.is_empty() {
        conversion.scenes.clear(); // as after an error, nothing is written
    }
    let written = write(args, &text, &conversion);

    let mut problems = crate::diag::Problems::default();
    for problem in conversion.problems {
        problems.push(problem);
    }
    let mut messages = Messages::new(&args.messages, false);
    messages.show(problems.into_report(&sources), args.deny);
    messages.finish();
    match (written, conversion.scenes.first()) {
        (Err(reason), _) => fail(reason),
        (Ok(()), None) => Exit::SceneWrong,
        (Ok(()), Some(first)) => {
            let is_report_printed = args.report.as_deref().is_some_and(is_standard);
            if file(&args.output).is_none() && !is_report_printed {
                print(&first.snell);
                if conversion.scenes.len() > 1 {
                    note(
                        "only the first scene was printed: `-o` writes all of them, `--scene N` picks one\n",
                    );
                }
            }
            Exit::Done
        }
    }
}

/// Whether a text says that it is a scene of this language: `snell 1` after any comments.
fn is_snell(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
    let mut words = lines.next().unwrap_or_default().split_whitespace();
    words.next() == Some("snell") && words.next().is_some_and(|word| word.parse::<u32>().is_ok())
}

/// Whether a path stands for standard input or output.
pub(super) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// The file to write to, unless that is standard output.
pub(super) fn file(path: &Option<PathBuf>) -> Option<&Path> {
    path.as_deref().filter(|path| !is_standard(path))
}

/// Why the files named cannot be written beside each other.
fn conflict(args: &ConvertArgs) -> Option<String> {
    let is_input = |path: &Path| {
        let same = |path: &Path| path.canonicalize().ok();
        same(path).is_some_and(|path| Some(path) == same(&args.input))
    };
    let (output, report) = (file(&args.output), file(&args.report));
    if output.is_some_and(is_input) || report.is_some_and(is_input) {
        return Some(format!(
            "`{}` would be overwritten: name another file to write to",
            args.input.display()
        ));
    }
    let is_one = output.is_some() && output == report;
    is_one.then(|| "the scene and the report cannot go to one file".into())
}

/// The text of a file in whatever encoding: UTF-16 with its mark, else UTF-8; other bytes become signs of their own, for
/// they stand in remarks only.
fn decoded(bytes: &[u8]) -> String {
    let units = |from: fn([u8; 2]) -> u16| -> String {
        let units = bytes[2..].chunks_exact(2).map(|pair| from([pair[0], pair[1]]));
        char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xff, 0xfe, ..] => units(u16::from_le_bytes),
        [0xfe, 0xff, ..] => units(u16::from_be_bytes),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    }
}

fn options(args: &ConvertArgs) -> Options {
    Options {
        dialect: args.dialect,
        strict: args.strict,
        basis: args.basis.map(|basis| match basis {
            BasisArg::Raw => Basis::Raw,
            BasisArg::Orthonormal => Basis::Orthonormal,
        }),
        angle: args.angle.map(|angle| match angle {
            AngleArg::Vertical => Angle::Vertical,
            AngleArg::Horizontal => Angle::Horizontal,
            AngleArg::Both => Angle::Both,
        }),
        rendition: match args.look {
            LookArg::Physical => Rendition::Physical,
            LookArg::Original => Rendition::Original,
        },
        lights: match args.lights {
            LightsArg::Auto => Lights::Auto,
            LightsArg::Keep => Lights::Keep,
            LightsArg::Drop => Lights::Drop,
        },
        falloff: match args.falloff {
            FalloffArg::Auto => Falloff::Auto,
            FalloffArg::Constant => Falloff::Constant,
            FalloffArg::OnePlus => Falloff::OnePlus,
            FalloffArg::InverseSquare => Falloff::InverseSquare,
            FalloffArg::Polynomial => Falloff::Polynomial,
        },
        planes: match args.planes {
            PlanesArg::Auto => Planes::Auto,
            PlanesArg::OneSided => Planes::OneSided,
            PlanesArg::TwoSided => Planes::TwoSided,
        },
        plane_sign: match args.plane_sign {
            PlaneSignArg::Auto => PlaneSign::Auto,
            PlaneSignArg::Same => PlaneSign::Same,
            PlaneSignArg::Opposite => PlaneSign::Opposite,
        },
    }
}

/// Writes the files that were asked for, and says what was done.
fn write(args: &ConvertArgs, text: &str, conversion: &Conversion) -> Result<(), String> {
    for (index, scene) in conversion.scenes.iter().enumerate() {
        if let Some(path) = file(&args.output) {
            output::replace(&numbered(path, index), scene.snell.as_bytes())
                .map_err(|error| error.to_string())?;
        }
    }
    if let Some(path) = &args.report {
        let json = format!("{:#}\n", as_json(args, text, conversion));
        match is_standard(path) {
            true => print(&json),
            false => output::replace(path, json.as_bytes()).map_err(|error| error.to_string())?,
        }
    }
    if args.verbose {
        note(report::render(text, &conversion.report));
    } else if !args.messages.quiet {
        for (index, scene) in conversion.scenes.iter().enumerate() {
            let path = file(&args.output).map(|path| numbered(path, index));
            let to = path.map_or("standard output".into(), |path| path.display().to_string());
            let detection = &scene.detection;
            note(format_args!(
                "{} → {to}: dialect {}, because {}\n",
                args.input.display(),
                detection.dialect.id(),
                detection.reason
            ));
        }
        if !conversion.scenes.is_empty() {
            note(format_args!("  {}\n", report::summary(&conversion.report)));
        }
    }
    Ok(())
}

/// `out.snell`, then `out-2.snell`, `out-3.snell`, ..
fn numbered(path: &Path, index: usize) -> PathBuf {
    if index == 0 {
        return path.to_path_buf();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().map_or(String::new(), |ending| format!(".{}", ending.to_string_lossy()));
    path.with_file_name(format!("{stem}-{}{ending}", index + 1))
}

/// The fate of every token, in the order of the file.
fn as_json(args: &ConvertArgs, text: &str, conversion: &Conversion) -> serde_json::Value {
    let fates = report::complete(text, &conversion.report);
    let mut counts = [("mapped", 0), ("approximated", 0), ("ignored", 0), ("dropped", 0)];
    let (mut line, mut seen, mut total) = (1, 0, 0);
    let mut tokens = Vec::new();
    for fate in &fates {
        line += text[seen..fate.span.start].bytes().filter(|&byte| byte == b'\n').count();
        seen = fate.span.start;
        let stretch = &text[fate.span.clone()];
        let (outcome, detail) = fate.outcome.parts();
        let count = report::tokens(stretch).count();
        total += count;
        for (name, sum) in &mut counts {
            *sum += if *name == outcome { count } else { 0 };
        }
        tokens.push(json!({ "line": line, "start": fate.span.start, "end": fate.span.end, "text": stretch,
                            "count": count, "fate": outcome, "detail": detail }));
    }
    let scenes = conversion.scenes.iter().enumerate().map(|(index, scene)| {
        let output = file(&args.output).map(|path| numbered(path, index).display().to_string());
        json!({ "output": output, "dialect": scene.detection.dialect.id(), "reason": scene.detection.reason })
    });
    let problems = conversion.problems.iter().map(|problem| {
        use miette::Diagnostic;
        let at = problem.labels().and_then(|mut labels| labels.next()).map(|label| label.offset());
        json!({ "code": problem.code().map(|code| code.to_string()), "message": problem.to_string(),
                "error": problem.is_error(), "start": at })
    });
    json!({
        "scenes": scenes.collect::<Vec<_>>(),
        "token_count": report::tokens(text).count(),
        "accounted": total,
        "counts": counts.into_iter().map(|(name, sum)| (name.to_string(), json!(sum)))
            .collect::<serde_json::Map<_, _>>(),
        "problems": problems.collect::<Vec<_>>(),
        "tokens": tokens,
    })
}

fn dialect(text: &str) -> Result<Dialect, String> {
    let known = Dialect::ALL.iter().find(|dialect| dialect.id().eq_ignore_ascii_case(text));
    known.copied().ok_or_else(|| {
        let names: Vec<&str> = Dialect::ALL.iter().map(|dialect| dialect.id()).collect();
        format!("the dialects are {}", names.join(", "))
    })
}
