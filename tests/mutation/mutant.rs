//! A scene with faults in it, each at a place of its own.

use super::corpus::Scene;
use super::faults::{Fault, Kind, fault};
use super::random::Random;
use std::ops::Range;

/// How often a place for a fault is looked for before the scene counts as full.
const TRIES: usize = 60;

/// A scene with faults.
pub struct Mutant<'a> {
    /// The scene without them.
    pub scene: &'a Scene,
    /// What is wrong.
    pub faults: Vec<Fault>,
}

impl<'a> Mutant<'a> {
    /// A random scene of `scenes` with 1 to `most` faults.
    pub fn new(scenes: &'a [Scene], most: usize, random: &mut Random) -> Self {
        let scene = &scenes[random.below(scenes.len())];
        let mut mutant = Self { scene, faults: Vec::new() };
        let wanted = 1 + random.below(most);
        for _ in 0..TRIES {
            let (kind, _) = Kind::ALL[random.below(Kind::ALL.len())];
            let file = random.below(scene.files.len());
            if let Some(fault) = fault(kind, scene, file, random).filter(|fault| mutant.has_room(fault)) {
                mutant.faults.push(fault);
            }
            if mutant.faults.len() == wanted {
                break;
            }
        }
        mutant
    }

    /// Whether a fault lies apart from those that are there, in a file that is read.
    fn has_room(&self, new: &Fault) -> bool {
        let apart = |old: &Fault| {
            old.file != new.file || old.claim.end < new.claim.start || new.claim.end < old.claim.start
        };
        self.faults.iter().all(|old| apart(old) && !self.hides(old, new.file) && !self.hides(new, old.file))
    }

    /// Whether a fault stands where a file is named that leads to `file`, which then may not be read.
    fn hides(&self, fault: &Fault, file: usize) -> bool {
        let named = &self.scene.files[fault.file].roles.files;
        let hit = |item: &Range<usize>| item.start <= fault.claim.end && fault.claim.start <= item.end;
        file != 0 && fault.kind != Kind::Cycle && named.iter().any(|(_, item, _)| hit(item))
    }

    /// The texts of its files.
    pub fn texts(&self) -> Vec<String> {
        let mut texts = self.scene.texts();
        let mut faults: Vec<&Fault> = self.faults.iter().collect();
        faults.sort_by_key(|fault| std::cmp::Reverse(fault.at.start));
        for fault in faults {
            texts[fault.file].replace_range(fault.at.clone(), &fault.by);
        }
        texts
    }

    /// Where a range of a file without faults lies in the file with them; what is put in at its end belongs to it.
    pub fn mutated(&self, file: usize, range: &Range<usize>) -> Range<usize> {
        let moved = |offset: usize, is_before: &dyn Fn(&Fault) -> bool| {
            let before = self.faults.iter().filter(|fault| fault.file == file && is_before(fault));
            let (grown, shrunk) =
                before.fold((0, 0), |(grown, shrunk), f| (grown + f.by.len(), shrunk + f.at.len()));
            offset + grown - shrunk
        };
        let start = moved(range.start, &|fault| fault.at.end <= range.start && fault.at.start < range.start);
        start..moved(range.end, &|fault| fault.at.end <= range.end)
    }

    /// A fault in words.
    pub fn describe(&self, fault: &Fault) -> String {
        let file = &self.scene.files[fault.file];
        let line = file.text[..fault.at.start].matches('\n').count() + 1;
        let (place, written, by) = (file.path.display(), &file.text[fault.at.clone()], fault.by.trim());
        match (written.is_empty(), by.is_empty()) {
            (_, true) => format!("{place}:{line}: `{written}` dropped"),
            (true, _) => format!("{place}:{line}: `{by}` put in"),
            _ => format!("{place}:{line}: `{by}` for `{written}`"),
        }
    }
}
