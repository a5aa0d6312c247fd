/* Programs that have no device of their own. */
#ifndef MODELS_H
#define MODELS_H

#include "check.h"

/* Files read, written and made. `saved`: where a file may be; `scene_file`: one that names it, from another folder. */
void models(const char *saved, const char *scene_file);

#endif
