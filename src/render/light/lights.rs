//! All lights of a world, and the choice among them.

use super::rect::Parallelogram;
use super::tree::{LightBounds, LightTree};
use super::{AliasTable, Light, LightEnd, LightSample, Sky, Viewpoint};
use crate::math::{Rgb, Vec2, Vec3};
use crate::render::bsdf::{Emission, Materials};
use crate::render::geometry::{Geometry, PrimId, SurfacePoint};
use crate::render::sampler::{Dim, Sampler};
use rustc_hash::FxHashMap;

/// The lights of a world.
///
/// Photons leave them in proportion to their power. Paths that look for light at a point choose by what it may receive:
/// from lights with a place by a [`LightTree`], from those at infinity by their irradiance.
pub struct Lights {
    lights: Vec<Light>,
    /// By power.
    table: AliasTable,
    /// Where the environment stands in `lights`.
    sky: Option<u32>,
    /// What is drawn from as one, in the order of the tree's lights.
    emitters: Vec<Emitter>,
    tree: LightTree,
    /// Which emitter a primitive is part of.
    by_prim: FxHashMap<PrimId, u32>,
    /// Lights at infinity, in `lights`, with the irradiance of a surface that faces them, of unit luminance.
    distant: Vec<(u32, f32)>,
}

/// A light with a place.
enum Emitter {
    /// One of `lights`.
    One(u32),
    /// Two triangles of `lights` in one.
    Pair(Box<Parallelogram>, Emission),
}

