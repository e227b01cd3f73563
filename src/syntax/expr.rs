//! Values and expressions.

use super::ast::{Arg, BinaryOp, Block, Entry, Expr, ExprKind, Item, ItemKind, Object, UnaryOp};
use super::error::SyntaxError;
use super::grammar::{Parts, Rule};
use super::lower::{Lower, item, poison};
use crate::source::{Span, Spanned};
use pest::iterators::Pair;

impl Lower<'_> {
    /// `value = { choice | object | block | expr }`
    pub(super) fn value(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.text.span_of(&pair);
        let lowered = self.nested(1, span, |lower| match pair.as_rule() {
            Rule::choice => lower.choice_value(pair),
            Rule::object => {
                let object = lower.object(pair);
                Expr { span: object.span, kind: ExprKind::Object(Box::new(object)) }
            }
            Rule::block => {
                let block = lower.block(pair);
                Expr { span: block.span, kind: ExprKind::Block(block) }
            }
            _ => lower.expr(pair),
        });
        lowered.unwrap_or_else(|| poison(span))
    }

    /// `object = { head ~ block }`
    pub(super) fn object(&mut self, pair: Pair<'_, Rule>) -> Object {
        let start = self.text.span_of(&pair);
        let mut parts = Parts::of(pair);
        let mut words = parts.take(Rule::head).into_iter().flat_map(Pair::into_inner);
        let kind = words.next().map_or_else(|| Spanned::new(String::new(), start), |word| self.word(&word));
        let second = words.next().map(|word| self.word(&word));
        let body = self.body(&mut parts, "this object");
        Object { span: kind.span.to(body.span), kind, second, body }
    }

    /// `choice = { condition ~ (kw_else ~ condition)* ~ (kw_else ~ body)? }`, as a value
    fn choice_value(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let item = self.choice(pair);
        let kind = match item.kind {
            ItemKind::If { condition, then, otherwise } => {
                ExprKind::If { condition: Box::new(condition), then, otherwise }
            }
            _ => ExprKind::Poison,
        };
        Expr { kind, span: item.span }
    }

    /// `choice = { condition ~ (kw_else ~ condition)* ~ (kw_else ~ body)? }`, as an item
    pub(super) fn choice(&mut self, pair: Pair<'_, Rule>) -> Item {
        let span = self.text.span_of(&pair);
        let mut parts = Parts::of(pair);
        let arms = parts.count(|rule| rule == Rule::condition);
        let lowered = self.nested(arms, span, |lower| {
            let mut arms = Vec::new();
            while let Some(arm) = parts.take(Rule::condition) {
                arms.push(lower.condition(arm));
            }
            let mut otherwise = parts.peek().map(|_| lower.body(&mut parts, "`else`"));
            // From the last arm outwards: each is what remains when the one before it does not hold.
            while let Some((condition, then, start)) = arms.pop() {
                let end = otherwise.as_ref().map_or(then.span, |block| block.span);
                let choice = item(ItemKind::If { condition, then, otherwise }, start.to(end));
                if arms.is_empty() {
                    return choice;
                }
                let span = choice.span;
                otherwise = Some(Block { entries: vec![Entry::Item(choice)], span, poisoned: false });
            }
            item(ItemKind::Poison, span)
        });
        lowered.unwrap_or_else(|| item(ItemKind::Poison, span))
    }

    /// `condition = { kw_if ~ (before_body | missing_value) ~ body }`, with the place where it begins
    fn condition(&mut self, pair: Pair<'_, Rule>) -> (Expr, Block, Span) {
        let start = self.text.span_of(&pair);
        let mut parts = Parts::of(pair);
        let condition =
            self.given_or_poison(&mut parts, "the condition of this `if`", "write `if CONDITION { .. }`");
        let then = self.body(&mut parts, "this `if`");
        (condition, then, Span::new(start.start, start.start))
    }

    /// The value that comes next, or poison and a report that `what` is missing.
    pub(super) fn given_or_poison(&mut self, parts: &mut Parts<'_>, what: &str, hint: &str) -> Expr {
        let missing = |at| SyntaxError::MissingValue { what: what.to_owned(), hint: hint.to_owned(), at };
        self.given(parts, missing).unwrap_or_else(|| poison(Span::default()))
    }

    /// `expr = { prefix* ~ operand ~ (infix ~ prefix* ~ operand)* }`, flat; climbed here.
    pub(super) fn expr(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.text.span_of(&pair);
        let mut parts = Parts::of(pair);
        let operators = parts.count(|rule| matches!(rule, Rule::infix | Rule::last_infix | Rule::prefix));
        if operators == 0 {
            return self.operand(&mut parts);
        }
        self.nested(operators, span, |lower| lower.climb(&mut parts, 0)).unwrap_or_else(|| poison(span))
    }

    /// Reads operators of at least this precedence (Richards 1979).
    fn climb(&mut self, parts: &mut Parts<'_>, precedence: u8) -> Expr {
        let mut left = self.prefixed(parts);
        while let Some(sign) = parts.peek() {
            let Some((op, strength)) = binary(sign.as_str()) else { break };
            if strength < precedence {
                break;
            }
            parts.next();
            if left.kind != ExprKind::Poison {
                self.check_infix(&sign);
            }
            // `^` alone groups from the right.
            let right = self.climb(parts, strength + u8::from(op != BinaryOp::Power));
            let op = Spanned::new(op, self.text.span_of(&sign));
            let span = left.span.to(right.span);
            if left.kind == ExprKind::Poison {
                left.span = span;
                continue;
            }
            left = Expr { kind: ExprKind::Binary { op, left: Box::new(left), right: Box::new(right) }, span };
        }
        left
    }

    /// `prefix* ~ operand`
    fn prefixed(&mut self, parts: &mut Parts<'_>) -> Expr {
        let Some(sign) = parts.take(Rule::prefix) else { return self.operand(parts) };
        let (op, strength) = match sign.as_str() {
            "-" => (UnaryOp::Minus, POWER),
            "+" => (UnaryOp::Plus, POWER),
            _ => (UnaryOp::Not, COMPARISON),
        };
        let op = Spanned::new(op, self.text.span_of(&sign));
        if sign.as_str() == "!" {
            self.wrong_operator(&sign, "not");
        }
        let operand = self.climb(parts, strength);
        let span = op.span.to(operand.span);
        Expr { kind: ExprKind::Unary { op, operand: Box::new(operand) }, span }
    }

    /// What operators join, with the second half of a size.
    fn operand(&mut self, parts: &mut Parts<'_>) -> Expr {
        let Some(pair) = parts.next() else { return poison(Span::default()) };
        let left = match pair.as_rule() {
            Rule::chain => self.chain(pair),
            Rule::on => self.on(pair),
            Rule::missing_operand => {
                self.missing_operand(&pair);
                poison(self.text.span_of(&pair))
            }
            _ => self.literal(pair),
        };
        let Some(tail) = parts.take(Rule::size_tail).and_then(|tail| tail.into_inner().next()) else {
            return left;
        };
        let right = self.literal(tail);
        let span = left.span.to(right.span);
        Expr { kind: ExprKind::Size(Box::new(left), Box::new(right)), span }
    }

    /// `on = { kw_on ~ (chain | missing_value) }`
    fn on(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.text.span_of(&pair);
        let mut parts = Parts::of(pair);
        if let Some(chain) = parts.take(Rule::chain) {
            let target = self.chain(chain);
            return Expr { span: span.to(target.span), kind: ExprKind::On(Box::new(target)) };
        }
        self.given_or_poison(
            &mut parts,
            "the name after `on`",
            "write the name of a placed object: `on goblet`",
        )
    }

    /// `chain = ${ (name ~ (sp+ ~ (list | string))? | list | tuple) ~ (member | call | index)* }`
    fn chain(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.text.span_of(&pair);
        let mut parts = Parts::of(pair);
        let links = parts.count(|rule| matches!(rule, Rule::member | Rule::call | Rule::index));
        self.nested(links, span, |lower| {
            let mut base = lower.chain_head(&mut parts, span);
            for link in parts.rest() {
                base = lower.link(base, link);
            }
            base
        })
        .unwrap_or_else(|| poison(span))
    }

    /// `name ~ (sp+ ~ (list | string))? | list | tuple`
    fn chain_head(&mut self, parts: &mut Parts<'_>, span: Span) -> Expr {
        let Some(head) = parts.next() else { return poison(span) };
        match head.as_rule() {
            Rule::list => self.list(head),
            Rule::tuple => self.tuple(head),
            _ => {
                let name = self.word(&head);
                match parts.peek_rule() {
                    Some(Rule::list | Rule::string) => self.tagged(name, parts),
                    _ => Expr { span: name.span, kind: word(name.value) },
                }
            }
        }
    }

    /// `name ~ sp+ ~ (list | string)`
    fn tagged(&mut self, tag: super::ast::Name, parts: &mut Parts<'_>) -> Expr {
        let value = match parts.next() {
            Some(list) if list.as_rule() == Rule::list => self.list(list),
            Some(string) => self.literal(string),
            None => poison(tag.span),
        };
        Expr { span: tag.span.to(value.span), kind: ExprKind::Tagged { tag, value: Box::new(value) } }
    }

    /// `member | call | index`
    fn link(&mut self, base: Expr, pair: Pair<'_, Rule>) -> Expr {
        let span = base.span.to(self.text.span_of(&pair));
        let base = Box::new(base);
        let kind = match pair.as_rule() {
            Rule::member => match self.binder_of_member(pair) {
                Some(field) => ExprKind::Access { base, field },
                None => ExprKind::Poison,
            },
            Rule::call => {
                let args = self.elements(pair, "arguments", |lower, arg| Some(lower.arg(arg)));
                ExprKind::Call { callee: base, args }
            }
            _ => {
                let at = self.text.span_of(&pair);
                let mut values = self.elements(pair, "elements", |lower, value| Some(lower.value(value)));
                match values.pop().filter(|_| values.is_empty()) {
                    Some(index) => ExprKind::Index { base, index: Box::new(index) },
                    None => self.bad_index(at),
                }
            }
        };
        Expr { kind, span }
    }

    /// `member = ${ "." ~ (ident | missing_name) }`
    fn binder_of_member(&mut self, pair: Pair<'_, Rule>) -> Option<super::ast::Name> {
        let part = pair.into_inner().next()?;
        if part.as_rule() == Rule::ident {
            return Some(self.word(&part));
        }
        let at = self.text.span_of(&part);
        self.note(SyntaxError::MissingName { what: "what follows this dot", example: "x", at });
        None
    }

    fn bad_index(&mut self, at: Span) -> ExprKind {
        let what = "the one index between these brackets".to_owned();
        self.note(SyntaxError::MissingValue { what, hint: "write one number, as in `xs[0]`".to_owned(), at });
        ExprKind::Poison
    }

    /// `arg = _{ named_arg | value }`, `named_arg = { ident ~ ":" ~ given }`
    fn arg(&mut self, pair: Pair<'_, Rule>) -> Arg {
        if pair.as_rule() != Rule::named_arg {
            return Arg { name: None, value: self.value(pair) };
        }
        let mut parts = Parts::of(pair);
        let name = parts.next().map(|name| self.word(&name));
        let what = name.as_ref().map_or_else(String::new, |name| format!("the value of `{}`", name.value));
        let value = self.given_or_poison(&mut parts, &what, "write it after the colon");
        Arg { name, value }
    }

    /// `tuple = !{ "(" ~ (value | comma | junk)* ~ ")" }`; one value in parentheses is that value.
    fn tuple(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.text.span_of(&pair);
        let before = self.errors.len();
        let mut values = self.elements(pair, "elements", |lower, value| Some(lower.value(value)));
        if values.is_empty() && self.errors.len() == before {
            let what = "what these parentheses hold".to_owned();
            let hint = "write a value, or several with commas between: `(0m, 1m, 0m)`".to_owned();
            self.note(SyntaxError::MissingValue { what, hint, at: span });
        }
        // Where a comma has nothing before it, nobody knows how many values there should be.
        let has_gap =
            self.errors[before..].iter().any(|error| matches!(error, SyntaxError::ExtraComma { .. }));
        match (values.len(), values.pop()) {
            (_, None) => poison(span),
            _ if has_gap => poison(span),
            (1, Some(only)) => Expr { span, ..only },
            (_, Some(last)) => {
                values.push(last);
                Expr { kind: ExprKind::Tuple(values), span }
            }
        }
    }

    /// `list = !{ "[" ~ (value | each | comma | junk)* ~ "]" }`
    fn list(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.text.span_of(&pair);
        if pair.clone().into_inner().any(|part| part.as_rule() == Rule::each) {
            return self.comprehension(pair, span);
        }
        let values = self.elements(pair, "elements", |lower, value| Some(lower.value(value)));
        Expr { kind: ExprKind::List(values), span }
    }

    /// `[ value ~ each ]`
    fn comprehension(&mut self, pair: Pair<'_, Rule>, span: Span) -> Expr {
        let mut parts = Parts::of(pair);
        let value = parts.next().filter(|part| part.as_rule() != Rule::each).map(|value| self.value(value));
        let each = parts.next().filter(|part| part.as_rule() == Rule::each);
        let (Some(value), Some(each), None) = (value, each, parts.next()) else {
            let what = "this list".to_owned();
            let hint = "write one value, then one loop: `[i * 2cm for i in 0..4 if i > 1]`".to_owned();
            self.note(SyntaxError::Unreadable { what, hint, at: span });
            return poison(span);
        };
        self.each(value, each, span)
    }

    /// `each = { kw_for ~ binder ~ kw_in ~ expr ~ (kw_if ~ expr)? }`
    fn each(&mut self, value: Expr, pair: Pair<'_, Rule>, span: Span) -> Expr {
        let mut parts = Parts::of(pair);
        let (name, range) = self.loop_over(&mut parts);
        let filter = parts.peek().map(|_| {
            let condition =
                self.given_or_poison(&mut parts, "the condition of this `if`", "write it after `if`");
            Box::new(condition)
        });
        let Some(name) = name else { return poison(span) };
        let kind = ExprKind::Comprehension { value: Box::new(value), name, range: Box::new(range), filter };
        Expr { kind, span }
    }
}

