//! What may stand in a field.

use super::{Area, Block};

/// The type of a field, of a parameter, of a function's argument.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Type {
    /// A whole number.
    Int,
    /// A plain number, or a percentage.
    Number,
    /// Metres.
    Length,
    /// Radians.
    Angle,
    /// Seconds.
    Time,
    /// Watts.
    Power,
    /// Kelvin.
    Temperature,
    /// Pixels.
    Pixels,
    /// Steps of exposure, each a factor of 2.
    Exposure,
    /// `f/2.8`.
    FNumber,
    /// `true` or `false`.
    Bool,
    /// Words in quotes.
    Text,
    /// Three lengths, or two: a place.
    Point,
    /// Three lengths: the way from one place to another.
    Offset,
    /// Three plain numbers: a direction.
    Vector,
    /// Two plain numbers.
    Pair,
    /// Two plain numbers, or one for both.
    Cells,
    /// Linear colour; a plain number is grey.
    Color,
    /// A colour, or the temperature of a black body.
    LightColor,
    /// A colour or number in W/m²/sr.
    Radiance,
    /// `#f4fff6 per 10cm`.
    Absorption,
    /// A colour or a texture.
    ColorInput,
    /// A radiance, or a texture of it.
    RadianceInput,
    /// A number or a texture.
    NumberInput,
    /// A colour, a temperature, or an image.
    SkyInput,
    /// A material.
    Material,
    /// A texture.
    Texture,
    /// An object.
    Object,
    /// A transform.
    Transform,
    /// A lens.
    Lens,
    /// A length, a point or `on NAME`.
    Focus,
    /// Pixels by pixels.
    Size,
    /// A pixel filter.
    Filter,
    /// `samples(64) or time(5min)`.
    Stop,
    /// `uv` or `planar { .. }`.
    Projection,
    /// A profile: `bezier`, `bspline` or `polyline`.
    Curve,
    /// A curve in space.
    Path,
    /// A picture, a function, or rows of numbers.
    Heights,
    /// An outline: `polygon`, `bezier` or `bspline`.
    Outline,
    /// A list of outlines.
    Outlines,
    /// A list of anything.
    List,
    /// An integrator: one of [`Type::METHODS`], or `classic { .. }`.
    Method,
    /// How the light of a point fades: one of [`Type::FALLOFFS`], or three numbers.
    Falloff,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A block without a head, with the fields that this kind declares.
    Block(&'static str),
}

/// A type that has a name.
#[derive(Debug)]
pub struct NamedType {
    /// Its name.
    pub name: &'static str,
    /// The type.
    pub ty: Type,
    /// What it is.
    pub doc: &'static str,
}

const fn named(name: &'static str, ty: Type, doc: &'static str) -> NamedType {
    NamedType { name, ty, doc }
}

impl Type {
    /// Whether a colour stands there by itself.
    pub fn takes_color(self) -> bool {
        matches!(
            self,
            Self::Color
                | Self::LightColor
                | Self::Radiance
                | Self::ColorInput
                | Self::RadianceInput
                | Self::SkyInput
        )
    }

