//! Floating-point helpers, and the one source of transcendental functions.
//!
//! The standard library calls the platform's functions, whose last bits differ between systems. Everything that can
//! reach a pixel takes them from here, so that the same scene and seed give the same bits everywhere.

/// Half of the distance from 1 to the next `f32`: the unit round-off u = 2⁻²⁴.
pub const UNIT_ROUND_OFF: f32 = 5.960_464_5e-8;

/// The bound γ(n) = n·u / (1 − n·u) on the relative error of n rounded operations (Higham 2002, section 3.1).
pub const fn gamma(n: u32) -> f32 {
    let nu = n as f32 * UNIT_ROUND_OFF;
    nu / (1.0 - nu)
}

/// `(sin x, cos x)` of an angle in radians.
pub fn sin_cos(x: f32) -> (f32, f32) {
    (libm::sinf(x), libm::cosf(x))
}

/// `(sin x, cos x)` in double precision.
pub fn sin_cos64(x: f64) -> (f64, f64) {
    (libm::sin(x), libm::cos(x))
}

/// `x` to the power `y`.
pub fn pow(x: f32, y: f32) -> f32 {
    libm::powf(x, y)
}

/// e to the power `x`.
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// The natural logarithm.
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// The angle of the vector `(x, y)` from the x axis, in (−π, π].
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// The arc cosine in [0, π]; arguments beyond ±1 by rounding count as ±1.
pub fn acos(x: f32) -> f32 {
    libm::acosf(x.clamp(-1.0, 1.0))
}

/// e to the power `x` in double precision.
pub fn exp64(x: f64) -> f64 {
    libm::exp(x)
}

/// `x` to the power `y` in double precision.
pub fn pow64(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// The tangent in double precision.
pub fn tan64(x: f64) -> f64 {
    libm::tan(x)
}

/// e to the power `x`, less 1; keeps its digits near 0.
pub fn exp_m1(x: f32) -> f32 {
    libm::expm1f(x)
}

/// The natural logarithm of `1 + x`; keeps its digits near 0.
pub fn ln_1p(x: f32) -> f32 {
    libm::log1pf(x)
}

/// The angle of the vector `(x, y)` from the x axis, in (−π, π], in double precision.
pub fn atan2_64(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}
