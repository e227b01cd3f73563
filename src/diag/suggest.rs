//! "Did you mean …?"

use std::path::PathBuf;

/// The candidates most like `wanted`, the best first, at most three.
///
/// Likeness is the Damerau–Levenshtein distance without regard to case (Damerau 1964; optimal string alignment):
/// at most a third of the word's length, and never the whole of it.
pub fn nearest<'a>(wanted: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let lower = wanted.to_lowercase();
    let limit = wanted.chars().count().div_ceil(3);
    let mut near: Vec<(usize, &str)> = candidates
        .into_iter()
        .map(|name| (strsim::osa_distance(&name.to_lowercase(), &lower), name))
        .filter(|&(distance, name)| distance <= limit && distance < name.chars().count())
        .collect();
    near.sort();
    near.dedup();
    near.into_iter().take(3).map(|(_, name)| name).collect()
}

/// The help line for an unknown name: "did you mean `glass`?", or nothing.
pub fn did_you_mean<'a>(wanted: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let quoted: Vec<String> = nearest(wanted, candidates).iter().map(|name| format!("`{name}`")).collect();
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
}
