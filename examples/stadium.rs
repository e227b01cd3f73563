//! Paints `stadium.jpg`: a full stadium at dusk under floodlights, seen from the touchline.
//!
//! The picture is a window 30 m wide and 10.5 m high, seen from 21 m before it at a height of 4.4 m: where the camera of
//! `arsenal.snell` stands. Through each point
//! of it a ray goes out to the pitch or to the bowl around it, which is one profile (boards, lower tier, boxes, upper
//! tier, roof) carried around a rounded rectangle. What the ray meets is painted: stripes and lines, seats with people
//! on them, lit windows. The glow of the floodlights is added in the plane of the picture.

mod common;

use std::io;

use common::noise::{fractal, hash};
use common::paint::{save, srgb};
use common::sky::{EYE, dusk};
use common::smoothstep;
use glam::{Vec2, Vec3};

/// The picture in pixels, and the window it shows in metres.
const SIZE: (u32, u32) = (2000, 700);
const WINDOW: Vec2 = Vec2::new(30.0, 10.5);

/// The middle of the pitch behind the eye's plane, half the size of the grass, and the radius of the bowl's corners.
const MIDDLE: f32 = -60.0;
const GRASS: Vec2 = Vec2::new(57.0, 38.0);
const CORNER: f32 = 26.0;

/// Along the profile, in metres behind the boards: the tiers, and the front edge of the roof with its height.
const LOWER_TIER: (f32, f32) = (4.0, 27.0);
const UPPER_TIER: (f32, f32) = (27.0, 47.0);
const ROOF_FRONT: f32 = 20.0;
const ROOF_HEIGHT: f32 = 27.5;
const FASCIA: f32 = 2.0;

/// Height of the open girder of tubes that stands on the fascia.
const GIRDER: f32 = 2.4;

fn main() -> io::Result<()> {
    let lamps = floodlights();
    save("stadium.jpg", SIZE, 2, |pixel| {
        let window = window(pixel);
        let seen = seen_through(window);
        seen + glow(&lamps, window)
    })
}

/// From pixels to metres in the window: x to the right of its middle, y above the ground.
fn window(pixel: Vec2) -> Vec2 {
    let unit = pixel / Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
    Vec2::new(unit.x - 0.5, 1.0 - unit.y) * WINDOW
}

/// The point on the ray through the window at `t` times the distance of the window.
fn along(window: Vec2, t: f32) -> Vec3 {
    Vec3::new(window.x * t, EYE.y + (window.y - EYE.y) * t, -EYE.x * t)
}

/// Metres behind the boards that surround the grass; negative on the grass. A rounded rectangle's distance.
fn behind_boards(p: Vec3) -> f32 {
    let q = Vec2::new(p.x, p.z - MIDDLE).abs() - GRASS + CORNER;
    q.max(Vec2::ZERO).length() + q.max_element().min(0.0) - CORNER
}

/// Whether a point of the ground is on the grass. On the near side there is nothing else.
fn on_grass(p: Vec3) -> bool {
    behind_boards(p) < 0.0 || MIDDLE < p.z && p.x.abs() < GRASS.x
}

/// Height of the bowl, `s` metres behind the boards.
fn bowl(s: f32) -> f32 {
    match s {
        s if s < 0.0 => 0.0,
        s if s < 0.4 => 1.0, // the boards
        s if s < LOWER_TIER.0 => 0.2,
        s if s < LOWER_TIER.1 => 1.4 + (s - LOWER_TIER.0) * 0.46,
        s if s < UPPER_TIER.1 => 15.6 + (s - UPPER_TIER.0) * 0.68,
        _ => 34.0, // the back wall, up to the roof
    }
}

/// Height of the underside of the roof, or nothing in front of it.
fn roof(s: f32) -> Option<f32> {
    (ROOF_FRONT..UPPER_TIER.1 + 1.0).contains(&s).then_some(ROOF_HEIGHT + (s - ROOF_FRONT) * 0.2)
}

