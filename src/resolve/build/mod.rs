//! From blocks whose fields were read to what they mean: a file per area of the language.

mod camera;
mod heights;
mod light;
mod material;
mod metal;
mod render;
mod shape;
mod sun;
mod texture;

use super::error::Error;
use super::{Env, Resolver, Value};
use crate::diag::{did_you_mean, did_you_mean_one_of, nearest, nearest_of_kind};
use crate::schema::{self, Area};
use crate::source::Span;
use crate::syntax::ast::{Block, Entry, Object};

/// Words of other systems for joining solids.
const CSG: &[&str] = &["difference", "union", "intersection", "merge", "subtract", "csg"];

impl<'a> Resolver<'a> {
    /// A block with its head, as a value.
    pub(super) fn object(&mut self, object: &'a Object, env: &Env<'a>) -> Value<'a> {
        let (kind, head) = kind_of(object);
        match schema::block(&kind).filter(|block| block.area != Area::Item && block.area != Area::Render) {
            Some(block) if kind == "environment" => self.misplaced_block(block, head),
            Some(block) if kind == "film" => self.misplaced_part(block, "camera", head),
            Some(block) if kind == "photo" || kind == "crop" => self.misplaced_part(block, "film", head),
            None if kind == "photons" || kind == "classic" => {
                let block = schema::block(&kind).expect("declared in the registry");
                self.misplaced_part(block, "render", head)
            }
            Some(block) => self.block(block, head, &object.body, env),
            None => self.no_such_block(object, &kind, head, env),
        }
    }

    /// The value of a block of a known kind.
    pub(super) fn block(
        &mut self,
        block: &'static schema::Block,
        head: Span,
        body: &'a Block,
        env: &Env<'a>,
    ) -> Value<'a> {
        let fields = self.read(block, head, body, env);
        let span = head.to(if body.span.is_empty() { head } else { body.span });
        let value = match block.area {
            Area::Shape => self.shape(&fields, body, span, env).map(Value::Object),
            Area::Light => self.light(&fields, span).map(Value::Object),
            Area::Material => self.material(&fields, span).map(Value::Material),
            Area::Texture => self.texture(&fields, span),
            Area::Camera => self.lens(&fields).map(|lens| Value::Lens(lens.into())),
            Area::Item | Area::Render => None,
        };
        value.unwrap_or(Value::Poison)
    }

    fn misplaced_block(&mut self, block: &schema::Block, used: Span) -> Value<'a> {
        let what = format!("`{}`", block.kind);
        let help = "it is an item: write it at the top level".to_owned();
        self.poison(Error::Misplaced { what, place: "where a value is wanted", used, help })
    }

    /// A block that stands in a field of another, outside of it.
    fn misplaced_part(&mut self, block: &schema::Block, owner: &str, used: Span) -> Value<'a> {
        let whole = schema::block(owner).expect("declared in the registry");
        let field = whole.fields().find(|field| field.ty.takes(block)).map_or("", |field| field.name);
        let what = format!("`{}`", block.kind);
        let help = format!(
            "it belongs into `{owner}`: `{field}: {}`",
            block
                .example
                .trim_start_matches("film: ")
                .trim_start_matches("crop: ")
                .trim_start_matches("photons: ")
        );
        self.poison(Error::Misplaced { what, place: "alone", used, help })
    }

    /// Looks for mistakes in a block of a misspelt kind, as in one of the kind that it is nearest to.
    fn misspelt_block(&mut self, object: &'a Object, kind: &str, env: &Env<'a>) {
        let meant = nearest_of_kind(kind, kinds_for(&object.body)).first().copied();
        let Some(block) = meant.and_then(schema::block).filter(|block| takes_fields(block, &object.body))
        else {
            return;
        };
        self.read(block, object.kind.span, &object.body, env);
        if block.holds_items() {
            self.members(&object.body, env);
        }
    }

    /// What to say of a kind of block that is none: what it is called here, or what is like it and has such fields.
    fn unknown_block_help(&mut self, object: &Object, kind: &str, env: &Env<'a>) -> Option<String> {
        if let Some(second) = &object.second {
            let is_field = schema::blocks().any(|block| block.field(&object.kind).is_some());
            if is_field && schema::block(second).is_some() {
                return Some(format!("write `{}: {} {{ .. }}`", object.kind.value, second.value));
            }
            if matches!(object.kind.as_str(), "shape" | "object" | "geometry" | "primitive" | "new")
                && schema::block(second).is_some()
            {
                return Some(format!("write `{} {{ .. }}`", second.value));
            }
            if !nearest(&object.kind, ["camera"]).is_empty() {
                return Some(format!("did you mean `camera {}`?", second.value));
            }
        }
        let place = schema::block("place").expect("declared in the registry");
        let fits = takes_fields(place, &object.body);
        let visible = env.visible();
        let names = visible.iter().map(|definition| (definition.name, fits));
        let near = nearest_of_kind(kind, kinds_for(&object.body).chain(names));
        self.proposed.extend(near.iter().map(|&name| name.to_owned()));
        did_you_mean_one_of(&near)
    }

    /// A block of no known kind. What its fields hold is looked at all the same.
    fn no_such_block(&mut self, object: &'a Object, kind: &str, used: Span, env: &Env<'a>) -> Value<'a> {
        if let Some(block) = schema::block(kind) {
            return self.misplaced_block(block, used);
        }
        let is_defined = env.find(&object.kind.value).is_some();
        let error = block_error(kind, used, is_defined).unwrap_or_else(|| {
            let help = self.unknown_block_help(object, kind, env);
            Error::UnknownBlock { kind: kind.to_owned(), used, help }
        });
        self.report(error);
        if CSG.contains(&kind) {
            self.members(&object.body, env);
        } else {
            self.misspelt_block(object, kind, env);
        }
        Value::Poison
    }
}

