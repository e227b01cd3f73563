//! Which bracket closes which, and where one is missing.
//!
//! A text whose brackets pair is left alone. Otherwise indentation tells where the missing one belongs, as people
//! see it: a block ends before the first line that stands no further right than the line that opens it. Where this finds
//! more mistakes than plain counting does, the text is not indented by its structure, and counting decides.

use super::scan::Mark;

/// A change that makes the brackets pair, and what was wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Repair {
    /// The bracket at `open` is not closed: `close` belongs at `at`.
    Insert { at: usize, open: usize, close: u8 },
    /// The bracket at `at` closes nothing.
    Remove { at: usize },
    /// The bracket at `at` should be `close`, to match the one at `open`.
    Replace { at: usize, open: usize, close: u8 },
}

/// The changes that make the brackets among `marks` pair; `text` has blanks for comments.
pub(super) fn balance(text: &[u8], marks: &[Mark]) -> Vec<Repair> {
    let counted = Balance::of(text, marks, false);
    if counted.is_empty() {
        return counted;
    }
    let seen = Balance::of(text, marks, true);
    if seen.len() <= counted.len() { seen } else { counted }
}

/// The first bracket that lies more than `limit` deep.
pub(super) fn too_deep(marks: &[Mark], limit: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for mark in marks {
        match mark.bracket {
            Some(b'(' | b'[' | b'{') => depth += 1,
            Some(_) => depth = depth.saturating_sub(1),
            None => {}
        }
        if depth > limit {
            return Some(mark.offset);
        }
    }
    None
}

/// The walk over the marks of a text.
struct Balance<'a> {
    text: &'a [u8],
    open: Vec<Mark>,
    repairs: Vec<Repair>,
}

impl<'a> Balance<'a> {
    fn of(text: &'a [u8], marks: &[Mark], by_indent: bool) -> Vec<Repair> {
        let mut balance = Self { text, open: Vec::new(), repairs: Vec::new() };
        for (index, &mark) in marks.iter().enumerate() {
            if by_indent && mark.is_first {
                balance.close_by_indent(mark);
            }
            match mark.bracket {
                Some(b'(' | b'[' | b'{') => balance.open.push(mark),
                Some(close) => balance.close(mark, close, by_indent, &marks[index + 1..]),
                None => {}
            }
        }
        while balance.insert_before(text.len()) {}
        balance.repairs
    }

    /// Closes what a line that begins with `mark` cannot belong to.
    fn close_by_indent(&mut self, mark: Mark) {
        let closes = |open: &Mark| mark.bracket.is_some_and(|bracket| Some(bracket) == closer(open));
        let is_closer = matches!(mark.bracket, Some(b')' | b']' | b'}'));
        // A closing bracket at the start of a line ends what stands at its own indentation, if there is such a thing.
        if is_closer && !self.open.iter().any(|open| open.indent == mark.indent && closes(open)) {
            return;
        }
        while let Some(top) = self.open.last() {
            let belongs = mark.indent > top.indent || is_closer && mark.indent == top.indent;
            if belongs || !self.insert_before(mark.offset) {
                break;
            }
        }
    }

    /// Closes the innermost open bracket after the last word before `offset`; `false` when none is open.
    fn insert_before(&mut self, offset: usize) -> bool {
        let Some(open) = self.open.pop() else { return false };
        let end = self.text[..offset].trim_ascii_end().len();
        let at = if self.is_tuple(&open) { first_field(self.text, open.offset + 1, end) } else { end };
        let close = closer(&open).expect("only opening brackets are kept");
        self.repairs.push(Repair::Insert { at, open: open.offset, close });
        true
    }

    /// Whether no name belongs between these brackets: all but blocks, and the arguments of calls.
    fn is_tuple(&self, open: &Mark) -> bool {
        let before = open.offset.checked_sub(1).map_or(b' ', |before| self.text[before]);
        open.bracket != Some(b'{') && !before.is_ascii_alphanumeric() && before != b'_'
    }

