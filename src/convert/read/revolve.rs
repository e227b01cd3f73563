//! Surfaces of revolution and their profiles.

use super::{Mistake, Reader, vocab};
use crate::convert::fields::Part;
use crate::convert::model::{Curve, Profile, Shape};
use crate::convert::parse::{Block, List, Node, Span};

impl Reader<'_> {
    /// `RevSurface { profile CURVE { controls [..] .. } }`, rotated about the y axis.
    pub(super) fn revolve(&mut self, block: Block<'_>) -> Option<Shape> {
        let span = block.head.clone();
        self.log.mapped(&span, "`revolve`");
        let (mut profile, mut has_curve) = (None, false);
        for part in self.log.parts(block.body, vocab::REV_SURFACE) {
            match part {
                Part::Field(field) if field.known => self.log.mapped(&field.span, "`profile`"),
                Part::Field(field) => self.log.unknown_field(&field, "RevSurface", vocab::REV_SURFACE),
                Part::Block(block) => {
                    has_curve = true;
                    profile = self.profile(block).or(profile);
                }
            }
        }
        if !has_curve {
            self.log.notes.note(Mistake::MissingField {
                block: "RevSurface".into(),
                field: "profile",
                at: span.into(),
                help: "add `profile BezierCurve { controls [ 1 0 0 ] .. }`".into(),
            });
        }
        profile.map(|profile| Shape::Revolve { profile })
    }

    fn profile(&mut self, block: Block<'_>) -> Option<Profile> {
        let kind = match block.name() {
            "BezierCurve" => Curve::Bezier,
            "BsplineCurve" => Curve::Bspline,
            _ => {
                self.log.unknown_block(&block, "in `RevSurface`".into(), &["BezierCurve", "BsplineCurve"]);
                return None;
            }
        };
        let mut fields = self.log.fields(block, vocab::CURVE);
        let (curve, head) = (fields.block.clone(), fields.head.clone());
        self.log.mapped(&head, "the kind of profile");
        let controls = self.log.take(&mut fields, "controls");
        self.log.finish(fields);
        let lists = controls.map(|field| {
            self.log.mapped(&field.span, "points of the profile");
            field.lists
        });
        let lists = lists.unwrap_or_default();
        if lists.len() < 4 {
            self.log.notes.note(Mistake::ProfileTooShort { curve, count: lists.len(), at: head.into() });
            return None;
        }
        if kind == Curve::Bezier && lists.len() % 3 != 1 {
            let help =
                "it was read as one curve over all its points; the original wants 4, 7, 10, .. of them";
            self.differs(format!("a Bezier curve of {} points", lists.len()), &head, help);
        }
        let points: Vec<_> = lists.iter().map(|list| self.control_point(list)).collect();
        let points: Option<Vec<_>> = points.into_iter().collect(); // after the mistakes of all of them
        Some(Profile { kind, points: self.outward(points?, &head) })
    }

    /// `[ x y 0 ]`: distance from the axis and height.
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
        let found = match list.items.iter().find(|item| !matches!(item, Node::Number(_))) {
            Some(Node::Word(word)) => format!("`{}` is none", word.text),
            _ => format!("this one has {}", list.items.len()),
        };
        match numbers[..] {
            [x, y, 0.0] if list.items.len() == 3 => Some((x, y)),
            [_, _, z] if list.items.len() == 3 => {
                self.log.notes.note(Mistake::ProfileOffPlane { z, at });
                None
            }
            _ => {
                self.log.notes.note(Mistake::MissingNumber {
                    key: "[ .. ]".into(),
                    wanted: "3 numbers".into(),
                    found,
                    at,
                    help: "a control point is `[ x y 0 ]`".into(),
                });
                None
            }
        }
    }

    /// Turns a profile on the left of the axis to the right, which makes the same surface.
    fn outward(&mut self, mut points: Vec<(f64, f64)>, at: &Span) -> Vec<(f64, f64)> {
        let (left, right) = (points.iter().any(|p| p.0 < 0.0), points.iter().any(|p| p.0 > 0.0));
        if left && right {
            let help = "a distance from the axis is never below 0: move the points to one side";
            self.bad_value("this profile crosses its axis", at, help);
        }
        if left && !right {
            for point in &mut points {
                point.0 = 0.0 - point.0;
            }
        }
        points
    }
}
