// One over the square of the minor half axis, in pixels, of the image of a splat whose map has this change of u along x and y, and of v, per pixel: the larger
// singular value, squared.
float inverse_minor2(vec4 uv)
{
    float sum = dot(uv, uv);
    float det = uv.x * uv.w - uv.y * uv.z;
    return 0.5 * (sum + sqrt(max(sum * sum - 4.0 * det * det, 0.0)));
}