/// A word as a value.
fn word(word: String) -> ExprKind {
    match word.as_str() {
        "true" => ExprKind::Bool(true),
        "false" => ExprKind::Bool(false),
        _ => ExprKind::Name(word),
    }
}

/// The precedence of comparisons, which `not` lets through to its operand.
const COMPARISON: u8 = 4;
/// The precedence of `^`, the only operator that binds tighter than a sign.
const POWER: u8 = 9;

/// An operator and its precedence, from low to high: `then`, `or`, `and`, comparisons, ranges, `per`, sums, products, `^`.
fn binary(sign: &str) -> Option<(BinaryOp, u8)> {
    use BinaryOp::*;
    Some(match sign {
        "then" => (Then, 1),
        "or" | "||" => (Or, 2),
        "and" | "&&" => (And, 3),
        "==" | "=" => (Equal, COMPARISON),
        "!=" => (NotEqual, COMPARISON),
        "<" => (Less, COMPARISON),
        "<=" => (LessEqual, COMPARISON),
        ">" => (Greater, COMPARISON),
        ">=" => (GreaterEqual, COMPARISON),
        ".." => (Range, 5),
        "..=" => (RangeInclusive, 5),
        "per" => (Per, 6),
        "+" | "++" => (Add, 7),
        "-" | "--" => (Subtract, 7),
        "*" => (Multiply, 8),
        "/" => (Divide, 8),
        "%" => (Remainder, 8),
        "^" | "**" => (Power, POWER),
        _ => return None,
    })
}
