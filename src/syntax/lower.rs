//! Lowering: from pest's nodes to the ast, a function per rule, each mistake noted and poisoned.
//!
//! This file holds what those functions share; they stand in `item.rs`, `block.rs`, `expr.rs` and `literal.rs`.

use super::ast::{Block, Expr, ExprKind, FileIndex, Item, ItemKind, Name};
use super::error::SyntaxError;
use super::grammar::{Parts, Rule};
use super::text::Text;
use crate::source::{Span, Spanned};
use pest::iterators::Pair;

/// How deep parts may lie in one another. It bounds the recursion of every later phase.
pub(super) const MAX_DEPTH: usize = 256;

/// A file that an item names.
pub(super) struct Request {
    /// The path as written.
    pub path: Spanned<String>,
    /// Whether it is imported, not included.
    pub is_import: bool,
    /// Whether the end of the path was guessed, which was reported.
    pub is_guessed: bool,
}

/// Reads a file that an item names, and says which one it became.
pub(super) type Load<'a> = dyn FnMut(&Request) -> Option<FileIndex> + 'a;

/// The walk from pest's nodes to the ast.
pub(super) struct Lower<'a> {
    /// Where the nodes lie.
    pub text: Text<'a>,
    /// The mistakes met so far.
    pub errors: Vec<SyntaxError>,
    /// Reads what `include` and `import` name.
    pub load: &'a mut Load<'a>,
    /// The codes that items silence, each with its item.
    pub allows: Vec<(Name, Span)>,
    /// The semicolons met so far: a habit is reported once.
    pub semicolons: Vec<Span>,
    /// The comments in the signs of other languages: another habit.
    pub foreign_comments: Vec<(&'static str, Span)>,
    /// The words of the language that items took as names: each is reported there, and not where it is used.
    pub bound_words: Vec<Name>,
    depth: usize,
}

impl<'a> Lower<'a> {
    /// A walk over `text`.
    pub(super) fn new(text: Text<'a>, load: &'a mut Load<'a>) -> Self {
        Self {
            text,
            errors: Vec::new(),
            load,
            allows: Vec::new(),
            semicolons: Vec::new(),
            foreign_comments: Vec::new(),
            bound_words: Vec::new(),
            depth: 0,
        }
    }

    /// Notes a mistake.
    pub(super) fn note(&mut self, error: SyntaxError) {
        self.errors.push(error);
    }

    /// Goes `levels` down for the time of `lower`; `None`, and a report, where that is too deep.
    pub(super) fn nested<T>(
        &mut self,
        levels: usize,
        at: Span,
        lower: impl FnOnce(&mut Self) -> T,
    ) -> Option<T> {
        if self.depth + levels > MAX_DEPTH {
            let at = Span::new(at.start, at.end.min(at.start + 1));
            self.note(SyntaxError::TooDeep { limit: MAX_DEPTH, at });
            return None;
        }
        self.depth += levels;
        let result = lower(self);
        self.depth -= levels;
        Some(result)
    }

    /// The word of an `ident` or `name`.
    pub(super) fn word(&self, pair: &Pair<'_, Rule>) -> Name {
        Spanned::new(pair.as_str().to_owned(), self.text.span_of(pair))
    }

    /// The name that an item gives, `None` when it has none that may be used.
    pub(super) fn binder(
        &mut self,
        parts: &mut Parts<'_>,
        what: &'static str,
        example: &'static str,
    ) -> Option<Name> {
        let pair = parts.next()?;
        if pair.as_rule() == Rule::missing_name {
            let offset = pair.as_span().start();
            if !self.strange_character_at(offset) {
                let at = self.text.after_token(offset);
                self.note(SyntaxError::MissingName { what, example, at });
            }
            return None;
        }
        let name = self.word(&pair);
        if is_reserved(&name) {
            self.bound_words.push(name.clone());
            self.note(SyntaxError::ReservedWord { word: name.value, at: name.span });
            return None;
        }
        Some(name)
    }

    /// The value that comes next; `missing` tells the report when there is none.
    pub(super) fn given(
        &mut self,
        parts: &mut Parts<'_>,
        missing: impl FnOnce(Span) -> SyntaxError,
    ) -> Option<Expr> {
        let pair = parts.next()?;
        if pair.as_rule() == Rule::missing_value {
            let at = self.text.after_token(pair.as_span().start());
            if !self.reserved_word_at(pair.as_span().start()) {
                self.note(missing(at));
            }
            return Some(poison(at));
        }
        Some(self.value(pair))
    }

    /// The block of an item.
    pub(super) fn body(&mut self, parts: &mut Parts<'_>, what: &'static str) -> Block {
        match parts.next() {
            Some(pair) if pair.as_rule() == Rule::block => self.block(pair),
            Some(pair) => {
                let at = self.text.after_token(pair.as_span().start());
                self.note(SyntaxError::MissingBlock { what, at });
                Block { entries: Vec::new(), span: at, poisoned: true }
            }
            None => Block::default(),
        }
    }
}

/// A value that could not be read.
pub(super) const fn poison(span: Span) -> Expr {
    Expr { kind: ExprKind::Poison, span }
}

/// An item without documentation.
pub(super) const fn item(kind: ItemKind, span: Span) -> Item {
    Item { kind, span, doc: None, allows: Vec::new() }
}

/// Whether `word` belongs to the language and names nothing else.
pub(super) fn is_reserved(word: &str) -> bool {
    const RESERVED: [&str; 22] = [
        "and", "as", "data", "else", "f", "false", "fn", "for", "if", "import", "in", "include", "let",
        "not", "on", "or", "param", "per", "place", "then", "true", "units",
    ];
    RESERVED.binary_search(&word).is_ok()
}
