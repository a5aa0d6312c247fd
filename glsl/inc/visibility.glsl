// Visibility splatting: the depth of the splat, moved away from the eye by epsilon (Guennebaud et al. 2006, section 2;
// Pajarola et al. 2003, figure 15). Reversed depth: nearer is larger. extra().x is 1 / f.

// What is seen here must be accumulated later, or a pixel would hide what is behind and stay empty. The passes are
// different pipelines, whose divisions may differ in the last bits: so visibility covers a hair less.
const float HAIR = 1.0 - 4e-6;

void main()
{
    gl_FragDepth = covered_uvw(HAIR * frame.coverage_r2).z * extra().x;
}
