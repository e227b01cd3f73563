//! Ast → ir: what a scene means. Names are bound, units applied, loops run; every mistake is noted.
//!
//! Definitions are evaluated when first needed, and once. A mistake leaves a poisoned value on which everything
//! that is made of it stays silent, so one mistake gives one report.

mod arguments;
mod budget;
mod build;
mod builtin;
mod call;
mod coerce;
mod color;
mod constructor;
mod dimension;
mod doubt;
mod error;
mod expr;
mod fields;
mod intent;
mod item;
mod lint;
mod meant;
mod mixed;
mod node;
mod noise;
mod operator;
mod param;
mod scope;
mod survey;
#[cfg(test)]
mod tests;
mod value;

use crate::diag::{Problems, Trail};
use crate::ir;
use crate::source::{SourceMap, Span, Spanned};
use crate::syntax::ast::{self, Entry, FileIndex, ItemKind};
pub use budget::Limits;
use budget::{Budget, Limit};
use dimension::Quantity;
pub use error::Error;
use miette::Diagnostic;
use mixed::BareUnit;
use rustc_hash::{FxHashMap, FxHashSet};
use scope::{Definition, Kind, Scope, State};
use std::collections::BTreeSet;
use std::rc::Rc;
pub use survey::{Offer, Offered, survey};
use value::Value;

/// A value that the command line gives to a parameter: `--set f_stop=8`.
#[derive(Clone, PartialEq, Debug)]
pub struct Setting {
    /// The parameter.
    pub name: Spanned<String>,
    /// What it shall be.
    pub value: ast::Expr,
}

/// What `program` means, with `settings` in place of the defaults of its parameters.
///
/// Mistakes go to `problems`; the scene holds what could be made sense of.
pub fn resolve(
    program: &ast::Program,
    sources: &SourceMap,
    settings: &[Setting],
    problems: &mut Problems,
) -> ir::Scene {
    resolve_within(program, sources, settings, &Limits::default(), problems)
}

/// [`resolve`], with other limits.
pub fn resolve_within(
    program: &ast::Program,
    sources: &SourceMap,
    settings: &[Setting],
    limits: &Limits,
    problems: &mut Problems,
) -> ir::Scene {
    if program.files.is_empty() {
        return ir::Scene::default();
    }
    let readable = !problems.has_errors();
    let doubtful = doubtful_words(sources, problems);
    let findings = lint::lint(program, problems);
    let mut resolver = Resolver::new(program, sources, problems);
    resolver.budget = Budget::new(limits);
    resolver.doubtful = doubtful;
    resolver.set_parameters(settings);
    resolver.run_file(FileIndex(0));
    resolver.evaluate_the_rest();
    resolver.report_doubts(findings.doubts);
    resolver.report_unused(findings.unused, readable);
    resolver.note_intent();
    resolver.scene
}

/// The words of the lines with the mistakes that were found so far.
fn doubtful_words<'a>(sources: &'a SourceMap, problems: &Problems) -> FxHashMap<&'a str, Vec<Span>> {
    let line = |offset: usize| {
        let file = sources.file(sources.find(u32::try_from(offset).ok()?)?);
        let lines = file.line_range(file.line_of(offset - file.base as usize));
        Some(Span::new(file.base + lines.start as u32, file.base + lines.end as u32))
    };
    let lines: BTreeSet<Span> = problems.list().iter().filter_map(|problem| line(problem.offset())).collect();
    let mut words: FxHashMap<&str, Vec<Span>> = FxHashMap::default();
    for line in lines {
        for word in sources.text(line).split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')) {
            words.entry(word).or_default().push(line);
        }
    }
    words
}

/// The scope in which an expression is evaluated.
type Env<'a> = Rc<Scope<'a>>;

