//! What opaque things hide: lights that nothing sees, objects that no camera sees, cameras that see no light.
//!
//! An opaque solid, a room of quads and an endless plane all part space in two. Light does not get from one part to the
//! other; so whatever is wholly in the part in which no camera is might as well not be there.

use super::region::{Extent, Region};
use super::solid::Solid;
use super::surface::Surface;
use super::{Reach, SpaceError, Survey, Thing, all_of_them, plane_of};
use crate::ir::{Focus, Lens, ShapeKind};
use crate::math::DVec3;
use crate::source::Span;
use rustc_hash::FxHashSet;

/// How often a thing is compared with a wall, at most: the largest walls come first.
const MOST_QUESTIONS: usize = 1_000_000;
/// Quads that rooms are looked for among, at most.
const MOST_QUADS: usize = 20_000;
/// Corners nearer to each other than this share of the whole are one.
const WELDED: f64 = 1e-7;
/// Below this a sine is 0, and so is the share of a size.
const ROUNDING: f64 = 1e-9;

/// What parts space in two.
struct Wall {
    kind: WallKind,
    /// Where it was written.
    span: Span,
    /// The things that it is made of.
    owners: Vec<usize>,
    noun: &'static str,
}

enum WallKind {
    Solid(Solid),
    /// Points p with `normal · p = offset`; the side that the normal leaves is inside.
    Plane {
        normal: DVec3,
        offset: f64,
    },
}

impl Wall {
    /// Whether all that light comes from is inside, or all of it outside.
    fn holds(&self, reach: &Reach) -> Option<bool> {
        self.holds_within(reach, reach.extent().as_ref())
    }

    /// The same for whoever asks often, and knows the box around it.
    fn holds_within(&self, reach: &Reach, extent: Option<&Extent>) -> Option<bool> {
        match (&self.kind, reach) {
            (WallKind::Solid(solid), Reach::Here(region)) => match extent {
                Some(extent) => solid.holds_within(region, extent),
                None => solid.holds(region),
            },
            (WallKind::Solid(_), Reach::Far(_) | Reach::Around) => Some(false),
            (WallKind::Plane { normal, offset }, Reach::Here(region)) => {
                let (least, most) = (-region.support(-*normal), region.support(*normal));
                let rounding = ROUNDING * (offset.abs() + least.abs().max(most.abs()));
                match (most < offset - rounding, least > offset + rounding) {
                    (true, _) => Some(true),
                    (_, true) => Some(false),
                    _ => None,
                }
            }
            (WallKind::Plane { normal, .. }, Reach::Far(from)) => {
                let cos = normal.dot(*from);
                (cos.abs() > ROUNDING).then_some(cos < 0.0)
            }
            (WallKind::Plane { .. }, Reach::Around) => None,
        }
    }

    /// Where something on the side away from the camera is, and this wall as it is called there.
    fn place_of_hidden(&self, camera_inside: bool) -> (&'static str, &'static str) {
        match (&self.kind, camera_inside) {
            (WallKind::Plane { .. }, _) => ("behind", "an endless plane"),
            (WallKind::Solid(_), true) => ("outside of", self.noun),
            (WallKind::Solid(_), false) => ("inside of", self.noun),
        }
    }
}

/// That a wall hides something.
#[derive(Clone, Copy)]
struct Hidden<'a> {
    wall: &'a Wall,
    camera_inside: bool,
}

