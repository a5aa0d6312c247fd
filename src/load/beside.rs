//! Files that another file names: in its folder or below, links followed, or anywhere if the user allows that.
//!
//! A file from elsewhere can't make the program read what its sender may not see, nor tell whether it is there.

use std::{
    fs, io,
    path::{Component, Path, PathBuf},
};

/// Why a file is not opened.
#[derive(Debug)]
pub(super) enum Refusal {
    /// The name begins at the root, and names may not.
    Rooted,
    /// It lies outside of the folder, or would.
    Outside,
    /// Nothing of that name can be found.
    Missing(PathBuf, io::Error),
}

/// The one path, without links, of the file that a file in `folder` calls `name`.
pub(super) fn find(folder: &Path, name: &str, allow_outside: bool) -> Result<PathBuf, Refusal> {
    let one_name = |path: PathBuf| fs::canonicalize(&path).map_err(|e| Refusal::Missing(path, e));
    let path = folder.join(name);
    if allow_outside {
        return one_name(path);
    }
    let name = Path::new(name);
    if name.is_absolute() || name.has_root() {
        return Err(Refusal::Rooted);
    }
    let folder = one_name(folder.to_owned())?;
    let goes_up = name.components().any(|part| part == Component::ParentDir);
    match one_name(path) {
        Ok(path) if path.starts_with(&folder) => Ok(path),
        // Whether there is a file elsewhere is nobody's business.
        Err(missing) if !goes_up => Err(missing),
        _ => Err(Refusal::Outside),
    }
}

#[cfg(test)]
mod tests {
    use temp_dir::TempDir;

    use super::*;

    #[test]
    fn only_files_in_the_folder_and_below_are_found_unless_others_may_be() {
        let outer = TempDir::new().unwrap();
        let root = outer.path().canonicalize().unwrap();
        let folder = root.join("in");
        fs::create_dir_all(folder.join("below")).unwrap();
        // Its name begins like the folder's, and it is no part of it.
        fs::create_dir(root.join("in 2")).unwrap();
        for file in ["in/a", "in/below/b", "c", "in 2/d"] {
            fs::write(root.join(file), "").unwrap();
        }
        let found = |name: &str, allow_outside| match find(&folder, name, allow_outside) {
            Ok(path) => path.strip_prefix(&root).unwrap().display().to_string(),
            Err(Refusal::Rooted) => "rooted".to_owned(),
            Err(Refusal::Outside) => "outside".to_owned(),
            Err(Refusal::Missing(path, _)) => format!("no {}", path.strip_prefix(&root).unwrap().display()),
        };
        let whole = folder.join("a").display().to_string();
        for (name, expected, anywhere) in [
            ("a", "in/a", "in/a"),
            ("below/b", "in/below/b", "in/below/b"),
            ("below/../a", "in/a", "in/a"),
            ("../in/a", "in/a", "in/a"),
            ("x", "no in/x", "no in/x"),
            ("../c", "outside", "c"),
            ("below/../../c", "outside", "c"),
            ("../in 2/d", "outside", "in 2/d"),
            ("../x", "outside", "no in/../x"),
            (&whole, "rooted", "in/a"),
        ] {
            assert_eq!(
                (found(name, false).as_str(), found(name, true).as_str()),
                (expected, anywhere),
                "{name}"
            );
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&root, folder.join("link")).unwrap();
            std::os::unix::fs::symlink(folder.join("a"), folder.join("inner")).unwrap();
            assert_eq!(
                (found("link/c", false), found("link/c", true)),
                ("outside".to_owned(), "c".to_owned())
            );
            assert_eq!(found("inner", false), "in/a");
        }
    }
}
