//! The faults that a file may get: each a change of its text, with where it is and what a report should say of it.

use super::corpus::{Scene, SceneFile};
use super::random::Random;
use super::roles::{FieldSite, Role, holds_name};
use super::tokens::{Kind as Token, Token as TokenAt};
use super::typo::typo;
use snell::syntax::ast::ExprKind;
use std::ops::Range;

/// The kinds of faults.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    Keyword,
    Block,
    Field,
    Name,
    Unit,
    Word,
    Brace,
    Bracket,
    Comma,
    Colon,
    Quote,
    Type,
    Dimension,
    Arity,
    MissingFile,
    Range,
    Duplicate,
    Cycle,
}

impl Kind {
    /// Whether such a fault is one wherever it stands, evaluated or not.
    const fn is_of_syntax(self) -> bool {
        use Kind::{Brace, Bracket, Colon, Comma, Cycle, Keyword, Quote};
        matches!(self, Brace | Bracket | Colon | Comma | Cycle | Keyword | Quote)
    }

    /// Every kind, with what the table calls it.
    pub const ALL: [(Self, &'static str); 18] = [
        (Self::Keyword, "typo in a keyword"),
        (Self::Block, "typo in the kind of a block"),
        (Self::Field, "typo in a field or argument"),
        (Self::Name, "typo in a name"),
        (Self::Unit, "typo in a unit"),
        (Self::Word, "typo in one of a few words"),
        (Self::Brace, "brace dropped or doubled"),
        (Self::Bracket, "`(`, `)`, `[` or `]` dropped or doubled"),
        (Self::Comma, "comma dropped or doubled"),
        (Self::Colon, "colon dropped or doubled"),
        (Self::Quote, "quote dropped or doubled"),
        (Self::Type, "value of another type"),
        (Self::Dimension, "unit of another dimension, or none"),
        (Self::Arity, "argument or coordinate too few or too many"),
        (Self::MissingFile, "file that is not there"),
        (Self::Range, "number out of range"),
        (Self::Duplicate, "field or definition twice"),
        (Self::Cycle, "file that includes itself"),
    ];
}

/// A fault in a file of a scene. All ranges are bytes of the text without it.
#[derive(Clone, Debug)]
pub struct Fault {
    /// Its kind.
    pub kind: Kind,
    /// The index of the file in its scene.
    pub file: usize,
    /// What is replaced.
    pub at: Range<usize>,
    /// By what.
    pub by: String,
    /// Where a person would look for it: the primary label has to touch this.
    pub place: Range<usize>,
    /// What it breaks: some label has to touch this.
    pub construct: Range<usize>,
    /// What would mend it.
    pub cure: Cure,
    /// Where no other fault may be, so that each is a mistake of its own.
    pub claim: Range<usize>,
}

/// What a report should propose.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Cure {
    /// Nothing restores what was there.
    None,
    /// This word.
    Word(String),
    /// This sign, where it was.
    Sign(&'static str),
    /// To take something away.
    Removal,
}

/// A fault of this kind at a random place of a file, if there is a place for one.
pub fn fault(kind: Kind, scene: &Scene, file: usize, random: &mut Random) -> Option<Fault> {
    let site = Site { scene, index: file, file: &scene.files[file] };
    let fault = site.fault(kind, random)?;
    let is_idle = |branch: &Range<usize>| branch.start < fault.at.start && fault.at.end < branch.end;
    (kind.is_of_syntax() || !site.file.roles.idle.iter().any(is_idle)).then_some(fault)
}

/// The words that begin or join items and expressions.
const KEYWORDS: [&str; 19] = [
    "snell", "let", "param", "for", "in", "fn", "place", "import", "include", "as", "at", "units", "if",
    "else", "then", "per", "on", "and", "or",
];

/// Functions that take neither fewer nor more arguments than they are given in a well-formed scene, mostly.
const FIXED: [&str; 15] = [
    "sin", "cos", "tan", "sqrt", "rgb", "srgb", "hsv", "rotate_x", "rotate_y", "rotate_z", "rotate",
    "samples", "passes", "time", "lerp",
];

/// Fields that take three coordinates, never two.
const TRIPLES: [&str; 14] = [
    "center",
    "position",
    "look_at",
    "direction",
    "up",
    "origin",
    "edge_u",
    "edge_v",
    "min",
    "max",
    "normal",
    "a",
    "b",
    "c",
];

/// A file to put a fault into.
struct Site<'a> {
    scene: &'a Scene,
    index: usize,
    file: &'a SceneFile,
}

