/* A program built with the header of an earlier release, linked with the library of today: it runs, and gets the answers it
 * got. Its structs have the size they had then and end where a page that nobody may touch begins, with known bytes in
 * front: the library neither reads nor writes outside of them.
 *
 * Compiled once for each header in previous/, so it may use nothing that came after 0.2. */
#include "testing.h"

#include <sys/mman.h>
#include <unistd.h>

#define RAYS 60
#define TRIANGLES 200

/* ---- memory with walls around it ---------------------------------------------------------------- */

typedef struct walled {
    unsigned char *pages;
    size_t room; /* bytes before the forbidden page */
    size_t used; /* the last of them */
} walled;

static walled all_walled[16384];
static size_t walled_count;
#define IN_FRONT 0xA5

static void *at_the_wall(size_t size) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    walled *block = &all_walled[walled_count++];
    if (walled_count > sizeof all_walled / sizeof all_walled[0]) {
        fprintf(stderr, "all_walled: too small for what the program asks\n");
        exit(1);
    }
    block->used = size;
    block->room = (size + page - 1) / page * page + page;
    block->pages =
        (unsigned char *)mmap(NULL, block->room + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if ((void *)block->pages == MAP_FAILED || mprotect(block->pages + block->room, page, PROT_NONE) != 0) exit(1);
    memset(block->pages, IN_FRONT, block->room - size);
    return block->pages + (block->room - size);
}

static void check_walls(void) {
    size_t i, k;
    for (i = 0; i < walled_count; ++i) {
        const walled *block = &all_walled[i];
        int untouched = 1;
        for (k = 0; k < block->room - block->used; ++k) untouched = untouched && block->pages[k] == IN_FRONT;
        CHECK(untouched);
        munmap(block->pages, block->room + (size_t)sysconf(_SC_PAGESIZE));
    }
    walled_count = 0;
}

/* A struct all zero but for its size. The size is the first member of each, checked by the compiler. */
#define NEW(type) ((type *)new_struct(sizeof(type), sizeof(((type *)0)->struct_size)))
static void *new_struct(size_t size, size_t size_of_struct_size) {
    const uint32_t struct_size = (uint32_t)size;
    void *fresh = at_the_wall(size);
    if (size_of_struct_size != sizeof struct_size) exit(1);
    memcpy(fresh, &struct_size, sizeof struct_size);
    return fresh;
}

/* ---- the scene, the rays and the answers expected ------------------------------------------------ */

static float *vertices;              /* of a soup */
static uint32_t *indices;            /* of the same */
static double *wide_vertices;        /* another mesh, float64 without indices */
static rw_ray *rays_in;              /* RAYS of them */
static rw_hit wanted[RAYS];          /* by the linear scan */
static float wanted_normal[RAYS][3]; /* zero for a miss */
static uint64_t wanted_all[RAYS];

static rw_triangles *narrow_mesh(void) {
    rw_triangles *t = NEW(rw_triangles);
    t->vertex_count = 3 * TRIANGLES;
    t->vertices.data = vertices;
    t->triangle_count = TRIANGLES;
    t->indices.data = indices;
    return t;
}

static rw_triangles *wide_mesh(void) {
    rw_triangles *t = NEW(rw_triangles);
    t->flags = RW_TRIANGLES_SHARED | RW_TRIANGLES_SKIP_INVALID;
    t->vertex_count = 6;
    t->vertices.data = wide_vertices;
    t->vertices.type = RW_FLOAT64;
    t->triangle_count = 2;
    return t;
}

static rw_rays *all_rays(void) {
    rw_rays *rays = NEW(rw_rays);
    rays->count = RAYS;
    rays->origin.data = rays_in[0].origin;
    rays->origin.stride = sizeof(rw_ray);
    rays->origin.type = RW_FLOAT64;
    rays->direction = rays->tmin = rays->tmax = rays->origin;
    rays->direction.data = rays_in[0].direction;
    rays->tmin.data = &rays_in[0].tmin;
    rays->tmax.data = &rays_in[0].tmax;
    return rays;
}

static void in_order(void *user, uint64_t count, rw_task task, void *task_data) {
    uint64_t i;
    for (i = 0; i < count; ++i) task(task_data, i);
    ++*(int *)user;
}

