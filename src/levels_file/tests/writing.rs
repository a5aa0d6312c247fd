//! Writing that fails, at whatever moment.

use std::io::{self, Seek, SeekFrom, Write};

use super::*;
use crate::{
    error::Error,
    geometry::{Overlaps, hierarchy::Hierarchy},
    levels_file::{
        header::Header,
        page::Form,
        part::{write_part, write_top},
        write::Writer,
    },
    save,
};

/// Fails at its write or seek number `left`, counted from 0, and at no other: who goes on after that shows.
struct Failing<W> {
    inner: W,
    left: i32,
}

impl<W> Failing<W> {
    fn count(&mut self) -> io::Result<()> {
        self.left -= 1;
        if self.left == -1 { Err(io::Error::other("no room left")) } else { Ok(()) }
    }
}

impl<W: Write> Write for Failing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.count()?;
        self.inner.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

impl<W: Seek> Seek for Failing<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.count()?;
        self.inner.seek(to)
    }
}

/// Writes an object to what fails after so many writes.
fn write(object: &Object, out: &mut (impl Write + Seek)) -> io::Result<Header> {
    let hierarchy = Hierarchy::build(&object.splats, &()).unwrap();
    let form = Form { ellipses: false, color: None, alpha: false, origin: hierarchy.origin };
    let bytes = written(object);
    let header = opened(&bytes).unwrap().header().clone();
    let mut writer = Writer::new(out, form)?;
    let overlaps = Overlaps::of(&object.splats);
    let root = write_part(&mut writer, (&object.splats, 1), &hierarchy, (&overlaps, overlaps.mean))?;
    write_top(&mut writer, &[], &[(root, None)], None)?;
    writer.finish(header)
}

#[test]
fn a_write_that_fails_leaves_nothing_at_its_place_and_nothing_that_opens() {
    let object = relief(9000);
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.surfel");
    let mut needed = None;
    for left in 0..100 {
        // What there is of it when the process ends at that moment.
        let mut half = Cursor::new(Vec::new());
        let done = write(&object, &mut Failing { inner: &mut half, left }).is_ok();
        assert_eq!(opened(half.get_ref()).is_ok(), done, "after {left} writes");
        let created = save::create(&path, |file| {
            write(&object, &mut Failing { inner: file, left }).map_err(|e| Error::file(&path, "write", e))
        });
        assert_eq!((created.is_ok(), path.exists()), (done, done), "after {left} writes");
        if done {
            needed = Some(left);
            break;
        }
        assert!(created.unwrap_err().to_string().ends_with("cannot write: no room left"));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "after {left} writes");
    }
    // The zeros, three pages at least, the table, a seek and the header.
    assert!(needed.is_some_and(|writes| writes >= 7), "{needed:?}");
    assert_eq!(fs::read(&path).unwrap(), written(&object));
}

#[test]
fn what_can_not_be_written_is_refused_before() {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.surfel");
    let mut object = relief(100);
    object.splats.colors.tint(None, 0.0);
    let mut none = relief(1);
    none.splats.keep(&[false]);
    for (object, problem) in [(object, "all of them are invisible"), (none, "none that can be drawn")] {
        let error = write_object(&path, &object, None, &()).unwrap_err().to_string();
        assert!(error.contains(problem) && !path.exists(), "{error}");
    }
}
