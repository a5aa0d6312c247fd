//! What keys do. One table: the keyboard, the help in the window and the manual are made from it.

use surfel::scene::View;

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Back to where the camera began.
    Home,
    /// All of the scene, from the same side.
    Fit,
    /// All of the scene, from this side.
    See(View),
    /// The next axis is up.
    NextUp,
    /// Between a perspective and parallel rays.
    Projection,
    /// Between a turntable and free turns.
    Turns,
    /// The next value of a setting, or the one before.
    Setting(&'static str, Step),
    /// More or less exposure, in stops.
    Exposure(f64),
    /// The next curve of bright light.
    Tonemap,
    /// All splats larger or smaller.
    SplatScale(f64),
    /// More or fewer transparent layers.
    Layers(i64),
    /// Shows or hides the panel.
    Panel,
    /// Shows or hides the keys.
    Keys,
    /// Closes what lies over the picture.
    Close,
    /// The picture to a file.
    Screenshot,
    /// The camera to the clipboard, as options or as a camera file.
    CopyCamera(CopiedAs),
    /// What is cut off.
    Cut(Cutting),
    /// What is done with one thing of the scene.
    Thing(OnThing),
    /// All settings as they were at first.
    Reset,
    /// How the picture is compared with another method.
    Compare(Comparing),
    /// What is done with a path of cameras.
    Path(OnPath),
    /// Says what is under the cursor, and how far it is from what was before.
    Pick,
    /// Reads the files again.
    Reload,
    /// Ends the program.
    Quit,
}

/// Which value comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The one behind.
    Next,
    /// The one before.
    Before,
}

/// How a camera is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CopiedAs {
    /// As options of the command line.
    Options,
    /// As a camera file.
    Json,
}

/// What is done with a path of cameras.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnPath {
    /// The camera of now is its next place.
    Add,
    /// Its last place goes.
    Remove,
    /// It is played, or stops.
    Play,
    /// It goes to a file.
    Save,
}

/// How two methods are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparing {
    /// Side by side, with a line between them that the mouse moves.
    Split,
    /// How far their colors differ.
    Difference,
    /// The other one in place of the first, and back.
    Flicker,
    /// The settings of now are those of the other one.
    Keep,
}

/// What is done with one thing of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OnThing {
    /// The next one is meant from now on.
    Next,
    /// It is hidden, or shown again.
    Hide,
    /// So much more alpha, or less.
    Alpha(f32),
}

/// How planes cut the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cutting {
    /// By a plane that faces the eye, or not.
    Plane,
    /// By a box, or not.
    Box,
    /// Deeper.
    More,
    /// Less deep.
    Less,
}

/// A key as it is printed on the keyboard: a character, or a name.
pub struct Binding {
    /// The key.
    pub key: &'static str,
    /// What it does.
    pub action: Action,
    /// In words.
    pub help: &'static str,
}

const fn binding(key: &'static str, action: Action, help: &'static str) -> Binding {
    Binding { key, action, help }
}

