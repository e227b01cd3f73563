//! Intervals of numbers, and how they are said.

use super::Type;

/// The values from `min` to `max`; an open end is left out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Range {
    /// The lower end.
    pub min: f64,
    /// The upper end.
    pub max: f64,
    /// Whether the lower end is left out.
    pub open_min: bool,
    /// Whether the upper end is left out.
    pub open_max: bool,
    /// Whether `check` speaks of it in the words of physics, so that `resolve` need not.
    pub physical: bool,
}

impl Range {
    /// Everything.
    const ALL: Self = Self {
        min: f64::NEG_INFINITY,
        max: f64::INFINITY,
        open_min: false,
        open_max: false,
        physical: false,
    };

    pub(super) const fn at_least(min: f64) -> Self {
        Self { min, ..Self::ALL }
    }

    pub(super) const fn above(min: f64) -> Self {
        Self { min, open_min: true, ..Self::ALL }
    }

    pub(super) const fn closed(min: f64, max: f64) -> Self {
        Self { min, max, ..Self::ALL }
    }

    pub(super) const fn open(min: f64, max: f64) -> Self {
        Self { min, max, open_min: true, open_max: true, ..Self::ALL }
    }

    pub(super) const fn physical(self) -> Self {
        Self { physical: true, ..self }
    }

    /// Whether `value` lies in it; NaN lies in none.
    pub fn contains(&self, value: f64) -> bool {
        let above = if self.open_min { self.min < value } else { self.min <= value };
        let below = if self.open_max { value < self.max } else { value <= self.max };
        above && below
    }

    /// The value in it that is nearest to `value`; `None` where no value is, since the end is left out.
    pub fn nearest(&self, value: f64) -> Option<f64> {
        let (open, end) = match value <= self.min {
            true => (self.open_min, self.min),
            false => (self.open_max, self.max),
        };
        (!open && end.is_finite()).then_some(end)
    }

    /// "at least 1", "greater than 0m", "between 0deg and 180deg", with numbers as `ty` writes them.
    pub fn describe(&self, ty: Type) -> String {
        let (min, max) = (ty.write(self.min), ty.write(self.max));
        match (self.min.is_finite(), self.max.is_finite()) {
            (true, true) if self.open_min && self.open_max => {
                format!("greater than {min} and less than {max}")
            }
            (true, true) => format!("from {min} to {max}"),
            (true, false) if self.open_min => format!("greater than {min}"),
            (true, false) => format!("at least {min}"),
            (false, true) if self.open_max => format!("less than {max}"),
            (false, true) => format!("at most {max}"),
            (false, false) => "anything".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_end_is_outside() {
        assert!(!Range::above(0.0).contains(0.0));
        assert!(Range::at_least(0.0).contains(0.0));
        assert!(!Range::closed(0.0, 1.0).contains(f64::NAN));
        assert_eq!(Range::above(0.0).nearest(-1.0), None);
        assert_eq!(Range::closed(0.0, 1.0).nearest(1.5), Some(1.0));
        assert_eq!(Range::open(0.0, 1.0).describe(Type::Number), "greater than 0 and less than 1");
        assert_eq!(Range::above(0.0).describe(Type::Length), "greater than 0m");
    }
}
