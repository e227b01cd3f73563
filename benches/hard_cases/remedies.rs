//! The remedies, each with its input and what counts as a failure.

use crate::support::{
    BruteForce, Random, Walk, aimed_ray, closed_meshes, conservative_slab, fresnel_by_angles, fused_slab,
    hasty_slab, mesh, naive_intersect, scene, sphere, textbook_distribution, textbook_fresnel,
    textbook_sphere,
};
use crate::{Form, Remedy, time_both};
use snell::math::{DAffine3, Ray, Vec3};
use snell::render::bsdf::fresnel_dielectric;
use snell::render::geometry::{Geometry, SurfacePoint};
use snell::render::integrator::mis_weight;
use snell::render::photon::Schedule;
use snell::render::shape::triangle::{ShearedRay, TriangleBlock};
use snell::render::shape::{MaterialId, Solid, SolidKind, SourceId};
use std::f64::consts::PI;

/// All of them, in the order of their cases.
pub fn all() -> Vec<Remedy> {
    vec![
        triangles(),
        boxes("2", "boxes by fused multiply-adds", fused_slab),
        boxes("3", "near side by `d < 0`, no allowance", hasty_slab),
        spheres(),
        origins(),
        fresnel(),
        microfacets(),
        weights(),
        radii(),
        sums(),
    ]
}

fn form(name: &'static str, failures: String, nanoseconds: f64) -> Form {
    Form { name, failures, nanoseconds }
}

/// Rays aimed at vertices and edges of closed meshes, with the mesh of each.
fn aimed(count: usize) -> Vec<(usize, Ray)> {
    let meshes = closed_meshes();
    let mut random = Random(1);
    (0..count)
        .map(|i| {
            let which = i / 4 % meshes.len();
            let (_, mesh, center) = &meshes[which];
            (which, aimed_ray(mesh, *center, i, &mut random))
        })
        .collect()
}

fn triangles() -> Remedy {
    let meshes = closed_meshes();
    let rays = aimed(1_600);
    let brute_force: Vec<_> = meshes.iter().map(|(_, mesh, _)| BruteForce::new(mesh)).collect();
    let lost_by_naive = rays.iter().filter(|(which, ray)| {
        let mesh = &meshes[*which].1;
        !mesh.triangles.iter().any(|corners| naive_intersect(mesh.corners(*corners), ray))
    });
    let lost = rays.iter().filter(|(which, ray)| brute_force[*which].closest_hit(ray).is_none());
    let failures =
        [lost_by_naive.count(), lost.count()].map(|n| format!("{n} of {} rays escape", rays.len()));

    // Four triangles at a time, as in the leaves of the tree.
    let mesh = &meshes[1].1;
    let fours: Vec<[[Vec3; 3]; 4]> =
        mesh.triangles.chunks_exact(4).map(|four| std::array::from_fn(|i| mesh.corners(four[i]))).collect();
    let blocks: Vec<_> = fours
        .iter()
        .map(|four| TriangleBlock::new(&std::array::from_fn::<_, 4, _>(|i| (four[i], i as u32))))
        .collect();
    let ray = Ray::new(Vec3::new(0.01, 0.02, 0.03), Vec3::new(0.3, 0.5, -0.8).normalize());
    let sheared = ShearedRay::new(&ray);
    let [naive, robust] = time_both(
        400_000,
        |i| fours[i % fours.len()].iter().filter(|corners| naive_intersect(**corners, &ray)).count() as f64,
        |i| {
            let mut hits = 0.0;
            blocks[i % blocks.len()].intersect(&sheared, |_, hit| hits += f64::from(hit.t));
            hits
        },
    );
    let [naive_failures, failures] = failures;
    Remedy {
        case: "1 edges and vertices",
        call: "a ray against four triangles",
        naive: form("Möller & Trumbore 1997", naive_failures, naive),
        robust: form("Woop, Benthin, Wald 2013, four at a time", failures, robust),
    }
}

