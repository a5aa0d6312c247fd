//! Splats that a host writes on the device, or copies there, in place of a scene that is uploaded once.
//!
//! **Layout.** Disk `i` has 32 bytes in the buffer of shapes: `x y z radius`, then `nx ny nz 2.0`, all f32: its center from the origin in world
//! units, a unit normal. (The 2.0 are bits of our own: neither room for ε nor overlap of its own is known.) It has 8 bytes in the buffer of colors:
//! linear red, green, blue and alpha as 16-bit fractions of 65535. [`disk`] and [`color`] make both on the host.

use ash::vk;
use glam::{DVec3, Vec3};

use super::{
    Block, Chunk, PreparedScene, RadiusStep, Rebase, SplatSetLayout,
    chunk::Traits,
    memory::{To, Uploader},
    pack::{Survey, packed_color},
};
use crate::{
    error::{Error, Result},
    scene::{DefectCounts, Storage},
    shaders::config::BLOCK_SPLATS,
    vk::{Device, Limits, Staging},
};

/// What is known of splats that a host writes. All of it may be wrong by being too large, at the cost of speed, but not by being too small: what lies
/// outside of the bounds may not be drawn.
///
/// ```no_run
/// use surfel::{ash::vk, embed::{DynamicSplats, PreparedScene, Renderer}, glam::DVec3};
///
/// /// Room for ten thousand splats of a closed surface in a box; the buffers are a compute shader's to fill.
/// fn room(renderer: &Renderer) -> surfel::Result<(PreparedScene, [vk::Buffer; 2])> {
///     let scene = renderer.dynamic(&DynamicSplats {
///         capacity: 10_000,
///         count: 10_000,
///         origin: DVec3::ZERO,
///         bounds: [DVec3::splat(-1.0), DVec3::splat(1.0)],
///         largest_radius: 0.05,
///         overlap: 2.0,
///         closed: true,
///         transparent: false,
///     })?;
///     let buffers = scene.dynamic_buffers().unwrap();
///     Ok((scene, [buffers.shapes, buffers.colors]))
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicSplats {
    /// How many there are room for, at most 4 million and what a storage buffer of the device holds at 32 bytes each.
    pub capacity: u32,
    /// How many are drawn, the first ones.
    pub count: u32,
    /// Where positions are counted from, in the world.
    pub origin: DVec3,
    /// The smallest and the largest coordinates of centers, from the origin.
    pub bounds: [DVec3; 2],
    /// The largest radius.
    pub largest_radius: f64,
    /// How many disks lie over a place of the surface, where they are fewest: it tells how much of a pixel a silhouette covers. Where fewer lie
    /// than that, a surface inside of its silhouette shows what is behind it.
    pub overlap: f64,
    /// They belong to a closed surface and their normals point outward: those that face away are not drawn.
    pub closed: bool,
    /// Some may be transparent: they are drawn in layers.
    pub transparent: bool,
}

/// The farthest from the origin that bounds may be, and the largest radius: squares of it stay within f32, in which a host writes them.
const FARTHEST: f64 = 1e18;

/// The mean of the default kernel, exp(−2 r²), over a disk: (1 − e⁻²) / 2. Disks sum to that times their number.
pub(super) const MEAN_WEIGHT: f64 = 0.432_332_358_381_693_65;

/// Where a host writes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DynamicBuffers {
    /// 32 bytes a splat; usage `STORAGE_BUFFER` and `TRANSFER_DST`.
    pub shapes: vk::Buffer,
    /// 8 bytes a splat; usage alike.
    pub colors: vk::Buffer,
}

