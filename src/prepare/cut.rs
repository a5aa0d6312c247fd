//! A scene cut into chunks: each object into pieces that a buffer holds, each piece into sites, which have an origin of their own.

mod levels;
mod meshes;
mod rooms;

use std::ops::Range;

use super::{
    PreparedScene,
    chunk::{self, Chunk, Traits},
    level_words::LevelWords,
    levels::{ChunkLevels, LevelPart, Leveled},
    memory::{To, Uploader},
    near_surfaces::{self, sharp::Sharp},
    pack::{self, Packed},
    part::{Numbers, Part},
    pieces,
    sequence::Sequence,
    sites::{Site, sites},
    updatable::{self, Shadow},
};
use crate::{
    error::Result,
    geometry::{Overlaps, at_border},
    scene::{Bounds, Clip, DefectCounts, Epsilon, Object, Opacity, Order, Room, Scene, Shapes, SplatFormat},
    vk::Limits,
};

/// How many splats are packed and uploaded at once: 72 bytes each at most, 4.7 MB, so that neither the host nor the device holds a
/// second copy of a scene on its way.
const BATCH_SPLATS: usize = 1 << 16;

/// The box around a scene that stays as it is. What came with its levels of detail has none.
fn bounds_of(scene: &Scene) -> Option<Bounds> {
    let changes = scene.updatable || scene.rooms.iter().any(Option::is_some);
    scene.bounds().filter(|_| !changes && scene.leveled.is_empty())
}

/// Cuts a scene; uploads it, or tells what that would take, where there is an uploader.
///
/// # Errors
/// Whatever the uploader answers.
pub(super) fn cut(
    uploader: Option<Uploader<'_>>,
    limits: &Limits,
    scene: &Scene,
    progress: &dyn Fn(u64, u64),
) -> Result<PreparedScene> {
    scene.check_lengths()?;
    scene.check_lights()?;
    scene.check_epsilons()?;
    scene.check_rooms()?;
    updatable::check(scene)?;
    let of_splats = scene.objects.iter().map(|object| object.name.as_str());
    let leveled = scene.leveled.iter().map(|object| object.name.as_str());
    let names = of_splats.chain(leveled).chain(scene.meshes.iter().map(|object| object.name.as_str()));
    let on = |uploader: &Uploader<'_>| matches!(uploader.to, To::Device(_)).then(|| uploader.device.clone());
    let device = uploader.as_ref().and_then(on);
    let mut cut = Cut {
        uploader,
        capacity: chunk::capacity(limits.max_storage_buffer_range),
        done: 0,
        total: scene.splat_count() as u64,
        progress,
        budget: scene.budget,
        numbered: scene.numbered,
        updatable: scene.updatable,
        transparent_splats: 0,
        transparent_radii: 0.0,
        beside_polygons: !scene.meshes.is_empty(),
        prepared: PreparedScene {
            objects: names.map(str::to_owned).collect(),
            chunks: Vec::new(),
            meshes: Vec::new(),
            device,
            lights: scene.lights.clone(),
            refinements: Vec::new(),
            storage: scene.storage,
            mean_transparent_radius: 0.0,
            defects: DefectCounts::default(),
            bounds: bounds_of(scene),
            changes: Default::default(),
            rooms: Vec::new(),
            upload: Default::default(),
        },
    };
    for (number, object) in scene.objects.iter().enumerate() {
        let epsilon = scene.own_epsilon(number);
        let auto = epsilon.map_or(!scene.without_auto_epsilon, |epsilon| epsilon == Epsilon::Auto);
        let leveled = if scene.levels { cut.leveled(object)? } else { None };
        match &leveled {
            None => {
                cut.object((number, object), epsilon, auto, scene.rooms.get(number).copied().flatten())?
            }
            Some((leveled, leaves)) => {
                cut.levels((number, leveled, None), (epsilon, auto), leaves.as_deref())?;
            }
        }
    }
    for (number, object) in (scene.objects.len()..).zip(&scene.leveled) {
        cut.total += (object.leaves.len() + object.nodes.len()) as u64;
        if object.opacity != Opacity::Invisible {
            cut.levels((number, object, None), (None, !scene.without_auto_epsilon), None)?;
        }
    }
    let first_of_meshes = scene.objects.len() + scene.leveled.len();
    for hybrid in &scene.hybrids {
        cut.total += (hybrid.splats.leaves.len() + hybrid.splats.nodes.len()) as u64;
        let number = first_of_meshes + hybrid.mesh;
        cut.levels((number, &hybrid.splats, Some(hybrid)), (None, !scene.without_auto_epsilon), None)?;
    }
    for (number, object) in scene.meshes.iter().enumerate() {
        let hybrid = scene.hybrids.iter().find(|hybrid| hybrid.mesh == number);
        cut.mesh((first_of_meshes + number, object), hybrid)?;
    }
    let Cut { mut prepared, transparent_splats, transparent_radii, .. } = cut;
    prepared.mean_transparent_radius = transparent_radii / f64::from(transparent_splats.max(1));
    Ok(prepared)
}

