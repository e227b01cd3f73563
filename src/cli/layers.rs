//! `--layers` of `render`: what an EXR holds beside its colours.

use crate::math::{Rgb, Vec3};
use crate::output::Plane;
use crate::render::film::Film;
use crate::render::{Outcome, World};
use clap::ValueEnum;

/// A layer, or several at once.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Choice {
    /// The share of light that the first surface sends on.
    Albedo,
    /// The direction in which the first surface looks, in the world.
    Normal,
    /// The distance to the first surface, in metres.
    Depth,
    /// How far the colour may be from the truth: half its 95 % interval.
    Margin,
    /// Seconds of a thread spent on the pixel; differs from run to run.
    Time,
    /// All of these.
    All,
    /// None of these.
    None,
}

/// The layers that are wanted; `None` takes back what was said before it.
pub fn chosen(said: &[Choice]) -> Vec<Choice> {
    use Choice::{Albedo, All, Depth, Margin, None, Normal, Time};
    match said.iter().rposition(|&choice| choice == None) {
        Some(none) => said[none + 1..].to_vec(),
        Option::None if said.is_empty() => vec![Albedo, Normal, Depth],
        Option::None if said.contains(&All) => vec![Albedo, Normal, Depth, Margin, Time],
        Option::None => said.to_vec(),
    }
}

/// The planes of the layers. Rays are traced only where a layer asks for them.
pub fn planes(wanted: &[Choice], world: &World, seed: u64, outcome: &Outcome) -> Vec<Plane> {
    let wants = |choice| wanted.contains(&choice);
    let mut planes = Vec::new();
    if [Choice::Albedo, Choice::Normal, Choice::Depth].into_iter().any(wants) {
        let first = crate::render::layers(world, outcome.film.region(), seed, outcome.stats.passes);
        if wants(Choice::Albedo) {
            planes.extend(colors("albedo", &first.albedo));
        }
        if wants(Choice::Normal) {
            planes.extend(vectors("normal", &first.normal));
        }
        if wants(Choice::Depth) {
            planes.push(Plane { name: "depth.Z".to_owned(), samples: first.depth });
        }
    }
    let margin = wants(Choice::Margin).then(|| outcome.film.margin()).flatten();
    if let Some(margin) = margin {
        planes.extend(colors("margin", &margin));
    }
    if wants(Choice::Time) {
        planes.push(Plane { name: "time.s".to_owned(), samples: outcome.pixel_seconds() });
    }
    planes
}

/// What tells noise from a difference, where neighbours may share theirs: see `study::welch`. Nothing below two passes.
pub fn errors(film: &Film) -> Vec<Plane> {
    film.tile_errors().map_or(Vec::new(), |errors| {
        let errors: Vec<Rgb> = errors.into_iter().map(Rgb::from).collect();
        colors("tile_error", &errors).into()
    })
}

fn colors(layer: &str, pixels: &[Rgb]) -> [Plane; 3] {
    [("R", 0), ("G", 1), ("B", 2)].map(|(channel, index)| Plane {
        name: format!("{layer}.{channel}"),
        samples: pixels.iter().map(|pixel| pixel[index]).collect(),
    })
}

fn vectors(layer: &str, pixels: &[Vec3]) -> [Plane; 3] {
    [("X", 0), ("Y", 1), ("Z", 2)].map(|(channel, index)| Plane {
        name: format!("{layer}.{channel}"),
        samples: pixels.iter().map(|pixel| pixel[index]).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_word_counts() {
        use Choice::{Albedo, All, Depth, Margin, Normal, Time};
        assert_eq!(chosen(&[]), [Albedo, Normal, Depth]);
        assert_eq!(chosen(&[All]), [Albedo, Normal, Depth, Margin, Time]);
        assert_eq!(chosen(&[All, Choice::None]), []);
        assert_eq!(chosen(&[Choice::None, Depth]), [Depth]);
    }
}
