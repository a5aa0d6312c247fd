//! Splats of arrays.

use std::{
    ffi::{c_char, c_void},
    mem::take,
};

use surfel::{
    ash::vk,
    glam::{DVec3, Vec2, Vec3},
    scene::{Clip, ClipCurve, Clips, Colors, Object, Shapes, Splats},
};

use crate::{
    arrays::{array, colors_in, copy, copy_colors},
    handle::text,
    result::{Failure, Result},
    rooms::SurfelRoom,
    structs::{Struct, SurfelStructureType},
};

/// A curve that cuts off a part of a splat: a rational Bézier curve of degree 2 in the splat's own plane, where its rim is u² + v² = 1. What
/// is to the right of the way from its start to its end is cut off.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelClipCurve {
    /// Where it starts on the rim, in radians from the first tangent vector toward the second.
    pub start_rad: f32,
    /// Where it ends.
    pub end_rad: f32,
    /// The control point in the middle, (u, v); the two others are its ends.
    pub middle: [f32; 2],
    /// The weight of that point, at least 0: 0 is the chord, 1 a parabola.
    pub weight: f32,
}

/// What is cut off a splat.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelClip {
    /// How many curves cut it, 0 to 2.
    pub curve_count: u32,
    /// Of two curves only what both cut off is; else what either does.
    pub both: vk::Bool32,
    /// The curves.
    pub curves: [SurfelClipCurve; 2],
}

impl SurfelClip {
    /// One of ours, as C has it.
    pub fn of(clip: &Clip) -> Self {
        let none = SurfelClipCurve { start_rad: 0.0, end_rad: 0.0, middle: [0.0; 2], weight: 0.0 };
        let curve = |of: Option<&ClipCurve>| {
            of.map_or(none, |ClipCurve { start_rad, end_rad, middle, weight }| SurfelClipCurve {
                start_rad: *start_rad,
                end_rad: *end_rad,
                middle: middle.to_array(),
                weight: *weight,
            })
        };
        let curves = clip.curves();
        let curve_count = curves.iter().flatten().count() as u32;
        Self { curve_count, both: matches!(clip, Clip::Both(..)).into(), curves: curves.map(curve) }
    }

    fn clip(&self) -> Result<Clip> {
        let curve = |SurfelClipCurve { start_rad, end_rad, middle, weight }: SurfelClipCurve| ClipCurve {
            start_rad,
            end_rad,
            middle: Vec2::from_array(middle),
            weight,
        };
        let [first, second] = self.curves.map(curve);
        let curves = match self.curve_count {
            0 => [None, None],
            1 => [Some(first), None],
            2 => [Some(first), Some(second)],
            other => {
                return Err(Failure::invalid(format!("clips: curveCount is {other}: expected at most 2")));
            }
        };
        Ok(Clip::of(curves, self.both != vk::FALSE))
    }
}

/// An object of splats, by arrays. Disks have `normals` and `radii`, ellipses have `tangentsS` and `tangentsT`; the other two are NULL.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelSplats {
    /// `SURFEL_STRUCTURE_TYPE_SPLATS`.
    pub s_type: u32,
    /// `sizeof(SurfelSplats)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// Shown in messages, as UTF-8; NULL: `splats`.
    pub name: *const c_char,
    /// How many splats there are.
    pub count: u64,
    /// Centers in the scene's own space: x, y, z of each.
    pub centers: *const f64,
    /// Normals of any length, x, y, z of each; the surface is seen from the side to which they point.
    pub normals: *const f32,
    /// Radii.
    pub radii: *const f32,
    /// First tangent vectors, scaled by the radius along them: x, y, z of each. A point of the splat is center + u s + v t with u² + v² ≤ 1.
    pub tangents_s: *const f32,
    /// Second tangent vectors alike; the normal is s × t.
    pub tangents_t: *const f32,
    /// Red, green, blue and alpha of each, linear, straight, 0 to 1; NULL: all are the opaque gray of surfaces without colors.
    pub colors: *const f32,
    /// How many colors there are: `count`, or 1 for all splats.
    pub color_count: u64,
    /// How far behind the nearest splat others of it belong to the same surface, in the scene's unit; 0: as the settings say.
    pub epsilon: f64,
    /// The splats sample a closed surface, and their normals point outward: those that face away can't be seen.
    pub closed: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
    /// What is cut off each ellipse; NULL: nothing. A disk that has a curve is left out.
    pub clips: *const SurfelClip,
    /// As `epsilon`, in mean radii of the object; one of both is 0.
    pub epsilon_in_radii: f64,
    /// Room for splats that come later; NULL: none comes, and none goes. Not for those that `surfel_update` and `surfel_append` are given.
    pub room: *const SurfelRoom,
    /// Its own epsilon is `auto`, whatever the settings say, and `withoutAutoEpsilon` of the scene; the two numbers are 0 then.
    pub auto_epsilon: vk::Bool32,
    /// 0; else it is refused.
    pub reserved_too: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelSplats {
    const TYPE: SurfelStructureType = SurfelStructureType::Splats;

    fn reserved(&self) -> u32 {
        self.reserved | self.reserved_too
    }
}