impl Survey<'_> {
    /// What opaque walls hide.
    pub(super) fn rooms(&self) -> Vec<SpaceError> {
        let walls = self.walls();
        // Walls that have all cameras on one side.
        let sides: Vec<Hidden> = walls
            .iter()
            .filter_map(|wall| Some(Hidden { wall, camera_inside: self.eyes_inside(wall)? }))
            .collect();
        let hidden_lamps: Vec<Option<Hidden>> =
            self.lamps.iter().map(|lamp| hider(&sides, &lamp.reach)).collect();
        let hidden_lamps = self.hide_sky(&sides, hidden_lamps);
        if let Some(dark) = self.dark(&sides, &hidden_lamps) {
            return vec![dark];
        }
        let lamps = self.lamps.iter().zip(hidden_lamps).map(|(lamp, hidden)| (lamp.span, hidden));
        let lamps = all_of_them(lamps).into_iter().map(|(light, hidden)| hidden.light(light));
        lamps.chain(by_wall(all_of_them(self.hidden_things(&sides).into_iter()))).collect()
    }

    /// Whether every camera is inside of a wall, or every one outside; `None` without any.
    fn eyes_inside(&self, wall: &Wall) -> Option<bool> {
        let mut sides = self.eyes.iter().map(|eye| wall.holds(&Reach::Here(eye.clone())));
        let first = sides.next()??;
        sides.all(|side| side == Some(first)).then_some(first)
    }

    /// The one report where all light is hidden from the cameras by one wall. Solids around all the light are lights sealed
    /// up, not a dark camera.
    fn dark(&self, sides: &[Hidden<'_>], lamps: &[Option<Hidden<'_>>]) -> Option<SpaceError> {
        let all_hidden = |side: &&Hidden| {
            let is_around = matches!(side.wall.kind, WallKind::Plane { .. }) || side.camera_inside;
            is_around
                && self.lamps.iter().zip(lamps).all(|(lamp, hidden)| {
                    side.wall.holds(&lamp.reach) == Some(!side.camera_inside)
                        || hidden.is_some() && lamp.reach == Reach::Around
                })
        };
        let wall = sides.iter().find(all_hidden).filter(|_| !self.lamps.is_empty())?.wall;
        let camera = self.scene.cameras.first()?.position.span;
        let (said, help) = match wall.kind {
            WallKind::Plane { .. } => (
                "all the light is on the other side of an endless plane".to_owned(),
                "move the camera or the light to the other side of the plane",
            ),
            WallKind::Solid(_) => (
                format!("the camera is sealed in {}, with no light in it", wall.noun),
                "move the camera out of it, or put a light into it",
            ),
        };
        Some(SpaceError::CameraSealed { said, camera, object: wall.span, help })
    }

    /// The environment is hidden where planes shut the cameras in on all sides.
    fn hide_sky<'w>(
        &self,
        sides: &[Hidden<'w>],
        mut lamps: Vec<Option<Hidden<'w>>>,
    ) -> Vec<Option<Hidden<'w>>> {
        let outwards = |side: &Hidden| match side.wall.kind {
            WallKind::Plane { normal, .. } => Some(if side.camera_inside { normal } else { -normal }),
            WallKind::Solid(_) => None,
        };
        let normals: Vec<DVec3> = sides.iter().filter_map(outwards).collect();
        let plane = sides.iter().find(|side| outwards(side).is_some());
        if let Some(plane) = plane.filter(|_| shut_in(&normals)) {
            for (lamp, hidden) in self.lamps.iter().zip(&mut lamps) {
                if lamp.reach == Reach::Around {
                    hidden.get_or_insert(*plane);
                }
            }
        }
        lamps
    }

    /// Each object that does not shine, with what hides it.
    fn hidden_things<'w>(&self, sides: &[Hidden<'w>]) -> Vec<(Span, Option<Hidden<'w>>)> {
        let targets = self.focus_targets();
        let hidden = |(index, thing): (usize, &Thing)| {
            let is_shown = thing.stuff.shines || thing.object.names.iter().any(|name| targets.contains(name));
            let region = thing.region.clone().filter(|_| !is_shown);
            let others = sides.iter().filter(|side| !side.wall.owners.contains(&index));
            (thing.object.span, region.and_then(|region| hider(others, &Reach::Here(region))))
        };
        self.things.iter().enumerate().map(hidden).collect()
    }

    /// The names that lenses are focused on: such an object may be there for nothing else.
    fn focus_targets(&self) -> FxHashSet<u32> {
        let focus = self.scene.cameras.iter().filter_map(|camera| match &camera.lens {
            Lens::Thin { focus: Some(focus), .. } | Lens::Prescription { focus: Some(focus), .. } => {
                Some(&focus.value)
            }
            _ => None,
        });
        focus.filter_map(|focus| if let Focus::On(id, _) = focus { Some(*id) } else { None }).collect()
    }

    /// Every wall, the largest first, as many as can be looked at.
    fn walls(&self) -> Vec<Wall> {
        let mut solids: Vec<Wall> = self.things.iter().enumerate().filter_map(solid_wall).collect();
        solids.extend(self.rooms_of_quads());
        let volume = |wall: &Wall| match &wall.kind {
            WallKind::Solid(solid) => solid.extent.volume(),
            WallKind::Plane { .. } => f64::INFINITY,
        };
        solids.sort_by(|a, b| volume(b).total_cmp(&volume(a)));
        let planes = self.things.iter().enumerate().filter_map(plane_wall);
        let mut walls: Vec<Wall> = planes.chain(solids).collect();
        walls.truncate(MOST_QUESTIONS / (self.things.len() + self.lamps.len()).max(1));
        walls
    }

    /// Closed surfaces that opaque quads and triangles make up together.
    fn rooms_of_quads(&self) -> Vec<Wall> {
        let mut corners: Vec<[DVec3; 3]> = Vec::new();
        let mut owners: Vec<usize> = Vec::new();
        let opaque = self.things.iter().enumerate().filter(|(_, thing)| thing.stuff.is_opaque);
        for (index, thing) in opaque {
            let is_flat = matches!(thing.kind, ShapeKind::Quad { .. } | ShapeKind::Triangle { .. });
            if let (true, Some(Region::Hull(points))) = (is_flat, &thing.region) {
                let fan = points.windows(2).skip(1).map(|pair| [points[0], pair[0], pair[1]]);
                corners.extend(fan);
                owners.resize(corners.len(), index);
            }
        }
        if owners.is_empty() || corners.len() > 2 * MOST_QUADS {
            return Vec::new();
        }
        let size =
            Extent::of(corners.iter().flatten().copied()).map_or(0.0, |e| (e.max - e.min).max_element());
        let grid = |p: DVec3| (p / (WELDED * size)).round().to_array().map(|x| (x + 0.0).to_bits());
        let parts = Surface::weld(corners, grid).closed_parts();
        parts
            .into_iter()
            .filter_map(|(surface, triangles)| {
                let mut owners: Vec<usize> = triangles.iter().map(|&triangle| owners[triangle]).collect();
                owners.dedup();
                let span = self.things[*owners.first()?].object.span;
                let kind = WallKind::Solid(Solid::closed(surface)?);
                Some(Wall { kind, span, owners, noun: "a closed room" })
            })
            .collect()
    }
}

