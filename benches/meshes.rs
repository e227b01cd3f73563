//! The speed of reading meshes: OBJ by this project's reader and by `tobj`, and the same mesh as binary glTF.
//!
//! One thread, CPU seconds, the readers in turn and the best of five. `cargo bench --bench meshes`, with thousands of
//! triangles as arguments: `-- 100 1000`.

use cpu_time::ThreadTime;
use snell::asset::{gltf, obj};
use std::fmt::Write;
use std::hint::black_box;

fn main() {
    let sizes: Vec<usize> = std::env::args().filter_map(|arg| arg.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![100, 1_000] } else { sizes };
    println!(
        "{:>12} {:>8} {:>12} {:>12} {:>8} {:>12}",
        "triangles", "OBJ", "here", "tobj", "ratio", "binary glTF"
    );
    for thousands in sizes {
        let mesh = Grid::of(thousands * 1000);
        let (text, binary) = (mesh.obj(), mesh.binary());
        let mut best = [f64::INFINITY; 3];
        for _ in 0..5 {
            let readers: [&dyn Fn(); 3] = [&|| here(&text), &|| tobj_reader(&text), &|| gltf_reader(&binary)];
            for (best, read) in best.iter_mut().zip(readers) {
                let start = cpu_seconds();
                read();
                *best = best.min(cpu_seconds() - start);
            }
        }
        let megabytes = text.len() as f64 / 1e6;
        let speed = |seconds: f64| format!("{:.0} MB/s", megabytes / seconds);
        println!(
            "{:>12} {megabytes:>5.0} MB {:>12} {:>12} {:>8.2} {:>9.0} ms",
            mesh.triangle_count(),
            speed(best[0]),
            speed(best[1]),
            best[1] / best[0],
            1e3 * best[2]
        );
    }
}

fn here(text: &[u8]) {
    black_box(obj::read(text, &|_| Err(String::new()), None).expect("the mesh is right"));
}

fn tobj_reader(text: &[u8]) {
    let options = tobj::LoadOptions { single_index: true, triangulate: true, ..Default::default() };
    let mut text = text;
    let read = tobj::load_obj_buf(&mut text, &options, |_| Ok(Default::default()));
    let (models, _) = read.expect("the mesh is right");
    black_box(models);
}

fn gltf_reader(bytes: &[u8]) {
    black_box(gltf::read(bytes, &|_| Err(String::new()), None).expect("the mesh is right"));
}

fn cpu_seconds() -> f64 {
    ThreadTime::now().as_duration().as_secs_f64()
}

/// A bumpy sheet with normals and texture points.
struct Grid {
    side: usize,
}

impl Grid {
    fn of(triangles: usize) -> Self {
        Self { side: ((triangles / 2) as f64).sqrt().ceil() as usize }
    }

    fn triangle_count(&self) -> usize {
        2 * self.side * self.side
    }

    /// Position, normal and texture point of each vertex.
    fn vertices(&self) -> impl Iterator<Item = [f32; 8]> {
        let side = self.side;
        (0..=side).flat_map(move |j| (0..=side).map(move |i| (i, j))).map(move |(i, j)| {
            let (u, v) = (i as f32 / side as f32, j as f32 / side as f32);
            let y = ((i * 7919 + j * 104_729) % 1000) as f32 * 1e-5;
            [u * 10.0 - 5.0, y, v * 10.0 - 5.0, y * 3.0, 1.0, y * 2.0, u, v]
        })
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> {
        let (side, row) = (self.side, self.side + 1);
        (0..side).flat_map(move |j| (0..side).map(move |i| j * row + i)).flat_map(move |corner| {
            let (a, b, c, d) = (corner, corner + 1, corner + row + 1, corner + row);
            [[a, c, b], [a, d, c]]
        })
    }

    fn obj(&self) -> Vec<u8> {
        let mut out = String::new();
        for [x, y, z, nx, ny, nz, u, v] in self.vertices() {
            let _ = writeln!(out, "v {x:.6} {y:.6} {z:.6}\nvt {u:.6} {v:.6}\nvn {nx:.4} {ny:.4} {nz:.4}");
        }
        for t in self.triangles() {
            let [a, b, c] = t.map(|i| i + 1);
            let _ = writeln!(out, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}");
        }
        out.into_bytes()
    }

    fn binary(&self) -> Vec<u8> {
        let vertex_count = (self.side + 1).pow(2);
        let vertices: Vec<u8> = self.vertices().flatten().flat_map(f32::to_le_bytes).collect();
        let indices = self.triangles().flatten().flat_map(|i| (i as u32).to_le_bytes());
        let bytes: Vec<u8> = vertices.iter().copied().chain(indices).collect();
        let view = |start: usize, end: usize, stride: &str| {
            format!("{{\"buffer\":0,\"byteOffset\":{start},\"byteLength\":{}{stride}}}", end - start)
        };
        let accessor = |view: usize, at: usize, kind: u32, count: usize, of: &str| {
            format!(
                "{{\"bufferView\":{view},\"byteOffset\":{at},\"componentType\":{kind},\"count\":{count},\"type\":\"{of}\"}}"
            )
        };
        let mut json = format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{{\"byteLength\":{}}}],\"bufferViews\":[{},{}],\
             \"accessors\":[{},{},{},{}],\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"NORMAL\":1,\
             \"TEXCOORD_0\":2}},\"indices\":3}}]}}]}}",
            bytes.len(),
            view(0, vertices.len(), ",\"byteStride\":32"),
            view(vertices.len(), bytes.len(), ""),
            accessor(0, 0, 5126, vertex_count, "VEC3"),
            accessor(0, 12, 5126, vertex_count, "VEC3"),
            accessor(0, 24, 5126, vertex_count, "VEC2"),
            accessor(1, 0, 5125, 3 * self.triangle_count(), "SCALAR"),
        );
        json.extend(std::iter::repeat_n(' ', json.len().next_multiple_of(4) - json.len()));
        let length = 12 + 8 + json.len() + 8 + bytes.len();
        let chunk =
            |kind: &[u8], content: &[u8]| [&(content.len() as u32).to_le_bytes()[..], kind, content].concat();
        let head = [&b"glTF"[..], &2_u32.to_le_bytes(), &(length as u32).to_le_bytes()].concat();
        [head, chunk(b"JSON", json.as_bytes()), chunk(b"BIN\0", &bytes)].concat()
    }
}
