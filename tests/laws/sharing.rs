//! What pixels promise that share what their paths find: the picture of those that share nothing, with less noise.

use super::forks::{SIDE, trace};
use super::light::sky_of_two_halves;
use super::scattering::surface;
use super::statistics::points;
use super::worlds::{camera, cornell, cuboid, diffuse, emissive, empty, gray, quad, sphere};
use snell::math::motion::{Factor, Motion};
use snell::math::{DAffine3, DVec3, Rgb, Vec3};
use snell::render::bsdf::{Bsdf, Glass, Lobe, Material};
use snell::render::integrator::{Integrator, PathTracer};
use snell::render::{Parts, World};
use std::sync::Arc;

/// Rooms and yards, each with the share of the noise, as a variance, that sharing leaves at the most.
fn worlds() -> Vec<(&'static str, Parts, f64)> {
    let room = cornell(SIDE, false);

    // Normals that lean over: a wall of a round thing, lit and seen from where they do not look.
    let mut leaning = cornell(SIDE, false);
    for (mesh, lean) in leaning.meshes.iter_mut().zip([Vec3::X, Vec3::Z, -Vec3::X, Vec3::Y, Vec3::Z]) {
        let n = (mesh.positions[1] - mesh.positions[0]).cross(mesh.positions[2] - mesh.positions[0]);
        let toward = |share: f32| (n.normalize() + lean * share).normalize();
        mesh.normals = Some([0.0, 1.5, 3.0, -1.5].map(toward).into());
    }

    let mut gleaming = cornell(SIDE, true);
    gleaming.materials[0] = Material::Plastic { color: gray(0.6), ior: 1.5, roughness: gray(0.6) };
    gleaming.materials[4] = Material::Metal { f0: gray(0.9), edge: gray(1.0), roughness: gray(0.5) };

    // Matt balls within coloured glass, beside others outside of it.
    let mut sunken = cornell(SIDE, true);
    sunken.materials[5] =
        Material::Glass(Glass { absorption: Rgb::new(0.5, 1.0, 4.0), ..Glass::of_ior(1.3) });
    sunken.solids = vec![
        sphere(Vec3::new(0.0, 0.7, 0.5), 0.6, 5),
        sphere(Vec3::new(-0.2, 0.6, 0.5), 0.2, 0),
        sphere(Vec3::new(0.2, 0.7, 0.6), 0.2, 1),
        sphere(Vec3::new(-0.7, 0.4, 0.0), 0.4, 2),
    ];

    // Under a sky that is bright on one side, with a lamp that bsdfs find as often as light sampling does.
    let mut yard = empty(camera(Vec3::new(0.0, 1.5, 4.0), Vec3::new(0.0, -0.3, -1.0), 0.4, SIDE));
    yard.materials = vec![diffuse(0.8), emissive(1.0)];
    yard.meshes = vec![quad(Vec3::new(-9.0, 0.0, -9.0), Vec3::Z * 18.0, Vec3::X * 18.0, 0)];
    yard.meshes.extend(cuboid(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(0.2, 1.0, 0.0), false, 0));
    yard.meshes.push(quad(Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.5, 1.5, 0.0), Vec3::Z * -2.0, 1));
    yard.environment = Some(sky_of_two_halves());

    vec![
        ("a room", room, 0.5),
        ("leaning normals", leaning, 0.7),
        ("gleams", gleaming, 1.1),
        ("under coloured glass", sunken, 0.8),
        ("a yard", yard, 0.7),
    ]
}

#[test]
fn sharing_changes_no_mean_and_takes_noise_away() {
    // Of Welch's t with 7 to 14 degrees of freedom: exceeded by chance once in 3,000 tests, of which there are 20.
    const T: f64 = 5.5;
    for (name, parts, most) in worlds() {
        let world = World::new(parts);
        let tracer = PathTracer::new(&world, 8);
        assert!(tracer.group_side() > 1);
        let shared = trace(&tracer, &world);
        let own = trace(&tracer.without_sharing(), &world);
        for (quarter, ((a, va), (b, vb))) in shared.quarters.into_iter().zip(own.quarters).enumerate() {
            let noise = (va + vb).sqrt();
            assert!((a - b).abs() <= T * noise, "{name}, quarter {quarter}: {a} and {b}, noise {noise}");
        }
        let ratio = shared.noise / own.noise;
        assert!(ratio < most, "{name}: {ratio} of the noise");
    }
}

#[test]
fn rays_that_do_not_always_meet_the_same_are_not_shared() {
    let mut masked = cornell(SIDE, false);
    masked.materials.push(Material::Mask {
        base: masked.meshes[0].material,
        opacity: gray(0.5),
        cutoff: 0.0,
    });
    assert_eq!(PathTracer::new(&World::new(masked), 8).group_side(), 1);
    let mut spread = cornell(SIDE, true);
    spread.materials[5] = Material::Glass(Glass { spread: 0.05, ..Glass::of_ior(1.6) });
    assert_eq!(PathTracer::new(&World::new(spread), 8).group_side(), 1);
    let mut moving = cornell(SIDE, true);
    let aside = DAffine3::from_translation(DVec3::X);
    let shift = Factor::Straight { from: DAffine3::IDENTITY, to: aside };
    moving.solids[0].motion = Motion::new([shift]).map(Arc::new);
    assert_eq!(PathTracer::new(&World::new(moving), 8).group_side(), 1);
}

#[test]
fn a_lambertian_is_its_bsdf() {
    let dirs: Vec<Vec3> = points(400)
        .map(|(u, _)| {
            let (z, phi) = (1.0 - 2.0 * u.x, u.y * std::f32::consts::TAU);
            Vec3::new((1.0 - z * z).sqrt() * phi.cos(), (1.0 - z * z).sqrt() * phi.sin(), z)
        })
        .collect();
    for ns in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.98, 0.2).normalize()] {
        let mut bsdf = Bsdf::new(&surface(ns));
        bsdf.add(Lobe::Lambert { albedo: Rgb::new(0.2, 0.5, 0.9) });
        for &wo in &dirs[..40] {
            let lambertian = bsdf.lambertian(wo).expect("seen from aside");
            for &wi in &dirs {
                let ((a, pa), (b, pb)) = (lambertian.eval_pdf(wi), bsdf.eval_pdf(wo, wi));
                assert!((pa - pb).abs() < 1e-6 && (a - b).map(f32::abs).max_component() < 1e-6, "{wo} {wi}");
            }
        }
    }
}