static int32_t keep_fraction(void *user, double fraction, const char *stage) {
    *(double *)user = fraction;
    return stage == NULL;
}

static void prepare(void) {
    soup s = make_soup(TRIANGLES);
    int i;
    static const double quad[18] = {-3, -3, 0.25, 3, -3, 0.25, 3, 3, 0.25, -3, -3, 0.25, 3, 3, 0.25, -3, 3, 0.25};
    vertices = (float *)at_the_wall(9 * TRIANGLES * sizeof(float));
    indices = (uint32_t *)at_the_wall(3 * TRIANGLES * sizeof(uint32_t));
    wide_vertices = (double *)at_the_wall(sizeof quad);
    rays_in = (rw_ray *)at_the_wall(RAYS * sizeof(rw_ray));
    memcpy(vertices, s.vertices, 9 * TRIANGLES * sizeof(float));
    memcpy(indices, s.indices, 3 * TRIANGLES * sizeof(uint32_t));
    memcpy(wide_vertices, quad, sizeof quad);
    for (i = 0; i < RAYS; ++i) rays_in[i] = random_ray();
    rays_in[RAYS - 1].direction[1] = NAN;
    free_soup(&s);
}

static rw_scene *filled_scene(const rw_profile *profile) {
    rw_scene *scene = NULL;
    uint32_t *geometry = (uint32_t *)at_the_wall(sizeof(uint32_t));
    NEED_OK(rw_scene_create(profile, &scene));
    NEED_OK(rw_scene_add_triangles(scene, narrow_mesh(), geometry));
    CHECK(*geometry == 0);
    NEED_OK(rw_scene_add_triangles(scene, wide_mesh(), geometry));
    CHECK(*geometry == 1);
    return scene;
}

/* ---- the questions, of a scene or of a view ------------------------------------------------------ */

typedef struct answers {
    float t[RAYS], uv[2 * RAYS], normal[3 * RAYS];
    uint32_t geometry[RAYS], primitive[RAYS];
    uint64_t instance[RAYS];
} answers;

static rw_hits *into(answers *to) {
    rw_hits *hits = NEW(rw_hits);
    hits->t.data = to->t;
    hits->uv.data = to->uv;
    hits->normal.data = to->normal;
    hits->instance.data = to->instance;
    hits->instance.type = RW_UINT64;
    hits->geometry.data = to->geometry;
    hits->primitive.data = to->primitive;
    return hits;
}

static void check_answer(const answers *a, int i, const rw_hit *hit) {
    CHECK(a->t[i] == (float)hit->t && a->uv[2 * i] == (float)hit->u && a->uv[2 * i + 1] == (float)hit->v);
    CHECK(memcmp(&a->normal[3 * i], wanted_normal[i], sizeof wanted_normal[i]) == 0);
    CHECK(a->geometry[i] == hit->geometry && a->primitive[i] == hit->primitive);
    CHECK(a->instance[i] == (hit->instance == RW_INVALID_ID ? 0xFFFFFFFFFFFFFFFFull : hit->instance));
}

static void ask_in_float32(const rw_scene *scene, int i) {
    rw_ray_f32 *ray = (rw_ray_f32 *)at_the_wall(sizeof(rw_ray_f32));
    rw_hit_f32 *hit = (rw_hit_f32 *)at_the_wall(sizeof(rw_hit_f32));
    rw_ray_options *options = NEW(rw_ray_options);
    rw_ray wide;
    rw_hit right;
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        wide.origin[axis] = ray->origin[axis] = (float)rays_in[i].origin[axis];
        wide.direction[axis] = ray->direction[axis] = (float)rays_in[i].direction[axis];
    }
    wide.tmin = ray->tmin = 0.0f;
    wide.tmax = ray->tmax = 1e9f;
    CHECK_OK(rw_scene_intersect(scene, &wide, NULL, &right));
    CHECK_OK(rw_scene_intersect_f32(scene, ray, options, hit));
    CHECK(hit->t == (float)right.t && hit->primitive == right.primitive && hit->geometry == right.geometry);
}

