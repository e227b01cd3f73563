//! What the paths of neighbouring pixels share.
//!
//! What leaves a matt point looks the same from everywhere, and so does the sky. Where the path of one pixel, scattered
//! widely at the first surface that is not clear, finds such a place, the paths of its neighbours could have found it as
//! well, and a shadow ray tells which of them would (Bekaert, Sbert, Halton 2002). So each such place, the *sender*, counts
//! for all points of a group, the *receivers*, that see it: in proportion to the density with which all these together find
//! it, the balance heuristic (Veach 1997, section 9.2.2), which leaves the mean of every pixel as it is. A ray is much
//! cheaper than the path that it saves. The price is that pixels of a group err alike; groups lie elsewhere in each stream.
//!
//! All that a direction finds is shared, because parts make up for each other: where the sky is hidden, what hides it is
//! bright, too. Only what looks otherwise from elsewhere, a gleam or a mirror, stays each path's own.

use super::path::{LIGHTS, PathTracer, Trace};
use super::vertex::Last;
use super::walk::Walk;
use super::{Counters, Event, Witness};
use crate::math::{Ray, Rgb, Vec3};
use crate::render::bsdf::{Bsdf, Lambertian};
use crate::render::geometry::SurfacePoint;
use crate::render::ledger;
use crate::render::light::Viewpoint;
use crate::render::media::Media;
use crate::render::photon::gathers;
use crate::render::sampler::Sampler;
use crate::render::shape::SourceId;
use crate::render::world::World;

/// Pixels along the side of a group.
pub const SIDE: u32 = 4;

/// Receivers that share, at the most: where paths have forked, a group has more, and they share by so many.
const MOST: usize = (SIDE * SIDE) as usize;

/// The paths of a group of pixels.
pub struct Group {
    /// The numbers of all paths from their receivers on.
    joint: Sampler,
    /// How many pixels it has.
    size: u32,
    /// The pixel whose path is under way, and its numbers.
    pixel: u32,
    own: Sampler,
    receivers: Vec<Receiver>,
    senders: Vec<Sender>,
}

/// The first point of a path that scatters widely.
struct Receiver {
    pixel: u32,
    /// What light from there counts.
    beta: Rgb,
    source: SourceId,
    /// The point itself, and where rays start that leave it.
    p: Vec3,
    origin: Vec3,
    scatter: Scatter,
    /// From where it looks for light, and how many paths do for each light drawn.
    from: Viewpoint,
    finders: f32,
    media: Media,
}

/// How a receiver scatters.
enum Scatter {
    Lambertian(Lambertian),
    /// The bsdf, seen along a direction.
    Other(Box<Bsdf>, Vec3),
}

/// What a path found from its receiver.
struct Sender {
    place: Place,
    /// The receiver that found it.
    finder: usize,
    /// What leaves it, other than what it emits.
    radiance: Rgb,
    /// Whether it emits.
    shines: bool,
}

/// Where a sender is.
enum Place {
    /// In a direction.
    Sky(Vec3),
    /// On a surface.
    At(Matt),
}

/// A point that looks the same from everywhere above it.
struct Matt {
    surface: SurfacePoint,
    /// The normals, geometric and shading, on the side from which it was found.
    n: Vec3,
    ns: Vec3,
}

/// How a receiver sees a sender.
struct Sight {
    wi: Vec3,
    /// The bsdf, times the cosine, and the density per steradian.
    value: Rgb,
    pdf: f32,
    /// Steradians for each square metre of the sender; 1 for the sky.
    scale: f32,
    /// In metres.
    distance: f32,
}

/// Whether pixels can share: not where a ray does not always meet the same, or light has another colour for each path.
pub fn can_share(world: &World) -> bool {
    !world.geometry.moves() && !world.materials.has_masks() && !world.materials.disperses()
}

/// Whether a surface scatters so widely that each direction from a point on it may as well start at its neighbours.
pub fn receives(bsdf: &Bsdf) -> bool {
    !bsdf.lobes().is_empty() && bsdf.lobes().iter().all(gathers) && !bsdf.spreads_through()
}

impl Group {
    fn new(cameras: &[(Ray, Sampler)]) -> Option<Self> {
        let (_, first) = *cameras.first()?;
        let size = cameras.len() as u32;
        Some(Self { joint: first, size, pixel: 0, own: first, receivers: Vec::new(), senders: Vec::new() })
    }
}

