//! Items and blocks.

use super::writer::Writer;
use crate::robust_syntax::SplitMix;
use snell::schema::{self, Area, Block, Field, Need, Type};

/// How deep values lie in one another at most.
const DEPTH: usize = 3;
/// What definitions may be.
const TYPES: [Type; 10] = [
    Type::Int,
    Type::Number,
    Type::Length,
    Type::Angle,
    Type::Point,
    Type::Color,
    Type::Material,
    Type::Transform,
    Type::Bool,
    Type::Object,
];

/// A scene that is being written.
pub struct Scene {
    pub out: Writer,
    /// What is defined so far; later definitions may use it, so there are no cycles.
    pub defined: Vec<(String, Type)>,
    names: usize,
}

impl Scene {
    pub fn new(random: SplitMix) -> Self {
        Self { out: Writer::new(random), defined: Vec::new(), names: 0 }
    }

    pub fn random(&mut self) -> &mut SplitMix {
        &mut self.out.random
    }

    /// All of it.
    pub fn write(mut self) -> String {
        if self.random().below(4) == 0 {
            self.out.line();
        }
        self.out.put("snell");
        self.out.blank();
        self.out.put("1");
        self.out.line();
        if self.random().below(4) == 0 {
            self.files();
        }
        for _ in 0..1 + self.random().below(8) {
            self.item();
            self.out.line();
        }
        self.out.finish()
    }

    fn files(&mut self) {
        self.words(&["import", "\"lib.snell\"", "as", "lib"]);
        self.out.line();
        self.words(&["include", "\"room.snell\""]);
        self.out.line();
        self.words(&["units", "{", "length:", "m", "}"]);
        self.out.line();
        self.defined.push(("lib.red".to_owned(), Type::Material));
        self.defined.push(("lib.width".to_owned(), Type::Length));
    }

    /// Words with blanks between them.
    fn words(&mut self, words: &[&str]) {
        for (index, word) in words.iter().enumerate() {
            if index > 0 {
                self.out.blank();
            }
            self.out.put(word);
        }
    }

    fn item(&mut self) {
        if self.random().below(4) == 0 {
            self.out.doc();
        }
        if self.random().below(12) == 0 {
            self.out.put("allow(snell::resolve::unused,");
            self.out.loose();
            self.out.put("\"a reason\")");
            self.out.line();
        }
        match self.random().below(10) {
            0..3 => self.binding(),
            3 => self.param(),
            4 => self.function(),
            5 => self.thing_of(Area::Light),
            6 => self.thing_of(Area::Item),
            _ => self.part(2),
        }
    }

    /// An item that may stand in a group, too.
    fn part(&mut self, depth: usize) {
        match if depth == 0 { 0 } else { self.random().below(8) } {
            1 => self.repeat(depth),
            2 => self.choice_of_items(depth),
            3 | 4 => self.place(),
            _ => self.thing_of(Area::Shape),
        }
    }

    fn thing_of(&mut self, area: Area) {
        let blocks: Vec<&Block> = schema::blocks().filter(|block| block.area == area).collect();
        let block = *self.random().one(&blocks);
        match block.kind {
            "place" => self.place(),
            "camera" if self.random().below(2) == 0 => {
                self.out.put("camera");
                self.out.blank();
                let name = self.name();
                self.out.put(&name);
                self.out.blank();
                self.body(block, DEPTH);
            }
            _ => self.block(block, DEPTH),
        }
    }

    fn name(&mut self) -> String {
        self.names += 1;
        let stem = *self.random().one(&["a", "ring", "x", "fn_", "Long_name", "_b", "e1", "data_", "per_"]);
        format!("{stem}{}", self.names)
    }

    fn binding(&mut self) {
        let (name, ty) = (self.name(), *self.random().one(&TYPES));
        self.words(&["let", &name]);
        self.equals();
        self.value(ty, ty.example(), DEPTH);
        self.defined.push((name, ty));
    }

    fn equals(&mut self) {
        self.out.blank();
        self.out.put("=");
        self.out.free();
    }

    fn param(&mut self) {
        let kinds =
            [("int", "12", "1..=500"), ("length", "30cm", "1cm..=2m"), ("f_number", "f/2.8", "f/1..=f/32")];
        let (name, (ty, value, range)) = (self.name(), *self.random().one(&kinds));
        self.words(&["param", &name]);
        self.out.put(":");
        self.words(&["", ty]);
        self.equals();
        self.out.put(value);
        if self.random().below(2) == 0 {
            self.words(&["", "in", range]);
        }
        self.defined.push((name, Type::named(ty).expect("a type")));
    }