static void ask_singly(const rw_scene *scene) {
    rw_hit *hit = (rw_hit *)at_the_wall(sizeof(rw_hit));
    rw_ray *ray = (rw_ray *)at_the_wall(sizeof(rw_ray));
    rw_hit *list = (rw_hit *)at_the_wall(2 * sizeof(rw_hit));
    int32_t *occluded = (int32_t *)at_the_wall(sizeof(int32_t));
    uint64_t *needed = (uint64_t *)at_the_wall(sizeof(uint64_t));
    int i;
    for (i = 0; i < RAYS; ++i) {
        int32_t status;
        *ray = rays_in[i];
        CHECK_OK(rw_scene_intersect(scene, ray, NULL, hit));
        CHECK(memcmp(hit, &wanted[i], sizeof *hit) == 0);
        CHECK_OK(rw_scene_occluded(scene, ray, NULL, occluded));
        CHECK(*occluded == (wanted[i].primitive != RW_INVALID_ID));
        ask_in_float32(scene, i);
        status = rw_scene_intersect_all(scene, ray, NULL, list, 2, needed);
        CHECK(*needed == wanted_all[i] && status == (*needed > 2 ? RW_ERROR_CAPACITY : RW_OK));
        CHECK(*needed == 0 || memcmp(list, &wanted[i], sizeof *list) == 0);
    }
}

static void ask_in_batches(const rw_scene *scene) {
    answers *a = (answers *)at_the_wall(sizeof(answers));
    rw_rays *rays = all_rays();
    rw_hits *hits = into(a);
    rw_query_options *options = NEW(rw_query_options);
    rw_output *flags = (rw_output *)at_the_wall(sizeof(rw_output));
    uint8_t *occluded = (uint8_t *)at_the_wall(RAYS);
    uint64_t *offsets = (uint64_t *)at_the_wall((RAYS + 1) * sizeof(uint64_t));
    uint64_t *invalid = (uint64_t *)at_the_wall(sizeof(uint64_t)), *needed = (uint64_t *)at_the_wall(sizeof(uint64_t));
    double *fraction = (double *)at_the_wall(sizeof(double));
    int32_t *cancel = (int32_t *)at_the_wall(sizeof(int32_t));
    int calls = 0, i;
    options->threads = 2;
    options->parallel_for = in_order;
    options->parallel_user = &calls;
    options->invalid_rays = invalid;
    options->progress = keep_fraction;
    options->progress_user = fraction;
    options->cancel = cancel;
    *cancel = 0;
    memset(flags, 0, sizeof *flags);
    flags->data = occluded;

    CHECK_OK(rw_scene_intersect_batch(scene, rays, hits, options));
    CHECK(*invalid == 1 && calls > 0 && *fraction == 1.0);
    for (i = 0; i < RAYS; ++i) check_answer(a, i, &wanted[i]);
    CHECK_OK(rw_scene_occluded_batch(scene, rays, flags, options));
    for (i = 0; i < RAYS; ++i) CHECK(occluded[i] == (wanted[i].primitive != RW_INVALID_ID));

    CHECK_OK(rw_scene_intersect_all_batch(scene, rays, offsets, NULL, 0, needed, options));
    CHECK(offsets[0] == 0 && offsets[RAYS] == *needed);
    for (i = 0; i < RAYS; ++i) CHECK(offsets[i + 1] - offsets[i] == wanted_all[i]);
    {
        float *t = (float *)at_the_wall((size_t)*needed * sizeof(float));
        rw_hits *only_t = NEW(rw_hits);
        only_t->t.data = t;
        CHECK_OK(rw_scene_intersect_all_batch(scene, rays, offsets, only_t, *needed, needed, options));
        for (i = 0; i < RAYS; ++i) CHECK(wanted_all[i] == 0 || t[offsets[i]] == (float)wanted[i].t);
    }
}

