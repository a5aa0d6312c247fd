//! Times as bars.

use egui::{Color32, Rect, Sense, Ui, Vec2, pos2};

use super::history::Times;

const BLUE: Color32 = Color32::from_rgb(90, 170, 255);

/// Times as bars, the tallest as tall as there is room for; that one.
pub fn bars(ui: &mut Ui, size: Vec2, times: &Times) -> f32 {
    let (response, painter) = ui.allocate_painter(size, Sense::hover());
    let rect = response.rect;
    painter.rect_filled(rect, 2.0, Color32::from_gray(40));
    let most = times.iter().copied().fold(0.0, f32::max);
    let step = rect.width() / times.len().max(2) as f32;
    for (number, ms) in times.iter().enumerate() {
        let [left, right] = [number, number + 1].map(|at| rect.left() + at as f32 * step);
        let top = rect.bottom() - rect.height() * ms / most.max(f32::MIN_POSITIVE);
        // Not a line: of one that is wider than it is long egui draws a hair as tall as any.
        let bar = Rect::from_min_max(pos2(left, top), pos2(right, rect.bottom()));
        painter.rect_filled(bar, 0.0, BLUE);
    }
    most
}

#[cfg(test)]
mod tests {
    use egui::epaint::Shape;

    use super::*;

    #[test]
    fn a_bar_is_as_tall_as_its_time() {
        let (context, times) = (egui::Context::default(), Times::from([0.001, 8.0, 2.0]));
        let output = context.run(egui::RawInput::default(), |context| {
            egui::CentralPanel::default().show(context, |ui| bars(ui, Vec2::new(60.0, 16.0), &times));
        });
        let sizes = output.shapes.iter().filter_map(|clipped| match &clipped.shape {
            Shape::Rect(rect) if rect.fill == BLUE => Some(rect.rect.size()),
            _ => None,
        });
        let sizes: Vec<_> = sizes.collect();
        let expected = [0.002, 16.0, 4.0].map(|tall| Vec2::new(20.0, tall));
        let is_near = |(size, other): (&Vec2, &Vec2)| (*size - *other).length() < 0.01;
        assert!(sizes.len() == 3 && sizes.iter().zip(&expected).all(is_near), "{sizes:?}");
    }
}
