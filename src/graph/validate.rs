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

/// Refuses the first resource at fault, else the first pass, in the order in which they were declared. The kinds of
/// all passes.
pub(super) fn validate(graph: &Declared<'_>) -> Result<Vec<PassKind>> {
    let mut names = HashSet::new();
    for resource in &graph.resources {
        if !names.insert(resource.name) {
            return refuse("", resource.name, "another resource has this name");
        }
        check_resource(resource)?;
    }
    let mut names = HashSet::new();
    let mut written = vec![0; graph.resources.len()];
    let check = |pass| {
        check_name(pass, &mut names)?;
        for usage in pass.uses {
            let written = &mut written[usage.resource.index()];
            if usage.version != *written {
                let reason = format!(
                    "the handle is stale: it took part in {} write(s), of which {written} are in the graph; the \
                     pass of the other was not finished",
                    usage.version
                );
                return refuse(pass.name, graph.resource(usage.resource).name, reason);
            }
            *written += u32::from(usage.start.is_some());
            check_use(graph, pass, usage)?;
        }
        check_same(graph, pass)?;
        check_attachments(graph, pass)?;
        kind_of(pass)
    };
    graph.passes.iter().map(check).collect()
}

fn check_name<'a>(pass: &Pass<'a>, names: &mut HashSet<&'a str>) -> Result<()> {
    if pass.name.is_empty() {
        return refuse("", "", "a pass has no name");
    }
    if !names.insert(pass.name) {
        return refuse(pass.name, "", "another pass has this name");
    }
    match pass.foreign {
        Some(id) => refuse(pass.name, &format!("#{}", id.index()), "the handle belongs to another graph"),
        None => Ok(()),
    }
}

/// The kind of a pass, from its accesses.
fn kind_of(pass: &Pass<'_>) -> Result<PassKind> {
    let mut found = pass.uses.iter().filter_map(|usage| Some((usage.access, usage.access.info().kind?)));
    let Some((access, kind)) = found.next() else {
        return refuse(pass.name, "", "no access says whether it draws, dispatches or copies");
    };
    if let Some((other, _)) = found.find(|(_, other)| *other != kind) {
        let reason = format!("{access:?} and {other:?} are of different kinds of passes; make it two");
        return refuse(pass.name, "", reason);
    }
    if kind == PassKind::Graphics && !pass.uses.iter().any(|usage| usage.access.is_attachment()) {
        return refuse(pass.name, "", "it draws but has no attachment");
    }
    Ok(kind)
}

fn check_resource(resource: &Resource<'_>) -> Result<()> {
    let refuse = |reason: &str| refuse("", resource.name, reason);
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

fn check_use(graph: &Declared<'_>, pass: &Pass<'_>, usage: &Use) -> Result<()> {
    let resource = graph.resource(usage.resource);
    let access = usage.access;
    let refuse = |reason: String| refuse(pass.name, resource.name, reason);
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

/// Several accesses of one pass to the same resource, each legal alone.
fn check_same(graph: &Declared<'_>, pass: &Pass<'_>) -> Result<()> {
    let mut uses: Vec<&Use> = pass.uses.iter().collect();
    uses.sort_by_key(|usage| usage.resource);
    for same in uses.chunk_by(|a, b| a.resource == b.resource) {
        for (i, b) in same.iter().enumerate() {
            same[..i].iter().try_for_each(|a| check_pair(graph, pass, a, b))?;
        }
    }
    Ok(())
}

fn check_pair(graph: &Declared<'_>, pass: &Pass<'_>, a: &Use, b: &Use) -> Result<()> {
    let Resource { name, desc, .. } = graph.resource(b.resource);
    let layout = |usage: &Use| usage.access.info().image.map(|(layout, _)| layout);
    let reason = if a.start.is_some() || b.start.is_some() {
        format!("{:?} and {:?} conflict: one of them writes", a.access, b.access)
    } else if a.access == b.access {
        format!("{:?} is declared twice", a.access)
    } else if matches!(desc, ResourceDesc::Image(_)) && layout(a) != layout(b) {
        format!("{:?} and {:?} need different layouts", a.access, b.access)
    } else {
        return Ok(());
    };
    refuse(pass.name, name, reason)
}

/// The attachments of one pass, each legal alone.
fn check_attachments(graph: &Declared<'_>, pass: &Pass<'_>) -> Result<()> {
    let mut first = None;
    let mut has_depth = false;
    for usage in pass.uses.iter().filter(|usage| usage.access.is_attachment()) {
        let Resource { name, desc: ResourceDesc::Image(desc), .. } = graph.resource(usage.resource) else {
            continue;
        };
        if usage.access.is_depth_attachment() && std::mem::replace(&mut has_depth, true) {
            return refuse(pass.name, name, "it is the second depth attachment of the pass");
        }
        let (first_name, of_first) = *first.get_or_insert((name, desc.extent));
        if desc.extent != of_first {
            let size = |extent: vk::Extent2D| format!("{}x{}", extent.width, extent.height);
            let (own, other) = (size(desc.extent), size(of_first));
            let reason = format!("its size {own} differs from that of attachment '{first_name}', {other}");
            return refuse(pass.name, name, reason);
        }
    }
    Ok(())
}

fn refuse<T>(pass: &str, resource: &str, reason: impl Into<String>) -> Result<T> {
    Err(ErrorKind::Graph { pass: pass.into(), resource: resource.into(), reason: reason.into() }.into())
}
