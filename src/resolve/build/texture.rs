//! Textures and projections.

use crate::ir::material::{Channel, CheckerCells, ColorSpace, Join, Pattern};
use crate::ir::{Checker, ImageUse, Input, Projection, Texture, TextureKind, Wrap};
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
            "blend" => TextureKind::Blend {
                a: fields.input("a")?,
                b: fields.input("b")?,
                amount: fields.input("amount")?,
            },
            "planar" | "spherical" | "cubic" => return projection(fields).map(Value::Projection),
            _ => TextureKind::Pattern {
                a: fields.input("a")?,
                b: fields.input("b")?,
                pattern: pattern(fields)?,
            },
        };
        Some(Value::Texture(self.scene.textures.push(Texture { kind, span })))
    }

    /// `image("wood.png") * 0.8`: a texture that is made of what stands on both sides.
    pub(in crate::resolve) fn join_textures(
        &mut self,
        op: Join,
        a: Input,
        b: Input,
        span: Span,
    ) -> Value<'a> {
        Value::Texture(self.scene.textures.push(Texture { kind: TextureKind::Join { op, a, b }, span }))
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
            uv_rotation: 0.0,
            uv_offset: DVec2::ZERO,
            projection: Projection::Uv,
            space: ColorSpace::Auto,
            channel: Channel::Rgb,
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
        uv_rotation: fields.number("uv_rotation")?.value,
        uv_offset: fields.triple("uv_offset")?.value.truncate(),
        projection: match fields.value("projection").map(|slot| &slot.value) {
            Some(Value::Projection(projection)) => *projection,
            _ => Projection::Uv,
        },
        space: match fields.word("space")?.value {
            "srgb" => ColorSpace::Srgb,
            "linear" => ColorSpace::Linear,
            _ => ColorSpace::Auto,
        },
        channel: match fields.word("channel")?.value {
            "red" => Channel::Red,
            "green" => Channel::Green,
            "blue" => Channel::Blue,
            "alpha" => Channel::Alpha,
            _ => Channel::Rgb,
        },
    })
}

fn checker(fields: &Fields) -> Option<Checker> {
    let cells = match fields.given("size") {
        Some(size) => CheckerCells::Solid(size.value),
        None => CheckerCells::Uv(cells(fields)?),
    };
    Some(Checker { a: fields.input("a")?, b: fields.input("b")?, cells })
}

/// How many along u and v, said or by default.
fn cells(fields: &Fields) -> Option<DVec2> {
    match fields.triple("cells") {
        Some(cells) => Some(cells.value.truncate()),
        None => Some(DVec2::splat(fields.number("cells")?.value)),
    }
}

fn pattern(fields: &Fields) -> Option<Pattern> {
    let number = |name| Some(fields.number(name)?.value);
    Some(match fields.block.kind {
        "gradient" => Pattern::Gradient(match (fields.triple("start"), fields.triple("end")) {
            (Some(start), Some(end)) => Some([start.value, end.value]),
            _ => None,
        }),
        "noise" => Pattern::Noise { size: number("size")?, octaves: fields.count("octaves")?.value },
        "marble" => Pattern::Marble { size: number("size")?, turbulence: number("turbulence")? },
        "wood" => Pattern::Wood { size: number("size")?, turbulence: number("turbulence")? },
        _ => Pattern::Brick { cells: cells(fields)?, mortar: number("mortar")?, aspect: number("aspect")? },
    })
}

fn projection(fields: &Fields) -> Option<Projection> {
    let vector = |name| -> Option<DVec3> { Some(fields.triple(name)?.value) };
    Some(match fields.block.kind {
        "planar" => Projection::Planar { origin: vector("origin")?, u: vector("u")?, v: vector("v")? },
        "spherical" => Projection::Spherical { center: vector("center")? },
        _ => Projection::Cubic { center: vector("center")?, size: vector("size")? },
    })
}
