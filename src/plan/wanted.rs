//! What a command says about effects: `auto`, `all`, `+NAME`, `-NAME`.

use super::effect::Effect;
use super::{EffectUse, Plan};
use crate::diag::did_you_mean;

/// One word of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// Those that the scene calls for.
    Auto,
    /// Every one, so that nothing is saved.
    All,
    /// One more, though nothing may call for it.
    With(Effect),
    /// One less, though something may call for it.
    Without(Effect),
}

impl Wanted {
    /// Reads one word.
    ///
    /// # Errors
    /// What to write instead, in a sentence.
    pub fn parse(text: &str) -> Result<Self, String> {
        let of = |name: &str| Effect::of_name(name).ok_or_else(|| unknown(name));
        match text.split_at_checked(1) {
            Some(("+", name)) => of(name).map(Self::With),
            Some(("-", name)) => match of(name)? {
                effect if effect.without().is_some() => Ok(Self::Without(effect)),
                effect => Err(format!(
                    "`{}` cannot be left out: it is what things are; those that can are {}",
                    effect.name(),
                    names(|effect| effect.without().is_some())
                )),
            },
            _ if text == "auto" => Ok(Self::Auto),
            _ if text == "all" => Ok(Self::All),
            _ => Err(match Effect::of_name(text) {
                Some(_) => format!("write `+{text}` to force it on, `-{text}` to leave it out"),
                None => did_you_mean(text, ["auto", "all"]).unwrap_or_else(|| unknown(text)),
            }),
        }
    }
}

fn unknown(name: &str) -> String {
    did_you_mean(name, Effect::ALL.map(Effect::name))
        .unwrap_or_else(|| format!("write `auto`, `all`, or + or - and one of {}", names(|_| true)))
}

fn names(keep: impl Fn(Effect) -> bool) -> String {
    let names: Vec<&str> = Effect::ALL.into_iter().filter(|e| keep(*e)).map(Effect::name).collect();
    names.join(", ")
}

impl Plan {
    /// Simulates what is wanted, word by word. What the scene calls for and is left out all the same comes back.
    pub fn want(&mut self, wanted: &[Wanted]) -> Vec<EffectUse> {
        for &word in wanted {
            match word {
                Wanted::Auto => self.simulated = self.in_doubt.clone(),
                Wanted::All => self.simulated = Effect::ALL.to_vec(),
                Wanted::With(effect) if self.simulates(effect) => {}
                Wanted::With(effect) => self.simulated.push(effect),
                Wanted::Without(effect) => self.simulated.retain(|other| *other != effect),
            }
        }
        self.effects.iter().filter(|used| !self.simulates(used.effect)).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_are_named_with_a_sign() {
        assert_eq!(Wanted::parse("auto"), Ok(Wanted::Auto));
        assert_eq!(Wanted::parse("+lens_blur"), Ok(Wanted::With(Effect::LensBlur)));
        assert_eq!(Wanted::parse("-caustics"), Ok(Wanted::Without(Effect::Caustics)));
        assert_eq!(Wanted::parse("-caustic"), Err("did you mean `caustics`?".to_owned()));
        assert!(Wanted::parse("caustics").is_err_and(|why| why.contains("`-caustics`")));
        assert!(Wanted::parse("-specular").is_err_and(|why| why.contains("lens_blur, ")));
        assert!(Wanted::parse("").is_err() && Wanted::parse("+").is_err() && Wanted::parse("é").is_err());
    }
}
