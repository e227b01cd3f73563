//! Draws `trophy.obj`: a tall silver cup with two large curved handles.
//!
//! The body is a Bézier profile turned about the y axis, with flutes that swell out of the lower bowl; each handle is a
//! tube along a spline from the foot of the bowl up past the rim and back to the neck. The cup is 1 high and stands on
//! the origin. Body and handles are three closed solids.

mod common;

use std::io;

use common::curve::{bezier_chain, catmull_rom, revolve, tube};
use common::mesh::{Mesh, Normals};
use common::smoothstep;
use glam::{Affine3A, Vec3};

fn main() -> io::Result<()> {
    let body = body();
    let handle = handle();
    for (name, part) in [("body", &body), ("handle", &handle)] {
        let volume = part.manifold_volume().map_err(|why| io::Error::other(format!("{name}: {why}")))?;
        println!("{name}: a manifold, volume {volume:.5}");
    }
    let mut cup = body;
    cup.append(&handle, Affine3A::IDENTITY);
    cup.append(&handle, Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0)));
    cup.save("trophy", "A cup with big ears, by examples/trophy.rs", Normals::Crease(0.6), &[])
}

/// The cup itself, plinth and all: hollow, with a wall that turns over at the rim.
fn body() -> Mesh {
    #[rustfmt::skip]
    let profile = [
        [0.0, 0.0],
        [0.06, 0.0], [0.12, 0.0], [0.18, 0.0],              // the plinth: a drum
        [0.187, 0.0], [0.19, 0.003], [0.19, 0.01],
        [0.19, 0.025], [0.19, 0.04], [0.19, 0.055],
        [0.19, 0.062], [0.187, 0.066], [0.178, 0.067],
        [0.17, 0.068], [0.165, 0.07], [0.165, 0.078],       // and a step on it
        [0.165, 0.09], [0.162, 0.096], [0.15, 0.1],
        [0.11, 0.11], [0.06, 0.125], [0.05, 0.17],          // the trumpet foot
        [0.047, 0.185], [0.052, 0.188], [0.062, 0.193],
        [0.074, 0.199], [0.074, 0.215], [0.062, 0.221],     // a ring around the stem
        [0.052, 0.226], [0.05, 0.23], [0.053, 0.24],
        [0.06, 0.27], [0.1, 0.3], [0.13, 0.36],             // the bowl, fluted here
        [0.17, 0.44], [0.205, 0.56], [0.21, 0.66],
        [0.213, 0.7], [0.218, 0.702], [0.218, 0.712],       // a raised band around the shoulder
        [0.218, 0.722], [0.213, 0.724], [0.208, 0.73],
        [0.19, 0.755], [0.14, 0.77], [0.132, 0.81],         // the neck
        [0.126, 0.84], [0.135, 0.865], [0.155, 0.885],      // and the rim, turned outwards
        [0.163, 0.893], [0.163, 0.902], [0.152, 0.9],
        [0.13, 0.885], [0.118, 0.86], [0.12, 0.81],         // down inside
        [0.125, 0.76], [0.195, 0.74], [0.195, 0.64],
        [0.19, 0.54], [0.15, 0.42], [0.11, 0.36],
        [0.08, 0.31], [0.04, 0.29], [0.0, 0.29],
    ];
    let points = bezier_chain(&profile, 6);
    let rim = points.iter().map(|p| p[1]).fold(0.0, f32::max);
    let inside_from = points.iter().position(|p| p[1] == rim).unwrap_or(points.len());

    // Twenty flutes grow out of the stem and fade below the shoulder; the inside stays round.
    revolve(&points, 100, |angle, i| {
        let height = points[i][1];
        let reach = smoothstep(0.25, 0.33, height) * (1.0 - smoothstep(0.42, 0.64, height));
        if i < inside_from { 1.0 + 0.1 * reach * (10.0 * angle).sin().abs() } else { 1.0 }
    })
}

/// The handle on the side of +x: out of the lower bowl, up in a wide ear, over the rim and down onto the shoulder.
fn handle() -> Mesh {
    let spine = [
        [0.15, 0.385],
        [0.205, 0.425],
        [0.262, 0.52],
        [0.312, 0.65],
        [0.338, 0.79],
        [0.33, 0.91],
        [0.285, 0.98],
        [0.232, 0.975],
        [0.204, 0.92],
        [0.21, 0.855],
        [0.213, 0.795],
        [0.185, 0.745],
    ]
    .map(|[x, y]| Vec3::new(x, y, 0.0));
    let steps = 72;
    let point = |i: usize| {
        let t = i as f32 / steps as f32;
        let radius = 0.0145 + 0.006 * (2.0 * t - 1.0).powi(2);
        (catmull_rom(&spine, t * (spine.len() - 1) as f32), radius)
    };
    tube(&(0..=steps).map(point).collect::<Vec<_>>(), 14)
}