impl Site<'_> {
    fn fault(&self, kind: Kind, random: &mut Random) -> Option<Fault> {
        match kind {
            Kind::Keyword => self.keyword(random),
            Kind::Block => self.typo(kind, Role::Block, random),
            Kind::Field => self.typo(kind, Role::Field, random),
            Kind::Name => self.typo(kind, Role::Name, random),
            Kind::Unit => self.typo(kind, Role::Unit, random),
            Kind::Word => self.typo(kind, Role::Word, random),
            Kind::Brace => self.bracket(kind, "{}", random),
            Kind::Bracket => self.bracket(kind, "()[]", random),
            Kind::Comma => self.comma(random),
            Kind::Colon => self.colon(random),
            Kind::Quote => self.quote(random),
            Kind::Type => self.wrong_type(random),
            Kind::Dimension => self.wrong_dimension(random),
            Kind::Arity => self.arity(random),
            Kind::MissingFile => self.missing_file(random),
            Kind::Range => self.out_of_range(random),
            Kind::Duplicate => self.duplicate(random),
            Kind::Cycle => Some(self.cycle()),
        }
    }

    fn text(&self, range: &Range<usize>) -> &str {
        &self.file.text[range.clone()]
    }

    /// The lines that a range touches.
    fn lines(&self, range: &Range<usize>) -> Range<usize> {
        let text = &self.file.text;
        let start = text[..range.start].rfind('\n').map_or(0, |end| end + 1);
        start..text[range.end..].find('\n').map_or(text.len(), |length| range.end + length)
    }

    /// The item of the file around a range.
    fn item(&self, range: &Range<usize>) -> Range<usize> {
        let around = |item: &&Range<usize>| item.start <= range.start && range.end <= item.end;
        self.file.roles.items.iter().find(around).cloned().unwrap_or_else(|| self.lines(range))
    }

    /// A fault within a line.
    fn local(&self, kind: Kind, at: Range<usize>, by: String, place: Range<usize>, cure: Cure) -> Fault {
        let claim = self.lines(&(place.start.min(at.start)..place.end.max(at.end)));
        Fault { kind, file: self.index, at, by, construct: place.clone(), place, cure, claim }
    }

    fn typo(&self, kind: Kind, role: Role, random: &mut Random) -> Option<Fault> {
        let words: Vec<&Range<usize>> = self
            .file
            .roles
            .words
            .values()
            .filter(|(_, found)| *found == role)
            .map(|(range, _)| range)
            .collect();
        let range = (*random.pick(&words)?).clone();
        let word = self.text(&range).to_owned();
        let wrong = typo(&word, &self.scene.known, random)?;
        Some(self.local(kind, range.clone(), wrong, range, Cure::Word(word)))
    }

    fn keyword(&self, random: &mut Random) -> Option<Fault> {
        let is_free = |token: &&TokenAt| {
            token.kind == Token::Word
                && KEYWORDS.contains(&self.text(&token.range))
                && !self.file.roles.words.contains_key(&token.range.start)
        };
        let words: Vec<&TokenAt> = self.file.tokens.iter().filter(is_free).collect();
        let range = random.pick(&words)?.range.clone();
        let word = self.text(&range).to_owned();
        let wrong = typo(&word, &self.scene.known, random)?;
        let construct = self.item(&range);
        Some(Fault { construct, ..self.local(Kind::Keyword, range.clone(), wrong, range, Cure::Word(word)) })
    }

    /// The tokens before and after one, and all between.
    fn around(&self, token: usize) -> Range<usize> {
        let tokens = &self.file.tokens;
        let before = token.checked_sub(1).map_or(0, |before| tokens[before].range.start);
        before..tokens.get(token + 1).map_or(self.file.text.len(), |after| after.range.end)
    }

    /// One of the tokens that `is_meant` says.
    fn pick(&self, random: &mut Random, is_meant: impl Fn(usize, &TokenAt) -> bool) -> Option<usize> {
        let tokens = self.file.tokens.iter().enumerate();
        let meant: Vec<usize> =
            tokens.filter(|(index, token)| is_meant(*index, token)).map(|(index, _)| index).collect();
        random.pick(&meant).copied()
    }

    /// Drops or doubles the sign that a token is.
    fn sign(
        &self,
        kind: Kind,
        token: usize,
        sign: &'static str,
        may_drop: bool,
        random: &mut Random,
    ) -> Fault {
        let range = self.file.tokens[token].range.clone();
        if may_drop && random.below(2) == 0 {
            return self.local(kind, range, String::new(), self.around(token), Cure::Sign(sign));
        }
        let end = range.end;
        self.local(kind, end..end, sign.to_owned(), range, Cure::Removal)
    }

    fn bracket(&self, kind: Kind, which: &'static str, random: &mut Random) -> Option<Fault> {
        let token = self.pick(random, |index, token| {
            which.contains(self.text(&token.range)) && token.partner.is_some() && !self.is_raw(index)
        })?;
        let TokenAt { range, partner, .. } = &self.file.tokens[token];
        let at = which.find(self.text(range))?;
        let fault = self.sign(kind, token, &which[at..=at], true, random);
        let partner = partner.expect("it was asked for");
        let construct = self.around(token.min(partner)).start..self.around(token.max(partner)).end;
        let claim = if kind == Kind::Brace { self.lines(&self.item(range)) } else { self.lines(&construct) };
        Some(Fault { construct, claim, ..fault })
    }

    /// Whether a token lies in a `data [..]` or `allow(..)`, where other rules hold.
    fn is_raw(&self, token: usize) -> bool {
        let tokens = &self.file.tokens;
        let open = match tokens[token].kind {
            Token::Open => Some(token),
            Token::Close => tokens[token].partner,
            _ => tokens[token].inside,
        };
        let before = open.and_then(|open| open.checked_sub(1));
        before.is_some_and(|before| ["data", "allow"].contains(&self.text(&tokens[before].range)))
    }

    /// A comma that a line end cannot stand in for.
    fn comma(&self, random: &mut Random) -> Option<Fault> {
        let tokens = &self.file.tokens;
        let token =
            self.pick(random, |index, token| self.text(&token.range) == "," && !self.is_raw(index))?;
        let next = tokens.get(token + 1)?;
        let between = &self.file.text[tokens[token].range.end..next.range.start];
        let in_block = tokens[token].inside.is_none_or(|open| self.text(&tokens[open].range) == "{");
        let before_field = matches!(self.file.roles.words.get(&next.range.start), Some((_, Role::Field)));
        let matters = match in_block {
            true => before_field && !between.contains('\n'),
            // `a -b` is a difference, `a [b]` a curve: another value, and no mistake where any value may stand.
            false => next.kind != Token::Close && !"+-[".contains(self.text(&next.range)),
        };
        Some(self.sign(Kind::Comma, token, ",", matters, random))
    }

    fn colon(&self, random: &mut Random) -> Option<Fault> {
        let tokens = &self.file.tokens;
        let token = self.pick(random, |index, token| {
            let before = index.checked_sub(1).map(|before| &tokens[before]);
            let after_word = before
                .is_some_and(|before| before.kind == Token::Word && before.range.end == token.range.start);
            self.text(&token.range) == ":" && after_word && !self.is_raw(index)
        })?;
        let is_apart = self.file.text[tokens[token].range.end..].starts_with(' ');
        Some(self.sign(Kind::Colon, token, ":", is_apart, random))
    }

    fn quote(&self, random: &mut Random) -> Option<Fault> {
        let token = self.pick(random, |index, token| token.kind == Token::Text && !self.is_raw(index))?;
        let Range { start, end } = self.file.tokens[token].range;
        let quote = if random.below(2) == 0 { start } else { end - 1 };
        if random.below(2) == 0 {
            let at = quote..quote + 1;
            return Some(self.local(Kind::Quote, at, String::new(), self.around(token), Cure::Sign("\"")));
        }
        Some(self.local(Kind::Quote, quote..quote, "\"".to_owned(), start..end, Cure::Removal))
    }

    /// One of the fields whose value stands on one line and uses no name.
    fn field(&self, random: &mut Random, is_meant: impl Fn(&FieldSite) -> bool) -> Option<&FieldSite> {
        let plain =
            |site: &&FieldSite| !holds_name(&site.value) && !self.text(&site.value_range).contains('\n');
        let fields: Vec<&FieldSite> =
            self.file.roles.fields.iter().filter(plain).filter(|site| is_meant(site)).collect();
        random.pick(&fields).copied()
    }

    fn wrong_type(&self, random: &mut Random) -> Option<Fault> {
        let field = self.field(random, |_| true)?;
        let range = field.value_range.clone();
        let wrong = match field.value.kind {
            ExprKind::Text(_) => "12",
            _ => "\"much\"",
        };
        Some(self.local(Kind::Type, range.clone(), wrong.to_owned(), range, Cure::None))
    }

    fn wrong_dimension(&self, random: &mut Random) -> Option<Fault> {
        let with_unit = |site: &FieldSite| matches!(&site.value.kind, ExprKind::Number { unit: Some(unit), .. } if unit.as_str() != "%");
        let range = self.field(random, with_unit)?.value_range.clone();
        let written = self.text(&range).to_owned();
        let numeral = written.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let unit = &written[numeral.len()..];
        // A bare number is no mistake where it means metres, pixels or grey.
        if ["deg", "W", "kW", "EV"].contains(&unit) && random.below(2) == 0 {
            let cure = if unit == "kW" { Cure::None } else { Cure::Word(written.clone()) };
            return Some(self.local(Kind::Dimension, range.clone(), numeral.to_owned(), range, cure));
        }
        let wrong = if ["deg", "rad", "turn"].contains(&unit) { "cm" } else { "deg" };
        Some(self.local(Kind::Dimension, range.clone(), format!("{numeral}{wrong}"), range, Cure::None))
    }

    fn arity(&self, random: &mut Random) -> Option<Fault> {
        if random.below(2) == 0 {
            return self.coordinate(random);
        }
        let roles = &self.file.roles;
        let calls: Vec<_> = roles
            .calls
            .iter()
            .filter(|call| {
                let own = self.scene.files.iter().find_map(|file| file.roles.functions.get(&call.function));
                !call.args.is_empty() && own.map_or(FIXED.contains(&call.function.as_str()), Option::is_some)
            })
            .collect();
        let call = random.pick(&calls)?;
        let (last, uses_names) = call.args.last()?.clone();
        if !uses_names && random.below(2) == 0 {
            let start = call.args.len().checked_sub(2).map_or(last.start, |before| call.args[before].0.end);
            return Some(self.local(
                Kind::Arity,
                start..last.end,
                String::new(),
                call.range.clone(),
                Cure::None,
            ));
        }
        let more = format!(", {}", self.text(&last));
        Some(self.local(Kind::Arity, last.end..last.end, more, call.range.clone(), Cure::None))
    }

    /// A point with two or four coordinates.
    fn coordinate(&self, random: &mut Random) -> Option<Fault> {
        let is_triple = |site: &FieldSite| match &site.value.kind {
            ExprKind::Tuple(parts) => parts.len() == 3 && TRIPLES.contains(&site.name.as_str()),
            _ => false,
        };
        let range = self.field(random, is_triple)?.value_range.clone();
        let comma = range.start + self.text(&range).rfind(',')?;
        let close = range.end - 1;
        if random.below(2) == 0 {
            return Some(self.local(Kind::Arity, comma..close, String::new(), range, Cure::None));
        }
        let more = self.file.text[comma..close].to_owned();
        Some(self.local(Kind::Arity, close..close, more, range, Cure::None))
    }

    /// The places of the texts that name files which have to be there.
    fn file_names(&self) -> Vec<Range<usize>> {
        let is_name = |token: &&TokenAt| {
            let (text, line) = (self.text(&token.range), self.lines(&token.range));
            token.kind == Token::Text && text.contains('.') && !self.text(&line).contains("missing: skip")
        };
        let names = self.file.tokens.iter().filter(is_name);
        names.map(|token| token.range.start + 1..token.range.end - 1).collect()
    }

    fn missing_file(&self, random: &mut Random) -> Option<Fault> {
        let range = random.pick(&self.file_names())?.clone();
        let name = self.text(&range).to_owned();
        let (folder, base) =
            name.rsplit_once('/').map_or(("", name.as_str()), |(folder, base)| (folder, base));
        let (stem, extension) = base.split_once('.')?;
        let wrong = typo(stem, &self.scene.known, random)?;
        let slash = if folder.is_empty() { "" } else { "/" };
        let (by, place) = (format!("{folder}{slash}{wrong}.{extension}"), range.start - 1..range.end + 1);
        Some(self.local(Kind::MissingFile, range, by, place, Cure::Word(name)))
    }

    fn out_of_range(&self, random: &mut Random) -> Option<Fault> {
        let field = self.field(random, |site| self.beyond(site).is_some())?;
        let (range, by) = (field.value_range.clone(), self.beyond(field)?);
        Some(self.local(Kind::Range, range.clone(), by, range, Cure::None))
    }

    /// A number that a field cannot have.
    fn beyond(&self, site: &FieldSite) -> Option<String> {
        let written = self.text(&site.value_range);
        match (&site.value.kind, site.name.as_str()) {
            (ExprKind::Number { unit: None, .. }, "ior") => Some("0.5".to_owned()),
            (ExprKind::Number { unit: None, .. }, "roughness" | "amount" | "specular") => {
                Some("1.5".to_owned())
            }
            (ExprKind::Number { .. }, "fov" | "fov_x") => Some("200deg".to_owned()),
            (
                ExprKind::Number { .. },
                "radius" | "depth" | "sensor" | "focal_length" | "tolerance" | "power" | "shininess"
                | "blades" | "irradiance" | "k" | "count",
            ) => Some(format!("-{written}")),
            (ExprKind::Size(..), "size") => Some("0 x 48".to_owned()),
            (ExprKind::FNumber(_), "aperture") => Some("f/0".to_owned()),
            _ => None,
        }
    }

    fn duplicate(&self, random: &mut Random) -> Option<Fault> {
        if random.below(2) == 0 {
            let field = self.field(random, |_| true)?;
            let range = field.range.clone();
            let again = format!(", {}", self.text(&range));
            return Some(self.local(Kind::Duplicate, range.end..range.end, again, range, Cure::Removal));
        }
        let range = random.pick(&self.file.roles.single)?.clone();
        let again = format!("\n{}", self.text(&range));
        let ends_line = self.file.text[range.end..].starts_with('\n');
        ends_line.then(|| self.local(Kind::Duplicate, range.end..range.end, again, range, Cure::Removal))
    }

    /// The file includes the scene's main file, which may be itself.
    fn cycle(&self) -> Fault {
        let main = &self.scene.files[0].path;
        let name = main.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let up = if main.parent() == self.file.path.parent() { "" } else { "../" };
        let end = self.file.text.find('\n').unwrap_or(self.file.text.len());
        let by = format!("\ninclude \"{up}{name}\"");
        Fault { claim: 0..end, ..self.local(Kind::Cycle, end..end, by, end..end, Cure::None) }
    }
}
