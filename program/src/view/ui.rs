//! What lies over the picture, and its events: egui, which runs only while there is something of it to see.

use std::{
    collections::VecDeque,
    time::{Duration, Instant},
};

use egui::{Event, PointerButton, Popup, Pos2, RawInput, Rect, ViewportId};
use surfel::Result;
use winit::{
    event::{ElementState, KeyEvent, MouseButton},
    keyboard::{Key, ModifiersState, NamedKey},
};

use super::{
    compared::labels,
    history::History,
    keys::Comparing,
    overlay::OverlayFrame,
    panel, popups,
    state::{Change, State},
    viewer::Viewer,
};

/// Messages are seen for so long.
const MESSAGE: Duration = Duration::from_secs(4);
/// The most messages at once.
const MOST_MESSAGES: usize = 6;

/// What lies over the picture.
pub struct Ui {
    context: egui::Context,
    pub(super) px_a_point: f32,
    /// What it has not seen yet.
    pub(super) events: Vec<Event>,
    pointer: Pos2,
    /// A button was pressed over it, and is not released yet.
    is_pressed: bool,
    has_panel: bool,
    /// Keys are the panel's, by the events that it has been told of, seen by it or not.
    has_keyboard: bool,
    has_keys: bool,
    messages: VecDeque<(Instant, String)>,
    started: Instant,
    wakes: Option<Instant>,
    is_compiling: bool,
    /// What is being read.
    pub reading: Option<String>,
    /// What frames have cost.
    pub history: History,
}

impl Ui {
    /// Nothing but what is read.
    pub fn new(px_a_point: f32) -> Self {
        let context = egui::Context::default();
        context.set_visuals(panel::visuals());
        Self {
            context,
            px_a_point,
            events: Vec::new(),
            pointer: Pos2::ZERO,
            is_pressed: false,
            has_panel: false,
            has_keyboard: false,
            has_keys: false,
            messages: VecDeque::new(),
            started: Instant::now(),
            wakes: None,
            is_compiling: false,
            reading: Some("reading".to_owned()),
            history: History::default(),
        }
    }

    /// The monitor has so many pixels a point.
    pub fn rescale(&mut self, px_a_point: f32) {
        self.px_a_point = px_a_point;
    }

    /// Shows a message for a while.
    pub fn tell(&mut self, text: &str) {
        self.messages.push_back((Instant::now() + MESSAGE, text.to_owned()));
        while self.messages.len() > MOST_MESSAGES {
            self.messages.pop_front();
        }
    }

    /// Pipelines are being made, or not; whether that is new.
    pub fn set_compiling(&mut self, is_compiling: bool) -> bool {
        std::mem::replace(&mut self.is_compiling, is_compiling) != is_compiling
    }

    /// Shows or hides the panel.
    pub fn toggle_panel(&mut self) {
        self.has_panel = !self.has_panel;
        Popup::close_all(&self.context);
    }

    /// Shows or hides the keys.
    pub fn toggle_keys(&mut self) {
        self.has_keys = !self.has_keys;
    }

    /// Closes the list that is open; without one, hides all of it.
    pub fn close(&mut self) {
        if self.has_panel && Popup::is_any_open(&self.context) {
            Popup::close_all(&self.context);
            return;
        }
        (self.has_panel, self.has_keys) = (false, false);
        self.messages.clear();
    }

    /// Whether there is anything of it to see.
    pub fn is_shown(&self) -> bool {
        let is_busy = self.reading.is_some() || self.is_compiling;
        self.has_panel || self.has_keys || !self.messages.is_empty() || is_busy
    }

    /// Whether passes are to be timed.
    pub fn shows_times(&self) -> bool {
        self.has_panel
    }

    /// When it changes without an event.
    pub fn next_wake(&self) -> Option<Instant> {
        let message = self.messages.front().map(|(until, _)| *until);
        [message, self.wakes].into_iter().flatten().min()
    }

    /// The pointer has moved to a pixel.
    pub fn pointer_moved(&mut self, [x, y]: [f64; 2]) {
        self.pointer = Pos2::new(x as f32, y as f32) / self.px_a_point;
        self.event(Event::PointerMoved(self.pointer));
    }

    /// The pointer has left the window.
    pub fn pointer_left(&mut self) {
        self.event(Event::PointerGone);
    }

    /// A button; whether it is for what lies over the picture.
    pub fn pointer_button(&mut self, at: [f64; 2], button: MouseButton, pressed: bool) -> bool {
        let button = match button {
            MouseButton::Left => PointerButton::Primary,
            MouseButton::Right => PointerButton::Secondary,
            MouseButton::Middle => PointerButton::Middle,
            _ => return false,
        };
        let is_mine = if pressed { self.is_over() } else { self.is_pressed };
        self.is_pressed = pressed && is_mine;
        self.pointer_moved(at);
        if is_mine {
            let modifiers = egui::Modifiers::default();
            self.event(Event::PointerButton { pos: self.pointer, button, pressed, modifiers });
        }
        is_mine
    }

    /// The wheel, in lines; whether it is for what lies over the picture.
    pub fn wheel(&mut self, lines: f32) -> bool {
        if !self.is_over() {
            return false;
        }
        let (unit, modifiers) = (egui::MouseWheelUnit::Line, egui::Modifiers::default());
        self.event(Event::MouseWheel { unit, delta: egui::vec2(0.0, lines), modifiers });
        true
    }

