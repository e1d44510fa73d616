#include "camera.h"

#include <string.h>

#define PI 3.14159265358979323846

void stage_set(struct stage *stage, const double lower[3], const double upper[3], const struct model *model) {
    memcpy(stage->lower, lower, sizeof stage->lower);
    memcpy(stage->upper, upper, sizeof stage->upper);
    const struct vector low = {lower[0], lower[1], lower[2]};
    const struct vector high = {upper[0], upper[1], upper[2]};
    stage->center = vector_scale(vector_add(low, high), 0.5);
    stage->radius = 0.5 * vector_length(vector_subtract(high, low));
    /* An empty mesh has infinite bounds, and one point has no size; the picture is then only background. */
    if (!isfinite(stage->radius) || !(stage->radius > 0.0)) {
        stage->radius = 1.0;
        if (!isfinite(vector_length(stage->center))) stage->center = (struct vector){0, 0, 0};
        for (int k = 0; k < 3; ++k) {
            const double middle = k == 0 ? stage->center.x : k == 1 ? stage->center.y : stage->center.z;
            stage->lower[k] = middle - 0.5;
            stage->upper[k] = middle + 0.5;
        }
    }
    const bool z_up = model->up == MODEL_UP_Z;
    stage->up = z_up ? (struct vector){0, 0, 1} : (struct vector){0, 1, 0};
    stage->front = z_up ? (struct vector){1, 0, 0} : (struct vector){0, 0, 1};
    stage->side = vector_cross(stage->up, stage->front);
    const double lowest = z_up ? stage->lower[2] : stage->lower[1];
    stage->ground = model->ground > lowest ? model->ground : lowest;
}

static bool stage_holds(const struct stage *stage, struct vector p) {
    const double value[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; ++k)
        if (!(value[k] >= stage->lower[k] && value[k] <= stage->upper[k])) return false;
    return vector_dot(p, stage->up) >= stage->ground;
}

/* Three-quarter view: level angle from the front, and height above the horizon. */
static struct vector towards(const struct stage *stage, double azimuth, double elevation) {
    const struct vector level =
        vector_add(vector_scale(stage->front, cos(azimuth)), vector_scale(stage->side, sin(azimuth)));
    return vector_add(vector_scale(level, cos(elevation)), vector_scale(stage->up, sin(elevation)));
}

/* The eye's distance along `away` from which all that can be seen of the model fits around `aim`, and by how much
 * the aim is off the middle of it, across and down. */
static double fit(const struct model *model, const struct stage *stage, const struct camera *camera, struct vector aim,
                  double tangent, double distance, double off[2]) {
    double nearest = 0.0;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint64_t i = 0; i < model->triangles.vertex_count; ++i) {
        const struct vector p = model_vertex(model, i);
        /* A file may hold vertices that belong to no triangle, and a ground may hide some. */
        if (!stage_holds(stage, p)) continue;
        const struct vector from_aim = vector_subtract(p, aim);
        const double across = vector_dot(from_aim, camera->right);
        const double down = vector_dot(from_aim, camera->down);
        const double deep = vector_dot(from_aim, camera->forward);
        nearest = fmax(nearest, fmax(fabs(across), fabs(down)) / tangent - deep);
        const double scale = distance / fmax(distance + deep, 0.1 * distance);
        low[0] = fmin(low[0], across * scale);
        high[0] = fmax(high[0], across * scale);
        low[1] = fmin(low[1], down * scale);
        high[1] = fmax(high[1], down * scale);
    }
    for (int k = 0; k < 2; ++k) off[k] = low[k] <= high[k] ? 0.5 * (low[k] + high[k]) : 0.0;
    return nearest > 0.0 ? nearest : 3.0 * stage->radius;
}

void camera_frame(struct camera *camera, const struct model *model, const struct stage *stage, uint32_t size) {
    const double margin = 1.28;
    const double tangent = tan(0.5 * 36.0 * PI / 180.0);
    const struct vector away = towards(stage, 32.0 * PI / 180.0, 24.0 * PI / 180.0);
    camera->forward = vector_scale(away, -1.0);
    camera->right = vector_unit(vector_cross(camera->forward, stage->up));
    camera->down = vector_cross(camera->forward, camera->right);

    /* Perspective enlarges what is near, so the middle of the box is not the middle of the picture. Each round moves
     * the aim to where the last picture's middle was; three bring it close enough. */
    struct vector aim = stage->center;
    double distance = 4.0 * stage->radius;
    double off[2];
    for (int round = 0; round < 4; ++round) {
        distance = fit(model, stage, camera, aim, tangent / margin, distance, off);
        if (round == 3) break;
        aim = vector_add(aim, vector_scale(camera->right, off[0]));
        aim = vector_add(aim, vector_scale(camera->down, off[1]));
    }
    camera->eye = vector_add(aim, vector_scale(away, distance));
    camera->right = vector_scale(camera->right, tangent);
    camera->down = vector_scale(camera->down, tangent);
    camera->half_angle = atan(sqrt(2.0) * tangent);
    camera->size = size;
}

void camera_directions(const struct camera *camera, uint32_t row, uint32_t rows, double dx, double dy,
                       float *directions) {
    const double pixel = 2.0 / camera->size;
    for (uint32_t y = row; y < row + rows; ++y) {
        const struct vector left = vector_add(camera->forward, vector_scale(camera->down, (y + dy) * pixel - 1.0));
        for (uint32_t x = 0; x < camera->size; ++x, directions += 3) {
            const struct vector d = vector_add(left, vector_scale(camera->right, (x + dx) * pixel - 1.0));
            directions[0] = (float)d.x;
            directions[1] = (float)d.y;
            directions[2] = (float)d.z;
        }
    }
}

void lamp_place(struct lamp *lamp, const struct stage *stage, double reach) {
    /* From the viewer's left and well above, so that shadows fall to the right and a little to the back. */
    const struct vector away = towards(stage, -38.0 * PI / 180.0, 48.0 * PI / 180.0);
    const double distance = 3.0 * reach;
    lamp->point = vector_add(stage->center, vector_scale(away, distance));
    lamp->forward = vector_scale(away, -1.0);
    lamp->half_angle = asin(reach / distance);
}

static void store(double out[3], struct vector v) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static rw_view_options point_view(struct vector point, struct vector forward, double half_angle, uint64_t rays,
                                  int32_t kind) {
    rw_view_options options;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.kind = RW_VIEW_POINT;
    store(options.origin, point);
    store(options.direction, forward);
    options.half_angle = half_angle * 1.0001; /* the outermost rays are rounded too */
    options.count = rays;
    options.ray_kind = kind;
    return options;
}

rw_view_options camera_view(const struct camera *camera, uint64_t rays) {
    return point_view(camera->eye, camera->forward, camera->half_angle, rays, RW_RAYS_CAMERA);
}

rw_view_options lamp_view(const struct lamp *lamp, uint64_t rays) {
    return point_view(lamp->point, lamp->forward, lamp->half_angle, rays, RW_RAYS_SHADOW);
}