static void ask_why(const rw_scene *scene, const char *chosen) {
    uint32_t *count = (uint32_t *)at_the_wall(sizeof(uint32_t)), i, found = 0;
    uint64_t *needed = (uint64_t *)at_the_wall(sizeof(uint64_t));
    char *text;
    CHECK_OK(rw_scene_candidate_count(scene, count));
    for (i = 0; i < *count; ++i) {
        rw_candidate *candidate = NEW(rw_candidate);
        CHECK_OK(rw_scene_get_candidate(scene, i, candidate));
        CHECK(candidate->struct_size == sizeof *candidate && candidate->structure != NULL);
        if ((candidate->flags & RW_CANDIDATE_CHOSEN) == 0) continue;
        ++found;
        CHECK(chosen == NULL || strcmp(candidate->structure, chosen) == 0);
        CHECK(candidate->actual_ray_ns >= 0.0); /* the last member, after batches */
    }
    CHECK(found == 1);
    CHECK_OK(rw_scene_explain(scene, RW_FORMAT_JSON, NULL, 0, needed));
    text = (char *)at_the_wall((size_t)*needed);
    CHECK_OK(rw_scene_explain(scene, RW_FORMAT_JSON, text, *needed, needed));
    CHECK(strlen(text) + 1 == *needed && (chosen == NULL || strstr(text, chosen) != NULL));
}

/* ---- the programs --------------------------------------------------------------------------------- */

static void versions(void) {
    uint32_t major = 99, minor = 99, patch = 99, abi = 0, status;
    char built[32];
    CHECK_OK(rw_abi_version(&abi));
    CHECK(abi == RW_ABI_VERSION);
    CHECK_OK(rw_version(&major, &minor, &patch));
    CHECK(major * 1000000 + minor * 1000 + patch >=
          RW_VERSION_MAJOR * 1000000 + RW_VERSION_MINOR * 1000 + RW_VERSION_PATCH);
    snprintf(built, sizeof built, "raywise-%d.%d.%d", RW_VERSION_MAJOR, RW_VERSION_MINOR, RW_VERSION_PATCH);
    CHECK(strcmp(built, PREVIOUS_RELEASE) == 0); /* the header in the folder is the one that was included */
    for (status = 0; status < RW_STATUS_COUNT; ++status) CHECK(rw_status_text((int32_t)status)[0] != '\0');
}

static rw_profile *profile_in_use(void) {
    rw_profile *profile = NULL;
    rw_profile_info *info = NEW(rw_profile_info);
    uint64_t needed = 0;
    NEED_OK(rw_profile_load(NULL, &profile));
    CHECK_OK(rw_profile_inspect(profile, info));
    CHECK(info->struct_size == sizeof *info && info->source == RW_PROFILE_SOURCE_GENERIC);
    CHECK(strcmp(info->machine, "generic") == 0 && info->reserved == 0);
    CHECK_OK(rw_profile_text(profile, RW_FORMAT_TEXT, NULL, 0, &needed));
    CHECK(needed > 1);
    return profile;
}

static void learn_what_is_wanted(const rw_profile *profile) {
    rw_scene *judge = filled_scene(profile);
    const rw_ray down = {{0.5, -1.0, 6.25}, 0.0, {0.0, 0.0, -1.0}, 1e9};
    rw_hit hit;
    rw_hit_f32 narrow;
    double normal[3];
    int i, hits = 0;
    NEED_OK(rw_scene_set_structure(judge, "linear_scan"));
    NEED_OK(rw_scene_commit(judge, NULL));
    for (i = 0; i < RAYS; ++i) {
        NEED_OK(rw_scene_intersect(judge, &rays_in[i], NULL, &wanted[i]));
        NEED_OK(rw_scene_intersect_all(judge, &rays_in[i], NULL, NULL, 0, &wanted_all[i]));
        if (wanted[i].primitive == RW_INVALID_ID) continue;
        ++hits;
        memset(&narrow, 0, sizeof narrow);
        narrow.instance = wanted[i].instance;
        narrow.geometry = wanted[i].geometry;
        narrow.primitive = wanted[i].primitive;
        NEED_OK(rw_scene_normal_f32(judge, &narrow, wanted_normal[i]));
    }
    CHECK(hits > RAYS / 3);
    rw_scene_release(judge);

    /* An answer that can be reckoned by hand. */
    NEED_OK(rw_scene_create(profile, &judge));
    NEED_OK(rw_scene_add_triangles(judge, wide_mesh(), NULL));
    NEED_OK(rw_scene_commit(judge, NULL));
    CHECK_OK(rw_scene_intersect(judge, &down, NULL, &hit));
    CHECK_OK(rw_scene_normal(judge, &hit, normal));
    CHECK(hit.t == 6.0 && normal[2] == 1.0 && hit.primitive == 0 && hit.geometry == 0);
    rw_scene_release(judge);
}