    fn function(&mut self) {
        let results = [("length", Type::Length, "1m"), ("object", Type::Object, "sphere { radius: 1m }")];
        let (name, (result, ty, example)) = (self.name(), *self.random().one(&results));
        self.words(&["fn", &name]);
        self.out.put("(");
        self.commas(2, |scene, index| {
            scene.out.put(["n: int", "width: length"][index]);
            if index == 1 {
                scene.equals();
                scene.value(Type::Length, "30cm", 1);
            }
        });
        self.words(&[")", "->", result, "{"]);
        self.out.free();
        if self.random().below(2) == 0 {
            self.words(&["let", "half", "=", "width", "/", "n"]);
            self.out.line();
        }
        self.value(ty, example, DEPTH - 1);
        self.out.free();
        self.out.put("}");
        self.defined.push((format!("{name}(3)"), ty));
        self.defined.push((format!("{name}(n: 3, width: 2m)"), ty));
    }

    fn repeat(&mut self, depth: usize) {
        let (name, range) = (self.name(), *self.random().one(&["0..3", "1..=2", "[1m, 2m]", "0..n_of(3)"]));
        let range = if range.contains("n_of") { "0 .. max(1, 3)" } else { range };
        self.words(&["for", &name, "in", range]);
        self.parts(depth);
    }

    fn choice_of_items(&mut self, depth: usize) {
        self.out.put("if");
        self.out.blank();
        self.condition(2);
        self.parts(depth);
        for _ in 0..self.random().below(3) {
            self.out.free();
            self.words(&["else", "if", "1 < 2"]);
            self.parts(depth);
        }
        if self.random().below(2) == 0 {
            self.out.free();
            self.out.put("else");
            self.parts(depth);
        }
    }

    /// Items between braces.
    fn parts(&mut self, depth: usize) {
        self.out.free();
        self.out.put("{");
        for _ in 0..self.random().below(3) {
            self.out.line();
            self.part(depth - 1);
        }
        self.out.line();
        self.out.put("}");
    }

    fn place(&mut self) {
        self.out.put("place");
        self.out.blank();
        self.operand(Type::Object, "sphere { radius: 1m }", 2);
        if self.random().below(3) == 0 {
            let name = self.name();
            self.words(&["", "as", &name]);
        }
        match self.random().below(3) {
            0 => {
                self.words(&["", "at", ""]);
                self.operand(Type::Point, "(0m, 1m, 2m)", 1);
            }
            1 => {
                self.out.blank();
                self.body(schema::block("place").expect("declared"), DEPTH);
            }
            _ => {}
        }
    }

    /// A block with its words.
    pub fn block(&mut self, block: &Block, depth: usize) {
        self.words(&block.kind.split(' ').collect::<Vec<_>>());
        self.out.free();
        self.body(block, depth);
    }

    /// What stands between the braces of a block, and those.
    pub fn body(&mut self, block: &Block, depth: usize) {
        let mut fields = self.fields_of(block);
        self.out.put("{");
        self.out.free();
        if block.holds_items() {
            for _ in 0..self.random().below(3) {
                self.part(depth.min(1));
                self.out.line();
            }
        }
        let is_on_lines = self.random().below(2) == 0;
        while !fields.is_empty() {
            let at = self.random().below(fields.len());
            let field = fields.remove(at);
            self.out.put(field.name);
            self.out.tight();
            self.out.put(":");
            self.out.free();
            self.value(field.ty, field.example(), depth);
            match (fields.is_empty(), is_on_lines) {
                (true, _) => self.out.free(),
                (false, true) => self.out.line(),
                (false, false) => {
                    self.out.tight();
                    self.out.put(",");
                    self.out.free();
                }
            }
        }
        self.out.put("}");
    }

    /// The fields that are given: what is required, one way of each choice, and some more.
    fn fields_of(&mut self, block: &Block) -> Vec<&'static Field> {
        let mut chosen: Vec<&str> = Vec::new();
        for choice in block.choices {
            chosen.extend(self.random().one(choice.ways).iter());
        }
        let is_choice = |field: &Field| {
            block.choices.iter().flat_map(|choice| choice.ways).any(|way| way.contains(&field.name))
        };
        let fields: Vec<&Field> = block.fields().collect();
        fields
            .into_iter()
            .filter(|field| match () {
                () if is_choice(field) => chosen.contains(&field.name),
                () => field.need == Need::Required || self.random().below(3) == 0,
            })
            .collect()
    }
}
