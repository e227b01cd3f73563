//! Text → raw tree: words, numbers, lists and blocks with their places, no meaning yet.

use super::mistake::Mistake;
use super::notebook::Notebook;
use pest::Parser;
use pest::iterators::Pair;

/// A range of bytes of the converted text.
pub type Span = std::ops::Range<usize>;

/// Blocks nested deeper than this are refused, so that no later walk over the tree can run out of stack.
pub const MAX_NESTING: usize = 256;

/// The longest text that is read, in bytes. The parser takes about thirty times as much memory.
pub const MAX_BYTES: usize = 16 << 20;

/// The largest number that is read as one.
const LARGEST: f64 = 1e15;

#[derive(pest_derive::Parser)]
#[grammar = "../grammar/arsenal.pest"]
struct Grammar;

/// A run of characters that is no number: a key, a flag, a file name.
#[derive(Clone, Debug, PartialEq)]
pub struct Word<'t> {
    pub text: &'t str,
    pub span: Span,
}

/// A finite number as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Number<'t> {
    pub value: f64,
    pub text: &'t str,
    pub span: Span,
}

/// `Name { .. }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Block<'t> {
    /// Missing in front of a stray `{`.
    pub name: Option<Word<'t>>,
    pub body: Vec<Node<'t>>,
    /// From the name to the closing brace.
    pub span: Span,
    /// The name and the opening brace.
    pub head: Span,
}

/// `[ .. ]`.
#[derive(Clone, Debug, PartialEq)]
pub struct List<'t> {
    pub items: Vec<Node<'t>>,
    pub span: Span,
}

/// Anything that stands in a file or block.
#[derive(Clone, Debug, PartialEq)]
pub enum Node<'t> {
    Word(Word<'t>),
    Number(Number<'t>),
    List(List<'t>),
    Block(Block<'t>),
}

impl<'t> Block<'t> {
    /// The block's name, empty if it has none.
    pub fn name(&self) -> &'t str {
        self.name.as_ref().map_or("", |name| name.text)
    }

    /// The blocks directly inside.
    pub fn blocks(&self) -> impl Iterator<Item = &Self> {
        self.body.iter().filter_map(Node::as_block)
    }

    /// The words directly inside.
    pub fn words(&self) -> impl Iterator<Item = &'t str> {
        self.body.iter().filter_map(|node| match node {
            Node::Word(word) => Some(word.text),
            _ => None,
        })
    }

    /// What follows the word `key` directly inside, if the word is there.
    pub fn after(&self, key: &str) -> Option<&[Node<'t>]> {
        let at = self.body.iter().position(|node| matches!(node, Node::Word(word) if word.text == key))?;
        Some(&self.body[at + 1..])
    }
}

impl<'t> Node<'t> {
    pub fn span(&self) -> Span {
        match self {
            Self::Word(word) => word.span.clone(),
            Self::Number(number) => number.span.clone(),
            Self::List(list) => list.span.clone(),
            Self::Block(block) => block.span.clone(),
        }
    }

    fn as_block(&self) -> Option<&Block<'t>> {
        match self {
            Self::Block(block) => Some(block),
            _ => None,
        }
    }
}

/// Reads a text as a nameless block that holds everything, and tells where its comments are. What is not balanced is
/// noted; the rest is read all the same.
pub fn parse<'t>(text: &'t str, notes: &mut Notebook) -> (Block<'t>, Vec<Span>) {
    let nothing = || Block { name: None, body: Vec::new(), span: 0..text.len(), head: 0..0 };
    if text.len() > MAX_BYTES {
        notes.note(Mistake::TooLarge { bytes: text.len(), limit: MAX_BYTES });
        return (nothing(), Vec::new());
    }
    match Grammar::parse(Rule::scene, text) {
        Ok(mut pairs) => {
            let scene = pairs.next().expect("a successful parse holds its rule");
            let mut builder = Builder { notes, comments: Vec::new() };
            let body = builder.nodes(scene.into_inner(), 0);
            builder.note_comments();
            (Block { body, ..nothing() }, builder.comments)
        }
        // `scene` matches every text, so the parser can only have run out of stack.
        Err(error) => {
            let at = match error.location {
                pest::error::InputLocation::Pos(at) | pest::error::InputLocation::Span((at, _)) => at,
            };
            notes.note(Mistake::TooDeep { limit: MAX_NESTING, at: (at, 0).into() });
            (nothing(), Vec::new())
        }
    }
}