/// The evaluation of a program.
struct Resolver<'a> {
    program: &'a ast::Program,
    sources: &'a SourceMap,
    problems: &'a mut Problems,
    scene: ir::Scene,
    /// The top-level scope of each file that is the main one or imported.
    roots: Vec<Option<Env<'a>>>,
    /// What a bare length is, for each file.
    units: Vec<BareUnit>,
    /// What a bare length is, where we are.
    unit: BareUnit,
    /// The bare number that became a length last.
    bare: Option<Span>,
    /// The calls and turns of loops we are in, the outermost first.
    trail: Vec<Step<'a>>,
    /// The definitions that are being evaluated.
    running: Vec<Rc<Definition<'a>>>,
    /// The functions we are in, by the places of their names.
    calls: Vec<Span>,
    /// The functions whose bodies a call has come to at least once.
    called: FxHashSet<Span>,
    /// The parts that may be left out and were not, by the offsets at which they begin.
    entered: FxHashSet<u32>,
    /// Reports that were made, by code and place: a loop repeats none.
    reported: FxHashSet<(String, usize)>,
    /// What the command line says, by parameter.
    settings: Vec<(&'a str, &'a Setting)>,
    /// Names that a report proposed for others: they are meant, only misspelt.
    proposed: FxHashSet<String>,
    /// The words of lines that could not be read as they are: what they name may have been defined there.
    doubtful: FxHashMap<&'a str, Vec<Span>>,
    environment: Option<Span>,
    render: Option<Span>,
    budget: Budget,
}

/// A step on the way to where we are; put into words only when something goes wrong there.
#[derive(Clone)]
enum Step<'a> {
    Call(&'a ast::Name, Span),
    Turn(&'a ast::Name, Option<Quantity>),
}

impl Step<'_> {
    fn told(&self) -> Trail {
        match self {
            Self::Call(name, span) => {
                Trail { span: *span, text: format!("in this call of `{}`", name.value) }
            }
            Self::Turn(name, Some(value)) => {
                Trail { span: name.span, text: format!("in the turn `{} = {}`", name.value, value.write()) }
            }
            Self::Turn(name, None) => {
                Trail { span: name.span, text: format!("in a turn of `{}`", name.value) }
            }
        }
    }
}

impl<'a> Resolver<'a> {
    fn new(program: &'a ast::Program, sources: &'a SourceMap, problems: &'a mut Problems) -> Self {
        let mut resolver = Self {
            program,
            sources,
            problems,
            scene: ir::Scene::default(),
            roots: vec![None; program.files.len()],
            units: vec![BareUnit::METRE; program.files.len()],
            unit: BareUnit::METRE,
            bare: None,
            trail: Vec::new(),
            running: Vec::new(),
            calls: Vec::new(),
            called: FxHashSet::default(),
            entered: FxHashSet::default(),
            reported: FxHashSet::default(),
            settings: Vec::new(),
            proposed: FxHashSet::default(),
            doubtful: FxHashMap::default(),
            environment: None,
            render: None,
            budget: Budget::default(),
        };
        resolver.read_units();
        resolver
    }

    /// Notes a mistake, with the calls and loops that led to it; the same mistake at the same place once.
    fn report(&mut self, error: Error) {
        let offset = error.labels().and_then(|mut labels| labels.next()).map_or(0, |label| label.offset());
        let code = error.code().map(|code| code.to_string()).unwrap_or_default();
        if self.reported.insert((code, offset)) && self.may_report(&error) {
            self.report_all_the_same(error);
        }
    }

    /// The calls we are in, the innermost first.
    fn calls_here(&self) -> Vec<Spanned<String>> {
        let call = |step: &Step| match step {
            Step::Call(name, span) => Some(Spanned::new(name.value.clone(), *span)),
            Step::Turn(..) => None,
        };
        self.trail.iter().rev().filter_map(call).collect()
    }

    /// Whether there are not too many mistakes already.
    fn may_report(&mut self, error: &Error) -> bool {
        let at = error.labels().and_then(|mut labels| labels.next());
        let span =
            at.map_or(Span::default(), |at| Span::new(at.offset() as u32, (at.offset() + at.len()) as u32));
        self.spend(Limit::Problems, 1, span)
    }

    fn report_all_the_same(&mut self, error: Error) {
        let trail = self.trail.iter().rev().map(Step::told).collect();
        self.problems.push_with_trail(error, trail);
    }

