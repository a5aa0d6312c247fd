//! What pops up over the picture: the keys, messages, the meaning of colors.

use egui::{Align2, Area, Color32, Context, Frame, Grid, Id, Label, Mesh, RichText, ScrollArea, Ui, Vec2};

use super::{
    keys::{BINDINGS, MOUSE},
    panel::visuals,
};

fn popup(context: &Context, name: &str, (align, offset): (Align2, [f32; 2]), add: impl FnOnce(&mut Ui)) {
    let frame = Frame::popup(&context.style()).fill(visuals().panel_fill);
    let (id, size) = (Id::new(name), |rect: egui::Rect| rect.size().round());
    let before = context.memory(|memory| memory.area_rect(id)).map(size);
    let area = Area::new(id).anchor(align, Vec2::from(offset)).constrain(true);
    let shown = area.show(context, |ui| frame.show(ui, add));
    if before != Some(size(shown.response.rect)) {
        // It was put where one of the size before has room: once more, before it is seen.
        context.request_discard("what pops up has another size");
    }
}

/// All keys, in as many columns as there is room for; whether they have it from left to right.
pub fn keys(context: &Context) -> bool {
    const COLUMN_POINTS: f32 = 480.0;
    let size = context.content_rect().size();
    let columns = ((size.x / COLUMN_POINTS) as usize).clamp(1, 3);
    let mut has_room = false;
    popup(context, "keys", (Align2::CENTER_CENTER, [0.0; 2]), |ui| {
        ui.set_max_size(size - Vec2::splat(60.0));
        // Beside what it scrolls, not over it.
        ui.spacing_mut().scroll = egui::style::ScrollStyle::solid();
        let shown = ScrollArea::both().show(ui, |ui| {
            let of_keys = BINDINGS.iter().map(|binding| (binding.key, binding.help));
            let lines: Vec<(&str, &str)> = MOUSE.iter().copied().chain(of_keys).collect();
            let rows = lines.len().div_ceil(columns);
            Grid::new("keys").num_columns(2 * columns).spacing([12.0, 3.0]).show(ui, |ui| {
                for row in 0..rows {
                    for (key, help) in lines.iter().skip(row).step_by(rows) {
                        ui.add(Label::new(RichText::new(*key).strong()).extend());
                        ui.add(Label::new(*help).extend());
                    }
                    ui.end_row();
                }
            });
        });
        has_room = shown.content_size.x <= shown.inner_rect.width();
    });
    has_room
}

/// What is being read, and messages.
pub fn messages(context: &Context, reading: Option<&str>, texts: &[&str]) {
    const MOST_POINTS: f32 = 560.0;
    if reading.is_none() && texts.is_empty() {
        return;
    }
    let width = (context.content_rect().width() - 48.0).clamp(1.0, MOST_POINTS);
    popup(context, "messages", (Align2::LEFT_BOTTOM, [12.0, -12.0]), |ui| {
        ui.set_width(width);
        for text in texts.iter().copied().chain(reading) {
            ui.label(text);
        }
    });
}

/// Which of two pictures is where.
pub fn compared(context: &Context, labels: &[(Align2, String)]) {
    for (number, (align, text)) in labels.iter().enumerate() {
        let inward = -align.to_sign().x;
        // Beside the panel, not below it.
        let panel = context.content_rect().right() - context.available_rect().right();
        let x = 12.0 * inward - 0.5 * (1.0 - inward) * panel;
        // Beside each other, or as wide as the window.
        let width = context.available_rect().width() / labels.len() as f32 - 48.0;
        popup(context, &format!("compared {number}"), (*align, [x, 12.0]), |ui| {
            ui.set_max_width(width.max(1.0));
            ui.label(text);
        });
    }
}

/// Which pictures differ, and what the colors of differences mean, in steps of 8 bits: those of `glsl/view_show.frag.glsl`.
pub fn color_bar(context: &Context, label: &str) {
    const RAMP: [Color32; 6] = [
        Color32::BLACK,
        Color32::from_rgb(0, 0, 255),
        Color32::from_rgb(0, 255, 255),
        Color32::from_rgb(255, 255, 0),
        Color32::from_rgb(255, 0, 0),
        Color32::WHITE,
    ];
    popup(context, "color bar", (Align2::CENTER_TOP, [0.0, 12.0]), |ui| {
        ui.add(Label::new(label).extend());
        ui.add(Label::new("difference, in steps of 8 bits").extend());
        let (response, painter) = ui.allocate_painter(Vec2::new(270.0, 34.0), egui::Sense::hover());
        let bar = response.rect.shrink2(Vec2::new(10.0, 0.0));
        let mut mesh = Mesh::default();
        for (number, color) in RAMP.iter().enumerate() {
            let x = bar.left() + bar.width() * number as f32 / 5.0;
            mesh.colored_vertex(egui::pos2(x, bar.top()), *color);
            mesh.colored_vertex(egui::pos2(x, bar.top() + 16.0), *color);
            if number > 0 {
                let at = 2 * number as u32;
                mesh.add_triangle(at - 2, at - 1, at);
                mesh.add_triangle(at - 1, at, at + 1);
            }
            // The ramp goes by the logarithm of one more than the steps, 33 at its end.
            let text = format!("{:.0}", 33_f32.powf(number as f32 / 5.0) - 1.0);
            let (font, white) = (egui::FontId::default(), Color32::WHITE);
            painter.text(egui::pos2(x, bar.bottom()), Align2::CENTER_BOTTOM, text, font, white);
        }
        painter.add(mesh);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_lie_within_the_window_from_the_first_frame_on() {
        let context = Context::default();
        let rect = egui::Rect::from_min_size(egui::Pos2::ZERO, Vec2::new(600.0, 450.0));
        let mut texts = Vec::new();
        for number in 0..9 {
            texts.push("place 1 of the path");
            let input = egui::RawInput { screen_rect: Some(rect), ..Default::default() };
            let output = context.run(input, |context| messages(context, None, &texts));
            let lines = output.shapes.iter().filter(|clipped| matches!(clipped.shape, egui::Shape::Text(_)));
            let places: Vec<_> = lines.map(|clipped| clipped.shape.visual_bounding_rect()).collect();
            let bottom = places.iter().map(|place| place.bottom()).fold(0.0, f32::max);
            assert_eq!(places.len(), number + 1);
            assert!((410.0..436.0).contains(&bottom), "{number}: {bottom}");
        }
    }

    #[test]
    fn the_keys_have_room_in_windows_of_usual_widths() {
        for width in [640.0, 1024.0, 1280.0, 1440.0, 1920.0] {
            let context = Context::default();
            let rect = egui::Rect::from_min_size(egui::Pos2::ZERO, Vec2::new(width, 768.0));
            let mut has_room = false;
            // What is laid out for the first time does not know its size yet.
            for _ in 0..3 {
                let input = egui::RawInput { screen_rect: Some(rect), ..Default::default() };
                let _ = context.run(input, |context| has_room = keys(context));
            }
            assert!(has_room, "{width}");
        }
    }
}
