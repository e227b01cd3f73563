//! Textures and projections.

use crate::ir::material::CheckerCells;
use crate::ir::{Checker, ImageUse, Projection, Texture, TextureKind, Wrap};
use crate::math::{DVec2, DVec3};
use crate::resolve::fields::Fields;
use crate::resolve::{Resolver, Value};
use crate::source::{Span, Spanned};

impl<'a> Resolver<'a> {
    /// The texture or projection of a block.
    pub(super) fn texture(&mut self, fields: &Fields<'a>, span: Span) -> Option<Value<'a>> {
        let kind = match fields.block.kind {
            "image" => TextureKind::Image(image(fields)?),
            "checker" => TextureKind::Checker(checker(fields)?),
            _ => return planar(fields).map(Value::Projection),
        };
        Some(Value::Texture(self.scene.textures.push(Texture { kind, span })))
    }

    /// `image("wood.png")`.
    pub(in crate::resolve) fn image_file(&mut self, file: &Spanned<Value<'a>>, span: Span) -> Value<'a> {
        let Value::Text(name) = &file.value else { return Value::Poison };
        let image = ImageUse {
            file: Spanned::new(name.to_string(), file.span),
            skip_missing: false,
            wrap: Wrap::Repeat,
            linear_filter: true,
            uv_scale: DVec2::ONE,
            uv_offset: DVec2::ZERO,
            projection: Projection::Uv,
        };
        Value::Texture(self.scene.textures.push(Texture { kind: TextureKind::Image(image), span }))
    }
}

fn image(fields: &Fields) -> Option<ImageUse> {
    let wrap = match fields.word("wrap")?.value {
        "clamp" => Wrap::Clamp,
        "mirror" => Wrap::Mirror,
        "border" => Wrap::Border(fields.color("border")?.value),
        _ => Wrap::Repeat,
    };
    Some(ImageUse {
        file: fields.text("file")?,
        skip_missing: fields.word("missing")?.value == "skip",
        wrap,
        linear_filter: fields.word("filter")?.value == "linear",
        uv_scale: fields.triple("uv_scale")?.value.truncate(),
        uv_offset: fields.triple("uv_offset")?.value.truncate(),
        projection: match fields.value("projection").map(|slot| &slot.value) {
            Some(Value::Projection(projection)) => *projection,
            _ => Projection::Uv,
        },
    })
}

fn checker(fields: &Fields) -> Option<Checker> {
    let cells = match (fields.given("size"), fields.triple("cells")) {
        (Some(size), _) => CheckerCells::Solid(size.value),
        (None, Some(cells)) => CheckerCells::Uv(cells.value.truncate()),
        (None, None) => CheckerCells::Uv(DVec2::splat(fields.number("cells")?.value)),
    };
    Some(Checker { a: fields.color("a")?, b: fields.color("b")?, cells })
}

fn planar(fields: &Fields) -> Option<Projection> {
    let vector = |name| -> Option<DVec3> { Some(fields.triple(name)?.value) };
    Some(Projection::Planar { origin: vector("origin")?, u: vector("u")?, v: vector("v")? })
}