impl Hidden<'_> {
    fn light(&self, light: Span) -> SpaceError {
        let (place, noun) = self.wall.place_of_hidden(self.camera_inside);
        let wall = self.wall.span;
        match place {
            "inside of" => SpaceError::LightSealed { noun, light, object: wall },
            _ => SpaceError::LightHidden { place, noun, light, wall },
        }
    }

    fn objects(&self, objects: &[Span]) -> SpaceError {
        let (place, noun) = self.wall.place_of_hidden(self.camera_inside);
        let others = match objects.len() - 1 {
            0 => String::new(),
            1 => ", nor of one more".to_owned(),
            more => format!(", nor of {more} more"),
        };
        SpaceError::ObjectHidden { others, place, noun, object: objects[0], wall: self.wall.span }
    }
}

/// The first wall between a place and the cameras.
fn hider<'s, 'w: 's>(sides: impl IntoIterator<Item = &'s Hidden<'w>>, reach: &Reach) -> Option<Hidden<'w>> {
    let extent = reach.extent();
    let bars = |side: &&Hidden| side.wall.holds_within(reach, extent.as_ref()) == Some(!side.camera_inside);
    sides.into_iter().find(bars).copied()
}

/// One report for all that one wall hides: it is the wall that may be in the wrong place.
fn by_wall(hidden: Vec<(Span, Hidden<'_>)>) -> Vec<SpaceError> {
    let mut walls: Vec<(Hidden, Vec<Span>)> = Vec::new();
    for (object, by) in hidden {
        match walls.iter_mut().find(|(known, _)| std::ptr::eq(known.wall, by.wall)) {
            Some((_, objects)) => objects.push(object),
            None => walls.push((by, vec![object])),
        }
    }
    walls.iter().map(|(by, objects)| by.objects(objects)).collect()
}

fn solid_wall((index, thing): (usize, &Thing<'_>)) -> Option<Wall> {
    let solid = thing.solid.clone().filter(|_| thing.stuff.is_opaque)?;
    let noun = match solid.form.noun() {
        "ball" => "an opaque ball",
        "box" => "an opaque box",
        "closed surface" => "an opaque mesh",
        _ => "an opaque solid",
    };
    Some(Wall { kind: WallKind::Solid(solid), span: thing.object.span, owners: vec![index], noun })
}

fn plane_wall((index, thing): (usize, &Thing<'_>)) -> Option<Wall> {
    if !thing.stuff.is_opaque {
        return None;
    }
    let (normal, offset) = plane_of(thing)?;
    let kind = WallKind::Plane { normal, offset };
    Some(Wall { kind, span: thing.object.span, owners: vec![index], noun: "an endless plane" })
}

/// Whether planes with these outward normals leave no way out but along them: no direction leaves all of them behind.
///
/// There is such a direction unless 0 lies in the convex hull of the normals (Gordan 1873). The best one is opposite to
/// the hull's point nearest to 0, which lies on a corner, an edge or a triangle.
fn shut_in(normals: &[DVec3]) -> bool {
    /// More planes than this are not looked at.
    const MOST: usize = 24;
    let normals = &normals[..normals.len().min(MOST)];
    let escapes = |d: DVec3| normals.iter().all(|n| n.dot(d) < -ROUNDING * d.length());
    let mut ways: Vec<DVec3> = normals.iter().map(|&n| -n).collect();
    for (i, &a) in normals.iter().enumerate() {
        for (j, &b) in normals.iter().enumerate().skip(i + 1) {
            ways.push(-(a + b));
            // The direction that makes the same angle with all three.
            ways.extend(normals.iter().skip(j + 1).flat_map(|&c| {
                let middle = (b - a).cross(c - a);
                [middle, -middle]
            }));
        }
    }
    !normals.is_empty() && !ways.into_iter().any(escapes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_walls_shut_in_and_five_do_not() {
        let walls = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z];
        assert!(shut_in(&walls));
        assert!(shut_in(&walls[..2]), "between two parallel planes there is only the plane between them");
        assert!(!shut_in(&[DVec3::X, DVec3::Y, -DVec3::X.rotate_towards(DVec3::Z, 0.1)]));
        assert!(!shut_in(&[DVec3::X, DVec3::Y, DVec3::Z]));
        assert!(!shut_in(&[]));
        let tent = [DVec3::new(1.0, 1.0, 1.0), DVec3::new(-1.0, 1.0, -1.0), DVec3::new(1.0, -1.0, -1.0)];
        assert!(!shut_in(&tent));
        let closed = [tent[0], tent[1], tent[2], DVec3::new(-1.0, -1.0, 1.0)];
        assert!(shut_in(&closed.map(DVec3::normalize)));
    }
}
