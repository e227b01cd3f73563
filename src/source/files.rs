//! Where files come from: a disk, or memory in tests, editors and previews.

use std::collections::BTreeMap;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Why a file that a scene names cannot be used.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Missing {
    /// There is none. `near` holds the most similar names beside it, the best first.
    NotFound {
        /// The paths that were tried.
        tried: Vec<PathBuf>,
        /// Similar names in the folders that were searched.
        near: Vec<String>,
    },
    /// It lies outside the scene's folder and the asset folders.
    Outside {
        /// Where the name points.
        path: PathBuf,
    },
}

/// The reader of everything a scene names.
pub trait Files: Send + Sync {
    /// The path of `name` as written in the file at `from`: beside that file first, then in the asset folders.
    ///
    /// # Errors
    /// [`Missing`] when there is no such file, or when it may not be read.
    fn locate(&self, from: &Path, name: &str) -> Result<PathBuf, Missing>;

    /// All bytes of the file at `path`.
    ///
    /// # Errors
    /// Whatever the system says.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;
}

/// The file system, seen from a scene: its folder and the asset folders, and nothing outside unless allowed.
#[derive(Clone)]
pub struct Disk {
    root: PathBuf,
    asset_dirs: Vec<PathBuf>,
    allow_outside: bool,
}

impl Disk {
    /// Files for the scene at `scene` (its folder is the root), with more folders for assets.
    pub fn new(scene: &Path, asset_dirs: Vec<PathBuf>, allow_outside: bool) -> Self {
        let root = scene.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        Self { root, asset_dirs, allow_outside }
    }

    fn inside(&self, path: &Path) -> bool {
        let real = |p: &Path| {
            let p = if p.as_os_str().is_empty() { Path::new(".") } else { p };
            p.canonicalize().unwrap_or_else(|_| normalise(p))
        };
        let path = real(path);
        std::iter::once(&self.root).chain(&self.asset_dirs).any(|dir| path.starts_with(real(dir)))
    }
}

impl Files for Disk {
    fn locate(&self, from: &Path, name: &str) -> Result<PathBuf, Missing> {
        let beside = from.parent().unwrap_or(Path::new("")).to_path_buf();
        let folders: Vec<PathBuf> = std::iter::once(beside).chain(self.asset_dirs.iter().cloned()).collect();
        let tried: Vec<PathBuf> = folders.iter().map(|folder| normalise(&folder.join(name))).collect();
        match tried.iter().find(|path| path.is_file()) {
            Some(path) if self.allow_outside || self.inside(path) => Ok(path.clone()),
            Some(path) => Err(Missing::Outside { path: path.clone() }),
            None => Err(Missing::NotFound { near: near_names(&tried), tried }),
        }
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        std::fs::read(path)
    }
}

/// Files that exist only in memory, by path.
#[derive(Default)]
pub struct Memory(pub BTreeMap<PathBuf, Vec<u8>>);

impl Memory {
    /// Adds a file and returns the collection, for chains.
    #[must_use]
    pub fn with(mut self, path: &str, bytes: impl Into<Vec<u8>>) -> Self {
        self.0.insert(PathBuf::from(path), bytes.into());
        self
    }
}

impl Files for Memory {
    fn locate(&self, from: &Path, name: &str) -> Result<PathBuf, Missing> {
        let path = normalise(&from.parent().unwrap_or(Path::new("")).join(name));
        if self.0.contains_key(&path) {
            return Ok(path);
        }
        let name_of = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let beside = self.0.keys().filter(|key| key.parent() == path.parent());
        let near = rank(beside.map(|key| name_of(key)), &name_of(&path));
        Err(Missing::NotFound { tried: vec![path], near })
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.0.get(path).cloned().ok_or_else(|| io::ErrorKind::NotFound.into())
    }
}

/// The path without `.` and, where a name precedes it, without `..`.
fn normalise(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(out.components().next_back(), Some(Component::Normal(_))) => {
                out.pop();
            }
            other => out.push(other),
        }
    }
    out
}

/// The names in the folders of `tried` that look most like the one asked for, at most three.
fn near_names(tried: &[PathBuf]) -> Vec<String> {
    let Some(wanted) = tried.first().and_then(|path| path.file_name()) else { return Vec::new() };
    let folders = tried.iter().filter_map(|path| path.parent());
    let names = folders.flat_map(|folder| {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        // A folder that cannot be listed has no names to offer; that it lacks the file is reported anyway.
        std::fs::read_dir(folder).into_iter().flatten().flatten()
    });
    rank(names.map(|entry| entry.file_name().to_string_lossy().into_owned()), &wanted.to_string_lossy())
}

/// The names most like `wanted`, at most three; likeness is that of the stem, as all scenes end alike.
fn rank(names: impl Iterator<Item = String>, wanted: &str) -> Vec<String> {
    let stem = Path::new(wanted).file_stem().map_or(0, |stem| stem.to_string_lossy().chars().count());
    let mut near: Vec<(usize, String)> = names
        .map(|name| (strsim::osa_distance(&name.to_lowercase(), &wanted.to_lowercase()), name))
        .filter(|(distance, name)| name != wanted && *distance <= stem.div_ceil(3))
        .collect();
    near.sort();
    near.dedup();
    near.into_iter().take(3).map(|(_, name)| name).collect()
}
