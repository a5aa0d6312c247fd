//! A binary file of splats, read row by row: for what is larger than memory.

use std::{
    fs::{self, File},
    io::{Read as _, Seek as _, SeekFrom},
    path::{Path, PathBuf},
};

use glam::DVec3;

use super::{
    body::{FixedRows, Table},
    faces::corners,
    header::{self, Header},
    layout::Layout,
    schema::Encoding,
    splats_or_points, vertex_element,
    vertices::Vertices,
};
use crate::{
    error::{Error, Result},
    load::{Input, LoadOptions, Model, ply::Read},
    scene::Splats,
};

/// A binary PLY file, each row of which is a splat by itself: nothing of it depends on others, as the white of colors in floating point of
/// other programs does.
pub struct SplatRows {
    path: PathBuf,
    file: File,
    layout: Layout,
    rows: FixedRows,
    /// The first byte of the first row.
    start: u64,
    count: u64,
    closed: bool,
    up: Option<DVec3>,
}

impl SplatRows {
    /// Opens a file; `None` of what is no such file, and may be another that [`crate::load::load`] reads.
    ///
    /// # Errors
    /// [`crate::ErrorKind::File`] if it can't be read; [`crate::ErrorKind::Input`] for more rows than it has bytes.
    pub fn open(path: &Path, options: &LoadOptions) -> Result<Option<Self>> {
        let fail = |e| Error::file(path, "read", e);
        let metadata = fs::metadata(path).map_err(fail)?;
        if !metadata.is_file() {
            return Ok(None);
        }
        let mut file = File::open(path).map_err(fail)?;
        let mut head = Vec::new();
        (&mut file).take(options.limits.header_bytes as u64).read_to_end(&mut head).map_err(fail)?;
        let is_ply = head.starts_with(b"ply\n") || head.starts_with(b"ply\r");
        let input = Input { path, folder: None, bytes: &head, options, progress: &() };
        // What is wrong with a header is told by who reads it as any model.
        let Some(header) = is_ply.then(|| header::parse(&input).ok()).flatten() else { return Ok(None) };
        let Some((layout, rows, count)) = fixed(&input, &header) else { return Ok(None) };
        let start = header.body_start as u64;
        let bytes = count.checked_mul(rows.stride() as u64).and_then(|bytes| bytes.checked_add(start));
        if bytes.is_none_or(|bytes| bytes > metadata.len()) {
            let problem =
                format!("{count} rows of {} bytes; expected no more than the file holds", rows.stride());
            return Err(Error::input(path, "element vertex", problem));
        }
        let Header { closed, up, .. } = header;
        Ok(Some(Self { path: path.to_owned(), file, layout, rows, start, count, closed, up }))
    }

    /// How many rows there are.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Bytes of a row.
    pub fn stride(&self) -> usize {
        self.rows.stride()
    }

    /// As [`crate::scene::Object::closed`].
    pub fn closed(&self) -> bool {
        self.closed
    }

    /// The direction that is up, where the file tells it.
    pub fn up(&self) -> Option<DVec3> {
        self.up
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Puts the rows from number `first` on into `bytes`: so many, or as many as there are.
    ///
    /// # Errors
    /// [`crate::ErrorKind::File`].
    pub fn read(&mut self, first: u64, count: usize, bytes: &mut Vec<u8>) -> Result<()> {
        let count = self.count.saturating_sub(first).min(count as u64);
        let (at, size) = (first * self.stride() as u64, count as usize * self.stride());
        bytes.resize(size, 0);
        let read = self.file.seek(SeekFrom::Start(self.start + at)).and_then(|_| self.file.read_exact(bytes));
        read.map_err(|e| Error::file(&self.path, "read", e))
    }

    /// The splats in these rows; those with a [`crate::scene::Defect`], too.
    pub fn splats(&self, bytes: &[u8]) -> Splats {
        let mut vertices = Vertices::new(&self.layout, bytes.len() / self.stride());
        self.rows.tables(bytes, &mut |table: &Table| vertices.extend(&self.layout, table));
        let read = Read {
            vertices,
            triangles: Vec::new(),
            fans: Vec::new(),
            small_polygons: 0,
            viewpoint: None,
            with_extra: 0,
            behind: 0,
        };
        match splats_or_points(read, false, String::new()).0.model {
            Model::Splats { splats, .. } => splats,
            // Its layout has all that makes splats.
            _ => Splats::none(),
        }
    }
}

/// What the rows of a file have, and how many there are; `None` where they are not splats by themselves.
fn fixed(input: &Input<'_>, header: &Header) -> Option<(Layout, FixedRows, u64)> {
    let def = vertex_element(header)?;
    // What stands before the rows moves them.
    let is_first = header.elements.first().is_some_and(|first| std::ptr::eq(first, def));
    let has_faces = header.elements.iter().any(|def| !matches!(corners(input, def), Ok(None)));
    if header.encoding == Encoding::Ascii || !is_first || has_faces || !def.is_fixed() || def.count == 0 {
        return None;
    }
    let mut layout = Layout::of(def, false).ok()?;
    layout.exact_colors = header.own;
    let is_splat = layout.tangents.is_some() || layout.normal.is_some() && layout.radius.is_some();
    let stands_alone = Vertices::new(&layout, 0).colors.is_none_or(|colors| colors.stand_alone());
    let usable = is_splat && stands_alone && layout.gaussian.is_none() && layout.clips.is_none();
    let rows = FixedRows::new(def, &layout.wanted, header.encoding);
    usable.then_some((layout, rows, def.count))
}
