//! What a function of the language is declared with.

use super::Type;

/// A function of the language: one that computes, or one that makes a transform, a colour, a filter ...
#[derive(Debug)]
pub struct Function {
    /// Its name.
    pub name: &'static str,
    /// What it is for.
    pub topic: Topic,
    /// The ways to call it: the arguments of each.
    pub forms: &'static [&'static [Arg]],
    /// What comes out, with its article: "an angle".
    pub result: &'static str,
    /// What it does, in one sentence.
    pub doc: &'static str,
    /// How it is computed, for whoever wants the same numbers elsewhere.
    pub method: Option<&'static str>,
    /// For which arguments it is defined, where not for all.
    pub domain: Option<&'static str>,
    /// A call of it.
    pub example: &'static str,
}

/// What functions are for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "each is its word")]
pub enum Topic {
    Numbers,
    Angles,
    Vectors,
    Chance,
    Lists,
    Colors,
    Textures,
    Transforms,
    Curves,
    Filters,
    Stops,
}

impl Topic {
    /// All of them, in the order of the reference.
    pub const ALL: [Self; 11] = [
        Self::Numbers,
        Self::Angles,
        Self::Vectors,
        Self::Lists,
        Self::Chance,
        Self::Colors,
        Self::Textures,
        Self::Transforms,
        Self::Curves,
        Self::Filters,
        Self::Stops,
    ];

    /// What stands above its functions.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Numbers => "numbers",
            Self::Angles => "angles",
            Self::Vectors => "points and vectors",
            Self::Chance => "chance",
            Self::Lists => "lists",
            Self::Colors => "colours",
            Self::Textures => "textures",
            Self::Transforms => "transforms",
            Self::Curves => "curves and outlines",
            Self::Filters => "pixel filters",
            Self::Stops => "rules to stop by",
        }
    }
}

/// An argument of a function.
#[derive(Clone, Copy, Debug)]
pub struct Arg {
    /// The name under which it may be given.
    pub name: &'static str,
    /// What may stand there.
    pub takes: Takes,
    /// How often it is given.
    pub times: Times,
}

/// What may stand for an argument.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Takes {
    /// A value of this type.
    Of(Type),
    /// A number of any unit; the same for all arguments that say so.
    Alike,
    /// A number of any unit.
    Number,
    /// Two or three numbers in parentheses, of any one unit.
    Tuple,
    /// Whatever can be added and multiplied by a number: numbers, points, colours.
    Mixable,
    /// Points in the plane, in brackets.
    Points,
}

impl Takes {
    /// What is wanted, with its article.
    pub fn noun(self) -> String {
        match self {
            Self::Of(ty) => ty.noun(),
            Self::Alike => "a number of the same unit as the others".to_owned(),
            Self::Number => "a number".to_owned(),
            Self::Tuple => "a vector".to_owned(),
            Self::Mixable => "a number, a point or a colour".to_owned(),
            Self::Points => "a list of points".to_owned(),
        }
    }

    /// Whether a value in parentheses is wanted.
    pub const fn is_tuple(self) -> bool {
        matches!(self, Self::Tuple | Self::Of(Type::Point | Type::Offset | Type::Vector | Type::Pair))
    }
}

/// How often an argument is given.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Times {
    /// Once.
    Once,
    /// Once or not at all.
    Perhaps,
    /// Once or more.
    Often,
}

/// The most arguments that a call of a function takes.
const MOST: usize = 64;

impl Function {
    /// The fewest and the most arguments of a form.
    pub fn count(form: &[Arg]) -> (usize, usize) {
        let least = form.iter().filter(|arg| arg.times != Times::Perhaps).count();
        let endless = form.iter().any(|arg| arg.times == Times::Often);
        (least, if endless { MOST } else { form.len() })
    }

    /// A form as it is called: `look_at(from, to[, up])`.
    pub fn signature(&self, form: &[Arg]) -> String {
        let mut text = format!("{}(", self.name);
        for (i, arg) in form.iter().enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            match arg.times {
                Times::Once => text.extend([comma, arg.name]),
                Times::Perhaps => text.extend(["[", comma, arg.name, "]"]),
                Times::Often => text.extend([comma, arg.name, ", .."]),
            }
        }
        text.push(')');
        text
    }
}
