//! Changes that a host asks for: some splats become others, come behind the others, or are taken out.

use std::ops::Range;

use super::{
    super::PreparedScene,
    Changes, RoomOf,
    change::{Change, What},
};
use crate::{
    error::{Error, Result},
    scene::Splats,
    vk::{Copies, Device},
};

/// A change that was found and is to be made.
pub(crate) struct Update<'s> {
    scene: &'s mut PreparedScene,
    what: What<'s>,
    bytes: u64,
}

impl Update<'_> {
    /// Bytes that are copied to the device.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Makes it, with copies for the device where the scene is on one.
    pub fn apply(self, mut copies: Option<&mut Copies<'_>>) {
        let PreparedScene { chunks, changes, .. } = self.scene;
        let Changes { of_chunks, len, packed, radii } = changes;
        for change in &of_chunks[..*len] {
            let chunk = &mut chunks[change.chunk];
            chunk.apply((change, self.what), (&mut *packed, &mut *radii), copies.as_deref_mut());
        }
    }
}

impl PreparedScene {
    /// Finds what is to change where splats of an object, from this number on, become these.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::update`].
    pub(crate) fn update<'s>(
        &'s mut self,
        device: Option<&Device>,
        object: usize,
        first: u32,
        splats: &'s Splats,
    ) -> Result<Update<'s>> {
        splats.check_lengths().map_err(|problem| Error::option("update", problem))?;
        let (found, update) = self.change(device, object, first, What::Splats(splats))?;
        if found != splats.len() {
            let (has, of) = (found, splats.len());
            return Err(Error::option(
                "update",
                format!(
                    "object {object} has {has} of the {of} splats from {first} on: fewer are there, or were left out by the upload"
                ),
            ));
        }
        Ok(update)
    }

    /// Finds what is to change where splats of an object come behind the last of its room; with their numbers.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::append`].
    pub(crate) fn append<'s>(
        &'s mut self,
        device: Option<&Device>,
        object: usize,
        splats: &'s Splats,
    ) -> Result<(Update<'s>, Range<u32>)> {
        let room = self.room("append", object)?;
        let first = self.end_of(object, room);
        match u32::try_from(splats.len()) {
            Ok(count) if count <= room.end() - first => {
                Ok((self.update(device, object, first, splats)?, first..first + count))
            }
            _ => {
                let (more, end) = (splats.len(), room.end());
                let problem = format!(
                    "{more} splats behind number {first} of object {object}: it has room up to {end}"
                );
                Err(Error::option("append", problem))
            }
        }
    }

    /// Finds what is to change where splats of an object are taken out.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::remove`].
    pub(crate) fn remove(
        &mut self,
        device: Option<&Device>,
        object: usize,
        numbers: Range<u32>,
    ) -> Result<Update<'_>> {
        let end = self.room("remove", object)?.end();
        if numbers.start > numbers.end || numbers.end > end {
            let Range { start, end: last } = numbers;
            let problem =
                format!("{start}..{last} of object {object}: expected numbers in order up to {end}");
            return Err(Error::option("remove", problem));
        }
        let what = What::Nobody(numbers.end - numbers.start);
        Ok(self.change(device, object, numbers.start, what)?.1)
    }

    fn room(&self, call: &str, object: usize) -> Result<RoomOf> {
        let room = self.rooms.get(object).copied().flatten();
        room.ok_or_else(|| {
            let problem =
                format!("object {object} has no room: expected one that was uploaded with Scene::rooms");
            Error::option(call, problem)
        })
    }

    /// How many of these places an object has, and what is to change in them.
    fn change<'s>(
        &'s mut self,
        device: Option<&Device>,
        object: usize,
        first: u32,
        what: What<'s>,
    ) -> Result<(usize, Update<'s>)> {
        let refused = |problem: String| Err(Error::option(what.call(), problem));
        if device.is_some_and(|device| !self.is_on(device)) {
            return refused("the scene was prepared for another device".to_owned());
        }
        if object >= self.objects.len() {
            return refused(format!("object {object}: the scene has {}", self.objects.len()));
        }
        if u32::try_from(what.len()).ok().and_then(|count| first.checked_add(count)).is_none() {
            return refused(format!("{} splats from {first} on: expected numbers of 32 bits", what.len()));
        }
        let Self { chunks, changes: Changes { of_chunks, len, .. }, .. } = self;
        *len = 0;
        let (mut found, mut bytes) = (0, 0);
        for (number, chunk) in chunks.iter().enumerate().filter(|(_, chunk)| chunk.object == object) {
            if *len == of_chunks.len() {
                of_chunks.push(Change::default());
            }
            let change = &mut of_chunks[*len];
            if chunk.change(first, what, change)? {
                change.chunk = number;
                found += change.splats.len();
                bytes += chunk.bytes_of(change, what);
                *len += 1;
            }
        }
        Ok((found, Update { scene: self, what, bytes }))
    }
}