/// The words before the brace, and where they stand.
pub fn kind_of(object: &Object) -> (String, Span) {
    match &object.second {
        Some(second) => (format!("{} {}", object.kind.value, second.value), object.kind.span.to(second.span)),
        None => (object.kind.value.clone(), object.kind.span),
    }
}

/// What to say of a block of no known kind; `None` where only the names of the scene may help.
pub fn block_error(kind: &str, used: Span, is_defined: bool) -> Option<Error> {
    if CSG.contains(&kind) {
        return Some(Error::NoCsg { word: kind.to_owned(), used });
    }
    let help = if is_defined {
        let name = kind.split(' ').next().unwrap_or(kind);
        format!("to put it into the picture, write `place {name} {{ .. }}`")
    } else {
        foreign_block_help(kind)?
    };
    Some(Error::UnknownBlock { kind: kind.to_owned(), used, help: Some(help) })
}

/// What a block is called here that other programs have, too.
fn foreign_block_help(kind: &str) -> Option<String> {
    let ours = match kind.to_ascii_lowercase().replace('_', "").as_str() {
        "pointlight" => "light point",
        "spotlight" => "light spot",
        "disklight" => "light disk",
        "sunsky" | "daylight" => "light sun_sky",
        "spherelight" | "arealight" => "light sphere",
        "rectlight" | "quadlight" => "light rect",
        "directionallight" | "sunlight" | "sun" => "light directional",
        "ball" => "sphere",
        "cube" | "cuboid" => "box",
        "model" | "obj" | "trianglemesh" => "mesh",
        "lathe" | "sor" => "revolve",
        "prism" => "extrude",
        "checkerboard" | "checkers" | "chequer" => "checker",
        "lambert" | "lambertian" | "matte" | "matt" => "diffuse",
        "dielectric" => "glass",
        "conductor" => "metal",
        "emitter" | "emission" => "emissive",
        "rectangle" | "square" => "quad",
        "circle" | "disc" => "disk",
        "bitmap" | "picture" => "image",
        "sky" | "skybox" | "background" | "envmap" => "environment",
        "texture" | "pigment" | "finish" => {
            return Some(
                "a surface is a `material` of its object: `material: diffuse { color: #c4553a }`".to_owned(),
            );
        }
        "object" => {
            return Some(
                "write the object itself, as in `sphere { .. }`; with a name it is `place goblet { .. }`"
                    .to_owned(),
            );
        }
        word if word.starts_with("while ") => {
            return Some("a loop runs over a range: `for i in 0..3 { .. }`".to_owned());
        }
        _ => "",
    };
    if let Some(block) = schema::block(ours) {
        return Some(format!("it is called `{ours}` here: `{}`", block.example));
    }
    let lights = || schema::blocks().map(|block| block.kind).filter(|known| known.starts_with("light "));
    kind.starts_with("light").then(|| {
        let all: Vec<&str> = lights().collect();
        did_you_mean(kind, lights()).unwrap_or_else(|| format!("the lights are {}", schema::quoted(&all)))
    })
}

/// Every kind of block, and whether it takes the fields that are written.
pub fn kinds_for<'n>(body: &Block) -> impl Iterator<Item = (&'n str, bool)> {
    schema::blocks().map(|block| (block.kind, takes_fields(block, body)))
}

/// Whether a kind of block has the fields that are written, or most of them: one may be misspelt as well.
fn takes_fields(block: &schema::Block, body: &Block) -> bool {
    let field = |entry: &Entry| match entry {
        Entry::Field(field) => {
            Some(block.field(&field.name).or_else(|| block.field(&field.name.to_lowercase())).is_some())
        }
        Entry::Item(_) => None,
    };
    let (known, unknown): (Vec<bool>, Vec<bool>) =
        body.entries.iter().filter_map(field).partition(|known| *known);
    unknown.is_empty() || unknown.len() < known.len()
}
