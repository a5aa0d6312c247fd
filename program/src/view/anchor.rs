//! What the wheel goes toward: the surface under the cursor. A pick of it is submitted and not waited for; steps that come meanwhile are made once it is done, and no
//! picture from where they lead could be there before: the device does one after the other.

use std::time::{Duration, Instant};

use glam::DVec3;
use surfel::{
    Result,
    frame::FrameSlot,
    passes::PickRay,
    scene::{Camera, Settings},
    vk::{Buffer, BufferDesc, CommandPool, MemoryUse},
};

use super::{device::is_device_lost, keys::Action, viewer::Viewer};

/// How soon the answer is looked for again.
const LOOK: Duration = Duration::from_millis(1);
/// The most that steps make of a distance while they wait, and the least, as a natural logarithm.
const MOST: f64 = 30.0;

/// What is under the cursor.
#[derive(Default)]
pub struct Anchor {
    /// Of a cursor and a camera, until something else is seen there; the wheel itself keeps it in its place.
    known: Option<(Seen, Option<DVec3>)>,
    asked: Option<Asked>,
    /// What steps wait for the answer, as a natural logarithm of distance.
    waits: f64,
    /// Keys that were pressed behind those.
    behind: Vec<Action>,
}

/// The cursor over a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    camera: Camera,
    cursor: [f64; 2],
    window_px: [u32; 2],
}

/// A pick that is under way, with all that it uses.
struct Asked {
    seen: Seen,
    ray: PickRay,
    answer: Buffer,
    epoch: u64,
    _slot: FrameSlot,
    _commands: CommandPool,
}

impl Anchor {
    /// The surface there, if that is known: `Some(None)` where there is none.
    fn known(&self, seen: &Seen) -> Option<Option<DVec3>> {
        self.known.as_ref().filter(|(known, _)| known == seen).map(|(_, surface)| *surface)
    }

    /// Something else may be seen now.
    pub fn forget(&mut self) {
        self.known = None;
        self.asked.take_if(|_| self.waits == 0.0);
    }

    /// Whether a key that was pressed behind steps waits with them: it may be of the camera.
    pub fn holds(&mut self, action: Action) -> bool {
        let holds = self.waits() && action != Action::Quit;
        if holds {
            self.behind.push(action);
        }
        holds
    }

    /// Whether steps wait for an answer.
    pub fn waits(&self) -> bool {
        self.asked.is_some() && self.waits != 0.0
    }

    /// When the answer is to be looked for.
    pub fn next_look(&self, now: Instant) -> Option<Instant> {
        self.asked.as_ref().map(|_| now + LOOK)
    }

    /// Whether a pick is under way of what is seen there; another one is of no use any more, unless steps wait for it.
    fn is_asked(&mut self, seen: &Seen) -> bool {
        if self.waits == 0.0 {
            self.asked.take_if(|asked| asked.seen != *seen);
        }
        self.asked.is_some()
    }
}

impl Viewer {
    /// Goes nearer to what is under the cursor, or away from it, by a natural logarithm of the distance.
    ///
    /// # Errors
    /// A lost device.
    pub fn zoom(&mut self, by: f64) -> Result<()> {
        let (Some(seen), true) = (self.seen(), by.is_finite()) else { return Ok(()) };
        let by = by.clamp(-2.0, 2.0);
        // Parallel rays have what is under the cursor at one place at any depth.
        let known = if seen.camera.is_orthographic() { Some(None) } else { self.anchor.known(&seen) };
        if let Some(surface) = known {
            self.zoom_toward(by, seen, surface);
            return Ok(());
        }
        // It moves already: pictures at rest wait for it.
        self.moved = Some(Instant::now());
        self.input_at = self.moved;
        if !self.anchor.is_asked(&seen) {
            self.ask(seen)?;
        }
        self.anchor.waits = (self.anchor.waits + by).clamp(-MOST, MOST);
        if self.anchor.asked.is_none() {
            self.go_on(seen, None);
        }
        Ok(())
    }

    /// Looks what is under the cursor while nothing else is to be done, so that the wheel need not wait for it, nor for pipelines.
    pub fn look_under_cursor(&mut self) {
        let Some(seen) = self.seen().filter(|seen| !seen.camera.is_orthographic()) else { return };
        if self.drawn.is_some() && self.anchor.known(&seen).is_none() && !self.anchor.is_asked(&seen) {
            // Errors, such as a lost device, come with the next frame, too.
            let _ = self.ask(seen);
        }
    }

