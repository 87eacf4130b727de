//! Reading files up to a limit, and writing files whole or not at all.

use std::{
    borrow::Cow,
    fs::{self, File},
    io::{self, Read, Write},
    path::{Path, PathBuf},
    time::Duration,
};
use tempfile::Builder;

/// The bytes of a file.
///
/// # Errors
///
/// If the file cannot be read, has more than `limit` bytes, or is a folder, a pipe or a device, which may have no end.
pub fn read_limited(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let too_long = || io::Error::other(format!("it has more than {} MB, the most that is read", limit >> 20));
    let file = open(path)?;
    if file.metadata()?.len() > limit {
        return Err(too_long());
    }
    let mut bytes = Vec::new();
    // A file may grow, and some files of the system state a size of 0.
    file.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(too_long()) } else { Ok(bytes) }
}

/// A file to be read.
///
/// # Errors
///
/// If the file cannot be opened, or is a folder, a pipe or a device, which may have no end.
pub fn open(path: &Path) -> io::Result<File> {
    // Before the file is opened: opening a pipe waits for its other end.
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() {
        let kind = if metadata.is_dir() { "a folder" } else { "a pipe or a device" };
        return Err(io::Error::other(format!("it is {kind}, expected a file")));
    }
    File::open(path)
}

/// The text of a file in UTF-8.
///
/// # Errors
///
/// As [`read_limited`], and if the bytes are no UTF-8 text.
pub fn read_text_limited(path: &Path, limit: u64) -> io::Result<String> {
    String::from_utf8(read_limited(path, limit)?).map_err(|e| io::Error::other(e.utf8_error()))
}

/// A text that fits some lines of a terminal: the beginning and the end of a longer one. A file may have millions of letters where a
/// message quotes it.
pub fn shortened(text: &str) -> Cow<'_, str> {
    /// Bytes of each end.
    const END: usize = 300;
    if text.len() <= 2 * END {
        return Cow::Borrowed(text);
    }
    let (start, end) = (text.floor_char_boundary(END), text.ceil_char_boundary(text.len() - END));
    Cow::Owned(format!("{} ... {}", &text[..start], &text[end..]))
}

/// How the names of temporary files begin and end, with letters and digits between.
const TEMPORARY: [&str; 2] = [".patchlight-", ".tmp"];
/// Age of a temporary file at which the process that made it surely holds its lock.
const TIME_TO_LOCK: Duration = Duration::from_secs(1);

/// Writes `bytes` to the file at `path`, whole or not at all: to a temporary file beside it, which is then renamed. Writes
/// directly to pipes and devices.
///
/// # Errors
///
/// If the file cannot be written; the previous file is then unchanged.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = link_target(path);
    let before = fs::metadata(&target).ok();
    if before.as_ref().is_some_and(|m| !m.is_file() && !m.is_dir()) {
        return fs::write(&target, bytes);
    }
    let folder = folder(&target);
    remove_left_over(&folder);
    // With a creator of our own, because the default one puts the temporary name into errors.
    let [prefix, suffix] = TEMPORARY;
    let temporary = Builder::new().prefix(prefix).suffix(suffix).make_in(folder, |path| File::create_new(path))?;
    // Where the file system has no locks, other processes cannot take the lock either and leave the file alone.
    temporary.as_file().try_lock().ok();
    temporary.as_file().write_all(bytes)?;
    if let Some(before) = before.filter(fs::Metadata::is_file) {
        temporary.as_file().set_permissions(before.permissions())?;
    }
    temporary.as_file().sync_all()?;
    temporary.persist(&target).map_err(|e| e.error)?;
    Ok(())
}

/// The file that writing to a path changes: the one that symbolic links lead to, whether it exists or not.
pub fn link_target(path: &Path) -> PathBuf {
    // As many links in a row as Linux follows.
    const MOST_LINKS: usize = 40;
    let next = |path: &PathBuf| fs::read_link(path).ok().map(|link| folder(path).join(link));
    std::iter::successors(Some(path.to_owned()), next).take(MOST_LINKS).last().unwrap_or_else(|| path.to_owned())
}

/// Removes the temporary files that processes left in a folder when they were killed. A process that still writes holds the lock of its
/// file.
fn remove_left_over(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten().filter(is_temporary) {
        let age = entry.metadata().and_then(|m| m.modified()).ok().and_then(|at| at.elapsed().ok());
        let is_old = age.is_some_and(|age| age > TIME_TO_LOCK);
        if is_old && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok()) {
            // What cannot be removed stays.
            fs::remove_file(entry.path()).ok();
        }
    }
}

