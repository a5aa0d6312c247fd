//! A plan in words, and as a drawing.

use std::fmt::{self, Write as _};

use super::{
    barrier::Barrier,
    declare::{Start, Use},
    lifetime::Usage,
    load_store::Attachment,
    plan::{Plan, PlannedPass},
    resource::{ClearValue, Origin, ResourceDesc, ResourceId, State},
    scope::Scope,
};

impl fmt::Display for Plan {
    /// The whole plan in words: resources, memory, passes, barriers. The same plan gives the same text.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "resources")?;
        for i in 0..self.resources.len() {
            self.write_resource(f, i)?;
        }
        if !self.blocks.is_empty() {
            writeln!(f, "memory")?;
        }
        for (i, block) in self.blocks.iter().enumerate() {
            let class = format!("{:?}", block.class).to_lowercase();
            writeln!(
                f,
                "  block {i}: {class}, {} bytes, alignment {}, memory types {:#b}",
                block.size_bytes, block.alignment_bytes, block.type_bits
            )?;
        }
        for (i, pass) in self.passes.iter().enumerate() {
            self.write_pass(f, i, pass)?;
        }
        if !self.final_barriers.is_empty() {
            writeln!(f, "after the last pass")?;
        }
        for barrier in &self.final_barriers {
            self.write_barrier(f, barrier)?;
        }
        for pass in &self.culled {
            writeln!(f, "culled pass '{}'", pass.name)?;
        }
        Ok(())
    }
}

impl Plan {
    /// The plan as a graph for Graphviz: boxes are passes, ellipses are contents of resources (`name` initially,
    /// `name #n` after the n-th write), what was culled is dashed.
    pub fn to_dot(&self) -> String {
        let mut edges = String::new();
        let mut contents = Vec::new();
        let live = self.passes.iter().map(|pass| (&pass.name, &pass.uses, ""));
        let culled = self.culled.iter().map(|pass| (&pass.name, &pass.uses, " [style=dashed]"));
        let passes: Vec<_> = live.chain(culled).collect();
        for (name, uses, style) in &passes {
            let pass = quoted(&format!("pass {name}"));
            for usage in *uses {
                let before = (usage.resource, usage.version);
                if usage.needs_content() {
                    contents.push(before);
                    let _ = writeln!(edges, "  {} -> {pass}{style};", self.content(before));
                }
                if usage.start.is_some() {
                    let after = (usage.resource, usage.version + 1);
                    contents.push(after);
                    let _ = writeln!(edges, "  {pass} -> {}{style};", self.content(after));
                }
            }
        }
        contents.sort_unstable();
        contents.dedup();
        let mut dot = String::from("digraph frame {\n  rankdir=LR;\n");
        for (name, _, style) in &passes {
            let style = if style.is_empty() { "" } else { ", style=dashed" };
            let pass = quoted(&format!("pass {name}"));
            let _ = writeln!(dot, "  {pass} [shape=box, label={}{style}];", quoted(name));
        }
        for content in contents {
            let bold = match self.resource(content.0).origin {
                Origin::Imported { .. } => ", penwidth=2",
                Origin::Transient => "",
            };
            let _ = writeln!(dot, "  {} [shape=ellipse{bold}];", self.content(content));
        }
        dot + &edges + "}\n"
    }

    fn content(&self, (resource, version): (ResourceId, u32)) -> String {
        match version {
            0 => quoted(&self.resource(resource).name),
            n => quoted(&format!("{} #{n}", self.resource(resource).name)),
        }
    }

