//! Compile stage 1: refuses a graph that can't be run, with a sentence that names pass and resource.
//!
//! A cycle can't be declared, so none is looked for: a pass can only name contents that exist already, because the
//! one handle of a resource moves on with each write. Declaration order is therefore an order of execution.

use std::collections::HashSet;

use ash::vk;

use super::{
    access::{Access, PassKind},
    declare::{Declared, Pass, Resource, Start, Use},
    resource::{ClearValue, Origin, ResourceDesc, aspect_of},
};
use crate::error::{ErrorKind, Result};

/// Refuses the first mistake, in the order in which resources and passes were declared.
pub(super) fn validate(graph: &Declared) -> Result<()> {
    let mut names = HashSet::new();
    for resource in &graph.resources {
        if !names.insert(&*resource.name) {
            return refuse("", &resource.name, "another resource has this name");
        }
        check_resource(resource)?;
    }
    let mut names = HashSet::new();
    for pass in &graph.passes {
        if pass.name.is_empty() {
            return refuse("", "", "a pass has no name");
        }
        if !names.insert(&pass.name) {
            return refuse(&pass.name, "", "another pass has this name");
        }
        if let Some((resource, reason)) = &pass.fault {
            return refuse(&pass.name, resource, reason.as_str());
        }
        for (i, usage) in pass.uses.iter().enumerate() {
            check_use(graph, pass, usage)?;
            for earlier in &pass.uses[..i] {
                check_pair(graph, pass, earlier, usage)?;
            }
        }
        kind_of(pass)?;
    }
    Ok(())
}

/// The kind of a pass, from its accesses.
pub(super) fn kind_of(pass: &Pass) -> Result<PassKind> {
    let mut found = pass.uses.iter().filter_map(|usage| Some((usage.access, usage.access.info().kind?)));
    let Some((access, kind)) = found.next() else {
        return refuse(&pass.name, "", "no access says whether it draws, dispatches or copies");
    };
    if let Some((other, _)) = found.find(|(_, other)| *other != kind) {
        let reason = format!("{access:?} and {other:?} are of different kinds of passes; make it two");
        return refuse(&pass.name, "", reason);
    }
    if kind == PassKind::Graphics && !pass.uses.iter().any(|usage| usage.access.is_attachment()) {
        return refuse(&pass.name, "", "it draws but has no attachment");
    }
    Ok(kind)
}

fn check_resource(resource: &Resource) -> Result<()> {
    let refuse = |reason: &str| refuse("", &resource.name, reason);
    if resource.name.is_empty() {
        return refuse("a resource has no name");
    }
    match resource.desc {
        ResourceDesc::Image(desc) => {
            if desc.extent.width == 0 || desc.extent.height == 0 {
                return refuse("an image needs at least one pixel");
            }
            if desc.format == vk::Format::UNDEFINED {
                return refuse("an image needs a format");
            }
            if let Origin::Imported { final_: Some(state), .. } = resource.origin
                && matches!(state.layout, vk::ImageLayout::UNDEFINED | vk::ImageLayout::PREINITIALIZED)
            {
                return refuse("no image can be brought into its final layout");
            }
        }
        ResourceDesc::Buffer(desc) if desc.size_bytes == 0 => {
            return refuse("a buffer needs at least one byte");
        }
        ResourceDesc::Buffer(_) => {}
    }
    Ok(())
}

