//! How bad each mistake is, and so which of them end a conversion.

use super::mistake::Mistake;

/// How bad a mistake is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gravity {
    /// Nothing is left to convert.
    Fatal,
    /// It breaks the rules of the format; what belongs to it is mended or left out.
    Wrong,
    /// It is nothing that the converter knows; it is left out or guessed at.
    Unknown,
    /// A person should know of it.
    Doubt,
}

impl Mistake {
    /// How bad it is. In strict mode everything wrong or unknown is an error, otherwise only what is fatal.
    pub fn gravity(&self) -> Gravity {
        use Mistake::*;
        match self {
            TooLarge { .. } | TooDeep { .. } | Empty => Gravity::Fatal,
            UnclosedBrace { .. }
            | UnclosedBracket { .. }
            | StrayClose { .. }
            | MissingNumber { .. }
            | NotANumber { .. }
            | MissingValue { .. }
            | MissingField { .. }
            | BadValue { .. }
            | IndexOutOfRange { .. }
            | NoMaterial { .. }
            | EmptyTransform { .. }
            | CrowdedTransform { .. }
            | ProfileOffPlane { .. }
            | ProfileTooShort { .. } => Gravity::Wrong,
            UnknownField { .. }
            | UnknownBlock { .. }
            | StrayToken { .. }
            | LetterCase { .. }
            | Guessed { .. }
            | GuessedBlock { .. }
            | NotReadYet { .. } => Gravity::Unknown,
            IndexAtCount { .. }
            | NoCamera
            | SeveralScenes { .. }
            | More { .. }
            | CountMismatch { .. }
            | Repeated { .. }
            | Comment { .. }
            | NormalNotUnit { .. }
            | UpNotPerpendicular { .. }
            | DisputedAngle { .. }
            | LightsDropped { .. }
            | MissingAsset { .. }
            | AssetElsewhere { .. }
            | NotConvertible { .. }
            | Differs { .. } => Gravity::Doubt,
        }
    }
}
