//! Room for splats that come later: chunks of an object in which there is nothing yet.

use glam::DVec3;

use super::{
    super::{
        chunk::{Chunk, Traits, part_of},
        pack::{Packed, inverse_overlap_in_upper_half, survey},
        pieces,
        rebase::Rebase,
        updatable::{RoomOf, Shadow, empties},
    },
    BATCH_SPLATS, Cut,
};
use crate::{
    error::Result,
    prepare::dynamic::MEAN_WEIGHT,
    scene::{Epsilon, Object, Opacity, Room},
};

/// How many disks lie over a place where nobody knows it: as many as where they are spread evenly, with radii of 1.4 times that of a circle with a disk's share of the surface.
const USUAL_OVERLAP: f64 = 2.0;

impl Cut<'_, '_> {
    /// Lets splats of an object, whose chunks are those from number `first` on, be taken out, and adds the room that it has.
    pub(super) fn room(
        &mut self,
        (number, object, epsilon): (usize, &Object, Option<Epsilon>),
        first: usize,
        room: Room,
    ) -> Result<()> {
        let splats = &object.splats;
        let own = splats.len() as u32;
        let of_object = &mut self.prepared.chunks[first..];
        of_object.iter_mut().for_each(|chunk| chunk.sparse = chunk.shadow.is_some());
        let known = of_object.iter().filter_map(|chunk| Some((chunk.shadow.as_ref()?, chunk.packing())));
        let [sum, count] = known.fold([0.0; 2], |[sum, count], (shadow, survey)| {
            [sum + shadow.sum_of_inverse_overlaps(&survey), count + f64::from(survey.count)]
        });
        let inverse_overlap = match room.overlap {
            None if count > 0.0 => sum / count,
            overlap => (overlap.unwrap_or(USUAL_OVERLAP) * MEAN_WEIGHT).recip(),
        };
        self.prepared.rooms.resize(number, None);
        self.prepared.rooms.push(Some(RoomOf { own, splats: room.splats }));

        let mut rebase = Rebase::of(splats, 0..splats.len());
        rebase.origin = room.around.unwrap_or(rebase.origin);
        for piece in pieces(0..room.splats as usize, part_of(self.capacity, false)) {
            let numbers: Vec<u32> = piece.clone().map(|place| own + place as u32).collect();
            let mut survey = survey(splats, std::iter::empty(), rebase);
            survey.count = piece.len() as u32;
            survey.uniform_color = false;
            survey.bounds = [DVec3::ZERO; 2];
            let transparent = splats.colors.opacity() != Opacity::Opaque;
            let traits = Traits { closed: object.closed, transparent, is_fixed: false };
            let at = self.prepared.chunks.len();
            let mut chunk = Chunk::new(self.uploader.as_ref(), at, traits, (&survey, None))?;
            let batches = pieces(piece, BATCH_SPLATS);
            let mut all = Packed::default();
            let batches = batches.map(|batch| {
                let packed = empties(batch.len(), &survey, inverse_overlap_in_upper_half(inverse_overlap));
                all.extend(&packed);
                packed
            });
            chunk.fill(self.uploader.as_mut(), batches, &survey, &mut |_| {})?;
            (chunk.object, chunk.epsilon) = (number, epsilon);
            chunk.is_sharp = !splats.clips.is_empty();
            (chunk.sparse, chunk.count) = (true, 0);
            chunk.numbers = self.numbered.then(|| numbers.clone());
            chunk.shadow = Some(Shadow::new(all, &numbers, &survey));
            self.prepared.chunks.push(chunk);
        }
        // What a change takes of memory is there from the first on.
        self.prepared.chunks[first..].iter_mut().for_each(Chunk::make_ready);
        Ok(())
    }
}
