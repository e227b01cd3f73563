//! Snell text as a tree of blocks, laid out as a person would: on one line where it fits.

/// The longest line that is written.
const WIDTH: usize = 100;

/// One step of indentation.
const INDENT: &str = "    ";

/// A line or block of the result with the remarks above it.
#[derive(Clone, Debug)]
pub struct Entry {
    pub notes: Vec<String>,
    /// What stands before the value: `material: `, `let grey = `.
    pub prefix: String,
    pub value: Value,
}

/// What an entry says.
#[derive(Clone, Debug)]
pub enum Value {
    Text(String),
    /// `head { fields }`.
    Block(String, Vec<Entry>),
    /// `head { items }`, always on lines of their own.
    Group(String, Vec<Entry>),
    /// Operands that `then` joins.
    Chain(Vec<String>),
    /// `open items close`, such as a list of points.
    List(String, Vec<String>, String),
}

impl Entry {
    /// `name: value`.
    pub fn field(name: &str, value: impl Into<Value>) -> Self {
        Self { notes: Vec::new(), prefix: format!("{name}: "), value: value.into() }
    }

    /// A value that stands for itself.
    pub fn item(value: impl Into<Value>) -> Self {
        Self { notes: Vec::new(), prefix: String::new(), value: value.into() }
    }

    /// `let name = value`.
    pub fn binding(name: &str, value: impl Into<Value>) -> Self {
        Self { notes: Vec::new(), prefix: format!("let {name} = "), value: value.into() }
    }

    /// The same with remarks above it.
    pub fn noted(mut self, notes: &[String]) -> Self {
        self.notes.extend_from_slice(notes);
        self
    }

    /// The entry as lines, each indented and ended.
    pub fn render(&self, depth: usize) -> String {
        let indent = INDENT.repeat(depth);
        let mut out: String = self.notes.iter().map(|note| comment(note, depth)).collect();
        match self.flat() {
            Some(line) if indent.len() + line.chars().count() <= WIDTH => out += &format!("{indent}{line}\n"),
            _ => self.broken(depth, &indent, &mut out),
        }
        out
    }

    /// The entry on one line, if nothing in it needs lines of its own.
    pub fn flat(&self) -> Option<String> {
        let value = match &self.value {
            Value::Text(text) => text.clone(),
            Value::Group(head, entries) if entries.is_empty() => format!("{head}{{}}"),
            Value::Group(..) => return None,
            Value::Chain(steps) => steps.join(" then "),
            Value::List(open, items, close) => format!("{open}{}{close}", items.join(", ")),
            Value::Block(head, fields) => {
                let flat = |field: &Self| field.notes.is_empty().then(|| field.flat()).flatten();
                let fields: Option<Vec<String>> = fields.iter().map(flat).collect();
                match fields?.join(", ") {
                    fields if fields.is_empty() => format!("{head}{{}}"),
                    fields => format!("{head}{{ {fields} }}"),
                }
            }
        };
        Some(format!("{}{value}", self.prefix))
    }

    fn broken(&self, depth: usize, indent: &str, out: &mut String) {
        let prefix = &self.prefix;
        match &self.value {
            Value::Text(text) => *out += &format!("{indent}{prefix}{text}\n"),
            Value::Block(head, entries) | Value::Group(head, entries) => {
                *out += &format!("{indent}{prefix}{head}{{\n");
                *out += &entries.iter().map(|entry| entry.render(depth + 1)).collect::<String>();
                *out += &format!("{indent}}}\n");
            }
            Value::Chain(steps) => {
                *out += &format!("{indent}{prefix}{}\n", steps.join(&format!("\n{indent}{INDENT}then ")));
            }
            Value::List(open, items, close) => {
                *out += &format!("{indent}{prefix}{open}\n");
                *out += &wrap(items.iter().map(|item| format!("{item},")), depth + 1, "");
                *out += &format!("{indent}{close}\n");
            }
        }
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

/// A remark, wrapped into lines that begin with `//`.
pub fn comment(note: &str, depth: usize) -> String {
    wrap(note.split_whitespace().map(String::from), depth, "// ")
}

/// A remark that stands for itself.
pub fn remark(note: &str) -> Value {
    Value::Text(comment(note, 0).trim_end().to_string())
}

/// Words in lines no longer than [`WIDTH`], each line with `lead` before it.
fn wrap(words: impl Iterator<Item = String>, depth: usize, lead: &str) -> String {
    let start = format!("{}{lead}", INDENT.repeat(depth));
    let (mut out, mut line, mut length) = (String::new(), start.clone(), start.len());
    let mut is_empty = true;
    for word in words {
        let word_length = word.chars().count();
        if !is_empty && length + 1 + word_length > WIDTH {
            out += &line;
            out.push('\n');
            line.clone_from(&start);
            (length, is_empty) = (start.len(), true);
        }
        if !is_empty {
            line.push(' ');
            length += 1;
        }
        line += &word;
        length += word_length;
        is_empty = false;
    }
    out + line.trim_end() + "\n"
}

/// Entries one below the other; a blank line sets off those that take several lines.
pub fn paragraph(entries: &[Entry]) -> String {
    let mut out = String::new();
    let mut was_tall = false;
    for entry in entries {
        let text = entry.render(0);
        let is_tall = text.lines().count() > 1;
        if !out.is_empty() && (is_tall || was_tall) {
            out.push('\n');
        }
        out += &text;
        was_tall = is_tall;
    }
    out
}
