//! Draws `dragon.obj`: a small winged dragon for a row of figures.
//!
//! It is modelled as a field: a spine of tapering capsules along a curve, to which head, legs, wings and spines are
//! joined with fillets, and meshed where the field is zero. It looks along −x, is 1.1 high, stands on the origin and
//! is the same on both sides but for the sway of its spine.

mod common;

use std::io;

use common::curve::catmull_rom;
use common::field::{ball, chain, ellipsoid, polygon, smooth_union, surface, taper};
use common::mesh::Normals;
use glam::{Vec2, Vec3};

/// Edge of the meshing cells.
const CELL: f32 = 0.0133;

/// The spine from the nape to the tip of the tail: x, y, z and the radius there.
const SPINE: [[f32; 4]; 15] = [
    [-0.58, 0.87, 0.0, 0.075],
    [-0.47, 0.82, 0.0, 0.078],
    [-0.40, 0.70, 0.01, 0.085],
    [-0.41, 0.55, 0.01, 0.1],
    [-0.44, 0.41, 0.0, 0.13],
    [-0.34, 0.28, -0.01, 0.155],
    [-0.15, 0.28, -0.02, 0.15],
    [0.04, 0.37, -0.01, 0.14],
    [0.23, 0.4, 0.01, 0.14],
    [0.39, 0.3, 0.03, 0.125],
    [0.51, 0.16, 0.04, 0.095],
    [0.67, 0.1, 0.02, 0.07],
    [0.81, 0.17, -0.02, 0.052],
    [0.85, 0.32, -0.04, 0.036],
    [0.77, 0.43, -0.02, 0.022],
];

fn main() -> io::Result<()> {
    let dragon = Dragon::new();
    let (low, high) = (Vec3::new(-0.98, -0.03, -0.46), Vec3::new(0.98, 1.16, 0.46));
    let mesh = surface(low, high, CELL, |p| dragon.field(p)).weld(CELL / 12.0);
    let volume = mesh.closed_volume().map_err(io::Error::other)?;
    println!("closed, volume {volume:.4}");
    mesh.save("dragon", "A dragon, by examples/dragon.rs", Normals::Absent, &[])
}

/// The parts that are too many to write out.
struct Dragon {
    spine: Vec<(Vec3, f32)>,
    crest: Vec<[(Vec3, f32); 2]>,
}

impl Dragon {
    fn new() -> Self {
        let points = SPINE.map(|[x, y, z, _]| Vec3::new(x, y, z));
        let radii = SPINE.map(|[.., r]| Vec3::splat(r));
        let last = (SPINE.len() - 1) as f32;
        let at = |t: f32| (catmull_rom(&points, t), catmull_rom(&radii, t).x);

        let steps = 70;
        let spine = (0..=steps).map(|i| at(last * i as f32 / steps as f32)).collect();

        // Thorns down the back, leaning towards the tail; the largest are over the shoulders.
        let thorn = |i: usize| {
            let t = 0.35 + 0.42 * i as f32;
            let ((p, r), (ahead, _)) = (at(t), at(t + 0.05));
            let along = (ahead - p).normalize();
            let up = Vec3::new(-along.y, along.x, 0.0).normalize();
            let size = 0.5 + 0.5 * (-(t - 5.0).powi(2) / 18.0).exp();
            let tip = p + up * (r + 0.085 * size) + along * 0.05 * size;
            [(p + up * r * 0.8, 0.042 * size), (tip, 0.006)]
        };
        Self { spine, crest: (0..32).map(thorn).filter(|[base, _]| base.0.x < 0.84).collect() }
    }

    /// Negative inside.
    fn field(&self, p: Vec3) -> f32 {
        let q = Vec3::new(p.x, p.y, p.z.abs());
        let thorns = self.crest.iter().map(|[base, tip]| taper(p, *base, *tip)).fold(f32::INFINITY, f32::min);
        let mut body = scales(p, chain(p, &self.spine));
        body = smooth_union(body, legs(q), 0.05);
        body = smooth_union(body, head(q), 0.05);
        body = smooth_union(body, wing(q), 0.03);
        body = smooth_union(body, thorns, 0.02);
        smooth_union(body, arrow(p), 0.02)
    }
}

/// Rings of belly plates and rows of scales: a shallow ripple along the body.
fn scales(p: Vec3, distance: f32) -> f32 {
    let ripple = (p.x * 80.0).sin() * (p.y * 80.0 + p.z * 35.0).sin();
    distance + 0.0026 * ripple
}

