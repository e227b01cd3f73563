//! The units that may be glued to a number.

use super::Type;
use std::f64::consts::{PI, TAU};

/// A unit.
#[derive(Debug)]
pub struct Unit {
    /// As it is written after a number.
    pub name: &'static str,
    /// The type of a number with it.
    pub of: Type,
    /// Its size in SI units.
    pub size: f64,
    /// What it is.
    pub doc: &'static str,
}

const fn unit(name: &'static str, of: Type, size: f64, doc: &'static str) -> Unit {
    Unit { name, of, size, doc }
}

/// Every unit, those of one type together.
pub const UNITS: &[Unit] = &[
    unit("nm", Type::Length, 1e-9, "Nanometres."),
    unit("um", Type::Length, 1e-6, "Micrometres."),
    unit("mm", Type::Length, 1e-3, "Millimetres."),
    unit("cm", Type::Length, 1e-2, "Centimetres."),
    unit("m", Type::Length, 1.0, "Metres."),
    unit("km", Type::Length, 1e3, "Kilometres."),
    unit("in", Type::Length, 0.0254, "Inches: 25.4mm."),
    unit("ft", Type::Length, 0.3048, "Feet: 30.48cm."),
    unit("deg", Type::Angle, PI / 180.0, "Degrees."),
    unit("rad", Type::Angle, 1.0, "Radians: 1rad is about 57.3deg."),
    unit("turn", Type::Angle, TAU, "Whole turns: 360deg."),
    unit("ns", Type::Time, 1e-9, "Nanoseconds."),
    unit("us", Type::Time, 1e-6, "Microseconds."),
    unit("ms", Type::Time, 1e-3, "Milliseconds."),
    unit("s", Type::Time, 1.0, "Seconds."),
    unit("min", Type::Time, 60.0, "Minutes."),
    unit("mW", Type::Power, 1e-3, "Milliwatts."),
    unit("W", Type::Power, 1.0, "Watts of light, weighted by luminance."),
    unit("kW", Type::Power, 1e3, "Kilowatts."),
    unit("lm", Type::Power, 1.0 / 683.0, "Lumens: 683lm are 1W."),
    unit("K", Type::Temperature, 1.0, "Kelvin: the temperature of a glowing black body."),
    unit("px", Type::Pixels, 1.0, "Pixels."),
    unit("EV", Type::Exposure, 1.0, "Steps of exposure: each doubles the brightness."),
    unit("%", Type::Number, 0.01, "Hundredths: 1% is 0.01. The remainder `7 % 2` has blanks."),
];
