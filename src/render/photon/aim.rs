//! Photons aimed at what throws caustics.
//!
//! A light sends them into the cones that the balls around the [`Targets`] fill, seen from the point where a photon
//! starts; light from infinity, through the balls' discs. A photon that misses all targets would carry nothing of what
//! is wanted, so leaving it out loses nothing (Jensen 1996 asks the same of a projection map). The density of a ray is
//! that of the mixture: every cone that holds it could have drawn it.

use super::targets::{Ball, MAX_BALLS, Targets};
use crate::math::{Frame, Ray, Rgb, Vec2, Vec3, float, warp};
use crate::render::bsdf::MaterialId;
use crate::render::geometry::PrimId;
use crate::render::light::{AliasTable, Light, LightEnd, LightSample, Sky};
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;
use std::f32::consts::{PI, TAU};

/// A sky whose light comes from more than this, in steradians, is better found by paths that leave the caustic.
const WIDE_SKY: f64 = 1.0;

/// Sends photons from lights to targets.
pub struct Aim<'a> {
    world: &'a World,
    targets: Targets,
    /// Chooses among the world's lights by the power they send to the targets, about.
    table: AliasTable,
    /// Whether the sky is among them.
    sky: bool,
    /// Whether something endless may stand between infinity and the rest.
    has_endless: bool,
}

/// The kinds of lights that photons treat differently.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Source {
    /// Those with a place.
    Near,
    /// From infinity, along one direction.
    Directional,
    /// From infinity, along all.
    Sky,
}

impl Source {
    /// That of a direction drawn towards a light.
    pub fn of(drawn: &LightSample) -> Self {
        match drawn.end {
            LightEnd::At { .. } => Self::Near,
            LightEnd::Infinity if drawn.delta => Self::Directional,
            LightEnd::Infinity => Self::Sky,
        }
    }
}

/// A photon that leaves a light.
pub struct Aimed {
    /// Along its way.
    pub ray: Ray,
    /// Its power, in watts, if it were the only one.
    pub power: Rgb,
    /// Whether its light is infinitely far away.
    pub from_infinity: bool,
}

impl<'a> Aim<'a> {
    /// Finds what to aim at, and from where.
    pub fn new(world: &'a World) -> Self {
        let targets = Targets::new(&world.geometry, &world.materials);
        let lights = world.lights.all();
        let sky = lights.iter().any(|light| matches!(light, Light::Environment(sky) if is_narrow(sky)));
        let has_endless =
            world.geometry.solid_prims().any(|(_, prim)| world.geometry.prim_bounds(prim).is_none());
        let mut aim = Self { world, targets, table: AliasTable::new(&[]), sky, has_endless };
        let weights: Vec<f64> = lights.iter().map(|light| f64::from(aim.power_to_targets(light))).collect();
        aim.table = AliasTable::new(&weights);
        aim
    }

    /// Whether there is no light, or nothing to aim at.
    pub fn is_idle(&self) -> bool {
        self.table.sample(0.0).is_none()
    }

    /// Whether light from such a source by way of this primitive is brought by photons: if so, by nothing else.
    pub fn owns(&self, source: Source, material: MaterialId, prim: PrimId) -> bool {
        match source {
            Source::Near => self.targets.holds(material, prim, false),
            Source::Directional => self.targets.holds(material, prim, true),
            Source::Sky => self.sky && self.targets.holds(material, prim, true),
        }
    }

    /// Whether a primitive is a target, for light from infinity or from nearer.
    pub fn holds(&self, material: MaterialId, prim: PrimId, from_infinity: bool) -> bool {
        self.targets.holds(material, prim, from_infinity)
    }

