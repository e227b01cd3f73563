//! A whole pipeline, from camera ray to direct light and a mirrored ray, in single and in double precision: the same code for
//! both, and the same rays. Beside them the renderer's own, with eight boxes and four triangles at a time.

use crate::scenes::{NAMES, Scene};
use crate::thread_seconds;
use snell::math::{Bounds, DVec3, Ray, Vec2, Vec3};
use snell::render::accel::build::Cell;
use snell::render::accel::{Items, partition};
use snell::render::light::Viewpoint;
use snell::render::shape::SolidKind;
use std::ops::{Add, Div, Mul, Neg, Range, Sub};

/// A kind of number.
trait Real:
    Copy
    + PartialOrd
    + From<f32>
    + Into<f64>
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// Half the distance from 1 to the next number.
    const ROUND_OFF: Self;
    fn of(x: f64) -> Self;
    fn root(self) -> Self;
    /// The next number towards `by`.
    fn beyond(self, by: Self) -> Self;
}

macro_rules! real {
    ($number:ident) => {
        impl Real for $number {
            const ROUND_OFF: Self = $number::EPSILON / 2.0;
            fn of(x: f64) -> Self {
                x as Self
            }
            fn root(self) -> Self {
                self.sqrt()
            }
            fn beyond(self, by: Self) -> Self {
                if by > 0.0 {
                    self.next_up()
                } else if by < 0.0 {
                    self.next_down()
                } else {
                    self
                }
            }
        }
    };
}
real!(f32);
real!(f64);

type Vector<F> = [F; 3];

fn vector<F: Real>(v: Vec3) -> Vector<F> {
    v.to_array().map(F::from)
}

fn map<F: Real>(a: Vector<F>, b: Vector<F>, f: impl Fn(F, F) -> F) -> Vector<F> {
    [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])]
}

fn sub<F: Real>(a: Vector<F>, b: Vector<F>) -> Vector<F> {
    map(a, b, |a, b| a - b)
}

/// `a + b · t`.
fn along<F: Real>(a: Vector<F>, b: Vector<F>, t: F) -> Vector<F> {
    map(a, b, |a, b| a + b * t)
}

fn dot<F: Real>(a: Vector<F>, b: Vector<F>) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<F: Real>(a: Vector<F>, b: Vector<F>) -> Vector<F> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit<F: Real>(a: Vector<F>) -> Vector<F> {
    let length = dot(a, a).root();
    a.map(|x| x / length)
}

fn abs<F: Real>(x: F) -> F {
    if x < F::from(0.0) { -x } else { x }
}

fn largest<F: Real>(v: Vector<F>) -> F {
    v.into_iter().fold(F::from(0.0), |most, x| if abs(x) > most { abs(x) } else { most })
}

/// The bound on the relative error of `n` operations (Higham 2002).
fn gamma<F: Real>(n: f32) -> F {
    let nu = F::from(n) * F::ROUND_OFF;
    nu / (F::from(1.0) - nu)
}

/// A ray with an open interval (0, `t_max`).
#[derive(Clone, Copy)]
struct Line<F> {
    o: Vector<F>,
    d: Vector<F>,
    t_max: F,
}

/// A point on a surface, as well as it is known.
struct Point<F> {
    p: Vector<F>,
    error: Vector<F>,
    n: Vector<F>,
}

impl<F: Real> Point<F> {
    /// Where a ray in direction `d` leaves, beyond the rounding of the surface (Pharr, Jakob, Humphreys 2023, section 6.8).
    fn leave(&self, d: Vector<F>) -> Vector<F> {
        let side = if dot(self.n, d) < F::from(0.0) { self.n.map(Neg::neg) } else { self.n };
        let shift = dot(side.map(abs), self.error);
        let by = side.map(|x| x * shift);
        map(map(self.p, by, |p, by| p + by), by, F::beyond)
    }
}

enum Kind {
    /// The other child; the first follows at once.
    Inner(usize),
    Leaf(Range<usize>),
}

struct Node<F> {
    low: Vector<F>,
    high: Vector<F>,
    kind: Kind,
}

/// Triangles and balls, and a tree over them.
struct Tracer<F> {
    triangles: Vec<[Vector<F>; 3]>,
    balls: Vec<(Vector<F>, F)>,
    nodes: Vec<Node<F>>,
    items: Vec<u32>,
}

/// The shapes of a scene as they are after lowering: coordinates in single precision.
struct Shapes {
    triangles: Vec<[Vec3; 3]>,
    balls: Vec<(DVec3, f64)>,
    root: Cell,
}

