//! Raw nodes → fields: each key with the values that belong to it.

use super::error::{Mistake, Notebook};
use super::parse::{Block, List, Node, Number, Span, Word};
use super::report::{Fate, Outcome};
use super::vocabulary::{self, Args, Vocabulary};
use crate::diag::did_you_mean;
use crate::math::DVec3;
use std::collections::BTreeMap;
use std::iter::Peekable;
use std::vec::IntoIter;

/// What is said of a field that was taken; it stays only where a mistake elsewhere ends the conversion.
pub const READ: &str = "read, and lost with what it belongs to";

/// A key and its values.
#[derive(Debug)]
pub struct Field<'t> {
    /// The key as the vocabulary spells it, or as written if it is unknown.
    pub key: &'t str,
    pub numbers: Vec<Number<'t>>,
    pub word: Option<Word<'t>>,
    pub lists: Vec<List<'t>>,
    /// From the key to its last value.
    pub span: Span,
    /// Whether the vocabulary has the key.
    pub known: bool,
    /// Whether it has the values it should have; if not, that is noted already.
    pub sound: bool,
}

impl Field<'_> {
    /// The `i`-th number; sound fields have as many as their vocabulary says.
    pub fn number(&self, i: usize) -> f64 {
        self.numbers.get(i).map_or(0.0, |number| number.value)
    }

    /// The first three numbers.
    pub fn vector(&self) -> DVec3 {
        DVec3::new(self.number(0), self.number(1), self.number(2))
    }
}

/// What a block holds, in the order of the file.
#[derive(Debug)]
pub enum Part<'t> {
    Field(Field<'t>),
    Block(Block<'t>),
}

/// What a block holds, when the order does not matter.
#[derive(Debug)]
pub struct Fields<'t> {
    pub block: String,
    /// The block's name and brace.
    pub head: Span,
    list: Vec<Field<'t>>,
    blocks: Vec<Block<'t>>,
    vocabulary: Vocabulary,
}

impl Fields<'_> {
    /// Whether a field of this name is there, sound or not.
    pub fn has(&self, key: &str) -> bool {
        self.list.iter().any(|field| field.key == key)
    }
}

/// Notes and fates: what every reading function writes to.
#[derive(Debug)]
pub struct Log {
    pub notes: Notebook,
    /// By their beginnings; what is said last of a stretch counts.
    pub fates: BTreeMap<usize, Fate>,
}

impl Log {
    pub fn new(notes: Notebook) -> Self {
        Self { notes, fates: BTreeMap::new() }
    }

    pub fn mapped(&mut self, span: &Span, to: impl Into<String>) {
        self.tell(span, Outcome::Mapped(to.into()));
    }

    pub fn approximated(&mut self, span: &Span, how: impl Into<String>) {
        self.tell(span, Outcome::Approximated(how.into()));
    }

    pub fn ignored(&mut self, span: &Span, why: impl Into<String>) {
        self.tell(span, Outcome::Ignored(why.into()));
    }

    pub fn dropped(&mut self, span: &Span, why: impl Into<String>) {
        self.tell(span, Outcome::Dropped(why.into()));
    }

    fn tell(&mut self, span: &Span, outcome: Outcome) {
        self.fates.insert(span.start, Fate { span: span.clone(), outcome });
    }

    /// Drops a whole block, whatever was said of its parts.
    pub fn drop_all(&mut self, span: &Span, why: &str) {
        let inside: Vec<usize> = self.fates.range(span.clone()).map(|(start, _)| *start).collect();
        for start in inside {
            self.fates.remove(&start);
        }
        self.dropped(span, why);
    }

