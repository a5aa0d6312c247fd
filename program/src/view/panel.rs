//! The panel, the keys and the messages over the picture. Everything in the panel can be done by keys, too.

use egui::{
    Align, Color32, ComboBox, Context, Grid, Id, Label, Layout, RichText, ScrollArea, Slider, Ui, Vec2,
};
use surfel::scene::{Layers, MOST_LAYERS, Settings, Tonemap};

use super::{
    bars::bars,
    history::History,
    keys::{Action, Cutting, Step},
    state::{Change, State},
    values,
};

/// White on nearly black, 15 to 1, whatever the picture is.
pub fn visuals() -> egui::Visuals {
    let mut visuals = egui::Visuals::dark();
    visuals.override_text_color = Some(Color32::from_gray(245));
    visuals.panel_fill = Color32::from_rgb(20, 20, 24);
    visuals.window_fill = visuals.panel_fill;
    visuals
}

/// How wide the panel is, whatever is in it.
const WIDTH: f32 = 330.0;
/// Lists are as tall as the longest of them, and as wide as its longest value.
const LIST: f32 = 400.0;
const LIST_WIDTH: f32 = 180.0;
/// Columns of the passes and their times.
const COLUMNS: [f32; 3] = [160.0, 72.0, 60.0];

/// How much of a window's width the panel leaves; all of it where that is less than a half.
pub fn beside_px(window_px: u32, px_a_point: f32) -> u32 {
    let panel_px = (WIDTH * px_a_point).ceil() as u32;
    if window_px / 2 > panel_px { window_px - panel_px } else { window_px }
}

/// The panel.
pub fn show(context: &Context, state: &State, history: &History, changes: &mut Vec<Change>) {
    egui::SidePanel::right("panel").exact_width(WIDTH).resizable(false).show(context, |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.heading("Scene");
            scene(ui, state, changes);
            ui.separator();
            ui.heading("Method");
            method(ui, state, changes);
            ui.separator();
            cuts(ui, changes);
            ui.separator();
            ui.heading("Light");
            light(ui, state, changes);
            ui.separator();
            ui.heading("Cost");
            cost(ui, history);
            ui.separator();
            Grid::new("facts").num_columns(2).show(ui, |ui| {
                for (name, value) in &state.facts {
                    ui.label(*name);
                    // What is too long for it is seen under the cursor.
                    ui.add(Label::new(value).truncate());
                    ui.end_row();
                }
            });
        });
    });
}

fn scene(ui: &mut Ui, state: &State, changes: &mut Vec<Change>) {
    for (number, (name, kind)) in state.things.iter().enumerate() {
        let Some((mut seen, mut alpha)) = state.edits.things.get(number).copied() else { continue };
        let chosen = state.things.len() > 1 && number == state.thing;
        let name = if chosen { RichText::new(name).underline() } else { RichText::new(name) };
        let mut changed = ui.checkbox(&mut seen, name).on_hover_text(kind).changed();
        // Taken when it is let go: the scene goes to the device again.
        let key = Id::new(("alpha", number));
        let dragged: Option<f32> = ui.data(|data| data.get_temp(key));
        let mut shown = dragged.unwrap_or(alpha);
        ui.horizontal(|ui| {
            ui.add_space(22.0);
            let slider = ui.add(percent(Slider::new(&mut shown, 0.05..=1.0)).text("of its alpha"));
            if slider.drag_stopped() || (slider.changed() && !slider.dragged()) {
                (alpha, changed) = (shown, true);
                ui.data_mut(|data| data.remove::<f32>(key));
            } else if slider.dragged() {
                ui.data_mut(|data| data.insert_temp(key, shown));
            }
        });
        if changed {
            let mut edits = state.edits.clone();
            edits.things[number] = (seen, alpha);
            changes.push(Change::Edits(edits));
        }
    }
    let key = Id::new("splat scale");
    let dragged: Option<f32> = ui.data(|data| data.get_temp(key));
    let mut scale = dragged.unwrap_or(state.edits.splat_scale);
    let slider =
        ui.add(Slider::new(&mut scale, 0.1..=10.0).logarithmic(true).max_decimals(2).text("splat scale"));
    if slider.drag_stopped() || (slider.changed() && !slider.dragged()) {
        changes.push(Change::SplatScale(scale));
        ui.data_mut(|data| data.remove::<f32>(key));
    } else if slider.dragged() {
        ui.data_mut(|data| data.insert_temp(key, scale));
    }
}

