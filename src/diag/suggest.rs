//! "Did you mean …?"

use std::path::PathBuf;

/// What a slip of the finger costs: two letters swapped, one dropped, one doubled, one hit beside.
const SLIP: usize = 2;
/// What any other change of a letter costs.
const CHANGE: usize = 3;
/// What it costs to be none of the kind that is wanted.
const OTHER_KIND: usize = 3;

/// The letters of a keyboard, row by row; each row is shifted by half a key against the one above.
const KEYS: [&str; 3] = ["qwertyuiop", "asdfghjkl", "zxcvbnm"];

/// The candidates most like `wanted`, the best first, at most three.
///
/// Near is what differs in at most a third of its letters and not in all of them, without regard to case
/// (Damerau 1964; optimal string alignment), or in one slip of the finger. Those that take fewer and likelier slips come
/// first.
pub fn nearest<'a>(wanted: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    nearest_of_kind(wanted, candidates.into_iter().map(|name| (name, true)))
}

/// The same, where some candidates are of the kind that is wanted: these come before others that are as near.
pub fn nearest_of_kind<'a>(
    wanted: &str,
    candidates: impl IntoIterator<Item = (&'a str, bool)>,
) -> Vec<&'a str> {
    let lower = wanted.to_lowercase();
    let length = wanted.chars().count();
    let limit = length.div_ceil(3);
    let rank = |(name, is_wanted): (&'a str, bool)| {
        // A hostile word may be as long as a file is.
        if name.chars().count().abs_diff(length) > limit {
            return None;
        }
        let distance = strsim::osa_distance(&name.to_lowercase(), &lower);
        let cost = slip_cost(name, wanted);
        let is_near = distance <= limit && distance < name.chars().count() || cost <= SLIP;
        is_near.then_some((cost + if is_wanted { 0 } else { OTHER_KIND }, name))
    };
    let mut near: Vec<(usize, &str)> = candidates.into_iter().filter_map(rank).collect();
    near.sort();
    let mut names: Vec<&str> = Vec::new();
    for (_, name) in near {
        if names.len() < 3 && !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Whether one slip of the finger makes `written` of `meant`.
pub fn is_slip_of(meant: &str, written: &str) -> bool {
    meant.len().abs_diff(written.len()) <= 1 && slip_cost(meant, written) <= SLIP
}

/// What it costs to write `meant` as `written`, letter by letter.
fn slip_cost(meant: &str, written: &str) -> usize {
    let (meant, written): (Vec<char>, Vec<char>) = (meant.chars().collect(), written.chars().collect());
    let width = written.len() + 1;
    // costs[i * width + j]: the first i letters of `meant` written as the first j of `written`.
    let mut costs = vec![0; (meant.len() + 1) * width];
    for i in 0..=meant.len() {
        for j in 0..=written.len() {
            let from = |di: usize, dj: usize, cost: usize| match (i.checked_sub(di), j.checked_sub(dj)) {
                (Some(i), Some(j)) => costs[i * width + j] + cost,
                _ => usize::MAX,
            };
            let mut best = if i + j == 0 { 0 } else { from(1, 0, SLIP) };
            if j > 0 {
                let is_doubled = j > 1 && written[j - 1] == written[j - 2];
                best = best.min(from(0, 1, if is_doubled { SLIP } else { CHANGE }));
            }
            if i > 0 && j > 0 {
                best = best.min(from(1, 1, substitution(meant[i - 1], written[j - 1])));
            }
            if i > 1 && j > 1 && meant[i - 1] == written[j - 2] && meant[i - 2] == written[j - 1] {
                best = best.min(from(2, 2, SLIP));
            }
            costs[i * width + j] = best;
        }
    }
    costs[meant.len() * width + written.len()]
}

/// What it costs to write one letter as another.
fn substitution(meant: char, written: char) -> usize {
    match (meant.to_ascii_lowercase(), written.to_ascii_lowercase()) {
        _ if meant == written => 0,
        (meant, written) if meant == written => 1,
        (meant, written) if are_neighbours(meant, written) => SLIP,
        _ => CHANGE,
    }
}

/// Whether two letters are beside each other on a keyboard.
fn are_neighbours(a: char, b: char) -> bool {
    let place = |letter| KEYS.iter().enumerate().find_map(|(row, keys)| Some((row, keys.find(letter)?)));
    let (Some(a), Some(b)) = (place(a), place(b)) else { return false };
    let ((upper, left), (lower, right)) = (a.min(b), a.max(b));
    match lower - upper {
        0 => right - left == 1,
        // Key c of a row touches keys c and c + 1 of the row above it.
        1 => left == right || left == right + 1,
        _ => false,
    }
}

/// The help line for an unknown name: "did you mean `glass`?", or nothing.
pub fn did_you_mean<'a>(wanted: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    did_you_mean_one_of(&nearest(wanted, candidates))
}

/// The help line that proposes these, the best first.
pub fn did_you_mean_one_of(names: &[&str]) -> Option<String> {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => None,
        [one] => Some(format!("did you mean {one}?")),
        [rest @ .., last] => Some(format!("did you mean {} or {last}?", rest.join(", "))),
    }
}

/// What to say of a file that is not there: the files beside it that are called alike, or else where it was looked for.
pub fn where_it_was_sought(name: &str, tried: &[PathBuf], near: &[String]) -> String {
    if near.is_empty() {
        let tried: Vec<String> = tried.iter().map(|path| format!("`{}`", path.display())).collect();
        return format!(
            "looked for {}; another folder can be named with `--asset-dir DIR`",
            tried.join(", ")
        );
    }
    // Names of files come without the folder that was written before the wanted one.
    let folder = name.rsplit_once('/').map_or("", |(folder, _)| folder);
    let whole = |near: &String| match folder.is_empty() || near.contains('/') {
        true => format!("`{near}`"),
        false => format!("`{folder}/{near}`"),
    };
    let quoted: Vec<String> = near.iter().map(whole).collect();
    format!("did you mean {}?", quoted.join(" or "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_comes_first() {
        assert_eq!(nearest("glas", ["mirror", "gloss", "glass"]), ["glass", "gloss"]);
        assert_eq!(did_you_mean("sphree", ["sphere", "plane"]).as_deref(), Some("did you mean `sphere`?"));
        assert_eq!(did_you_mean("xyz", ["sphere", "plane"]), None);
    }

    #[test]
    fn slips_of_the_finger_come_before_other_changes() {
        assert_eq!(nearest("cmm", ["mm", "cm"]), ["cm", "mm"], "doubled");
        assert_eq!(nearest("colot", ["colon", "color"]), ["color", "colon"], "the key beside");
        assert_eq!(nearest("o", ["i", "n"]), ["i"], "one letter, the key beside");
        assert_eq!(nearest("ii", ["i", "n"]), ["i"], "one letter, doubled");
    }

    #[test]
    fn what_is_of_the_kind_that_is_wanted_comes_first() {
        assert_eq!(nearest_of_kind("eg", [("EV", false), ("deg", true)]), ["deg", "EV"]);
    }
}
