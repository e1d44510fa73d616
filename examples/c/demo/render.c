#include "render.h"

#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Rays in a block of rows: enough to keep all threads busy, few enough that progress moves and buffers stay small. */
#define BLOCK_RAYS 131072u

/* The other three samples of a pixel are taken when they are done in about so many seconds. */
#define MORE_SAMPLES_NS 15e9

struct buffers {
    struct surface_hit *hits;
    struct ray_list camera;
    struct ray_list shadows;
    uint32_t *shadow_pixel; /* of each shadow ray, within the block */
    struct vector *lit;     /* what each shadow ray brings when it arrives */
    uint8_t *occluded;
};

static uint32_t block_rows(uint32_t size) {
    const uint32_t rows = BLOCK_RAYS / size;
    return rows < 1 ? 1 : rows < size ? rows : size;
}

static void buffers_free(struct buffers *buffers) {
    free(buffers->hits);
    ray_list_free(&buffers->camera);
    ray_list_free(&buffers->shadows);
    free(buffers->shadow_pixel);
    free(buffers->lit);
    free(buffers->occluded);
    memset(buffers, 0, sizeof *buffers);
}

static bool buffers_make(struct buffers *buffers, const struct look *look) {
    memset(buffers, 0, sizeof *buffers);
    const uint64_t most = (uint64_t)block_rows(look->camera->size) * look->camera->size;
    if (!ray_list_reserve(&buffers->camera, most, false) || !ray_list_reserve(&buffers->shadows, most, false))
        return false;
    buffers->camera.origin = look->camera->eye;
    buffers->shadows.origin = look->lamp->point;
    buffers->shadows.tmax = 1.0;
    buffers->hits = calloc(most, sizeof *buffers->hits);
    buffers->shadow_pixel = malloc(most * sizeof *buffers->shadow_pixel);
    buffers->lit = malloc(most * sizeof *buffers->lit);
    buffers->occluded = malloc(most);
    if (buffers->hits == NULL || buffers->shadow_pixel == NULL || buffers->lit == NULL || buffers->occluded == NULL) {
        fprintf(stderr, "raywise-demo: out of memory for rendering\n");
        return false;
    }
    return true;
}

/* One block of one sample: camera rays, shading, shadow rays. */
static bool render_block(struct picture *picture, const struct look *look, const struct target *camera,
                         const struct target *lamp, uint32_t row, uint32_t rows, double dx, double dy,
                         struct buffers *buffers, struct check *check) {
    const uint32_t size = picture->size;
    const uint64_t pixels = (uint64_t)rows * size;
    float *sum = picture->sum + (uint64_t)row * size * 3;
    camera_directions(look->camera, row, rows, dx, dy, buffers->camera.directions);
    const rw_hits outputs = ask_whole_hits(buffers->hits);
    double start = clock_ns();
    if (!ask_batch(camera, &buffers->camera, 0, pixels, &outputs, NULL)) return false;
    picture->camera_ns += clock_ns() - start;
    picture->camera_rays += pixels;

    uint64_t shadows = 0;
    for (uint64_t i = 0; i < pixels; ++i) {
        struct shade shade;
        const double height = ((double)row + (double)(i / size) + dy) / size;
        shade_hit(look, &buffers->hits[i], buffers->camera.directions + 3 * i, height, &shade);
        sum[3 * i + 0] += (float)shade.dark.x;
        sum[3 * i + 1] += (float)shade.dark.y;
        sum[3 * i + 2] += (float)shade.dark.z;
        if (!shade.asks_lamp) continue;
        memcpy(buffers->shadows.directions + 3 * shadows, shade.from_lamp, sizeof shade.from_lamp);
        buffers->shadow_pixel[shadows] = (uint32_t)i;
        buffers->lit[shadows] = shade.lit;
        ++shadows;
    }
    if (shadows > 0) {
        start = clock_ns();
        if (!ask_batch(lamp, &buffers->shadows, 0, shadows, NULL, buffers->occluded)) return false;
        picture->shadow_ns += clock_ns() - start;
        picture->shadow_rays += shadows;
    }
    for (uint64_t i = 0; i < shadows; ++i) {
        if (buffers->occluded[i]) continue;
        float *pixel = sum + 3 * (uint64_t)buffers->shadow_pixel[i];
        pixel[0] += (float)buffers->lit[i].x;
        pixel[1] += (float)buffers->lit[i].y;
        pixel[2] += (float)buffers->lit[i].z;
    }

    if (check == NULL) return true;
    uint64_t shadow = 0;
    for (uint64_t i = 0; i < pixels; ++i) {
        while (shadow < shadows && buffers->shadow_pixel[shadow] < i) ++shadow;
        if (((uint64_t)row * size + i) % check->every != 0 || check->hit_count == CHECK_MOST) continue;
        memcpy(check->directions[check->hit_count], buffers->camera.directions + 3 * i, 3 * sizeof(float));
        check->hits[check->hit_count++] = buffers->hits[i];
        if (shadow < shadows && buffers->shadow_pixel[shadow] == i) {
            memcpy(check->shadow_directions[check->shadow_count], buffers->shadows.directions + 3 * shadow,
                   3 * sizeof(float));
            check->occluded[check->shadow_count++] = buffers->occluded[shadow];
        }
    }
    return true;
}

