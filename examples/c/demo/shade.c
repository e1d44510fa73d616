#include "shade.h"

#include <string.h>

/* Linear RGB throughout. */
static const struct vector backdrop_top = {0.33, 0.42, 0.55};
static const struct vector backdrop_bottom = {0.84, 0.86, 0.88};
static const struct vector lamp_colour = {1.02, 0.95, 0.84};
static const struct vector light_above = {0.30, 0.36, 0.45}; /* of the sky, on what faces up */
static const struct vector light_below = {0.14, 0.12, 0.10}; /* of the ground, on what faces down */
#define AMBIENT 0.03

/* Corners sharper than about 45 degrees stay sharp. */
#define CREASE_COSINE 0.7

static struct vector backdrop(double height) {
    return vector_mix(backdrop_top, backdrop_bottom, smooth_step(-0.1, 0.85, height));
}

static struct vector times(struct vector a, struct vector b) {
    return (struct vector){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* The normals of the corners, blended with u and v as raywise defines them: (1 - u - v), u, v. */
static struct vector smooth_normal(const struct model *model, const rw_hit *hit, struct vector face) {
    if (model->vertex_normals == NULL) return face;
    const double weight[3] = {1.0 - hit->u - hit->v, hit->u, hit->v};
    uint64_t corner[3];
    model_corners(model, hit->primitive, corner);
    struct vector sum = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const float *n = model->vertex_normals + 3 * corner[k];
        struct vector normal = vector_unit((struct vector){n[0], n[1], n[2]});
        if (vector_dot(normal, face) < CREASE_COSINE) normal = face;
        sum = vector_add(sum, vector_scale(normal, weight[k]));
    }
    return vector_unit(sum);
}

void shade_hit(const struct look *look, const struct surface_hit *found, const float direction[3], double height,
               struct shade *shade) {
    memset(shade, 0, sizeof *shade);
    const rw_hit *hit = &found->hit;
    const struct vector behind = backdrop(height);
    if (hit->primitive == RW_INVALID_ID) {
        shade->dark = behind;
        return;
    }

    const struct vector ray = {direction[0], direction[1], direction[2]};
    const struct vector point = vector_add(look->camera->eye, vector_scale(ray, hit->t));
    const bool on_ground = look->ground != NULL && hit->geometry == 1;
    struct vector face = {found->normal[0], found->normal[1], found->normal[2]};
    struct vector normal = on_ground ? face : smooth_normal(look->model, hit, face);
    /* Two-sided: meshes from files are open or wound inside out often enough. */
    if (vector_dot(face, ray) > 0.0) {
        face = vector_scale(face, -1.0);
        normal = vector_scale(normal, -1.0);
    }

    const uint8_t paint = look->model->paint != NULL && !on_ground ? look->model->paint[hit->primitive] : 0;
    const struct vector colour = on_ground ? look->model->ground_colour : look->model->palette[paint];
    const double facing_up = 0.5 + 0.5 * vector_dot(normal, look->stage->up);
    const struct vector around = vector_mix(light_below, light_above, facing_up);
    shade->dark = vector_add(vector_scale(colour, AMBIENT), times(colour, around));

    /* The shadow ray ends a little in front of the surface, on the viewer's side, so that the surface does not
     * shadow itself. */
    const struct vector end = vector_add(point, vector_scale(face, 1e-4 * look->stage->radius));
    const struct vector from_lamp = vector_subtract(end, look->lamp->point);
    const struct vector to_lamp = vector_unit(vector_scale(from_lamp, -1.0));
    const double lambert = vector_dot(normal, to_lamp);
    if (lambert > 0.0 && vector_dot(face, to_lamp) > 0.0) {
        shade->lit = vector_scale(times(colour, lamp_colour), lambert);
        if (!on_ground) {
            const struct vector halfway = vector_unit(vector_subtract(to_lamp, vector_unit(ray)));
            const double shine = 0.14 * pow(clamp01(vector_dot(normal, halfway)), 60.0);
            shade->lit = vector_add(shade->lit, vector_scale(lamp_colour, shine));
        }
        shade->asks_lamp = true;
        shade->from_lamp[0] = (float)from_lamp.x;
        shade->from_lamp[1] = (float)from_lamp.y;
        shade->from_lamp[2] = (float)from_lamp.z;
    }

    /* The ground has no visible end: far from the middle it turns into the backdrop. */
    if (on_ground) {
        const double away = vector_length(vector_subtract(point, look->ground->middle));
        const double fade = smooth_step(look->ground->fades_from, look->ground->fades_to, away);
        shade->dark = vector_mix(shade->dark, behind, fade);
        shade->lit = vector_scale(shade->lit, 1.0 - fade);
        shade->asks_lamp = shade->asks_lamp && fade < 1.0;
    }
}
