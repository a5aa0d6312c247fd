//! Pages one after the other, then the table, then the header: until that is there, nothing opens the file as one.

use std::io::{self, Seek, SeekFrom, Write};

use super::{
    bytes::Out,
    header::{HEADER_BYTES, Header},
    page::{Form, Page},
    table::PageEntry,
};

/// A file that is being written.
pub(super) struct Writer<W> {
    out: W,
    form: Form,
    /// Where the next page begins.
    at: u64,
    pages: Vec<PageEntry>,
}

impl<W: Write + Seek> Writer<W> {
    pub fn new(mut out: W, form: Form) -> io::Result<Self> {
        out.write_all(&[0; HEADER_BYTES])?;
        Ok(Self { out, form, at: HEADER_BYTES as u64, pages: Vec::new() })
    }

    pub fn page(&mut self, mut page: Page) -> io::Result<()> {
        let (bytes, entry) = page.encode(&self.form);
        self.out.write_all(&bytes)?;
        self.pages.push(PageEntry { at: self.at, ..entry });
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// How many splats are in pages of nodes, or in those of the object's own splats.
    pub fn count(&self, nodes: bool) -> u64 {
        self.pages.iter().filter(|page| page.nodes == nodes).map(|page| u64::from(page.count)).sum()
    }

    /// Writes what is left: the rest of `header`, and that. Gives what was written.
    pub fn finish(mut self, header: Header) -> io::Result<Header> {
        let mut table = Out::default();
        self.pages.iter().for_each(|page| page.encode(&mut table));
        self.out.write_all(&table.0)?;
        let header = Header {
            splats: self.count(false),
            nodes: self.count(true),
            pages: self.pages.len() as u32,
            table_at: self.at,
            table_crc: crc32fast::hash(&table.0),
            ..header
        };
        self.out.flush()?;
        self.out.seek(SeekFrom::Start(0))?;
        self.out.write_all(&header.encode())?;
        self.out.flush()?;
        Ok(header)
    }
}
