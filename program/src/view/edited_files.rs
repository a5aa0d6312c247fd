//! What the viewer changes of files that are read in pages: as they are written they come in pages, else as a whole.

use surfel::{
    Progress, Result,
    levels_file::LevelsFile,
    scene::{Object, Scene},
};

use super::edits::{Edits, things_before_files};

impl Edits {
    /// Which of the files beside a scene are as they were read, and seen: their pages are. Of a file that is changed all splats are drawn, as of what is in levels.
    pub fn in_pages(&self, scene: &Scene, files: &[LevelsFile]) -> Vec<bool> {
        let things = self.of_files(scene, files);
        things.map(|(_, thing)| thing == (true, 1.0) && self.splat_scale == 1.0).collect()
    }

    /// Those that are changed, and seen.
    pub fn changed_files<'f>(
        &self,
        scene: &Scene,
        files: &'f [LevelsFile],
    ) -> impl Iterator<Item = (&'f LevelsFile, f32)> {
        let is_changed = |alpha: f32| alpha != 1.0 || self.splat_scale != 1.0;
        let things = self.of_files(scene, files);
        things
            .filter(move |(_, (seen, alpha))| *seen && is_changed(*alpha))
            .map(|(file, (_, alpha))| (file, alpha))
    }

    fn of_files<'f>(
        &self,
        scene: &Scene,
        files: &'f [LevelsFile],
    ) -> impl Iterator<Item = (&'f LevelsFile, (bool, f32))> {
        let things = self.things.iter().skip(things_before_files(scene)).copied();
        files.iter().zip(things.chain(std::iter::repeat((true, 1.0))))
    }

    /// Reads all splats of the files that are changed, with these changes.
    ///
    /// # Errors
    /// As [`LevelsFile::again`] and [`LevelsFile::load`].
    pub fn whole_files(
        &self,
        scene: &Scene,
        files: &[LevelsFile],
        progress: &dyn Progress,
    ) -> Result<Vec<Object>> {
        let whole = |(file, alpha): (&LevelsFile, f32)| {
            let object = file.again()?.load(None, u64::MAX, progress)?.object;
            let splats = self.splats(&object.leaves, alpha);
            Ok(Object { name: object.name, splats, closed: object.closed })
        };
        self.changed_files(scene, files).map(whole).collect()
    }
}