/// The colour that comes through a point of the window.
fn seen_through(window: Vec2) -> Vec3 {
    // The grass is flat: no search for it.
    let ground = EYE.y / (EYE.y - window.y);
    if 0.0 < ground && on_grass(along(window, ground)) {
        return grass(along(window, ground));
    }

    // Walk out to the first step below the bowl or above the roof, then halve that step.
    let met = |t: f32| {
        let p = along(window, t);
        let s = behind_boards(p);
        let under_roof = roof(s).is_some_and(|height| height < p.y && p.y < height + FASCIA);
        under_roof || p.y < bowl(s)
    };
    let Some(step) = (0..360).map(|i| 1.5 + i as f32 * 0.018).find(|&t| met(t)) else {
        return over_roof(window);
    };
    let (mut free, mut hit) = (step - 0.018, step);
    for _ in 0..12 {
        let half = (free + hit) / 2.0;
        *(if met(half) { &mut hit } else { &mut free }) = half;
    }
    let p = along(window, free);
    bowl_color(p, behind_boards(p), behind_boards(along(window, hit)))
}

/// The dusk over the roof, as at the foot of the painted sky, and the girder before it.
fn over_roof(window: Vec2) -> Vec3 {
    let (mut near, mut far) = (1.5, 8.0);
    for _ in 0..20 {
        let half = (near + far) / 2.0;
        *(if behind_boards(along(window, half)) < ROOF_FRONT { &mut near } else { &mut far }) = half;
    }
    let p = along(window, near);
    let height = (p.y - ROOF_HEIGHT - FASCIA) / GIRDER;
    if girder(perimeter(p) / GIRDER, height) { srgb(0xf3e6dc) * (0.75 + 0.2 * height) } else { dusk(window) }
}

/// Whether a point is on the tubes of the girder: two chords, and a zigzag of diagonals between them. Lengths are in
/// heights of the girder.
fn girder(run: f32, height: f32) -> bool {
    let phase = (run / 1.6).rem_euclid(1.0);
    let zigzag = 1.0 - (2.0 * phase - 1.0).abs();
    let chord = height.abs().min((height - 1.0).abs()) < 0.07;
    (0.0..=1.07).contains(&height) && (chord || (height - zigzag).abs() < 0.075)
}

// ── The pitch ───────────────────────────────────────────────────────────────────────────────────────────────────

/// Mown stripes across the pitch, lines of chalk, worn grass, and light that falls off towards the near side.
fn grass(p: Vec3) -> Vec3 {
    let at = Vec2::new(p.x, p.z - MIDDLE);
    let stripe = (at.x / 5.25).floor().rem_euclid(2.0);
    let cross = (at.y / 8.5).floor().rem_euclid(2.0);
    let tone = 0.42 + 0.36 * stripe + 0.12 * cross;
    let wear = 1.0 + 0.22 * fractal(at * 0.12, 4, 11) + 0.25 * fractal(at * Vec2::new(3.0, 1.1), 3, 12);
    let light = 0.5 + 0.5 * smoothstep(-24.0, -60.0, p.z);
    let green = srgb(0x2c6a1c).lerp(srgb(0x69a83a), tone) * wear * light;

    let width = 0.09 + 0.0007 * p.z.abs(); // a line never falls below a pixel
    green.lerp(srgb(0xe8efe2) * light, 0.85 * (1.0 - smoothstep(width * 0.7, width * 1.3, chalk(at))))
}

/// Distance to the nearest chalk line of a pitch of 105 m × 68 m; `at` is measured from the centre spot.
fn chalk(at: Vec2) -> f32 {
    let side = at.abs(); // every line has its mirror image
    let frame = |half: Vec2, center: Vec2| {
        let q = (side - center).abs() - half;
        (q.max(Vec2::ZERO).length() + q.max_element().min(0.0)).abs()
    };
    let goal_line = 52.5;
    [
        frame(Vec2::new(goal_line, 34.0), Vec2::ZERO),
        if side.y < 34.0 { side.x } else { f32::MAX },
        (at.length() - 9.15).abs(),
        at.length() - 0.25,
        frame(Vec2::new(8.25, 20.16), Vec2::new(goal_line - 8.25, 0.0)),
        frame(Vec2::new(2.75, 9.16), Vec2::new(goal_line - 2.75, 0.0)),
    ]
    .into_iter()
    .fold(f32::MAX, f32::min)
}

// ── The bowl ────────────────────────────────────────────────────────────────────────────────────────────────────

