//! A naive reading of the family's scenes: words in blocks, shapes one by one, rays that try them all.

use snell::math::{DAffine3, DMat3, DVec3};
use std::path::Path;

/// A block of words and blocks.
#[derive(Clone, Debug, Default)]
struct Node {
    name: String,
    items: Vec<Item>,
}

#[derive(Clone, Debug)]
enum Item {
    Word(String),
    Block(Node),
}

/// What a ray can hit, in the frame of `from_world`.
struct Placed {
    shape: Shape,
    from_world: DAffine3,
}

enum Shape {
    Ball(DVec3, f64),
    /// `normal . p = offset`.
    Plane(DVec3, f64),
    /// Corner and edges; whether only the triangle between them is meant.
    Parallelogram(DVec3, DVec3, DVec3, bool),
    Disk(DVec3, DVec3, f64),
    Box(DVec3, DVec3),
    /// Triangles, the box around them, and whether some of them are parts of larger polygons.
    Triangles(Vec<[DVec3; 3]>, DVec3, DVec3, bool),
    /// Straight pieces of a profile (radius, height) turned about y.
    Turned(Vec<(f64, f64)>),
}

/// A scene as a list of shapes and a camera.
pub struct Scene {
    pub size: [u32; 2],
    /// Whether any mesh has faces of more than three corners.
    pub has_polygons: bool,
    shapes: Vec<Placed>,
    center: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// The tangent of half the vertical angle, or half the side of what an orthographic camera sees.
    extent: f64,
    is_orthographic: bool,
}

/// Reads the scenes of a file; `None` for one that this reader cannot read.
pub fn read(text: &str, path: &Path) -> Vec<Option<Scene>> {
    let mut words = Vec::new();
    for line in text.lines() {
        let line = line.split("//").next().unwrap_or_default();
        let spaced = line.replace('{', " { ").replace('}', " } ").replace('[', " [ ").replace(']', " ] ");
        words.extend(spaced.split_whitespace().map(String::from).collect::<Vec<_>>());
    }
    let mut stack = vec![Node::default()];
    for word in words {
        let depth = stack.len();
        let top = stack.last_mut().expect("the file itself");
        match word.as_str() {
            "{" => {
                let name = match top.items.pop() {
                    Some(Item::Word(name)) => name,
                    _ => String::new(),
                };
                stack.push(Node { name, items: Vec::new() });
            }
            "}" if depth > 1 => {
                let done = stack.pop().expect("more than one");
                stack.last_mut().expect("the file itself").items.push(Item::Block(done));
            }
            "}" => return vec![None],
            _ => top.items.push(Item::Word(word)),
        }
    }
    if stack.len() != 1 {
        return vec![None];
    }
    split(stack.remove(0)).iter().map(|node| scene(node, path)).collect()
}

/// A camera after a group begins a new scene.
fn split(file: Node) -> Vec<Node> {
    let mut scenes = vec![Node::default()];
    for item in file.items {
        let is_camera = matches!(&item, Item::Block(block) if block.name.contains("Camera"));
        let last = scenes.last().expect("one at least");
        if is_camera && last.blocks().any(|block| block.name == "Group") {
            scenes.push(Node::default());
        }
        scenes.last_mut().expect("one at least").items.push(item);
    }
    scenes
}

impl Item {
    fn word(&self) -> Option<&str> {
        match self {
            Self::Word(word) => Some(word),
            Self::Block(_) => None,
        }
    }
}

impl Node {
    fn blocks(&self) -> impl Iterator<Item = &Self> {
        self.items.iter().filter_map(|item| match item {
            Item::Block(block) => Some(block),
            Item::Word(_) => None,
        })
    }

    fn words(&self) -> Vec<&str> {
        self.items.iter().filter_map(Item::word).collect()
    }

    fn has(&self, key: &str) -> bool {
        self.words().contains(&key)
    }

    /// All words of the block and of those in it.
    fn all_words(&self) -> Vec<&str> {
        let mut words = self.words();
        for block in self.blocks() {
            words.extend(block.all_words());
        }
        words
    }

    fn after(&self, key: &str) -> Vec<&str> {
        let words = self.words();
        let at = words.iter().rposition(|word| *word == key);
        at.map_or(Vec::new(), |at| words[at + 1..].to_vec())
    }

    fn numbers(&self, key: &str, count: usize) -> Option<Vec<f64>> {
        let numbers: Option<Vec<f64>> =
            self.after(key).into_iter().take(count).map(|word| word.parse().ok()).collect();
        numbers.filter(|numbers| numbers.len() == count)
    }

