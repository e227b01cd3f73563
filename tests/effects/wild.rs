//! Random scenes that call for random effects. All of them can be rendered.

use crate::support::Random;
use snell::source::Memory;
use std::fmt::Write;

/// The files that the scenes name.
pub fn files() -> Memory {
    let row = |a: u8, b: u8| [a, b, 128, b, a, 200, 90, 20, b, 255, 255, 255];
    let picture = |a, b| [b"P6 2 2 255 ".as_slice(), &row(a, b)].concat();
    let mesh = "v -1 0 0\nv 1 0 0\nv 0 1 0.5\nv 0 -1 0.5\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0.3 0 1\nvn -0.3 0 1\nvn 0 0.2 1\n\
                f 1/1/1 2/2/2 3/3/3\nf 2/1/1 1/2/2 4/3/3\n";
    Memory::default().with("a.ppm", picture(10, 240)).with("b.ppm", picture(200, 60)).with("mesh.obj", mesh)
}

/// The scene of this number.
pub fn scene(number: u64) -> String {
    let mut wild = Wild { random: Random(number << 20) };
    let mut text = format!("snell 1\n{}", wild.camera());
    for _ in 0..1 + wild.random.below(3) {
        let light = wild.light();
        let _ = writeln!(text, "{light}");
    }
    if wild.chance(3) {
        let sky = wild.color();
        let _ = writeln!(text, "environment {{ radiance: {sky} }}");
    }
    if wild.chance(2) {
        let material = wild.made_of_others(); // what is endless may not shine
        let _ = writeln!(text, "plane {{ y: -1.3m, material: {material} }}");
    }
    for _ in 0..1 + wild.random.below(5) {
        let object = wild.object();
        let _ = writeln!(text, "{object}");
    }
    text
}

struct Wild {
    random: Random,
}

impl Wild {
    /// True once in so many times.
    fn chance(&mut self, of: usize) -> bool {
        self.random.below(of) == 0
    }

    fn within(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.random.unit()
    }

    fn one(&mut self, of: &[&str]) -> String {
        of[self.random.below(of.len())].to_owned()
    }

    fn point(&mut self) -> String {
        let p = self.random.point() * 1.2;
        format!("({:.3}m, {:.3}m, {:.3}m)", p.x, p.y, p.z)
    }

    fn color(&mut self) -> String {
        let c = [(); 3].map(|()| self.within(0.05, 0.8));
        format!("rgb({:.2}, {:.2}, {:.2})", c[0], c[1], c[2])
    }

    fn camera(&mut self) -> String {
        let lens = match self.random.below(5) {
            0 => ", lens: thin { radius: 8cm, focus: 4m, focal_length: 50mm }".to_owned(),
            1 => ", lens: orthographic { height: 4m }".to_owned(),
            _ => ", fov: 45deg".to_owned(),
        };
        let filter = self.one(&["box(0.5px)", "tent(1px)", "gaussian(1.5px)"]);
        format!(
            "camera {{ position: (0.2m, 0.5m, 5m), look_at: (0m, 0m, 0m){lens}, film: {{ size: 64 x 48, filter: {filter} }} }}\n"
        )
    }

    fn light(&mut self) -> String {
        let (p, power) = (self.point(), self.within(5.0, 100.0));
        let (x, z) = (self.within(-1.0, 1.0), self.within(-1.0, 1.0));
        match self.random.below(7) {
            0 => format!("light point {{ position: {p}, power: {power:.0}W }}"),
            1 => format!(
                "light sphere {{ center: ({x:.2}m, 2.5m, {z:.2}m), radius: 15cm, power: {power:.0}W }}"
            ),
            2 => format!(
                "light rect {{ origin: ({x:.2}m, 2m, {z:.2}m), edge_u: (40cm, 0m, 0m), edge_v: (0m, 0m, 40cm), power: {power:.0}W }}"
            ),
            3 => format!(
                "light disk {{ center: ({x:.2}m, 2m, 0m), normal: (0, -1, 0), radius: 20cm, power: {power:.0}W }}"
            ),
            4 => format!("light directional {{ direction: ({x:.2}, -1, {z:.2}), irradiance: 2 }}"),
            5 => format!(
                "light spot {{ position: {p}, direction: ({x:.2}, -1, {z:.2}), angle: 50deg, power: {power:.0}W }}"
            ),
            _ => format!(
                "sphere {{ center: ({x:.2}m, 2m, {z:.2}m), radius: 20cm, material: emissive {{ power: {power:.0}W }} }}"
            ),
        }
    }

