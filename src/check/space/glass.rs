//! Glass: that light which goes in comes out again, and that each place is filled by one glass or by one inside another.

use super::region::{Extent, Region};
use super::solid::{Form, Solid};
use super::stuff::Glass;
use super::surface::Surface;
use super::{Meshes, OwnMaterial, SpaceError, Survey, Thing, all_of_them, plane_of};
use crate::ir::{Caps, ShapeKind};
use crate::math::{DMat3, DVec2, DVec3};
use crate::source::Span;
use rustc_hash::FxHashSet;

/// Pairs of glasses that are compared, at most.
const MOST_PAIRS: usize = 200_000;
/// Things of glass among which lone ones are looked for, at most.
const MOST_LEAVES: usize = 500;
/// Surfaces nearer to each other than this share of their size lie in one place.
const ROUNDING: f64 = 1e-9;
/// An overlap thinner than this share of a solid's size is a touch.
const TOUCH: f64 = 1e-6;

/// A glass solid in its place.
struct Clear<'a> {
    thing: &'a Thing<'a>,
    solid: &'a Solid,
    glass: Glass,
}

impl Survey<'_> {
    /// Glass around a camera, and glasses that get into each other's way.
    pub(super) fn glass(&self) -> Vec<SpaceError> {
        let clear: Vec<Clear> = self.things.iter().filter_map(Clear::of).collect();
        let mut doubts = self.cameras_in_glass(&clear);
        let mut by_start: Vec<usize> = (0..clear.len()).collect();
        by_start.sort_by(|&a, &b| clear[a].solid.extent.min.x.total_cmp(&clear[b].solid.extent.min.x));
        let mut pairs = 0;
        let mut said: FxHashSet<(u32, u32)> = FxHashSet::default();
        for (position, &i) in by_start.iter().enumerate() {
            let end = clear[i].solid.extent.max.x;
            let near = by_start[position + 1..].iter().take_while(|&&j| clear[j].solid.extent.min.x <= end);
            for &j in near {
                pairs += 1;
                if pairs > MOST_PAIRS {
                    return doubts;
                }
                // In the order written.
                let (a, b) = (&clear[i.min(j)], &clear[i.max(j)]);
                let spans = (a.thing.object.span.start, b.thing.object.span.start);
                if let Some(doubt) = pair(a, b).filter(|_| said.insert(spans)) {
                    doubts.push(doubt);
                }
            }
        }
        doubts
    }

    fn cameras_in_glass(&self, clear: &[Clear<'_>]) -> Vec<SpaceError> {
        let cameras = self.scene.cameras.iter().zip(&self.eyes);
        let inside = |eye: &Region| {
            let solid = clear.iter().find(|glass| glass.solid.holds(eye) == Some(true));
            solid.map(|glass| glass.thing).or_else(|| self.things.iter().find(|thing| is_below(thing, eye)))
        };
        cameras
            .filter_map(|(camera, eye)| {
                let glass = inside(eye)?.object.span;
                Some(SpaceError::CameraInGlass { camera: camera.position.span, glass })
            })
            .collect()
    }

    /// Meshes of glass whose surface leaves open what is inside.
    pub(super) fn open_glass(&self, meshes: &dyn Meshes) -> Vec<SpaceError> {
        let mut seen = FxHashSet::default();
        let doubts = self.things.iter().filter_map(|thing| {
            let ShapeKind::Mesh { file, scale, .. } = &thing.kind else { return None };
            let is_clear = |own: OwnMaterial| match thing.is_painted {
                true => thing.stuff.clear.is_some(),
                false => own == OwnMaterial::Clear,
            };
            if !seen.insert((thing.object.shape.index(), thing.is_painted, thing.stuff.clear.is_some())) {
                return None;
            }
            let parts = meshes.parts(thing.object.shape);
            let glass = parts.iter().filter(|part| is_clear(part.own));
            let surface = Surface::of_parts(glass, scale.value);
            surface_doubt(&surface, &file.value, file.span)
        });
        doubts.chain(self.open_ends()).chain(self.lone_glass()).collect()
    }

    /// Tubes of glass without ends.
    fn open_ends(&self) -> impl Iterator<Item = SpaceError> {
        self.things.iter().filter(|thing| thing.stuff.clear.is_some()).filter_map(|thing| {
            let close = "leave `caps` out, or write `caps: true`";
            let (what, help) = match thing.kind {
                ShapeKind::Cone { caps: false, top_radius: None, .. } => ("cylinder", close),
                ShapeKind::Cone { caps: false, .. } => ("cone", close),
                ShapeKind::Sweep { caps: Caps::None, closed: false, .. } => {
                    ("tube", "leave `caps` out, or write `caps: round`")
                }
                _ => return None,
            };
            Some(SpaceError::OpenEnds { what, object: thing.object.span, help })
        })
    }

    /// Things of glass that enclose nothing and stand alone, so that they cannot be the faces of something with an inside.
    fn lone_glass(&self) -> impl Iterator<Item = SpaceError> {
        let glass: Vec<(&Thing<'_>, Extent)> = self
            .things
            .iter()
            .filter(|thing| thing.stuff.clear.is_some())
            .filter_map(|thing| Some((thing, thing.region.as_ref()?.extent().grown(TOUCH))))
            .take(MOST_LEAVES)
            .collect();
        let doubts = all_of_them(glass.iter().filter_map(|(thing, extent)| {
            let said = leaf(thing)?;
            let is_alone = !glass.iter().any(|(other, around)| {
                !std::ptr::eq(*other, *thing) && other.solid.is_none() && around.touches(extent)
            });
            Some((thing.object.span, is_alone.then_some(said)))
        }));
        doubts.into_iter().map(|(object, (what, help))| SpaceError::LoneGlass { what, object, help })
    }
}

impl<'a> Clear<'a> {
    fn of(thing: &'a Thing<'a>) -> Option<Self> {
        Some(Self { thing, solid: thing.solid.as_ref()?, glass: thing.stuff.clear? })
    }
}

/// What people call a thing that encloses nothing by itself, and what to do about it.
fn leaf(thing: &Thing<'_>) -> Option<(&'static str, &'static str)> {
    const PANE: &str =
        "for a pane write `thin: true` in its glass; with a thickness it is a `box` or another solid";
    match thing.kind {
        ShapeKind::Quad { .. } => Some(("quad", PANE)),
        ShapeKind::Disk { .. } => Some(("disk", PANE)),
        ShapeKind::Triangle { .. } => Some(("triangle", PANE)),
        ShapeKind::Heightfield { .. } => Some(("heightfield", PANE)),
        ShapeKind::Revolve { .. } if thing.solid.is_none() => Some((
            "surface of revolution",
            "begin and end its `profile` at radius 0, or end it where it began",
        )),
        _ => None,
    }
}

/// Whether an eye is on the inner side of an endless plane of glass.
fn is_below(thing: &Thing<'_>, eye: &Region) -> bool {
    let plane = thing.stuff.clear.and_then(|_| plane_of(thing));
    plane.is_some_and(|(n, offset)| eye.support(n) < offset)
}

/// What is wrong with a surface around glass.
fn surface_doubt(surface: &Surface, name: &str, used: Span) -> Option<SpaceError> {
    let name = name.to_owned();
    let seams = surface.seams();
    if surface.triangle_count() == 0 {
        None
    } else if seams.open > 0 {
        let edges =
            if seams.open == 1 { "1 open edge".to_owned() } else { format!("{} open edges", seams.open) };
        Some(SpaceError::OpenGlass { name, edges, used })
    } else if seams.mixed > 0 {
        let said =
            format!("at {} of its edges two triangles disagree about which side is outside", seams.mixed);
        Some(SpaceError::InsideOutGlass { name, said, used })
    } else if surface.volume() < 0.0 {
        let said = "its triangles face inwards".to_owned();
        Some(SpaceError::InsideOutGlass { name, said, used })
    } else {
        None
    }
}

/// What is wrong with two glasses beside each other.
fn pair(a: &Clear<'_>, b: &Clear<'_>) -> Option<SpaceError> {
    if !a.solid.extent.touches(&b.solid.extent.grown(ROUNDING)) {
        return None;
    }
    let (first, second) = (a.thing.object.span, b.thing.object.span);
    if coincide(a, b) {
        return Some(SpaceError::CoincidentGlass { second, first });
    }
    // Where alike glasses overlap they melt into one; of others, the scene may say which fills the space.
    let is_said = a.glass.priority != b.glass.priority;
    (a.glass != b.glass && !is_said && overlap(a.solid, b.solid))
        .then_some(SpaceError::GlassOverlap { second, first })
}

/// Whether two solids surely overlap without one being inside the other.
fn overlap(a: &Solid, b: &Solid) -> bool {
    if let (Form::Cube, Form::Cube) = (&a.form, &b.form) {
        let nested = a.holds(&b.region()) == Some(true) || b.holds(&a.region()) == Some(true);
        return !nested && !touches_at_most(a, b) && !touches_at_most(b, a) && !parted_by_edges(a, b);
    }
    crosses(a, b) || crosses(b, a)
}

/// Whether the surface of `a`, which hangs together, is inside of `b` in one place and outside in another.
fn crosses(a: &Solid, b: &Solid) -> bool {
    let (mut inside, mut outside) = (false, false);
    for p in a.surface_points().into_iter().chain(a.points_towards(b)) {
        match b.contains(p) {
            Some(true) => inside = true,
            Some(false) => outside = true,
            None => {}
        }
        if inside && outside {
            return true;
        }
    }
    false
}

impl Solid {
    /// The box or ball as a region of the world.
    fn region(&self) -> Region {
        let own = match self.form {
            Form::Ball => Region::Round { center: DVec3::ZERO, axes: DMat3::IDENTITY },
            _ => Extent { min: DVec3::NEG_ONE, max: DVec3::ONE }.hull(),
        };
        own.moved(&self.world_from_own())
    }

    /// Points of this surface where another solid is met first, if it is met at all: for balls the nearest and the farthest
    /// from its middle and from its faces, for boxes the nearest of each face.
    fn points_towards(&self, other: &Self) -> Vec<DVec3> {
        let to_world = self.world_from_own();
        let center = other.world_from_own().translation;
        let own = self.own_from_world().transform_point3(center);
        let points: Vec<DVec3> = match self.form {
            Form::Ball => {
                let faces = DVec3::AXES.map(|axis| other.own_from_world().matrix3.transpose() * axis);
                // The farthest point along a normal of the world, in the frame in which this is the unit ball.
                let faces = faces.map(|n| to_world.matrix3.transpose() * n);
                faces
                    .into_iter()
                    .chain([own])
                    .filter_map(DVec3::try_normalize)
                    .flat_map(|d| [d, -d])
                    .collect()
            }
            Form::Cube => DVec3::AXES
                .into_iter()
                .flat_map(|axis| [axis, -axis])
                .map(|face| {
                    let on_face = face.abs();
                    (own * (DVec3::ONE - on_face) + face).clamp(DVec3::NEG_ONE, DVec3::ONE)
                })
                .collect(),
            _ => Vec::new(),
        };
        points.into_iter().map(|p| to_world.transform_point3(p)).collect()
    }
}

/// Whether a face of `a` has all of `b` beyond it, or as good as that.
fn touches_at_most(a: &Solid, b: &Solid) -> bool {
    let own = b.region().moved(a.own_from_world());
    DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).any(|face| -own.support(-face) >= 1.0 - TOUCH)
}

