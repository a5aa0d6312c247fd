//! The manual of scene files.

/// The keys, in a table that fits the width at which help is wrapped.
pub const KEYS: &str = "\
A scene file, in TOML, with all its keys and their defaults; an object needs a file or a builtin,
a light its kind. Unknown keys are faults. Points and directions, such as [1, 2, 3], are in world
space; colors are sRGB from 0 to 1.

[camera]                   options replace it key by key, --camera as a whole
  eye, view, target, up    as the options; points are arrays, sides, axes and objects texts
  azimuth_deg, elevation_deg, zoom, near
                           as the options without _deg
  fov_deg = 45             the vertical field of view in degrees; or
  orthographic             the picture's height, or \"fit\"
epsilon = \"auto\"           as the option, or a number: a length; these five stand above all
background = [1, 1, 1]     or \"none\"; tables, and options replace each of them
shading = \"phong\"          as the option
clip_box, clip_planes      as the options: six numbers; arrays of four
[[light]]                  at most 16; without any, a white one at the eye
  kind = \"eye\"             or \"directional\"
  direction                in which a directional light travels
  color = [1, 1, 1]
  intensity = 1            multiplies the color as linear light, at least 0
[[object]]                 at least one, at most 1024
  file                     any model or scan that `surfel info` reads, in the scene file's folder
                           or below, links followed (--allow-outside: anywhere); .surfel for
                           render, view and info, as splats alone and without epsilon; or
  builtin                  \"relief\", \"sphere\" (of radius 1) or \"checkerboard\"
  splats                   of a builtin; 150000, 20000 and 10000 of these; a hybrid has a share
                           for the area of its splats
  triangles = 20480        of the sphere as triangles: at least so many
  name                     in messages, in place of the file's
  representation = \"auto\"  a mesh as what shows it best; or \"splats\": disks at its vertices;
                           \"mesh\": its triangles; \"hybrid\": some triangles, splats for the
                           others
  polygons                 of a hybrid, which triangles stay: { plane = [nx, ny, nz, d] }: those
                           whose middle x has n.x >= d, or { longer_than = LENGTH }: those with a
                           longer edge; before the object is placed; without, the view decides:
                           those whose splats would be larger on the screen than --lod
  sample_edges = true      of a hybrid: splats on the edges where both meet, for a smooth seam
  resample                 of a mesh: so many splats, spread evenly, not a disk at each vertex; a
                           hybrid always does, with the number of its splat part's vertices
  seed = 0                 which ones
  scale = 1                or [x, y, z]; negative numbers mirror
  rotate_deg = [0, 0, 0]   then turned about x, then y, then z, in degrees
  translate = [0, 0, 0]    then moved
  matrix                   in place of these three: three rows of four numbers, the last of which
                           move, or four rows of three: where x, y, z and the origin go
  color                    replaces the object's own
  alpha = 1                multiplies its own, 0 to 1
  epsilon                  of its splats, in place of the picture's";

#[cfg(test)]
mod tests {
    use super::KEYS;

    #[test]
    fn no_line_is_wrapped() {
        assert!(KEYS.lines().all(|line| line.chars().count() <= 98));
    }
}
