//! What is under the cursor: a pivot, or a place to measure from.

use surfel::{
    Result,
    passes::{Picked, PickedPart},
    scene::Settings,
};

use super::{device::is_device_lost, on_device::OnDevice, viewer::Viewer};

impl Viewer {
    /// The point of the surface under the cursor is what the camera turns about from now on.
    ///
    /// # Errors
    /// Of the device.
    pub fn set_pivot(&mut self) -> Result<()> {
        if self.tells_of_no_picture() {
            return Ok(());
        }
        match self.pick()? {
            Some(picked) => {
                if let Some(navigation) = &mut self.navigation {
                    navigation.set_pivot(picked.position);
                }
                self.ui.tell("turns about this point");
            }
            None => self.ui.tell("there is no surface under the cursor"),
        }
        self.window.request_redraw();
        Ok(())
    }

    /// Says what is under the cursor, where it is, and how far from what was picked before; and copies that.
    ///
    /// # Errors
    /// Of the device.
    pub fn measure(&mut self) -> Result<()> {
        if self.tells_of_no_picture() {
            return Ok(());
        }
        let Some(picked) = self.pick()? else {
            self.ui.tell("there is no surface under the cursor");
            return Ok(());
        };
        let scene = self.prepared.as_ref().map(OnDevice::scene);
        let objects = scene.map(|scene| scene.objects.as_slice()).unwrap_or_default();
        let name = objects.get(picked.object).map_or("", String::as_str);
        let mut text = format!("{name}, {}", describe(&picked));
        if let Some(before) = self.measured.replace(picked.position) {
            text += &format!("; {} from the point before", before.distance(picked.position));
        }
        self.copy(&text);
        Ok(())
    }

    /// Tells that no picture has come yet, in which something could be picked; whether that is so.
    fn tells_of_no_picture(&mut self) -> bool {
        let is_none = self.drawn.is_none();
        if is_none {
            self.ui.tell("there is no picture yet");
            self.window.request_redraw();
        }
        is_none
    }

    fn pick(&mut self) -> Result<Option<Picked>> {
        let (size_px, cursor) = (self.window_px(), self.input.cursor);
        let pixel = [0, 1].map(|i| (cursor[i].max(0.0) as u32).min(size_px[i] - 1));
        let settings = self.at_rest(&Settings { size_px, ..self.settings.clone() });
        let (Some(camera), Some(prepared)) = (self.camera(), &self.prepared) else { return Ok(None) };
        let Some(settings) = prepared.pages().map_or(Some(settings.clone()), |pages| pages.now(&settings))
        else {
            return Ok(None);
        };
        match self.gpu.headless.pick(prepared.scene(), &camera, &settings, pixel) {
            Err(error) if !is_device_lost(&error) => {
                self.tell(&error.to_string());
                Ok(None)
            }
            picked => picked,
        }
    }
}

fn describe(picked: &Picked) -> String {
    let triple = |of: glam::DVec3| format!("{},{},{}", of.x, of.y, of.z);
    let numbered = |what: &str, number: Option<u32>| match number {
        Some(number) => format!("{what} {number}"),
        None => what.to_owned(),
    };
    let part = match picked.part {
        PickedPart::Splat(number) => numbered("splat", number),
        PickedPart::Triangle(number) => numbered("triangle", number),
        PickedPart::Node => "node of levels of detail".to_owned(),
    };
    // Normals are of 32 bits.
    let normal = picked.normal.as_vec3();
    format!("{part} at {}, normal {},{},{}", triple(picked.position), normal.x, normal.y, normal.z)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn positions_have_all_their_digits() {
        let position = DVec3::new(500_000.001_234_5, 1.0 / 3.0, -0.25);
        let part = PickedPart::Splat(Some(7));
        let picked = Picked { position, normal: DVec3::Z, distance: 1.0, depth: 1.0, object: 0, part };
        let expected = "splat 7 at 500000.0012345,0.3333333333333333,-0.25, normal 0,0,1";
        assert_eq!(describe(&picked), expected);
    }
}
