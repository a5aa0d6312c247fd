//! Inputs that are octrees of points (COPC, Potree 2): opened with the scene, and read when the view is known.
//!
//! A view reads the nodes that may be in it, down to the level whose points are at most τ apart on the screen ([`Lod`]): from there on no filter tells more
//! points from fewer. What is read becomes splats as all points do, whose radii follow from how dense the points are.

use surfel::{
    Progress as _, Result,
    compose::make_loaded,
    levels_file::PageView,
    load::{NodeKey, ObjectDescription, PointOctree, file_name, is_point_octree},
    notes::counted,
    report::{InputReport, ModelReport},
    scene::{Budget, Camera, Lod, Scene, Settings},
};

use crate::{
    console::{self, Bars},
    hierarchies::megabytes,
    inputs::Inputs,
    scene::refuse_losses,
};

/// Octrees, and how their points are to be taken.
#[derive(Default)]
pub struct Octrees {
    pub files: Vec<PointOctree>,
    inputs: Inputs,
    /// Objects of the scene, and reports, that are none of theirs; once something is read.
    others: Option<[usize; 2]>,
}

/// The bytes of a point on its way to be a splat, at the height of the work.
const BYTES_PER_POINT: u64 = 300;

/// By so much τ changes from one try to the next, for a budget.
const STEP: f64 = 1.09;

/// The largest size that is tried where memory is short, in pixels, and the smallest where a budget is not spent.
const SIZES_PX: [f64; 2] = [1e6, 1.0 / 64.0];

impl Octrees {
    /// Opens those of some inputs; the other inputs.
    ///
    /// # Errors
    /// As [`PointOctree::open`].
    pub fn open(inputs: &Inputs) -> Result<(Self, Inputs)> {
        let (octrees, files): (Vec<_>, Vec<_>) =
            inputs.files.iter().cloned().partition(|path| is_point_octree(path));
        let files_of = octrees.iter().map(|path| PointOctree::open(path, &inputs.options));
        let others = Inputs { files, ..inputs.clone() };
        Ok((Self { files: files_of.collect::<Result<_>>()?, inputs: inputs.clone(), others: None }, others))
    }

    /// What they hold, in numbers and words.
    pub fn reports(&self) -> impl Iterator<Item = InputReport> {
        self.files.iter().map(report)
    }

    /// How many points they say there are.
    pub fn points(&self) -> u64 {
        self.files.iter().map(PointOctree::points).sum()
    }

    /// Reads what a view needs of each, in the place of what was read before, within so much memory; the bytes that it takes of that. `reports` are those of all inputs, of
    /// which the last ones are theirs.
    ///
    /// # Errors
    /// Of the files; with `strict`, what is not drawn as they say it.
    pub fn read(
        &mut self,
        scene: &mut Scene,
        reports: &mut Vec<InputReport>,
        (camera, settings): (&Camera, &Settings),
        most_bytes: Option<u64>,
        bars: &Bars,
    ) -> Result<u64> {
        let own = [scene.objects.len(), reports.len().saturating_sub(self.files.len())];
        let [objects, inputs] = *self.others.get_or_insert(own);
        scene.objects.truncate(objects);
        reports.truncate(inputs);
        let (all, mut taken) = (self.points(), 0_u64);
        for octree in &mut self.files {
            let share = |most: u64| (most as f64 * (octree.points() as f64 / all.max(1) as f64)) as u64;
            let nodes = choose(octree, (camera, settings), most_bytes.map(share))?;
            let (points, bytes) = octree.size_of(&nodes);
            taken = taken.saturating_add(points.saturating_mul(BYTES_PER_POINT));
            let name = file_name(octree.path());
            bars.note(&format!(
                "{name}: read {} nodes, {points} of {} points, {bytes} bytes",
                nodes.len(),
                octree.points()
            ));
            let loaded = octree.read(&nodes, bars)?;
            let Inputs { representation, samples, .. } = self.inputs;
            let object =
                ObjectDescription { representation, samples, ..ObjectDescription::of_file(octree.path()) };
            let built = make_loaded(loaded, &object, bars);
            bars.clear();
            let built = built?;
            bars.note(&built.report.summary);
            if self.inputs.strict {
                refuse_losses(&built.report)?;
            }
            reports.push(built.report);
            scene.objects.extend(built.splats);
        }
        Ok(taken)
    }
}

/// The nodes that a view needs.
fn choose(
    octree: &mut PointOctree,
    (camera, settings): (&Camera, &Settings),
    most_bytes: Option<u64>,
) -> Result<Vec<NodeKey>> {
    let view = PageView::new(camera, settings.size_px, 0.0);
    let mut at = |tau_px: f64| -> Result<_> {
        let view = view.with_tau(tau_px);
        let nodes = octree.choose(&|node| {
            // Disks reach beyond their box; and points above it, in the same places, are twice as far apart.
            let is_seen = || view.sees_box(node.center, node.half, 2.0 * node.spacing);
            tau_px == 0.0 || (is_seen() && view.may_be_long(2.0 * node.spacing, node.center, node.radius()))
        })?;
        let (points, _) = octree.size_of(&nodes);
        Ok((nodes, points))
    };
    let asked_px = if settings.lod == Lod::Auto { 1.0 } else { settings.tau_px() };
    let (mut nodes, mut points) = at(asked_px)?;
    let wanted_bytes = points.saturating_mul(BYTES_PER_POINT);
    let [largest_px, smallest_px] = SIZES_PX;
    let mut tau_px = asked_px;
    // What is smaller than a pixel is drawn where a budget allows it.
    while let (Budget::Splats(most), Lod::Auto) = (settings.budget, settings.lod)
        && points < most.into()
        && tau_px > smallest_px
    {
        tau_px /= STEP;
        (nodes, points) = at(tau_px)?;
    }
    while let Some(most) = most_bytes
        && points.saturating_mul(BYTES_PER_POINT) > most
        && tau_px < largest_px
    {
        tau_px = tau_px.max(smallest_px) * STEP;
        (nodes, points) = at(tau_px)?;
    }
    if tau_px > asked_px {
        console::say(&format!(
            "{}: --budget-memory does not suffice for --lod {asked_px:.3}px: read for --lod {tau_px:.3}px; --lod {asked_px:.3}px takes {}, {BYTES_PER_POINT} \
             bytes for each point on its way to the device",
            file_name(octree.path()),
            megabytes(wanted_bytes)
        ));
    }
    Ok(nodes)
}

fn report(octree: &PointOctree) -> InputReport {
    let name = file_name(octree.path());
    let count = usize::try_from(octree.points()).unwrap_or(usize::MAX);
    let bounds = octree.bounds();
    InputReport {
        vertices: None,
        triangles: None,
        splats: count,
        dropped: 0,
        drawn_as: "splats",
        because: "points become disks that close their surface".to_owned(),
        model: Some(ModelReport {
            format: octree.format().to_owned(),
            holds: "points",
            points: count,
            triangles: None,
            normals: false,
            colors: octree.has_colors(),
            sizes: false,
            bounds: Some([bounds.min.to_array(), bounds.max.to_array()]),
            metres_per_unit: octree.metres_per_unit(),
            up: Some([0.0, 0.0, 1.0]),
        }),
        notes: Vec::new(),
        summary: format!(
            "{name}: {} in an octree, {} apart at its root",
            counted(octree.points(), "points"),
            octree.spacing()
        ),
        name,
    }
}
