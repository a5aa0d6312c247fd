//! The body: element after element, from whichever encoding.

mod ascii;
mod binary;
mod fixed_rows;
mod items;
mod table;

use super::{
    header::Header,
    schema::{Element, Encoding},
};
use crate::{
    error::{Error, Result},
    load::Input,
};

pub(super) use fixed_rows::FixedRows;
pub(super) use items::Items;
pub(super) use table::Table;

/// A value of an element.
enum Field<'a> {
    One(f64),
    List(Items<'a>),
}

/// Why an element can't be read.
enum Fault {
    /// The file ends in it.
    Ends,
    /// In words.
    Is(String),
}

/// How many elements are read between two progress messages.
const PROGRESS_ELEMENTS: u64 = 1 << 16;

/// The bytes that are left to read. A copy reads the same again.
#[derive(Clone, Copy)]
pub(super) struct Body<'a> {
    input: &'a Input<'a>,
    encoding: Encoding,
    line_end: u8,
    rest: &'a [u8],
    /// The number of the last line read, from 1; in ascii files only.
    line: usize,
    /// Elements of ascii files with more values than the header declares.
    pub with_extra: u64,
}

impl<'a> Body<'a> {
    pub(super) fn new(input: &'a Input<'a>, header: &Header) -> Self {
        let rest = input.bytes.get(header.body_start..).unwrap_or_default();
        let Header { encoding, line_end, lines: line, .. } = *header;
        Self { input, encoding, line_end, rest, line, with_extra: 0 }
    }

    pub(super) fn is_ascii(&self) -> bool {
        self.encoding == Encoding::Ascii
    }

    /// The bytes that are left, but for blanks of text.
    pub(super) fn left(&self) -> u64 {
        let rest = if self.is_ascii() { self.rest.trim_ascii() } else { self.rest };
        rest.len() as u64
    }

    /// Refuses a count that the rest of the file can't hold, before anything is allocated for it.
    pub(super) fn check_size(&self, def: &Element) -> Result<()> {
        let each = def.min_bytes(self.encoding);
        // The last line of an ascii file may lack its end.
        let left = self.rest.len() as u64 + u64::from(self.is_ascii());
        if def.count.checked_mul(each).is_some_and(|needed| needed <= left) {
            return Ok(());
        }
        let problem = format!(
            "the header declares {} of at least {each} bytes each, the file has {} bytes left for them; expected as \
             many as it holds",
            def.count,
            self.rest.len()
        );
        Err(self.input.fault(format!("element {}", def.name), problem))
    }

    /// Reads all elements of this kind. `take` gets the values of the wanted properties, which are no lists, of some
    /// elements after the other.
    pub(super) fn tables(
        &mut self,
        def: &Element,
        wanted: &[usize],
        take: &mut dyn FnMut(&Table),
    ) -> Result<()> {
        self.check_size(def)?;
        if !self.is_ascii() && def.is_fixed() {
            return self.fixed_tables(def, wanted, take);
        }
        let mut column_of = vec![None; def.properties.len()];
        for (column, &property) in wanted.iter().enumerate() {
            if let Some(slot) = column_of.get_mut(property) {
                *slot = Some(column);
            }
        }
        let is_wanted: Vec<bool> = column_of.iter().map(Option::is_some).collect();
        let mut table = Table::new(wanted.len());
        for i in 0..def.count {
            let extra = self.element(def, i, &is_wanted, &mut |property, field| {
                let column = column_of.get(property).copied().flatten();
                if let (Some(column), Field::One(value)) = (column, field)
                    && let Some(column) = table.columns_mut().get_mut(column)
                {
                    column.push(value);
                }
            })?;
            if extra > 0 && !wanted.is_empty() {
                // Of values that are looked at, nobody knows which one is too many.
                let problem = format!("{} {i}: {extra} value(s) more than the header declares", def.name);
                return Err(self.input.fault(format!("line {}", self.line), problem));
            }
            if (i + 1) % Table::ROWS as u64 == 0 || i + 1 == def.count {
                take(&table);
                table.clear();
            }
        }
        Ok(())
    }