/// Head, jaw, horns, ears and brows; the mouth is open.
fn head(q: Vec3) -> f32 {
    let skull = ellipsoid(q, Vec3::new(-0.62, 0.905, 0.0), Vec3::new(0.11, 0.085, 0.085));
    let muzzle = taper(q, (Vec3::new(-0.67, 0.895, 0.0), 0.066), (Vec3::new(-0.84, 0.86, 0.0), 0.045));
    let nostril = ball(q, Vec3::new(-0.865, 0.885, 0.025), 0.022);
    let jaw = taper(q, (Vec3::new(-0.63, 0.84, 0.0), 0.05), (Vec3::new(-0.80, 0.765, 0.0), 0.026));
    let beard = taper(q, (Vec3::new(-0.77, 0.765, 0.0), 0.02), (Vec3::new(-0.76, 0.69, 0.0), 0.006));
    let brow = taper(q, (Vec3::new(-0.715, 0.955, 0.045), 0.022), (Vec3::new(-0.62, 0.985, 0.065), 0.028));
    let eye = ball(q, Vec3::new(-0.69, 0.93, 0.062), 0.024);
    let fang = taper(q, (Vec3::new(-0.82, 0.83, 0.025), 0.014), (Vec3::new(-0.825, 0.785, 0.027), 0.004));
    let horn = chain(
        q,
        &[
            (Vec3::new(-0.58, 0.965, 0.045), 0.032),
            (Vec3::new(-0.50, 1.03, 0.075), 0.025),
            (Vec3::new(-0.41, 1.06, 0.1), 0.017),
            (Vec3::new(-0.32, 1.05, 0.11), 0.006),
        ],
    );
    let ear = taper(q, (Vec3::new(-0.565, 0.88, 0.075), 0.03), (Vec3::new(-0.46, 0.92, 0.15), 0.006));

    let face = smooth_union(smooth_union(skull, muzzle, 0.05), smooth_union(jaw, beard, 0.02), 0.025);
    let face = smooth_union(smooth_union(face, nostril, 0.015), smooth_union(brow, eye, 0.008), 0.012);
    [fang, horn, ear].into_iter().fold(face, |face, part| smooth_union(face, part, 0.015))
}

/// The four legs, each with three claws.
fn legs(q: Vec3) -> f32 {
    let fore = chain(
        q,
        &[
            (Vec3::new(-0.42, 0.36, 0.09), 0.075),
            (Vec3::new(-0.39, 0.21, 0.155), 0.05),
            (Vec3::new(-0.47, 0.06, 0.165), 0.034),
            (Vec3::new(-0.51, 0.028, 0.165), 0.034),
        ],
    );
    let hind = chain(
        q,
        &[
            (Vec3::new(0.3, 0.33, 0.1), 0.105),
            (Vec3::new(0.2, 0.19, 0.165), 0.062),
            (Vec3::new(0.32, 0.085, 0.165), 0.036),
            (Vec3::new(0.24, 0.028, 0.17), 0.034),
        ],
    );
    let claw = |ankle: Vec3, spread: f32| {
        let toe = ankle + Vec3::new(-0.065, -0.004, spread);
        chain(q, &[(ankle, 0.024), (toe, 0.021), (toe + Vec3::new(-0.035, -0.016, spread * 0.2), 0.004)])
    };
    let feet = [Vec3::new(-0.51, 0.024, 0.165), Vec3::new(0.24, 0.024, 0.17)];
    let claws = feet.iter().flat_map(|&foot| [-0.04, 0.0, 0.04].map(|spread| claw(foot, spread)));
    claws.fold(smooth_union(fore, hind, 0.01), |legs, toe| smooth_union(legs, toe, 0.012))
}

/// A wing: an arm, three fingers, and a skin with a scalloped edge between them, in a plane that leans outwards.
fn wing(q: Vec3) -> f32 {
    const LEAN: f32 = 0.42; // metres outwards for each metre up
    let joint = |x: f32, y: f32| Vec3::new(x, y, 0.1 + LEAN * (y - 0.4));
    let (root, wrist) = (joint(-0.33, 0.4), joint(-0.2, 0.88));
    let tips = [joint(0.16, 1.06), joint(0.25, 0.86), joint(0.16, 0.66)];

    let arm = chain(q, &[(root, 0.045), (joint(-0.3, 0.66), 0.03), (wrist, 0.024)]);
    let thumb = taper(q, (wrist, 0.022), (wrist + Vec3::new(-0.06, 0.07, 0.02), 0.004));
    let fingers =
        tips.iter().map(|&tip| taper(q, (wrist, 0.022), (tip, 0.009))).fold(f32::INFINITY, f32::min);

    let flat = |v: Vec3| Vec2::new(v.x, v.y);
    let dip = |a: Vec3, b: Vec3| flat(a).lerp(flat(b), 0.5).lerp(flat(wrist), 0.22);
    let heel = joint(-0.1, 0.42);
    let outline = [
        flat(root),
        flat(joint(-0.3, 0.66)),
        flat(wrist),
        flat(tips[0]),
        dip(tips[0], tips[1]),
        flat(tips[1]),
        dip(tips[1], tips[2]),
        flat(tips[2]),
        dip(tips[2], heel),
        flat(heel),
    ];
    let thickness = (q.z - joint(q.x, q.y).z).abs() / LEAN.hypot(1.0) - 0.009;
    let skin = polygon(flat(q), &outline).max(thickness);
    smooth_union(smooth_union(arm, thumb, 0.02), smooth_union(fingers, skin, 0.018), 0.02)
}

/// The barb at the end of the tail.
fn arrow(p: Vec3) -> f32 {
    let tip = Vec2::new(0.655, 0.5);
    let outline = [tip, Vec2::new(0.785, 0.5), Vec2::new(0.765, 0.44), Vec2::new(0.7, 0.395)];
    polygon(Vec2::new(p.x, p.y), &outline).max((p.z + 0.02).abs() - 0.014)
}
