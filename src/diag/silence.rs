//! Warnings that the scene itself silences: `allow(unused, "for the close-up")` before an item.

use super::{Problem, Problems, Severity};
use crate::source::{Span, Spanned};
use std::collections::BTreeSet;

/// What an `allow` asks for: no warning of this code about that item.
#[derive(Clone, PartialEq, Debug)]
pub struct Allow {
    /// The code, whole or from a `::` on, where it is written.
    pub code: Spanned<String>,
    /// The item, with all that is in it.
    pub item: Span,
    /// Whether it has silenced something.
    pub used: bool,
}

impl Problems {
    /// Notes that the scene silences warnings of `code` about `item`.
    pub fn allow(&mut self, code: Spanned<String>, item: Span) {
        self.allows.push(Allow { code, item, used: false });
    }

    /// What the scene silences.
    pub fn allows(&self) -> &[Allow] {
        &self.allows
    }

    /// Removes the warnings that the scene silences, as far as they have been noted. Errors stay.
    pub fn silence(&mut self) {
        if self.allows.is_empty() {
            return;
        }
        let warnings = self.list.iter().enumerate().filter(|(_, p)| p.severity() == Severity::Warning);
        let mut warnings: Vec<(usize, usize, String)> =
            warnings.map(|(index, problem)| (problem.offset(), index, problem.code())).collect();
        warnings.sort();
        let mut waiting = self.waiting(&warnings.iter().map(|(.., code)| code.as_str()).collect());

        // Items lie beside or inside one another: going through the text, those around a place are open.
        let mut open: Vec<usize> = Vec::new();
        let mut silenced = vec![false; self.list.len()];
        for (offset, index, code) in warnings {
            while let Some(next) = waiting.pop_if(|next| self.allows[*next].item.start as usize <= offset) {
                open.push(next);
            }
            open.retain(|&allow| offset < self.allows[allow].item.end as usize);
            for &allow in &open {
                let allow = &mut self.allows[allow];
                let is_meant = names(&allow.code, &code);
                allow.used |= is_meant;
                silenced[index] |= is_meant;
            }
        }
        let mut silenced = silenced.into_iter();
        self.list.retain(|_: &Problem| !silenced.next().unwrap_or_default());
    }

    /// The `allow`s that mean one of these codes, the last in the text first; of equal ones only one.
    fn waiting(&self, codes: &BTreeSet<&str>) -> Vec<usize> {
        let means_one = |allow: &Allow| codes.iter().any(|code| names(&allow.code, code));
        let mut waiting: Vec<usize> =
            (0..self.allows.len()).filter(|&index| means_one(&self.allows[index])).collect();
        let key = |&index: &usize| {
            let allow = &self.allows[index];
            (allow.item.start, allow.item.end, allow.code.as_str())
        };
        waiting.sort_by(|a, b| key(b).cmp(&key(a)).then(a.cmp(b)));
        waiting.dedup_by(|a, b| key(a) == key(b));
        waiting
    }
}

/// Whether `name` is the code, or the end of it from a `::` on.
fn names(name: &str, code: &str) -> bool {
    let before = code.strip_suffix(name).filter(|_| !name.is_empty());
    before.is_some_and(|before| before.is_empty() || before.ends_with("::"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::samples::{Odd, Wrong};

    /// How many problems are left of an odd thing at each offset and something wrong at 5, and which `allow`s were used.
    fn left(offsets: &[u32], allows: &[(&str, u32, u32)]) -> (usize, Vec<bool>) {
        let mut problems = Problems::default();
        for &offset in offsets {
            problems.push(Odd { at: Span::new(offset, offset + 1) });
        }
        problems.push(Wrong { at: Span::new(5, 6) });
        for &(code, start, end) in allows {
            problems.allow(Spanned::new(code.to_owned(), Span::new(start, start)), Span::new(start, end));
        }
        problems.silence();
        (problems.list().len(), problems.allows().iter().map(|allow| allow.used).collect())
    }

    #[test]
    fn warnings_of_the_code_in_the_item_are_silenced() {
        assert_eq!(left(&[3], &[("odd", 0, 9)]), (1, vec![true]));
        assert_eq!(left(&[3], &[("test::odd", 0, 9)]), (1, vec![true]));
        assert_eq!(left(&[3], &[("snell::test::odd", 3, 9)]), (1, vec![true]));
        assert_eq!(left(&[3, 9], &[("odd", 4, 9)]), (3, vec![false]), "before and after the item");
        assert_eq!(left(&[3], &[("dd", 0, 9), ("", 0, 9), ("even", 0, 9)]), (2, vec![false; 3]));
    }

    #[test]
    fn errors_stay() {
        assert_eq!(left(&[], &[("wrong", 0, 9)]), (1, vec![false]));
    }

    #[test]
    fn items_lie_inside_items() {
        let allows = [("odd", 0, 30), ("odd", 2, 5), ("odd", 10, 20), ("odd", 10, 20)];
        // Of two equal ones the second is in vain.
        assert_eq!(left(&[3, 25], &allows), (1, vec![true, true, false, false]));
        assert_eq!(left(&[12, 40], &allows), (2, vec![true, false, true, false]));
    }

    #[test]
    fn many_are_silenced_soon() {
        let offsets: Vec<u32> = (0..100_000).collect();
        let allows = vec![("odd", 0, 100_000); 100_000];
        assert_eq!(left(&offsets, &allows).0, 1);
    }
}