    fn number(&self, key: &str) -> Option<f64> {
        Some(self.numbers(key, 1)?[0])
    }

    fn vector(&self, key: &str) -> Option<DVec3> {
        let v = self.numbers(key, 3)?;
        Some(DVec3::new(v[0], v[1], v[2]))
    }
}

fn scene(file: &Node, path: &Path) -> Option<Scene> {
    let camera = file.blocks().filter(|block| block.name.contains("Camera")).last()?;
    let is_orthographic = camera.name == "OrthographicCamera";
    let forward = camera.vector("direction")?.normalize();
    let across = forward.cross(camera.vector("up")?);
    let words = file.all_words();
    let has = |key: &str| words.contains(&key);
    // Only the framework of 2020, which arsenal.txt is written for, does not normalise.
    let is_arsenal = has("reflection") || (has("emissionColor") && !has("diffuseColor")) || has("Y_inverse");
    let scale = if is_arsenal { across.length() } else { 1.0 };
    let angle = camera.number("angle").or(camera.number("h-angle")).unwrap_or(0.0).to_radians();
    let size = match (camera.number("width"), camera.number("height")) {
        (Some(width), Some(height)) => [width as u32, height as u32],
        _ => [500, 500],
    };
    let side = camera.number("size").unwrap_or(0.0);
    let extent = if is_orthographic { 0.5 * side } else { (0.5 * angle).tan() * scale };
    let center = camera.vector("center")?;
    let right = across.normalize();
    let mut shapes = Vec::new();
    let groups = file.blocks().filter(|block| block.name == "Group");
    if let Some(group) = groups.last() {
        walk(group, DAffine3::IDENTITY, path, &mut shapes);
    }
    for lights in file.blocks().filter(|block| block.name == "Lights") {
        walk_lights(lights, path, &mut shapes);
    }
    // Planes have one side in the dialect of weights.
    if has("type")
        && words.windows(4).any(|w| w[0] == "type" && w[1..].iter().all(|w| w.parse::<f64>().is_ok()))
    {
        let is_behind = |placed: &Placed| match placed.shape {
            Shape::Plane(normal, offset) => {
                placed.from_world == DAffine3::IDENTITY && normal.dot(center) < offset
            }
            _ => false,
        };
        shapes.retain(|placed| !is_behind(placed));
    }
    Some(Scene {
        size,
        has_polygons: shapes.iter().any(|placed| matches!(placed.shape, Shape::Triangles(.., true))),
        shapes,
        center,
        forward,
        right,
        up: right.cross(forward),
        extent,
        is_orthographic,
    })
}

fn walk(group: &Node, from_world: DAffine3, path: &Path, shapes: &mut Vec<Placed>) {
    for block in group.blocks() {
        match block.name.as_str() {
            "Group" => walk(block, from_world, path, shapes),
            "Transform" => walk(block, transform(block).inverse() * from_world, path, shapes),
            _ => shapes.extend(shape(block, path).map(|shape| Placed { shape, from_world })),
        }
    }
}

/// What lights show of themselves.
fn walk_lights(lights: &Node, path: &Path, shapes: &mut Vec<Placed>) {
    for light in lights.blocks() {
        let around = |a: &str, b: &str| {
            let (p, u, v) = (light.vector("position")?, light.vector(a)?, light.vector(b)?);
            Some(Shape::Parallelogram(p - u - v, 2.0 * u, 2.0 * v, false))
        };
        let corners = |names: [&str; 3], is_triangle: bool| {
            let [a, b, c] = names.map(|name| light.vector(name));
            Some(Shape::Parallelogram(a?, b? - a?, c? - a?, is_triangle))
        };
        let along = || {
            let (u, v) = (light.vector("U")?.normalize(), light.vector("V")?.normalize());
            let (u, v) = (u * light.number("LU")?, v * light.number("LV")?);
            Some(Shape::Parallelogram(light.vector("origin")? - u - v, 2.0 * u, 2.0 * v, false))
        };
        let by_corners = || match light.name.as_str() {
            "QuadLight" => corners(["A", "B", "C"], false),
            "LightTriangle" => corners(["vertex0", "vertex1", "vertex2"], true),
            _ => along(),
        };
        let flat = around("x_axis", "y_axis").or_else(|| around("dirX", "dirY")).or_else(by_corners);
        let shape = flat.or_else(|| match (light.vector("position"), light.number("radius")) {
            (Some(p), Some(radius)) if light.name == "SphereLight" => Some(Shape::Ball(p, radius)),
            (Some(p), Some(radius)) if light.name != "PointLight" && light.name != "SpotLight" => {
                let normal = light.vector("normal").or(light.vector("direction"))?;
                Some(Shape::Disk(p, normal.normalize(), radius))
            }
            _ if light.name == "RecLight" => {
                let way = light.vector("direction")?.normalize();
                let u = light.vector("up")?.normalize();
                let (u, v) = (u * light.number("dx")?, way.cross(u) * light.number("dy")?);
                Some(Shape::Parallelogram(light.vector("position")? - 0.5 * (u + v), u, v, false))
            }
            _ => light.blocks().find_map(|block| shape(block, path)),
        });
        shapes.extend(shape.map(|shape| Placed { shape, from_world: DAffine3::IDENTITY }));
    }
}

