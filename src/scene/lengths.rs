//! What no scene has, whoever made it: lists that belong together have as many as there are positions; lights shine, and an ε is a length.

use super::{Colors, Light, MOST_LIGHTS, OptionValue, Room, Scene, Shapes, Splats};
use crate::error::{Error, Result};

impl Scene {
    /// Refuses lights that are none, and more than a frame has.
    pub(crate) fn check_lights(&self) -> Result<()> {
        self.lights.iter().try_for_each(Light::validate)?;
        match self.lights.len() <= MOST_LIGHTS {
            true => Ok(()),
            false => {
                let problem = format!("{}: expected at most {MOST_LIGHTS}", self.lights.len());
                Err(Error::option("lights", problem))
            }
        }
    }

    /// Refuses an object's own ε that is none.
    pub(crate) fn check_epsilons(&self) -> Result<()> {
        for (number, epsilon) in self.epsilons.iter().enumerate() {
            let checked = epsilon.as_ref().map_or(Ok(()), OptionValue::check);
            checked.map_err(|problem| Error::option(format!("epsilon of object {number}"), problem))?;
        }
        Ok(())
    }

    /// Refuses room for splats that none can be given.
    pub(crate) fn check_rooms(&self) -> Result<()> {
        let rooms = self.rooms.iter().enumerate().filter_map(|(number, room)| Some((number, (*room)?)));
        for (number, Room { splats, around, overlap }) in rooms {
            let refused = |problem: String| Err(Error::option(format!("room of object {number}"), problem));
            if !self.updatable {
                return refused("expected a scene with Scene::updatable".to_owned());
            }
            let Some(object) = self.objects.get(number) else {
                return refused(format!("the scene has {} objects of splats", self.objects.len()));
            };
            if !object.splats.clips.is_empty() {
                return refused("clip curves cut its splats: expected whole ones".to_owned());
            }
            let own = object.splats.len();
            if u32::try_from(own).ok().and_then(|own| own.checked_add(splats)).is_none() {
                return refused(format!("{splats} splats behind {own}: expected numbers of 32 bits"));
            }
            if around.is_some_and(|around| !around.is_finite()) {
                return refused("around: expected a place".to_owned());
            }
            if overlap.is_some_and(|overlap| !(overlap >= 1.0 && overlap.is_finite())) {
                return refused("overlap: expected 1 or more".to_owned());
            }
        }
        Ok(())
    }

    /// Refuses an object or a mesh, by its name, of which a list is shorter or longer than that of its positions.
    pub(crate) fn check_lengths(&self) -> Result<()> {
        let of_splats = self.objects.iter().map(|object| ("object", &object.name, lists(&object.splats)));
        let of_levels = self.leveled.iter().map(|object| ("object", &object.name, lists(&object.leaves)));
        let of_meshes = self.meshes.iter().map(|object| {
            let normals = object.mesh.normals.as_ref().map(Vec::len);
            let colors = of_colors(&object.mesh.colors);
            let lists = [("normals", normals), ("colors", colors), ("colors", None)];
            ("mesh", &object.name, (object.mesh.positions.len(), lists))
        });
        for (kind, name, (positions, lists)) in of_splats.chain(of_levels).chain(of_meshes) {
            check((positions, lists))
                .map_err(|problem| Error::option(format!("{kind} '{name}'"), problem))?;
        }
        Ok(())
    }
}

impl Splats {
    /// Refuses a list that is shorter or longer than that of positions.
    pub(crate) fn check_lengths(&self) -> std::result::Result<(), String> {
        check(lists(self))
    }
}

fn check((positions, lists): Lists) -> std::result::Result<(), String> {
    let other = |count: &usize| *count != positions;
    match lists.into_iter().find_map(|(list, count)| Some((list, count.filter(other)?))) {
        Some((list, count)) => Err(format!("{positions} positions, and {count} {list}; expected as many")),
        None => Ok(()),
    }
}

/// How many positions there are, and how many of what goes with them.
type Lists = (usize, [(&'static str, Option<usize>); 3]);

fn lists(splats: &Splats) -> Lists {
    let [first, second] = match &splats.shapes {
        Shapes::Disks { normals, radii } => [("normals", normals.len()), ("radii", radii.len())],
        Shapes::Ellipses { s, t } => [("first tangents", s.len()), ("second tangents", t.len())],
    };
    let some = |(list, count)| (list, Some(count));
    (splats.positions.len(), [some(first), some(second), ("colors", of_colors(&splats.colors))])
}

fn of_colors(colors: &Colors) -> Option<usize> {
    match colors {
        Colors::Uniform(_) => None,
        Colors::Each(colors) => Some(colors.len()),
    }
}