    /// Sorts a block's content into fields and blocks. Strays are noted and dropped.
    pub fn parts<'t>(&mut self, body: Vec<Node<'t>>, vocabulary: Vocabulary) -> Vec<Part<'t>> {
        let mut nodes = body.into_iter().peekable();
        let mut parts = Vec::new();
        while let Some(node) = nodes.next() {
            match node {
                Node::Word(word) => parts.push(Part::Field(self.field(word, &mut nodes, vocabulary))),
                Node::Block(block) => parts.push(self.block_or_field(block, vocabulary)),
                Node::Number(_) | Node::List(_) => self.stray(&node, &mut nodes),
            }
        }
        parts
    }

    /// Like [`Log::parts`], for blocks in which the order does not matter.
    pub fn fields<'t>(&mut self, block: Block<'t>, vocabulary: Vocabulary) -> Fields<'t> {
        let mut fields = Fields {
            block: block.name().into(),
            head: block.head.clone(),
            list: Vec::new(),
            blocks: Vec::new(),
            vocabulary,
        };
        for part in self.parts(block.body, vocabulary) {
            match part {
                Part::Field(field) => fields.list.push(field),
                Part::Block(block) => fields.blocks.push(block),
            }
        }
        fields
    }

    /// Some dialects put braces round arguments, `Scale { 5 1 1 }`: such a block is a field.
    fn block_or_field<'t>(&mut self, block: Block<'t>, vocabulary: Vocabulary) -> Part<'t> {
        let argument_of = |name: &Word<'t>| match vocabulary::find(vocabulary, name.text) {
            Some((_, Args::Numbers(_))) => Some(name.clone()),
            _ => None,
        };
        match block.name.as_ref().and_then(argument_of) {
            Some(key) => {
                let mut nodes = block.body.into_iter().peekable();
                let mut field = self.field(key, &mut nodes, vocabulary);
                field.span.end = block.span.end;
                Part::Field(field)
            }
            None => Part::Block(block),
        }
    }

    /// Takes the values that belong to `key`.
    fn field<'t>(
        &mut self,
        key: Word<'t>,
        nodes: &mut Peekable<IntoIter<Node<'t>>>,
        vocabulary: Vocabulary,
    ) -> Field<'t> {
        let capitalised = || vocabulary::find_capitalised(vocabulary, key.text);
        let entry = vocabulary::find(vocabulary, key.text).or_else(capitalised);
        let mut field = Field {
            key: entry.map_or(key.text, |(meant, _)| meant),
            numbers: Vec::new(),
            word: None,
            lists: Vec::new(),
            span: key.span.clone(),
            known: entry.is_some(),
            sound: true,
        };
        if let Some((meant, _)) = entry
            && meant != key.text
        {
            let written = key.text.into();
            self.notes.note(Mistake::LetterCase {
                written,
                meant: meant.into(),
                at: key.span.clone().into(),
            });
        }
        match entry.map(|(_, args)| args) {
            Some(Args::Flag) => {}
            Some(Args::Numbers(count)) => {
                take_numbers(&mut field, nodes, count);
                self.check_count(&mut field, nodes, count, vocabulary);
            }
            Some(Args::Path) => {
                take_word(&mut field, nodes, |_| true);
                take_numbers(&mut field, nodes, usize::MAX);
                self.check_path(&mut field);
            }
            Some(Args::Lists) => take_lists(&mut field, nodes),
            Some(Args::Free) => {
                take_numbers(&mut field, nodes, usize::MAX);
                if field.numbers.is_empty() {
                    take_word(&mut field, nodes, |word| vocabulary::find(vocabulary, word).is_none());
                }
                self.check_free(&mut field);
            }
            None => {
                take_numbers(&mut field, nodes, usize::MAX);
                take_word(&mut field, nodes, |word| vocabulary::find(vocabulary, word).is_none());
                take_numbers(&mut field, nodes, usize::MAX);
            }
        }
        field
    }

    fn check_count<'t>(
        &mut self,
        field: &mut Field<'t>,
        nodes: &mut Peekable<IntoIter<Node<'t>>>,
        count: usize,
        vocabulary: Vocabulary,
    ) {
        if field.numbers.len() == count {
            return;
        }
        field.sound = false;
        let (key, wanted) = (field.key.to_string(), numbers_wanted(count));
        let is_new_key = |word: &str| vocabulary::find(vocabulary, word).is_some();
        match nodes.peek() {
            Some(Node::Word(word)) if !is_new_key(word.text) => {
                self.notes.note(Mistake::NotANumber {
                    key,
                    wanted,
                    word: word.text.into(),
                    at: word.span.clone().into(),
                });
                field.span.end = word.span.end;
                nodes.next();
                take_numbers(field, nodes, count.saturating_sub(field.numbers.len() + 1));
            }
            _ => {
                let found = match field.numbers.len() {
                    0 => "none follows".to_string(),
                    1 => "only one follows".to_string(),
                    some => format!("only {some} follow"),
                };
                let help = format!("write `{}`", example(field.key, count));
                self.notes.note(Mistake::MissingNumber {
                    key,
                    wanted,
                    found,
                    at: field.span.clone().into(),
                    help,
                });
            }
        }
    }

    fn check_path(&mut self, field: &mut Field<'_>) {
        if field.word.is_none() {
            field.sound = false;
            self.notes.note(Mistake::MissingValue {
                key: field.key.into(),
                wanted: "a file name",
                at: field.span.clone().into(),
                help: format!("write `{} FILE`, a name without spaces", field.key),
            });
        }
    }

    fn check_free(&mut self, field: &mut Field<'_>) {
        if field.word.is_none() && field.numbers.is_empty() {
            field.sound = false;
            self.notes.note(Mistake::MissingValue {
                key: field.key.into(),
                wanted: "numbers or a word",
                at: field.span.clone().into(),
                help: format!("write `{} 1 0 0` for weights, or a word such as `DIFF`", field.key),
            });
        }
    }

    /// Notes a run of numbers and lists that follow no key as one stray.
    fn stray<'t>(&mut self, first: &Node<'t>, nodes: &mut Peekable<IntoIter<Node<'t>>>) {
        let mut span = first.span();
        let mut text = match first {
            Node::Number(number) => number.text.to_string(),
            _ => "[ .. ]".to_string(),
        };
        while let Some(node) = nodes.next_if(|node| matches!(node, Node::Number(_) | Node::List(_))) {
            span.end = node.span().end;
            if !text.ends_with(" ..") {
                text.push_str(" ..");
            }
        }
        self.dropped(&span, "belongs to no key");
        self.notes.note(Mistake::StrayToken { text, at: span.into() });
    }

    /// Takes the field `key`. If it was written several times the last one counts, as in the original.
    pub fn take<'t>(&mut self, fields: &mut Fields<'t>, key: &str) -> Option<Field<'t>> {
        let last = fields.list.iter().rposition(|field| field.key == key)?;
        let field = fields.list.remove(last);
        fields.list.retain(|earlier| {
            if earlier.key == key {
                self.repeated(key, &earlier.span, &field.span);
            }
            earlier.key != key
        });
        if field.sound {
            self.mapped(&field.span, READ); // until the reader says what it becomes
        } else {
            self.dropped(&field.span, "malformed");
        }
        field.sound.then_some(field)
    }

    /// Notes that only the last of several counts.
    pub fn repeated(&mut self, name: &str, earlier: &Span, last: &Span) {
        self.dropped(earlier, "repeated further down; the last one counts");
        let (at, last) = (earlier.clone().into(), last.clone().into());
        self.notes.note(Mistake::Repeated { name: name.into(), at, last });
    }

    /// Takes a field of three numbers, which becomes `to`.
    pub fn vector(&mut self, fields: &mut Fields<'_>, key: &str, to: &str) -> Option<DVec3> {
        let field = self.take(fields, key)?;
        self.mapped(&field.span, to);
        Some(field.vector())
    }

    /// Takes a field that must be there.
    pub fn need<'t>(&mut self, fields: &mut Fields<'t>, key: &'static str) -> Option<Field<'t>> {
        if !fields.has(key) {
            let count = match vocabulary::find(fields.vocabulary, key) {
                Some((_, Args::Numbers(count))) => count,
                _ => 0,
            };
            self.notes.note(Mistake::MissingField {
                block: fields.block.clone(),
                field: key,
                at: fields.head.clone().into(),
                help: format!(
                    "add `{}`",
                    if count == 0 { format!("{key} FILE") } else { example(key, count) }
                ),
            });
        }
        self.take(fields, key)
    }

    /// Takes a field of three numbers that must be there.
    pub fn need_vector(&mut self, fields: &mut Fields<'_>, key: &'static str, to: &str) -> Option<DVec3> {
        let field = self.need(fields, key)?;
        self.mapped(&field.span, to);
        Some(field.vector())
    }

    /// Takes a field of one number that must be there.
    pub fn need_number(&mut self, fields: &mut Fields<'_>, key: &'static str, to: &str) -> Option<f64> {
        let field = self.need(fields, key)?;
        self.mapped(&field.span, to);
        Some(field.number(0))
    }

    /// What nobody took: unknown fields and blocks, with a warning for each.
    pub fn finish(&mut self, fields: Fields<'_>) {
        for field in fields.list {
            self.unknown_field(&field, &fields.block, fields.vocabulary);
        }
        for block in fields.blocks {
            self.unknown_block(&block, format!("in `{}`", fields.block), &[]);
        }
    }

    /// What nobody took, for one stated reason and without warnings.
    pub fn finish_quietly(&mut self, fields: Fields<'_>, why: &str) {
        for field in fields.list {
            self.dropped(&field.span, why);
        }
        for block in fields.blocks {
            self.dropped(&block.span, why);
        }
    }

    /// Drops a field with a warning. A field of the vocabulary is known to the family, but not in this place.
    pub fn unknown_field(&mut self, field: &Field<'_>, block: &str, vocabulary: Vocabulary) {
        if !field.sound {
            return self.dropped(&field.span, "malformed");
        }
        self.dropped(&field.span, "not known to the converter");
        let help = if field.known {
            Some(format!("the dialect of this `{block}` gives it no meaning"))
        } else {
            did_you_mean(field.key, vocabulary.iter().map(|(key, _)| *key))
        };
        self.notes.note(Mistake::UnknownField {
            field: field.key.into(),
            block: block.into(),
            at: field.span.clone().into(),
            help,
        });
    }

    /// Drops a whole block with a warning.
    pub fn unknown_block(&mut self, block: &Block<'_>, place: String, names: &[&str]) {
        self.dropped(&block.span, "not known to the converter");
        self.notes.note(Mistake::UnknownBlock {
            name: block.name().into(),
            place,
            at: block.head.clone().into(),
            help: did_you_mean(block.name(), names.iter().copied()),
        });
    }

    /// Compares a count with what it counts. The braces win.
    pub fn check_counts(&mut self, field: &Field<'_>, found: usize) {
        if !field.sound {
            return self.dropped(&field.span, "malformed");
        }
        self.mapped(&field.span, "counts what follows, which the braces tell by themselves");
        if field.number(0) != found as f64 {
            self.notes.note(Mistake::CountMismatch {
                key: field.key.into(),
                said: field.numbers.first().map_or("", |number| number.text).into(),
                found,
                at: field.span.clone().into(),
            });
        }
    }
}