/// The product of a block's operations, each multiplied on the right.
fn transform(block: &Node) -> DAffine3 {
    let mut product = DAffine3::IDENTITY;
    let mut words: Vec<(String, Vec<f64>)> = Vec::new();
    for item in &block.items {
        match item {
            Item::Word(word) => match (word.parse(), words.last_mut()) {
                (Ok(number), Some(last)) => last.1.push(number),
                _ => words.push((word.clone(), Vec::new())),
            },
            Item::Block(inner) => {
                let numbers: Option<Vec<f64>> = inner.words().iter().map(|word| word.parse().ok()).collect();
                words.extend(numbers.filter(|n| !n.is_empty()).map(|numbers| (inner.name.clone(), numbers)));
            }
        }
    }
    for (name, n) in words {
        let v = || DVec3::new(n[0], n[1], n[2]);
        // Rows, or columns; the only operations that are multiplied on the left.
        if name.starts_with("Matrix") {
            let at = |row: usize, column: usize| {
                n[if name == "Matrix" { 4 * row + column } else { 4 * column + row }]
            };
            let column = |j| DVec3::new(at(0, j), at(1, j), at(2, j));
            let linear = DMat3::from_cols(column(0), column(1), column(2));
            product = DAffine3::from_mat3_translation(linear, column(3)) * product;
            continue;
        }
        let turn = |m: fn(f64) -> DMat3| DAffine3::from_mat3(m(n[0].to_radians()));
        product *= match name.as_str() {
            "Translate" => DAffine3::from_translation(v()),
            "Scale" => DAffine3::from_scale(v()),
            "UniformScale" => DAffine3::from_scale(DVec3::splat(n[0])),
            "XRotate" => turn(DMat3::from_rotation_x),
            "YRotate" => turn(DMat3::from_rotation_y),
            "ZRotate" => turn(DMat3::from_rotation_z),
            "Rotate" => DAffine3::from_axis_angle(v().normalize(), n[3].to_radians()),
            _ => DAffine3::IDENTITY,
        };
    }
    product
}

fn shape(block: &Node, path: &Path) -> Option<Shape> {
    match block.name.as_str() {
        "Sphere" => {
            let moved = ["velocity", "moveVector", "motion"].iter().find_map(|key| block.vector(key));
            Some(Shape::Ball(
                block.vector("center")? + 0.5 * moved.unwrap_or_default(),
                block.number("radius")?,
            ))
        }
        "MovingSphere" => {
            let middle = 0.5 * (block.vector("center0")? + block.vector("center1")?);
            Some(Shape::Ball(middle, block.number("radius")?))
        }
        "Plane" => Some(Shape::Plane(block.vector("normal")?, block.number("offset")?)),
        "Triangle" => {
            let [a, b, c] = ["vertex0", "vertex1", "vertex2"].map(|key| block.vector(key));
            Some(Shape::Parallelogram(a?, b? - a?, c? - a?, true))
        }
        "Quad" => {
            Some(Shape::Parallelogram(block.vector("origin")?, block.vector("u")?, block.vector("v")?, false))
        }
        "Rectangle" if block.has("x_axis") => {
            let (p, u, v) = (block.vector("position")?, block.vector("x_axis")?, block.vector("y_axis")?);
            Some(Shape::Parallelogram(p - u - v, 2.0 * u, 2.0 * v, false))
        }
        "Rectangle" => {
            Some(Shape::Parallelogram(block.vector("point")?, block.vector("x")?, block.vector("y")?, false))
        }
        "XYRectangle" | "XZRectangle" | "YZRectangle" => {
            let (n, at) = (block.numbers("points", 4)?, block.number("offset")?);
            let place = |u: f64, v: f64| match block.name.as_bytes()[..2] {
                [b'X', b'Y'] => DVec3::new(u, v, at),
                [b'X', b'Z'] => DVec3::new(u, at, v),
                _ => DVec3::new(at, u, v),
            };
            let corner = place(n[0], n[2]);
            Some(Shape::Parallelogram(corner, place(n[1], n[2]) - corner, place(n[0], n[3]) - corner, false))
        }
        "Disk" => Some(Shape::Disk(
            block.vector("center")?,
            block.vector("normal")?.normalize(),
            block.number("radius")?,
        )),
        "Cube" => {
            let (a, b) = (block.vector("min_p")?, block.vector("max_p")?);
            Some(Shape::Box(a.min(b), a.max(b)))
        }
        "TriangleMesh" => mesh(block, block.after("obj_file").first()?, path),
        "TinyObj" => mesh(block, block.words().first()?, path),
        "RevSurface" => Some(Shape::Turned(profile(block.blocks().next()?))),
        // Both ends on the y axis.
        "Cylinder" => {
            let (words, radius) = (block.words(), block.number("radius")?);
            let height = |at: usize| words.get(at + 2)?.parse().ok();
            let ends = (0..words.len()).filter(|&at| words[at] == "endpoint").filter_map(height);
            Some(Shape::Turned(ends.map(|y| (radius, y)).collect()))
        }
        _ => None,
    }
}