impl Shapes {
    fn of(scene: &Scene) -> Self {
        let geometry = &scene.lowered.world.geometry;
        let meshes = geometry.mesh_prims();
        let triangles: Vec<_> = meshes
            .flat_map(|(mesh, _)| mesh.triangles.iter().map(|corners| mesh.corners(*corners)))
            .collect();
        let ball = |solid: &snell::render::shape::Solid| {
            assert!(matches!(solid.kind, SolidKind::Sphere), "these scenes have no other solids");
            (solid.world_from_object.translation, solid.world_from_object.matrix3.x_axis.length())
        };
        let balls: Vec<_> = geometry.solid_prims().map(|(solid, _)| ball(solid)).collect();
        let boxes: Vec<_> =
            balls.iter().map(|(c, r)| Bounds::enclosing(*c - *r * 1.001, *c + *r * 1.001)).collect();
        let root = partition(&Items { triangles: &triangles, boxes: &boxes }).root;
        Self { triangles, balls, root }
    }
}

impl<F: Real> Tracer<F> {
    fn new(shapes: &Shapes) -> Self {
        let balls = shapes.balls.iter().map(|(c, r)| (c.to_array().map(F::of), F::of(*r))).collect();
        let triangles = shapes.triangles.iter().map(|corners| corners.map(vector)).collect();
        let mut tracer = Self { triangles, balls, nodes: Vec::new(), items: Vec::new() };
        tracer.flatten(&shapes.root);
        tracer
    }

    fn flatten(&mut self, cell: &Cell) {
        let (bounds, index) = (cell.bounds(), self.nodes.len());
        self.nodes.push(Node { low: vector(bounds.min), high: vector(bounds.max), kind: Kind::Leaf(0..0) });
        self.nodes[index].kind = match cell {
            Cell::Inner { children, .. } => {
                self.flatten(&children[0]);
                let second = self.nodes.len();
                self.flatten(&children[1]);
                Kind::Inner(second)
            }
            Cell::Leaf { items, .. } => {
                let first = self.items.len();
                self.items.extend(items);
                Kind::Leaf(first..self.items.len())
            }
        };
    }

    /// The nearest hit, or any: what, and where.
    fn meet<const ANY: bool>(&self, line: &Line<F>) -> Option<(u32, F, [F; 2])> {
        let zero = F::from(0.0);
        let inverse = line.d.map(|d| F::from(1.0) / d);
        let slack = F::from(1.0) + gamma::<F>(3.0) * F::from(2.0);
        let (mut t_max, mut best, mut stack) = (line.t_max, None::<(u32, F, [F; 2])>, vec![0]);
        while let Some(index) = stack.pop() {
            let Node { low, high, kind } = &self.nodes[index];
            let (mut enter, mut exit) = (zero, t_max);
            for axis in 0..3 {
                let (a, b) =
                    ((low[axis] - line.o[axis]) * inverse[axis], (high[axis] - line.o[axis]) * inverse[axis]);
                let (near, far) = if inverse[axis] < zero { (b, a) } else { (a, b) };
                enter = if near > enter { near } else { enter };
                exit = if far < exit { far } else { exit };
            }
            if enter > exit * slack {
                continue;
            }
            match kind {
                // The child on the ray's own side comes first.
                Kind::Inner(second) => {
                    let (a, b) = (&self.nodes[index + 1], &self.nodes[*second]);
                    let towards = dot(
                        sub(along(b.low, b.high, F::from(1.0)), along(a.low, a.high, F::from(1.0))),
                        line.d,
                    );
                    stack.extend(if towards > zero { [*second, index + 1] } else { [index + 1, *second] });
                }
                Kind::Leaf(range) => {
                    for &item in &self.items[range.clone()] {
                        let Some((t, b)) = self.hit(item, line) else { continue };
                        // Of equals the lowest comes first.
                        let is_first = best.is_some_and(|(best, ..)| t == t_max && item < best);
                        if !(F::from(0.0) < t && (t < t_max || is_first)) {
                            continue;
                        }
                        (t_max, best) = (t, Some((item, t, b)));
                        if ANY {
                            return best;
                        }
                    }
                }
            }
        }
        best
    }

    fn hit(&self, item: u32, line: &Line<F>) -> Option<(F, [F; 2])> {
        match (item as usize).checked_sub(self.triangles.len()) {
            None => hit_triangle(&self.triangles[item as usize], line),
            Some(ball) => {
                let (center, radius) = self.balls[ball];
                let roots = hit_ball(sub(line.o, center), line.d, radius)?;
                roots.into_iter().find(|t| F::from(0.0) < *t).map(|t| (t, [F::from(0.0); 2]))
            }
        }
    }

