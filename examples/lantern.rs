//! Makes `lantern.glb`: a six-sided lantern of brass with panes of glass around a candle.
//!
//! One mesh each for what there is six times of, placed by six nodes; the flame shines (KHR_materials_emissive_strength), the
//! panes are thin (KHR_materials_transmission), the roof is lacquered (KHR_materials_clearcoat). In metres.

mod common;

use common::glb::{Glb, Solid};
use glam::Vec3;
use serde_json::json;
use std::f32::consts::TAU;
use std::io;

/// From the axis to the posts, and how high these are.
const RADIUS: f32 = 0.09;
const HEIGHT: f32 = 0.2;
/// How high the base is.
const BASE: f32 = 0.03;
const SIDES: usize = 6;

fn main() -> io::Result<()> {
    let mut file = Glb::default();
    let brass = file.material(json!({ "name": "brass", "pbrMetallicRoughness": {
        "baseColorFactor": [0.89, 0.62, 0.27, 1.0], "metallicFactor": 1.0, "roughnessFactor": 0.35 } }));
    let lacquer = file.material(json!({ "name": "lacquer", "pbrMetallicRoughness": {
        "baseColorFactor": [0.05, 0.12, 0.09, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.6 },
        "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.1 } } }));
    let glass = file.material(json!({ "name": "panes", "doubleSided": true, "pbrMetallicRoughness": {
        "baseColorFactor": [0.97, 0.98, 0.96, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.0 },
        "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1.0 } } }));
    let wax = file.material(json!({ "name": "wax", "pbrMetallicRoughness": {
        "baseColorFactor": [0.85, 0.8, 0.68, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5 } }));
    let flame = file.material(json!({ "name": "flame", "emissiveFactor": [1.0, 0.52, 0.16],
        "pbrMetallicRoughness": { "baseColorFactor": [0.0, 0.0, 0.0, 1.0], "metallicFactor": 0.0 },
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 900.0 } } }));

    let mut base = Solid::default();
    base.turned(&[(0.0, 0.0), (0.11, 0.0), (0.115, 0.012), (0.1, BASE), (0.0, BASE)], SIDES, false);
    let mut roof = Solid::default();
    let eaves = BASE + HEIGHT;
    let slope =
        [(0.0, eaves), (0.12, eaves), (0.122, eaves + 0.01), (0.03, eaves + 0.075), (0.0, eaves + 0.075)];
    roof.turned(&slope, SIDES, false);
    let mut knob = Solid::default();
    let ball = |i: usize| {
        let angle = std::f32::consts::PI * i as f32 / 12.0;
        (0.022 * angle.sin().max(0.0), eaves + 0.09 - 0.022 * angle.cos())
    };
    knob.turned(&(0..=12).map(ball).collect::<Vec<_>>(), 24, true);
    let mut candle = Solid::default();
    candle.turned(&[(0.028, BASE), (0.026, BASE + 0.075)], 32, true);
    candle.turned(&[(0.026, BASE + 0.075), (0.0, BASE + 0.07)], 32, true);
    let mut light = Solid::default();
    let tear = |i: usize| {
        let t = i as f32 / 12.0;
        (0.011 * (std::f32::consts::PI * t.powf(0.7)).sin().max(0.0), BASE + 0.078 + 0.042 * t)
    };
    light.turned(&(0..=12).map(tear).collect::<Vec<_>>(), 24, true);

    let body = [
        ("base", &base, brass),
        ("roof", &roof, lacquer),
        ("knob", &knob, brass),
        ("candle", &candle, wax),
        ("flame", &light, flame),
    ];
    for (name, solid, material) in body {
        let mesh = file.mesh(name, solid, material);
        file.node(name, mesh, 0.0, Vec3::ZERO);
    }
    let mut post = Solid::default();
    post.turned(&[(0.006, 0.0), (0.006, HEIGHT)], 12, true);
    let post = file.mesh("post", &post, brass);
    let mut pane = Solid::default();
    let (half, depth) = (RADIUS * (TAU / 12.0).sin(), RADIUS * (TAU / 12.0).cos());
    pane.quad(
        [(-half, 0.0), (half, 0.0), (half, HEIGHT), (-half, HEIGHT)].map(|(x, y)| Vec3::new(x, y, depth)),
    );
    let pane = file.mesh("pane", &pane, glass);
    for i in 0..SIDES {
        let turn = TAU * i as f32 / SIDES as f32;
        let corner = Vec3::new(RADIUS * turn.cos(), BASE, -RADIUS * turn.sin());
        file.node(&format!("post {i}"), post, 0.0, corner);
        file.node(&format!("pane {i}"), pane, turn, Vec3::Y * BASE);
    }
    file.save("lantern.glb", "examples/lantern.rs")
}
