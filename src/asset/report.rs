//! What became of what a mesh file holds: used, approximated, ignored or left out, each in a sentence.

/// What became of something.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Fate {
    /// Taken as the file means it.
    Used,
    /// Brought to what comes near it.
    Approximated,
    /// Not taken, because it is no part of what is made of the file.
    Ignored,
    /// Not taken, because it is broken.
    LeftOut,
}

impl Fate {
    /// The word for it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Used => "used",
            Self::Approximated => "approximated",
            Self::Ignored => "ignored",
            Self::LeftOut => "left out",
        }
    }
}

/// What a remark is about, and so when it matters.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum About {
    /// Triangles.
    Shape,
    /// Materials, which matter where the scene gives the mesh none of its own.
    Material,
    /// The file as such: what it says of cameras, or what its name promises.
    File,
}

/// A sentence on what became of something.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Remark {
    /// What became of it.
    pub fate: Fate,
    /// What it is about.
    pub about: About,
    /// Whether the picture may differ from what the file means.
    pub matters: bool,
    /// In words, such as `morph targets`.
    pub text: String,
    /// How many of the same there are.
    pub count: usize,
}

impl Remark {
    /// With the number of the same.
    pub fn sentence(&self) -> String {
        if self.count > 1 { format!("{} ({} times)", self.text, self.count) } else { self.text.clone() }
    }
}

/// Everything that is to be said of a file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ImportReport {
    remarks: Vec<Remark>,
    /// How many more there are.
    untold: usize,
}

/// Files that are wrong in more ways than this are told of the first ones.
const MOST: usize = 1000;

impl ImportReport {
    /// The remarks, in the order in which they were made.
    pub fn remarks(&self) -> &[Remark] {
        &self.remarks
    }

    /// Adds a remark, or counts it if it was made before.
    fn add(&mut self, fate: Fate, about: About, matters: bool, text: String) {
        let same = |r: &Remark| (r.fate, r.about, r.text.as_str()) == (fate, about, text.as_str());
        match self.remarks.iter().position(same) {
            Some(known) => {
                self.remarks[known].count += 1;
                self.remarks[known].matters |= matters;
            }
            None if self.remarks.len() < MOST => {
                self.remarks.push(Remark { fate, about, matters, text, count: 1 });
            }
            None => self.untold += 1,
        }
    }

    /// Something was taken as the file means it.
    pub fn used(&mut self, about: About, text: impl Into<String>) {
        self.add(Fate::Used, about, false, text.into());
    }

    /// Something was brought to what comes near it, and the picture may show that.
    pub fn approximated(&mut self, about: About, text: impl Into<String>) {
        self.add(Fate::Approximated, about, true, text.into());
    }

    /// Something is not taken, and the picture may lack it.
    pub fn ignored(&mut self, about: About, text: impl Into<String>) {
        self.add(Fate::Ignored, about, true, text.into());
    }

    /// Something is not taken that would not change a still picture of the mesh.
    pub fn passed_over(&mut self, about: About, text: impl Into<String>) {
        self.add(Fate::Ignored, about, false, text.into());
    }

    /// Something is broken and left out.
    pub fn left_out(&mut self, about: About, text: impl Into<String>) {
        self.add(Fate::LeftOut, about, true, text.into());
    }

    /// The first thing that was left out of the shape, in a sentence.
    pub(super) fn lost_shape(&self) -> Option<String> {
        let is_lost = |r: &&Remark| r.about == About::Shape && r.fate == Fate::LeftOut;
        self.remarks.iter().find(is_lost).map(Remark::sentence)
    }

    /// How many remarks there are beyond those that are told.
    pub fn untold(&self) -> usize {
        self.untold
    }

    /// One line for each fate that there is, for those who ask for all of it.
    pub fn lines(&self) -> Vec<String> {
        let fates = [Fate::Used, Fate::Approximated, Fate::Ignored, Fate::LeftOut];
        let of = |fate: Fate| self.remarks.iter().filter(move |remark| remark.fate == fate);
        let line = |fate: Fate| {
            let said: Vec<String> = of(fate).map(Remark::sentence).collect();
            (!said.is_empty()).then(|| format!("{}: {}", fate.word(), said.join("; ")))
        };
        let more = (self.untold > 0).then(|| format!("and {} more remarks", self.untold));
        fates.into_iter().filter_map(line).chain(more).collect()
    }
}