/// The colour of the bowl at `p`: `s` metres behind the boards just before the surface, `beyond` just after.
fn bowl_color(p: Vec3, s: f32, beyond: f32) -> Vec3 {
    let run = perimeter(p);
    if let Some(height) = roof(beyond).filter(|height| *height - 0.3 < p.y) {
        return roof_color(p.y - height, beyond, run);
    }
    if s < 0.4 && p.y < 1.05 {
        return boards(run, p.y);
    }
    if (LOWER_TIER.0..LOWER_TIER.1 - 0.05).contains(&s) {
        return seats(run, s - LOWER_TIER.0, 0.52, 1);
    }
    if p.y < 15.6 {
        return boxes(run, p.y - 12.0);
    }
    if s < UPPER_TIER.1 - 0.05 {
        let shade = 0.5 - 0.32 * smoothstep(UPPER_TIER.0, UPPER_TIER.1, s);
        return seats(run, s - UPPER_TIER.0, shade, 2);
    }
    srgb(0x3a2a2c) * 0.4
}

/// Metres along the perimeter of the bowl, from the middle of the far side.
fn perimeter(p: Vec3) -> f32 {
    let at = Vec2::new(p.x, MIDDLE - p.z); // y away from the eye
    let straight = GRASS - CORNER;
    let arc = std::f32::consts::FRAC_PI_2 * (CORNER + 20.0);
    if at.x.abs() < straight.x {
        return at.x;
    }
    if at.y < straight.y {
        return at.x.signum() * (straight.x + arc + straight.y - at.y);
    }
    let corner = Vec2::new(at.x.abs() - straight.x, at.y - straight.y);
    at.x.signum() * (straight.x + corner.x.atan2(corner.y) * (CORNER + 20.0))
}

/// A tier of seats: rows 0.8 m deep, seats 0.55 m wide, stairs between the blocks; most seats are taken.
fn seats(run: f32, depth: f32, light: f32, tier: u32) -> Vec3 {
    let stairs = (run / 15.4 + 0.5).rem_euclid(1.0) - 0.5;
    if stairs.abs() < 0.035 {
        return srgb(0x8d8788) * light * (0.55 + 0.3 * (depth / 0.4).floor().rem_euclid(2.0));
    }
    let (row, seat) = ((depth / 0.8).floor(), (run / 0.55).floor());
    let local = Vec2::new(run / 0.55 - seat - 0.5, depth / 0.8 - row - 0.5);
    let random = |salt: u32| hash(seat as i32, row as i32, tier * 100 + salt);

    let red_seat = srgb(0x9e1c26) * (0.5 + 0.5 * smoothstep(-0.5, 0.5, local.y));
    let crowd = 0.86 + 0.3 * fractal(Vec2::new(seat, row) * 0.045, 3, tier); // thinner here, denser there
    if crowd < random(1) {
        return red_seat * light;
    }
    let sway = Vec2::new((random(2) - 0.5) * 0.2, (random(3) - 0.5) * 0.25);
    let head = (local - sway - Vec2::new(0.0, 0.22)).length() < 0.24;
    let body = (local.x - sway.x).abs() < 0.4 && local.y < 0.2;
    let skin = srgb(0xc8946e).lerp(srgb(0x6a4433), random(4));
    let person = if head {
        skin
    } else if body {
        coat(random(5))
    } else {
        red_seat * 0.5
    };
    person * light * (0.7 + 0.5 * random(6))
}

/// What people wear: mostly the home colours.
fn coat(u: f32) -> Vec3 {
    match u {
        u if u < 0.42 => srgb(0xc0202c),
        u if u < 0.58 => srgb(0xe6e0da),
        u if u < 0.76 => srgb(0x23283a),
        u if u < 0.86 => srgb(0x4b5a78),
        u if u < 0.94 => srgb(0x6e6a66),
        _ => srgb(0xd9a53a),
    }
}

/// The boxes between the tiers: a parapet, warm windows with people in some, a dark slab above.
fn boxes(run: f32, height: f32) -> Vec3 {
    if height < 0.6 {
        return srgb(0x5a2026) * 0.8;
    }
    if 3.0 < height {
        return srgb(0xb02030) * (0.75 + 0.25 * (run * 0.9).sin().signum());
    }
    let pane = (run / 2.2).floor();
    let local = run / 2.2 - pane;
    if local < 0.1 {
        return srgb(0x2a2224);
    }
    let warm = srgb(0xffc878) * (0.35 + 0.65 * hash(pane as i32, 0, 7));
    let guest = (local - 0.3 - 0.5 * hash(pane as i32, 1, 7)).abs() < 0.1 && height < 1.9;
    if guest && hash(pane as i32, 2, 7) < 0.6 { warm * 0.12 } else { warm * (0.6 + 0.15 * height) }
}