/// Whether a file has the name of a temporary one. Links and pipes are none, and would lead elsewhere or wait for ever.
fn is_temporary(entry: &fs::DirEntry) -> bool {
    let (name, [prefix, suffix]) = (entry.file_name(), TEMPORARY);
    let random = name.to_str().and_then(|name| name.strip_prefix(prefix)?.strip_suffix(suffix));
    random.is_some_and(|random| !random.is_empty() && random.chars().all(|c| c.is_ascii_alphanumeric()))
        && entry.file_type().is_ok_and(|kind| kind.is_file())
}

/// The folder of the file at `path`.
pub fn folder(path: &Path) -> PathBuf {
    path.parent().filter(|p| !p.as_os_str().is_empty()).map_or_else(|| PathBuf::from("."), Path::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_or_leaves_alone() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        write_whole(&path, b"one").unwrap();
        write_whole(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        let folder_in_the_way = dir.path().join("folder");
        fs::create_dir(&folder_in_the_way).unwrap();
        write_whole(&folder_in_the_way, b"three").unwrap_err();
        write_whole(&dir.path().join("no such folder/b.txt"), b"four").unwrap_err();
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 2, "nothing is left behind");
    }

    #[test]
    fn files_of_killed_processes_are_removed() {
        let dir = tempfile::tempdir().unwrap();
        let make = |name: &str, age: u64| {
            let path = dir.path().join(name);
            let file = File::create(&path).unwrap();
            file.set_modified(std::time::SystemTime::now() - Duration::from_secs(age)).unwrap();
            (path, file)
        };
        let (left_over, _) = make(".patchlight-dead.tmp", 9);
        let (in_use, holder) = make(".patchlight-alive.tmp", 9);
        holder.lock().unwrap();
        let (new, _) = make(".patchlight-new.tmp", 0);
        let others = ["patchlight-a.tmp", ".patchlight-mine.toml", ".patchlight-my notes.tmp", ".patchlight-.tmp"];
        let others = others.map(|name| make(name, 9).0);
        let folder = dir.path().join(".patchlight-folder.tmp");
        fs::create_dir(&folder).unwrap();
        write_whole(&dir.path().join("a"), b"a").unwrap();
        assert!(!left_over.exists() && in_use.exists() && new.exists() && folder.exists());
        assert!(others.iter().all(|other| other.exists()), "files of the user stay");
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_or_a_link_with_the_name_of_a_temporary_file_is_left_alone() {
        let dir = tempfile::tempdir().unwrap();
        let (pipe, link) = (dir.path().join(".patchlight-pipe.tmp"), dir.path().join(".patchlight-link.tmp"));
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        std::os::unix::fs::symlink("a", &link).unwrap();
        std::thread::sleep(TIME_TO_LOCK + Duration::from_millis(50));
        write_whole(&dir.path().join("a"), b"a").unwrap();
        assert!(pipe.exists() && fs::symlink_metadata(&link).is_ok());
    }

    #[test]
    fn errors_do_not_name_the_temporary_file() {
        let dir = tempfile::tempdir().unwrap();
        let error = write_whole(&dir.path().join("no such folder/b.txt"), b"four").unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert!(!error.to_string().contains(".patchlight"), "{error}");
        assert!(error.to_string().contains("No such file"), "{error}");
    }

    #[test]
    fn only_files_within_the_limit_are_read() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        fs::write(&path, vec![1; 2 << 20]).unwrap();
        assert_eq!(read_limited(&path, 2 << 20).unwrap().len(), 2 << 20);
        let refused = |path: &Path| read_limited(path, (2 << 20) - 1).unwrap_err().to_string();
        assert_eq!(refused(&path), "it has more than 1 MB, the most that is read");
        assert_eq!(refused(dir.path()), "it is a folder, expected a file");
        #[cfg(unix)]
        for device in ["/dev/zero", "/dev/null"] {
            assert_eq!(refused(Path::new(device)), "it is a pipe or a device, expected a file");
        }
        fs::write(&path, b"\xff").unwrap();
        assert!(read_text_limited(&path, 9).unwrap_err().to_string().contains("utf-8"));
    }

    #[cfg(unix)]
    #[test]
    fn keeps_links_permissions_and_devices() {
        use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
        let dir = tempfile::tempdir().unwrap();
        let (path, link) = (dir.path().join("a"), dir.path().join("link"));
        fs::write(&path, b"old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&path, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        let (dangling, missing) = (dir.path().join("dangling"), dir.path().join("missing"));
        symlink("missing", &dangling).unwrap();
        write_whole(&dangling, b"there").unwrap();
        assert!(fs::symlink_metadata(&dangling).unwrap().is_symlink());
        assert_eq!(fs::read(&missing).unwrap(), b"there");
        write_whole(Path::new("/dev/null"), b"gone").unwrap();
        assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    }
}
