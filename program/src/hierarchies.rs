//! Inputs that are hierarchies of splats (`.surfel`): opened with the scene, and read when the view is known.

use clap::Args;
use surfel::{
    Progress as _, Result,
    compose::{is_in_levels, open_levels},
    geometry::FoundUp,
    levels_file::{HOST_BYTES, LevelsFile, PageView, VERSION, load_together},
    load::ObjectDescription,
    notes::counted,
    passes::count_drawn,
    report::{InputReport, ModelReport},
    scene::{Ball, Budget, Camera, LeveledObject, Lod, Opacity, Scene, Settings},
};

use crate::{
    console::{self, Bars},
    described::describe,
    inputs::Inputs,
    octrees::Octrees,
    parse,
    scene::{Loaded, load_described, refuse_losses},
};

/// The memory for them.
#[derive(Clone, Copy, Args)]
pub struct HierarchyArguments {
    /// So much memory for what is read of all .surfel files, COPC and Potree together on its way to the device, such as 256MB: what is drawn is coarser where that does not
    /// suffice, and a line says so [default: what --lod asks for]
    #[arg(long, value_name = "BYTES", value_parser = parse::bytes(1 << 20), allow_hyphen_values = true)]
    pub budget_memory: Option<u64>,
}

/// The processes that share what a view needs.
#[derive(Clone, Copy)]
pub struct Readers {
    /// This one, from 0 on.
    pub number: u32,
    /// How many there are.
    pub count: u32,
}

impl Readers {
    /// This process alone.
    pub const ONE: Self = Self { number: 0, count: 1 };
}

/// As [`load_scene_with_hierarchies`], of inputs of which some may be octrees of points, too.
///
/// # Errors
/// As [`load_scene_with_hierarchies`] and [`Octrees::open`].
pub fn load_scene_by_view(inputs: &Inputs, bars: &Bars) -> Result<Loaded> {
    bars.held(|| load_by_view(inputs, bars))
}

fn load_by_view(inputs: &Inputs, bars: &Bars) -> Result<Loaded> {
    let (octrees, others) = Octrees::open(inputs)?;
    let mut loaded = match (others.files.is_empty(), &octrees.files[..]) {
        (true, [first, ..]) => Loaded::of_nothing(first.ball()),
        _ => load_scene_with_hierarchies(&others, bars)?,
    };
    for (octree, mut report) in octrees.files.iter().zip(octrees.reports()) {
        tell_of(&mut report, inputs, bars)?;
        let because = format!("{} says so", report.name);
        loaded.ball = loaded.ball.union(octree.ball());
        loaded.up = loaded.up.take().or(Some(FoundUp { direction: glam::DVec3::Z, because }));
        loaded.inputs.push(report);
    }
    loaded.octrees = octrees;
    Ok(loaded)
}

/// As [`crate::scene::load_scene`], of inputs of which some, or objects of whose scene files, may be hierarchies: these are opened, and said what they hold.
///
/// # Errors
/// As [`describe`], [`open_levels`] and [`load_described`].
pub fn load_scene_with_hierarchies(inputs: &Inputs, bars: &Bars) -> Result<Loaded> {
    bars.held(|| load_with_hierarchies(inputs, bars))
}

fn load_with_hierarchies(inputs: &Inputs, bars: &Bars) -> Result<Loaded> {
    let mut described = describe(inputs, bars)?;
    let (hierarchies, objects) = described.objects.into_iter().partition(is_in_levels);
    described.objects = objects;
    let hierarchies: Vec<ObjectDescription> = hierarchies;
    let opened = hierarchies.iter().map(open_levels).collect::<Result<Vec<_>>>()?;
    let mut loaded = load_described(described, opened, inputs, bars)?;
    for file in &loaded.hierarchies {
        let mut report = report(file);
        tell_of(&mut report, inputs, bars)?;
        let up = file.header().up;
        let up = up.map(|direction| FoundUp { direction, because: format!("{} says so", report.name) });
        loaded.up = loaded.up.take().or(up);
        loaded.inputs.push(report);
    }
    Ok(loaded)
}

/// Tells what a file holds that was opened, and what of the command line is of no use for it.
///
/// # Errors
/// As [`refuse_losses`], with `strict`.
fn tell_of(report: &mut InputReport, inputs: &Inputs, bars: &Bars) -> Result<()> {
    report.notes.extend(inputs.options.columns_unused());
    report.notes.iter().for_each(|note| bars.note(&format!("{}: {note}", report.name)));
    if inputs.strict {
        refuse_losses(report)?;
    }
    bars.note(&report.summary);
    Ok(())
}

/// What a file holds, in numbers and words.
fn report(file: &LevelsFile) -> InputReport {
    let header = file.header();
    let kind = if header.ellipses { "ellipses" } else { "disks" };
    let closed = if header.closed { ", closed" } else { "" };
    let name = file.name().to_owned();
    let opacity = match header.opacity() {
        Opacity::Opaque => "",
        Opacity::Transparent => "; transparent",
        Opacity::Invisible => "; invisible, alpha 0",
    };
    let (splats, nodes, pages) = (header.splats, header.nodes, header.pages);
    InputReport {
        vertices: None,
        triangles: None,
        splats: usize::try_from(splats).unwrap_or(usize::MAX),
        dropped: 0,
        drawn_as: "splats",
        because: "its file holds splats".to_owned(),
        model: Some(ModelReport {
            format: format!("hierarchy of splats, version {VERSION}"),
            holds: "splats",
            points: usize::try_from(splats).unwrap_or(usize::MAX),
            triangles: None,
            normals: true,
            colors: header.color.is_none(),
            sizes: true,
            bounds: Some(header.bounds.map(|corner| corner.to_array())),
            metres_per_unit: None,
            up: header.up.map(|up| up.to_array()),
        }),
        notes: Vec::new(),
        summary: format!(
            "{name}: {splats} {kind}{closed}; {nodes} nodes above them, in {pages} pages{opacity}"
        ),
        name,
    }
}

