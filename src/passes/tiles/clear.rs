//! Images that begin with 0 everywhere.

use ash::vk;

use crate::graph::{Access, Graph, Handle, Image, Start, execute::Body};
use crate::passes::{
    pass::{Pass, Source},
    place::transfer,
};

/// Declares the pass that sets images to 0.
pub(crate) fn clear<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    source: Source<'a>,
    name: &str,
    why: &'static str,
    images: &mut [&mut Handle<Image>],
) {
    let count = images.len() as u32;
    let mut pass = Pass::new(graph, source, name, why);
    for (number, image) in (0..).zip(images) {
        pass = pass.write(transfer(number), image, Access::TransferWrite, Start::Discard);
    }
    pass.finish(move |pass| {
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(vk::ImageAspectFlags::COLOR)
            .level_count(1)
            .layer_count(1);
        let zero = vk::ClearColorValue { float32: [0.0; 4] };
        for number in 0..count {
            let (image, layout) = pass.image(transfer(number))?;
            // SAFETY: outside of rendering; the image is in the layout that the pass declares.
            unsafe { pass.device().cmd_clear_color_image(pass.commands(), image, layout, &zero, &[range]) };
        }
        Ok(())
    });
}