    /// A key; whether it is for what lies over the picture: the panel has those that follow Tab, until Escape.
    pub fn key(&mut self, event: &KeyEvent, modifiers: ModifiersState) -> bool {
        let is_command = modifiers.control_key() || modifiers.alt_key() || modifiers.super_key();
        let enters = event.logical_key == Key::Named(NamedKey::Tab);
        if !self.has_panel || is_command || !(enters || self.has_keyboard) {
            return false;
        }
        let pressed = event.state == ElementState::Pressed;
        let named = match &event.logical_key {
            Key::Named(NamedKey::Space) => Some(egui::Key::Space),
            Key::Named(NamedKey::ArrowUp) => Some(egui::Key::ArrowUp),
            Key::Named(NamedKey::ArrowDown) => Some(egui::Key::ArrowDown),
            Key::Named(NamedKey::Enter) => Some(egui::Key::Enter),
            Key::Named(NamedKey::Escape) => Some(egui::Key::Escape),
            Key::Named(NamedKey::Tab) => Some(egui::Key::Tab),
            Key::Named(NamedKey::Backspace) => Some(egui::Key::Backspace),
            Key::Named(NamedKey::Delete) => Some(egui::Key::Delete),
            Key::Named(NamedKey::ArrowLeft) => Some(egui::Key::ArrowLeft),
            Key::Named(NamedKey::ArrowRight) => Some(egui::Key::ArrowRight),
            _ => None,
        };
        self.has_keyboard = !(pressed && named == Some(egui::Key::Escape));
        if let Some(key) = named {
            let modifiers = egui::Modifiers { shift: modifiers.shift_key(), ..Default::default() };
            self.event(Event::Key { key, physical_key: None, pressed, repeat: event.repeat, modifiers });
        } else if let (true, Some(text)) = (pressed, &event.text) {
            self.event(Event::Text(text.to_string()));
        }
        true
    }

    fn is_over(&self) -> bool {
        self.is_shown() && self.context.is_pointer_over_area()
    }

    fn event(&mut self, event: Event) {
        // Without anything to see nobody takes them.
        if self.is_shown() {
            self.events.push(event);
        }
    }

    /// Runs it for a frame: its triangles, its textures, and what is to be changed.
    fn run(
        &mut self,
        window_px: [u32; 2],
        state: &State,
    ) -> (OverlayFrame, egui::TexturesDelta, Vec<Change>) {
        let now = Instant::now();
        self.messages.retain(|(until, _)| *until > now);
        let px_a_point = self.px_a_point;
        self.context.set_pixels_per_point(px_a_point);
        let size = egui::vec2(window_px[0] as f32, window_px[1] as f32) / px_a_point;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, size)),
            time: Some((now - self.started).as_secs_f64()),
            events: std::mem::take(&mut self.events),
            focused: true,
            ..RawInput::default()
        };
        let mut changes = Vec::new();
        let texts: Vec<&str> = self.messages.iter().map(|(_, text)| text.as_str()).collect();
        let output = self.context.run(input, |context| {
            if self.has_panel {
                panel::show(context, state, &self.history, &mut changes);
            }
            if self.has_keys {
                popups::keys(context);
            }
            let compiling = self.is_compiling.then_some("compiling shaders");
            popups::messages(context, self.reading.as_deref().or(compiling), &texts);
            if let Some((how, names)) = &state.compared {
                match (how, &labels(*how, names)[..]) {
                    (Comparing::Difference, [(_, label)]) => popups::color_bar(context, label),
                    (_, labels) => popups::compared(context, labels),
                }
            }
        });
        self.has_keyboard = self.context.wants_keyboard_input();
        let delay = output.viewport_output.get(&ViewportId::ROOT).map(|output| output.repaint_delay);
        self.wakes = delay.filter(|delay| *delay < Duration::from_secs(60)).map(|delay| now + delay);
        let primitives = self.context.tessellate(output.shapes, output.pixels_per_point);
        let frame = OverlayFrame { primitives, px_a_point: output.pixels_per_point };
        (frame, output.textures_delta, changes)
    }
}

impl Viewer {
    /// What lies over the picture of this frame; nothing, mostly. What it changes is changed.
    ///
    /// # Errors
    /// Of the device.
    pub fn run_ui(&mut self) -> Result<Option<OverlayFrame>> {
        if !self.ui.is_shown() && self.comparing.is_none() {
            // What was to be drawn again is not there any more.
            self.ui.wakes = None;
            return Ok(None);
        }
        let state = State::of(self);
        let window_px = self.window_px();
        let (frame, textures, changes) = self.ui.run(window_px, &state);
        self.gpu.update_overlay(&textures)?;
        changes.into_iter().try_for_each(|change| self.change(change))?;
        Ok(Some(frame))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escape_closes_an_open_list_before_the_panel() {
        let mut ui = Ui::new(1.0);
        ui.toggle_panel();
        Popup::open_id(&ui.context, egui::Id::new("list"));
        ui.close();
        assert!(ui.has_panel && !Popup::is_any_open(&ui.context));
        ui.close();
        assert!(!ui.has_panel);
        // A panel that is hidden with its list comes back without.
        ui.toggle_panel();
        Popup::open_id(&ui.context, egui::Id::new("list"));
        ui.toggle_panel();
        assert!(!Popup::is_any_open(&ui.context));
    }
}