/// Turns pest's pairs into nodes.
struct Builder<'n> {
    notes: &'n mut Notebook,
    comments: Vec<Span>,
}

impl Builder<'_> {
    fn nodes<'t>(&mut self, pairs: impl Iterator<Item = Pair<'t, Rule>>, depth: usize) -> Vec<Node<'t>> {
        pairs.filter_map(|pair| self.node(pair, depth)).collect()
    }

    fn node<'t>(&mut self, pair: Pair<'t, Rule>, depth: usize) -> Option<Node<'t>> {
        match pair.as_rule() {
            Rule::word => Some(Node::Word(word(&pair))),
            Rule::number => Some(number(&pair)),
            Rule::list => Some(Node::List(self.list(pair, depth))),
            Rule::block => self.block(pair, depth + 1).map(Node::Block),
            Rule::COMMENT => {
                self.comments.push(span(&pair));
                None
            }
            Rule::close_brace => self.stray('}', &pair),
            Rule::close_bracket => self.stray(']', &pair),
            _ => None,
        }
    }

    /// `block = { word? ~ open_brace ~ (node | close_bracket)* ~ (close_brace | missing_brace) }`
    fn block<'t>(&mut self, pair: Pair<'t, Rule>, depth: usize) -> Option<Block<'t>> {
        let span = span(&pair);
        if depth > MAX_NESTING {
            self.notes.note(Mistake::TooDeep { limit: MAX_NESTING, at: (span.start, 1).into() });
            return None;
        }
        let mut block = Block { name: None, body: Vec::new(), head: span.start..span.start, span };
        let mut opened = false;
        for part in pair.into_inner() {
            let part_span = self::span(&part);
            match part.as_rule() {
                Rule::word if !opened => block.name = Some(word(&part)),
                Rule::open_brace => {
                    opened = true;
                    block.head.end = part_span.end;
                }
                Rule::close_brace => block.span.end = part_span.end,
                Rule::missing_brace => self.notes.note(Mistake::UnclosedBrace {
                    name: block.name().into(),
                    open: block.head.clone().into(),
                }),
                _ => block.body.extend(self.node(part, depth)),
            }
        }
        Some(block)
    }

    /// `list = { open_bracket ~ (separator | number | word)* ~ (close_bracket | missing_bracket) }`
    fn list<'t>(&mut self, pair: Pair<'t, Rule>, depth: usize) -> List<'t> {
        let mut list = List { items: Vec::new(), span: span(&pair) };
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::open_bracket | Rule::close_bracket => list.span.end = part.as_span().end(),
                Rule::missing_bracket => {
                    self.notes.note(Mistake::UnclosedBracket { open: (list.span.start, 1).into() });
                }
                _ => {
                    let item = self.node(part, depth);
                    list.span.end = item.as_ref().map_or(list.span.end, |item| item.span().end);
                    list.items.extend(item);
                }
            }
        }
        list
    }

    fn stray<'t>(&mut self, what: char, pair: &Pair<'t, Rule>) -> Option<Node<'t>> {
        self.notes.note(Mistake::StrayClose { what, at: span(pair).into() });
        None
    }

    fn note_comments(&mut self) {
        if let Some(first) = self.comments.first() {
            self.notes.note(Mistake::Comment { count: self.comments.len(), first: first.clone().into() });
        }
    }
}

fn word<'t>(pair: &Pair<'t, Rule>) -> Word<'t> {
    Word { text: pair.as_str(), span: span(pair) }
}

/// A number, in double precision. What is too small for the original's single precision is 0, and what is larger than
/// anything in a scene stays a word; whoever wants a number there says so.
fn number<'t>(pair: &Pair<'t, Rule>) -> Node<'t> {
    match pair.as_str().parse::<f64>() {
        Ok(value) if value.abs() <= LARGEST => {
            let value = if value as f32 == 0.0 { 0.0 } else { value };
            Node::Number(Number { value, text: pair.as_str(), span: span(pair) })
        }
        _ => Node::Word(word(pair)),
    }
}

fn span(pair: &Pair<'_, Rule>) -> Span {
    pair.as_span().start()..pair.as_span().end()
}
