//! The scores, kind by kind.

use super::corpus::{Said, Scene};
use super::faults::Kind;
use super::judge::{Judgement, Verdict};
use super::mutant::Mutant;
use std::collections::BTreeMap;
use std::fmt::Write;

/// What came of the faults of a kind.
#[derive(Clone, Default)]
struct Row {
    faults: usize,
    reported: usize,
    placed: usize,
    curable: usize,
    cured: usize,
    echoes: usize,
}

/// What came of all.
pub struct Table {
    rows: BTreeMap<Kind, Row>,
    scenes: usize,
    mutants: usize,
    spurious: usize,
    accepted: usize,
    /// What went wrong, for people to read: kind, what was missed, how to see it again.
    pub misses: Vec<(Kind, &'static str, String)>,
}

impl Row {
    fn add(&mut self, verdict: &Verdict) {
        self.faults += 1;
        self.reported += usize::from(verdict.reported);
        self.placed += usize::from(verdict.placed);
        self.curable += usize::from(verdict.cured.is_some());
        self.cured += usize::from(verdict.cured == Some(true));
        self.echoes += verdict.echoes;
    }
}

impl Table {
    /// No mutant yet.
    pub fn new(scenes: &[Scene]) -> Self {
        Self {
            rows: BTreeMap::new(),
            scenes: scenes.len(),
            mutants: 0,
            spurious: 0,
            accepted: 0,
            misses: Vec::new(),
        }
    }

    /// Counts one mutant.
    pub fn add(&mut self, number: usize, mutant: &Mutant, said: &Said, judgement: &Judgement) {
        self.mutants += 1;
        self.accepted += usize::from(!said.refused);
        self.spurious += judgement.spurious.len();
        for (fault, verdict) in mutant.faults.iter().zip(&judgement.verdicts) {
            self.rows.entry(fault.kind).or_default().add(verdict);
            let what = match verdict {
                Verdict { reported: false, .. } => "not reported",
                Verdict { placed: false, .. } => "not placed",
                Verdict { cured: Some(false), .. } => "not cured",
                _ => continue,
            };
            self.misses.push((fault.kind, what, format!("{number} {}{}", mutant.describe(fault), shown(mutant, said, fault.file))));
        }
        for &index in &judgement.spurious {
            let report = &said.reports[index];
            let kind = mutant.faults.first().map_or(Kind::Cycle, |fault| fault.kind);
            self.misses.push((kind, "spurious", format!("{number} {}: {}", report.message, mutant.faults.iter().map(|f| mutant.describe(f)).collect::<Vec<_>>().join(" & "))));
        }
    }

    fn total(&self) -> Row {
        self.rows.values().fold(Row::default(), |sum, row| Row {
            faults: sum.faults + row.faults,
            reported: sum.reported + row.reported,
            placed: sum.placed + row.placed,
            curable: sum.curable + row.curable,
            cured: sum.cured + row.cured,
            echoes: sum.echoes + row.echoes,
        })
    }

    /// The table as Markdown.
    pub fn markdown(&self) -> String {
        let mut out = String::from(
            "| kind | faults | reported | in its place | cured | echoes a fault |\n|---|--:|--:|--:|--:|--:|\n",
        );
        for (kind, name) in Kind::ALL {
            if let Some(row) = self.rows.get(&kind) {
                line(&mut out, name, row);
            }
        }
        line(&mut out, "**all**", &self.total());
        out
    }

    /// What is counted for all kinds together.
    pub fn summary(&self) -> String {
        let total = self.total();
        format!(
            "{} mutants of {} scenes with {} faults: {:.3} spurious reports a fault, {} mutants accepted",
            self.mutants,
            self.scenes,
            total.faults,
            self.spurious as f64 / total.faults as f64,
            self.accepted,
        )
    }

    /// Holds all faults together to what was promised.
    pub fn assert_good(&self) {
        let total = self.total();
        let table = || format!("{}\n{}", self.markdown(), self.summary());
        assert!(share(total.reported, total.faults) >= 0.95, "too few are reported\n{}", table());
        assert!(share(total.placed, total.faults) >= 0.90, "too few are in their place\n{}", table());
        assert!(share(total.cured, total.curable) >= 0.85, "too few are cured\n{}", table());
        assert!(
            share(self.spurious, total.faults) <= 0.1,
            "too many reports belong to no fault\n{}",
            table()
        );
        assert_eq!(self.accepted, 0, "some mutants are accepted\n{}", table());
    }
}

fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

fn line(out: &mut String, name: &str, row: &Row) {
    let percent = |part, whole| match whole {
        0 => "–".to_owned(),
        _ => format!("{:.1} %", 100.0 * share(part, whole)),
    };
    let _ = writeln!(
        out,
        "| {name} | {} | {} | {} | {} | {:.2} |",
        row.faults,
        percent(row.reported, row.faults),
        percent(row.placed, row.faults),
        percent(row.cured, row.curable),
        share(row.echoes, row.faults),
    );
}

fn shown(mutant: &Mutant, said: &Said, file: usize) -> String {
    let texts = mutant.texts();
    let mut out = String::new();
    for report in &said.reports {
        for (i, label) in report.labels.iter().enumerate() {
            if label.file > texts.len() { continue }
            let text = &texts[label.file];
            let line = text[..label.range.start].matches('\n').count();
            let col = label.range.start - text[..label.range.start].rfind('\n').map_or(0, |e| e + 1);
            let _ = if i == 0 { write!(out, "\n      {}:{}+{} {} | {}\n         {}", line + 1, col + 1, label.range.len(), report.message, report.help, text.lines().nth(line).unwrap_or("")) } else {
              write!(out, "\n         (also {}:{})", line + 1, col + 1) };
        }
    }
    let _ = file;
    out
}
