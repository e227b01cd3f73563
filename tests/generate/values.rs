//! Values of every type, written in many ways.

use super::items::Scene;
use snell::schema::{self, Arg, Block, Function, Takes, Times, Topic, Type};

/// Lists of this length are long enough to fill several lines.
const LONG: usize = 40;
/// The types whose values operators join.
const NUMERIC: [Type; 9] = [
    Type::Int,
    Type::Number,
    Type::Length,
    Type::Angle,
    Type::Time,
    Type::Power,
    Type::Temperature,
    Type::Pixels,
    Type::NumberInput,
];
/// The types whose values operators join, number by number.
const TUPLES: [Type; 4] = [Type::Point, Type::Offset, Type::Vector, Type::Pair];

impl Scene {
    /// A value for a field or a definition; `example` is one that makes sense there.
    pub fn value(&mut self, ty: Type, example: &str, depth: usize) {
        let named: Vec<String> =
            self.defined.iter().filter(|(_, of)| *of == ty).map(|(name, _)| name.clone()).collect();
        match self.random().below(8) {
            0..2 if !named.is_empty() => {
                let name = self.random().one(&named).clone();
                self.out.put(&name);
            }
            0 if depth > 0 => self.choice(ty, example, depth - 1),
            1 if depth > 0 => self.element(ty, example, depth - 1),
            _ => self.plain(ty, example, depth),
        }
    }

    /// A value where `if` may not begin one.
    pub fn operand(&mut self, ty: Type, example: &str, depth: usize) {
        match self.random().below(3) {
            0 => self.parenthesised(|scene| scene.value(ty, example, depth)),
            _ => self.plain(ty, example, depth),
        }
    }

    /// A value as its type alone has it.
    fn plain(&mut self, ty: Type, example: &str, depth: usize) {
        let blocks: Vec<&Block> = match ty {
            Type::Block(_) => Vec::new(),
            _ => schema::blocks().filter(|block| ty.takes(block)).collect(),
        };
        let inner = depth.saturating_sub(1);
        match ty {
            _ if depth == 0 => self.example(example),
            _ if NUMERIC.contains(&ty) => self.number(ty, example, depth),
            _ if TUPLES.contains(&ty) => self.tuple(ty, example, depth),
            Type::Bool => self.condition(inner),
            Type::Color | Type::ColorInput | Type::RadianceInput | Type::LightColor => self.color(ty, inner),
            Type::Absorption => {
                self.plain(Type::Color, "#f4fff6", inner);
                self.sign("per");
                self.plain(Type::Length, "10cm", inner);
            }
            Type::Transform => self.joined("then", Topic::Transforms, inner),
            Type::Stop => self.joined("or", Topic::Stops, inner),
            Type::Filter => self.joined("", Topic::Filters, inner),
            Type::Curve => self.curve(inner),
            Type::Block(kind) => self.body(schema::block(kind).expect("declared"), inner),
            Type::List => self.list(inner),
            Type::Size => {
                self.out.put("640");
                let parted = self.random().below(2) == 0;
                (0..2).for_each(|side| {
                    if parted {
                        self.out.blank();
                    }
                    self.out.put(["x", "480"][side]);
                });
            }
            _ if !blocks.is_empty() && self.random().below(4) > 0 => {
                let block = *self.random().one(&blocks);
                self.block(block, inner);
            }
            _ => self.example(example),
        }
    }

    /// An example of the registry, with other blanks between its words.
    fn example(&mut self, example: &str) {
        for (index, word) in example.split(' ').enumerate() {
            if index > 0 {
                self.out.blank();
            }
            self.out.put(word);
        }
    }

    /// A number near `example`.
    fn number(&mut self, ty: Type, example: &str, depth: usize) {
        // A block is a whole value, never an operand.
        let example = if example.contains('{') { ty.example() } else { example };
        let inner = depth - 1;
        let factor = *self.random().one(&["1", "2", "0.5", "1e0", "1_0", "150%", ".5"]);
        match self.random().below(12) {
            0 => self.parenthesised(|scene| scene.number_or(ty, example, inner)),
            1 => {
                self.number_or(ty, example, inner);
                self.sign("*");
                self.out.put(factor);
            }
            2 => {
                self.number_or(ty, example, inner);
                self.sign("+");
                self.number_or(ty, example, inner);
            }
            3 => {
                self.number_or(ty, example, inner);
                self.sign("-");
                self.out.put("-");
                self.parenthesised(|scene| scene.number_or(ty, example, inner));
            }
            4 => self.call_with("max", |scene| scene.number_or(ty, example, inner), 3),
            5 => self.call_with("min", |scene| scene.number_or(ty, example, inner), 2),
            6 if ty == Type::Number => self.call_of(Topic::Numbers, inner),
            6 if ty == Type::Angle => self.call_of(Topic::Angles, inner),
            7 if ty == Type::Int => {
                self.out.put("len");
                self.parenthesised(|scene| scene.list(inner));
            }
            7 if ty == Type::Number => self.call_of(Topic::Chance, inner),
            8 => {
                self.example(example);
                self.sign("/");
                self.out.put("2");
                self.sign("%");
                self.out.put("7");
                self.sign("^");
                self.out.put("2");
            }
            _ => self.example(example),
        }
    }