/// What is done so far.
struct Cut<'u, 'a> {
    uploader: Option<Uploader<'u>>,
    /// Splats of a chunk.
    capacity: usize,
    done: u64,
    total: u64,
    progress: &'a dyn Fn(u64, u64),
    budget: bool,
    numbered: bool,
    updatable: bool,
    transparent_splats: u32,
    transparent_radii: f64,
    /// The scene has polygons, too.
    beside_polygons: bool,
    prepared: PreparedScene,
}

impl Cut<'_, '_> {
    fn step(&mut self, count: usize) {
        self.done += count as u64;
        (self.progress)(self.done, self.total);
    }

    /// `auto`: ε is to fit what is near each splat.
    fn object(
        &mut self,
        (number, object): (usize, &Object),
        epsilon: Option<Epsilon>,
        auto: bool,
        room: Option<Room>,
    ) -> Result<()> {
        let splats = &object.splats;
        let opacity = splats.colors.opacity();
        if opacity == Opacity::Invisible && room.is_none() {
            self.step(splats.len());
            return Ok(());
        }
        let order = self.prepared.storage.order;
        let numbers = if self.numbered || self.updatable { Numbers::Own } else { Numbers::Unknown };
        let first = self.prepared.chunks.len();
        self.part_of((number, object, numbers), (epsilon, auto), order, None)?;
        if let Some(room) = room {
            self.room((number, object, epsilon), first, room)?;
        }
        Ok(())
    }