bool render(struct picture *picture, const struct look *look, const struct target *camera, const struct target *lamp,
            uint32_t samples, struct check *check) {
    memset(picture, 0, sizeof *picture);
    const uint32_t size = look->camera->size;
    picture->size = size;
    picture->sum = calloc((size_t)size * size, 3 * sizeof(float));
    if (picture->sum == NULL) {
        fprintf(stderr, "raywise-demo: out of memory for the picture\n");
        return false;
    }
    /* A step that shares no factor with the width visits all columns instead of a few. */
    check->every = (uint64_t)size * size / CHECK_MOST + 1;
    while (check->every > 1 && (check->every % 2 == 0 || size % check->every == 0)) ++check->every;

    struct buffers buffers;
    bool good = buffers_make(&buffers, look);
    struct progress progress;
    progress_begin(&progress, "rendering");
    const uint32_t rows = block_rows(size);
    const double start = clock_ns();
    uint32_t wanted = samples;
    for (uint32_t sample = 0; good && (sample == 0 || sample < wanted); ++sample) {
        const double dx = samples == 1 ? 0.5 : 0.25 + 0.5 * (sample & 1);
        const double dy = samples == 1 ? 0.5 : 0.25 + 0.5 * (sample >> 1);
        for (uint32_t row = 0; good && row < size; row += rows) {
            const uint32_t some = size - row < rows ? size - row : rows;
            good = render_block(picture, look, camera, lamp, row, some, dx, dy, &buffers, sample == 0 ? check : NULL);
            const double share = (sample + (double)(row + some) / size) / (wanted != 0 ? wanted : 1);
            progress_update(&progress, share);
        }
        ++picture->samples;
        if (wanted == 0) wanted = 3.0 * (clock_ns() - start) <= MORE_SAMPLES_NS ? 4 : 1;
    }
    progress_end(&progress);
    buffers_free(&buffers);
    return good;
}

void picture_free(struct picture *picture) {
    free(picture->sum);
    memset(picture, 0, sizeof *picture);
}

bool render_camera_rays(const struct look *look, struct ray_list *list) {
    const uint32_t size = look->camera->size;
    if (!ray_list_reserve(list, (uint64_t)size * size, false)) return false;
    list->origin = look->camera->eye;
    camera_directions(look->camera, 0, size, 0.5, 0.5, list->directions);
    return true;
}

bool render_shadow_rays(const struct look *look, const struct target *camera, const struct ray_list *list,
                        struct ray_list *shadows) {
    const uint32_t size = look->camera->size;
    const uint64_t block = (uint64_t)block_rows(size) * size;
    struct surface_hit *hits = calloc(block, sizeof *hits);
    if (hits == NULL || !ray_list_reserve(shadows, list->count, false)) {
        if (hits == NULL) fprintf(stderr, "raywise-demo: out of memory for the shadow rays\n");
        free(hits);
        return false;
    }
    shadows->origin = look->lamp->point;
    shadows->tmax = 1.0;
    shadows->count = 0;
    struct progress progress;
    progress_begin(&progress, "finding the shadow rays");
    bool good = true;
    for (uint64_t first = 0; good && first < list->count; first += block) {
        const uint64_t count = list->count - first < block ? list->count - first : block;
        const rw_hits outputs = ask_whole_hits(hits);
        good = ask_batch(camera, list, first, count, &outputs, NULL);
        for (uint64_t i = 0; good && i < count; ++i) {
            struct shade shade;
            shade_hit(look, &hits[i], list->directions + 3 * (first + i), 0.0, &shade);
            if (shade.asks_lamp)
                memcpy(shadows->directions + 3 * shadows->count++, shade.from_lamp, sizeof shade.from_lamp);
        }
        progress_update(&progress, (double)(first + count) / (double)list->count);
    }
    progress_end(&progress);
    free(hits);
    return good;
}