fn boxes(
    case: &'static str,
    name: &'static str,
    slab: fn(&Ray, snell::math::Bounds) -> Option<[f32; 2]>,
) -> Remedy {
    let meshes = closed_meshes();
    let rays = aimed(16_000);
    let walks = |slab| -> Vec<Walk> { meshes.iter().map(|(_, mesh, _)| Walk::new(mesh, slab)).collect() };
    let (plain, careful) = (walks(slab), walks(conservative_slab));
    let lost =
        |walks: &[Walk]| rays.iter().filter(|(which, ray)| walks[*which].closest_hit(ray).is_none()).count();
    let failures = [lost(&plain), lost(&careful)].map(|n| format!("{n} of {} rays escape", rays.len()));
    let trace = |walks: &[Walk], i: usize| {
        let (which, ray) = &rays[i % rays.len()];
        walks[*which].closest_hit(ray).map_or(0.0, |(t, _)| f64::from(t))
    };
    let [naive, robust] = time_both(16_000, |i| trace(&plain, i), |i| trace(&careful, i));
    let [naive_failures, failures] = failures;
    Remedy {
        case: if case == "2" { "2 no cell is skipped" } else { "3 zeros of both signs" },
        call: "a ray through a binary tree",
        naive: form(name, naive_failures, naive),
        robust: form("conservative (Ize 2013), near side by the sign bit", failures, robust),
    }
}

fn spheres() -> Remedy {
    let mut random = Random(18);
    let rays: Vec<Ray> = (0..20_000)
        .map(|_| {
            let o = random.direction() * 1e4;
            Ray::new(o, (random.point() * 1.2 - o).normalize())
        })
        .collect();
    let solid = Solid {
        kind: SolidKind::Sphere,
        world_from_object: DAffine3::IDENTITY,
        texture_from_object: DAffine3::IDENTITY,
        material: MaterialId(0),
        source: SourceId::default(),
        motion: None,
    };
    let geometry = Geometry::build(Vec::new(), vec![solid]);
    let is_hit = |ray: &Ray| {
        let (o, d) = (ray.o.as_dvec3(), ray.d.as_dvec3());
        o.cross(d).length() < d.length()
    };
    let wrong = |test: &dyn Fn(&Ray) -> bool| {
        let wrong = rays.iter().filter(|ray| test(ray) != is_hit(ray)).count();
        format!("{wrong} of {} hits or misses wrong at 10⁴ radii", rays.len())
    };
    let failures =
        [wrong(&|ray| textbook_sphere(ray.o, ray.d, 1.0).is_some()), wrong(&|ray| geometry.any_hit(ray))];
    let [naive, robust] = time_both(
        200_000,
        |i| f64::from(textbook_sphere(rays[i % rays.len()].o, rays[i % rays.len()].d, 1.0).unwrap_or(0.0)),
        |i| geometry.closest_hit(&rays[i % rays.len()]).map_or(0.0, |hit| f64::from(hit.t)),
    );
    let [naive_failures, failures] = failures;
    Remedy {
        case: "18 small and distant spheres",
        call: "a ray against a sphere; the second with box and tree",
        naive: form("b² − 4ac in single precision", naive_failures, naive),
        robust: form("double precision, stable root (Haines et al. 2019)", failures, robust),
    }
}