/// Reads what this process needs for a view of all files, within one memory, and gives the settings for which that suffices.
///
/// # Errors
/// As [`load_together`].
pub fn load(
    files: &mut [LevelsFile],
    scene: &mut Scene,
    (camera, settings): (&Camera, &Settings),
    arguments: &HierarchyArguments,
    readers: Readers,
    bars: &Bars,
) -> Result<Settings> {
    let asked_px = settings.tau_px();
    let Budget::Splats(most) = settings.budget else {
        let Read { objects, lines, tau_px, wanted_bytes } =
            load_for(files, (camera, settings, asked_px), arguments, readers, bars)?;
        lines.iter().for_each(|line| console::say(line));
        scene.leveled = objects;
        if tau_px > asked_px {
            let [splat, node] = HOST_BYTES;
            console::say(&format!(
                "--budget-memory does not suffice for --lod {asked_px:.3}px: drawn with --lod {tau_px:.3}px; --lod {asked_px:.3}px takes {}, \
                 {splat} bytes for each splat on its way to the device and {node} for each node",
                megabytes(wanted_bytes)
            ));
            return Ok(Settings { lod: Lod::Px(tau_px), ..settings.clone() });
        }
        return Ok(settings.clone());
    };
    // From a size that reads little: the number of splats goes by its square.
    let mut tau_px = COARSE_PX.max(asked_px);
    loop {
        let Read { objects, lines, tau_px: read_px, .. } =
            load_for(files, (camera, settings, tau_px), arguments, readers, bars)?;
        let drawn = count_drawn(&objects, camera, settings, read_px);
        if drawn >= most.into() || tau_px <= asked_px || read_px > tau_px {
            lines.iter().for_each(|line| console::say(line));
            scene.leveled = objects;
            return Ok(Settings { lod: Lod::Px(read_px), ..settings.clone() });
        }
        let step = (drawn as f64 / f64::from(most)).sqrt().clamp(0.125, 0.9);
        tau_px = if step * tau_px < LEAST_PX { asked_px } else { (step * tau_px).max(asked_px) };
    }
}

/// The size that is read first for a budget, and that below which all splats are.
const COARSE_PX: f64 = 32.0;
const LEAST_PX: f64 = 1.0 / 16.0;

/// What was read of files.
struct Read {
    objects: Vec<LeveledObject>,
    /// What was read, in a line each.
    lines: Vec<String>,
    /// The size for which it suffices.
    tau_px: f64,
    /// The memory that suffices for the size that was asked for.
    wanted_bytes: u64,
}

/// Bytes as an option takes them, rounded up.
pub fn megabytes(bytes: u64) -> String {
    format!("{}MB", bytes.div_ceil(1_000_000))
}

/// What is to be drawn for a size, and that for which there is memory.
fn load_for(
    files: &mut [LevelsFile],
    (camera, settings, asked_px): (&Camera, &Settings, f64),
    arguments: &HierarchyArguments,
    readers: Readers,
    bars: &Bars,
) -> Result<Read> {
    let view = PageView::new(camera, settings.size_px, asked_px)
        .with_blended(settings.blended_size())
        .with_readers(readers.number, readers.count);
    let view = if settings.budget == Budget::Unlimited { view } else { view.with_coarser() };
    let most_bytes = arguments.budget_memory.unwrap_or(u64::MAX);
    let read = load_together(files, &view, most_bytes, bars);
    bars.clear();
    let read = read?;
    let (tau_px, wanted_bytes) =
        read.first().map_or((asked_px, 0), |chosen| (chosen.tau_px, chosen.wanted_bytes));
    let (mut objects, mut lines) = (Vec::new(), Vec::new());
    for (file, chosen) in files.iter().zip(read) {
        let name = &chosen.object.name;
        let (splats, nodes) = (chosen.object.leaves.len(), chosen.object.nodes.len());
        let all = file.header().pages;
        lines.push(format!(
            "{name}: read {} of {all} pages, {} bytes: {} and {}",
            chosen.pages,
            chosen.bytes,
            counted(splats as u64, "splats"),
            counted(nodes as u64, "nodes")
        ));
        // A process may have no page of a file.
        if splats + nodes > 0 {
            objects.push(chosen.object);
        }
    }
    Ok(Read { objects, lines, tau_px, wanted_bytes })
}

impl Loaded {
    /// Nothing yet, within a ball.
    fn of_nothing(ball: Ball) -> Self {
        Self {
            scene: Scene::default(),
            ball,
            camera: None,
            picture: Default::default(),
            up: None,
            inputs: Vec::new(),
            steps: Vec::new(),
            hierarchies: Vec::new(),
            octrees: Octrees::default(),
        }
    }
}