    /// Makes the steps that wait, if the answer has come.
    ///
    /// # Errors
    /// A lost device.
    pub fn hear_anchor(&mut self) -> Result<()> {
        let Some(asked) = self.anchor.asked.take() else { return Ok(()) };
        if !self.gpu.headless.queue().is_done(asked.epoch)? {
            self.anchor.asked = Some(asked);
            return Ok(());
        }
        // SAFETY: its submission is done.
        let surface = asked.ray.read(unsafe { asked.answer.bytes() });
        if self.anchor.waits == 0.0 {
            self.anchor.known = Some((asked.seen, surface));
            return Ok(());
        }
        let input_at = self.input_at;
        self.go_on(asked.seen, surface);
        self.input_at = input_at.or(self.input_at);
        std::mem::take(&mut self.anchor.behind).into_iter().try_for_each(|action| self.act(action))
    }

    fn seen(&self) -> Option<Seen> {
        Some(Seen { camera: self.camera()?, cursor: self.input.cursor, window_px: self.window_px() })
    }

    fn go_on(&mut self, seen: Seen, surface: Option<DVec3>) {
        let by = std::mem::take(&mut self.anchor.waits);
        self.zoom_toward(by, seen, surface);
    }

    /// About a point that stays in its place, also where the camera has moved since it was seen.
    fn zoom_toward(&mut self, by: f64, seen: Seen, surface: Option<DVec3>) {
        let Some(navigation) = &mut self.navigation else { return };
        let is_there = navigation.camera == seen.camera;
        navigation.zoom(by.exp(), (seen.cursor, surface), seen.window_px);
        let seen = Seen { camera: navigation.camera, ..seen };
        self.anchor.known = is_there.then_some((seen, surface));
        self.moved();
    }

    /// Submits a pick of what is under the cursor; none where nothing is drawn.
    fn ask(&mut self, seen: Seen) -> Result<()> {
        match self.asked(seen) {
            Err(error) if is_device_lost(&error) => Err(error),
            // What can't be drawn can't be seen.
            asked => {
                self.anchor.asked = asked.ok().flatten();
                Ok(())
            }
        }
    }

    fn asked(&self, seen: Seen) -> Result<Option<Asked>> {
        let Some(prepared) = &self.prepared else { return Ok(None) };
        let (headless, size_px) = (&self.gpu.headless, seen.window_px);
        let settings = self.at_rest(&Settings { size_px, ..self.settings.clone() });
        let settings = prepared.pages().map_or(Some(settings.clone()), |pages| pages.now(&settings));
        let Some(settings) = settings else { return Ok(None) };
        let pixel = [0, 1].map(|i| (seen.cursor[i].max(0.0) as u32).min(size_px[i] - 1));
        let plan = headless.renderer.plan_pick(prepared.scene(), &seen.camera, &settings, pixel)?;
        let desc = BufferDesc {
            name: "read-back of what is under the cursor",
            size: plan.size_bytes(),
            usage: ash::vk::BufferUsageFlags::TRANSFER_DST,
        };
        let answer = Buffer::new(headless.device(), desc, MemoryUse::Readback)?;
        let mut slot = FrameSlot::new(headless.device());
        let pool = CommandPool::new(headless.device(), "what is under the cursor")?;
        // SAFETY: the pool is new.
        let commands = unsafe { pool.begin() }?;
        // SAFETY: recording; slot and buffer are new and kept until the answer is read; what is dropped before waits for its epoch.
        unsafe { headless.renderer.record_pick(commands, &mut slot, &plan, answer.raw()) }?;
        // SAFETY: recorded just now; as above.
        let epoch = unsafe { headless.queue().submit(pool.end()?) }?;
        let ray = plan.ray();
        Ok(Some(Asked { seen, ray, answer, epoch, _slot: slot, _commands: pool }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_is_of_one_cursor_and_one_camera() {
        let seen = Seen { camera: Camera::default(), cursor: [3.0, 4.0], window_px: [9; 2] };
        let mut anchor = Anchor { known: Some((seen, Some(DVec3::X))), ..Anchor::default() };
        assert_eq!(anchor.known(&seen), Some(Some(DVec3::X)));
        let camera = Camera { eye: DVec3::X, ..seen.camera };
        for other in
            [Seen { camera, ..seen }, Seen { cursor: [3.0, 5.0], ..seen }, Seen { window_px: [9, 8], ..seen }]
        {
            assert_eq!(anchor.known(&other), None);
        }
        anchor.forget();
        assert_eq!(anchor.known(&seen), None);
        // Without steps that wait, no key does.
        assert!(!anchor.holds(Action::Fit) && anchor.behind.is_empty());
    }
}
