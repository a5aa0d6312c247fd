//! What the engine has drawn, read by the host.

use ash::vk;

use super::Engine;

impl Engine {
    /// The picture: linear light, row by row.
    pub fn pixels(&self) -> Vec<[f32; 4]> {
        let [width, height] = self.style.size_px;
        // SAFETY: the host waited; the buffer begins with so many pixels of four floats, aligned as memory is mapped.
        unsafe { std::slice::from_raw_parts(self.readback.2.cast(), (width * height) as usize) }.to_vec()
    }

    /// The depth, as the device keeps it: floats, or whole numbers of its steps.
    pub fn depths(&self) -> Vec<f64> {
        let [width, height] = self.style.size_px;
        let pixels = (width * height) as usize;
        // SAFETY: as above; depths lie behind the colors, in two or four bytes.
        unsafe {
            let begin = self.readback.2.add(16 * pixels);
            match self.style.depth_format {
                vk::Format::D16_UNORM => {
                    let all = std::slice::from_raw_parts(begin.cast::<u16>(), pixels);
                    all.iter().map(|d| f64::from(*d) / 65_535.0).collect()
                }
                vk::Format::X8_D24_UNORM_PACK32 | vk::Format::D24_UNORM_S8_UINT => {
                    let all = std::slice::from_raw_parts(begin.cast::<u32>(), pixels);
                    all.iter().map(|d| f64::from(d & 0xff_ffff) / 16_777_215.0).collect()
                }
                _ => {
                    let all = std::slice::from_raw_parts(begin.cast::<f32>(), pixels);
                    all.iter().map(|d| f64::from(*d)).collect()
                }
            }
        }
    }

    /// The numbers of objects, and how each pixel has moved, where the style has images of them.
    pub fn told(&self) -> (Vec<u32>, Vec<[f32; 2]>) {
        let [width, height] = self.style.size_px;
        let pixels = (width * height) as usize;
        // SAFETY: as above; behind the depths.
        unsafe {
            let [numbers, motion] = [20, 24].map(|at| self.readback.2.add(at * pixels));
            let numbers = std::slice::from_raw_parts(numbers.cast(), pixels).to_vec();
            (numbers, std::slice::from_raw_parts(motion.cast(), pixels).to_vec())
        }
    }

    /// Writes the picture over gray.
    pub fn save(&self, file: &str) -> Result<(), Box<dyn std::error::Error>> {
        let encode = |x: f32| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        let byte = |light: f32, alpha: f32| {
            (255.0 * encode((light + 0.5 * (1.0 - alpha)).clamp(0.0, 1.0))).round() as u8
        };
        let pixels = self.pixels();
        let bytes: Vec<u8> =
            pixels.iter().flat_map(|[r, g, b, a]| [r, g, b].map(|light| byte(*light, *a))).collect();
        Ok(surfel::save::png(file.as_ref(), self.style.size_px, 3, &bytes)?)
    }

    /// The engine goes; an error if the validation layer has said anything.
    pub fn end(self) -> Result<(), Box<dyn std::error::Error>> {
        let said = self.said();
        match said.is_empty() {
            true => Ok(()),
            false => Err(format!("the validation layer says: {}", said.join("\n")).into()),
        }
    }

    /// What the validation layer has said.
    pub fn said(&self) -> Vec<String> {
        self.said.lock().unwrap().clone()
    }
}