fn method(ui: &mut Ui, state: &State, changes: &mut Vec<Change>) {
    Grid::new("method").num_columns(2).show(ui, |ui| {
        for setting in values::IN_PANEL.iter().filter_map(|name| values::setting(name)) {
            let now = (setting.get)(&state.settings);
            ui.label(setting.name).on_hover_text(setting.help.trim());
            let drawn = state.drawn_edges.filter(|_| setting.name == "edges");
            let shown = drawn.map_or(now.clone(), |drawn| format!("{now} ({drawn} here)"));
            let list =
                ComboBox::from_id_salt(setting.name).selected_text(shown).height(LIST).width(LIST_WIDTH);
            let list = list.show_ui(ui, |ui| {
                for value in values::values(setting) {
                    let help = setting.choices.iter().find(|choice| choice.name == value);
                    let label = ui.selectable_label(now == value, value);
                    let label = help.map_or(label.clone(), |choice| label.on_hover_text(choice.help.trim()));
                    if label.clicked() {
                        changes.extend(values::with(&state.settings, setting, value).map(Change::Settings));
                    }
                }
            });
            changes.extend(
                step(ui, &list.response).map(|step| Change::Act(Action::Setting(setting.name, step))),
            );
            ui.end_row();
        }
    });
    let (Layers::Fixed(now) | Layers::Auto(now)) = state.settings.layers;
    let mut layers = now;
    ui.add(Slider::new(&mut layers, 1..=MOST_LAYERS.min(32)).text("layers"));
    if layers != now {
        let layers = match state.settings.layers {
            Layers::Fixed(_) => Layers::Fixed(layers),
            Layers::Auto(_) => Layers::Auto(layers),
        };
        changes.push(Change::Settings(Settings { layers, ..state.settings.clone() }));
    }
}

/// Which value an arrow asks for, of a list that has the keyboard.
fn step(ui: &Ui, list: &egui::Response) -> Option<Step> {
    if !list.has_focus() {
        return None;
    }
    let arrows = egui::EventFilter { horizontal_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(list.id, arrows));
    let steps = [(egui::Key::ArrowRight, Step::Next), (egui::Key::ArrowLeft, Step::Before)];
    steps.into_iter().find_map(|(key, step)| ui.input(|input| input.key_pressed(key)).then_some(step))
}

fn cuts(ui: &mut Ui, changes: &mut Vec<Change>) {
    const ACTIONS: [(&str, Action); 5] = [
        ("plane", Action::Cut(Cutting::Plane)),
        ("box", Action::Cut(Cutting::Box)),
        ("deeper", Action::Cut(Cutting::More)),
        ("less", Action::Cut(Cutting::Less)),
        ("reset all", Action::Reset),
    ];
    ui.horizontal(|ui| {
        ui.label("cut by");
        for (name, action) in ACTIONS {
            if ui.button(name).clicked() {
                changes.push(Change::Act(action));
            }
        }
    });
}

fn light(ui: &mut Ui, state: &State, changes: &mut Vec<Change>) {
    let mut stops = state.encoding.exposure.0;
    if ui.add(Slider::new(&mut stops, -8.0..=8.0).max_decimals(2).text("exposure, stops")).changed() {
        changes.push(Change::Exposure(stops));
    }
    ui.horizontal(|ui| {
        for (name, tonemap) in Tonemap::NAMES {
            if ui.selectable_label(state.encoding.tonemap == *tonemap, *name).clicked() {
                changes.push(Change::Tonemap(*tonemap));
            }
        }
        ui.label("tone curve");
    });
}

/// Shares in percent.
fn percent(slider: Slider<'_>) -> Slider<'_> {
    slider.custom_formatter(|share, _| format!("{:.0}%", 100.0 * share)).custom_parser(|text| {
        text.trim().trim_end_matches('%').parse::<f64>().ok().map(|percent| percent / 100.0)
    })
}

fn cost(ui: &mut Ui, history: &History) {
    let most = bars(ui, Vec2::new(ui.available_width(), 48.0), &history.frames);
    if let Some(last) = history.frames.back() {
        ui.add(Label::new(format!("frame {last:.2} ms; the tallest {most:.2} ms")).truncate());
    }
    // Not a grid: that knows how wide its columns are only a frame after their texts have come.
    for (name, times) in history.passes() {
        ui.horizontal(|ui| {
            let ms = times.back().map_or(String::new(), |ms| format!("{ms:.3} ms"));
            let texts = [name.to_owned(), ms];
            for (text, width) in texts.into_iter().zip(COLUMNS) {
                let left = Layout::left_to_right(Align::Center);
                let size = Vec2::new(width, ui.spacing().interact_size.y);
                ui.allocate_ui_with_layout(size, left, |ui| {
                    ui.set_min_width(width);
                    ui.add(Label::new(text).truncate());
                });
            }
            bars(ui, Vec2::new(COLUMNS[2], 14.0), times);
        });
    }
}

#[cfg(test)]
mod tests;