/// Whether two boxes are parted by a plane along an edge of each (Gottschalk, Lin, Manocha 1996).
fn parted_by_edges(a: &Solid, b: &Solid) -> bool {
    let (region_a, region_b) = (a.region(), b.region());
    let (to_a, to_b) = (a.world_from_own().matrix3, b.world_from_own().matrix3);
    let edges = |m: DMat3| [m.x_axis, m.y_axis, m.z_axis];
    edges(to_a).into_iter().flat_map(|u| edges(to_b).map(|v| u.cross(v))).any(|n| {
        let depth =
            (region_a.support(n) + region_b.support(-n)).min(region_a.support(-n) + region_b.support(n));
        let width = region_a.support(n) + region_a.support(-n);
        n.try_normalize().is_some() && depth <= TOUCH * width
    })
}

/// Whether two glasses share a face, or all of their surface.
fn coincide(a: &Clear<'_>, b: &Clear<'_>) -> bool {
    let same_place = {
        let between = *a.solid.own_from_world() * b.solid.world_from_own();
        let off = (between.matrix3 - DMat3::IDENTITY).to_cols_array().into_iter();
        off.chain(between.translation.to_array()).all(|x| x.abs() <= ROUNDING)
    };
    match (&a.solid.form, &b.solid.form) {
        (Form::Ball, Form::Ball) => same_place,
        (Form::Cube, Form::Cube) => same_place || share_a_face(a.solid, b.solid),
        _ => same_place && a.thing.object.shape == b.thing.object.shape,
    }
}

