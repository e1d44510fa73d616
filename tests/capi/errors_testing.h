/* What the tests of errors share: one of each handle, and a folder for files. */
#ifndef RAYWISE_TESTS_CAPI_ERRORS_TESTING_H
#define RAYWISE_TESTS_CAPI_ERRORS_TESTING_H

#include "testing.h"

#include <sys/stat.h>
#include <unistd.h>

static soup s;
static rw_scene *fresh;     /* filled, not committed */
static rw_scene *committed; /* on the linear scan */
static rw_scene *view;
static rw_profile *profile;
static rw_mesh *mesh;
static char folder[] = "/tmp/raywise-errors-XXXXXX";

static const char *file_of(const char *name, const void *content, size_t size) {
    static char path[512];
    FILE *file;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    remove(path);
    file = fopen(path, "wb");
    if (file == NULL || fwrite(content, 1, size, file) != size || fclose(file) != 0) exit(1);
    return path;
}
static const char *file_with(const char *name, const char *content) { return file_of(name, content, strlen(content)); }

static void set_up(void) {
    rw_view_options options;
    const char *obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    rw_triangles t;
    use_all_helpers();
    (void)file_of;
    (void)file_with;
    if (mkdtemp(folder) == NULL) exit(1);
    s = make_soup(100);
    t = triangles_of(&s);
    NEED_OK(rw_profile_load(NULL, &profile));
    NEED_OK(rw_scene_create(profile, &fresh));
    NEED_OK(rw_scene_add_triangles(fresh, &t, NULL));
    committed = make_scene(&s, "linear_scan");
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.count = 100;
    NEED_OK(rw_scene_view(committed, &options, NULL, &view));
    NEED_OK(rw_mesh_load(file_with("square.obj", obj), &mesh));
}

/* Whatever went wrong before, the scene is as it was. */
static int tear_down(const char *name) {
    char command[600];
    rw_scene_statistics statistics;
    statistics.struct_size = sizeof statistics;
    CHECK_OK(rw_scene_set_structure(fresh, NULL));
    CHECK_OK(rw_scene_commit(fresh, NULL));
    CHECK_OK(rw_scene_get_statistics(fresh, &statistics));
    CHECK(statistics.geometry_count == 1 && statistics.triangle_count == s.triangles);
    rw_mesh_release(mesh);
    rw_scene_release(view);
    rw_scene_release(fresh);
    rw_scene_release(committed);
    rw_profile_release(profile);
    free_soup(&s);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0) return 1;
    return finish(name);
}

#endif
