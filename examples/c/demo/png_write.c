#include "png_write.h"

#include <png.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The sRGB transfer curve (IEC 61966-2-1). */
static png_byte encode(double linear) {
    const double value = clamp01(linear);
    const double curved = value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1.0 / 2.4) - 0.055;
    return (png_byte)(255.0 * curved + 0.5);
}

bool png_write(const struct picture *picture, const char *path) {
    const size_t values = (size_t)picture->size * picture->size * 3;
    png_bytep bytes = malloc(values);
    if (bytes == NULL) {
        fprintf(stderr, "raywise-demo: out of memory for the picture\n");
        return false;
    }
    for (size_t i = 0; i < values; ++i) bytes[i] = encode(picture->sum[i] / picture->samples);

    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = picture->size;
    image.height = picture->size;
    image.format = PNG_FORMAT_RGB;
    const bool written = png_image_write_to_file(&image, path, 0, bytes, 0, NULL) != 0;
    if (!written) fprintf(stderr, "raywise-demo: cannot write %s: %s\n", path, image.message);
    png_image_free(&image);
    free(bytes);
    return written;
}
