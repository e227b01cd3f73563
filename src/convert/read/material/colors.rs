//! Materials that say a colour for each thing a surface does to light.

use super::lobes::mixed;
use super::{USUAL_INDEX, clear, frosted};
use crate::convert::dialect::Dialect;
use crate::convert::fields::{Field, Fields};
use crate::convert::model::{Look, Texture};
use crate::convert::parse::Span;
use crate::convert::read::Reader;
use crate::math::DVec3;

impl Reader<'_> {
    /// A material of diffuse, specular, mirror and transparent colours.
    ///
    /// The course: `diffuse max(0, L.N) + specular max(0, V.R)^n` for each light, no shadows. MIT of 2004 adds
    /// `reflectiveColor` times the mirrored ray and `transparentColor` times the refracted one; its later editions
    /// weigh both of these with `specularColor`, the latter where `refractionIndex` is above 0.
    pub(super) fn colored_look(
        &mut self,
        fields: &mut Fields<'_>,
        dialect: Dialect,
        notes: &mut Vec<String>,
    ) -> Look {
        if self.is_classic() {
            return self.whitted_look(fields);
        }
        let has_diffuse = fields.has("color") || fields.peek_where("diffuse", Field::is_vector).is_some();
        let mirror = self.color_of(fields, "mirror", "the share and colour of a `mirror`");
        let glass = self.color_of(fields, "glass", "the share and colour of `glass`");
        let says_index = fields.peek("index").map(|field| field.span.clone());
        let index = self.index(fields, &["index", "refraction", "refr", "refractRate"]);
        let is_glass = index.is_some_and(|index| index > 0.0);
        let no_layers = mirror.is_none() && glass.is_none();
        if let Some(at) = says_index.filter(|_| no_layers && !dialect.is_mit() && dialect != Dialect::Implied)
            && let Some(look) = self.look_of_index(fields, index, &at)
        {
            return look;
        }
        let reflects_specular = matches!(dialect, Dialect::Mit2010 | Dialect::Mit2016) || is_glass;

        if dialect == Dialect::Implied && mirror.is_none() && glass.is_none() && !has_diffuse {
            return self.implied_look(fields, index);
        }
        if mirror.is_none() && glass.is_none() && !reflects_specular {
            return self.phong_look(fields, notes);
        }
        let specular = self.peek_color(fields, "specular");
        let index = index.filter(|index| *index > 0.0).unwrap_or(USUAL_INDEX);
        let mut lobes = Vec::new();
        if mirror.is_some() || glass.is_some() {
            lobes.push((mirror.unwrap_or_default(), Layer::Mirror));
            lobes.push((glass.unwrap_or_default(), Layer::Glass(index)));
        } else {
            let layer = if is_glass { Layer::Glass(index) } else { Layer::Mirror };
            lobes.push((specular, layer));
        }
        let base = match has_diffuse || !is_glass {
            true => self.phong_look(fields, notes),
            false => {
                self.log.take(fields, "specular").inspect(|field| {
                    self.log.mapped(&field.span, "the colour of the glass");
                });
                Look::Diffuse { color: Texture::plain(DVec3::ZERO) }
            }
        };
        layered(base, &lobes, notes)
    }

    /// An index of refraction, and neither a share nor a colour of what it refracts: glass, tinted by the one colour.
    fn look_of_index(&mut self, fields: &mut Fields<'_>, index: Option<f64>, at: &Span) -> Option<Look> {
        let has_specular = self.peek_color(fields, "specular") != DVec3::ZERO;
        let index = index.filter(|index| *index > 1.0 && !has_specular)?;
        let color = self.one_color(fields);
        let roughness = self.roughness(fields);
        let help =
            "it says how light bends and not how much of it does; if it is opaque, write `diffuse` instead";
        self.log.differs("a surface with an index of refraction was taken as glass", at, help);
        Some(frosted(index, color, roughness))
    }

    /// The terms of the original as they are: see [`Self::colored_look`].
    fn whitted_look(&mut self, fields: &mut Fields<'_>) -> Look {
        let diffuse = Texture::plain(self.term(fields, "diffuse").unwrap_or(DVec3::ONE));
        let specular = self.term(fields, "specular").unwrap_or_default();
        let mirror = self.term(fields, "mirror").unwrap_or_default();
        let glass = self.term(fields, "glass").unwrap_or_default();
        let shininess = self.log.take(fields, "shininess");
        if let Some(field) = &shininess {
            self.log.mapped(&field.span, "`shininess`");
        }
        let usual = if self.dialect == Dialect::Mit2004 { 1.0 } else { 0.0 };
        let shininess = shininess.map_or(usual, |field| field.number(0)).clamp(0.0, 1e5);
        let index = self.index(fields, &["index", "refraction", "refr", "refractRate"]).unwrap_or(0.0);

        let by_specular = matches!(self.dialect, Dialect::Mit2010 | Dialect::Mit2016);
        let fresnel = by_specular && index > 0.0;
        let (reflection, transmission) = match (by_specular, fresnel) {
            (true, true) => (specular, specular),
            (true, false) => (specular, DVec3::ZERO),
            (false, _) => (mirror, glass),
        };
        Look::Whitted { diffuse, specular, shininess, reflection, transmission, ior: index.max(1.0), fresnel }
    }

    /// The factor of a term; `diffuse` goes by two names.
    fn term(&mut self, fields: &mut Fields<'_>, role: &str) -> Option<DVec3> {
        let field = match self.log.take(fields, role) {
            None if role == "diffuse" => self.log.take(fields, "color"),
            field => field,
        }?;
        self.log.mapped(&field.span, "a factor of `whitted`");
        Some(field.vector().max(DVec3::ZERO))
    }

    /// The hybrid in which the fields that are there imply the kind: an index is glass, a specular colour alone a mirror.
    fn implied_look(&mut self, fields: &mut Fields<'_>, index: Option<f64>) -> Look {
        let color = match self.log.take(fields, "specular") {
            Some(field) => {
                self.log.mapped(&field.span, "colour");
                self.reflectance(&field)
            }
            None if index.is_some() => DVec3::ONE,
            None => return Look::Diffuse { color: Texture::plain(DVec3::ZERO) },
        };
        match index {
            Some(index) => clear(index, color),
            None => Look::Mirror { color: Texture::plain(color) },
        }
    }

    fn color_of(&mut self, fields: &mut Fields<'_>, role: &str, to: &str) -> Option<DVec3> {
        let field = self.log.take(fields, role)?;
        self.log.mapped(&field.span, to);
        let color = self.reflectance(&field);
        (color != DVec3::ZERO).then_some(color)
    }

    fn peek_color(&self, fields: &Fields<'_>, role: &str) -> DVec3 {
        fields.peek(role).map_or(DVec3::ZERO, Field::vector).clamp(DVec3::ZERO, DVec3::ONE)
    }

    /// A Phong lobe over a diffuse one, or a diffuse one alone.
    pub(super) fn phong_look(&mut self, fields: &mut Fields<'_>, notes: &mut Vec<String>) -> Look {
        let color = self.one_color(fields);
        let specular = self.log.take_any(fields, &["specular", "specular or share"]);
        let specular_color = specular.as_ref().map_or(DVec3::ZERO, |field| self.reflectance(field));
        let shininess = self.log.take(fields, "shininess");
        let roughness = if shininess.is_none() { self.roughness(fields) } else { 0.0 };
        if shininess.is_some() {
            self.log.put_aside(fields, &["gloss", "roughness"], "`shininess` says how wide the highlight is");
        }
        let matte = Look::Diffuse { color: Texture::plain(color) };
        if specular_color == DVec3::ZERO {
            for field in [&specular, &shininess].into_iter().flatten() {
                self.log.mapped(&field.span, "no highlight");
            }
            return matte;
        }
        let specular_span = specular.map(|field| field.span).unwrap_or_default();
        let how = "a `phong` lobe whose highlight is as bright as the original's at its middle";
        self.log.approximated(&specular_span, how);
        let exponent = match &shininess {
            Some(field) => {
                self.log.mapped(&field.span, "`shininess`");
                field.number(0).clamp(0.0, 1e5)
            }
            None if roughness > 0.0 => exponent_of(roughness),
            None => 0.0,
        };
        if exponent == 0.0 && !self.dialect.is_mit() {
            self.log.differs(
                "`specularColor` without `shininess` brightens the whole surface in the original",
                &specular_span,
                "it became a lobe of exponent 0, which is as wide; add `shininess` for a highlight",
            );
        }
        fitted_phong(Texture::plain(color), specular_color, exponent, notes)
    }
}