    fn number_or(&mut self, ty: Type, example: &str, depth: usize) {
        if depth == 0 { self.example(example) } else { self.number(ty, example, depth) }
    }

    fn tuple(&mut self, ty: Type, example: &str, depth: usize) {
        let inner = depth - 1;
        match self.random().below(6) {
            0 => {
                self.example(example);
                self.sign("+");
                self.example(example);
            }
            1 => {
                self.example(example);
                self.sign("*");
                self.number_or(Type::Number, "0.5", inner);
            }
            2 => {
                let (part, one) = match ty {
                    Type::Point | Type::Offset => (Type::Length, "30cm"),
                    _ => (Type::Number, "0.5"),
                };
                let count = if ty == Type::Pair { 2 } else { 3 };
                self.out.put("(");
                self.commas(count, |scene, _| scene.number_or(part, one, inner));
                self.out.put(")");
            }
            _ => self.example(example),
        }
    }

    /// Something that is true or false.
    pub fn condition(&mut self, depth: usize) {
        let inner = depth.saturating_sub(1);
        match if depth == 0 { 0 } else { self.random().below(7) } {
            0 => {
                let word = *self.random().one(&["true", "false"]);
                self.out.put(word);
            }
            1 => {
                self.out.put("not");
                self.out.blank();
                self.parenthesised(|scene| scene.condition(inner));
            }
            2 | 3 => {
                self.condition(inner);
                let word = *self.random().one(&["and", "or"]);
                self.sign(word);
                self.condition(inner);
            }
            _ => {
                let (ty, one) =
                    *self.random().one(&[(Type::Length, "2m"), (Type::Int, "3"), (Type::Angle, "9deg")]);
                self.number_or(ty, one, inner);
                let sign = *self.random().one(&["<", "<=", ">", ">=", "==", "!="]);
                self.sign(sign);
                self.number_or(ty, one, inner);
            }
        }
    }

    fn color(&mut self, ty: Type, depth: usize) {
        match self.random().below(7) {
            0 => self.out.put("tomato"),
            1 if ty == Type::LightColor => self.number_or(Type::Temperature, "3200K", depth),
            1 if matches!(ty, Type::ColorInput | Type::RadianceInput) => {
                self.plain(Type::Texture, Type::Texture.example(), depth)
            }
            2 => self.call_of(Topic::Colors, depth),
            3 => {
                self.out.put("#2f4F00");
                self.sign("*");
                self.number_or(Type::Number, "50%", depth);
            }
            _ => self.out.put("#0088fF"),
        }
    }

    /// A curve, its points after its word or in a call.
    fn curve(&mut self, depth: usize) {
        let word = *self.random().one(&["polyline", "bspline", "bezier"]);
        let count = if self.random().below(6) == 0 { LONG } else { 4 };
        self.out.put(word);
        match self.random().below(4) {
            0 if word == "bezier" => {
                self.out.put("(degree:");
                self.out.loose();
                self.out.put("all,");
                self.out.loose();
                self.points(count, depth);
                self.out.put(")");
            }
            0 => self.parenthesised(|scene| scene.points(count, depth)),
            _ => {
                self.out.blank();
                self.points(count, depth);
            }
        }
    }

    fn points(&mut self, count: usize, depth: usize) {
        self.out.put("[");
        self.commas(count, |scene, index| {
            scene.out.put(&format!("({}cm,", index % 5));
            scene.out.loose();
            scene.number_or(Type::Length, &format!("{index}cm"), depth / 2);
            scene.out.put(")");
        });
        self.out.put("]");
    }

