//! How far the things of a scene reach, each by itself: what is hidden, or far away from the others, counts for what is seen alone.

use surfel::{
    geometry::main_part,
    scene::{Ball, LeveledObject, Object, Scene},
};

use super::{document::Document, edits::Edits};

/// The ball of each thing of a scene, in the order of [`Edits`], or of most of it where few of its places are far away. The scene stays as it is.
pub fn balls(scene: &mut Scene) -> Vec<Option<Ball>> {
    let of = |one: &Scene| {
        let whole = one.ball()?;
        Some(main_part(one, &whole).map_or(whole, |part| part.ball))
    };
    let mut balls = Vec::new();
    let mut one = Scene::default();
    for object in std::mem::take(&mut scene.objects) {
        one.objects.push(object);
        balls.push(of(&one));
        scene.objects.append(&mut one.objects);
    }
    for object in std::mem::take(&mut scene.meshes) {
        one.meshes.push(object);
        balls.push(of(&one));
        scene.meshes.append(&mut one.meshes);
    }
    for leveled in std::mem::take(&mut scene.leveled) {
        one.objects.push(Object { name: String::new(), splats: leveled.leaves, closed: false });
        balls.push(of(&one));
        let whole =
            one.objects.pop().map(|Object { splats: leaves, .. }| LeveledObject { leaves, ..leveled });
        scene.leveled.extend(whole);
    }
    balls
}

/// The ball of what is seen: `whole`, which a picture of the scene shows at first, unless something is hidden, or is not in it.
fn ball_of_seen(whole: Ball, balls: &[Option<Ball>], edits: &Edits) -> Ball {
    // Balls reach beyond that around all of them.
    let is_in = |ball: &Ball| ball.center.distance(whole.center) <= whole.radius;
    let all = edits.things.iter().all(|(seen, _)| *seen) && balls.iter().flatten().all(is_in);
    let seen = balls.iter().zip(&edits.things).filter(|(_, (seen, _))| *seen).filter_map(|(ball, _)| *ball);
    let seen = seen.reduce(|all, ball| all.union(ball));
    seen.filter(|_| !all).unwrap_or(whole)
}

impl Document {
    /// The ball of what is seen of the scene.
    pub fn ball_of_seen(&self, edits: &Edits) -> Ball {
        ball_of_seen(self.ball, &self.balls, edits)
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};
    use surfel::scene::{Colors, Shapes, Splats};

    use super::*;
    use crate::view::edits::things;

    fn object(x: f64) -> Object {
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; 2], radii: vec![0.5; 2] };
        let places = vec![DVec3::new(x, -1.0, 0.0), DVec3::new(x, 1.0, 0.0)];
        let splats = Splats::new(places, shapes, Colors::Uniform([1.0; 4]));
        Object { name: format!("at {x}"), splats, closed: true }
    }

    #[test]
    fn what_is_hidden_does_not_count_and_what_is_far_away_does() {
        let mut scene = Scene { objects: vec![object(0.0), object(10.0)], ..Scene::default() };
        let balls = balls(&mut scene);
        assert_eq!(
            things(&scene, &[]).iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
            ["at 0", "at 10"]
        );
        let whole = scene.ball().unwrap();
        let mut edits = Edits::none(&scene, &[]);
        assert_eq!(ball_of_seen(whole, &balls, &edits), whole);
        // The view at first may be of one of them alone.
        let first = balls[0].unwrap();
        let all = ball_of_seen(first, &balls, &edits);
        assert!(all.center.distance(DVec3::new(5.0, 0.0, 0.0)) < 1e-9 && all.radius > 6.0, "{all:?}");
        edits.things[1].0 = false;
        assert_eq!(ball_of_seen(whole, &balls, &edits), first);
        edits.things[0].0 = false;
        assert_eq!(ball_of_seen(whole, &balls, &edits), whole);
    }
}