/// What lies over a base.
#[derive(Clone, Copy)]
enum Layer {
    Mirror,
    Glass(f64),
}

/// The Phong exponent whose lobe is as wide as GGX's of this roughness: `2 / alpha^2 - 2` (Walter et al. 2007).
pub(super) fn exponent_of(roughness: f64) -> f64 {
    let alpha = (roughness * roughness).max(5e-3);
    (2.0 / (alpha * alpha) - 2.0).max(0.0)
}

/// A base and layers that the original adds up, as lobes that are chosen by their shares.
///
/// What a lobe of share p and colour c adds is p c. The shares are in proportion to the colours' largest components m, so
/// the lobe of colour a has the colour a / p; where all m together are above 1, everything is divided by their sum, as
/// otherwise more light would leave than arrives.
fn layered(base: Look, layers: &[(DVec3, Layer)], notes: &mut Vec<String>) -> Look {
    let base_most = brightest(&base);
    let sum = base_most + layers.iter().map(|(color, _)| color.max_element()).sum::<f64>();
    if sum > 1.0 {
        notes.push(format!("The original's lobes add up to {:.3} of the light; these are scaled to 1.", sum));
    }
    let scale = sum.max(1.0);
    let mut lobes = vec![(base_most, brightened(base, sum / (base_most * scale)))];
    for &(color, layer) in layers {
        let most = color.max_element();
        if most <= 0.0 {
            continue;
        }
        let color = (color * (sum / (most * scale))).min(DVec3::ONE);
        let look = match layer {
            Layer::Mirror => Look::Mirror { color: Texture::plain(color) },
            Layer::Glass(index) => clear(index, color),
        };
        lobes.push((most, look));
    }
    let total: f64 = lobes.iter().map(|(share, _)| share).sum();
    if total <= 0.0 {
        return Look::Diffuse { color: Texture::plain(DVec3::ZERO) };
    }
    mixed(lobes.into_iter().map(|(share, look)| (share / total, look)).collect())
}