fn take_numbers<'t>(field: &mut Field<'t>, nodes: &mut Peekable<IntoIter<Node<'t>>>, most: usize) {
    for _ in 0..most {
        let Some(Node::Number(number)) = nodes.next_if(|node| matches!(node, Node::Number(_))) else {
            return;
        };
        field.span.end = number.span.end;
        field.numbers.push(number);
    }
}

fn take_word<'t>(
    field: &mut Field<'t>,
    nodes: &mut Peekable<IntoIter<Node<'t>>>,
    fits: impl Fn(&str) -> bool,
) {
    let is_fitting = |node: &Node<'_>| matches!(node, Node::Word(word) if fits(word.text));
    if let Some(Node::Word(word)) = nodes.next_if(is_fitting) {
        field.span.end = word.span.end;
        field.word = Some(word);
    }
}

fn take_lists<'t>(field: &mut Field<'t>, nodes: &mut Peekable<IntoIter<Node<'t>>>) {
    while let Some(Node::List(list)) = nodes.next_if(|node| matches!(node, Node::List(_))) {
        field.span.end = list.span.end;
        field.lists.push(list);
    }
}

fn numbers_wanted(count: usize) -> String {
    if count == 1 { "a number".into() } else { format!("{count} numbers") }
}

/// What a field looks like, for the help of an error.
fn example(key: &str, count: usize) -> String {
    let numbers = match (key, count) {
        ("up" | "normal", _) => " 0 1 0".into(),
        ("direction", _) => " 0 0 -1".into(),
        ("angle", _) => " 45".into(),
        (_, 1) => " 1".into(),
        (_, 3) => " 0 0 0".into(),
        (_, count) => " 0".repeat(count),
    };
    format!("{key}{numbers}")
}