    /// Draws a photon that is under way at `time`; `None` for one that carries nothing.
    ///
    /// The mean of the power over all draws is that of the light that leaves towards targets.
    pub fn emit(&self, sampler: &Sampler, time: f32) -> Option<Aimed> {
        let aimed = self.aimed(sampler)?;
        let ray = aimed.ray.at_time(time);
        // From infinity it starts where nothing bounded is behind it; what is endless may be.
        if aimed.from_infinity && self.has_endless && self.world.any_hit(&Ray { d: -ray.d, ..ray }) {
            return None;
        }
        Some(Aimed { ray, ..aimed })
    }

    fn aimed(&self, sampler: &Sampler) -> Option<Aimed> {
        let (index, pmf) = self.table.sample(sampler.get_1d(Dim::PhotonLight))?;
        let (u_dir, u_target) = (sampler.get_2d(Dim::PhotonDirection), sampler.get_1d(Dim::PhotonTarget));
        let u_pos = || sampler.get_2d(Dim::PhotonPosition);
        match &self.world.lights.all()[index] {
            Light::Point { p, intensity, .. } => {
                let cones = self.cones(*p, None);
                let (dir, pdf) = cones.sample(u_dir, u_target)?;
                Some(Aimed { ray: Ray::new(*p, dir), power: *intensity / (pdf * pmf), from_infinity: false })
            }
            Light::Spot(spot) => {
                let (dir, pdf) = self.cones(spot.p, None).sample(u_dir, u_target)?;
                let share = spot.share(dir);
                let power = spot.intensity * (share / (pdf * pmf));
                (share > 0.0).then(|| Aimed { ray: Ray::new(spot.p, dir), power, from_infinity: false })
            }
            Light::Area { prim, emission } => {
                let at = self.world.geometry.sample_area(*prim, u_pos());
                // Each side of what shines on both gets half of the photons.
                let (side, u_target, chance) = match (emission.front.is_black(), emission.back.is_black()) {
                    (false, false) if u_target < 0.5 => (1.0, 2.0 * u_target, 0.5),
                    (false, false) => (-1.0, 2.0 * u_target - 1.0, 0.5),
                    (true, _) => (-1.0, u_target, 1.0),
                    (false, true) => (1.0, u_target, 1.0),
                };
                let n = at.n * side;
                let (dir, pdf) = self.cones(at.p, Some(n)).sample(u_dir, u_target)?;
                let emission = self.world.emission_at(*prim, at.p, at.n);
                let power = emission.radiance(side) * (dir.dot(n) / (at.pdf_area * pdf * chance * pmf));
                Some(Aimed { ray: at.spawn(dir), power, from_infinity: false })
            }
            Light::Directional { direction, irradiance } => {
                self.emit_from_infinity(*direction, *irradiance / pmf, u_pos(), u_target)
            }
            Light::Environment(sky) => {
                let (towards, pdf) = sky.sample(u_dir);
                self.emit_from_infinity(-towards, sky.radiance(towards) / (pdf * pmf), u_pos(), u_target)
            }
        }
    }

    /// A photon from infinitely far away along `dir`, through the disc of one of the balls.
    ///
    /// `irradiance` is what arrives on a surface that faces the light, over the density of the direction.
    fn emit_from_infinity(&self, dir: Vec3, irradiance: Rgb, u: Vec2, u_target: f32) -> Option<Aimed> {
        let balls = self.targets.balls();
        let weight = |ball: &Ball| ball.radius * ball.radius * ball.albedo;
        let total: f32 = balls.iter().map(weight).sum();
        let chosen = pick(balls.iter().map(weight), u_target * total)?;
        let frame = Frame::from_normal(dir);
        let disk = warp::square_to_uniform_disk(u) * balls[chosen].radius;
        let p = balls[chosen].center + frame.x * disk.x + frame.y * disk.y;
        // Each disc is drawn in proportion to its area and albedo, so that its own density is the albedo over the total.
        let is_inside = |(i, ball): &(usize, &Ball)| {
            let to = p - ball.center;
            *i == chosen || (to - dir * to.dot(dir)).length_squared() <= ball.radius * ball.radius
        };
        let density: f32 = balls.iter().enumerate().filter(is_inside).map(|(_, ball)| ball.albedo).sum();
        let pdf = density / (PI * total);

        let bounds = self.world.geometry.bounds();
        let o = p - dir * ((p - bounds.center()).dot(dir) + bounds.radius());
        Some(Aimed { ray: Ray::new(o, dir), power: irradiance / pdf, from_infinity: true })
    }