/// The largest share of light that a base reflects in any component.
fn brightest(look: &Look) -> f64 {
    match look {
        Look::Diffuse { color } => color.color.max_element(),
        Look::Phong { diffuse, specular, .. } => (diffuse.color + *specular).max_element(),
        _ => 0.0,
    }
}

fn brightened(look: Look, factor: f64) -> Look {
    let factor = if factor.is_finite() { factor } else { 1.0 };
    let times = |texture: Texture| texture.map(|color| (color * factor).min(DVec3::ONE));
    match look {
        Look::Diffuse { color } => Look::Diffuse { color: times(color) },
        Look::Phong { diffuse, specular, shininess } => {
            let diffuse = times(diffuse);
            let room = DVec3::ONE - diffuse.color;
            Look::Phong { specular: (specular * factor).min(room), diffuse, shininess }
        }
        look => look,
    }
}

/// A Phong lobe that shows like the course's own.
///
/// There, a light of colour c adds `c specular (V.R)^n`; here, with light that makes a white diffuse surface as bright
/// as there, it adds `c specular (n + 2) / 2 (V.R)^n cos`: the lobe is normalised. So the highlights are equally bright
/// for a specular colour of `2 / (n + 2)` of the original's. Both lobes are scaled where together they would reflect
/// more than they receive.
pub(super) fn fitted_phong(
    diffuse: Texture,
    specular: DVec3,
    shininess: f64,
    notes: &mut Vec<String>,
) -> Look {
    let specular = specular * (2.0 / (shininess + 2.0));
    notes.push("`specular` makes the highlight as bright as the original's, which is not normalised.".into());
    let most = (diffuse.color + specular).max_element();
    if most <= 1.0 {
        return Look::Phong { diffuse, specular, shininess };
    }
    let divisor = (most * 1e3).ceil() / 1e3; // so that rounding cannot bring the sum above 1
    notes.push(format!("Both colours are divided by {divisor}, lest more light leaves than arrives."));
    let diffuse = diffuse.map(|color| color / divisor);
    Look::Phong { diffuse, specular: specular / divisor, shininess }
}