impl PathTracer<'_> {
    /// The radiances along the camera rays of a group; what comes about for one of them is told.
    pub(super) fn shared_radiances(
        &self,
        cameras: &[(Ray, Sampler)],
        told: Option<usize>,
        counters: &mut Counters,
        witness: &mut impl Witness,
    ) -> Vec<Rgb> {
        let Some(mut group) = Group::new(cameras) else { return Vec::new() };
        let mut radiances = Vec::with_capacity(cameras.len());
        for (i, (ray, sampler)) in cameras.iter().enumerate() {
            (group.pixel, group.own) = (i as u32, *sampler);
            let group = Some(&mut group);
            self.world.begin_path();
            radiances.push(if told == Some(i) {
                self.trace(*ray, sampler, group, counters, witness)
            } else {
                self.trace(*ray, sampler, group, counters, &mut ())
            });
        }
        let own = told.map(|told| radiances[told]);
        for sender in &group.senders {
            let company = sender.finder / MOST * MOST..;
            let company = &group.receivers[company];
            self.hand_out(sender, &company[..company.len().min(MOST)], &mut radiances, counters);
        }
        if let (Some(told), Some(own)) = (told, own) {
            witness.note(|| Event::Shared { paths: group.receivers.len(), added: radiances[told] - own });
        }
        radiances
    }

    /// Lights a receiver and follows its path on, to a sender; the vertex from which it goes on by itself, if it found none.
    pub(super) fn receive(
        &self,
        walk: &mut Walk,
        surface: &SurfacePoint,
        bsdf: Bsdf,
        group: &mut Group,
        trace: &mut Trace<impl Witness>,
    ) -> Option<SurfacePoint> {
        let vertex = walk.vertex(surface, &bsdf);
        let is_main = walk.sampler == group.own;
        let lights = if is_main { LIGHTS } else { 1 };
        let finders = group.size.min(MOST as u32) as f32 / lights as f32;
        let lit = self.lit_by(lights, finders, walk, &vertex, trace);
        trace.radiance += walk.beta * lit;

        let finder = group.receivers.len();
        group.receivers.push(Receiver {
            pixel: group.pixel,
            beta: walk.beta,
            source: surface.source,
            p: surface.p,
            origin: surface.origin(vertex.wo),
            scatter: match bsdf.lambertian(vertex.wo) {
                Some(lambertian) => Scatter::Lambertian(lambertian),
                None => Scatter::Other(Box::new(bsdf), vertex.wo),
            },
            from: vertex.viewpoint(),
            finders,
            media: walk.media,
        });
        if is_main {
            walk.sampler = group.joint.part(group.pixel, SIDE * SIDE);
        }
        self.draw(walk, &vertex, trace.witness)?;
        walk.last.pdf *= finders;
        walk.depth += 1;
        self.find(walk, finder, group, trace)
    }

    /// Follows a path from a receiver to what it finds: a sender, or a vertex that it does not share.
    fn find(
        &self,
        walk: &mut Walk,
        finder: usize,
        group: &mut Group,
        trace: &mut Trace<impl Witness>,
    ) -> Option<SurfacePoint> {
        trace.counters.rays += 1;
        let Some(hit) = self.world.closest_hit(&walk.ray) else {
            let (sky, place) = (self.world.lights.sky(walk.ray.d).0, Place::Sky(walk.ray.d));
            trace.witness.note(|| Event::Sends);
            trace.witness.note(|| Event::Sky { dir: walk.ray.d, added: sky });
            let shines = !sky.is_black();
            group.senders.push(Sender { place, finder, radiance: Rgb::BLACK, shines });
            return None;
        };
        let surface = self.world.interaction(&walk.ray, &hit);
        walk.pass_through(hit.t, self.world);
        trace.witness.note(|| Event::Vertex { surface, wo: walk.wo(), t: hit.t, beta: walk.beta });
        let bsdf = self.world.bsdf_between(&surface, walk.wo(), &walk.media);
        let Some(matt) = Matt::new(surface, &bsdf, walk.wo()) else {
            return self.shine(walk, &surface, trace).map(|()| surface);
        };
        trace.witness.note(|| Event::Sends);
        let mut radiance = Rgb::BLACK;
        if !self.ends(walk) && !bsdf.lobes().is_empty() {
            let Trace { counters, witness, .. } = trace;
            let mut rest = Trace { radiance, waiting: Vec::new(), counters, witness: *witness };
            self.follow_from(&mut walk.rest(), surface, &mut rest);
            radiance = rest.radiance;
        }
        let shines = !self.world.materials.emission(surface.material).is_none();
        group.senders.push(Sender { place: Place::At(matt), finder, radiance, shines });
        None
    }

    /// Adds what a sender sends to each receiver that sees it.
    fn hand_out(
        &self,
        sender: &Sender,
        receivers: &[Receiver],
        radiances: &mut [Rgb],
        counters: &mut Counters,
    ) {
        let finder = sender.finder % MOST;
        if !sender.radiance.is_valid() {
            // What is no radiance is told of the one pixel that found it.
            radiances[receivers[finder].pixel as usize] += sender.radiance;
            return;
        }
        if !sender.shines && sender.radiance.is_black() {
            return;
        }
        // Densities of different receivers compare by area at the sender.
        let (mut density, mut shares) = (0.0, [(0, Rgb::BLACK); MOST]);
        let mut count = 0;
        for (i, receiver) in receivers.iter().enumerate() {
            let Some(sight) = receiver.sight(&sender.place) else { continue };
            if i != finder {
                if self.world.is_watched {
                    ledger::share(receiver.source);
                }
                counters.rays += 1;
                if self.world.any_hit(&receiver.ray_to(&sender.place)) {
                    continue;
                }
            }
            density += sight.pdf * sight.scale;
            let last = Last { from: receiver.from, pdf: sight.pdf * receiver.finders, sharp: None };
            let sent = match &sender.place {
                Place::Sky(dir) => self.sky(*dir, &last),
                Place::At(matt) => {
                    let mut sent = sender.radiance;
                    if sender.shines {
                        sent += self.emitted(&matt.surface, -sight.wi, &last);
                    }
                    sent * receiver.media.transmittance(sight.distance, &self.world.materials)
                }
            };
            shares[count] = (receiver.pixel, receiver.beta * sight.value * sent * sight.scale);
            count += 1;
        }
        if density > 0.0 {
            for (pixel, share) in &shares[..count] {
                radiances[*pixel as usize] += *share / density;
            }
        }
    }
}

