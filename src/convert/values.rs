//! Raw nodes → fields: which values belong to which key.

use super::fields::{Field, Part, example};
use super::log::Log;
use super::mistake::Mistake;
use super::parse::{Block, Node, Word};
use super::words::{Args, Row, Values, Vocabulary};
use std::collections::VecDeque;

/// The nodes of a block that nobody took yet.
struct Nodes<'t>(VecDeque<Node<'t>>);

impl<'t> Nodes<'t> {
    fn next(&mut self) -> Option<Node<'t>> {
        self.0.pop_front()
    }

    fn next_if(&mut self, fits: impl Fn(&Node<'t>) -> bool) -> Option<Node<'t>> {
        self.0.front().is_some_and(fits).then(|| self.0.pop_front()).flatten()
    }
}

impl Log {
    /// Sorts a block's content into fields and blocks. Strays are noted and dropped.
    pub fn parts<'t>(&mut self, body: Vec<Node<'t>>, vocabulary: &'static Vocabulary) -> Vec<Part<'t>> {
        let mut nodes = Nodes(body.into());
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

    /// Some dialects put braces round arguments, `Scale { 5 1 1 }`: such a block is a field.
    fn block_or_field<'t>(&mut self, block: Block<'t>, vocabulary: &'static Vocabulary) -> Part<'t> {
        let takes_numbers = |name: &Word<'t>| {
            vocabulary.find(name.text).is_some_and(|row| matches!(row.args, Args::Numbers(_)))
        };
        let only_values = block.body.iter().all(|node| !matches!(node, Node::Block(_)));
        match block.name.clone().filter(|name| only_values && takes_numbers(name)) {
            Some(key) => {
                let mut nodes = Nodes(block.body.into());
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
        nodes: &mut Nodes<'t>,
        vocabulary: &'static Vocabulary,
    ) -> Field<'t> {
        let row = vocabulary.find(key.text).or_else(|| self.row_of_variant(&key, vocabulary));
        let mut field = Field {
            key: key.text,
            role: row.map_or("", |row| row.role),
            numbers: Vec::new(),
            word: None,
            lists: Vec::new(),
            span: key.span,
            guessed: false,
            sound: true,
        };
        match row.map(|row| row.args) {
            Some(Args::Flag) => {}
            Some(Args::Numbers(count)) => {
                take_numbers(&mut field, nodes, count);
                self.check_numbers(&mut field, nodes, count, vocabulary);
            }
            Some(Args::Color) => {
                take_numbers(&mut field, nodes, 3);
                self.check_numbers(&mut field, nodes, 3, vocabulary);
                field.sound |= field.numbers.len() == 1; // a grey
            }
            Some(Args::Path) => {
                take_word(&mut field, nodes, |_, _| true);
                take_numbers(&mut field, nodes, usize::MAX);
                self.check_value(&mut field, "a file name", " FILE`, a name without spaces");
            }
            Some(Args::Lists) => take_lists(&mut field, nodes),
            Some(Args::Maybe) => {
                take_word(&mut field, nodes, |word, _| looks_like_value(word));
                take_numbers(&mut field, nodes, usize::MAX);
            }
            Some(Args::Free) => {
                take_numbers(&mut field, nodes, usize::MAX);
                if field.numbers.is_empty() {
                    take_word(&mut field, nodes, |word, _| {
                        vocabulary.find(word).is_none_or(|row| row.args == Args::Flag)
                    });
                    take_numbers(&mut field, nodes, usize::MAX);
                }
                self.check_value(&mut field, "numbers or a word", " 1`, or a word");
            }
            None => {
                take_numbers(&mut field, nodes, usize::MAX);
                take_word(&mut field, nodes, |word, next| {
                    !vocabulary.knows(word)
                        && (looks_like_value(word) || !matches!(next, Some(Node::Number(_))))
                });
                take_numbers(&mut field, nodes, usize::MAX);
                let guess = vocabulary.guess(field.key, values_of(&field));
                field.role = guess.unwrap_or_default();
                field.guessed = guess.is_some();
            }
        }
        field
    }

    /// The row of a key that is spelt with other capitals or underscores, as some programs do.
    fn row_of_variant(&mut self, key: &Word<'_>, vocabulary: &'static Vocabulary) -> Option<&'static Row> {
        let (row, meant) = vocabulary.find_loosely(key.text)?;
        self.notes.note(Mistake::LetterCase {
            written: key.text.into(),
            meant: meant.into(),
            at: key.span.clone().into(),
        });
        Some(row)
    }

    fn check_numbers<'t>(
        &mut self,
        field: &mut Field<'t>,
        nodes: &mut Nodes<'t>,
        count: usize,
        vocabulary: &'static Vocabulary,
    ) {
        if field.numbers.len() == count {
            return;
        }
        field.sound = false;
        let key = field.key.to_string();
        let wanted = if count == 1 { "a number".into() } else { format!("{count} numbers") };
        let is_value = |word: &Word<'_>| !vocabulary.knows(word.text) && starts_like_number(word.text);
        match nodes.next_if(|node| matches!(node, Node::Word(word) if is_value(word))) {
            Some(Node::Word(word)) => {
                field.span.end = word.span.end;
                self.notes.note(Mistake::NotANumber {
                    key,
                    wanted,
                    word: word.text.into(),
                    at: word.span.into(),
                });
                take_numbers(field, nodes, count.saturating_sub(field.numbers.len() + 1));
            }
            _ => {
                let found = match field.numbers.len() {
                    0 => "none follows".to_string(),
                    1 => "only one follows".to_string(),
                    some => format!("only {some} follow"),
                };
                let help = format!("write `{}`", example(field.key, count));
                let at = field.span.clone().into();
                self.notes.note(Mistake::MissingNumber { key, wanted, found, at, help });
            }
        }
    }

    /// Notes a field without any value.
    fn check_value(&mut self, field: &mut Field<'_>, wanted: &'static str, example: &str) {
        if field.word.is_none() && field.numbers.is_empty() {
            field.sound = false;
            self.notes.note(Mistake::MissingValue {
                key: field.key.into(),
                wanted,
                at: field.span.clone().into(),
                help: format!("write `{}{example}", field.key),
            });
        }
    }

    /// Notes a run of numbers and lists that follow no key as one stray.
    fn stray<'t>(&mut self, first: &Node<'t>, nodes: &mut Nodes<'t>) {
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
}