    fn point(&self, line: &Line<F>, (item, t, [b1, b2]): (u32, F, [F; 2])) -> Point<F> {
        match (item as usize).checked_sub(self.triangles.len()) {
            None => {
                let [a, b, c] = self.triangles[item as usize];
                let b0 = F::from(1.0) - b1 - b2;
                let terms = [a.map(|x| x * b0), b.map(|x| x * b1), c.map(|x| x * b2)];
                let size = [largest(sub(b, a)), largest(sub(c, b)), largest(sub(a, c))];
                let sum = |terms: [Vector<F>; 3]| {
                    along(along(terms[0], terms[1], F::from(1.0)), terms[2], F::from(1.0))
                };
                let error = sum(terms.map(|term| term.map(abs))).map(|x| (x + largest(size)) * gamma(7.0));
                Point { p: sum(terms), error, n: unit(cross(sub(b, a), sub(c, a))) }
            }
            Some(ball) => {
                let (center, radius) = self.balls[ball];
                let n = unit(sub(along(line.o, line.d, t), center));
                let error = center.map(|x| (abs(x) + radius) * gamma(5.0));
                Point { p: along(center, n, radius), error, n }
            }
        }
    }

    fn see(&self, ray: &Ray, lamp: Vec3) -> Option<Seen> {
        let line = Line { o: vector(ray.o), d: vector(ray.d), t_max: F::from(f32::INFINITY) };
        let hit = self.meet::<false>(&line)?;
        let point = self.point(&line, hit);
        let to_lamp = sub(vector(lamp), point.p);
        let o = point.leave(to_lamp);
        // All but the last thousandth: what the lamp is made of is not to shade it.
        let shadow = Line { o, d: sub(vector(lamp), o), t_max: F::from(0.999) };
        let is_lit = self.meet::<true>(&shadow).is_none();
        let d = along(line.d, point.n, -(dot(line.d, point.n) + dot(line.d, point.n)));
        let mirrored = Line { o: point.leave(d), d, t_max: F::from(f32::INFINITY) };
        let cosine = abs(dot(point.n, unit(to_lamp)));
        Some(Seen {
            what: hit.0,
            depth: hit.1.into(),
            light: if is_lit { (cosine / dot(to_lamp, to_lamp)).into() } else { 0.0 },
            mirrored: self.meet::<false>(&mirrored).map(|(item, ..)| item),
        })
    }
}

/// Woop, Benthin, Wald 2013; edge functions that round to 0 are decided in double precision.
fn hit_triangle<F: Real>(corners: &[Vector<F>; 3], line: &Line<F>) -> Option<(F, [F; 2])> {
    let size = line.d.map(abs);
    let z = if size[0] > size[1] && size[0] > size[2] {
        0
    } else if size[1] > size[2] {
        1
    } else {
        2
    };
    let (x, y) = ((z + 1) % 3, (z + 2) % 3);
    let shear = [line.d[x] / line.d[z], line.d[y] / line.d[z], F::from(1.0) / line.d[z]];
    let [a, b, c] = corners.map(|p| {
        let depth = p[z] - line.o[z];
        [(p[x] - line.o[x]) - shear[0] * depth, (p[y] - line.o[y]) - shear[1] * depth, depth]
    });
    let edge = |p: Vector<F>, q: Vector<F>| p[0] * q[1] - p[1] * q[0];
    let exact = |p: Vector<F>, q: Vector<F>| {
        let [p, q] = [p, q].map(|v| v.map(Into::<f64>::into));
        F::of(p[0] * q[1] - p[1] * q[0])
    };
    let zero = F::from(0.0);
    let (mut u, mut v, mut w) = (edge(c, b), edge(a, c), edge(b, a));
    if u == zero || v == zero || w == zero {
        (u, v, w) = (exact(c, b), exact(a, c), exact(b, a));
    }
    let determinant = u + v + w;
    let agree = (u >= zero && v >= zero && w >= zero) || (u <= zero && v <= zero && w <= zero);
    if !agree || determinant == zero {
        return None;
    }
    let t = (u * a[2] + v * b[2] + w * c[2]) * shear[2] / determinant;
    Some((t, [v / determinant, w / determinant]))
}

/// Haines, Günther, Akenine-Möller 2019.
fn hit_ball<F: Real>(o: Vector<F>, d: Vector<F>, radius: F) -> Option<[F; 2]> {
    let (a, b) = (dot(d, d), -dot(o, d));
    let nearest = along(o, d, b / a);
    let distance = dot(nearest, nearest).root();
    let discriminant = (radius - distance) * (radius + distance);
    if discriminant < F::from(0.0) {
        return None;
    }
    let root = (a * discriminant).root();
    let q = if b < F::from(0.0) { b - root } else { b + root };
    let length = dot(o, o).root();
    let (t0, t1) = ((length - radius) * (length + radius) / q, q / a);
    Some(if t0 <= t1 { [t0, t1] } else { [t1, t0] })
}

