//! `snell explain`: what a diagnostic code means, and what to do.

use super::args::Color;
use super::{Exit, fail, print, session};
use crate::diag;
use crate::explain::{Look, Page, find, pages};
use clap::Args;
use std::io::{IsTerminal, stdout};

/// Arguments of `snell explain`.
#[derive(Args, Debug)]
pub struct ExplainArgs {
    /// The code, whole or its last word: `wrong_dimension`; all of them are listed without it
    #[arg(value_name = "CODE")]
    code: Option<String>,
    /// When to use colour
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    color: Color,
}

/// Prints the page of a code, or the list of all.
pub fn run(args: &ExplainArgs) -> Exit {
    let look = look(args.color);
    let Some(asked) = &args.code else {
        print(list(pages().iter(), &look));
        return Exit::Done;
    };
    let found = find(asked);
    match found[..] {
        [] => other(asked, &look),
        [page] => {
            print(page.render(&look));
            Exit::Done
        }
        _ => {
            let whole: Vec<String> = found.iter().map(|page| page.render(&look)).collect();
            let count = found.len();
            print(format_args!("{count} codes end in `{asked}`:\n\n{}", whole.join("\n\n")));
            Exit::Done
        }
    }
}

/// What is no code: a phase, whose codes are listed, or a slip.
fn other(asked: &str, look: &Look) -> Exit {
    let phase = asked.trim_start_matches("snell::").trim_end_matches("::").to_ascii_lowercase();
    let mut of_phase = pages().iter().filter(|page| page.phase() == phase).peekable();
    if of_phase.peek().is_some() {
        print(list(of_phase, look));
        return Exit::Done;
    }
    let name = asked.rsplit("::").next().unwrap_or(asked).to_ascii_lowercase();
    let names = pages().iter().map(Page::name);
    match diag::did_you_mean(&name, names) {
        Some(near) => fail(format_args!("no code is called `{asked}`: {near}")),
        None => fail(format_args!("no code is called `{asked}`; `snell explain` lists them all")),
    }
}

/// Codes by phase, each with its first sentence.
fn list(pages: impl Iterator<Item = &'static Page>, look: &Look) -> String {
    let mut out = String::new();
    let mut phase = "";
    for page in pages {
        if page.phase() != phase {
            phase = page.phase();
            let gap = if out.is_empty() { "" } else { "\n" };
            out.push_str(&format!("{gap}{}\n", look.paint("1", &format!("snell::{phase}"))));
        }
        out.push_str(&format!("  {}\n", look.paint("36", page.name())));
        look.wrap(&page.summary(), "      ", &mut out);
    }
    out
}

/// How pages look where standard output goes.
fn look(color: Color) -> Look {
    Look { color: session::paints(color, stdout().is_terminal()), width: session::result_width() }
}
