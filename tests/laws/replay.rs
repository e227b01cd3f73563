//! A pixel that is replayed is the pixel that was rendered.

use super::worlds::{cornell, path_tracing};
use snell::math::Rgb;
use snell::render::integrator::{ClassicSettings, Event, Shading};
use snell::render::{GatherRadius, HybridSettings, Method, PpmSettings, Settings, World, render, replay};

fn methods() -> [Method; 4] {
    let (photon_count, k, shrink) = (2_000, 20, 0.67);
    [
        Method::Pt,
        Method::Ppm(PpmSettings { photon_count, k, radius: 0.1, shrink }),
        Method::Hybrid(HybridSettings { photon_count, k, radius: GatherRadius::Pixels(2.0), shrink }),
        Method::Classic(ClassicSettings {
            shading: Shading::Phong,
            shadows: true,
            ambient: Rgb::gray(0.1),
            lit_backs: false,
        }),
    ]
}

/// What events add to their pixel. What is shared counts once it has been.
fn added(events: &[Event]) -> Rgb {
    let (mut sum, mut is_shared) = (Rgb::BLACK, false);
    for event in events {
        match event {
            Event::Sends => is_shared = true,
            Event::Branch { .. } | Event::Shared { .. } => is_shared = false,
            _ => {}
        }
        if !is_shared {
            sum += added_by(event);
        }
    }
    sum
}

fn added_by(event: &Event) -> Rgb {
    match event {
        Event::Emitted { added }
        | Event::Lit { added }
        | Event::Photons { added }
        | Event::Gathered { added }
        | Event::Shared { added, .. }
        | Event::Sky { added, .. } => *added,
        _ => Rgb::BLACK,
    }
}

#[test]
fn replayed_samples_are_those_of_the_film_bit_for_bit() {
    for method in methods() {
        let world = World::new(cornell(8, true));
        let settings = Settings { method, ..path_tracing(5, 12) };
        let film = render(&world, &settings, &()).film;
        for (pixel, mean) in film.region().pixels().zip(film.mean()) {
            let replays = replay(&world, &settings, pixel, 0..5);
            let sum = replays.iter().map(|replay| f64::from(replay.sample.g)).sum::<f64>();
            assert_eq!((sum / 5.0) as f32, mean.g, "{method:?} {pixel:?}");
        }
    }
}

#[test]
fn what_events_add_is_the_sample() {
    for method in methods() {
        let world = World::new(cornell(8, true));
        let settings = Settings { method, ..path_tracing(1, 12) };
        let mut vertices = 0;
        for pixel in [[1, 6], [2, 5], [5, 5], [6, 6], [4, 1]] {
            for replay in replay(&world, &settings, pixel, 0..4) {
                let sum = added(&replay.events);
                // Up to the order in which a path adds them up.
                let apart = (sum - replay.sample).map(f32::abs).max_component();
                let most = 1e-5 * replay.sample.max_component();
                assert!(apart <= most, "{method:?} {pixel:?}: {sum:?} for {:#?}", replay);
                vertices += replay.events.iter().filter(|e| matches!(e, Event::Vertex { .. })).count();
            }
        }
        assert!(vertices > 20, "{method:?}: only {vertices} vertices");
    }
}