fn origins() -> Remedy {
    let places = [(1.0, Vec3::ZERO), (1e-4, Vec3::ZERO), (1e6, Vec3::ZERO), (1.0, Vec3::splat(1e4))];
    let mut points: Vec<(usize, SurfacePoint, Vec3)> = Vec::new();
    let mut random = Random(25);
    let scenes: Vec<Geometry> = places
        .iter()
        .map(|&(scale, shift)| {
            let (positions, triangles) = sphere(40, 40, |_, _| 1.0);
            scene(mesh(positions.iter().map(|p| *p * scale + shift).collect(), triangles))
        })
        .collect();
    for (i, &(scale, shift)) in places.iter().enumerate() {
        for _ in 0..5_000 {
            let o = shift + random.direction() * scale * 3.0;
            let ray = Ray::new(o, shift + random.point() * scale * 0.5 - o);
            let Some(hit) = scenes[i].closest_hit(&ray) else { continue };
            points.push((i, scenes[i].surface_point(&ray, &hit), random.direction()));
        }
    }
    let wrong = |spawn: &dyn Fn(&SurfacePoint, Vec3) -> Ray| {
        let (mut self_hits, mut leaks) = (0, 0);
        for (which, point, dir) in &points {
            let out = if dir.dot(point.n) < 0.0 { -*dir } else { *dir };
            self_hits += usize::from(scenes[*which].any_hit(&spawn(point, out)));
            leaks += usize::from(!scenes[*which].any_hit(&spawn(point, -out)));
        }
        format!("{self_hits} self-hits, {leaks} leaks of {} each", points.len())
    };
    let fixed = |point: &SurfacePoint, dir: Vec3| Ray::new(point.p + dir * 1e-4, dir);
    let bounded = |point: &SurfacePoint, dir: Vec3| point.spawn(dir);
    let failures = [wrong(&fixed), wrong(&bounded)];
    let sum = |ray: Ray| f64::from(ray.o.x + ray.o.y + ray.o.z);
    let [naive, robust] = time_both(
        2_000_000,
        |i| sum(fixed(&points[i % points.len()].1, points[i % points.len()].2)),
        |i| sum(bounded(&points[i % points.len()].1, points[i % points.len()].2)),
    );
    let [naive_failures, failures] = failures;
    Remedy {
        case: "25 leaving a surface",
        call: "the origin of a ray",
        naive: form("10⁻⁴ along the direction", naive_failures, naive),
        robust: form("error bounds (Pharr, Jakob, Humphreys 2023)", failures, robust),
    }
}

fn fresnel() -> Remedy {
    let inputs: Vec<(f64, f64)> = [1.0 + 1e-6, 1.0001, 1.5, 1.0 / 1.5, 2.42]
        .into_iter()
        .flat_map(|eta| (0..2_000).map(move |i| (f64::from(i) / 2_000.0, eta)))
        .collect();
    let worst = |f: &dyn Fn(f64, f64) -> f64| {
        let errors = inputs.iter().map(|&(cos, eta)| (f(cos, eta) - fresnel_by_angles(cos, eta)).abs());
        format!("off by up to {:.0e}", errors.fold(0.0, f64::max))
    };
    let naive = |cos: f64, eta: f64| f64::from(textbook_fresnel(cos as f32, eta as f32));
    let robust = |cos: f64, eta: f64| fresnel_dielectric(cos, eta).0;
    let failures = [worst(&naive), worst(&robust)];
    let at = |i: usize| inputs[i % inputs.len()];
    let [naive, robust] = time_both(2_000_000, |i| naive(at(i).0, at(i).1), |i| robust(at(i).0, at(i).1));
    let [naive_failures, failures] = failures;
    Remedy {
        case: "34 Fresnel near total reflection",
        call: "a reflectance",
        naive: form("1 − (1 − c²) / η² in single precision", naive_failures, naive),
        robust: form("(c² + (η − 1)(η + 1)) / η² in double precision", failures, robust),
    }
}

fn microfacets() -> Remedy {
    let textbook = |alpha: f32, h: Vec3| textbook_distribution(alpha, h.z);
    let by_slopes = |alpha: f32, h: Vec3| {
        let a2 = alpha * alpha;
        let s = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
        1.0 / (std::f32::consts::PI * a2 * s * s)
    };
    let inputs: Vec<(f32, Vec3)> = [1e-4_f32, 1e-3, 1e-2, 0.1]
        .into_iter()
        .flat_map(|alpha| {
            (0..1_000)
                .map(move |i| (alpha, Vec3::new(alpha * 3.0 * i as f32 / 1_000.0, 0.0, 1.0).normalize()))
        })
        .collect();
    let wrong = |d: &dyn Fn(f32, Vec3) -> f32| {
        let wrong = inputs.iter().filter(|(alpha, h)| {
            let (a, h) = (f64::from(*alpha), h.as_dvec3());
            let s = (h.x * h.x + h.y * h.y) / (a * a) + h.z * h.z;
            let exact = 1.0 / (PI * a * a * s * s);
            !is_within(f64::from(d(*alpha, h.as_vec3())) / exact - 1.0, 0.01)
        });
        format!("{} of {} off by more than 1 %", wrong.count(), inputs.len())
    };
    let failures = [wrong(&textbook), wrong(&by_slopes)];
    let at = |i: usize| inputs[i % inputs.len()];
    let [naive, robust] = time_both(
        2_000_000,
        |i| f64::from(textbook(at(i).0, at(i).1)),
        |i| f64::from(by_slopes(at(i).0, at(i).1)),
    );
    let [naive_failures, failures] = failures;
    Remedy {
        case: "37 microfacets of small width",
        call: "D(h)",
        naive: form("(n·h)² (α² − 1) + 1", naive_failures, naive),
        robust: form("by slopes", failures, robust),
    }
}