    /// Notes a mistake and gives the value on which everything stays silent.
    fn poison(&mut self, error: Error) -> Value<'a> {
        self.report(error);
        Value::Poison
    }

    /// "did you mean ..?", with a note of what was proposed.
    fn propose<'n>(&mut self, wanted: &str, names: impl IntoIterator<Item = &'n str>) -> Option<String> {
        let near = crate::diag::nearest(wanted, names);
        self.proposed.extend(near.iter().map(|&name| name.to_owned()));
        crate::diag::did_you_mean(wanted, near)
    }

    /// Notes that evaluation has come to a part that it may leave out.
    fn enter(&mut self, part: Span) {
        self.entered.insert(part.start);
    }

    /// Reports what is unknown in parts to which evaluation did not come.
    fn report_doubts(&mut self, doubts: Vec<doubt::Doubt>) {
        for doubt in doubts {
            if !self.entered.contains(&doubt.region) {
                self.report(doubt.error);
            }
        }
    }

    /// Warns of definitions that nothing uses, unless a misspelt name may have meant them. In a text that could not be
    /// read as it is, only what is named nowhere else, and nearly named on no line with a mistake, is surely unused.
    fn report_unused(&mut self, mut unused: Vec<lint::Unused<'a>>, readable: bool) {
        let root = self.root(FileIndex(0));
        let is_wrong = |name: &str| {
            root.own(name).is_some_and(|own| matches!(&*own.state.borrow(), State::Done(Value::Poison)))
        };
        unused.retain(|found| !self.proposed.contains(found.name) && !is_wrong(found.name));
        if !readable {
            let is_sure = |name: &str| self.count_of(name) == 1 && !self.may_be_in_doubtful_line(name);
            // A silence that could not be read may be meant for any of them.
            let is_unsure = self.program.lacks_files || self.doubtful.contains_key("allow");
            unused.retain(|found| !is_unsure && is_sure(found.name));
        }
        for found in unused {
            self.report(found.error());
        }
    }

    /// The text of a place on one line, cut when it is long.
    fn text(&self, span: Span) -> String {
        const LONGEST: usize = 40;
        let text = self.sources.text(span);
        let line = text.lines().next().unwrap_or("").trim_end();
        let short: String = line.chars().take(LONGEST).collect();
        if short.len() == text.len() { short } else { format!("{short} ..") }
    }

    /// The top-level scope of a file.
    fn root(&mut self, file: FileIndex) -> Env<'a> {
        let index = file.0 as usize;
        if let Some(scope) = &self.roots[index] {
            return Rc::clone(scope);
        }
        let scope = Scope::new(None);
        scope.declare_file(self.program, file, &self.units);
        self.roots[index] = Some(Rc::clone(&scope));
        scope
    }

    /// The value of a definition in `scope`, evaluated now if it was not yet.
    fn value_of(&mut self, scope: &Env<'a>, definition: &Rc<Definition<'a>>) -> Value<'a> {
        match &*definition.state.borrow() {
            State::Done(value) => return value.clone(),
            State::Running => {
                let cycle = self.cycle(definition);
                return self.poison(cycle);
            }
            State::Waiting => {}
        }
        *definition.state.borrow_mut() = State::Running;
        self.running.push(Rc::clone(definition));
        // A definition is evaluated where it stands: in its file's units, outside the calls that asked for it.
        let unit = std::mem::replace(&mut self.unit, definition.unit);
        let trail = std::mem::take(&mut self.trail);
        let value = self.define(scope, definition);
        self.trail = trail;
        self.unit = unit;
        self.running.pop();
        *definition.state.borrow_mut() = State::Done(value.clone());
        value
    }

    fn define(&mut self, scope: &Env<'a>, definition: &Rc<Definition<'a>>) -> Value<'a> {
        match definition.kind {
            Kind::Let(expr) => {
                let value = self.eval(expr, scope);
                self.name_value(definition, value)
            }
            Kind::Param { .. } => self.parameter(scope, definition),
            Kind::Function(function) => Value::Function(value::Function {
                definition: function,
                scope: Rc::clone(scope),
                unit: self.unit,
            }),
            Kind::Import(Some(file)) => {
                self.definitions_only(file);
                let root = self.root(file);
                for definition in root.in_order() {
                    self.value_of(&root, &definition);
                }
                Value::Module(root)
            }
            Kind::Instance(place, span) => {
                self.place(place, span, scope, Some(definition)).map_or(Value::Poison, Value::Object)
            }
            Kind::Import(None) | Kind::Given => Value::Poison,
        }
    }

    /// Lets a `let`'s objects and materials know their name.
    fn name_value(&mut self, definition: &Definition<'a>, value: Value<'a>) -> Value<'a> {
        match value {
            Value::Object(node) => {
                let id = self.name_id(definition);
                Value::Object(node::Node::named(node, id, definition.span))
            }
            Value::Material(handle) => {
                let name = &mut self.scene.materials[handle].name;
                name.get_or_insert_with(|| definition.name.to_owned());
                Value::Material(handle)
            }
            value => value,
        }
    }

    /// The id that objects placed under this name carry.
    fn name_id(&mut self, definition: &Definition<'a>) -> u32 {
        if let Some(id) = definition.name_id.get() {
            return id;
        }
        let id = self.scene.names.len() as u32;
        let name = Spanned::new(definition.name.to_owned(), definition.span);
        self.scene.names.push(ir::Named { name, count: 0, placed: Vec::new() });
        definition.name_id.set(Some(id));
        id
    }

    /// The definitions from this one to itself, each with what it needs.
    fn cycle(&self, again: &Rc<Definition<'a>>) -> Error {
        let start = self.running.iter().position(|running| Rc::ptr_eq(running, again)).unwrap_or(0);
        let round = &self.running[start..];
        let label = |(i, from): (usize, &Rc<Definition<'a>>)| {
            let to = round.get(i + 1).unwrap_or(again);
            let text = format!("`{}` needs `{}`", from.name, to.name);
            miette::LabeledSpan::new_with_span(Some(text), from.span)
        };
        let name = again.name.to_owned();
        let help = match color::named(&name) {
            Some(_) => format!("this name hides the colour `{name}`: choose another, such as `{name}_paint`"),
            None => "one of these has to be said without the others".to_owned(),
        };
        Error::Cycle { name, help, steps: round.iter().enumerate().map(label).collect() }
    }

    /// Evaluates what nothing has asked for, so that its mistakes are found in the same run.
    fn evaluate_the_rest(&mut self) {
        let mut done = 0;
        // Importing adds roots while we go; an evaluated definition costs nothing the second time.
        while done < self.roots.len() {
            if let Some(root) = self.roots[done].clone() {
                for definition in root.in_order() {
                    self.value_of(&root, &definition);
                }
            }
            done += 1;
        }
        for root in self.roots.clone().into_iter().flatten() {
            for definition in root.in_order() {
                if let Value::Function(function) = self.value_of(&root, &definition) {
                    self.try_function(&function);
                }
            }
        }
    }

    /// What a bare length means in each file.
    fn read_units(&mut self) {
        let program = self.program;
        for (index, file) in program.files.iter().enumerate() {
            let mut first = None;
            for item in &file.items {
                let ItemKind::Units(block) = &item.kind else { continue };
                match first {
                    Some(first) => {
                        self.report(Error::SecondBlock { kind: "units", second: item.span, first });
                    }
                    None => self.read_units_block(index, block, item.span),
                }
                first.get_or_insert(item.span);
            }
        }
    }

    fn read_units_block(&mut self, file: usize, body: &'a ast::Block, span: Span) {
        let block = crate::schema::block("units").expect("declared in the registry");
        let fields = self.read(block, span, body, &Scope::new(None));
        self.units[file].is_said = true;
        let Some(word) = fields.word("length") else { return };
        if let Some(length) = dimension::with_unit(1.0, word.value) {
            self.units[file].metres = length.value;
        }
    }

    /// Definitions of blocks are read by the scope; this says whether an entry is one.
    fn is_definition(entry: &Entry) -> bool {
        let Entry::Item(item) = entry else { return false };
        matches!(
            item.kind,
            ItemKind::Let { .. } | ItemKind::Param { .. } | ItemKind::Fn(_) | ItemKind::Import { .. }
        )
    }
}
