//! Paints `sky.jpg`: clouds at dusk, burning near the horizon and slate above.
//!
//! The picture hangs over that of `stadium.rs`: it is 30 m wide and 10.5 m high, and its foot is the stadium's top.

mod common;

use std::io;

use common::paint::save;
use common::sky::dusk;
use glam::Vec2;

/// The picture in pixels, the window it shows, and the height of its foot, in metres.
const SIZE: (u32, u32) = (1600, 560);
const WINDOW: Vec2 = Vec2::new(30.0, 10.5);
const FOOT: f32 = 10.5;

fn main() -> io::Result<()> {
    save("sky.jpg", SIZE, 2, |pixel| {
        let unit = pixel / Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
        dusk(Vec2::new((unit.x - 0.5) * WINDOW.x, FOOT + (1.0 - unit.y) * WINDOW.y))
    })
}
