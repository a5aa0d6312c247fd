// Visibility splatting: the depth of the splat, moved away from the eye by epsilon (Guennebaud et al. 2006, section 2;
// Pajarola et al. 2003, figure 15). Reversed depth: nearer is larger. extra().x is 1 / f.

void main()
{
    gl_FragDepth = covered_uvw().z * extra().x;
}