fn take_numbers<'t>(field: &mut Field<'t>, nodes: &mut Nodes<'t>, most: usize) {
    for _ in 0..most {
        let Some(Node::Number(number)) = nodes.next_if(|node| matches!(node, Node::Number(_))) else {
            return;
        };
        field.span.end = number.span.end;
        field.numbers.push(number);
    }
}

/// Takes a word that fits, seen together with what follows it.
fn take_word<'t>(
    field: &mut Field<'t>,
    nodes: &mut Nodes<'t>,
    fits: impl Fn(&str, Option<&Node<'t>>) -> bool,
) {
    let next = nodes.0.get(1);
    let is_fitting = matches!(nodes.0.front(), Some(Node::Word(word)) if fits(word.text, next));
    if let Some(Node::Word(word)) = is_fitting.then(|| nodes.next()).flatten() {
        field.span.end = word.span.end;
        field.word = Some(word);
    }
}

fn take_lists<'t>(field: &mut Field<'t>, nodes: &mut Nodes<'t>) {
    while let Some(Node::List(list)) = nodes.next_if(|node| matches!(node, Node::List(_))) {
        field.span.end = list.span.end;
        field.lists.push(list);
    }
}

/// Whether a word is more likely a value than a key: a file name, or one of the words for yes and no.
fn looks_like_value(word: &str) -> bool {
    let is_answer =
        ["true", "false", "yes", "no", "on", "off"].iter().any(|it| it.eq_ignore_ascii_case(word));
    is_answer || word.contains(['.', '/', '\\'])
}

/// Whether a word may be a number gone wrong rather than the next key.
fn starts_like_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'))
        || word.chars().count() <= 2
}

fn values_of(field: &Field<'_>) -> Values {
    match (field.numbers.len(), &field.word) {
        (_, Some(_)) => Values::Word,
        (0, None) => Values::Nothing,
        (1, None) => Values::Number,
        (3, None) => Values::Vector,
        _ => Values::Other,
    }
}
