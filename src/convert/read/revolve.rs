//! Surfaces of revolution and their profiles.

use super::{Mistake, Reader};
use crate::convert::fields::Fields;
use crate::convert::model::{Curve, Profile, Shape};
use crate::convert::parse::{Block, List, Node, Span};
use crate::convert::words::CURVE;

/// How many straight pieces stand for a curve that the scene language cannot say.
const PIECES: usize = 128;

/// The longest profile of one Bezier curve that is evaluated exactly; beyond, its binomials lose their digits.
const MAX_BEZIER_POINTS: usize = 64;

impl Reader<'_> {
    /// `RevSurface { profile CURVE { controls [..] .. } }`, rotated about the y axis.
    pub(super) fn revolve(&mut self, fields: &mut Fields<'_>) -> Option<Shape> {
        let span = fields.head.clone();
        self.log.mapped(&span, "`revolve`");
        if let Some(field) = self.log.take(fields, "profile") {
            self.log.mapped(&field.span, "`profile`");
        }
        let is_curve = |name: &str| name.to_ascii_lowercase().contains("curve");
        let Some(curve) = fields.take_block(is_curve) else {
            self.log.notes.note(Mistake::MissingField {
                block: "RevSurface".into(),
                field: "profile",
                at: span.into(),
                help: "add `profile BezierCurve { controls [ 1 0 0 ] .. }`".into(),
            });
            return None;
        };
        let profile = self.profile(curve);
        profile.map(|profile| Shape::Revolve { profile })
    }

    fn profile(&mut self, block: Block<'_>) -> Option<Profile> {
        let is_bezier = block.name().to_ascii_lowercase().contains("bezier");
        let kind = if is_bezier { Curve::Bezier } else { Curve::Bspline };
        let mut fields = self.log.fields(block, &CURVE);
        let (curve, head) = (fields.block.clone(), fields.head.clone());
        self.log.mapped(&head, "the kind of profile");
        let controls = self.log.take(&mut fields, "controls");
        self.log.finish(fields);
        let lists = controls.map(|field| {
            self.log.mapped(&field.span, "points of the profile");
            field.lists
        });
        let lists = lists.unwrap_or_default();
        let points: Vec<_> = lists.iter().filter_map(|list| self.control_point(list)).collect();
        let fewest = if kind == Curve::Bezier { 2 } else { 4 };
        if lists.len() < 4 {
            let at = head.clone().into();
            self.log.notes.note(Mistake::ProfileTooShort { curve, count: lists.len(), at });
        }
        if points.len() < fewest {
            return None;
        }
        if kind == Curve::Bezier && points.len() % 3 != 1 {
            let help =
                "it was read as one curve over all its points; the original wants 4, 7, 10, .. of them";
            self.log.differs(format!("a Bezier curve of {} points", points.len()), &head, help);
        }
        if points.iter().all(|point| point.0 == 0.0) || points.iter().all(|point| *point == points[0]) {
            let what = "a profile that makes no surface";
            self.log.not_convertible(what, &head, "its points lie on the axis, or are all one; left out");
            return None;
        }
        self.outward(Profile { kind, points }, &head)
    }

    /// `[ x y 0 ]`: distance from the axis and height. What is no point is left out.
    fn control_point(&mut self, list: &List<'_>) -> Option<(f64, f64)> {
        let numbers: Vec<f64> = list
            .items
            .iter()
            .filter_map(|item| match item {
                Node::Number(number) => Some(number.value),
                _ => None,
            })
            .collect();
        let at = list.span.clone().into();
        match numbers[..] {
            [x, y] | [x, y, 0.0] if list.items.len() == numbers.len() => Some((x, y)),
            [x, y, z] if list.items.len() == 3 => {
                self.log.notes.note(Mistake::ProfileOffPlane { z, at });
                Some((x, y))
            }
            _ => {
                let found = match list.items.iter().find(|item| !matches!(item, Node::Number(_))) {
                    Some(Node::Word(word)) => format!("`{}` is none", word.text),
                    _ => format!("this one has {}", list.items.len()),
                };
                self.log.notes.note(Mistake::MissingNumber {
                    key: "[ .. ]".into(),
                    wanted: "3 numbers".into(),
                    found,
                    at,
                    help: "a control point is `[ x y 0 ]`; this one was left out".into(),
                });
                None
            }
        }
    }

    /// Brings a profile to the right of the axis, which makes the same surface: by turning it over where it is on the
    /// left as a whole, else point by point, as a line of many pieces.
    fn outward(&mut self, mut profile: Profile, at: &Span) -> Option<Profile> {
        let is_left = |p: &(f64, f64)| p.0 < 0.0;
        if !profile.points.iter().any(is_left) {
            return Some(profile);
        }
        for point in &mut profile.points {
            point.0 = 0.0 - point.0;
        }
        if !profile.points.iter().any(is_left) {
            return Some(profile);
        }
        if profile.kind == Curve::Bezier && profile.points.len() > MAX_BEZIER_POINTS {
            self.log.not_convertible("this profile", at, "it crosses its axis, and has very many points");
            return None;
        }
        self.log.approximated(at, "a line of many pieces, for the curve crosses its axis");
        let on_curve = |i: usize| {
            let (x, y) = profile.at(i as f64 / PIECES as f64);
            (x.abs(), y)
        };
        Some(Profile { kind: Curve::Polyline, points: (0..=PIECES).map(on_curve).collect() })
    }
}

impl Profile {
    /// The point at parameter t in 0..=1.
    fn at(&self, t: f64) -> (f64, f64) {
        match self.kind {
            Curve::Bezier => self.on_bezier(t),
            Curve::Bspline => self.on_bspline(t),
            Curve::Polyline => self.points[((self.points.len() - 1) as f64 * t) as usize],
        }
    }

    /// De Casteljau's construction.
    fn on_bezier(&self, t: f64) -> (f64, f64) {
        let mut points = self.points.clone();
        while points.len() > 1 {
            let between = |pair: &[(f64, f64)]| {
                (pair[0].0 + t * (pair[1].0 - pair[0].0), pair[0].1 + t * (pair[1].1 - pair[0].1))
            };
            points = points.windows(2).map(between).collect();
        }
        points[0]
    }

    /// The uniform cubic B-spline, n - 3 pieces of four points each.
    fn on_bspline(&self, t: f64) -> (f64, f64) {
        let pieces = self.points.len() - 3;
        let piece = ((t * pieces as f64) as usize).min(pieces - 1);
        let u = t * pieces as f64 - piece as f64;
        let v = 1.0 - u;
        let weights = [
            v * v * v / 6.0,
            (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
            (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0,
            u * u * u / 6.0,
        ];
        let sum = |pick: fn(&(f64, f64)) -> f64| -> f64 {
            weights.iter().zip(&self.points[piece..]).map(|(weight, point)| weight * pick(point)).sum()
        };
        (sum(|point| point.0), sum(|point| point.1))
    }
}
