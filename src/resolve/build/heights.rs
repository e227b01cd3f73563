//! The heights of a heightfield: of a picture, of rows of numbers, or of a function.

use crate::ir::{Heights, TextureKind};
use crate::resolve::error::Error;
use crate::resolve::fields::Fields;
use crate::resolve::value::Function;
use crate::resolve::{Resolver, Value};
use crate::source::{Span, Spanned};

/// More points than this are no heightfield but a mistake.
const MOST: usize = 16_000_000;

impl<'a> Resolver<'a> {
    pub(super) fn heights(&mut self, fields: &Fields<'a>) -> Option<Heights> {
        let Spanned { value, span } = fields.value("heights")?.clone();
        match value {
            Value::Texture(handle) => {
                if matches!(self.scene.textures[handle].kind, TextureKind::Image(_)) {
                    return Some(Heights::Image(Spanned::new(handle, span)));
                }
                let help = "write `image(\"hills.png\")`";
                self.wrong_type("a picture, rows of numbers or a function", "another texture", span, help);
                None
            }
            Value::List(rows) => self.rows(&rows, span),
            Value::Function(function) => {
                let (width, height) = match fields.value("resolution") {
                    Some(Spanned { value: Value::Size(width, height), .. }) => (*width, *height),
                    _ => fields.size("resolution")?.value,
                };
                let used = fields.span("resolution").unwrap_or(span);
                self.sampled(&function, [width as usize, height as usize], used, span)
            }
            _ => None,
        }
    }

    fn rows(&mut self, rows: &[Value<'a>], span: Span) -> Option<Heights> {
        let help = "write rows of the same length, such as `[[0, 0, 0], [0, 1, 0], [0, 0, 0]]`";
        let (mut values, mut width) = (Vec::new(), None);
        for row in rows {
            let Value::List(row) = row else {
                self.wrong_type("a list of rows of numbers", &format!("one of {}", row.noun()), span, help);
                return None;
            };
            if *width.get_or_insert(row.len()) != row.len() {
                self.wrong_type("a list of rows of the same length", "a list of different ones", span, help);
                return None;
            }
            for value in row.iter() {
                let value = self.coerce(value.clone(), crate::schema::Type::Number, span);
                let Value::Number(number) = value else { return None };
                values.push(number.value as f32);
            }
        }
        let width = width.unwrap_or(0);
        if width < 2 || rows.len() < 2 {
            self.wrong_type("a list of two rows of two numbers or more", "a shorter one", span, help);
            return None;
        }
        Some(Heights::Grid { width, values, span })
    }

    /// A function at the points of a grid: its arguments go from 0 to 1, along x and from the first row to the last.
    fn sampled(
        &mut self,
        function: &Function<'a>,
        [width, height]: [usize; 2],
        resolution: Span,
        span: Span,
    ) -> Option<Heights> {
        if width < 2 || height < 2 || width * height > MOST {
            let (field, found) = ("resolution".to_owned(), format!("`{width} x {height}`"));
            let range = "at least 2 x 2, and at most 16 million points".to_owned();
            let help = "write for example `resolution: 128 x 128`".to_owned();
            self.report(Error::OutOfRange { field, range, found, used: resolution, said: None, help });
            return None;
        }
        let share = |i: usize, count: usize| Value::number(i as f64 / (count - 1) as f64);
        let mut values = Vec::with_capacity(width * height);
        for (i, j) in (0..height).flat_map(|j| (0..width).map(move |i| (i, j))) {
            let value = self.call_with(function, &[share(i, width), share(j, height)], span);
            let Value::Number(number) = self.coerce(value, crate::schema::Type::Number, span) else {
                return None;
            };
            values.push(number.value as f32);
        }
        Some(Heights::Grid { width, values, span })
    }
}
