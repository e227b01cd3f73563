//! How well the reports of a mutant tell of its faults. Nothing here asks the compiler what is right.

use super::corpus::{Label, Report, Said};
use super::faults::{Cure, Fault};
use super::mutant::Mutant;
use std::ops::Range;

/// What came of one fault.
#[derive(Clone, Copy, Default)]
pub struct Verdict {
    /// Some label of some report touches what the fault breaks.
    pub reported: bool,
    /// The primary label of some report touches the fault.
    pub placed: bool,
    /// A report that is placed proposes what was there; `None` where nothing restores it.
    pub cured: Option<bool>,
    /// How many reports beyond the first touch what the fault breaks.
    pub echoes: usize,
}

/// What came of a mutant.
pub struct Judgement {
    /// One for each fault.
    pub verdicts: Vec<Verdict>,
    /// How many reports belong to no fault.
    pub spurious: usize,
}

/// Judges what is said of a mutant.
pub fn judge(mutant: &Mutant, said: &Said) -> Judgement {
    let is_old = |report: &Report| match report.labels.first() {
        Some(label) => mutant.scene.warnings.iter().any(|old| {
            let range = mutant.mutated(old.file, &old.range);
            old.code == label.code && old.file == label.file && range.start == label.range.start
        }),
        None => false,
    };
    let new: Vec<&Report> = said.reports.iter().filter(|report| !is_old(report)).collect();
    let touches = |fault: &Fault, report: &Report| {
        let construct = mutant.mutated(fault.file, &fault.construct);
        report.labels.iter().any(|label| touch(label, fault.file, &construct))
    };
    let belongs = |report: &Report| mutant.faults.iter().any(|fault| touches(fault, report));
    let verdict = |fault: &Fault| {
        let own: Vec<&&Report> = new.iter().filter(|report| touches(fault, report)).collect();
        let place = mutant.mutated(fault.file, &fault.place);
        let placed = own.iter().filter(|report| touch(&report.labels[0], fault.file, &place));
        let cures: Vec<bool> = placed.map(|report| cures(&fault.cure, report)).collect();
        Verdict {
            reported: !own.is_empty(),
            placed: !cures.is_empty(),
            cured: (fault.cure != Cure::None).then(|| cures.contains(&true)),
            echoes: own.len().saturating_sub(1),
        }
    };
    Judgement {
        verdicts: mutant.faults.iter().map(verdict).collect(),
        spurious: new.iter().filter(|report| !belongs(report)).count(),
    }
}

/// Whether a label touches a range; ends that meet touch.
fn touch(label: &Label, file: usize, range: &Range<usize>) -> bool {
    label.file == file && label.range.start <= range.end && range.start <= label.range.end
}

/// Whether the first thing that a report proposes restores what was there.
fn cures(cure: &Cure, report: &Report) -> bool {
    let first = report.help.split('`').nth(1);
    match cure {
        Cure::None => false,
        Cure::Word(word) => first.is_some_and(|first| holds_word(first, word)),
        Cure::Sign(sign) => {
            report.help.contains(&format!("`{sign}`")) || first.is_some_and(|first| first.contains(sign))
        }
        Cure::Removal => ["remove", "take one", "keep one"].iter().any(|word| report.help.contains(word)),
    }
}

/// Whether `word` stands whole in a text.
fn holds_word(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + word.len()..].chars().next();
        // A unit stands behind its numeral.
        !before.is_some_and(|c| is_part(c) && !c.is_ascii_digit()) && !after.is_some_and(is_part)
    })
}