impl DynamicSplats {
    fn check(&self, capacity: usize) -> Result<()> {
        let refused = |problem: String| Err(Error::option("dynamic splats", problem));
        let Self { capacity: room, count, origin, bounds: [lo, hi], largest_radius, overlap, .. } = *self;
        if room == 0 || room as usize > capacity {
            return refused(format!("room for {room}: expected 1 to {capacity}"));
        }
        if count > room {
            return refused(format!("{count} of them: there is room for {room}"));
        }
        let holds = |corner: DVec3| corner.abs().max_element() <= FARTHEST;
        let ordered = origin.is_finite() && lo.cmple(hi).all() && holds(lo) && holds(hi);
        if !(ordered
            && largest_radius > 0.0
            && largest_radius <= FARTHEST
            && overlap >= 1.0
            && overlap.is_finite())
        {
            return refused(format!(
                "expected bounds within {FARTHEST:e}, the smaller coordinates first, a radius above 0 and as large at most, and an overlap of 1 or more"
            ));
        }
        Ok(())
    }

    fn survey(&self) -> Survey {
        Survey {
            rebase: Rebase { origin: self.origin, scale: 1.0 },
            count: self.capacity,
            ellipses: false,
            fine: false,
            uniform_color: false,
            clipped: false,
            packed: false,
            bounds: self.bounds,
            largest_radius: self.largest_radius,
            radii: Vec::new(),
            sum_of_radii: 0.0,
            defects: DefectCounts::default(),
        }
    }

    /// Nothing is known of where which are.
    fn blocks(&self) -> impl Iterator<Item = Block> + use<'_> {
        let [lo, hi] = self.bounds;
        let block = move |first: u32| Block {
            count: BLOCK_SPLATS.min(self.count - first),
            center: 0.5 * (lo + hi),
            radius: 0.5 * (hi - lo).length(),
            axis: DVec3::Z,
            spread_rad: std::f64::consts::PI,
            spread_sin_cos: std::f64::consts::PI.sin_cos().into(),
            largest_radius: self.largest_radius,
            levels: None,
        };
        (0..self.count).step_by(BLOCK_SPLATS as usize).map(block)
    }
}

impl PreparedScene {
    /// A scene of splats that a host writes on the device. Nothing is in its buffers: they must be written before a frame that shows it.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for what is no bound; whatever the allocator or the driver answers.
    pub(crate) fn dynamic(
        (device, limits): (&Device, &Limits),
        layout: &SplatSetLayout,
        splats: &DynamicSplats,
    ) -> Result<Self> {
        splats.check(super::chunk::capacity(limits.max_storage_buffer_range))?;
        let submit: &mut dyn FnMut(Staging) -> Result<()> = &mut |_| Ok(());
        let uploader = Uploader { device, layout, to: To::Device(submit) };
        let traits = Traits { closed: splats.closed, transparent: splats.transparent, is_fixed: false };
        let mut chunk = Chunk::new(Some(&uploader), 0, traits, (&splats.survey(), None))?;
        chunk.dynamic = true;
        let mut scene = Self {
            chunks: vec![chunk],
            objects: vec!["dynamic splats".to_owned()],
            meshes: Vec::new(),
            device: Some(device.clone()),
            lights: Vec::new(),
            storage: Storage::default(),
            mean_transparent_radius: if splats.transparent { splats.largest_radius } else { 0.0 },
            refinements: Vec::new(),
            defects: DefectCounts::default(),
            bounds: None,
            changes: Default::default(),
            rooms: Vec::new(),
            upload: Default::default(),
        };
        scene.set_dynamic(splats)?;
        Ok(scene)
    }