static void scene_program(const rw_profile *profile, const char *structure, int32_t effort, int32_t rule) {
    rw_scene *scene = filled_scene(profile);
    rw_expected_rays *expected = NEW(rw_expected_rays);
    rw_commit_options *commit = NEW(rw_commit_options);
    rw_scene_statistics *statistics = NEW(rw_scene_statistics);
    rw_grid_statistics *grid = NEW(rw_grid_statistics);
    double *corners = (double *)at_the_wall(6 * sizeof(double)), fraction = 0.0;
    int calls = 0;
    expected->kind = RW_RAYS_CAMERA;
    expected->count = 1000;
    expected->sample = all_rays();
    commit->threads = 2;
    commit->progress = keep_fraction;
    commit->progress_user = &fraction;
    commit->parallel_for = in_order;
    commit->parallel_user = &calls;
    CHECK_OK(rw_scene_set_expected_rays(scene, expected));
    CHECK_OK(rw_scene_set_effort(scene, effort, rule, 0.0));
    CHECK_OK(rw_scene_set_memory_limit(scene, 0));
    CHECK_OK(rw_scene_set_structure(scene, structure));
    NEED_OK(rw_scene_commit(scene, commit));
    CHECK(fraction > 0.0);

    CHECK_OK(rw_scene_bounds(scene, corners, corners + 3));
    CHECK(corners[0] == -3.0 && corners[3] == 3.0);
    ask_singly(scene);
    ask_in_batches(scene);
    CHECK_OK(rw_scene_get_statistics(scene, statistics));
    CHECK(statistics->struct_size == sizeof *statistics && statistics->geometry_count == 2);
    CHECK(statistics->triangle_count == TRIANGLES + 2 && statistics->rays > 0 && statistics->invalid_rays > 0);
    CHECK(structure == NULL || strcmp(statistics->structure, structure) == 0);
    CHECK(statistics->rays_ns > 0.0); /* the last member */
    if (strcmp(statistics->structure, "uniform_grid") == 0) {
        CHECK_OK(rw_scene_get_grid_statistics(scene, grid));
        CHECK(grid->struct_size == sizeof *grid && grid->cells > 0 && grid->kurtosis != 0.0);
    } else {
        CHECK_ERROR(rw_scene_get_grid_statistics(scene, grid), RW_ERROR_WRONG_STRUCTURE, "uniform_grid");
    }
    ask_why(scene, statistics->structure);
    rw_scene_release(scene);
}

static void view_program(const rw_profile *profile, const char *structure, int32_t kind) {
    rw_scene *scene = filled_scene(profile);
    rw_view_options *options = NEW(rw_view_options);
    rw_commit_options *commit = NEW(rw_commit_options);
    rw_scene *view = NULL;
    options->kind = kind;
    options->origin[2] = 3.0;
    options->direction[2] = -1.0;
    options->half_angle = kind == RW_VIEW_POINT ? 1.0 : 0.0;
    options->count = 1000;
    options->ray_kind = RW_RAYS_SHADOW;
    options->structure = structure;
    commit->threads = 1;
    NEED_OK(rw_scene_commit(scene, NULL));
    NEED_OK(rw_scene_view(scene, options, commit, &view));
    ask_singly(view);
    ask_in_batches(view);
    ask_why(view, structure);
    rw_scene_release(view);
    rw_scene_release(scene);
}

/* Two meshes side by side at the wall, so that the second is found by the size of that time. */
static void once_program(const rw_profile *profile) {
    rw_triangles *meshes = (rw_triangles *)at_the_wall(2 * sizeof(rw_triangles));
    answers *a = (answers *)at_the_wall(sizeof(answers));
    rw_once_options *options = NEW(rw_once_options);
    rw_query_options *query = NEW(rw_query_options);
    uint8_t *occluded = (uint8_t *)at_the_wall(RAYS);
    rw_output *flags = (rw_output *)at_the_wall(sizeof(rw_output));
    int i;
    meshes[0] = *narrow_mesh();
    meshes[1] = *wide_mesh();
    options->kind = RW_RAYS_RANDOM;
    options->profile = profile;
    options->structure = "kd_tree";
    options->query = query;
    query->threads = 1;
    memset(flags, 0, sizeof *flags);
    flags->data = occluded;
    CHECK_OK(rw_once_intersect(meshes, 2, all_rays(), into(a), options));
    for (i = 0; i < RAYS; ++i) check_answer(a, i, &wanted[i]);
    CHECK_OK(rw_once_occluded(meshes, 2, all_rays(), flags, options));
    for (i = 0; i < RAYS; ++i) CHECK(occluded[i] == (wanted[i].primitive != RW_INVALID_ID));
}