    fn write_resource(&self, f: &mut fmt::Formatter<'_>, index: usize) -> fmt::Result {
        let resource = &self.resources[index];
        let origin = match resource.origin {
            Origin::Transient => "transient",
            Origin::Imported { .. } => "imported",
        };
        write!(f, "  {}: {origin} ", resource.name)?;
        match resource.desc {
            ResourceDesc::Image(desc) => {
                write!(f, "image {}x{} {:?}", desc.extent.width, desc.extent.height, desc.format)?;
            }
            ResourceDesc::Buffer(desc) => write!(f, "buffer of {} bytes", desc.size_bytes)?,
        }
        match resource.lifetime {
            Some(life) if life.first == life.last => write!(f, ", pass {}", life.first)?,
            Some(life) => write!(f, ", passes {} to {}", life.first, life.last)?,
            None => write!(f, ", unused")?,
        }
        if resource.lifetime.is_some() {
            match resource.usage {
                Usage::Image(flags) => write!(f, ", {flags:?}")?,
                Usage::Buffer(flags) => write!(f, ", {flags:?}")?,
            }
        }
        if let Some(slot) = resource.slot {
            write!(f, ", block {} at {}, {} bytes", slot.block, slot.offset_bytes, slot.size_bytes)?;
        }
        writeln!(f)?;
        if let Origin::Imported { initial, final_ } = resource.origin {
            writeln!(f, "    initially {}", words_of_state(initial, &resource.desc))?;
            match final_ {
                Some(state) => writeln!(f, "    finally {}", words_of_state(state, &resource.desc))?,
                None => writeln!(f, "    left as {}", words_of_state(resource.end, &resource.desc))?,
            }
        }
        Ok(())
    }

    fn write_pass(&self, f: &mut fmt::Formatter<'_>, index: usize, pass: &PlannedPass) -> fmt::Result {
        let kind = format!("{:?}", pass.kind).to_lowercase();
        write!(f, "pass {index} '{}', {kind}", pass.name)?;
        if let Some(rendering) = &pass.rendering {
            write!(f, " {}x{}", rendering.extent.width, rendering.extent.height)?;
        }
        writeln!(f, "{}", if pass.side_effect { ", has a side effect" } else { "" })?;
        if let Some((src, dst)) = pass.barriers.memory {
            writeln!(f, "  wait for memory: {} before {}", words_of_scope(src), words_of_scope(dst))?;
        }
        for barrier in &pass.barriers.resources {
            self.write_barrier(f, barrier)?;
        }
        let attachments = pass.rendering.iter().flat_map(|r| r.colors.iter().chain(&r.depth));
        let attachments: Vec<&Attachment> = attachments.collect();
        for usage in &pass.uses {
            let attachment = attachments.iter().find(|attachment| attachment.resource == usage.resource);
            self.write_use(f, usage, attachment.filter(|_| usage.access.is_attachment()).copied())?;
        }
        Ok(())
    }

    fn write_use(
        &self,
        f: &mut fmt::Formatter<'_>,
        usage: &Use,
        attachment: Option<&Attachment>,
    ) -> fmt::Result {
        write!(f, "  {}: {:?}", self.resource(usage.resource).name, usage.access)?;
        match usage.start {
            Some(Start::Clear(ClearValue::Color(color))) => write!(f, ", cleared to {color:?}")?,
            Some(Start::Clear(ClearValue::Depth(depth))) => write!(f, ", cleared to {depth:?}")?,
            Some(Start::Load) => write!(f, ", keeps the rest")?,
            Some(Start::Discard) => write!(f, ", old content discarded")?,
            None => {}
        }
        if let Some(Attachment { load, store, .. }) = attachment {
            write!(f, "; load {load:?}, store {store:?}")?;
        }
        writeln!(f)
    }

    fn write_barrier(&self, f: &mut fmt::Formatter<'_>, barrier: &Barrier) -> fmt::Result {
        let Barrier { resource, cause, tenants, src, dst, transition } = barrier;
        write!(f, "  wait for {} ({cause:?}", self.resource(*resource).name)?;
        for (i, tenant) in tenants.iter().enumerate() {
            let lead = if i == 0 { " after" } else { "," };
            write!(f, "{lead} {}", self.resource(*tenant).name)?;
        }
        write!(f, "): {} before {}", words_of_scope(*src), words_of_scope(*dst))?;
        match transition {
            Some(layouts) if layouts.old != layouts.new => {
                writeln!(f, ", {:?} to {:?}", layouts.old, layouts.new)
            }
            _ => writeln!(f),
        }
    }
}

fn words_of_scope(scope: Scope) -> String {
    match (scope.stages.is_empty(), scope.access.is_empty()) {
        (true, _) => "nothing".into(),
        (false, true) => format!("{:?}", scope.stages),
        (false, false) => format!("{:?} ({:?})", scope.stages, scope.access),
    }
}

fn words_of_state(State { stages, access, layout }: State, desc: &ResourceDesc) -> String {
    let scope = words_of_scope(Scope { stages, access });
    match desc {
        ResourceDesc::Image(_) => format!("{scope}, {layout:?}"),
        ResourceDesc::Buffer(_) => scope,
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
