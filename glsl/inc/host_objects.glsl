// Objects as a host numbers them, and how each has moved. The host's mirror is `HostObject` in src/passes/pipeline/constants.rs; the build compares the
// offsets.
//
// A pixel, 1 and w, times a matrix, is where the point that is seen there was a frame before, as a homogeneous place in the picture (src/embed/motion.rs). The rows are of
// that matrix less the one of what stands still, so that what moves little loses nothing: with X and W what those rows give, where it was is (x + X) / (1 + W),
// and x less that is (x W - X) / (1 + W).

struct HostObject {
    vec4 x;    // times (x, y, 1, w), with x and y in pixels from the view's corner
    vec4 y;
    vec4 over; // of what divides
    uint id;   // the host's own number
    uint unused[3];
};

layout(set = 1, binding = 0) uniform utexture2D object_numbers; // one more than the number in `objects`; 0: nothing
layout(set = 1, binding = 1, std430) readonly buffer Objects { HostObject objects[]; };

const uint NO_OBJECT = 0xffffffffu;

vec2 motion_of(HostObject object, vec4 seen)
{
    float over = dot(object.over, seen);
    vec2 moved = seen.xy * over - vec2(dot(object.x, seen), dot(object.y, seen));
    // What was behind the eye was nowhere in the picture.
    return over > -1.0 ? moved / (1.0 + over) : vec2(0.0);
}