    /// Says anew what is known of splats that a host writes, for frames that are recorded from now on: as many as there is room for, anywhere.
    /// Capacity, and whether they are closed or transparent, stay.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for what is no bound, or another of those three, and a scene that is not one of [`crate::embed`]'s dynamic ones.
    pub fn set_dynamic(&mut self, splats: &DynamicSplats) -> Result<()> {
        let Some(chunk) = self.chunks.first_mut().filter(|chunk| chunk.dynamic) else {
            return Err(Error::option(
                "dynamic splats",
                "the scene was uploaded: expected one of dynamic splats",
            ));
        };
        splats.check(chunk.room() as usize)?;
        if (splats.capacity, splats.closed, splats.transparent)
            != (chunk.room(), chunk.closed, chunk.transparent)
        {
            let problem =
                "another capacity, closed or transparent: expected those that the scene was made with";
            return Err(Error::option("dynamic splats", problem));
        }
        if chunk.transparent {
            self.mean_transparent_radius = splats.largest_radius;
        }
        chunk.count = splats.count;
        chunk.bounds = splats.bounds;
        chunk.rebase.origin = splats.origin;
        chunk.largest_radius = splats.largest_radius;
        // In memory that stays, with room for as many as there may be.
        chunk.radii.clear();
        chunk.radii.push(RadiusStep { count: splats.count, radius: splats.largest_radius });
        chunk.inverse_overlap = (splats.overlap * MEAN_WEIGHT).recip();
        chunk.blocks.clear();
        chunk.blocks.reserve(splats.capacity.div_ceil(BLOCK_SPLATS) as usize);
        chunk.blocks.extend(splats.blocks());
        Ok(())
    }

    /// The buffers that a host writes; `None` of a scene that was uploaded.
    pub fn dynamic_buffers(&self) -> Option<DynamicBuffers> {
        let chunk = self.chunks.first()?;
        chunk.written_by_host().map(|[shapes, colors]| DynamicBuffers { shapes, colors })
    }
}

/// The shape of a disk as it lies in memory: its center from the origin, its radius, its unit normal.
pub fn disk(center: Vec3, radius: f32, normal: Vec3) -> [f32; 8] {
    let ([x, y, z], [nx, ny, nz]) = (center.to_array(), normal.to_array());
    [x, y, z, radius, nx, ny, nz, 2.0]
}

/// A color as it lies in memory, linear.
pub fn color(color: [f32; 4]) -> [u16; 4] {
    packed_color(color)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        prepare::pack::{self, Beside},
        scene::{Colors, Shapes, Splats},
    };

    #[test]
    fn the_layout_is_that_of_uploaded_splats() {
        let (center, normal, rgba) =
            (DVec3::new(0.25, -0.5, 0.75), Vec3::new(0.0, 0.6, -0.8), [0.1, 0.5, 0.9, 1.0]);
        let shapes = Shapes::Disks { normals: vec![normal], radii: vec![0.125] };
        let splats = Splats::new(vec![center], shapes, Colors::Each(vec![rgba]));
        let rebase = Rebase { origin: DVec3::ZERO, scale: 1.0 };
        let survey = pack::survey(&splats, 0..1, rebase);
        let packed = pack::pack(&splats, 0..1, &survey, Beside::default());
        let bytes: &[f32] = bytemuck::cast_slice(&packed.shapes);
        assert_eq!(bytes, disk(center.as_vec3(), 0.125, normal));
        let colors: &[u16] = bytemuck::cast_slice(&packed.colors);
        assert_eq!(colors, color(rgba));
    }

    #[test]
    fn what_is_no_bound_is_refused() {
        let plain = DynamicSplats {
            capacity: 100,
            count: 10,
            origin: DVec3::ZERO,
            bounds: [DVec3::NEG_ONE, DVec3::ONE],
            largest_radius: 0.1,
            overlap: 2.0,
            closed: false,
            transparent: false,
        };
        plain.check(1000).unwrap();
        assert_eq!(plain.blocks().count(), 1);
        for wrong in [
            DynamicSplats { capacity: 0, ..plain },
            DynamicSplats { capacity: 1001, ..plain },
            DynamicSplats { count: 101, ..plain },
            DynamicSplats { bounds: [DVec3::ONE, DVec3::NEG_ONE], ..plain },
            DynamicSplats { largest_radius: 0.0, ..plain },
            DynamicSplats { overlap: f64::NAN, ..plain },
        ] {
            assert!(wrong.check(1000).is_err(), "{wrong:?}");
        }
    }
}
