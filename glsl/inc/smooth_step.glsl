// From 0 at x = 0 to 1 at 1, flat at both ends.
float smooth_step(float x)
{
    x = clamp(x, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}