/// What a pixel shows.
#[derive(Clone, Copy)]
struct Seen {
    what: u32,
    depth: f64,
    /// From the lamp, if nothing is between.
    light: f64,
    /// What a mirror there would show.
    mirrored: Option<u32>,
}

/// The same by the renderer's own geometry.
fn see(scene: &Scene, ray: &Ray, lamp: Vec3) -> Option<Seen> {
    let geometry = &scene.lowered.world.geometry;
    let hit = geometry.closest_hit(ray)?;
    let point = geometry.surface_point(ray, &hit);
    let to_lamp = lamp - point.p;
    let shadow = Ray { t_max: 0.999, ..point.spawn_to(lamp, Vec3::ZERO, Vec3::ZERO) };
    let light = point.n.dot(to_lamp.normalize()).abs() / to_lamp.length_squared();
    let d = ray.d - 2.0 * ray.d.dot(point.n) * point.n;
    Some(Seen {
        what: hit.prim.0,
        depth: f64::from(hit.t),
        light: if geometry.any_hit(&shadow) { 0.0 } else { f64::from(light) },
        mirrored: geometry.closest_hit(&point.spawn(d)).map(|hit| hit.prim.0),
    })
}

/// Where the middle of the scene's lamp is.
fn lamp(scene: &Scene) -> Vec3 {
    let world = &scene.lowered.world;
    let eye = Viewpoint { p: world.camera.position(), n: None };
    let draws = (0..64).map(|i| Vec2::new((i as f32 + 0.5) / 64.0, 0.5));
    let lights = |u| world.lights.sample_li(&world.geometry, &eye, u, Vec2::splat(0.5));
    let near = draws.filter_map(lights).find(|light| light.distance().is_finite());
    let light = near.expect("each of these scenes has a lamp");
    eye.p + light.wi * light.distance()
}

/// Pictures of one pipeline, and the time of a pixel in the best of so many.
fn picture(rays: &[Ray], see: impl Fn(&Ray) -> Option<Seen>) -> (Vec<Option<Seen>>, f64) {
    const ROUNDS: usize = 3;
    let mut seen = Vec::new();
    let mut least = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = thread_seconds();
        seen = rays.iter().map(&see).collect();
        least = least.min((thread_seconds() - start) * 1e9 / rays.len() as f64);
    }
    (seen, least)
}

/// Prints the table.
pub fn print() {
    println!(
        "| scene | pipeline | ns a pixel | other surface | other shadow | other mirror image | depth off: median | most |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|");
    for name in NAMES {
        let scene = Scene::new(name, 1);
        let (shapes, lamp, rays) = (Shapes::of(&scene), lamp(&scene), scene.camera_rays());
        let double = Tracer::<f64>::new(&shapes);
        let (exact, by_double) = picture(&rays, |ray| double.see(ray, lamp));
        drop(double);
        let single = Tracer::<f32>::new(&shapes);
        let (found, by_single) = picture(&rays, |ray| single.see(ray, lamp));
        let (own, by_own) = picture(&rays, |ray| see(&scene, ray, lamp));
        println!("| {name} | double precision | {by_double:.0} | | | | | |");
        println!("| | single precision, the same code | {by_single:.0} | {} |", differences(&found, &exact));
        println!("| | single precision, as shipped | {by_own:.0} | {} |", differences(&own, &exact));
    }
}

/// Cells that say in how many pixels a picture is another one.
fn differences(found: &[Option<Seen>], exact: &[Option<Seen>]) -> String {
    let pairs = || found.iter().zip(exact);
    let what = |seen: &Option<Seen>| seen.map(|seen| seen.what);
    let other = pairs().filter(|(a, b)| what(a) != what(b)).count();
    let same: Vec<(Seen, Seen)> =
        pairs().filter(|(a, b)| what(a) == what(b)).filter_map(|(a, b)| a.zip(*b)).collect();
    let shadow = same.iter().filter(|(a, b)| (a.light > 0.0) != (b.light > 0.0)).count();
    let mirror = same.iter().filter(|(a, b)| a.mirrored != b.mirrored).count();
    let both = pairs().filter_map(|(a, b)| a.zip(*b));
    let mut off: Vec<f64> = both.map(|(a, b)| (a.depth / b.depth - 1.0).abs()).collect();
    off.sort_by(f64::total_cmp);
    let (median, most) = (off[off.len() / 2], off[off.len() - 1]);
    format!("{other} of {} | {shadow} | {mirror} | {median:.0e} | {most:.0e}", found.len())
}