    /// The cones of directions in which targets lie, seen from a point; for a surface, with its normal.
    fn cones(&self, p: Vec3, n: Option<Vec3>) -> Cones {
        let mut cones =
            Cones { cones: [Cone::default(); MAX_BALLS], count: 0, total: 0.0, everywhere: 0.0, n };
        cones.everywhere = self.targets.endless_albedo();
        for ball in self.targets.balls() {
            match Cone::around(ball, p, n) {
                Seen::Inside => cones.everywhere = cones.everywhere.max(ball.albedo),
                Seen::Below => {}
                Seen::In(cone) => cones.push(cone),
            }
        }
        // Where cones fill more than there is, all directions are simpler.
        let whole = if n.is_some() { PI } else { 4.0 * PI };
        let all = cones.cones().iter().map(|cone| cone.density).fold(0.0, f32::max);
        if cones.total > whole * all {
            (cones.everywhere, cones.count, cones.total) = (cones.everywhere.max(all), 0, 0.0);
        }
        cones.total += whole * cones.everywhere;
        cones
    }

    /// About the luminous power that a light sends to the targets, in watts; 0 only where it sends none.
    fn power_to_targets(&self, light: &Light) -> f32 {
        let geometry = &self.world.geometry;
        let discs = || self.targets.balls().iter().map(|ball| PI * ball.radius * ball.radius * ball.albedo);
        match light {
            _ if self.targets.is_empty() => 0.0,
            Light::Point { p, intensity, .. } => intensity.luminance() * self.cones(*p, None).total,
            Light::Spot(spot) => {
                let to_targets = spot.intensity.luminance() * self.cones(spot.p, None).total;
                to_targets.min(spot.power().luminance())
            }
            Light::Area { prim, emission } => {
                let at = geometry.sample_area(*prim, Vec2::splat(0.5));
                // Seen from one of its points; others may see more. Which way it faces is not asked.
                let share = (self.cones(at.p, None).total / PI).clamp(0.01, 1.0);
                (emission.front + emission.back).luminance() * (PI * geometry.area(*prim) as f32) * share
            }
            Light::Directional { irradiance, .. } => irradiance.luminance() * discs().sum::<f32>(),
            Light::Environment(sky) if self.sky => sky.mean().luminance() * 4.0 * PI * discs().sum::<f32>(),
            Light::Environment(_) => 0.0,
        }
    }
}

/// Whether most light of a sky comes from few directions: (∫L)² / ∫L² is small.
fn is_narrow(sky: &Sky) -> bool {
    const DRAWS: u32 = 1024;
    let (mut sum, mut sum_of_squares) = (0.0, 0.0);
    for i in 0..DRAWS {
        let u = Vec2::new((i as f32 + 0.5) / DRAWS as f32, (i as f32 * 0.618_034).fract());
        let (dir, pdf) = sky.sample(u);
        let radiance = f64::from(sky.radiance(dir).luminance());
        sum += radiance / f64::from(pdf);
        sum_of_squares += radiance * radiance / f64::from(pdf);
    }
    sum > 0.0 && sum * sum / (sum_of_squares * f64::from(DRAWS)) < WIDE_SKY
}

/// Which of some weights `rest`, below their sum, falls into.
fn pick(weights: impl Iterator<Item = f32>, mut rest: f32) -> Option<usize> {
    let mut last = None;
    for (i, weight) in weights.enumerate() {
        last = if weight > 0.0 { Some(i) } else { last };
        if rest < weight {
            break;
        }
        rest -= weight;
    }
    last
}

