/* All hits of rays exactly through edges and corners: a closed mesh is entered as often as it is left, from every structure. */
#include "testing.h"

static const double corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint32_t faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

static rw_scene *box(const char *structure) {
    rw_scene *scene = NULL;
    rw_triangles t;
    memset(&t, 0, sizeof t);
    t.struct_size = sizeof t;
    t.vertex_count = 8;
    t.vertices.data = corners;
    t.vertices.type = RW_FLOAT64;
    t.triangle_count = 12;
    t.indices.data = faces;
    NEED_OK(rw_scene_create(NULL, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
    NEED_OK(rw_scene_set_structure(scene, structure));
    NEED_OK(rw_scene_commit(scene, NULL));
    return scene;
}

/* From the points of a grid around, on and in the box, towards those of another: most pass exactly through edges and
 * corners, along edges or in the planes of faces. */
static void check_grid(const rw_scene *scene, const rw_scene *scan) {
    int from, to;
    for (from = 0; from < 343; ++from) {
        const double origin[3] = {from % 7 - 3.0, from / 7 % 7 - 3.0, from / 49 - 3.0};
        const double largest = fmax(fabs(origin[0]), fmax(fabs(origin[1]), fabs(origin[2])));
        for (to = 0; to < 125; ++to) {
            const double target[3] = {to % 5 - 2.0, to / 5 % 5 - 2.0, to / 25 - 2.0};
            rw_ray ray;
            rw_hit all[16], same[16], closest;
            uint64_t count = 0, again = 0;
            int32_t occluded = -1;
            int axis;
            for (axis = 0; axis < 3; ++axis) {
                ray.origin[axis] = origin[axis];
                ray.direction[axis] = target[axis] - origin[axis];
            }
            ray.tmin = 0.0;
            ray.tmax = INFINITY;
            CHECK_OK(rw_scene_intersect_all(scene, &ray, NULL, all, 16, &count));
            CHECK_OK(rw_scene_intersect_all(scan, &ray, NULL, same, 16, &again));
            CHECK(count == again && memcmp(all, same, (size_t)count * sizeof all[0]) == 0);
            CHECK_OK(rw_scene_intersect(scene, &ray, NULL, &closest));
            CHECK_OK(rw_scene_occluded(scene, &ray, NULL, &occluded));
            CHECK(occluded == (count > 0));
            if (count > 0) CHECK(memcmp(&closest, &all[0], sizeof closest) == 0);
            if (count == 0) CHECK(closest.primitive == RW_INVALID_ID);
            if (ray.direction[0] == 0.0 && ray.direction[1] == 0.0 && ray.direction[2] == 0.0) {
                CHECK(count == 0);
            } else if (largest > 1.0) {
                CHECK(count == 0 || count == 2);
            } else if (largest < 1.0) {
                CHECK(count == 1);
            }
        }
    }
}

int main(void) {
    uint32_t structures = 0, i;
    rw_scene *scan = box("linear_scan");
    use_all_helpers();
    NEED_OK(rw_structure_count(&structures));
    for (i = 0; i < structures; ++i) {
        const char *name = NULL;
        rw_scene *scene;
        NEED_OK(rw_structure_name(i, &name));
        scene = box(name);
        check_grid(scene, scan);
        rw_scene_release(scene);
    }
    rw_scene_release(scan);
    return finish("crossings");
}
