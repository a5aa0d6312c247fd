//! Events of the window: mouse and keyboard.

use std::time::{Duration, Instant};

use surfel::Result;
use winit::{
    event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent},
    keyboard::{Key, KeyCode, ModifiersState, NamedKey, PhysicalKey},
};

use super::{keys, viewer::Viewer};

/// Clicks that follow each other so soon, and so near, are one double click.
const DOUBLE_CLICK: (Duration, f64) = (Duration::from_millis(400), 5.0);
/// Radii of the scene in a second.
const FLIGHT_SPEED: f64 = 0.7;

/// What is held and where the cursor is.
#[derive(Default)]
pub struct Input {
    pub cursor: [f64; 2],
    modifiers: ModifiersState,
    dragged: Option<Drag>,
    last_click: Option<(Instant, [f64; 2])>,
    /// Keys that fly: right, up, forward.
    held: Vec<(KeyCode, [f64; 3])>,
    flown: Option<Instant>,
}

#[derive(Clone, Copy, PartialEq)]
enum Drag {
    Orbit,
    Pan,
    Split,
}

impl Input {
    /// Whether a key is held that flies.
    pub fn flies(&self) -> bool {
        !self.held.is_empty()
    }
}

impl Viewer {
    /// An event of the window.
    ///
    /// # Errors
    /// As [`Viewer::redraw`].
    pub fn event(&mut self, event: WindowEvent) -> Result<()> {
        match event {
            WindowEvent::CloseRequested => self.ends = true,
            WindowEvent::RedrawRequested => return self.redraw(),
            WindowEvent::Resized(size) => {
                self.gpu.resize([size.width, size.height]);
                // A hand on the window's edge goes on moving it.
                self.moved();
            }
            WindowEvent::ScaleFactorChanged { scale_factor, .. } => {
                self.ui.rescale(scale_factor as f32);
                self.changed();
            }
            WindowEvent::ModifiersChanged(modifiers) => self.input.modifiers = modifiers.state(),
            WindowEvent::Focused(false) => {
                // What is released elsewhere is not heard of.
                (self.input.dragged, self.input.flown) = (None, None);
                self.input.held.clear();
            }
            WindowEvent::Occluded(false) => self.changed(),
            WindowEvent::DroppedFile(path) => {
                if self.reads_first {
                    let name = surfel::load::file_name(&path);
                    self.ui.tell(&format!("{name} comes once the first files are read"));
                    self.window.request_redraw();
                }
                self.files.drop_one(path);
            }
            WindowEvent::CursorMoved { position, .. } => self.cursor([position.x, position.y]),
            WindowEvent::CursorLeft { .. } => {
                self.ui.pointer_left();
                self.window.request_redraw();
            }
            WindowEvent::MouseInput { state, button, .. } => self.button(button, state)?,
            WindowEvent::MouseWheel { delta, .. } => self.wheel(delta)?,
            WindowEvent::PinchGesture { delta, .. } => self.zoom(-delta)?,
            WindowEvent::KeyboardInput { event, .. } => {
                let pressed = event.state == ElementState::Pressed;
                if pressed {
                    self.catch_up()?;
                }
                let is_written = self.ui.key(&event, self.input.modifiers);
                if !is_written || !pressed {
                    self.hold(event.physical_key, pressed);
                }
                if is_written {
                    self.window.request_redraw();
                } else if pressed
                    && !event.repeat
                    && let Some(key) = self.name(&event.logical_key)
                {
                    self.key(&key)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// What lies over the picture sees what came before a press: it takes two presses of one frame for one, and what is hidden sees nothing.
    fn catch_up(&mut self) -> Result<()> {
        if !self.ui.events.is_empty() {
            self.run_ui()?;
        }
        Ok(())
    }

    fn cursor(&mut self, to: [f64; 2]) {
        let from = std::mem::replace(&mut self.input.cursor, to);
        let by = [to[0] - from[0], to[1] - from[1]];
        let window_px = self.window_px();
        self.ui.pointer_moved(to);
        if self.ui.is_shown() {
            self.window.request_redraw();
        }
        match self.input.dragged {
            Some(Drag::Split) => {
                self.split = (to[0] / f64::from(window_px[0])).clamp(0.0, 1.0) as f32;
                self.window.request_redraw();
            }
            Some(drag) => {
                let Some(navigation) = &mut self.navigation else { return };
                if drag == Drag::Orbit {
                    navigation.orbit(by, window_px);
                } else {
                    navigation.pan(by, window_px);
                }
                self.moved();
            }
            None => {}
        }
    }

    fn button(&mut self, button: MouseButton, state: ElementState) -> Result<()> {
        let (pressed, cursor) = (state == ElementState::Pressed, self.input.cursor);
        let shift = self.input.modifiers.shift_key();
        if pressed {
            self.catch_up()?;
        }
        if self.ui.pointer_button(cursor, button, pressed) {
            self.window.request_redraw();
            return Ok(());
        }
        if !pressed {
            let drags = self.input.dragged.take().is_some();
            if drags && !self.pace.waits() && self.moved.take().is_some() {
                // The hand is off: what it moved rests.
                self.window.request_redraw();
            }
            return Ok(());
        }
        let split_px = self.split * self.window_px()[0] as f32;
        let is_at_split = self.comparing == Some(keys::Comparing::Split)
            && (cursor[0] - f64::from(split_px)).abs() < 8.0 * self.window.scale_factor();
        self.input.dragged = match button {
            MouseButton::Left if is_at_split => Some(Drag::Split),
            MouseButton::Left if !shift => Some(Drag::Orbit),
            MouseButton::Left | MouseButton::Right | MouseButton::Middle => Some(Drag::Pan),
            _ => None,
        };
        if button == MouseButton::Left {
            let now = Instant::now();
            let (within, near) = DOUBLE_CLICK;
            let is_second = self.input.last_click.is_some_and(|(when, at)| {
                now - when < within && (at[0] - cursor[0]).hypot(at[1] - cursor[1]) < near
            });
            self.input.last_click = (!is_second).then_some((now, cursor));
            if is_second {
                return self.set_pivot();
            }
        }
        Ok(())
    }

    fn wheel(&mut self, delta: MouseScrollDelta) -> Result<()> {
        const PX_A_LINE: f64 = 40.0;
        let lines = match delta {
            MouseScrollDelta::LineDelta(_, y) => f64::from(y),
            MouseScrollDelta::PixelDelta(px) => px.y / PX_A_LINE,
        };
        if self.ui.wheel(lines as f32) {
            self.window.request_redraw();
            return Ok(());
        }
        self.zoom(-0.15 * lines)
    }

    /// Keys that fly, by their place on the keyboard.
    fn hold(&mut self, key: PhysicalKey, pressed: bool) {
        let PhysicalKey::Code(code) = key else { return };
        let direction = match code {
            KeyCode::KeyD => [1.0, 0.0, 0.0],
            KeyCode::KeyA => [-1.0, 0.0, 0.0],
            KeyCode::KeyE => [0.0, -1.0, 0.0],
            KeyCode::KeyQ => [0.0, 1.0, 0.0],
            KeyCode::KeyW => [0.0, 0.0, 1.0],
            KeyCode::KeyS => [0.0, 0.0, -1.0],
            _ => return,
        };
        let modifiers = self.input.modifiers;
        self.input.held.retain(|(held, _)| *held != code);
        if pressed && !modifiers.control_key() && !modifiers.alt_key() && !modifiers.super_key() {
            self.input.held.push((code, direction));
            self.window.request_redraw();
        }
        if !self.input.flies() {
            self.input.flown = None;
        }
    }

    /// Flies on, as long as it took since the last time.
    pub fn fly(&mut self) {
        let now = Instant::now();
        if !self.input.flies() {
            return;
        }
        let secs = self.input.flown.map_or(0.0, |flown| (now - flown).as_secs_f64()).min(0.2);
        self.input.flown = Some(now);
        let faster = if self.input.modifiers.shift_key() { 4.0 } else { 1.0 };
        let sum = self.input.held.iter().fold([0.0; 3], |sum, (_, by)| [0, 1, 2].map(|i| sum[i] + by[i]));
        if let Some(navigation) = self.navigation.as_mut().filter(|_| secs > 0.0) {
            navigation.fly(sum.map(|part| part * secs * FLIGHT_SPEED * faster));
            self.moved();
        }
    }

    /// A key as the table has it.
    fn name(&self, key: &Key) -> Option<String> {
        let name = match key {
            Key::Character(character) => character.to_string(),
            Key::Named(NamedKey::Space) => "Space".to_owned(),
            Key::Named(NamedKey::Escape) => "Escape".to_owned(),
            Key::Named(NamedKey::Enter) => "Enter".to_owned(),
            Key::Named(NamedKey::Backspace) => "Backspace".to_owned(),
            Key::Named(NamedKey::F1) => "F1".to_owned(),
            Key::Named(NamedKey::F5) => "F5".to_owned(),
            _ => return None,
        };
        let modifiers = self.input.modifiers;
        if modifiers.alt_key() || modifiers.super_key() {
            return None;
        }
        Some(if modifiers.control_key() { format!("Ctrl+{}", name.to_lowercase()) } else { name })
    }
}
