/* Faces of many corners, read from files and asked by rays: surface where the polygon has its inside, once, and nowhere else. */
#include "testing.h"

#include <unistd.h>

typedef struct shape {
    const char *name;
    int count;
    int corners[16][2];
    const char *inside[9]; /* rows of unit squares from the top; '#': of the polygon */
} shape;

static const shape shapes[] = {
    {"a notch", 8, {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, {"#.#", "#.#", "###"}},
    {"two holes, joined to the outline by lines there and back",
     16,
     {{0, 0},
      {5, 0},
      {5, 5},
      {0, 5},
      {0, 0},
      {1, 1},
      {1, 2},
      {2, 2},
      {3, 3},
      {3, 4},
      {4, 4},
      {4, 3},
      {3, 3},
      {2, 2},
      {2, 1},
      {1, 1}},
     {"#####", "###.#", "#####", "#.###", "#####"}},
    {"a comb",
     12,
     {{0, 3}, {0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 3}},
     {"#...#", "#.#.#", "#####"}},
};

static char folder[] = "/tmp/raywise-polygons-XXXXXX";

/* A corner the outline comes back to is the same vertex, or another at the same place. */
static int vertex_of(const shape *s, int corner, int own) {
    int i = 0;
    while (!own && memcmp(s->corners[i], s->corners[corner], sizeof s->corners[i]) != 0) ++i;
    return own ? corner : i;
}

/* The shape in a tilted plane, from its corner `first` on, in one direction or the other. */
static const char *write_shape(const char *ending, const shape *s, int first, int reversed) {
    static char path[512];
    const int is_obj = strcmp(ending, ".obj") == 0;
    FILE *file;
    int i;
    snprintf(path, sizeof path, "%s/shape%s", folder, ending);
    file = fopen(path, "w");
    if (file == NULL) exit(1);
    if (strcmp(ending, ".off") == 0) fprintf(file, "OFF\n%d 1 0\n", s->count);
    if (strcmp(ending, ".ply") == 0) {
        fprintf(file,
                "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 1\nproperty list uchar int vertex_indices\nend_header\n",
                s->count);
    }
    for (i = 0; i < s->count; ++i) {
        const int x = s->corners[i][0], y = s->corners[i][1];
        fprintf(file, "%s%d %d %d\n", is_obj ? "v " : "", x, y, 2 * x - y);
    }
    if (is_obj) {
        fprintf(file, "f");
    } else {
        fprintf(file, "%d", s->count);
    }
    for (i = 0; i < s->count; ++i) {
        const int step = reversed ? s->count - i : i;
        fprintf(file, " %d", vertex_of(s, (first + step) % s->count, reversed) + is_obj);
    }
    fprintf(file, "\n");
    if (fclose(file) != 0) exit(1);
    return path;
}

static rw_scene *scene_of(const char *path, const char *structure, int count) {
    rw_mesh *mesh = NULL;
    rw_scene *scene = NULL;
    rw_triangles t;
    uint64_t faces = 0;
    const uint32_t *face_of_triangle = NULL;
    NEED_OK(rw_mesh_load(path, &mesh));
    t.struct_size = sizeof t;
    NEED_OK(rw_mesh_triangles(mesh, &t));
    CHECK(t.triangle_count == (uint64_t)count - 2);
    CHECK_OK(rw_mesh_faces(mesh, &face_of_triangle, &faces));
    CHECK(faces == 1);
    NEED_OK(rw_scene_create(NULL, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, NULL));
    NEED_OK(rw_scene_set_structure(scene, structure));
    NEED_OK(rw_scene_commit(scene, NULL));
    rw_mesh_release(mesh);
    return scene;
}

/* Down onto (x, y); how many hits there are, each on the plane and from the side that is wanted. */
static uint64_t hits_at(const rw_scene *scene, double x, double y, int upward) {
    rw_ray ray;
    rw_hit hits[8];
    double normal[3];
    uint64_t count = 0;
    memset(&ray, 0, sizeof ray);
    ray.origin[0] = x;
    ray.origin[1] = y;
    ray.origin[2] = 100.0;
    ray.direction[2] = -1.0;
    ray.tmax = INFINITY;
    CHECK_OK(rw_scene_intersect_all(scene, &ray, NULL, hits, 8, &count));
    if (count == 1) {
        CHECK(fabs(hits[0].t - (100.0 - (2.0 * x - y))) < 1e-9);
        CHECK_OK(rw_scene_normal(scene, &hits[0], normal));
        CHECK((normal[2] > 0.0) == upward);
    }
    return count;
}

/* Points of every unit square in and around the shape, those on lines between triangles included. */
static void ask(const rw_scene *scene, const shape *s, int rows, int upward) {
    const int columns = (int)strlen(s->inside[0]);
    int x, y;
    for (y = -2; y < 4 * rows + 2; ++y) {
        for (x = -2; x < 4 * columns + 2; ++x) {
            const double px = 0.25 * x + 0.125, py = 0.25 * y + 0.125;
            const int row = rows - 1 - (int)floor(py), column = (int)floor(px);
            const int is_square = row >= 0 && row < rows && column >= 0 && column < columns;
            const uint64_t wanted = is_square && s->inside[row][column] == '#';
            if (!CHECK(hits_at(scene, px, py, upward) == wanted))
                fprintf(stderr, "    at %g %g of %s\n", px, py, s->name);
        }
    }
}

int main(void) {
    static const char *const endings[] = {".obj", ".off", ".ply"};
    uint32_t structures = 0;
    size_t ending, which;
    char command[600];
    use_all_helpers();
    if (mkdtemp(folder) == NULL) return 1;
    NEED_OK(rw_structure_count(&structures));
    for (ending = 0; ending < sizeof endings / sizeof endings[0]; ++ending) {
        for (which = 0; which < sizeof shapes / sizeof shapes[0]; ++which) {
            const shape *s = &shapes[which];
            int rows = 0, first;
            while (s->inside[rows] != NULL) ++rows;
            for (first = 0; first < s->count; ++first) {
                const char *name = NULL;
                const char *path = write_shape(endings[ending], s, first, first % 2);
                rw_scene *scene;
                NEED_OK(rw_structure_name((uint32_t)first % structures, &name));
                scene = scene_of(path, name, s->count);
                ask(scene, s, rows, first % 2 == 0);
                if (which == 0) CHECK(hits_at(scene, 1.5, 2.0, 1) == 0);
                rw_scene_release(scene);
            }
        }
    }
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0) return 1;
    return finish("polygons");
}
