//! Tokens, and what may stand between them.

use crate::robust_syntax::SplitMix;

/// A text that grows.
pub struct Writer {
    pub random: SplitMix,
    text: String,
    /// How often a gap is not just a blank: once in so many.
    calm: usize,
    comments: usize,
}

impl Writer {
    pub fn new(mut random: SplitMix) -> Self {
        let calm = *random.one(&[4, 12, 40, 400]);
        Self { random, text: String::new(), calm, comments: 0 }
    }

    /// The text, with the line ends of one system or the other.
    pub fn finish(mut self) -> String {
        match self.random.below(8) {
            0 => self.text.replace('\n', "\r\n"),
            1 => format!("\u{FEFF}{}", self.text),
            _ => self.text,
        }
    }

    /// A token, glued to the one before.
    pub fn put(&mut self, token: &str) {
        self.text.push_str(token);
    }

    /// A gap that need not be there.
    pub fn tight(&mut self) {
        if self.is_wild() {
            self.within_line();
        }
    }

    /// A gap on the line.
    pub fn blank(&mut self) {
        if self.is_wild() { self.within_line() } else { self.put(" ") }
    }

    /// A gap that may end lines.
    pub fn free(&mut self) {
        if !self.is_wild() {
            return self.put(" ");
        }
        match self.random.below(3) {
            0 => self.within_line(),
            _ => self.line(),
        }
    }

    /// A gap that may end lines or not be there.
    pub fn loose(&mut self) {
        if self.is_wild() {
            self.free();
        }
    }

    /// A gap with a line end.
    pub fn line(&mut self) {
        if !self.is_wild() {
            return self.put("\n");
        }
        for _ in 0..1 + self.random.below(3) {
            match self.random.below(6) {
                0 => self.line_comment(),
                1 => self.comment(),
                2 => self.put("\n\n\n"),
                3 => self.put("\n      "),
                4 => self.put(" \t \n"),
                _ => self.put("\n\n"),
            }
        }
        self.put("\n");
    }

    /// What documents the item after it.
    pub fn doc(&mut self) {
        for _ in 0..self.random.below(3) {
            let comment = self.words();
            self.put(&format!("///{comment}\n"));
        }
    }

    /// A gap is a blank more often than not.
    pub fn is_wild(&mut self) -> bool {
        self.random.below(self.calm) == 0
    }

    fn within_line(&mut self) {
        match self.random.below(4) {
            0 => self.put("   "),
            1 => self.put("\t"),
            2 => self.put(" "),
            _ => {
                let comment = self.words();
                self.put(&format!(" /*{comment}*/ "));
            }
        }
    }

    fn line_comment(&mut self) {
        let (comment, slashes) = (self.words(), *self.random.one(&["//", "// ", "///", "////", "//!"]));
        self.put(&format!(" {slashes}{comment}\n"));
    }

    /// A comment that may hold others and line ends.
    fn comment(&mut self) {
        let (comment, inner) = (self.words(), self.words());
        match self.random.below(4) {
            0 => self.put(&format!(" /*{comment}*/")),
            1 => self.put(&format!(" /**{comment}\n     {inner} */ ")),
            2 => self.put(&format!("\n/*{comment}/*{inner}*/ // \n\"*/\n")),
            _ => self.put(&format!(" /*{comment}*//*{inner}*/")),
        }
    }

    /// What a comment says; each has its number, so that none can stand for another.
    fn words(&mut self) -> String {
        self.comments += 1;
        let text = *self.random.one(&[
            "",
            " a word",
            " }",
            " \"",
            " { ( [",
            " let x = 1",
            "\té",
            "   ",
            " # § 'x' ",
        ]);
        format!("{text} {}", self.comments)
    }
}