    /// All elements have the same number of bytes.
    fn fixed_tables(&mut self, def: &Element, wanted: &[usize], take: &mut dyn FnMut(&Table)) -> Result<()> {
        let fixed = FixedRows::new(def, wanted, self.encoding);
        let stride = fixed.stride();
        let bytes = usize::try_from(def.count).ok().and_then(|count| count.checked_mul(stride));
        let split = bytes.and_then(|bytes| self.rest.split_at_checked(bytes));
        let (rows, after) = split.ok_or_else(|| self.ends_early(def, 0))?;
        if stride > 0 && !wanted.is_empty() {
            let mut done = 0;
            fixed.tables(rows, &mut |table| {
                take(table);
                self.step((done * Table::ROWS) as u64, done * Table::ROWS * stride);
                done += 1;
            });
        }
        self.rest = after;
        Ok(())
    }

    /// Reads all elements of this kind. `take` gets the number of each and the items of one property, a list.
    pub(super) fn lists<'d>(
        &mut self,
        def: &'d Element,
        list: usize,
        take: &mut dyn FnMut(u64, Items<'d>) -> Result<()>,
    ) -> Result<()>
    where
        'a: 'd,
    {
        self.check_size(def)?;
        let is_wanted: Vec<bool> = (0..def.properties.len()).map(|i| i == list).collect();
        for i in 0..def.count {
            let mut found = None;
            let extra = self.element(def, i, &is_wanted, &mut |property, field| {
                if let (true, Field::List(items)) = (property == list, field) {
                    found = Some(items);
                }
            })?;
            self.with_extra += u64::from(extra > 0);
            if let Some(items) = found {
                take(i, items)?;
            }
        }
        Ok(())
    }

    /// Reads one element, and tells how many words its line has too many.
    fn element<'d>(
        &mut self,
        def: &'d Element,
        i: u64,
        is_wanted: &[bool],
        take: &mut dyn FnMut(usize, Field<'d>),
    ) -> Result<usize>
    where
        'a: 'd,
    {
        self.step(i, 0);
        if self.is_ascii() {
            let line = self.line(def, i)?;
            return ascii::element(line, def, is_wanted, take)
                .map_err(|problem| self.fault(format!("{} {i}: {problem}", def.name)));
        }
        match binary::element(self.rest, def, self.encoding, take) {
            Ok(after) => self.rest = after,
            Err(Fault::Ends) => return Err(self.ends_early(def, i)),
            Err(Fault::Is(problem)) => return Err(self.input.fault(format!("{} {i}", def.name), problem)),
        }
        Ok(0)
    }

    /// The next line that is not empty.
    fn line(&mut self, def: &Element, i: u64) -> Result<&'a [u8]> {
        let most = self.input.options.limits.line_bytes;
        while !self.rest.is_empty() {
            let window = self.rest.get(..=most).unwrap_or(self.rest);
            let end = window.iter().position(|&b| b == self.line_end).unwrap_or(window.len());
            self.line += 1;
            if end > most {
                return Err(self.fault(format!("longer than {most} bytes; expected at most that many")));
            }
            let (line, after) = self.rest.split_at_checked(end).unwrap_or((self.rest, &[]));
            self.rest = after.get(1..).unwrap_or_default();
            if !line.trim_ascii().is_empty() {
                return Ok(line);
            }
        }
        Err(self.ends_early(def, i))
    }

    fn fault(&self, problem: String) -> Error {
        self.input.fault(format!("line {}", self.line), problem)
    }

    fn ends_early(&self, def: &Element, i: u64) -> Error {
        let problem = format!("the file ends here; expected {}, as the header declares", def.count);
        self.input.fault(format!("{} {i}", def.name), problem)
    }

    /// Tells now and then how far the reader is: `ahead` bytes beyond what it has left behind.
    fn step(&self, element: u64, ahead: usize) {
        if element.is_multiple_of(PROGRESS_ELEMENTS) {
            self.input.step(self.input.bytes.len() - self.rest.len() + ahead);
        }
    }
}
