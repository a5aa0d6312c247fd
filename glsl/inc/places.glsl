// Where places in the image are counted from as they are handed over to fragments: from the middle of the image, where thin
// splats keep the digits they need; but those of sprites that a filter keeps at least h wide from its corner, as the device counts,
// in images of up to 8192 pixels: a place is rounded by 2^-12 pixels there at most, by which r^2 is off by 5e-4, and a fragment need
// not load the image's size (9% of a frame on a CPU).

#if defined(PLAIN)
const bool PLACES_FROM_CORNER = FROM_CORNER;
#else
const bool PLACES_FROM_CORNER = false;
#endif