fn check_use(graph: &Declared, pass: &Pass, usage: &Use) -> Result<()> {
    let resource = graph.resource(usage.resource);
    let access = usage.access;
    let refuse = |reason: String| refuse(&pass.name, &resource.name, reason);
    match resource.desc {
        ResourceDesc::Image(desc) => {
            if access.info().image.is_none() {
                return refuse(format!("{access:?} is not an access to an image"));
            }
            let aspect = aspect_of(desc.format);
            if access.is_depth_attachment() && !aspect.contains(vk::ImageAspectFlags::DEPTH) {
                return refuse(format!("{access:?} needs a depth format, not {:?}", desc.format));
            }
            // Depth formats can be sampled and copied, but not written as colors or by shaders.
            let needs_color = !access.is_depth_attachment()
                && access.info().image.is_some_and(|(_, image_usage)| {
                    image_usage
                        .intersects(vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::STORAGE)
                });
            if needs_color && aspect != vk::ImageAspectFlags::COLOR {
                return refuse(format!("{access:?} needs a color format, not {:?}", desc.format));
            }
        }
        ResourceDesc::Buffer(_) if access.info().buffer.is_none() => {
            return refuse(format!("{access:?} is not an access to a buffer"));
        }
        ResourceDesc::Buffer(desc) => {
            if access == Access::TexelReadCompute && desc.texels == vk::Format::UNDEFINED {
                return refuse(format!("{access:?} needs a format of texels"));
            }
        }
    }
    match (access.writes(), usage.start) {
        (true, None) => return refuse(format!("{access:?} writes: declare it by `write`")),
        (false, Some(_)) => return refuse(format!("{access:?} only reads: declare it by `read`")),
        _ => {}
    }
    if let Some(Start::Clear(value)) = usage.start {
        match value {
            _ if !access.is_attachment() => {
                return refuse(format!("{access:?} can't begin with a clear: only attachments can"));
            }
            ClearValue::Color(_) if access.is_depth_attachment() => {
                return refuse("a depth can't be cleared to a color".into());
            }
            ClearValue::Depth(_) if !access.is_depth_attachment() => {
                return refuse("a color can't be cleared to a depth".into());
            }
            ClearValue::Depth(depth) if !(0.0..=1.0).contains(&depth) => {
                return refuse(format!("a depth is cleared to {depth}: expected 0 to 1"));
            }
            _ => {}
        }
    }
    let empty = match resource.origin {
        Origin::Transient => true,
        Origin::Imported { initial, .. } => {
            matches!(resource.desc, ResourceDesc::Image(_)) && initial.layout == vk::ImageLayout::UNDEFINED
        }
    };
    if empty && usage.version == 0 && usage.needs_content() {
        let verb = if usage.start.is_some() { "loads" } else { "reads" };
        return refuse(format!("{access:?} {verb} what no earlier pass has written"));
    }
    Ok(())
}

/// Two accesses of one pass, each legal alone.
fn check_pair(graph: &Declared, pass: &Pass, a: &Use, b: &Use) -> Result<()> {
    let name = &graph.resource(b.resource).name;
    let both = format!("{:?} and {:?}", a.access, b.access);
    if a.resource == b.resource {
        if a.start.is_some() || b.start.is_some() {
            return refuse(&pass.name, name, format!("{both} conflict: one of them writes"));
        }
        if a.access == b.access {
            return refuse(&pass.name, name, format!("{:?} is declared twice", a.access));
        }
        let layout = |usage: &Use| usage.access.info().image.map(|(layout, _)| layout);
        if matches!(graph.resource(a.resource).desc, ResourceDesc::Image(_)) && layout(a) != layout(b) {
            return refuse(&pass.name, name, format!("{both} need different layouts"));
        }
    }
    if a.access.is_depth_attachment() && b.access.is_depth_attachment() {
        return refuse(&pass.name, name, "it is the second depth attachment of the pass");
    }
    if a.access.is_attachment()
        && b.access.is_attachment()
        && let (ResourceDesc::Image(x), ResourceDesc::Image(y)) =
            (graph.resource(a.resource).desc, graph.resource(b.resource).desc)
        && x.extent != y.extent
    {
        let reason = format!(
            "its size {}x{} differs from that of attachment '{}', {}x{}",
            y.extent.width,
            y.extent.height,
            graph.resource(a.resource).name,
            x.extent.width,
            x.extent.height
        );
        return refuse(&pass.name, name, reason);
    }
    Ok(())
}

fn refuse<T>(pass: &str, resource: &str, reason: impl Into<String>) -> Result<T> {
    Err(ErrorKind::Graph { pass: pass.into(), resource: resource.into(), reason: reason.into() }.into())
}