/// The boards around the grass: the name of the project in lights, between stars.
fn boards(run: f32, height: f32) -> Vec3 {
    /// SNELL and a star, 5 × 5 dots each, a row of bits from the left in each number.
    const GLYPHS: [[u8; 5]; 6] = [
        [0b01111, 0b10000, 0b01110, 0b00001, 0b11110],
        [0b10001, 0b11001, 0b10101, 0b10011, 0b10001],
        [0b11111, 0b10000, 0b11110, 0b10000, 0b11111],
        [0b10000, 0b10000, 0b10000, 0b10000, 0b11111],
        [0b10000, 0b10000, 0b10000, 0b10000, 0b11111],
        [0b00100, 0b01110, 0b11111, 0b01110, 0b00100],
    ];
    let dot = 0.16;
    let panel = (run / (9.0 * 7.0 * dot)).floor() as i32;
    let column = (run / dot).floor().rem_euclid(9.0 * 7.0) as usize;
    let (glyph, x) = (column / 7, column % 7);
    let y = ((0.95 - height) / dot).floor();
    let lit = glyph < 6
        && (1..=5).contains(&x)
        && (0.0..5.0).contains(&y)
        && GLYPHS[glyph][y as usize] >> (5 - x) & 1 == 1;
    let ground = if panel.rem_euclid(2) == 0 { srgb(0x8e0f1e) } else { srgb(0x14203c) };
    if lit { srgb(0xfff2d8) } else { ground }
}

/// The roof: a pale fascia with ribs in front, and dark steel with purlins underneath.
fn roof_color(above_underside: f32, s: f32, run: f32) -> Vec3 {
    if s < ROOF_FRONT + 0.6 && 0.0 < above_underside {
        let rib = (run / 3.0).rem_euclid(1.0) < 0.06;
        let band = smoothstep(0.0, FASCIA, above_underside);
        let pale = srgb(0x8a8fa0).lerp(srgb(0xd8cfcf), band);
        return if rib { pale * 0.6 } else { pale };
    }
    // Trusses every 12 m run back from the edge; purlins cross them.
    let truss = (run / 12.0).rem_euclid(1.0) < 0.03;
    let diagonal = ((run / 12.0 + (s - ROOF_FRONT) / 12.0).rem_euclid(1.0) < 0.025)
        || ((run / 12.0 - (s - ROOF_FRONT) / 12.0).rem_euclid(1.0) < 0.025);
    let purlin = ((s - ROOF_FRONT) / 3.0).rem_euclid(1.0) < 0.12;
    let light = 1.0 - 0.7 * smoothstep(ROOF_FRONT, ROOF_FRONT + 16.0, s);
    let steel = if truss || diagonal || purlin { srgb(0xb9b6bb) } else { srgb(0x4c4a55) };
    steel * light * 0.6
}

// ── The floodlights ─────────────────────────────────────────────────────────────────────────────────────────────

/// Where the lamps under the front edge of the roof are seen in the window, and how large they look.
fn floodlights() -> Vec<(Vec2, f32)> {
    let lamp = |x: f32, z: f32| {
        let t = -z / EYE.x;
        let seen = Vec2::new(x, ROOF_HEIGHT - EYE.y - 0.35) / t + Vec2::Y * EYE.y;
        (seen, 1.0 / t)
    };
    // Walk along the edge of the roof by the angle around the pitch; find the edge outwards from the middle.
    let on_edge = |angle: f32| {
        let dir = Vec3::new(angle.sin(), 0.0, -angle.cos());
        let (mut near, mut far) = (0.0, 200.0);
        for _ in 0..24 {
            let half = (near + far) / 2.0;
            let p = Vec3::new(0.0, 0.0, MIDDLE) + dir * half;
            *(if behind_boards(p) < ROOF_FRONT { &mut near } else { &mut far }) = half;
        }
        let p = Vec3::new(0.0, 0.0, MIDDLE) + dir * near;
        lamp(p.x, p.z)
    };
    (-17..=17).map(|i| on_edge(i as f32 * 0.089)).collect()
}

/// A burnt-out core and two halos around each lamp.
fn glow(lamps: &[(Vec2, f32)], window: Vec2) -> Vec3 {
    let light = |&(at, scale): &(Vec2, f32)| {
        let offset = (window - at) * Vec2::new(1.0, 1.35);
        let d = offset.length() / scale;
        1.6 * (-(d / 0.42).powi(2)).exp() + 0.35 * (-d / 0.8).exp() + 0.05 * (-d / 4.0).exp()
    };
    srgb(0xfff4e0) * lamps.iter().map(light).sum::<f32>()
}
