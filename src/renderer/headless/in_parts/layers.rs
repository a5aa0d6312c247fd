//! Transparent layers of frames in parts: see, reduce, sum, reduce, compose, until one is empty.

#[cfg(feature = "inside")]
use super::super::Headless;
use super::{PartSums, Parts, buffer, copied, fill};
use crate::{
    error::Result,
    frame::FrameSlot,
    renderer::{Around, PartLayer, Stage},
    vk::{Buffer, Device},
};
#[cfg(feature = "inside")]
use crate::{
    prepare::PreparedScene,
    scene::{Camera, Settings},
};

/// What of all parts lies around a transparent layer: depths, a value a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub struct PartsAround<'d> {
    /// Of opaque splats, where there are any.
    pub opaque: Option<&'d [f32]>,
    /// Of the layer before; none for the first.
    pub before: Option<&'d [f32]>,
}

/// What all parts have summed of a transparent layer.
#[derive(Clone, Copy, Debug)]
pub enum LayerSums<'s> {
    /// Of a surface.
    Surface(&'s PartSums),
    /// Of all that is left, for the last layer; of the layer before, where its weights are to count surfaces.
    Rest(&'s PartSums, Option<&'s PartSums>),
}

/// What lives as long as the host, for layers of pictures of one size.
pub(super) struct LayerParts {
    /// Of the stages of a layer, so that each finds its frame of before: see, sum, sum the rest, compose.
    slots: [FrameSlot; 4],
    opaque: Buffer,
    before: Buffer,
    weights: Buffer,
    colors_before: Buffer,
    composed: [Buffer; 2],
}

impl LayerParts {
    fn new(device: &Device, size_px: [u32; 2]) -> Result<Self> {
        let of = |name, bytes| buffer(device, size_px, name, bytes);
        Ok(Self {
            slots: [(); 4].map(|()| FrameSlot::new(device)),
            opaque: of("depth of opaque parts", 4)?,
            before: of("depth of the layer before", 4)?,
            weights: of("weights of parts", 4)?,
            colors_before: of("colors of the layer before", 16)?,
            composed: [of("layers before", 16)?, of("layers", 16)?],
        })
    }

    /// # Safety
    /// The device does nothing with them.
    unsafe fn fill_around(&mut self, PartsAround { opaque, before }: PartsAround<'_>) -> Result<Around> {
        let filled = |to: &mut Buffer, from: Option<&[f32]>| -> Result<_> {
            // SAFETY: this function's contract.
            from.map(|from| unsafe { fill(to, from) }.map(|()| to.raw())).transpose()
        };
        Ok(Around { opaque: filled(&mut self.opaque, opaque)?, before: filled(&mut self.before, before)? })
    }
}

impl Parts {
    /// Its layers, and the others.
    fn layers(&mut self, device: &Device) -> Result<&mut LayerParts> {
        match &mut self.layers {
            Some(layers) => Ok(layers),
            none => Ok(none.insert(LayerParts::new(device, self.size_px)?)),
        }
    }

    /// Puts what layers add up to where the picture finds it.
    ///
    /// # Safety
    /// The device does nothing with it.
    pub(super) unsafe fn fill_layers(&mut self, device: &Device, layers: &[f32]) -> Result<ash::vk::Buffer> {
        let [before, _] = &mut self.layers(device)?.composed;
        // SAFETY: this function's contract.
        unsafe { fill(before, layers) }?;
        Ok(before.raw())
    }
}

#[cfg(feature = "inside")]
impl Headless {
    /// What is seen of a transparent layer of a part: near / z of its surface at each pixel, at least that of opaque splats. Of all parts it is the largest.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::record_stage`]; [`crate::ErrorKind::Option`] for another number of pixels.
    pub fn see_layer_part(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        around: PartsAround<'_>,
    ) -> Result<Vec<f32>> {
        let mut parts = self.parts(settings)?;
        let depth = parts.depth.raw();
        let layers = parts.layers(&self.device)?;
        // SAFETY: every submission was waited for.
        let around = unsafe { layers.fill_around(around) }?;
        let stage = Stage::SeeLayer { around, depth };
        self.run_stage(&mut layers.slots[0], scene, camera, settings, stage)?;
        // SAFETY: waited for.
        let depth = copied(unsafe { parts.depth.bytes() });
        self.parts = Some(parts);
        Ok(depth)
    }

