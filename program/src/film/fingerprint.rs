//! What a picture is made of, as a number.

use std::{
    fs,
    hash::{DefaultHasher, Hasher as _},
    io,
    path::Path,
};

use bytemuck::NoUninit;
use surfel::scene::{Colors, Scene, Shapes};

/// Of all that was added, one after the other.
#[derive(Clone)]
pub struct Fingerprint(DefaultHasher);

/// What is printed is added.
impl std::fmt::Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

impl Fingerprint {
    /// Of this program.
    pub fn new() -> Self {
        let mut new = Self(DefaultHasher::new());
        new.add(&env!("CARGO_PKG_VERSION"));
        new
    }

    /// Adds anything as it prints itself.
    pub fn add(&mut self, value: &dyn std::fmt::Debug) {
        // Never fails: `write_str` does not.
        let _ = std::fmt::Write::write_fmt(self, format_args!("{value:?};"));
    }

    fn add_bytes<T: NoUninit>(&mut self, values: &[T]) {
        self.0.write_usize(values.len());
        self.0.write(bytemuck::cast_slice(values));
    }

    fn add_colors(&mut self, colors: &Colors) {
        match colors {
            Colors::Uniform(color) => self.add_bytes(&[*color]),
            Colors::Each(colors) => self.add_bytes(colors),
        }
    }

    /// Adds all that is drawn of a scene.
    pub fn add_scene(&mut self, scene: &Scene) {
        let Scene { lights, storage, epsilons, without_auto_epsilon, levels, budget, .. } = scene;
        self.add(&(lights, storage, epsilons, without_auto_epsilon, levels, budget));
        for object in &scene.objects {
            let splats = &object.splats;
            self.add(&(&object.name, object.closed));
            self.add_bytes(&splats.positions);
            match &splats.shapes {
                Shapes::Disks { normals, radii } => {
                    self.add_bytes(normals);
                    self.add_bytes(radii);
                }
                Shapes::Ellipses { s, t } => {
                    self.add_bytes(s);
                    self.add_bytes(t);
                }
            }
            self.add_colors(&splats.colors);
            self.add(&splats.clips);
        }
        for object in &scene.meshes {
            let mesh = &object.mesh;
            self.add(&(&object.name, object.closed));
            self.add_bytes(&mesh.positions);
            self.add_bytes(&mesh.triangles);
            self.add_bytes(mesh.normals.as_deref().unwrap_or_default());
            self.add_colors(&mesh.colors);
        }
    }

    /// Adds a file of which parts are read: by its place, its size and when it was changed.
    ///
    /// # Errors
    /// A file that is not there any more.
    pub fn add_file(&mut self, path: &Path) -> io::Result<()> {
        let metadata = fs::metadata(path)?;
        self.add(&(path.canonicalize()?, metadata.len(), metadata.modified()?));
        Ok(())
    }

    /// The number.
    pub fn number(&self) -> u64 {
        self.0.finish()
    }
}
