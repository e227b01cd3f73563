//! Where the files are that a scene names.
//!
//! The original programs look from their working directory, which is usually the folder above the scenes. So a file is
//! looked for beside the scene, then in every folder above it, then in the folders the user gave, and at last by its
//! bare name below the project.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Looks for the files that a scene names; the converter opens none itself.
pub trait AssetFinder {
    /// Looks for `path`, which is written as in the scene, with slashes.
    fn find(&self, path: &str) -> Search;
}

/// What came of looking for a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Search {
    /// It is where it should be.
    Found {
        /// The folder it was found from, seen from the scene's folder: `.`, `..`, ..
        root: String,
        /// Its first bytes, enough for a picture's header.
        head: Vec<u8>,
    },
    /// One file of this name lies elsewhere.
    Elsewhere {
        /// Where, as seen from the scene's folder.
        path: String,
        /// Its first bytes.
        head: Vec<u8>,
    },
    /// It is nowhere.
    Missing {
        /// The places looked at.
        tried: Vec<String>,
    },
}

/// How much of a file is read.
const HEAD: u64 = 512;

/// Looks for files on disk, from the folder of a scene.
#[derive(Clone, Debug)]
pub struct DiskFinder {
    scene_folder: PathBuf,
    asset_folders: Vec<PathBuf>,
    /// What the scene's own folder is called: `.`, unless the converted scene goes elsewhere.
    scene_root: String,
}

impl DiskFinder {
    /// `scene` is the file that is converted, `asset_folders` are further places to look.
    pub fn new(scene: &Path, asset_folders: Vec<PathBuf>) -> Self {
        let absolute = std::path::absolute(scene).unwrap_or_else(|_| scene.to_path_buf());
        let scene_folder = absolute.parent().map(Path::to_path_buf).unwrap_or_default();
        Self { scene_folder, asset_folders, scene_root: ".".into() }
    }

    /// The same for a converted scene at `output`: in another folder it finds nothing beside it.
    pub fn written_to(mut self, output: &Path) -> Self {
        let folder = std::path::absolute(output).ok().and_then(|path| path.parent().map(Path::to_path_buf));
        if folder.is_some_and(|folder| folder != self.scene_folder) {
            self.scene_root = self.scene_folder.display().to_string();
        }
        self
    }

    /// The folder of the scene and those above it, each with its name as seen from the scene.
    fn ancestors(&self) -> impl Iterator<Item = (String, PathBuf)> {
        self.scene_folder.ancestors().enumerate().map(|(up, folder)| {
            let name = match (up, self.scene_root.as_str()) {
                (0, root) => root.to_string(),
                (_, ".") => vec![".."; up].join("/"),
                _ => folder.display().to_string(),
            };
            (name, folder.to_path_buf())
        })
    }

    /// A path as seen from the scene's folder, if it lies there or in the folder above.
    fn seen_from_scene(&self, file: &Path) -> String {
        let above =
            || file.strip_prefix(self.scene_folder.parent()?).ok().map(|rest| Path::new("..").join(rest));
        let seen = file.strip_prefix(&self.scene_folder).ok().map(Path::to_path_buf).or_else(above);
        seen.unwrap_or_else(|| file.to_path_buf()).display().to_string().replace('\\', "/")
    }

    /// The only file with this bare name in or below the folder above the scene, if there is exactly one.
    fn by_bare_name(&self, path: &str) -> Option<PathBuf> {
        let name = Path::new(path).file_name()?;
        let project = self.scene_folder.parent().unwrap_or(&self.scene_folder);
        let mut files = Vec::new();
        let mut entries_left = 10_000;
        let mut folders = vec![(project.to_path_buf(), 0)];
        while let Some((folder, depth)) = folders.pop() {
            for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
                entries_left -= 1;
                if entries_left == 0 {
                    return None; // too much to look through for a guess
                }
                let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
                if is_folder && depth < 4 {
                    folders.push((entry.path(), depth + 1));
                } else if !is_folder && entry.file_name() == name {
                    files.push(entry.path());
                }
            }
        }
        (files.len() == 1).then(|| files.remove(0))
    }
}

impl AssetFinder for DiskFinder {
    fn find(&self, path: &str) -> Search {
        let given = self.asset_folders.iter().map(|folder| (folder.display().to_string(), folder.clone()));
        let mut tried = Vec::new();
        for (root, folder) in self.ancestors().chain(given) {
            if let Some(head) = head(&folder.join(path)) {
                return Search::Found { root, head };
            }
            tried.push(if root == "." { path.to_string() } else { format!("{root}/{path}") });
        }
        match self.by_bare_name(path) {
            Some(file) => {
                let head = head(&file).unwrap_or_default();
                Search::Elsewhere { path: self.seen_from_scene(&file), head }
            }
            None => Search::Missing { tried },
        }
    }
}

/// The first bytes of a file, or `None` if it is not there or cannot be read.
fn head(path: &Path) -> Option<Vec<u8>> {
    let file = File::open(path).ok()?;
    if !file.metadata().ok()?.is_file() {
        return None;
    }
    let mut bytes = Vec::new();
    file.take(HEAD).read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

/// Width and height from the header of a PPM or PGM picture: two numbers after the magic one, comments skipped.
pub fn picture_size(head: &[u8]) -> Option<(u32, u32)> {
    let text = String::from_utf8_lossy(head);
    let mut words = text.lines().flat_map(|line| line.split('#').next().unwrap_or("").split_whitespace());
    let magic = words.next()?;
    let (width, height) = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
    (["P2", "P3", "P5", "P6"].contains(&magic) && width > 0 && height > 0).then_some((width, height))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ppm_header_tells_its_size_past_comments() {
        assert_eq!(picture_size(b"P6\n# by hand\n1280 891\n255\n\x98\xb6"), Some((1280, 891)));
        assert_eq!(picture_size(b"P6 0 3 255 "), None);
        assert_eq!(picture_size(b"\x89PNG\r\n"), None);
    }

    #[test]
    fn a_file_is_found_above_its_scene_and_by_its_bare_name() {
        let project = tempfile::tempdir().expect("a folder for the test");
        for folder in ["scenes", "mesh", "other"] {
            std::fs::create_dir(project.path().join(folder)).expect("a folder");
        }
        std::fs::write(project.path().join("mesh/a.obj"), "v 0 0 0").expect("a file");
        std::fs::write(project.path().join("other/b.obj"), "v 0 0 0").expect("a file");
        let finder = DiskFinder::new(&project.path().join("scenes/s.txt"), Vec::new());
        let head = b"v 0 0 0".to_vec();
        assert_eq!(finder.find("mesh/a.obj"), Search::Found { root: "..".into(), head });
        assert!(
            matches!(finder.find("mesh/b.obj"), Search::Elsewhere { path, .. } if path == "../other/b.obj")
        );
        assert!(matches!(finder.find("mesh/c.obj"), Search::Missing { tried } if tried.len() >= 2));
    }
}