/// A light that [`Lights::choose_for`] chose.
enum Choice<'a> {
    Emitter(&'a Emitter),
    Distant(&'a Light),
}

impl Lights {
    /// The given lights, one for each primitive that emits, and the sky.
    ///
    /// What emits but cannot be drawn from (a plane, an exact surface of revolution) is not among them: it is seen
    /// where a path meets it, and throws no photons.
    pub fn new(mut lights: Vec<Light>, sky: Option<Sky>, geometry: &Geometry, materials: &Materials) -> Self {
        let named = lights.len() as u32;
        for prim in shining_prims(geometry, materials) {
            lights.push(Light::Area { prim, emission: mean_emission(prim, geometry, materials) });
        }
        let sky = sky.map(|sky| {
            lights.push(Light::Environment(Box::new(sky)));
            lights.len() as u32 - 1
        });
        let weights: Vec<f64> =
            lights.iter().map(|light| f64::from(light.power(geometry).luminance())).collect();
        let distant = (0..).zip(&lights).map(|(i, light)| (i, light.distant_irradiance()));
        let distant = distant.filter(|(_, irradiance)| *irradiance > 0.0).collect();

        let mut all = Self {
            table: AliasTable::new(&weights),
            lights,
            sky,
            emitters: Vec::new(),
            tree: LightTree::new(&[]),
            by_prim: FxHashMap::default(),
            distant,
        };
        all.find_emitters(named, geometry, materials);
        all
    }

    /// Gathers what has a place: points first, then what shines, triangles in pairs where they make a parallelogram.
    fn find_emitters(&mut self, named: u32, geometry: &Geometry, materials: &Materials) {
        let mut bounds = Vec::new();
        let mut add = |emitters: &mut Vec<Emitter>, emitter, of: Option<LightBounds>| {
            let of = of.filter(|of| of.intensity > 0.0 && of.intensity.is_finite())?;
            bounds.push(of);
            emitters.push(emitter);
            Some(emitters.len() as u32 - 1)
        };
        let mut pairs = parallelograms(&self.lights, geometry, materials);
        let mut waiting = None;
        for (i, light) in (0..).zip(&self.lights) {
            let Light::Area { prim, emission } = light else {
                if i < named {
                    add(&mut self.emitters, Emitter::One(i), light.bounds(geometry));
                }
                continue;
            };
            let emitter = match (waiting.take(), pairs.remove(prim)) {
                (Some(emitter), _) => emitter,
                (None, Some(pair)) => {
                    let next = self.lights.get(i as usize + 1).and_then(|next| next.bounds(geometry));
                    let of = light.bounds(geometry).zip(next).map(|(a, b)| a.union(&b));
                    let emitter = add(&mut self.emitters, Emitter::Pair(Box::new(pair), *emission), of);
                    waiting = Some(emitter);
                    emitter
                }
                (None, None) => add(&mut self.emitters, Emitter::One(i), light.bounds(geometry)),
            };
            self.by_prim.extend(emitter.map(|emitter| (*prim, emitter)));
        }
        self.tree = LightTree::new(&bounds);
    }

    /// A light with its probability, in proportion to its power, by `u` in [0, 1); `None` when none has power.
    pub fn choose(&self, u: f32) -> Option<(&Light, f32)> {
        let (index, pmf) = self.table.sample(u)?;
        Some((&self.lights[index], pmf))
    }

    /// Draws a direction in which a point may see a light; its density counts the choice of the light.
    ///
    /// `None` where no light shines, or none that only chance would not find as well.
    pub fn sample_li(
        &self,
        geometry: &Geometry,
        from: &Viewpoint,
        u_choice: Vec2,
        u: Vec2,
    ) -> Option<LightSample> {
        let (choice, pmf) = self.choose_for(from, u_choice)?;
        let sample = match choice {
            Choice::Distant(Light::Environment(sky)) => {
                let (wi, pdf) = sky.sample_direct(u)?;
                LightSample {
                    wi,
                    radiance: sky.radiance(wi),
                    pdf,
                    delta: false,
                    end: LightEnd::Infinity,
                    prim: None,
                }
            }
            Choice::Distant(light) => light.sample_li(geometry, from.p, u)?,
            Choice::Emitter(Emitter::One(light)) => {
                self.lights[*light as usize].sample_li(geometry, from.p, u)?
            }
            Choice::Emitter(Emitter::Pair(pair, emission)) => {
                LightSample::of_surface(pair.sample_toward(from.p, u)?, emission)?
            }
        };
        Some(LightSample { pdf: sample.pdf * pmf, ..sample })
    }

    /// The density, per steradian seen from `from`, with which [`Self::sample_li`] draws the point `at` of a shining
    /// primitive; 0 for what is never drawn.
    pub fn pdf_area(&self, geometry: &Geometry, from: &Viewpoint, at: &SurfacePoint) -> f32 {
        let Some(&emitter) = self.by_prim.get(&at.prim) else { return 0.0 };
        let (near, _) = self.shares(from);
        if near == 0.0 {
            return 0.0;
        }
        let pdf = match &self.emitters[emitter as usize] {
            Emitter::One(_) => geometry.pdf_toward(at.prim, from.p, at),
            Emitter::Pair(pair, _) => pair.pdf_toward(from.p, at.p),
        };
        near * self.tree.pmf(from, emitter) * pdf
    }

    /// The radiance of the sky in a direction, and the density per steradian with which photons are sent from there.
    pub fn sky(&self, dir: Vec3) -> (Rgb, f32) {
        let Some((index, sky)) = self.sky.zip(self.the_sky()) else { return (Rgb::BLACK, 0.0) };
        (sky.radiance(dir), self.table.pmf(index as usize) * sky.pdf(dir))
    }

    /// The density per steradian with which [`Self::sample_li`] draws a direction of the sky.
    pub fn pdf_sky(&self, from: &Viewpoint, dir: Vec3) -> f32 {
        let Some(sky) = self.the_sky() else { return 0.0 };
        let pdf = sky.pdf_direct(dir);
        if pdf == 0.0 {
            return 0.0;
        }
        let (_, far) = self.shares(from);
        let (all, own) = self.distant.iter().fold((0.0, 0.0), |(all, own), &(index, irradiance)| {
            let weight = self.distant_weight(index, irradiance, from);
            (all + weight, if Some(index) == self.sky { weight } else { own })
        });
        if own > 0.0 { far * (own / all) * pdf } else { 0.0 }
    }

    /// Whether points of a shining primitive are ever drawn, and photons leave it.
    pub fn draws(&self, prim: PrimId) -> bool {
        self.by_prim.contains_key(&prim)
    }

    /// Every light.
    pub fn all(&self) -> &[Light] {
        &self.lights
    }

    fn the_sky(&self) -> Option<&Sky> {
        match &self.lights[self.sky? as usize] {
            Light::Environment(sky) => Some(sky),
            _ => None,
        }
    }

    /// The probabilities of lights with a place and of those at infinity; both 0 where none shines.
    fn shares(&self, from: &Viewpoint) -> (f32, f32) {
        if self.distant.is_empty() {
            return if self.emitters.is_empty() { (0.0, 0.0) } else { (1.0, 0.0) };
        }
        let near = self.tree.importance(from);
        let far: f32 = self
            .distant
            .iter()
            .map(|&(index, irradiance)| self.distant_weight(index, irradiance, from))
            .sum();
        let sum = near + far;
        if sum > 0.0 && sum.is_finite() { (near / sum, far / sum) } else { (0.0, 0.0) }
    }

    /// What a light at infinity may send to a point, in W·m⁻².
    fn distant_weight(&self, index: u32, irradiance: f32, from: &Viewpoint) -> f32 {
        match (&self.lights[index as usize], from.n) {
            (Light::Directional { direction, .. }, Some(n)) => irradiance * (-direction.dot(n)).max(0.0),
            _ => irradiance,
        }
    }

    /// A light with its probability for a point. Both coordinates of `u` are used: one alone has too few bits to tell
    /// a million lights apart.
    fn choose_for(&self, from: &Viewpoint, u: Vec2) -> Option<(Choice<'_>, f32)> {
        let u = f64::from(u.x) + f64::from(u.y) * UNIT_STEP;
        let (near, far) = self.shares(from);
        let split = f64::from(near);
        if u < split {
            let (emitter, pmf) = self.tree.sample(from, u / split)?;
            return Some((Choice::Emitter(&self.emitters[emitter as usize]), near * pmf));
        }
        if far == 0.0 {
            return None;
        }
        let weight = |&(index, irradiance): &(u32, f32)| self.distant_weight(index, irradiance, from);
        let total: f32 = self.distant.iter().map(weight).sum();
        let mut rest = ((u - split) / (1.0 - split)) as f32 * total;
        let mut last = None;
        for light in &self.distant {
            let weight = weight(light);
            if weight > 0.0 {
                last = Some((Choice::Distant(&self.lights[light.0 as usize]), far * (weight / total)));
                rest -= weight;
                if rest < 0.0 {
                    break;
                }
            }
        }
        last
    }
}

/// The distance between neighbouring numbers that a sampler gives.
const UNIT_STEP: f64 = 1.0 / 16_777_216.0;

/// The parallelograms that pairs of shining triangles in a row make up, by their first primitive.
fn parallelograms(
    lights: &[Light],
    geometry: &Geometry,
    materials: &Materials,
) -> FxHashMap<PrimId, Parallelogram> {
    let shining: FxHashMap<PrimId, ()> = lights
        .iter()
        .filter_map(|light| if let Light::Area { prim, .. } = light { Some((*prim, ())) } else { None })
        .collect();
    let mut found = FxHashMap::default();
    for (mesh, prims) in geometry.mesh_prims() {
        // What shines by a picture is drawn from triangle by triangle.
        if !shining.contains_key(&PrimId(prims.start)) || materials.glows(mesh.material) {
            continue;
        }
        let mut i = 0;
        while let [[a, b, c], second, ..] = mesh.triangles[i..] {
            let pair = (second[0] == a && second[1] == c)
                .then(|| {
                    Parallelogram::of([a, b, c, second[2]].map(|vertex| mesh.positions[vertex as usize]))
                })
                .flatten();
            i += if pair.is_some() { 2 } else { 1 };
            found.extend(pair.map(|pair| (PrimId(prims.start + i as u32 - 2), pair)));
        }
    }
    found
}

/// What a primitive emits, on average over points spread evenly on it.
///
/// Never less than a hundredth of the picture's mean: what only seems dark is drawn from too.
fn mean_emission(prim: PrimId, geometry: &Geometry, materials: &Materials) -> Emission {
    const POINTS: u32 = 64;
    const LEAST: f32 = 0.01;
    let material = geometry.material(prim);
    let overall = *materials.emission(material);
    if !materials.glows(material) {
        return overall;
    }
    let sampler = |i| Sampler::new(0, 0, 0, i);
    let mut sum = Emission::NONE;
    for i in 0..POINTS {
        let at = geometry.sample_area(prim, sampler(i).get_2d(Dim::Light(0)));
        if let Some(surface) = geometry.point_near(prim, at.p, at.n) {
            let here = materials.emission_at(&surface);
            sum = Emission { front: sum.front + here.front, back: sum.back + here.back };
        }
    }
    let least = |sum: Rgb, overall: Rgb| {
        let (mean, least) = (sum / POINTS as f32, overall * LEAST);
        Rgb::new(mean.r.max(least.r), mean.g.max(least.g), mean.b.max(least.b))
    };
    Emission { front: least(sum.front, overall.front), back: least(sum.back, overall.back) }
}

/// The primitives that emit and that points can be drawn from.
fn shining_prims(geometry: &Geometry, materials: &Materials) -> Vec<PrimId> {
    let shines = |material| !materials.emission(material).is_none();
    let meshes = geometry.mesh_prims().map(|(mesh, prims)| (mesh.material, prims));
    let instances = geometry.instance_prims().map(|(instance, prims)| (instance.material, prims));
    let triangles = meshes
        .chain(instances)
        .filter(|(material, _)| shines(*material))
        .flat_map(|(_, prims)| prims.map(PrimId));
    let solids = geometry
        .solid_prims()
        .filter(|(solid, _)| shines(solid.material))
        .filter(|(solid, _)| solid.kind.can_be_sampled())
        .map(|(_, prim)| prim);
    triangles.chain(solids).collect()
}