/// Whether a face of one box lies in the plane of a face of the other, and they have some area in common.
fn share_a_face(a: &Solid, b: &Solid) -> bool {
    // Seen from `a`, which goes from −1 to 1, the faces of `b` are parallelograms.
    let from_b = *a.own_from_world() * b.world_from_own();
    let edges = [from_b.matrix3.x_axis, from_b.matrix3.y_axis, from_b.matrix3.z_axis];
    let mut faces = (0..6).map(|i| {
        let sign = if i < 3 { 1.0 } else { -1.0 };
        (from_b.translation + edges[i % 3] * sign, edges[(i + 1) % 3], edges[(i + 2) % 3])
    });
    faces.any(|(middle, u, v)| {
        (0..3).any(|axis| {
            let level = middle[axis];
            let is_level =
                u[axis].abs().max(v[axis].abs()) <= ROUNDING && (level.abs() - 1.0).abs() <= ROUNDING;
            let flat = |p: DVec3| DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3]);
            is_level && covers_some(flat(middle), flat(u), flat(v))
        })
    })
}

/// Whether the parallelogram `middle ± u ± v` and the square from −1 to 1 have area in common: no axis parts them.
fn covers_some(middle: DVec2, u: DVec2, v: DVec2) -> bool {
    [DVec2::X, DVec2::Y, u.perp(), v.perp()].into_iter().all(|n| {
        let reach = n.x.abs() + n.y.abs() + n.dot(u).abs() + n.dot(v).abs();
        n.dot(middle).abs() < reach * (1.0 - TOUCH)
    })
}