/// The directions in which targets lie, as a mixture of cones.
struct Cones {
    cones: [Cone; MAX_BALLS],
    count: usize,
    /// The sum of all weights.
    total: f32,
    /// The density, not yet divided by the total, with which all directions are drawn; those of a surface by cosine.
    everywhere: f32,
    n: Option<Vec3>,
}

/// One of them.
#[derive(Clone, Copy, Default)]
struct Cone {
    axis: Vec3,
    /// 1 − cos of half the angle: digits are kept where it is narrow.
    width: f32,
    /// Of its directions, not yet divided by the total.
    density: f32,
}

/// How a ball is seen from a point.
enum Seen {
    /// From within.
    Inside,
    /// Not at all: it lies below the horizon.
    Below,
    /// In a cone.
    In(Cone),
}

impl Cone {
    fn around(ball: &Ball, p: Vec3, n: Option<Vec3>) -> Seen {
        let to = ball.center - p;
        let distance2 = to.length_squared();
        let sin2 = ball.radius * ball.radius / distance2;
        if distance2 <= ball.radius * ball.radius * (1.0 + 1e-5) {
            return Seen::Inside;
        }
        let axis = to / distance2.sqrt();
        let cos = (1.0 - sin2).sqrt();
        // Towards where it is highest above the horizon: the cosine of a difference of angles.
        let highest = n.map_or(1.0, |n| {
            let (up, flat) = (axis.dot(n), axis.cross(n).length());
            if up >= cos { 1.0 } else { up * cos + flat * sin2.sqrt() }
        });
        if highest <= 0.0 {
            return Seen::Below;
        }
        Seen::In(Self { axis, width: sin2 / (1.0 + cos), density: ball.albedo * highest })
    }

    /// Whether a direction lies in it: by the square of a chord, 2 (1 − cos).
    fn holds(&self, dir: Vec3) -> bool {
        (dir - self.axis).length_squared() <= 2.0 * self.width
    }

    /// A uniform direction.
    fn sample(&self, u: Vec2) -> Vec3 {
        let down = u.x * self.width; // 1 − cos
        let r = (down * (2.0 - down)).max(0.0).sqrt();
        let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
        Frame::from_normal(self.axis).to_world(Vec3::new(r * cos_phi, r * sin_phi, 1.0 - down)).normalize()
    }
}

impl Cones {
    fn cones(&self) -> &[Cone] {
        &self.cones[..self.count]
    }

    fn push(&mut self, cone: Cone) {
        self.cones[self.count] = cone;
        self.count += 1;
        self.total += TAU * cone.width * cone.density;
    }

    /// A direction and its density per steradian; `None` when nothing lies in any, or below the horizon.
    fn sample(&self, u: Vec2, u_target: f32) -> Option<(Vec3, f32)> {
        let rest = u_target * self.total;
        let chosen = pick(self.cones().iter().map(|cone| TAU * cone.width * cone.density), rest);
        let of_cones = self.total - self.of_everywhere();
        let (chosen, dir) = match chosen {
            Some(i) if rest < of_cones => (Some(i), self.cones[i].sample(u)),
            _ if self.everywhere > 0.0 => (None, self.anywhere(u)),
            _ => return None,
        };
        let cos = self.n.map_or(1.0, |n| n.dot(dir));
        if cos <= 0.0 {
            return None;
        }
        let holds = |(i, cone): &(usize, &Cone)| Some(*i) == chosen || cone.holds(dir);
        let density: f32 = self.cones().iter().enumerate().filter(holds).map(|(_, cone)| cone.density).sum();
        Some((dir, (density + self.everywhere * cos) / self.total))
    }

    fn of_everywhere(&self) -> f32 {
        self.everywhere * if self.n.is_some() { PI } else { 4.0 * PI }
    }

    fn anywhere(&self, u: Vec2) -> Vec3 {
        match self.n {
            Some(n) => Frame::from_normal(n).to_world(warp::square_to_cosine_hemisphere(u)).normalize(),
            None => warp::square_to_uniform_sphere(u),
        }
    }
}