impl Matt {
    /// The point that was found from `wo`, if it looks the same to all who see its front as whoever found it does.
    ///
    /// A surface that scatters nothing is one: what it emits is asked for each time. A relief turns its normals towards the
    /// viewer, and a smooth surface does without its normals for those whom they do not face.
    fn new(surface: SurfacePoint, bsdf: &Bsdf, wo: Vec3) -> Option<Self> {
        if !(bsdf.lobes().is_empty() || bsdf.is_lambertian() && bsdf.normal() == surface.ns) {
            return None;
        }
        let side = 1.0_f32.copysign(wo.dot(surface.n));
        let matt = Self { surface, n: surface.n * side, ns: surface.ns * side };
        matt.faces(wo).then_some(matt)
    }

    fn faces(&self, wo: Vec3) -> bool {
        wo.dot(self.n) > 0.0 && wo.dot(self.ns) > 0.0
    }
}

impl Receiver {
    /// How it sees a sender, if nothing is in between; `None` where it never finds it, or not as a sender.
    fn sight(&self, place: &Place) -> Option<Sight> {
        let (wi, scale, distance) = match place {
            Place::Sky(dir) => (*dir, 1.0, f32::INFINITY),
            Place::At(matt) => {
                let to = matt.surface.p - self.p;
                let distance = to.length();
                let wi = to / distance;
                if !matt.faces(-wi) {
                    return None;
                }
                (wi, -wi.dot(matt.n) / distance / distance, distance)
            }
        };
        let (value, pdf) = match &self.scatter {
            Scatter::Lambertian(lambertian) => lambertian.eval_pdf(wi),
            Scatter::Other(bsdf, wo) => bsdf.eval_pdf(*wo, wi),
        };
        let is_sound = pdf > 0.0 && scale > 0.0 && scale.is_finite();
        is_sound.then_some(Sight { wi, value, pdf, scale, distance })
    }

    /// The ray that must be free.
    fn ray_to(&self, place: &Place) -> Ray {
        match place {
            Place::Sky(dir) => Ray::new(self.origin, *dir),
            Place::At(matt) => matt.surface.seen_from(self.origin),
        }
    }
}