    /// An object that can be seen, or one of its two parts.
    fn part_of(
        &mut self,
        (number, object, numbers): (usize, &Object, Numbers<'_>),
        (epsilon, auto): (Option<Epsilon>, bool),
        order: Order,
        levels: Option<(&Leveled, ChunkLevels)>,
    ) -> Result<()> {
        let (splats, storage) = (&object.splats, self.prepared.storage);
        let transparent = levels
            .map_or_else(|| splats.colors.opacity() != Opacity::Opaque, |(leveled, _)| leveled.transparent);
        // Packed disks have no room for a share; ellipses are never packed.
        let exact = storage.format == SplatFormat::Exact || matches!(splats.shapes, Shapes::Ellipses { .. });
        self.step(0); // so that a bar is there meanwhile
        let one_for_all = |overlap: f64| vec![overlap.recip() as f32; splats.len()];
        let is_of_cells = levels.is_some_and(|(_, levels)| levels.part == LevelPart::OfCells);
        let known = levels.and_then(|(leveled, _)| leveled.inverse_overlaps.clone());
        let inverse_overlaps = match levels {
            Some((leveled, levels)) if levels.part == LevelPart::Nodes => one_for_all(leveled.overlap),
            // Where splats meet polygons of the same surface, their sum is to fall toward their border: of cells what is beyond it was counted.
            _ if exact && (!self.beside_polygons || is_of_cells) => {
                known.unwrap_or_else(|| Overlaps::of(splats).inverse)
            }
            Some((leveled, _)) if known.is_some() => one_for_all(leveled.overlap),
            _ => one_for_all(Overlaps::of(splats).mean),
        };
        let is_sharp = !splats.clips.is_empty();
        let radii = Epsilon::auto_radii(transparent);
        let Sharp { shares, bends } = if is_sharp { Sharp::of(splats, radii) } else { Sharp::default() };
        let shares = match auto && exact {
            true if is_sharp => Some(shares),
            true if transparent || !object.closed => near_surfaces::shares(splats, radii),
            _ => None,
        };
        // Layers have no room for what such splats cover; beside polygons of the same surface none is at its border.
        let without = transparent || is_sharp || !exact || levels.is_some() || self.beside_polygons;
        let at_border = if without { None } else { at_border(splats) };
        // Before it is cut, so that chunks are compact; and after what needs room of its own.
        let sequence = Sequence::of(splats, order);
        let part = Part {
            number,
            object,
            numbers,
            transparent,
            inverse_overlaps,
            epsilon,
            shares,
            bends,
            at_border,
            levels,
        };
        if splats.clips.is_empty() {
            return self.sequence(&part, &sequence);
        }
        // What is clipped costs others nothing.
        let parts = sequence.parted(|i| splats.clips.get(i) != Clip::None);
        parts.iter().try_for_each(|sequence| self.sequence(&part, sequence))
    }

    fn sequence(&mut self, part: &Part<'_>, sequence: &Sequence) -> Result<()> {
        let (splats, format) = (&part.object.splats, self.prepared.storage.format);
        for piece in pieces(0..sequence.len(), self.capacity) {
            for site in sites(splats, sequence, &piece, format) {
                for range in pieces(0..site.len(&piece), chunk::part_of(self.capacity, site.fine)) {
                    self.chunk((part, sequence), &piece, &site, range)?;
                }
            }
        }
        Ok(())
    }

    /// The splats at `range` of a site of a piece.
    fn chunk(
        &mut self,
        (part, sequence): (&Part<'_>, &Sequence),
        piece: &Range<usize>,
        site: &Site,
        range: Range<usize>,
    ) -> Result<()> {
        let splats = &part.object.splats;
        let which = |places: Range<usize>| site.at(sequence, piece, places);
        let mut survey = site.survey(splats, which(range.clone()));
        // Each may get a color of its own.
        survey.uniform_color &= !self.updatable;
        self.prepared.defects.merge(&survey.defects);
        if survey.count > 0 {
            if part.transparent && !part.levels.is_some_and(|(_, levels)| levels.part.stands_for_others()) {
                self.transparent_splats += survey.count;
                self.transparent_radii += survey.sum_of_radii;
            }
            let number = self.prepared.chunks.len();
            let (closed, transparent) = (part.object.closed, part.transparent);
            let traits = Traits { closed, transparent, is_fixed: !self.updatable };
            let levels = part.levels.map(|(leveled, levels)| {
                let numbers = pack::packable(splats, which(range.clone()), survey.rebase);
                (levels, LevelWords::of(leveled, levels, &numbers))
            });
            let of_levels = levels.as_ref().map(|(levels, words)| (*levels, words));
            let mut chunk = Chunk::new(self.uploader.as_ref(), number, traits, (&survey, of_levels))?;
            let numbers = || part.numbered(pack::packable(splats, which(range.clone()), survey.rebase));
            chunk.numbers = if self.numbered { numbers() } else { None };
            let mut shadow = (self.updatable && !survey.clipped).then(Packed::default);
            chunk.object = part.number;
            chunk.epsilon = part.epsilon;
            chunk.own_epsilon = part.shares.is_some();
            chunk.is_sharp = !splats.clips.is_empty();
            chunk.has_borders = part.at_border.is_some();
            let batches = pieces(range.clone(), BATCH_SPLATS).map(which);
            let packed = batches.map(|which| {
                let packed = pack::pack(splats, which, &survey, part.beside());
                shadow.iter_mut().for_each(|shadow| shadow.extend(&packed));
                packed
            });
            let mut uploaded = |count| (self.progress)(self.done + count, self.total);
            chunk.fill(self.uploader.as_mut(), packed, &survey, &mut uploaded)?;
            chunk.shadow =
                shadow.zip(numbers()).map(|(packed, numbers)| Shadow::new(packed, &numbers, &survey));
            if let Some((levels, words)) = &levels {
                chunk.fill_levels(self.uploader.as_mut(), words)?;
                chunk.scene_bytes += levels.scene_bytes_each() * u64::from(survey.count);
            }
            if survey.packed {
                chunk.inverse_overlap = part.inverse_overlaps[0].into();
            }
            chunk.scene_bytes += splats.bytes() * u64::from(survey.count) / splats.len() as u64;
            self.prepared.chunks.push(chunk);
        }
        self.step(range.len());
        Ok(())
    }
}
