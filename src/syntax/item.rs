//! Items: what stands at the top level, in groups, loops and choices.

use super::ast::{Expr, ExprKind, Formal, Function, Item, ItemKind, Name, Place};
use super::error::SyntaxError;
use super::grammar::{Parts, Rule};
use super::lower::{Lower, Request, item, poison};
use crate::source::Span;
use pest::iterators::Pair;

impl Lower<'_> {
    /// An item; its documentation and `allow`s are added by the sequence that holds it.
    pub(super) fn item(&mut self, pair: Pair<'_, Rule>) -> Item {
        let span = self.text.trimmed_span_of(&pair);
        let kind = match pair.as_rule() {
            Rule::include => self.include(pair),
            Rule::import => self.import(pair),
            Rule::units => ItemKind::Units(self.body(&mut Parts::of(pair), "`units`")),
            Rule::param => self.param(pair, span),
            Rule::binding => self.binding(pair),
            Rule::function => self.function(pair, span),
            Rule::repeat => self.repeat(pair),
            Rule::place => ItemKind::Place(self.place(pair)),
            Rule::object => ItemKind::Object(self.object(pair)),
            Rule::choice => return self.choice(pair),
            Rule::expr | Rule::block => ItemKind::Value(self.value(pair)),
            _ => {
                self.stray(&pair);
                ItemKind::Poison
            }
        };
        item(kind, span)
    }

    /// `include = { kw_include ~ (string | missing_value) ~ unwanted_as? }`
    fn include(&mut self, pair: Pair<'_, Rule>) -> ItemKind {
        let hint = "write `include \"room.snell\"`";
        let mut parts = Parts::of(pair);
        let is_guessed = self.names_guess(&mut parts);
        let Some(path) = self.path(&mut parts, hint) else { return ItemKind::Poison };
        if let Some(name) = parts.take(Rule::unwanted_as) {
            let hint = "an `include` takes no name, an `import` does: write `import .. as ..`, or take the name away";
            let (what, at) = ("a name for what is included".to_owned(), self.text.trimmed_span_of(&name));
            self.note(SyntaxError::Unreadable { what, hint: hint.to_owned(), at });
            return ItemKind::Poison;
        }
        let request = Request { path, is_import: false, is_guessed };
        let file = (self.load)(&request);
        ItemKind::Include { path: request.path, file }
    }

    /// `import = { kw_import ~ (string | missing_value) ~ (kw_as ~ binder | missing_as) }`
    fn import(&mut self, pair: Pair<'_, Rule>) -> ItemKind {
        let mut parts = Parts::of(pair);
        let is_guessed = self.names_guess(&mut parts);
        let path = self.path(&mut parts, "write `import \"materials.snell\" as mat`");
        if let Some(missing) = parts.take(Rule::missing_as) {
            if path.is_some() {
                let (place, hint) =
                    ("after the file's name", "write `as` and the name under which its names shall live");
                self.missing_sign("as", place, hint, &missing);
            }
            return ItemKind::Poison;
        }
        parts.skip(Rule::kw_as);
        let alias = self.binder(&mut parts, "this import", "mat");
        let (Some(path), Some(alias)) = (path, alias) else { return ItemKind::Poison };
        let request = Request { path, is_import: true, is_guessed };
        let file = (self.load)(&request);
        ItemKind::Import { path: request.path, alias, file }
    }

    /// Whether a path comes next of which an end was guessed.
    fn names_guess(&self, parts: &mut Parts<'_>) -> bool {
        parts.peek().is_some_and(|pair| pair.as_rule() == Rule::string && self.is_guessed(&pair))
    }

    /// The path of a file, `None` and a report when there is none.
    fn path(&mut self, parts: &mut Parts<'_>, hint: &str) -> Option<Name> {
        let pair = parts.next()?;
        if pair.as_rule() == Rule::string {
            return Some(self.string(&pair));
        }
        let at = self.text.after_token(pair.as_span().start());
        let what = "the name of a file between quotes".to_owned();
        self.note(SyntaxError::MissingValue { what, hint: hint.to_owned(), at });
        None
    }

    /// `param = { kw_param ~ binder ~ of_type ~ equals ~ given ~ (kw_in ~ expr)? }`
    fn param(&mut self, pair: Pair<'_, Rule>, span: Span) -> ItemKind {
        let mut parts = Parts::of(pair);
        let before = self.errors.len();
        let name = self.binder(&mut parts, "this parameter", "seats");
        let ty = self.of_type(&mut parts, name.as_ref(), "seats: int = 12");
        self.equals(&mut parts, "param", name.as_ref(), before);
        let value = self.definition_value(&mut parts, name.as_ref(), before);
        let range = parts.skip(Rule::kw_in).then(|| {
            self.given_or_poison(
                &mut parts,
                "the range after `in`",
                "write the allowed values, such as `1..=500`",
            )
        });
        match (name, ty) {
            (Some(name), Some(ty)) => ItemKind::Param { name, ty, value, range },
            // The name is known, so that its uses stay silent.
            (Some(name), None) => ItemKind::Let { name, value: poison(span) },
            (None, _) => ItemKind::Poison,
        }
    }

    /// `of_type = _{ ":" ~ (ident | missing_type) | missing_colon ~ ident | missing_type }`
    fn of_type(&mut self, parts: &mut Parts<'_>, name: Option<&Name>, example: &str) -> Option<Name> {
        if let Some(missing) = parts.take(Rule::missing_colon) {
            let place = name.map_or("here".to_owned(), |name| format!("after `{}`", name.value));
            self.missing_sign(":", &place, &format!("write it as in `{example}`"), &missing);
        }
        let pair = parts.next()?;
        if pair.as_rule() == Rule::ident {
            return Some(self.word(&pair));
        }
        if let Some(name) = name {
            let at = self.text.after_token(pair.as_span().start());
            let example = format!("its type after a colon, as in `{example}`");
            self.note(SyntaxError::MissingType { name: name.value.clone(), example, at });
        }
        None
    }

    /// `binding = { kw_let ~ binder ~ unwanted_type? ~ equals ~ given }`
    fn binding(&mut self, pair: Pair<'_, Rule>) -> ItemKind {
        let mut parts = Parts::of(pair);
        let before = self.errors.len();
        let name = self.binder(&mut parts, "this value", "goblet");
        if let (Some(ty), Some(name)) = (parts.take(Rule::unwanted_type), &name) {
            let at = self.text.trimmed_span_of(&ty);
            self.note(SyntaxError::TypedLet { name: name.value.clone(), at });
        }
        self.equals(&mut parts, "let", name.as_ref(), before);
        let value = self.definition_value(&mut parts, name.as_ref(), before);
        name.map_or(ItemKind::Poison, |name| ItemKind::Let { name, value })
    }

    /// `equals = _{ "=" | wrong_colon | missing_equals }`; silent when something before it was reported.
    fn equals(&mut self, parts: &mut Parts<'_>, word: &str, name: Option<&Name>, before: usize) {
        let sign = parts.take(Rule::wrong_colon).or_else(|| parts.take(Rule::missing_equals));
        let (Some(sign), Some(name)) = (sign, name) else { return };
        if self.errors.len() > before {
            return;
        }
        let ty = if word == "param" { ": .." } else { "" };
        let hint = format!("write `{word} {}{ty} = ..`", name.value);
        if sign.as_rule() == Rule::wrong_colon {
            let at = self.text.span_of(&sign);
            self.note(SyntaxError::WrongSign { written: ":".to_owned(), wanted: "=", hint, at });
        } else if !self.strange_character_at(sign.as_span().start()) {
            self.missing_sign("=", &format!("after `{}`", name.value), &hint, &sign);
        }
    }

    /// The value of a definition; silent when something before it was reported.
    fn definition_value(&mut self, parts: &mut Parts<'_>, name: Option<&Name>, before: usize) -> Expr {
        let reported = self.errors.len();
        let (what, hint) = name.map_or_else(Default::default, |name| {
            (format!("the value of `{}`", name.value), "write it after `=`".to_owned())
        });
        let value = self.given_or_poison(parts, &what, &hint);
        // What stands where a definition broke off is part of the mistake, not a value.
        if before < reported && (name.is_none() || value.kind == ExprKind::Poison) {
            self.errors.truncate(reported);
        }
        value
    }

    /// `function = { kw_fn ~ binder ~ formals ~ "->" ~ ident ~ body }`
    fn function(&mut self, pair: Pair<'_, Rule>, span: Span) -> ItemKind {
        let mut parts = Parts::of(pair);
        let before = self.errors.len();
        let name = self.binder(&mut parts, "this function", "ring");
        let formals = self.formals(&mut parts);
        let result = self.result(&mut parts, name.as_ref(), before);
        let reported = self.errors.len() > before;
        if reported && parts.skip(Rule::missing_block) {
            return name.map_or(ItemKind::Poison, |name| ItemKind::Let { name, value: poison(span) });
        }
        let body = self.body(&mut parts, "this function");
        match (name, formals, result) {
            (Some(name), Some(formals), Some(result)) => {
                ItemKind::Fn(Function { name, formals, result, body })
            }
            // The name is known, so that its uses stay silent.
            (Some(name), ..) => ItemKind::Let { name, value: poison(span) },
            (None, ..) => ItemKind::Poison,
        }
    }

    /// `formals = { "(" ~ (formal | comma | junk)* ~ ")" }`, or `missing_formals`
    fn formals(&mut self, parts: &mut Parts<'_>) -> Option<Vec<Formal>> {
        let pair = parts.next()?;
        if pair.as_rule() == Rule::missing_formals {
            let hint = "write its parameters between parentheses, or `()`";
            self.missing_sign("(", "after the name of this function", hint, &pair);
            return None;
        }
        let before = self.errors.len();
        let formals = self.elements(pair, "parameters", Self::formal);
        (self.errors.len() == before).then_some(formals)
    }

    /// `formal = { ident ~ of_type ~ ("=" ~ given)? }`
    fn formal(&mut self, pair: Pair<'_, Rule>) -> Option<Formal> {
        let mut parts = Parts::of(pair);
        let name = self.binder(&mut parts, "this parameter", "radius")?;
        let ty = self.of_type(&mut parts, Some(&name), "radius: length")?;
        let what = format!("the default of `{}`", name.value);
        let default = parts.peek().map(|_| self.given_or_poison(&mut parts, &what, "write it after `=`"));
        Some(Formal { name, ty, default })
    }

    /// `("->" | wrong_arrow) ~ (ident | missing_type) | missing_result`
    fn result(&mut self, parts: &mut Parts<'_>, name: Option<&Name>, before: usize) -> Option<Name> {
        let reported = self.errors.len() > before;
        let hint = "write the type of the result, as in `fn ring(n: int) -> object { .. }`";
        if let Some(missing) = parts.take(Rule::missing_result) {
            if !reported {
                self.missing_sign("->", "after the parameters", hint, &missing);
            }
            return None;
        }
        if let Some(sign) = parts.take(Rule::wrong_arrow) {
            let (written, at) = (sign.as_str().to_owned(), self.text.span_of(&sign));
            self.note(SyntaxError::WrongSign { written, wanted: "->", hint: hint.to_owned(), at });
        }
        self.of_type(parts, name, "fn ring(n: int) -> object")
    }

    /// `repeat = { (kw_while ~ endless | kw_for ~ (wrapped | counting | loop_name ~ kw_in ~ before_body)) ~ body }`
    fn repeat(&mut self, pair: Pair<'_, Rule>) -> ItemKind {
        let mut parts = Parts::of(pair);
        for (rule, what) in [(Rule::counting, "a loop that counts"), (Rule::endless, "`while`")] {
            if let Some(foreign) = parts.take(rule) {
                let hint = "a loop runs over a range: write `for i in 0..3 { .. }`".to_owned();
                let (what, at) = (what.to_owned(), self.text.trimmed_span_of(&foreign));
                self.note(SyntaxError::Unreadable { what, hint, at });
                return ItemKind::Poison;
            }
        }
        let (name, range) = match parts.take(Rule::wrapped) {
            Some(wrapped) => {
                let inner = wrapped.as_str().trim_matches(|c: char| "()".contains(c) || c.is_whitespace());
                let hint = format!("write `for {inner} {{ .. }}`, without parentheses");
                let at = self.text.trimmed_span_of(&wrapped);
                self.note(SyntaxError::Unreadable { what: "a loop in parentheses".to_owned(), hint, at });
                self.loop_over(&mut Parts::of(wrapped))
            }
            None => self.loop_over(&mut parts),
        };
        let body = self.body(&mut parts, "this loop");
        name.map_or(ItemKind::Poison, |name| ItemKind::For { name, range, body })
    }

    /// `loop_name ~ kw_in ~ before_body`
    pub(super) fn loop_over(&mut self, parts: &mut Parts<'_>) -> (Option<Name>, Expr) {
        let name = self.binder(parts, "this loop", "i");
        if let Some(missing) = parts.take(Rule::missing_in) {
            self.missing_sign("in", "after the loop's name", "write `for i in 0..4`", &missing);
        }
        parts.skip(Rule::kw_in);
        let range = self.given_or_poison(parts, "what this loop runs over", "write a range, such as `0..4`");
        (name, range)
    }

    /// `place = { kw_place ~ (object | expr) ~ (kw_as ~ binder | kw_at ~ expr)* ~ block? }`
    fn place(&mut self, pair: Pair<'_, Rule>) -> Place {
        let mut parts = Parts::of(pair);
        let target = self.given_or_poison(
            &mut parts,
            "what `place` places",
            "write an object or its name: `place goblet`",
        );
        let (mut at, mut name) = (None, None);
        loop {
            if parts.skip(Rule::kw_as) {
                name = self.binder(&mut parts, "this object", "hero");
            } else if parts.skip(Rule::kw_at) {
                at = Some(self.given_or_poison(
                    &mut parts,
                    "the point after `at`",
                    "write a point: `at (0m, 1m, 0m)`",
                ));
            } else {
                break;
            }
        }
        let body = parts.take(Rule::block).map(|block| self.block(block));
        Place { target, at, name, body }
    }

    /// Reports that a sign is missing before a node without width.
    pub(super) fn missing_sign(
        &mut self,
        sign: &'static str,
        place: &str,
        hint: &str,
        missing: &Pair<'_, Rule>,
    ) {
        let at = self.text.after_token(missing.as_span().start());
        self.note(SyntaxError::MissingSign { sign, place: place.to_owned(), hint: hint.to_owned(), at });
    }
}