    /// A list: its elements, one for each turn of a loop, or numbers in bulk.
    fn list(&mut self, depth: usize) {
        match self.random().below(4) {
            0 => {
                self.out.put("data");
                self.out.blank();
                let numbers = *self.random().one(&["[ 1 -2.5\n3e2,  4 ]", "[1\t2 // ]\n 3 /* ] */]", "[]"]);
                self.out.put(numbers);
            }
            1 => {
                self.out.put("[");
                self.out.loose();
                self.number_or(Type::Number, "0.5", depth);
                self.each(depth);
                self.out.put("]");
            }
            2 => {
                self.out.put("[");
                self.commas(LONG, |scene, index| scene.out.put(&format!("{index}.5")));
                self.out.put("]");
            }
            _ => {
                self.out.put("[");
                self.commas(3, |scene, _| scene.number_or(Type::Number, "2", depth));
                self.out.put("]");
            }
        }
    }

    /// `for i in 0..4 if i > 1`.
    fn each(&mut self, depth: usize) {
        self.out.free();
        self.out.put("for");
        self.out.blank();
        self.out.put("turn");
        self.out.blank();
        self.out.put("in");
        self.out.blank();
        let range = *self.random().one(&["0..4", "1 ..= 4", "[1, 2]"]);
        self.out.put(range);
        if self.random().below(3) == 0 {
            self.out.free();
            self.out.put("if");
            self.out.blank();
            self.condition(depth);
        }
        self.out.loose();
    }

    /// One of two values, by a condition.
    fn choice(&mut self, ty: Type, example: &str, depth: usize) {
        self.out.put("if");
        self.out.blank();
        self.condition(depth);
        for part in ["{", "} else {"] {
            self.out.free();
            self.example(part);
            self.out.free();
            self.value(ty, example, depth);
            self.out.free();
        }
        self.out.put("}");
    }

    /// An element of a list, or a value in parentheses.
    fn element(&mut self, ty: Type, example: &str, depth: usize) {
        if self.random().below(3) == 0 {
            return self.parenthesised(|scene| scene.value(ty, example, depth));
        }
        self.out.put("[");
        self.commas(2, |scene, _| scene.value(ty, example, depth));
        self.out.put("][");
        self.out.loose();
        self.number_or(Type::Int, "1", depth);
        self.out.loose();
        self.out.put("]");
    }

    /// Calls of some functions of a topic, joined by a word.
    fn joined(&mut self, word: &str, topic: Topic, depth: usize) {
        let more = if word.is_empty() { 0 } else { self.random().below(4) };
        self.call_of(topic, depth);
        for _ in 0..more {
            self.sign(word);
            self.call_of(topic, depth);
        }
    }

    /// A call of a function of this topic.
    fn call_of(&mut self, topic: Topic, depth: usize) {
        let functions: Vec<&Function> =
            schema::functions().filter(|function| function.topic == topic).collect();
        let function = *self.random().one(&functions);
        let form = *self.random().one(function.forms);
        let given = Function::count(form).0;
        let is_named = self.random().below(4) == 0 && form.iter().all(|arg| arg.times != Times::Often);
        self.out.put(function.name);
        self.out.put("(");
        self.commas(given, |scene, index| {
            let arg: &Arg = &form[index.min(form.len() - 1)];
            if is_named || arg.name == "degree" {
                scene.out.put(&format!("{}:", arg.name));
                scene.out.loose();
            }
            scene.argument(arg.takes, depth);
        });
        self.out.put(")");
    }

    fn argument(&mut self, takes: Takes, depth: usize) {
        match takes {
            Takes::Of(Type::List) => self.list(depth),
            Takes::Of(ty) => self.value(ty, ty.example(), depth),
            Takes::Tuple => self.value(Type::Vector, "(0, 1, 2)", depth),
            Takes::Points => self.points(4, depth),
            Takes::Alike | Takes::Number | Takes::Mixable => self.value(Type::Number, "0.5", depth),
        }
    }

    fn call_with(&mut self, name: &str, argument: impl Fn(&mut Self), count: usize) {
        self.out.put(name);
        self.out.put("(");
        self.commas(count, |scene, _| argument(scene));
        self.out.put(")");
    }

    fn parenthesised(&mut self, value: impl FnOnce(&mut Self)) {
        self.out.put("(");
        self.out.loose();
        value(self);
        self.out.loose();
        self.out.put(")");
    }

    /// Things with commas between them, and now and then one after the last.
    pub fn commas(&mut self, count: usize, mut thing: impl FnMut(&mut Self, usize)) {
        self.out.loose();
        for index in 0..count {
            thing(self, index);
            self.out.tight();
            if index + 1 < count {
                self.out.put(",");
                self.out.free();
            } else if self.random().below(8) == 0 {
                self.out.put(",");
            }
        }
        self.out.loose();
    }

    /// An operator; the line may end before or after it.
    fn sign(&mut self, sign: &str) {
        self.out.free();
        self.out.put(sign);
        self.out.free();
    }
}
