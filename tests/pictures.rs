//! What picture files hold beside colour, and pictures shown anew.

use exr::prelude::{FlatImage, read_all_flat_layers_from_file};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A ball 4 m away before nothing: `MATERIAL` is put in.
const BALL: &str = "snell 1
camera {
    position: (0m, 0m, 4m), look_at: (0m, 0m, 0m),
    film: { size: 33 x 33, tone: agx, exposure: 1EV },
}
light point { position: (0m, 3m, 4m), power: 300W }
sphere { radius: 1m, material: MATERIAL }
";

struct Folder(tempfile::TempDir);

impl Folder {
    fn with(material: &str) -> Self {
        let folder = tempfile::tempdir().expect("there is room");
        std::fs::write(folder.path().join("ball.snell"), BALL.replace("MATERIAL", material))
            .expect("there is room");
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn snell(&self, args: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_snell"));
        command.current_dir(self.0.path()).args(args).output().expect("the command runs")
    }

    fn render(&self, more: &[&str]) {
        let args = [&["render", "ball.snell", "--passes", "4", "-q"], more].concat();
        let output = self.snell(&args);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

fn open(path: &Path) -> FlatImage {
    read_all_flat_layers_from_file(path).expect("an EXR")
}

fn names(image: &FlatImage) -> Vec<String> {
    image.layer_data[0].channel_data.list.iter().map(|channel| channel.name.to_string()).collect()
}

fn channel(image: &FlatImage, name: &str) -> Vec<f32> {
    let list = &image.layer_data[0].channel_data.list;
    let found = list.iter().find(|channel| channel.name.to_string() == name);
    found.unwrap_or_else(|| panic!("no channel {name}")).sample_data.values_as_f32().collect()
}

const MIDDLE: usize = 16 * 33 + 16;
const CORNER: usize = 0;

#[test]
fn layers_say_what_the_camera_sees_first() {
    // A matt colour, a mirror's, and glass: of a white thing that takes nothing away, all light goes on.
    let cases = [
        ("diffuse { color: rgb(0.2, 0.5, 0.8) }", [0.2, 0.5, 0.8]),
        ("mirror { color: rgb(0.9, 0.6, 0.3) }", [0.9, 0.6, 0.3]),
        ("glass { ior: 1.5 }", [1.0; 3]),
    ];
    for (material, albedo) in cases {
        let folder = Folder::with(material);
        folder.render(&["-o", "ball.exr"]);
        let image = open(&folder.path("ball.exr"));
        for (name, value) in ["albedo.R", "albedo.G", "albedo.B"].into_iter().zip(albedo) {
            let plane = channel(&image, name);
            assert!((plane[MIDDLE] - value).abs() < 1e-5, "{material}: {name} is {}", plane[MIDDLE]);
            assert_eq!(plane[CORNER], 0.0, "{material}");
        }
        // The pixel covers 6 mm of the sphere: the normal's z is 1 - 2·10⁻⁵ at its edge, the depth 3 m + 2·10⁻⁵ m.
        assert!((channel(&image, "normal.Z")[MIDDLE] - 1.0).abs() < 1e-3, "{material}");
        assert!((channel(&image, "depth.Z")[MIDDLE] - 3.0).abs() < 1e-3, "{material}");
        assert_eq!(channel(&image, "depth.Z")[CORNER], f32::INFINITY, "{material}");
        // To the right of the middle the sphere looks to the right.
        assert!(channel(&image, "normal.X")[MIDDLE + 5] > 0.2, "{material}");
    }
}

#[test]
fn the_layers_are_those_asked_for_and_change_no_colour() {
    let folder = Folder::with("diffuse { color: white }");
    folder.render(&["-o", "plain.exr", "--layers", "none"]);
    folder.render(&["-o", "all.exr", "--layers", "all"]);
    folder.render(&["-o", "some.exr", "--layers", "depth,time"]);
    let [plain, all, some] = ["plain.exr", "all.exr", "some.exr"].map(|name| open(&folder.path(name)));
    let colors = [
        "B",
        "G",
        "R",
        "error.B",
        "error.G",
        "error.R",
        "samples",
        "tile_error.B",
        "tile_error.G",
        "tile_error.R",
    ];
    assert_eq!(names(&plain), colors);
    assert!(
        ["albedo.R", "normal.Z", "depth.Z", "margin.G", "time.s"]
            .iter()
            .all(|name| names(&all).iter().any(|n| n == name))
    );
    assert_eq!(names(&some).len(), colors.len() + 2);
    for name in colors {
        assert_eq!(channel(&plain, name), channel(&all, name), "{name}");
    }
    assert!(channel(&all, "time.s").iter().all(|&seconds| seconds > 0.0));

    let output = folder.snell(&["render", "ball.snell", "-o", "ball.png", "--layers", "depth"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("add `-o NAME.exr`"));
}

#[test]
fn tone_shows_a_picture_as_its_scene_did_or_as_one_asks() {
    let folder = Folder::with("diffuse { color: rgb(0.2, 0.5, 0.8) }");
    folder.render(&["-o", "ball.exr", "-o", "ball.ppm"]);
    let bytes = |name: &str| std::fs::read(folder.path(name)).expect("it was written");
    let tone = |args: &[&str]| {
        let output = folder.snell(&[&["tone", "ball.exr"], args].concat());
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, said) = tone(&["-o", "again.ppm"]);
    assert_eq!((code, said.as_str()), (Some(0), "again.ppm, exposure 1EV, agx\n"));
    assert_eq!(bytes("again.ppm"), bytes("ball.ppm"));
    assert_eq!(tone(&["-o", "bright.ppm", "--exposure", "3", "-q"]), (Some(0), String::new()));
    assert!(bytes("bright.ppm") > bytes("ball.ppm"));

    // By default beside the picture; what is wrong is told, and nothing is written.
    assert_eq!(tone(&[]).0, Some(0));
    assert!(folder.path("ball.png").exists());
    let wrong: [(&[&str], &str); 4] = [
        (&["-o", "x.exr"], "written as .png or .ppm"),
        (&["-o", "x.png", "--tone", "agxx"], "did you mean `agx`?"),
        (&["-o", "x.png", "--exposure", "bright"], "write `auto`, or stops"),
        (&["-o", "no/x.png"], "there is no folder"),
    ];
    for (args, expected) in wrong {
        let (code, said) = tone(args);
        assert!(code == Some(2) && said.contains(expected), "{args:?}: {said}");
    }
    assert!(!folder.path("x.png").exists());
    let output = folder.snell(&["tone", "ball.png", "-o", "x.png"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("display values"));
}
