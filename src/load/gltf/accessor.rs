//! Numbers in the buffers of a glTF file.

use super::{
    buffers::{Buffers, Bytes},
    document::Document,
};
use crate::{error::Result, load::Input};

/// Elements of an accessor; all of them are within the buffer.
pub(super) struct Elements<'a> {
    bytes: Bytes<'a>,
    start: usize,
    stride: usize,
    /// How many there are.
    pub count: usize,
    /// Numbers of an element.
    pub width: usize,
    kind: Kind,
    normalized: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Kind {
    fn of(number: u32) -> Option<Self> {
        match number {
            5120 => Some(Self::I8),
            5121 => Some(Self::U8),
            5122 => Some(Self::I16),
            5123 => Some(Self::U16),
            5125 => Some(Self::U32),
            5126 => Some(Self::F32),
            _ => None,
        }
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    fn number(self, bytes: &[u8], normalized: bool) -> f64 {
        let mut wide = [0; 4];
        wide.iter_mut().zip(bytes.iter().take(self.size())).for_each(|(to, from)| *to = *from);
        let bits = u32::from_le_bytes(wide);
        let (value, largest) = match self {
            Self::I8 => (f64::from(bits as u8 as i8), 127.0),
            Self::U8 => (f64::from(bits), 255.0),
            Self::I16 => (f64::from(bits as u16 as i16), 32767.0),
            Self::U16 => (f64::from(bits), 65535.0),
            Self::U32 => (f64::from(bits), 4_294_967_295.0),
            Self::F32 => return f64::from(f32::from_bits(bits)),
        };
        if normalized { (value / largest).max(-1.0) } else { value }
    }
}

impl<'a> Elements<'a> {
    /// The elements of accessor `i`, of one of the `widths`, for `what`.
    pub fn new(
        input: &Input<'_>,
        document: &Document<'_>,
        buffers: &mut Buffers<'a>,
        i: u32,
        widths: &[usize],
        what: &str,
    ) -> Result<Self> {
        let fault = |problem: String| input.fault(format!("accessor {i}"), problem);
        let Some(accessor) = document.accessors.get(i as usize) else {
            return Err(fault(format!("not there; the file has {}", document.accessors.len())));
        };
        let width = match accessor.shape.as_ref() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 0,
        };
        let Some(kind) = Kind::of(accessor.component_type).filter(|_| widths.contains(&width)) else {
            return Err(fault(format!("numbers of another shape or kind than {what} have")));
        };
        let (Some(view), None) = (accessor.buffer_view, &accessor.sparse) else {
            return Err(fault("sparse or without a buffer view, which is not supported".to_owned()));
        };
        let Some(view) = document.buffer_views.get(view as usize) else {
            return Err(fault(format!(
                "of buffer view {view}; the file has {}",
                document.buffer_views.len()
            )));
        };
        let bytes = buffers.get(view.buffer)?;
        let size = (width * kind.size()) as u64;
        let stride = view.byte_stride.filter(|stride| *stride != 0).unwrap_or(size);
        // All in checked arithmetic: every number is the file's.
        let end = accessor
            .count
            .checked_sub(1)
            .and_then(|last| last.checked_mul(stride)?.checked_add(size)?.checked_add(accessor.byte_offset));
        let view_end = view.byte_offset.checked_add(view.byte_length);
        let fits = end.is_some_and(|end| end <= view.byte_length)
            && view_end.is_some_and(|end| end <= bytes.len() as u64)
            && stride >= size;
        if !fits {
            let (count, length) = (accessor.count, view.byte_length);
            return Err(fault(format!(
                "{count} elements of {size} bytes do not fit its buffer view of {length}"
            )));
        }
        Ok(Self {
            start: (view.byte_offset + accessor.byte_offset) as usize,
            stride: stride as usize,
            count: accessor.count as usize,
            normalized: accessor.normalized,
            bytes,
            width,
            kind,
        })
    }

    /// Whether these can be indices.
    pub fn is_unsigned(&self) -> bool {
        matches!(self.kind, Kind::U8 | Kind::U16 | Kind::U32)
    }

    /// Element `i`; numbers that it lacks, and all of one that is not there, are 1.
    pub fn get(&self, i: usize) -> [f64; 4] {
        let mut numbers = [1.0; 4];
        let element = self.bytes.get(self.start + i * self.stride..).unwrap_or_default();
        let parts = element.chunks_exact(self.kind.size()).take(self.width);
        for (number, bytes) in numbers.iter_mut().zip(parts) {
            *number = self.kind.number(bytes, self.normalized);
        }
        numbers
    }
}