    /// Pairs a closing bracket with the one it closes.
    fn close(&mut self, mark: Mark, close: u8, by_indent: bool, rest: &[Mark]) {
        let at = mark.offset;
        let Some(&top) = self.open.last() else { return self.repairs.push(Repair::Remove { at }) };
        let partner = self.open.iter().rposition(|open| closer(open) == Some(close));
        let too_far_right = by_indent && mark.is_first && mark.indent > top.indent;
        match partner {
            Some(partner) if partner + 1 == self.open.len() && !too_far_right => {
                self.open.pop();
            }
            Some(_) if too_far_right => self.repairs.push(Repair::Remove { at }),
            Some(partner) if top.line != mark.line || self.open[partner].line == mark.line => {
                while self.open.len() > partner + 1 {
                    self.insert_before(at);
                }
                self.open.pop();
            }
            _ if top.line == mark.line && !closes_on_line(&top, rest) => {
                self.open.pop();
                let close = closer(&top).expect("only opening brackets are kept");
                self.repairs.push(Repair::Replace { at, open: top.offset, close });
            }
            _ => self.repairs.push(Repair::Remove { at }),
        }
    }
}

/// Where `, name:` begins within a range of the text, outside brackets in it, or else the range's end.
fn first_field(text: &[u8], start: usize, end: usize) -> usize {
    let (mut depth, mut at) = (0_usize, start);
    while at < end {
        match text[at] {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            b'"' => {
                at += text[at + 1..end].iter().take_while(|&&byte| byte != b'"' && byte != b'\n').count() + 1
            }
            b',' if depth == 0 && is_field(&text[at + 1..end]) => return at,
            _ => {}
        }
        at += 1;
    }
    end
}

/// Whether a text begins with `name:`.
fn is_field(text: &[u8]) -> bool {
    let text = text.trim_ascii_start();
    let name = text.iter().take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'_').count();
    text.first().is_some_and(|byte| !byte.is_ascii_digit())
        && name > 0
        && text[name..].trim_ascii_start().starts_with(b":")
}

/// Whether `open` is closed by the marks after it on its line.
fn closes_on_line(open: &Mark, rest: &[Mark]) -> bool {
    let mut depth = 0_usize;
    for mark in rest.iter().take_while(|mark| mark.line == open.line) {
        match mark.bracket {
            Some(b'(' | b'[' | b'{') => depth += 1,
            Some(close) if depth == 0 => return closer(open) == Some(close),
            Some(_) => depth -= 1,
            None => {}
        }
    }
    false
}

/// The bracket that closes an opening one.
fn closer(open: &Mark) -> Option<u8> {
    match open.bracket? {
        b'(' => Some(b')'),
        b'[' => Some(b']'),
        b'{' => Some(b'}'),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::scan::scan;
    use super::*;

    fn repairs(text: &str) -> Vec<Repair> {
        let scan = scan(text);
        balance(&scan.text, &scan.marks)
    }

    #[test]
    fn pairs_are_left_alone_however_they_are_indented() {
        assert_eq!(repairs("group {\nsphere {\n}\n  }\n(\n)"), []);
    }

    #[test]
    fn a_missing_brace_belongs_where_the_indentation_ends() {
        let text = "group {\n    sphere {\n        radius: 1m\n    plane { y: 0m }\n}\n";
        let at = text.find("\n    plane").unwrap();
        assert_eq!(repairs(text), [Repair::Insert { at, open: 19, close: b'}' }]);
    }

    #[test]
    fn a_missing_parenthesis_belongs_on_its_line() {
        let text = "camera {\n    position: (0m, 1m, 2m\n    look_at: (0m, 0m, 0m)\n}\n";
        let at = text.find("\n    look").unwrap();
        assert_eq!(repairs(text), [Repair::Insert { at, open: 23, close: b')' }]);
    }

    #[test]
    fn a_missing_parenthesis_belongs_before_the_next_field() {
        let text = "sphere { center: (0m, 1m, 2m, radius: 1m }";
        let at = text.find(", radius").unwrap();
        assert_eq!(repairs(text), [Repair::Insert { at, open: 17, close: b')' }]);
        let call = "place ring(1, radius: 1m";
        assert_eq!(repairs(call), [Repair::Insert { at: call.len(), open: 10, close: b')' }]);
    }

    #[test]
    fn a_bracket_of_the_wrong_kind_is_replaced() {
        assert_eq!(repairs("a: (1, 2]"), [Repair::Replace { at: 8, open: 3, close: b')' }]);
    }

    #[test]
    fn a_brace_too_many_is_the_one_that_stands_too_far_right() {
        let text = "group {\n    sphere {\n    }\n    }\n}\n";
        assert_eq!(repairs(text), [Repair::Remove { at: 31 }]);
    }
}