    /// What is summed of a transparent layer of a part, whose depth in all parts is `depth`. Of all parts it is the sum; a layer of no weight is empty, and
    /// so are those behind it.
    ///
    /// # Errors
    /// As [`Self::see_layer_part`].
    pub fn sum_layer_part(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        around: PartsAround<'_>,
        depth: &[f32],
    ) -> Result<PartSums> {
        let mut parts = self.parts(settings)?;
        // SAFETY: every submission was waited for.
        unsafe { fill(&mut parts.depth, depth) }?;
        let (depth, sums) = (parts.depth.raw(), parts.sums());
        let layers = parts.layers(&self.device)?;
        // SAFETY: as above.
        let around = unsafe { layers.fill_around(around) }?;
        let stage = Stage::SumLayer { around, depth, sums };
        self.run_stage(&mut layers.slots[1], scene, camera, settings, stage)?;
        // SAFETY: waited for.
        let [colors, normals] = parts.sums.each_ref().map(|buffer| copied(unsafe { buffer.bytes() }));
        self.parts = Some(parts);
        Ok(PartSums { colors, normals })
    }

    /// What is summed of all of a part that lies behind the layer before, for the last layer: Σ weight · alpha · lit color, Σ weight · alpha, and in place of
    /// normals Σ weight, one value a pixel. Of all parts it is the sum.
    ///
    /// # Errors
    /// As [`Self::see_layer_part`].
    pub fn sum_rest_part(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        around: PartsAround<'_>,
    ) -> Result<PartSums> {
        let mut parts = self.parts(settings)?;
        let [colors, _] = parts.sums();
        let layers = parts.layers(&self.device)?;
        // SAFETY: every submission was waited for.
        let around = unsafe { layers.fill_around(around) }?;
        let stage = Stage::SumRest { around, sums: [colors, layers.weights.raw()] };
        self.run_stage(&mut layers.slots[2], scene, camera, settings, stage)?;
        // SAFETY: waited for.
        let normals = copied(unsafe { layers.weights.bytes() });
        // SAFETY: as above.
        let colors = copied(unsafe { parts.sums[0].bytes() });
        self.parts = Some(parts);
        Ok(PartSums { colors, normals })
    }

    /// A transparent layer of all parts, shaded and put under those before it: linear light times alpha, and alpha, four values a pixel. Of the scene, which
    /// may be any part, lights are taken alone.
    ///
    /// # Errors
    /// As [`Self::see_layer_part`].
    pub fn compose_parts(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        sums: LayerSums<'_>,
        before: Option<&[f32]>,
    ) -> Result<Vec<f32>> {
        let mut parts = self.parts(settings)?;
        let [colors, normals] = parts.sums();
        let of_rest = matches!(sums, LayerSums::Rest(..));
        let (LayerSums::Surface(of_layer) | LayerSums::Rest(of_layer, _)) = sums;
        // SAFETY: every submission was waited for.
        unsafe { fill(&mut parts.sums[0], &of_layer.colors) }?;
        if !of_rest {
            // SAFETY: as above.
            unsafe { fill(&mut parts.sums[1], &of_layer.normals) }?;
        }
        let before = match before {
            None => None,
            // SAFETY: as above.
            Some(before) => Some(unsafe { parts.fill_layers(&self.device, before) }?),
        };
        let layers = parts.layers(&self.device)?;
        let layer = match sums {
            LayerSums::Surface(_) => PartLayer::Surface([colors, normals]),
            LayerSums::Rest(rest, of_before) => {
                // SAFETY: as above.
                unsafe { fill(&mut layers.weights, &rest.normals) }?;
                if let Some(of_before) = of_before {
                    // SAFETY: as above.
                    unsafe { fill(&mut layers.colors_before, &of_before.colors) }?;
                }
                PartLayer::Rest([colors, layers.weights.raw()], of_before.map(|_| layers.colors_before.raw()))
            }
        };
        let stage = Stage::Compose { layer, before, composed: layers.composed[1].raw() };
        self.run_stage(&mut layers.slots[3], scene, camera, settings, stage)?;
        // SAFETY: waited for.
        let composed = copied(unsafe { layers.composed[1].bytes() });
        self.parts = Some(parts);
        Ok(composed)
    }
}
