//! Slips of the finger, as people make them: two letters swapped, one dropped, one doubled, one hit beside.

use super::random::Random;
use std::collections::BTreeSet;

/// The letters of a keyboard, row by row; each row is shifted by half a key against the one above.
const ROWS: [&str; 3] = ["qwertyuiop", "asdfghjkl", "zxcvbnm"];

/// `word` with one slip, which makes it none of the `known` words and leaves it a word.
pub fn typo(word: &str, known: &BTreeSet<String>, random: &mut Random) -> Option<String> {
    let slips: Vec<String> =
        slips(word).into_iter().filter(|slip| is_word(slip) && !known.contains(slip)).collect();
    random.pick(&slips).cloned()
}

/// Every word that one slip makes of `word`.
fn slips(word: &str) -> BTreeSet<String> {
    let letters: Vec<char> = word.chars().collect();
    let mut slips = BTreeSet::new();
    for at in 0..letters.len() {
        let with = |middle: &[char], skip: usize| -> String {
            letters[..at].iter().chain(middle).chain(&letters[at + skip..]).collect()
        };
        slips.insert(with(&[], 1));
        slips.insert(with(&[letters[at], letters[at]], 1));
        if let Some(&next) = letters.get(at + 1) {
            slips.insert(with(&[next, letters[at]], 2));
        }
        slips.extend(neighbours(letters[at]).into_iter().map(|key| with(&[key], 1)));
    }
    slips.remove(word);
    slips
}

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

/// The keys around a letter, in its case.
fn neighbours(letter: char) -> Vec<char> {
    let small = letter.to_ascii_lowercase();
    let Some((row, column)) = position(small) else { return Vec::new() };
    let near = |other: char| {
        let (r, c) = position(other).expect("it stands in a row");
        // Key c of a row touches keys c and c + 1 of the row above it.
        match r.cmp(&row) {
            std::cmp::Ordering::Equal => c.abs_diff(column) == 1,
            std::cmp::Ordering::Less => r + 1 == row && (c == column || c == column + 1),
            std::cmp::Ordering::Greater => row + 1 == r && (column == c || column == c + 1),
        }
    };
    let near = ROWS.iter().flat_map(|row| row.chars()).filter(|&other| near(other));
    near.map(|key| if letter.is_ascii_uppercase() { key.to_ascii_uppercase() } else { key }).collect()
}

fn position(letter: char) -> Option<(usize, usize)> {
    ROWS.iter().enumerate().find_map(|(row, keys)| Some((row, keys.find(letter)?)))
}
