//! Quantities: numbers with the exponents of their units.

use crate::schema::{self, Type};

/// Exponents of length, angle, time, power, temperature, pixel, exposure step and f-number.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Dimension([i8; 8]);

impl Dimension {
    pub const NONE: Self = Self([0; 8]);
    pub const LENGTH: Self = Self([1, 0, 0, 0, 0, 0, 0, 0]);
    pub const ANGLE: Self = Self([0, 1, 0, 0, 0, 0, 0, 0]);
    pub const TIME: Self = Self([0, 0, 1, 0, 0, 0, 0, 0]);
    pub const POWER: Self = Self([0, 0, 0, 1, 0, 0, 0, 0]);
    pub const TEMPERATURE: Self = Self([0, 0, 0, 0, 1, 0, 0, 0]);
    pub const PIXEL: Self = Self([0, 0, 0, 0, 0, 1, 0, 0]);
    pub const EXPOSURE: Self = Self([0, 0, 0, 0, 0, 0, 1, 0]);
    pub const F_NUMBER: Self = Self([0, 0, 0, 0, 0, 0, 0, 1]);

    /// The dimension of a type of numbers; `None` for types that are no numbers.
    pub const fn of(ty: Type) -> Option<Self> {
        Some(match ty {
            Type::Int | Type::Number => Self::NONE,
            Type::Length => Self::LENGTH,
            Type::Angle => Self::ANGLE,
            Type::Time => Self::TIME,
            Type::Power => Self::POWER,
            Type::Temperature => Self::TEMPERATURE,
            Type::Pixels => Self::PIXEL,
            Type::Exposure => Self::EXPOSURE,
            Type::FNumber => Self::F_NUMBER,
            _ => return None,
        })
    }

    /// The type that a value of this dimension has, when there is one.
    const fn ty(self) -> Option<Type> {
        Some(match self {
            Self::NONE => Type::Number,
            Self::LENGTH => Type::Length,
            Self::ANGLE => Type::Angle,
            Self::TIME => Type::Time,
            Self::POWER => Type::Power,
            Self::TEMPERATURE => Type::Temperature,
            Self::PIXEL => Type::Pixels,
            Self::EXPOSURE => Type::Exposure,
            Self::F_NUMBER => Type::FNumber,
            _ => return None,
        })
    }

    /// The dimension of a product.
    pub fn times(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].saturating_add(other.0[i])))
    }

    /// The dimension of a quotient.
    pub fn over(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].saturating_sub(other.0[i])))
    }

    /// The dimension of a power; `None` when an exponent would not be whole.
    pub fn power(self, exponent: f64) -> Option<Self> {
        let powers = self.0.map(|e| f64::from(e) * exponent);
        let whole = powers.iter().all(|e| e.fract() == 0.0 && e.abs() <= 100.0);
        whole.then(|| Self(powers.map(|e| e as i8)))
    }

    /// How a report calls such a value: "a length".
    pub fn noun(self) -> String {
        const AREA: Dimension = Dimension([2, 0, 0, 0, 0, 0, 0, 0]);
        const VOLUME: Dimension = Dimension([3, 0, 0, 0, 0, 0, 0, 0]);
        const SPEED: Dimension = Dimension([1, 0, -1, 0, 0, 0, 0, 0]);
        const UNITS: [&str; 8] = ["m", "rad", "s", "W", "K", "px", "EV", "f/"];
        match (self, self.ty()) {
            (Self::NONE, _) => "a plain number".to_owned(),
            (_, Some(ty)) => ty.noun(),
            (AREA, _) => "an area".to_owned(),
            (VOLUME, _) => "a volume".to_owned(),
            (SPEED, _) => "a speed".to_owned(),
            _ => {
                let factor = |(&unit, &e): (&&str, &i8)| match e {
                    0 => None,
                    1 => Some(unit.to_owned()),
                    _ => Some(format!("{unit}^{e}")),
                };
                let factors: Vec<String> = UNITS.iter().zip(&self.0).filter_map(factor).collect();
                format!("a quantity in {}", factors.join(" "))
            }
        }
    }
}

/// A number in SI units with its dimension. Angles are in radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Quantity {
    /// In SI units.
    pub value: f64,
    /// Of what.
    pub dimension: Dimension,
}

impl Quantity {
    /// `value` in SI units of `dimension`.
    pub const fn new(value: f64, dimension: Dimension) -> Self {
        Self { value, dimension }
    }

    /// A plain number.
    pub const fn plain(value: f64) -> Self {
        Self::new(value, Dimension::NONE)
    }

    /// As a scene would say it, where the language has words for it.
    pub fn write(self) -> String {
        self.dimension.ty().map_or_else(|| self.value.to_string(), |ty| ty.write(self.value))
    }
}

/// A numeral with a unit in SI units; `None` for an unknown unit. Decimal prefixes are divided out where that rounds
/// only once, so that `30cm` is exactly 0.3 m.
pub fn with_unit(value: f64, unit: &str) -> Option<Quantity> {
    let unit = schema::unit(unit)?;
    let (size, dimension) = (unit.size, Dimension::of(unit.of)?);
    let inverse = (1.0 / size).round();
    let decimal = size < 1.0 && 1.0 / inverse == size && dimension != Dimension::ANGLE;
    Some(Quantity::new(if decimal { value / inverse } else { value * size }, dimension))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_add_and_subtract() {
        let speed = Dimension::LENGTH.over(Dimension::TIME);
        assert_eq!(speed.noun(), "a speed");
        assert_eq!(speed.times(Dimension::TIME), Dimension::LENGTH);
        assert_eq!(Dimension::LENGTH.power(2.0).map(Dimension::noun).as_deref(), Some("an area"));
        assert_eq!(Dimension::LENGTH.power(0.5), None);
        assert_eq!(speed.over(Dimension::TIME).noun(), "a quantity in m s^-2");
    }

    #[test]
    fn units_round_once() {
        assert_eq!(with_unit(30.0, "cm"), Some(Quantity::new(0.3, Dimension::LENGTH)));
        assert_eq!(with_unit(1.0, "%"), Some(Quantity::plain(0.01)));
        assert_eq!(with_unit(683.0, "lm"), Some(Quantity::new(1.0, Dimension::POWER)));
        assert_eq!(with_unit(180.0, "deg"), Some(Quantity::new(std::f64::consts::PI, Dimension::ANGLE)));
        assert_eq!(with_unit(1.0, "furlong"), None);
    }
}
