//! The `render` block.

use crate::ir::{Method, Photons, Render};
use crate::resolve::error::Error;
use crate::resolve::fields::Fields;
use crate::resolve::{Env, Resolver, Value};
use crate::schema;
use crate::syntax::ast::Object;

impl<'a> Resolver<'a> {
    /// `render { .. }`: one in a scene.
    pub(in crate::resolve) fn render(&mut self, object: &'a Object, env: &Env<'a>) {
        let block = schema::block("render").expect("declared in the registry");
        let fields = self.read(block, object.kind.span, &object.body, env);
        if let Some(first) = self.render {
            return self.report(Error::SecondBlock { kind: "render", second: object.kind.span, first });
        }
        self.render = Some(object.kind.span);
        let method = fields.word("method").and_then(|word| {
            let method = match word.value {
                "pt" => Method::Pt,
                "ppm" => Method::Ppm,
                _ => return None,
            };
            Some(word.map(|_| method))
        });
        let stop = match fields.value("stop").map(|slot| &slot.value) {
            Some(Value::Stop(stop)) => *stop,
            _ => Default::default(),
        };
        let depth = fields.given_count("depth");
        let seed = fields.given("seed").map(|seed| seed.map(|seed| seed as u64));
        let photons = fields.nested("photons").map(photons).unwrap_or_default();
        self.scene.render = Render { method, stop, depth, seed, photons };
    }
}

fn photons(fields: &Fields) -> Photons {
    Photons {
        count: fields.given_count("count"),
        k: fields.given_count("k"),
        radius: fields.given("radius"),
        shrink: fields.given("shrink"),
    }
}
