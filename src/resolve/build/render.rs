//! The `render` block.

use crate::ir::{Classic, Method, Photons, PixelPoint, Render};
use crate::resolve::error::Error;
use crate::resolve::fields::Fields;
use crate::resolve::{Env, Resolver, Value};
use crate::schema;
use crate::source::Spanned;
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
        let method = method(&fields);
        let classic = fields.nested("method").and_then(classic).unwrap_or_default();
        let stop = match fields.value("stop").map(|slot| &slot.value) {
            Some(Value::Stop(stop)) => *stop,
            _ => Default::default(),
        };
        let depth = fields.given_count("depth");
        let seed = fields.given("seed").map(|seed| seed.map(|seed| seed as u64));
        let photons = fields.nested("photons").map(photons).unwrap_or_default();
        self.scene.render = Render { method, stop, depth, seed, photons, classic };
    }
}

/// The method asked for; `None` for `auto`.
fn method(fields: &Fields) -> Option<Spanned<Method>> {
    if fields.nested("method").is_some() {
        return Some(Spanned::new(Method::Classic, fields.span("method")?));
    }
    let word = fields.word("method")?;
    let method = match word.value {
        "pt" => Method::Pt,
        "ppm" => Method::Ppm,
        "hybrid" => Method::Hybrid,
        "classic" => Method::Classic,
        _ => return None,
    };
    Some(word.map(|_| method))
}

fn classic(fields: &Fields) -> Option<Classic> {
    let word = |name| fields.word(name).map(|word| word.value);
    Some(Classic {
        blinn: word("shading")? == "blinn",
        shadows: fields.flag("shadows")?,
        ambient: fields.color("ambient")?.value,
        lit_backs: word("backs")? == "lit",
        pixel: match word("pixel")? {
            "center" => PixelPoint::Center,
            "corner" => PixelPoint::Corner,
            _ => PixelPoint::Filter,
        },
        floor: word("quantise")? == "floor",
    })
}

fn photons(fields: &Fields) -> Photons {
    Photons {
        count: fields.given_count("count"),
        k: fields.given_count("k"),
        radius: fields.given("radius"),
        shrink: fields.given("shrink"),
    }
}
