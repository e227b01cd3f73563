//! What each diagnostic code means: a page with a broken scene and the same scene mended.
//!
//! The pages are `docs/codes/PHASE/NAME.md`; a test puts every example of theirs through the compiler.

mod pages;
mod terminal;

pub use pages::pages;
pub use terminal::Look;

/// Whether what a code reports forbids to render.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Level {
    /// Suspicious: the scene is rendered all the same, and `allow` silences it.
    Warning,
    /// Wrong: no ray is shot.
    Error,
}

/// The page of a diagnostic code.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// The code: `snell::resolve::unknown_name`.
    pub code: &'static str,
    /// How bad it is.
    pub level: Level,
    /// The page in Markdown: a heading, paragraphs, fenced blocks.
    pub markdown: &'static str,
}

/// A part of a page.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// Lines that belong together.
    Paragraph(&'static str),
    /// A scene, or a file that it needs.
    Block {
        /// What follows the fence: `snell broken`, `text file=tri.obj`.
        info: &'static str,
        /// The text between the fences.
        text: &'static str,
    },
}

/// What people call what is not here, and the code whose page says what to do instead.
const ALIASES: [(&str, &str); 6] = [
    ("csg", "no_csg"),
    ("difference", "no_csg"),
    ("intersection", "no_csg"),
    ("merge", "no_csg"),
    ("subtract", "no_csg"),
    ("union", "no_csg"),
];

/// The pages that are meant by `asked`: a code (`snell::resolve::unknown_name`, `resolve::unknown_name`), or a name, which
/// several phases may have.
pub fn find(asked: &str) -> Vec<&'static Page> {
    let plain = asked.trim_matches(|c: char| !c.is_ascii_alphanumeric()).to_ascii_lowercase();
    let plain = plain.replace('-', "_");
    let alias = ALIASES.iter().find(|(word, _)| *word == plain);
    let wanted = alias.map_or(plain.as_str(), |(_, name)| name);
    pages().iter().filter(|page| page.is_called(wanted)).collect()
}

impl Page {
    /// Whether `name` is the code, or the end of it from a `::` on.
    pub fn is_called(&self, name: &str) -> bool {
        let before = self.code.strip_suffix(name).filter(|_| !name.is_empty());
        before.is_some_and(|before| before.is_empty() || before.ends_with("::"))
    }

    /// The phase that reports it: `resolve`.
    pub fn phase(&self) -> &'static str {
        self.code.split("::").nth(1).unwrap_or_default()
    }

    /// The last word of the code: `unknown_name`.
    pub fn name(&self) -> &'static str {
        self.code.rsplit("::").next().unwrap_or(self.code)
    }

    /// The shortest name that means this page and no other: `unknown_name`, or `check::out_of_range`.
    pub fn short_name(&self) -> &'static str {
        let name = self.name();
        let is_only = pages().iter().filter(|page| page.is_called(name)).count() == 1;
        if is_only { name } else { &self.code["snell::".len()..] }
    }

    /// The paragraphs and blocks below the heading.
    pub fn parts(&self) -> Vec<Part> {
        let mut rest = self.markdown.split_once('\n').map_or("", |(_, below)| below);
        let mut parts = Vec::new();
        while let Some((part, after)) = next_part(rest) {
            parts.push(part);
            rest = after;
        }
        parts
    }

    /// The first paragraph, on one line.
    pub fn opening(&self) -> String {
        let first = self.parts().into_iter().find_map(|part| match part {
            Part::Paragraph(text) => Some(text),
            Part::Block { .. } => None,
        });
        first.map(|text| text.split_whitespace().collect::<Vec<_>>().join(" ")).unwrap_or_default()
    }

    /// The first sentence.
    pub fn summary(&self) -> String {
        let opening = self.opening();
        let end =
            opening.match_indices(". ").find(|(at, _)| opening[..*at].matches('`').count().is_multiple_of(2));
        end.map_or(opening.clone(), |(at, _)| opening[..=at].to_owned())
    }
}

/// The first part of a text, and what follows it.
fn next_part(text: &'static str) -> Option<(Part, &'static str)> {
    let text = text.trim_start_matches('\n');
    if text.is_empty() {
        return None;
    }
    let Some(fenced) = text.strip_prefix("```") else {
        let end = text.find("\n\n").unwrap_or(text.len());
        return Some((Part::Paragraph(text[..end].trim_end()), &text[end..]));
    };
    let (info, rest) = fenced.split_once('\n')?;
    // An empty block has its closing fence right away.
    let (text, after) = match rest.strip_prefix("```") {
        Some(after) => ("", after),
        None => {
            let end = rest.find("\n```")?;
            (&rest[..=end], &rest[end + "\n```".len()..])
        }
    };
    Some((Part::Block { info, text }, after))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: Page = Page {
        code: "snell::resolve::odd",
        level: Level::Error,
        markdown: "# snell::resolve::odd\n\nWrite `a. b`, not\nodd. Second.\n\n```snell broken\na\n\nb\n```\n\nEnd.\n",
    };

    #[test]
    fn a_page_has_paragraphs_and_blocks() {
        let parts = [
            Part::Paragraph("Write `a. b`, not\nodd. Second."),
            Part::Block { info: "snell broken", text: "a\n\nb\n" },
            Part::Paragraph("End."),
        ];
        assert_eq!(PAGE.parts(), parts);
        assert_eq!(PAGE.summary(), "Write `a. b`, not odd.");
        assert_eq!(PAGE.phase(), "resolve");
    }

    #[test]
    fn a_page_is_found_by_any_end_of_its_code_in_any_case() {
        let codes = |asked| find(asked).iter().map(|page| page.code).collect::<Vec<_>>();
        let whole = ["snell::resolve::wrong_dimension"];
        for asked in [whole[0], "resolve::wrong_dimension", "Wrong-Dimension", "[wrong_dimension]"] {
            assert_eq!(codes(asked), whole, "{asked}");
        }
        assert_eq!(codes("out_of_range"), ["snell::check::out_of_range", "snell::resolve::out_of_range"]);
        assert_eq!(codes("difference"), ["snell::resolve::no_csg"]);
        assert_eq!(codes("dimension"), [""; 0]);
        assert_eq!(codes(""), [""; 0]);
    }

    #[test]
    fn pages_stand_in_order_and_begin_with_their_code() {
        assert!(pages().is_sorted_by_key(|page| page.code));
        for page in pages() {
            assert_eq!(page.markdown.lines().next(), Some(format!("# {}", page.code).as_str()));
            assert!(page.summary().ends_with('.'), "{}: {}", page.code, page.summary());
            assert_eq!(find(page.short_name()).len(), 1, "{}", page.code);
        }
    }
}