/// The triangles of an OBJ file, scaled, mirrored and moved; `None` if there is no such file.
fn mesh(block: &Node, file: &str, path: &Path) -> Option<Shape> {
    let scale = block.number("scale").unwrap_or(1.0);
    let offset = block.vector("offset").unwrap_or_default();
    let mirror = if block.has("Y_inverse") { DVec3::new(1.0, 1.0, -1.0) } else { DVec3::ONE };
    let text = path
        .ancestors()
        .skip(1)
        .take(3)
        .find_map(|folder| std::fs::read_to_string(folder.join(file)).ok())?;
    let (mut points, mut triangles, mut has_polygons) = (Vec::new(), Vec::new(), false);
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z, ..] => {
                let [x, y, z] = [x, y, z].map(|word| word.parse::<f64>().expect("a coordinate"));
                points.push(DVec3::new(x, y, z) * mirror * scale + offset);
            }
            ["f", ref corners @ ..] => {
                let index = |corner: &&str| corner.split('/').next().and_then(|i| i.parse::<usize>().ok());
                let corners: Vec<DVec3> =
                    corners.iter().filter_map(index).map(|index| points[index - 1]).collect();
                has_polygons |= corners.len() > 3;
                triangles.extend((2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]));
            }
            _ => {}
        }
    }
    let all = || triangles.iter().flatten().copied();
    let (low, high) = (all().fold(DVec3::INFINITY, DVec3::min), all().fold(DVec3::NEG_INFINITY, DVec3::max));
    Some(Shape::Triangles(triangles, low, high, has_polygons))
}

/// The profile in many straight pieces, on the right of the axis.
fn profile(curve: &Node) -> Vec<(f64, f64)> {
    const PIECES: usize = 1500;
    let words = curve.after("controls");
    let controls: Vec<DVec3> = words
        .split(|word| *word == "]")
        .filter_map(|point| {
            let n: Vec<f64> = point.iter().filter_map(|word| word.parse().ok()).collect();
            (n.len() == 3).then(|| DVec3::new(n[0], n[1], n[2]))
        })
        .collect();
    let at = |t: f64| -> DVec3 {
        if curve.name == "BezierCurve" {
            let mut points = controls.clone();
            while points.len() > 1 {
                points = points.windows(2).map(|pair| pair[0].lerp(pair[1], t)).collect();
            }
            return points[0];
        }
        let pieces = controls.len() - 3;
        let piece = ((t * pieces as f64) as usize).min(pieces - 1);
        let u = t * pieces as f64 - piece as f64;
        let weights = [
            (1.0 - u).powi(3),
            3.0 * u.powi(3) - 6.0 * u * u + 4.0,
            -3.0 * u.powi(3) + 3.0 * u * u + 3.0 * u + 1.0,
            u.powi(3),
        ];
        weights.iter().zip(&controls[piece..]).map(|(weight, point)| *point * (weight / 6.0)).sum()
    };
    (0..=PIECES).map(|i| at(i as f64 / PIECES as f64)).map(|p| (p.x.abs(), p.y)).collect()
}

impl Scene {
    /// The ray through the middle of a pixel, counted from the top left, with a unit direction.
    pub fn ray(&self, [x, y]: [u32; 2]) -> (DVec3, DVec3) {
        let [width, height] = self.size.map(f64::from);
        let across = (2.0 * (f64::from(x) + 0.5) - width) / height;
        let upwards = (height - 2.0 * (f64::from(y) + 0.5)) / height;
        let offset = (self.right * across + self.up * upwards) * self.extent;
        if self.is_orthographic {
            return (self.center + offset - self.forward * (2000.0 * self.extent), self.forward);
        }
        (self.center, (self.forward + offset).normalize())
    }