/// Memory for arrays of C's, kept from one copy of them to the next.
#[derive(Default)]
pub struct Arrays {
    centers: Vec<DVec3>,
    normals: Vec<Vec3>,
    radii: Vec<f32>,
    tangents: [Vec<Vec3>; 2],
    colors: Vec<[f32; 4]>,
}

impl Arrays {
    /// The splats that C means, in this memory, which [`Self::take_back`] wants back.
    ///
    /// # Safety
    /// Pointers are NULL or lead to as much as the struct says.
    pub unsafe fn splats(&mut self, given: &SurfelSplats) -> Result<Splats> {
        let Self { centers, normals, radii, tangents: [s, t], colors } = self;
        let count = given.count;
        // SAFETY: this function's contract, here and below.
        unsafe { copy(given.centers.cast(), count, "centers", DVec3::from_array, centers) }?;
        let vectors = |from: *const f32, name, into: &mut Vec<Vec3>| {
            // SAFETY: as above.
            unsafe { copy(from.cast(), count, name, Vec3::from_array, into) }
        };
        let is_given = |all: [*const f32; 2]| all.iter().any(|array| !array.is_null());
        let disks = is_given([given.normals, given.radii]);
        if disks == is_given([given.tangents_s, given.tangents_t]) && count > 0 {
            return Err(Failure::invalid("expected normals and radii, or tangentsS and tangentsT"));
        }
        match disks {
            true => {
                vectors(given.normals, "normals", normals)?;
                // SAFETY: as above.
                unsafe { copy(given.radii, count, "radii", |radius| radius, radii) }?;
            }
            false => {
                vectors(given.tangents_s, "tangentsS", s)?;
                vectors(given.tangents_t, "tangentsT", t)?;
            }
        }
        // SAFETY: as above.
        unsafe { copy_colors(given.colors, given.color_count, count, colors) }?;
        let clips = match given.clips.is_null() {
            true => Clips::default(),
            // SAFETY: as above.
            false => Clips::of(
                unsafe { array(given.clips, count, "clips") }?
                    .iter()
                    .map(SurfelClip::clip)
                    .collect::<Result<_>>()?,
            ),
        };
        // All is there: nothing that fails any more loses what is kept.
        let shapes = match disks {
            true => Shapes::Disks { normals: take(normals), radii: take(radii) },
            false => Shapes::Ellipses { s: take(s), t: take(t) },
        };
        Ok(Splats { clips, ..Splats::new(take(centers), shapes, colors_in(colors)) })
    }

    /// Keeps the memory of splats that are not needed any more.
    pub fn take_back(&mut self, splats: Splats) {
        self.centers = splats.positions;
        match splats.shapes {
            Shapes::Disks { normals, radii } => (self.normals, self.radii) = (normals, radii),
            Shapes::Ellipses { s, t } => self.tangents = [s, t],
        }
        if let Colors::Each(colors) = splats.colors {
            self.colors = colors;
        }
    }
}

/// An object of splats, whose arrays are copied.
///
/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
pub unsafe fn object(given: &SurfelSplats) -> Result<Object> {
    // SAFETY: this function's contract, here and below.
    let splats = unsafe { Arrays::default().splats(given) }?;
    let name = match given.name.is_null() {
        true => "splats",
        // SAFETY: as above.
        false => unsafe { text(given.name, "name") }?,
    };
    Ok(Object { name: name.to_owned(), splats, closed: given.closed != vk::FALSE })
}
