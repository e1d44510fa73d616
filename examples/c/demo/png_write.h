#ifndef DEMO_PNG_WRITE_H
#define DEMO_PNG_WRITE_H

#include "render.h"

/* Turns sums of linear light into sRGB and writes a PNG file. False with a message on failure. */
bool png_write(const struct picture *picture, const char *path);

#endif