    /// The distance to the nearest surface.
    pub fn closest_hit(&self, origin: DVec3, way: DVec3) -> Option<f64> {
        let hits = self.shapes.iter().filter_map(|placed| {
            let (o, d) =
                (placed.from_world.transform_point3(origin), placed.from_world.transform_vector3(way));
            placed.shape.hit(o, d)
        });
        hits.min_by(f64::total_cmp)
    }
}

/// The smallest solution of `a t^2 + b t + c = 0` above 0 that is admitted.
fn smallest(a: f64, b: f64, c: f64, admits: impl Fn(f64) -> bool) -> Option<f64> {
    let root = (b * b - 4.0 * a * c).sqrt();
    let both = if a.abs() < 1e-300 {
        [-c / b, f64::NAN]
    } else {
        [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]
    };
    both.into_iter().filter(|t| *t > 1e-9 && admits(*t)).min_by(f64::total_cmp)
}

impl Shape {
    fn hit(&self, o: DVec3, d: DVec3) -> Option<f64> {
        match self {
            Self::Ball(center, radius) => {
                let to = o - *center;
                smallest(d.dot(d), 2.0 * d.dot(to), to.dot(to) - radius * radius, |_| true)
            }
            Self::Plane(normal, offset) => {
                Some((offset - normal.dot(o)) / normal.dot(d)).filter(|t| *t > 1e-9 && t.is_finite())
            }
            Self::Parallelogram(corner, u, v, is_triangle) => {
                let n = u.cross(*v);
                let t = n.dot(*corner - o) / n.dot(d);
                let p = o + d * t - *corner;
                let (a, b) = (p.cross(*v).dot(n) / n.dot(n), u.cross(p).dot(n) / n.dot(n));
                let inside =
                    a >= 0.0 && b >= 0.0 && if *is_triangle { a + b <= 1.0 } else { a <= 1.0 && b <= 1.0 };
                (t > 1e-9 && inside).then_some(t)
            }
            Self::Disk(center, normal, radius) => {
                let t = normal.dot(*center - o) / normal.dot(d);
                (t > 1e-9 && (o + d * t).distance(*center) <= *radius).then_some(t)
            }
            Self::Box(low, high) => {
                let (near, far) = slabs(o, d, *low, *high)?;
                Some(if near > 1e-9 { near } else { far }).filter(|t| *t > 1e-9)
            }
            Self::Triangles(triangles, low, high, _) => {
                slabs(o, d, *low, *high)?;
                let each = triangles
                    .iter()
                    .filter_map(|[a, b, c]| Self::Parallelogram(*a, *b - *a, *c - *a, true).hit(o, d));
                each.min_by(f64::total_cmp)
            }
            Self::Turned(profile) => {
                let pieces = profile.windows(2).filter_map(|pair| frustum(o, d, pair[0], pair[1]));
                pieces.min_by(f64::total_cmp)
            }
        }
    }
}

/// Where a ray enters and leaves a box.
fn slabs(o: DVec3, d: DVec3, low: DVec3, high: DVec3) -> Option<(f64, f64)> {
    let (a, b) = ((low - o) / d, (high - o) / d);
    let (near, far) = (a.min(b).max_element(), a.max(b).min_element());
    (near <= far * (1.0 + 1e-9) && far > 0.0).then_some((near, far))
}

/// A straight piece of a profile turned about y: a part of a cone, or of a plane.
fn frustum(o: DVec3, d: DVec3, (r0, y0): (f64, f64), (r1, y1): (f64, f64)) -> Option<f64> {
    let (dr, dy) = (r1 - r0, y1 - y0);
    if dy == 0.0 {
        let t = (y0 - o.y) / d.y;
        let r = (o + d * t).with_y(0.0).length();
        return (t > 1e-9 && r >= r0.min(r1) && r <= r0.max(r1)).then_some(t);
    }
    // x^2 + z^2 = (r0 + k (y - y0))^2
    let k = dr / dy;
    let (s0, s1) = (r0 + k * (o.y - y0), k * d.y);
    let a = d.x * d.x + d.z * d.z - s1 * s1;
    let b = 2.0 * (o.x * d.x + o.z * d.z - s0 * s1);
    let c = o.x * o.x + o.z * o.z - s0 * s0;
    smallest(a, b, c, |t| {
        let y = o.y + d.y * t;
        y >= y0.min(y1) && y <= y0.max(y1) && s0 + s1 * t >= 0.0
    })
}
