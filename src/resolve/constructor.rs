//! Functions that make transforms, curves, filters and rules to stop by.

use super::error::Error;
use super::{Env, Resolver, Value};
use crate::diag::did_you_mean;
use crate::ir::{self, CurveKind, Filter, Stop, TransformStep};
use crate::math::motion::Factor;
use crate::math::{DAffine3, DMat3, DVec3};
use crate::schema::{self, Topic, Type};
use crate::source::{Span, Spanned};
use crate::syntax::ast::{Arg, Expr, ExprKind, Name};

impl<'a> Resolver<'a> {
    /// The result of a constructor whose arguments have the right types already.
    pub(super) fn construct(&mut self, name: &str, args: &[Spanned<Value<'a>>], used: Span) -> Value<'a> {
        let first = &args[0];
        let x = match first.value {
            Value::Number(quantity) => quantity.value,
            _ => 0.0,
        };
        if matches!(name, "samples" | "passes") && x < 0.0 {
            let (found, range, help) =
                (format!("`{x}`"), "at least 1".to_owned(), format!("write `{name}(64)`"));
            let field = name.to_owned();
            return self.poison(Error::OutOfRange {
                field,
                range,
                found,
                used: first.span,
                said: None,
                help,
            });
        }
        let said = Spanned::new(x, used);
        let count = said.map(|x| x as u32);
        match name {
            "samples" | "passes" => Value::Stop(Stop { passes: Some(count), ..Stop::default() }),
            "time" => Value::Stop(Stop { seconds: Some(said), ..Stop::default() }),
            "error" => Value::Stop(Stop { error: Some(said), ..Stop::default() }),
            "box" => Value::Filter(Filter::Box(x)),
            "tent" => Value::Filter(Filter::Tent(x)),
            "gaussian" => Value::Filter(Filter::Gaussian(x)),
            "mitchell" => Value::Filter(Filter::Mitchell(x)),
            "blackman_harris" => Value::Filter(Filter::BlackmanHarris(x)),
            "image" => self.image_file(first, used),
            "moving" => self.moving(args, used),
            _ => match self.factor_of(name, args, x) {
                Some(factor) => Value::Transform([TransformStep { factor, span: used }].into()),
                None => Value::Poison,
            },
        }
    }

    fn factor_of(&mut self, name: &str, args: &[Spanned<Value<'a>>], x: f64) -> Option<Factor> {
        match name {
            "translate" => Some(Factor::still(DAffine3::from_translation(three(args)?))),
            "scale" => match args {
                [Spanned { value: Value::Number(_), .. }] => {
                    Some(Factor::still(DAffine3::from_scale(DVec3::splat(x))))
                }
                _ => Some(Factor::still(DAffine3::from_scale(three(args)?))),
            },
            "rotate_x" => Some(Factor::turned(DVec3::X, x)),
            "rotate_y" => Some(Factor::turned(DVec3::Y, x)),
            "rotate_z" => Some(Factor::turned(DVec3::Z, x)),
            "rotate" => {
                let axis = self.unit(&args[0])?;
                let Value::Number(angle) = args[1].value else { return None };
                Some(Factor::turned(axis, angle.value))
            }
            "look_at" => self.looking(args).map(Factor::still),
            _ => self.sixteen(&args[0]).map(Factor::still),
        }
    }

    /// The way from one transform to another; both must stand still.
    fn moving(&mut self, args: &[Spanned<Value<'a>>], used: Span) -> Value<'a> {
        let mut ends = [Vec::new(), Vec::new()];
        for (end, arg) in ends.iter_mut().zip(args) {
            let Value::Transform(steps) = &arg.value else { return Value::Poison };
            if steps.iter().any(|step| !step.factor.is_still()) {
                let help = "give it two transforms that stand still; motions follow each other with `then`";
                return self.wrong_type("a transform that stands still", "one that moves", arg.span, help);
            }
            end.extend(steps.iter().map(|step| step.factor));
        }
        let [from, to] = ends;
        let factors = Factor::between(&from, &to).into_iter();
        Value::Transform(factors.map(|factor| TransformStep { factor, span: used }).collect())
    }

    fn unit(&mut self, vector: &Spanned<Value<'a>>) -> Option<DVec3> {
        let unit = vector.triple()?.try_normalize();
        if unit.is_none() {
            let why = "a vector of length 0 has no direction".to_owned();
            let help = "write an axis such as `(0, 1, 0)`".to_owned();
            self.report(Error::NotFinite { why, used: vector.span, help });
        }
        unit
    }

    /// Puts the object's origin at `from`, with its −z axis towards `to`.
    fn looking(&mut self, args: &[Spanned<Value<'a>>]) -> Option<DAffine3> {
        let (from, to) = (args[0].triple()?, args[1].triple()?);
        let up = args.get(2).map_or(Some(DVec3::Y), |up| up.triple())?;
        let z = (from - to).try_normalize();
        let x = z.and_then(|z| up.cross(z).try_normalize());
        let (Some(z), Some(x)) = (z, x) else {
            let why = "the two points coincide, or `up` points along them".to_owned();
            let help = "move them apart, or choose another `up`".to_owned();
            self.report(Error::NotFinite { why, used: args[0].span.to(args[args.len() - 1].span), help });
            return None;
        };
        Some(DAffine3 { matrix3: DMat3::from_cols(x, z.cross(x), z), translation: from })
    }

    /// Sixteen numbers, row by row; the last row is 0 0 0 1. Translations may be lengths.
    fn sixteen(&mut self, list: &Spanned<Value<'a>>) -> Option<DAffine3> {
        let Value::List(parts) = &list.value else { return None };
        let number = |value: &Value| match value {
            Value::Number(quantity) => Some(quantity.value),
            _ => None,
        };
        let numbers: Vec<f64> = parts.iter().filter_map(number).collect();
        let affine = numbers.len() == 16 && numbers[12..] == [0.0, 0.0, 0.0, 1.0];
        if !affine || parts.len() != 16 {
            let help = "write the rows one after the other; the last is `0, 0, 0, 1`";
            self.wrong_type("a list of 16 numbers that end in 0, 0, 0, 1", "another list", list.span, help);
            return None;
        }
        let column = |c: usize| DVec3::new(numbers[c], numbers[4 + c], numbers[8 + c]);
        Some(DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) })
    }

    /// `bezier [..]`, `polygon [..]`: a word that says how points are joined.
    pub(super) fn tagged(&mut self, tag: &'a Name, value: &'a Expr, env: &Env<'a>) -> Value<'a> {
        let Some(kind) = curve_kind(tag) else {
            let curves = curve_names();
            let help = did_you_mean(tag, curves.iter().copied())
                .unwrap_or_else(|| format!("the words before a list are {}", schema::quoted(&curves)));
            let wanted = "a way to join points".to_owned();
            return self.poison(Error::UnknownWord { word: tag.value.clone(), wanted, used: tag.span, help });
        };
        self.curve(kind, value, tag.span.to(value.span), env)
    }

    /// `bezier(degree: all, [..])` and the other words as calls; `None`: it is no such call.
    pub(super) fn curve_call(
        &mut self,
        name: &str,
        args: &'a [Arg],
        used: Span,
        env: &Env<'a>,
    ) -> Option<Value<'a>> {
        let mut kind = curve_kind(name)?;
        let mut points = None;
        for arg in args {
            match (&arg.name, &arg.value.kind) {
                (Some(degree), ExprKind::Name(all)) if degree.value == "degree" && all == "all" => {
                    kind = CurveKind::BezierOneCurve;
                }
                (Some(degree), ExprKind::Name(word)) if degree.value == "degree" => {
                    let (wanted, used) = ("`all`".to_owned(), arg.value.span);
                    let help =
                        did_you_mean(word, ["all"]).unwrap_or_else(|| "write `degree: all`".to_owned());
                    return Some(self.poison(Error::UnknownWord { word: word.clone(), wanted, used, help }));
                }
                (None, _) => points = Some(&arg.value),
                (Some(other), _) => {
                    let (function, help) = (name.to_owned(), "write `bezier(degree: all, [..])`".to_owned());
                    let name = other.value.clone();
                    return Some(self.poison(Error::UnknownArgument {
                        function,
                        name,
                        used: other.span,
                        help,
                    }));
                }
            }
        }
        Some(match points {
            Some(points) => self.curve(kind, points, used, env),
            None => {
                let (function, wanted) = (name.to_owned(), "a list of points".to_owned());
                let help = format!("write `{name} [(0m, 0m), ..]`");
                self.poison(Error::ArgumentCount { function, wanted, found: args.len(), used, help })
            }
        })
    }

    /// In the plane or in space, as the points have two parts or three.
    fn curve(&mut self, kind: CurveKind, points: &'a Expr, span: Span, env: &Env<'a>) -> Value<'a> {
        let written = match &points.kind {
            ExprKind::List(parts) => parts
                .iter()
                .map(|part| self.written_point(part, env))
                .collect::<Vec<_>>()
                .into_iter()
                .collect(),
            _ => self.computed_points(points, env),
        };
        let Some(written): Option<Vec<(DVec3, usize)>> = written else { return Value::Poison };
        let in_space = written.iter().filter(|(_, parts)| *parts == 3).count();
        if in_space == 0 {
            let points = written.into_iter().map(|(p, _)| p.truncate()).collect();
            return Value::Curve(ir::Curve { kind, points, span }.into());
        }
        if in_space < written.len() {
            let help = "give all points two lengths, or all of them three";
            return self.wrong_type(
                "a list of points of one kind",
                "one of both the plane and space",
                span,
                help,
            );
        }
        let points = written.into_iter().map(|(p, _)| p).collect();
        Value::Path(ir::Path { kind, points, span }.into())
    }

    /// A point, and how many parts it has.
    fn written_point(&mut self, point: &'a Expr, env: &Env<'a>) -> Option<(DVec3, usize)> {
        if let ExprKind::Tuple(parts) = &point.kind
            && matches!(parts.len(), 2 | 3)
        {
            return Some((self.tuple_as(parts, Type::Length, env).triple()?, parts.len()));
        }
        let value = self.eval(point, env);
        self.point_of(value, point.span)
    }

    fn computed_points(&mut self, list: &'a Expr, env: &Env<'a>) -> Option<Vec<(DVec3, usize)>> {
        let Value::List(parts) = self.eval_as(list, Type::List, env) else { return None };
        parts.iter().map(|part| self.point_of(part.clone(), list.span)).collect()
    }

    fn point_of(&mut self, value: Value<'a>, span: Span) -> Option<(DVec3, usize)> {
        match value {
            Value::Poison => None,
            Value::Tuple(parts) if matches!(parts.len(), 2 | 3) => {
                self.doubt_tuple(&parts, span);
                let lengths = parts.iter().map(|part| self.coerce(part.clone(), Type::Length, span));
                let lengths: Vec<Value> = lengths.collect();
                Some((Value::Tuple(lengths.into()).triple()?, parts.len()))
            }
            other => {
                let help = "points of curves have two lengths, such as `(4cm, 10cm)`";
                self.wrong_type("a point in the plane", &other.noun(), span, help);
                None
            }
        }
    }
}

/// Three numbers as arguments, or as one tuple.
fn three(args: &[Spanned<Value>]) -> Option<DVec3> {
    match args {
        [tuple] => tuple.triple(),
        _ => Value::Tuple(args.iter().map(|arg| arg.value.clone()).collect()).triple(),
    }
}

/// The words before a list of points.
fn curve_names() -> Vec<&'static str> {
    schema::functions().filter(|f| f.topic == Topic::Curves).map(|f| f.name).collect()
}

/// Whether a word says how points are joined.
pub fn is_curve(word: &str) -> bool {
    curve_kind(word).is_some()
}

fn curve_kind(word: &str) -> Option<CurveKind> {
    Some(match word {
        "bezier" => CurveKind::Bezier,
        "bspline" => CurveKind::Bspline,
        "polyline" | "polygon" => CurveKind::Polyline,
        _ => return None,
    })
}
