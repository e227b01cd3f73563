//! Meshes with materials and nodes, written as binary glTF 2.0.

use std::io;

use glam::Vec3;
use serde_json::{Value, json};

/// A file as it grows.
#[derive(Default)]
pub struct Glb {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
}

/// Triangles with a normal at each vertex.
#[derive(Default, Clone)]
pub struct Solid {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub triangles: Vec<[u16; 3]>,
}

impl Solid {
    /// Adds a flat quad, counter-clockwise seen from outside.
    pub fn quad(&mut self, corners: [Vec3; 4]) {
        let [a, b, c, d] = corners;
        let base = self.positions.len() as u16;
        self.positions.extend(corners);
        self.normals.extend([(c - a).cross(d - b).normalize(); 4]);
        // A side that has no length, at the tip of a cone, leaves one triangle.
        let halves = [[0, 1, 2], [0, 2, 3]].into_iter().filter(|half: &[usize; 3]| {
            let [a, b, c] = half.map(|i| corners[i]);
            (b - a).cross(c - a) != Vec3::ZERO
        });
        self.triangles.extend(halves.map(|half| half.map(|i| base + i as u16)));
    }

    /// Adds a closed body of revolution about the y axis: rings (radius, height) from the bottom up, smooth where `smooth`.
    pub fn turned(&mut self, rings: &[(f32, f32)], sides: usize, smooth: bool) {
        let point = |(r, y): (f32, f32), i: usize| {
            let angle = std::f32::consts::TAU * i as f32 / sides as f32;
            Vec3::new(r * angle.cos(), y, -r * angle.sin())
        };
        for pair in rings.windows(2) {
            for i in 0..sides {
                let corners =
                    [point(pair[0], i), point(pair[0], i + 1), point(pair[1], i + 1), point(pair[1], i)];
                let start = self.normals.len();
                self.quad(corners);
                if smooth {
                    let slope = (pair[0].0 - pair[1].0) / (pair[1].1 - pair[0].1).max(1e-6);
                    for (normal, p) in self.normals[start..].iter_mut().zip(corners) {
                        *normal =
                            (Vec3::new(p.x, 0.0, p.z).normalize_or_zero() + Vec3::Y * slope).normalize();
                    }
                }
            }
        }
    }
}

impl Glb {
    /// Adds a material, as glTF has it.
    pub fn material(&mut self, material: Value) -> usize {
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// Adds a mesh of one material.
    pub fn mesh(&mut self, name: &str, solid: &Solid, material: usize) -> usize {
        let low = solid.positions.iter().fold(Vec3::INFINITY, |low, p| low.min(*p));
        let high = solid.positions.iter().fold(Vec3::NEG_INFINITY, |high, p| high.max(*p));
        let vectors =
            |all: &[Vec3]| all.iter().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect();
        let positions: Vec<u8> = vectors(&solid.positions);
        let normals: Vec<u8> = vectors(&solid.normals);
        let indices: Vec<u8> = solid.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        let count = solid.positions.len();
        let position = self.accessor(
            &positions,
            json!({ "componentType": 5126, "count": count, "type": "VEC3",
            "min": low.to_array(), "max": high.to_array() }),
        );
        let normal =
            self.accessor(&normals, json!({ "componentType": 5126, "count": count, "type": "VEC3" }));
        let corners = 3 * solid.triangles.len();
        let index =
            self.accessor(&indices, json!({ "componentType": 5123, "count": corners, "type": "SCALAR" }));
        self.meshes.push(json!({ "name": name, "primitives": [{ "attributes": { "POSITION": position,
            "NORMAL": normal }, "indices": index, "material": material }] }));
        self.meshes.len() - 1
    }

    fn accessor(&mut self, bytes: &[u8], mut accessor: Value) -> usize {
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() }));
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Places a mesh: turned about the y axis, then moved.
    pub fn node(&mut self, name: &str, mesh: usize, turn: f32, at: Vec3) {
        let (sin, cos) = (turn / 2.0).sin_cos();
        self.nodes.push(json!({ "name": name, "mesh": mesh, "rotation": [0.0, sin, 0.0, cos],
            "translation": at.to_array() }));
    }

    /// Writes the file beside the other assets.
    pub fn save(self, name: &str, copyright: &str) -> io::Result<()> {
        let nodes: Vec<usize> = (0..self.nodes.len()).collect();
        let json = json!({
            "asset": { "version": "2.0", "generator": copyright },
            "extensionsUsed": ["KHR_materials_emissive_strength", "KHR_materials_transmission",
                "KHR_materials_clearcoat"],
            "scene": 0, "scenes": [{ "nodes": nodes }], "nodes": self.nodes, "meshes": self.meshes,
            "materials": self.materials, "accessors": self.accessors, "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len() }],
        });
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + text.len() + 8 + self.bytes.len();
        let mut out = Vec::with_capacity(length);
        out.extend(b"glTF");
        out.extend(2_u32.to_le_bytes());
        for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &self.bytes)] {
            if kind == b"JSON" {
                out.extend((length as u32).to_le_bytes());
            }
            out.extend((chunk.len() as u32).to_le_bytes());
            out.extend(kind);
            out.extend(chunk);
        }
        let path = super::asset(name);
        std::fs::write(&path, out)?;
        println!("{}: {length} bytes", path.display());
        Ok(())
    }
}