/// Whether an error is below a bound; what is no number is not.
fn is_within(error: f64, bound: f64) -> bool {
    error.abs() < bound
}

fn weights() -> Remedy {
    let densities = [0.0, 1e-38, 1e-20, 1.0, 1e20, 1e38, f32::INFINITY];
    let inputs: Vec<(f32, f32)> = densities
        .iter()
        .flat_map(|&a| densities.iter().map(move |&b| (a, b)))
        .filter(|pair| *pair != (0.0, 0.0))
        .collect();
    let squares = |a: f32, b: f32| a * a / (a * a + b * b);
    let wrong = |w: &dyn Fn(f32, f32) -> f32| {
        let wrong = inputs.iter().filter(|&&(a, b)| !is_within(f64::from(w(a, b) + w(b, a)) - 1.0, 1e-6));
        format!("{} of {} pairs do not add up to 1", wrong.count(), inputs.len())
    };
    let failures = [wrong(&squares), wrong(&mis_weight)];
    let at = |i: usize| (0.5 + (i % 97) as f32, 0.1 + (i % 89) as f32);
    let [naive, robust] = time_both(
        4_000_000,
        |i| f64::from(squares(at(i).0, at(i).1)),
        |i| f64::from(mis_weight(at(i).0, at(i).1)),
    );
    let [naive_failures, failures] = failures;
    Remedy {
        case: "45 weights at the extremes",
        call: "a weight",
        naive: form("a² / (a² + b²)", naive_failures, naive),
        robust: form("the ratio formed first", failures, robust),
    }
}

fn radii() -> Remedy {
    let (alpha, passes) = (2.0 / 3.0, 1_000_000_u32);
    let exact = libm::exp(
        libm::lgamma(f64::from(passes) + alpha)
            - libm::lgamma(1.0 + alpha)
            - libm::lgamma(f64::from(passes) + 1.0),
    );
    let single = (1..passes).fold(1.0_f32, |r2, i| r2 * ((i as f32 + alpha as f32) / (i as f32 + 1.0)));
    let double = Schedule::new(1.0, alpha).radius2(passes - 1);
    let off = |r2: f64| format!("off by {:.0e} after 10⁶ passes", (r2 / exact - 1.0).abs());
    let (mut r2, mut schedule) = (1.0_f32, Schedule::new(1.0, alpha));
    let [naive, robust] = time_both(
        100_000,
        |i| {
            r2 = if i == 0 { 1.0 } else { r2 * ((i as f32 + 0.666) / (i as f32 + 1.0)) };
            f64::from(r2)
        },
        |i| schedule.radius2(i as u32),
    );
    Remedy {
        case: "54 radii over a long run",
        call: "a pass",
        naive: form("the recursion in single precision", off(f64::from(single)), naive),
        robust: form("in double precision", off(double), robust),
    }
}

fn sums() -> Remedy {
    let samples = |i: usize| if i.is_multiple_of(10) { 0.3 } else { 0.1_f32 };
    let count = 10_000_000;
    let exact = (0..count).map(|i| f64::from(samples(i))).sum::<f64>();
    let single = (0..count).fold(0.0_f32, |sum, i| sum + samples(i));
    let off = |sum: f64| format!("off by {:.0e} after 10⁷ samples", (sum / exact - 1.0).abs());
    let (mut a, mut b) = (0.0_f32, 0.0_f64);
    let [naive, robust] = time_both(
        4_000_000,
        |i| {
            a += samples(i);
            0.0
        },
        |i| {
            b += f64::from(samples(i));
            0.0
        },
    );
    std::hint::black_box((a, b));
    Remedy {
        case: "62 sums of samples",
        call: "a sample",
        naive: form("single precision", off(f64::from(single)), naive),
        robust: form("double precision", off(exact), robust),
    }
}
