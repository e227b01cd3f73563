//! `allow(CODE, "why")`: that the codes which a scene silences are warnings, and that there is something to silence.
//!
//! The silencing itself is [`Problems::silence`].

mod error;

use crate::diag::{Problems, did_you_mean};
use crate::explain::{Level, Page, find, pages};
use crate::source::{SourceMap, Span};
pub use error::AllowError;

/// Notes the `allow`s of codes that are no warnings.
pub fn check(problems: &mut Problems) {
    let wrong: Vec<AllowError> =
        problems.allows().iter().filter_map(|allow| error(&allow.code.value, allow.code.span)).collect();
    wrong.into_iter().for_each(|error| problems.push(error));
}

/// Notes the `allow`s of the main file that silenced nothing; in other files they may be for other scenes.
///
/// That a file may be left out is never idle: whether it is there is not for the scene to say. Asked when every phase has
/// spoken. Where one of them found an error, the others may have been silent for that reason, and then so is this.
pub fn doubt_idle(sources: &SourceMap, problems: &mut Problems) {
    if problems.has_errors() {
        return;
    }
    problems.silence();
    let is_main =
        |at: Span| sources.find(at.start).is_some_and(|id| sources.file(id).included_from.is_none());
    let idle = problems.allows().iter().filter(|allow| !allow.used && is_main(allow.code.span));
    let idle = idle.filter(|allow| !allow.code.value.ends_with("skipped_file"));
    let idle: Vec<AllowError> = idle
        .map(|allow| AllowError::Idle { code: allow.code.value.clone(), used: allow.code.span })
        .collect();
    idle.into_iter().for_each(|error| problems.push(error));
}

/// What is wrong with silencing `code`.
fn error(code: &str, used: Span) -> Option<AllowError> {
    let mut meant = find(code);
    meant.retain(|page| !is_of_converter(page));
    if meant.iter().any(|page| page.level == Level::Warning) {
        return None;
    }
    let code = code.to_owned();
    if !meant.is_empty() {
        return Some(AllowError::NotAWarning { code, used });
    }
    let warnings = pages().iter().filter(|page| page.level == Level::Warning && !is_of_converter(page));
    let name = code.rsplit("::").next().unwrap_or(&code);
    let help = did_you_mean(name, warnings.map(Page::name)).unwrap_or_else(|| {
        "the code stands at the head of the warning; `snell explain` lists them all".to_owned()
    });
    Some(AllowError::UnknownCode { code, used, help })
}

/// Whether the code is about scenes of another format, in which there is no `allow`.
fn is_of_converter(page: &Page) -> bool {
    page.phase() == "convert"
}