/// All keys but those that are held: w, a, s, d, q and e fly, Shift makes it four times as fast.
pub const BINDINGS: &[Binding] = &[
    binding("h", Action::Home, "the camera back to where it began"),
    binding("f", Action::Fit, "all of the scene"),
    binding("1", Action::See(View::Front), "from the front"),
    binding("2", Action::See(View::Back), "from the back"),
    binding("3", Action::See(View::Left), "from the left"),
    binding("4", Action::See(View::Right), "from the right"),
    binding("5", Action::See(View::Top), "from above"),
    binding("6", Action::See(View::Bottom), "from below"),
    binding("7", Action::See(View::Iso), "isometric"),
    binding("u", Action::NextUp, "the next axis is up"),
    binding("p", Action::Projection, "perspective or parallel rays"),
    binding("t", Action::Turns, "turntable or free turns"),
    binding("r", Action::Setting("rasterizer", Step::Next), "the next rasterizer"),
    binding("R", Action::Setting("rasterizer", Step::Before), "the rasterizer before"),
    binding("g", Action::Setting("filter", Step::Next), "the next filter"),
    binding("G", Action::Setting("filter", Step::Before), "the filter before"),
    binding("k", Action::Setting("kernel", Step::Next), "the next kernel"),
    binding("n", Action::Setting("epsilon", Step::Next), "the next ε: auto, 0.5, 1, 2 or 4 radii"),
    binding("b", Action::Setting("edges", Step::Next), "the next treatment of edges"),
    binding("v", Action::Setting("shading", Step::Next), "the next shading"),
    binding("V", Action::Setting("shading", Step::Before), "the shading before"),
    binding("O", Action::Setting("outlines", Step::Next), "outlines of splats, or none"),
    binding("l", Action::Layers(1), "one transparent layer more"),
    binding("L", Action::Layers(-1), "one transparent layer less"),
    binding("]", Action::Exposure(0.5), "half a stop brighter"),
    binding("[", Action::Exposure(-0.5), "half a stop darker"),
    binding("m", Action::Tonemap, "the next tone curve"),
    binding(".", Action::SplatScale(1.25), "larger splats"),
    binding(",", Action::SplatScale(0.8), "smaller splats"),
    binding("X", Action::Cut(Cutting::Plane), "cuts off what is before the point turned about, or nothing"),
    binding("B", Action::Cut(Cutting::Box), "cuts off what is outside of a box, or nothing"),
    binding("=", Action::Cut(Cutting::More), "the cut goes deeper"),
    binding("-", Action::Cut(Cutting::Less), "the cut goes less deep"),
    binding("N", Action::Thing(OnThing::Next), "the next thing of the scene, for the three keys below"),
    binding("H", Action::Thing(OnThing::Hide), "hides that thing, or shows it again"),
    binding("<", Action::Thing(OnThing::Alpha(-0.1)), "that thing is more transparent"),
    binding(">", Action::Thing(OnThing::Alpha(0.1)), "that thing is less transparent"),
    binding("0", Action::Reset, "method, light, cuts and things as at the beginning"),
    binding("x", Action::Compare(Comparing::Split), "split: this method and the one kept"),
    binding("z", Action::Compare(Comparing::Difference), "difference of the two, with a color bar"),
    binding("Space", Action::Compare(Comparing::Flicker), "the other one, and back"),
    binding("y", Action::Compare(Comparing::Keep), "keeps this method as the other one"),
    binding("i", Action::Screenshot, "the picture to a file, with --samples"),
    binding("c", Action::CopyCamera(CopiedAs::Options), "copies the camera as options of surfel render"),
    binding("C", Action::CopyCamera(CopiedAs::Json), "copies the camera as a camera file"),
    binding("Enter", Action::Path(OnPath::Add), "the camera is the next place of a path, 2 s on"),
    binding("Backspace", Action::Path(OnPath::Remove), "the last place of the path goes"),
    binding("/", Action::Path(OnPath::Play), "plays the path, or stops"),
    binding("K", Action::Path(OnPath::Save), "the path to a file, for surfel render --path"),
    binding("j", Action::Pick, "what is under the cursor, and how far from the last"),
    binding("F5", Action::Reload, "reads the files again"),
    binding("o", Action::Panel, "shows or hides the panel"),
    binding("?", Action::Keys, "shows or hides the keys"),
    binding("F1", Action::Keys, "shows or hides the keys"),
    binding("Escape", Action::Close, "closes panel and keys"),
    binding("Ctrl+q", Action::Quit, "ends"),
];

/// What the mouse does, in words.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "turns"),
    ("right drag, Shift+drag", "moves along the picture"),
    ("wheel", "nearer to what is under the cursor, or away from it"),
    ("double click", "turns about that point of the surface from then on"),
    ("w a s d q e", "fly: forward, left, back, right, down, up; with Shift faster"),
    ("Tab", "through the panel: Space sets, arrows change, Escape leaves"),
];

/// What a key does, by its character or name, if anything.
pub fn action(key: &str) -> Option<Action> {
    BINDINGS.iter().find(|binding| binding.key == key).map(|binding| binding.action)
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn each_key_does_one_thing_and_none_of_those_that_fly() {
        let keys: HashSet<_> = BINDINGS.iter().map(|binding| binding.key).collect();
        assert_eq!(keys.len(), BINDINGS.len());
        assert!(["w", "a", "s", "d", "q", "e"].iter().all(|key| !keys.contains(key)));
        assert_eq!(action("h"), Some(Action::Home));
        // Large letters are keys of their own.
        assert_eq!(action("H"), Some(Action::Thing(OnThing::Hide)));
        assert_eq!(action("F"), None);
    }
}