static void file_program(void) {
    char path[] = "/tmp/raywise-previous-XXXXXX.obj";
    const char *square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    const int file = mkstemps(path, 4);
    rw_mesh *mesh = NULL;
    rw_triangles *triangles = NEW(rw_triangles);
    rw_scene *scene = NULL;
    const uint32_t *faces = NULL;
    uint64_t count = 0;
    const rw_ray down = {{0.75, 0.5, 2.0}, 0.0, {0.0, 0.0, -1.0}, 1e9};
    rw_hit hit;
    if (file < 0 || write(file, square, strlen(square)) != (ssize_t)strlen(square) || close(file) != 0) exit(1);
    NEED_OK(rw_mesh_load(path, &mesh));
    CHECK_OK(rw_mesh_triangles(mesh, triangles));
    CHECK(triangles->struct_size == sizeof *triangles && triangles->triangle_count == 2);
    CHECK_OK(rw_mesh_faces(mesh, &faces, &count));
    CHECK(count == 1 && faces[1] == 0);
    NEED_OK(rw_scene_create(NULL, &scene));
    triangles->flags = RW_TRIANGLES_SHARED;
    CHECK_OK(rw_scene_add_triangles(scene, triangles, NULL));
    NEED_OK(rw_scene_commit(scene, NULL));
    CHECK_OK(rw_scene_intersect(scene, &down, NULL, &hit));
    CHECK(hit.t == 2.0);
    rw_scene_release(scene);
    rw_mesh_release(mesh);
    remove(path);
}

/* Sizes from before the first release never were. */
static void too_small(const rw_profile *profile) {
    rw_profile_info *info = NEW(rw_profile_info);
    rw_rays *rays = all_rays();
    rw_scene *scene = filled_scene(profile);
    answers *a = (answers *)at_the_wall(sizeof(answers));
    NEED_OK(rw_scene_commit(scene, NULL));
    info->struct_size -= 8;
    CHECK_ERROR(rw_profile_inspect(profile, info), RW_ERROR_INVALID_ARGUMENT, "info|struct_size");
    rays->struct_size = 8;
    CHECK_ERROR(rw_scene_intersect_batch(scene, rays, into(a), NULL), RW_ERROR_INVALID_ARGUMENT, "rays|struct_size");
    rw_scene_release(scene);
}

int main(void) {
    rw_profile *profile;
    uint32_t structures = 0, i;
    use_all_helpers();
    prepare();
    versions();
    profile = profile_in_use();
    learn_what_is_wanted(profile);
    NEED_OK(rw_structure_count(&structures));
    for (i = 0; i < structures; ++i) {
        const char *name = NULL;
        NEED_OK(rw_structure_name(i, &name));
        scene_program(profile, name, RW_EFFORT_ESTIMATE, RW_RULE_SMALLEST_TOTAL);
        view_program(profile, name, i % 2 == 0 ? RW_VIEW_POINT : RW_VIEW_DIRECTION);
    }
    scene_program(profile, NULL, RW_EFFORT_PROBE, RW_RULE_SMALLEST_TOTAL);
    scene_program(NULL, NULL, RW_EFFORT_MEASURE, RW_RULE_SMALLEST_TOTAL);
    scene_program(profile, NULL, RW_EFFORT_PROBE, RW_RULE_HAPALA);
    view_program(profile, NULL, RW_VIEW_POINT);
    once_program(profile);
    file_program();
    too_small(profile);
    CHECK_OK(rw_profile_release(profile));
    check_walls();
    return finish("a program of " PREVIOUS_RELEASE);
}
