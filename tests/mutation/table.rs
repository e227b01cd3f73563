//! The scores, kind by kind, and the page that shows them.

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
    /// For each kind and each way to miss a fault, the first of them and how many there are.
    misses: BTreeMap<(&'static str, Kind), (usize, String)>,
}

/// What is promised of all faults together.
const REPORTED: f64 = 0.95;
const PLACED: f64 = 0.90;
const CURED: f64 = 0.85;
const SPURIOUS: f64 = 0.1;

impl Row {
    fn add(&mut self, other: &Self) {
        self.faults += other.faults;
        self.reported += other.reported;
        self.placed += other.placed;
        self.curable += other.curable;
        self.cured += other.cured;
        self.echoes += other.echoes;
    }

    fn of(verdict: &Verdict) -> Self {
        Self {
            faults: 1,
            reported: verdict.reported.into(),
            placed: verdict.placed.into(),
            curable: verdict.cured.is_some().into(),
            cured: (verdict.cured == Some(true)).into(),
            echoes: verdict.echoes,
        }
    }

    fn line(&self, name: &str) -> String {
        let percent = |part, whole| match whole {
            0 => "–".to_owned(),
            _ => format!("{:.1} %", 100.0 * share(part, whole)),
        };
        format!(
            "| {name} | {} | {} | {} | {} | {:.2} |\n",
            self.faults,
            percent(self.reported, self.faults),
            percent(self.placed, self.faults),
            percent(self.cured, self.curable),
            share(self.echoes, self.faults),
        )
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
            misses: BTreeMap::new(),
        }
    }

    /// Counts one mutant.
    pub fn add(&mut self, number: usize, mutant: &Mutant, said: &Said, judgement: &Judgement) {
        self.mutants += 1;
        self.accepted += usize::from(!said.refused);
        self.spurious += judgement.spurious;
        for (fault, verdict) in mutant.faults.iter().zip(&judgement.verdicts) {
            self.rows.entry(fault.kind).or_default().add(&Row::of(verdict));
            let how = match verdict {
                Verdict { reported: false, .. } => "not reported",
                Verdict { placed: false, .. } => "not in its place",
                Verdict { cured: Some(false), .. } => "not cured",
                _ => continue,
            };
            let first = || (0, format!("mutant {number}, {}", mutant.describe(fault)));
            self.misses.entry((how, fault.kind)).or_insert_with(first).0 += 1;
        }
    }

    fn total(&self) -> Row {
        let mut total = Row::default();
        self.rows.values().for_each(|row| total.add(row));
        total
    }

    /// The table as Markdown.
    pub fn markdown(&self) -> String {
        let head = "| kind | faults | reported | in its place | cured | echoes a fault |\n|---|--:|--:|--:|--:|--:|\n";
        let rows = Kind::ALL.iter().filter_map(|(kind, name)| Some(self.rows.get(kind)?.line(name)));
        format!("{head}{}{}", rows.collect::<String>(), self.total().line("**all**"))
    }

    /// What is counted for all kinds together.
    pub fn summary(&self) -> String {
        let faults = self.total().faults;
        format!(
            "{} mutants of {} scenes hold {faults} faults. Reports that belong to no fault: {} ({:.3} a fault). \
             Mutants that were accepted: {}.",
            self.mutants,
            self.scenes,
            self.spurious,
            share(self.spurious, faults),
            self.accepted,
        )
    }

    /// What is missed, the first example of each kind.
    pub fn missed(&self) -> String {
        let mut out =
            String::from("| kind | what is missed | how often | for example |\n|---|---|--:|---|\n");
        for ((how, kind), (count, example)) in &self.misses {
            let name = Kind::ALL.iter().find(|(known, _)| known == kind).map_or("", |(_, name)| name);
            let _ = writeln!(out, "| {name} | {how} | {count} | {} |", example.replace('\n', " "));
        }
        out
    }

    /// Holds all faults together to what is promised.
    pub fn assert_good(&self) {
        let total = self.total();
        let all = format!("{}\n{}\n{}", self.markdown(), self.summary(), self.missed());
        assert!(share(total.reported, total.faults) >= REPORTED, "too few are reported\n{all}");
        assert!(share(total.placed, total.faults) >= PLACED, "too few are in their place\n{all}");
        assert!(share(total.cured, total.curable) >= CURED, "too few are cured\n{all}");
        assert!(share(self.spurious, total.faults) <= SPURIOUS, "too many reports belong to no fault\n{all}");
        assert_eq!(self.accepted, 0, "some mutants are accepted\n{all}");
    }
}

fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}
