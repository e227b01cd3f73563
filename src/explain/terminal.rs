//! A page as a terminal shows it: wrapped, examples indented.

use super::{Level, Page, Part};
use std::fmt::Write;

/// How a page looks.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Whether to use ANSI colours.
    pub color: bool,
    /// The width in columns that text is wrapped to.
    pub width: usize,
}

/// What stands before each line of an example.
const INDENT: &str = "    ";

impl Page {
    /// The page as plain text.
    pub fn render(&self, look: &Look) -> String {
        let (level, hue) = match self.level {
            Level::Error => ("error", "1;31"),
            Level::Warning => ("warning", "1;33"),
        };
        let mut out = format!("{} ({level})\n", look.paint(hue, self.code));
        for part in self.parts() {
            out.push('\n');
            match part {
                Part::Paragraph(text) => look.paragraph(text, &mut out),
                Part::Block { info, text } => look.block(info, text, &mut out),
            }
        }
        out
    }
}

impl Look {
    /// `text` in the colour of this ANSI code.
    pub fn paint(&self, code: &str, text: &str) -> String {
        if self.color { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }

    /// Wraps `text` to lines that begin with `indent`; what stands in backticks stays together.
    pub fn wrap(&self, text: &str, indent: &str, out: &mut String) {
        let mut column = 0;
        for word in words(text) {
            let length = word.chars().count();
            if column > 0 && indent.len() + column + 1 + length > self.width {
                out.push('\n');
                column = 0;
            }
            match column {
                0 => out.push_str(indent),
                _ => out.push(' '),
            }
            column += length + usize::from(column > 0);
            out.push_str(&word);
        }
        out.push('\n');
    }

    fn paragraph(&self, text: &str, out: &mut String) {
        self.wrap(text, "", out);
    }

    /// An example, under its name when it is a file that the scene needs.
    fn block(&self, info: &str, text: &str, out: &mut String) {
        if let Some(name) = info.split_whitespace().find_map(|word| word.strip_prefix("file=")) {
            let _ = writeln!(out, "{INDENT}{}", self.paint("2", &format!("// {name}")));
        }
        for line in text.lines() {
            let line = if line.is_empty() { "" } else { &format!("{INDENT}{}", self.paint("36", line)) };
            let _ = writeln!(out, "{line}");
        }
    }
}

/// The words of a text, with the blanks between backticks as part of them.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut is_code = false;
    for word in text.split_whitespace() {
        match words.last_mut() {
            Some(last) if is_code => {
                last.push(' ');
                last.push_str(word);
            }
            _ => words.push(word.to_owned()),
        }
        is_code ^= word.matches('`').count() % 2 == 1;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: Page = Page {
        code: "snell::resolve::odd",
        level: Level::Error,
        markdown: "# snell::resolve::odd\n\nThe word `a b c` stays whole\nhere.\n\n```text file=a.txt\nx\n\ny\n```\n",
    };

    #[test]
    fn a_page_is_wrapped_and_its_examples_are_indented() {
        let said = PAGE.render(&Look { color: false, width: 14 });
        let page = "The word\n`a b c` stays\nwhole here.\n\n    // a.txt\n    x\n\n    y\n";
        assert_eq!(said, format!("snell::resolve::odd (error)\n\n{page}"));
    }

    #[test]
    fn colour_changes_no_letter() {
        let plain = PAGE.render(&Look { color: false, width: 80 });
        let mut painted = PAGE.render(&Look { color: true, width: 80 });
        for code in ["1;31", "36", "2", "0"] {
            painted = painted.replace(&format!("\x1b[{code}m"), "");
        }
        assert_eq!(painted, plain);
    }
}