    /// The integrators.
    pub const METHODS: &'static [&'static str] = &["auto", "pt", "ppm", "hybrid", "classic"];
    /// The laws of fading that have a name.
    pub const FALLOFFS: &'static [&'static str] = &["physical", "none"];

    /// The blocks that are projections of pictures.
    const PROJECTIONS: &'static [&'static str] = &["planar", "spherical", "cubic"];

    /// The types that a `param` or a function may name.
    pub const NAMED: &'static [NamedType] = &[
        named("int", Self::Int, "A whole number."),
        named("number", Self::Number, "A plain number, or a percentage."),
        named("ratio", Self::Number, "Another word for `number`."),
        named(
            "length",
            Self::Length,
            "A number with a unit of length; a bare one counts as the file's `units` say.",
        ),
        named("angle", Self::Angle, "A number with a unit of angle."),
        named("time", Self::Time, "A number with a unit of time."),
        named("power", Self::Power, "A number of watts or lumens."),
        named("temperature", Self::Temperature, "A number of kelvin."),
        named("exposure", Self::Exposure, "Steps of exposure, or `auto`."),
        named("f_number", Self::FNumber, "The focal length by the width of the opening."),
        named("bool", Self::Bool, "`true` or `false`."),
        named("string", Self::Text, "A text in quotes."),
        named("point", Self::Point, "Three lengths: a place."),
        named("vector", Self::Vector, "Three plain numbers: a direction."),
        named("color", Self::Color, "A colour; a plain number is a grey."),
        named("material", Self::Material, "What an object is made of."),
        named("texture", Self::Texture, "What varies over a surface."),
        named("object", Self::Object, "A shape, a group, or a light."),
        named("light", Self::Object, "Another word for `object`."),
        named("transform", Self::Transform, "A way to move, turn and stretch."),
        named("list", Self::List, "Values in brackets."),
    ];

    /// The type that a `param` or a function calls by this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMED.iter().find(|known| known.name == name).map(|known| known.ty)
    }

    /// The words that it takes, if those are all that it takes for a word.
    pub const fn words(self) -> Option<&'static [&'static str]> {
        match self {
            Self::Choice(words) => Some(words),
            Self::Method => Some(Self::METHODS),
            Self::Falloff => Some(Self::FALLOFFS),
            _ => None,
        }
    }

    /// What is wanted, with its article: "a length".
    pub fn noun(self) -> String {
        match self {
            Self::Choice(words) => format!("one of {}", quoted(words)),
            Self::Method => format!("one of {}", quoted(Self::METHODS)),
            Self::Block(_) => "a block in braces".to_owned(),
            _ => self.plain_noun().to_owned(),
        }
    }

    const fn plain_noun(self) -> &'static str {
        match self {
            Self::Int => "a whole number",
            Self::Number => "a number",
            Self::Length => "a length",
            Self::Angle => "an angle",
            Self::Time => "a time",
            Self::Power => "a power",
            Self::Temperature => "a temperature",
            Self::Pixels => "a number of pixels",
            Self::Exposure => "an exposure",
            Self::FNumber => "an f-number",
            Self::Bool => "`true` or `false`",
            Self::Text => "a text in quotes",
            Self::Point => "a point",
            Self::Offset => "a vector of lengths",
            Self::Vector => "a direction",
            Self::Pair => "a pair of numbers",
            Self::Cells => "a number or a pair of numbers",
            Self::Color => "a colour",
            Self::LightColor => "a colour or a temperature",
            Self::Radiance => "a number or a colour",
            Self::Absorption => "a colour per length",
            Self::ColorInput => "a colour or a texture",
            Self::RadianceInput => "a number, a colour or a texture",
            Self::NumberInput => "a number or a texture",
            Self::SkyInput => "a colour or an image",
            Self::Material => "a material",
            Self::Texture => "a texture",
            Self::Object => "an object",
            Self::Transform => "a transform",
            Self::Lens => "a lens",
            Self::Focus => "a length, a point or `on NAME`",
            Self::Size => "a size in pixels",
            Self::Filter => "a pixel filter",
            Self::Stop => "a rule to stop by",
            Self::Projection => "a projection",
            Self::Curve => "a curve",
            Self::Path => "a path",
            Self::Heights => "a picture, a function or rows of numbers",
            Self::Outline => "an outline",
            Self::Outlines => "a list of outlines",
            Self::List => "a list",
            Self::Falloff => "a law of falloff",
            Self::Choice(_) | Self::Method | Self::Block(_) => "a word",
        }
    }

    /// A value of this type.
    pub const fn example(self) -> &'static str {
        match self {
            Self::Int => "12",
            Self::Number | Self::NumberInput => "0.5",
            Self::Length => "30cm",
            Self::Angle => "30deg",
            Self::Time => "5min",
            Self::Power => "60W",
            Self::Temperature => "3200K",
            Self::Pixels => "1px",
            Self::Exposure => "1EV",
            Self::FNumber => "f/2.8",
            Self::Bool => "true",
            Self::Text => "\"wood.png\"",
            Self::Point => "(0m, 1m, 2m)",
            Self::Offset => "(1m, 0m, 0m)",
            Self::Vector => "(0, 1, 0)",
            Self::Pair => "(2, 2)",
            Self::Cells => "8",
            Self::Color | Self::ColorInput => "#ff8800",
            Self::LightColor => "3200K",
            Self::Radiance | Self::RadianceInput => "10",
            Self::Absorption => "#f4fff6 per 10cm",
            Self::SkyInput => "image(\"sky.hdr\")",
            Self::Material => "diffuse { color: #ff8800 }",
            Self::Texture => "image(\"wood.png\")",
            Self::Object => "sphere { radius: 30cm }",
            Self::Transform => "scale(2) then translate(0m, 1m, 0m)",
            Self::Lens => "thin { focal_length: 50mm, aperture: f/2.8, focus: 2m }",
            Self::Focus => "2m",
            Self::Size => "1024 x 768",
            Self::Filter => "tent(1px)",
            Self::Stop => "samples(64) or time(5min)",
            Self::Projection => "uv",
            Self::Curve => "polyline [(0m, 0m), (10cm, 20cm)]",
            Self::Path => "polyline [(0m, 0m, 0m), (0m, 1m, 0m), (1m, 1m, 0m)]",
            Self::Heights => "[[0, 0, 0], [0, 1, 0], [0, 0, 0]]",
            Self::Outline => "polygon [(0m, 0m), (1m, 0m), (0m, 1m)]",
            Self::Outlines => "[polygon [(0m, 0m), (1m, 0m), (0m, 1m)]]",
            Self::List => "[1, 2, 3]",
            Self::Method => "auto",
            Self::Falloff => "(1, 0, 0.2)",
            Self::Choice(words) => words[0],
            Self::Block(_) => "{ .. }",
        }
    }

    /// Whether a block of this kind is a value of this type.
    pub fn takes(self, block: &Block) -> bool {
        match self {
            Self::Block(kind) => kind == block.kind,
            Self::Method => block.kind == "classic",
            Self::Lens => block.area == Area::Camera && !matches!(block.kind, "film" | "photo" | "crop"),
            Self::Exposure => block.kind == "photo",
            Self::Projection => Self::PROJECTIONS.contains(&block.kind),
            Self::Texture | Self::ColorInput | Self::RadianceInput | Self::NumberInput => {
                block.area == Area::Texture && !Self::PROJECTIONS.contains(&block.kind)
            }
            Self::SkyInput | Self::Heights => block.kind == "image",
            Self::Material => block.area == Area::Material,
            Self::Object => matches!(block.area, Area::Shape | Area::Light) && block.kind != "environment",
            _ => false,
        }
    }

    /// The unit in which a number of this type is usually written.
    pub const fn usual_unit(self) -> &'static str {
        match self {
            Self::Angle => "deg",
            _ => self.unit(),
        }
    }

    /// The SI unit of a number of this type.
    const fn unit(self) -> &'static str {
        match self {
            Self::Length | Self::Point | Self::Offset => "m",
            Self::Angle => "rad",
            Self::Time => "s",
            Self::Power => "W",
            Self::Temperature => "K",
            Self::Pixels => "px",
            Self::Exposure => "EV",
            _ => "",
        }
    }

    /// A number in SI units as a scene would say it: `45deg`, `36mm`.
    pub fn write(self, value: f64) -> String {
        /// From here on digits say less than the exponent.
        const LARGE: f64 = 1e7;
        if value.abs() >= LARGE && value.is_finite() {
            return format!("{value:e}{}", self.unit());
        }
        let rounded = |x: f64| (x * 1e9).round() / 1e9;
        match self {
            Self::Length | Self::Point | Self::Offset if value != 0.0 && value.abs() < 0.01 => {
                format!("{}mm", rounded(value * 1e3))
            }
            Self::Length | Self::Point | Self::Offset if value != 0.0 && value.abs() < 1.0 => {
                format!("{}cm", rounded(value * 1e2))
            }
            Self::Angle => format!("{}deg", rounded(value.to_degrees())),
            Self::FNumber => format!("f/{value}"),
            _ => format!("{}{}", rounded(value), self.unit()),
        }
    }
}

/// Words in backticks: "`a`, `b` or `c`".
pub fn quoted(words: &[&str]) -> String {
    match words {
        [] => String::new(),
        [one] => format!("`{one}`"),
        [rest @ .., last] => {
            let rest: Vec<String> = rest.iter().map(|word| format!("`{word}`")).collect();
            format!("{} or `{last}`", rest.join(", "))
        }
    }
}
