// The half axis that is drawn in place of one of length l (adjust.glsl).

const float PART_OF_AXIS = 250.0 / 251.0;
const float PART_OF_FILTER = 609.0 / 610.0;

float widened_axis(float l, float h)
{
    return max(sqrt(PART_OF_AXIS * FORMULA(FORMULA_WIDENED, l * l) + PART_OF_FILTER * h * h), max(l, h));
}
