//! Exact pictures, those drawn last of which are kept: a test that draws one scene in several ways compares them with one.

use std::{
    cell::RefCell,
    collections::VecDeque,
    fmt::{self, Write},
    hash::{DefaultHasher, Hasher},
    rc::Rc,
};

use super::scenes::Hard;
use surfel::{
    reference::{self, Picture},
    scene::Settings,
    selftest::of_oracle,
};

/// Pictures of a thread, which is a test.
const MOST: usize = 8;

/// By the scene and the camera, as they are printed, and the settings.
struct Kept {
    scene: u64,
    settings: Settings,
    picture: Rc<Picture>,
}

thread_local! {
    static KEPT: RefCell<VecDeque<Kept>> = const { RefCell::new(VecDeque::new()) };
}

/// The exact picture.
pub fn oracle_of(hard: &Hard) -> Rc<Picture> {
    let mut printed = Printed::default();
    write!(printed, "{:?}{:?}", hard.scene, hard.camera).unwrap();
    let (scene, settings) = (printed.0.finish(), of_oracle(&hard.settings));
    let same = |kept: &&Kept| kept.scene == scene && kept.settings == settings;
    if let Some(picture) = KEPT.with_borrow(|all| all.iter().find(same).map(|kept| Rc::clone(&kept.picture)))
    {
        return picture;
    }
    let picture = Rc::new(reference::render(&hard.scene, &hard.camera, &settings, &|_, _| {}).unwrap());
    KEPT.with_borrow_mut(|all| {
        all.truncate(MOST - 1);
        all.push_front(Kept { scene, settings, picture: Rc::clone(&picture) });
    });
    picture
}

/// A text, of which only the hash is kept.
#[derive(Default)]
struct Printed(DefaultHasher);

impl Write for Printed {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}
