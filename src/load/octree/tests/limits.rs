//! What an octree may hold.

use super::*;

#[test]
fn points_have_a_limit() {
    let (copc, potree) = (octree(100).copc(1).0, octree(100).potree(1));
    for (most, refused) in [(100, false), (99, true)] {
        let mut options = small();
        options.limits.points = most;
        let opened = [
            PointOctree::of_copc(source("a.copc.laz", copc.clone()), &options),
            of_potree_within(potree.clone(), &options.limits),
        ];
        for opened in opened {
            assert_eq!(opened.is_err(), refused);
            if let Err(error) = opened {
                assert!(error.to_string().ends_with("expected at most 99"), "{error}");
            }
        }
    }
}