    fn texture(&mut self) -> String {
        match self.random.below(5) {
            0 => "image(\"a.ppm\")".to_owned(),
            1 => "image { file: \"b.ppm\", filter: nearest }".to_owned(),
            2 => format!("checker {{ a: {}, b: {}, size: 30cm }}", self.color(), self.color()),
            3 => format!("noise {{ a: {}, b: {}, size: 20cm }}", self.color(), self.color()),
            _ => self.color(),
        }
    }

    fn share(&mut self) -> String {
        let share = self.within(0.0, 1.0);
        if self.chance(4) { "image(\"a.ppm\")".to_owned() } else { format!("{share:.2}") }
    }

    fn roughness(&mut self) -> String {
        match self.random.below(4) {
            0 => "0".to_owned(),
            1 => "0.03".to_owned(),
            _ => format!("{:.2}", self.within(0.05, 0.9)),
        }
    }

    fn material(&mut self) -> String {
        if self.chance(2) { self.made_of_others() } else { self.plain() }
    }

    /// A material that is not made of others.
    fn plain(&mut self) -> String {
        match self.random.below(8) {
            0 => format!("mirror {{ color: {} }}", self.color()),
            1 => {
                let (roughness, more) = (
                    self.roughness(),
                    self.one(&["", ", abbe: 35", ", absorption: #c0ffd0 per 40cm", ", thin: true"]),
                );
                format!("glass {{ ior: 1.5, roughness: {roughness}{more} }}")
            }
            2 => {
                let (metallic, transmission) = (self.one(&["0", "1", "0.4"]), self.one(&["0", "0", "0.7"]));
                let (color, roughness) = (self.texture(), self.roughness());
                format!(
                    "principled {{ color: {color}, metallic: {metallic}, roughness: {roughness}, transmission: {transmission} }}"
                )
            }
            3 => "emissive { radiance: 0.4 }".to_owned(),
            _ => self.opaque(),
        }
    }

    /// One that light does not go through.
    fn opaque(&mut self) -> String {
        let (texture, roughness) = (self.texture(), self.roughness());
        match self.random.below(4) {
            0 => format!("diffuse {{ color: {texture} }}"),
            1 => {
                let shininess = self.one(&["10", "31.9", "32", "60", "900"]);
                let specular = self.within(0.02, 0.2);
                format!(
                    "phong {{ diffuse: {}, specular: {specular:.2}, shininess: {shininess} }}",
                    self.color()
                )
            }
            2 => format!("metal {{ kind: gold, roughness: {roughness} }}"),
            _ => format!("plastic {{ color: {texture}, roughness: {roughness} }}"),
        }
    }

    fn made_of_others(&mut self) -> String {
        let (a, b) = (self.opaque(), self.opaque());
        match self.random.below(6) {
            0 => format!("mix {{ a: {a}, b: {b}, amount: {} }}", self.share()),
            1 => format!("mask {{ material: {a}, opacity: {} }}", self.share()),
            2 => format!("normal_map {{ material: {a}, map: image(\"b.ppm\") }}"),
            3 => format!("bump {{ material: {a}, height: image(\"a.ppm\"), depth: 2cm }}"),
            4 => {
                let (color, roughness) = (self.texture(), self.roughness());
                format!("layer {{ base: diffuse {{ color: {color} }}, roughness: {roughness} }}")
            }
            _ => format!("two_sided {{ front: {a}, back: {b} }}"),
        }
    }

    fn object(&mut self) -> String {
        let (p, material) = (self.point(), self.material());
        let radius = self.within(0.2, 0.7);
        let shape = match self.random.below(7) {
            0 | 1 => format!("sphere {{ radius: {radius:.2}m, material: {material} }}"),
            2 => format!(
                "box {{ min: (-{radius:.2}m, -0.3m, -0.3m), max: ({radius:.2}m, 0.3m, 0.3m), material: {material} }}"
            ),
            3 => format!("mesh {{ file: \"mesh.obj\", scale: {radius:.2}, material: {material} }}"),
            4 => format!(
                "disk {{ center: (0m, 0m, 0m), normal: (0.2, 0.3, 1), radius: {radius:.2}m, material: {material} }}"
            ),
            5 => format!(
                "torus {{ center: (0m, 0m, 0m), radius: {radius:.2}m, tube: 12cm, material: {material} }}"
            ),
            _ => format!("cylinder {{ height: {radius:.2}m, radius: 25cm, material: {material} }}"),
        };
        let turn = self.within(0.0, 360.0);
        format!("place {shape} {{ transform: rotate_x({turn:.0}deg) then translate{p} }}")
    }
}
