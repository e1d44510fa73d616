/* cases.json from C, with the library loaded at run time as a plug-in would do it:
 *   parity_c_test LIBRARY CASES
 * Every structure has to give the stored bits. */
#define _GNU_SOURCE
#include "raywise/raywise.h"

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- the functions wanted --- */

typedef struct library {
    int32_t (*abi_version)(uint32_t *);
    int32_t (*structure_count)(uint32_t *);
    int32_t (*structure_name)(uint32_t, const char **);
    int32_t (*scene_create)(const rw_profile *, rw_scene **);
    int32_t (*scene_release)(const rw_scene *);
    int32_t (*scene_add_triangles)(rw_scene *, const rw_triangles *, uint32_t *);
    int32_t (*scene_set_structure)(rw_scene *, const char *);
    int32_t (*scene_commit)(rw_scene *, const rw_commit_options *);
    int32_t (*scene_intersect)(const rw_scene *, const rw_ray *, rw_hit *);
    const char *(*last_error_message)(void);
} library;

static library lib;

static void load_name(void *handle, const char *name, void *function) {
    void *found = dlsym(handle, name);
    if (found == NULL) {
        fprintf(stderr, "%s is not in the library\n", name);
        exit(1);
    }
    memcpy(function, &found, sizeof found); /* C has no conversion from an object pointer to a function's */
}

static void load_library(const char *path) {
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    uint32_t abi = 0;
    if (handle == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    load_name(handle, "rw_abi_version", &lib.abi_version);
    load_name(handle, "rw_structure_count", &lib.structure_count);
    load_name(handle, "rw_structure_name", &lib.structure_name);
    load_name(handle, "rw_scene_create", &lib.scene_create);
    load_name(handle, "rw_scene_release", &lib.scene_release);
    load_name(handle, "rw_scene_add_triangles", &lib.scene_add_triangles);
    load_name(handle, "rw_scene_set_structure", &lib.scene_set_structure);
    load_name(handle, "rw_scene_commit", &lib.scene_commit);
    load_name(handle, "rw_scene_intersect", &lib.scene_intersect);
    load_name(handle, "rw_last_error_message", &lib.last_error_message);
    if (lib.abi_version(&abi) != RW_OK || abi != RW_ABI_VERSION) exit(1);
}

/* --- the file: read in the order in which parity_generate writes it --- */

static const char *at; /* what is left of the text */

static void fail(const char *what) {
    fprintf(stderr, "cases.json: %s expected at: %.60s\n", what, at);
    exit(1);
}
static void skip_space(void) { at += strspn(at, " \t\r\n"); }
static int next_is(const char *text) {
    skip_space();
    return strncmp(at, text, strlen(text)) == 0;
}
static int take_if(const char *text) {
    if (!next_is(text)) return 0;
    at += strlen(text);
    return 1;
}
static void take(const char *text) {
    if (!take_if(text)) fail(text);
}
static double take_number(void) {
    char *end;
    double value;
    skip_space();
    value = strtod(at, &end);
    if (end == at) fail("a number");
    at = end;
    return value;
}
static void take_vector(double *v) {
    take("[");
    v[0] = take_number();
    take(",");
    v[1] = take_number();
    take(",");
    v[2] = take_number();
    take("]");
}
static double take_bits(void) {
    uint64_t bits;
    double value;
    char *end;
    take("\"");
    bits = strtoull(at, &end, 16);
    if (end == at) fail("bits");
    at = end;
    take("\"");
    memcpy(&value, &bits, sizeof value);
    return value;
}
static void take_name(char *name, size_t room) {
    size_t length;
    take("\"");
    length = strcspn(at, "\"");
    if (length >= room) fail("a short name");
    memcpy(name, at, length);
    name[length] = '\0';
    at += length;
    take("\"");
}

/* --- meshes and cases --- */

#define MOST_VERTICES 1000
#define MOST_STRUCTURES 16

typedef struct mesh {
    char name[64];
    rw_scene *scenes[MOST_STRUCTURES];
} mesh;

static mesh meshes[16];
static size_t mesh_count;
static uint32_t structure_count;

static void need(int32_t status) {
    if (status == RW_OK) return;
    fprintf(stderr, "%s\n", lib.last_error_message());
    exit(1);
}

static void read_mesh(void) {
    static double vertices[3 * MOST_VERTICES];
    static uint32_t indices[3 * MOST_VERTICES];
    mesh *m = &meshes[mesh_count++];
    rw_triangles t;
    uint32_t i;
    memset(&t, 0, sizeof t);
    t.struct_size = sizeof t;
    t.vertices.data = vertices;
    t.vertices.type = RW_FLOAT64;
    t.indices.data = indices;
    if (mesh_count == sizeof meshes / sizeof meshes[0]) fail("fewer meshes");
    take("{\"name\":");
    take_name(m->name, sizeof m->name);
    take(",");
    take("\"vertices\":");
    take("[");
    do {
        if (t.vertex_count == MOST_VERTICES) fail("fewer vertices");
        take_vector(vertices + 3 * t.vertex_count++);
    } while (take_if(","));
    take("],");
    take("\"triangles\":");
    take("[");
    do {
        double corners[3];
        if (t.triangle_count == MOST_VERTICES) fail("fewer triangles");
        take_vector(corners);
        for (i = 0; i < 3; ++i) indices[3 * t.triangle_count + i] = (uint32_t)corners[i];
        ++t.triangle_count;
    } while (take_if(","));
    take("]}");
    for (i = 0; i < structure_count; ++i) {
        const char *structure = NULL;
        need(lib.structure_name(i, &structure));
        need(lib.scene_create(NULL, &m->scenes[i]));
        need(lib.scene_add_triangles(m->scenes[i], &t, NULL));
        need(lib.scene_set_structure(m->scenes[i], structure));
        need(lib.scene_commit(m->scenes[i], NULL));
    }
}

static int check_case(int number) {
    char name[64];
    rw_ray ray;
    rw_hit wanted, hit;
    size_t m;
    uint32_t i;
    int wrong = 0;
    memset(&wanted, 0, sizeof wanted);
    wanted.t = INFINITY;
    wanted.instance = wanted.geometry = wanted.primitive = RW_INVALID_ID;
    take("{\"mesh\":");
    take_name(name, sizeof name);
    take(",\"origin\":");
    take_vector(ray.origin);
    take(",\"direction\":");
    take_vector(ray.direction);
    take(",\"tmin\":");
    ray.tmin = take_number();
    take(",\"tmax\":");
    ray.tmax = take_if("\"inf\"") ? INFINITY : take_number();
    take(",\"hit\":");
    if (!take_if("null")) {
        take("{\"t\":");
        wanted.t = take_bits();
        take(",\"u\":");
        wanted.u = take_bits();
        take(",\"v\":");
        wanted.v = take_bits();
        take(",\"normal\":[");
        for (i = 0; i < 3; ++i) {
            if (i > 0) take(",");
            wanted.normal[i] = take_bits();
        }
        take("],\"geometry\":");
        wanted.geometry = (uint32_t)take_number();
        take(",\"primitive\":");
        wanted.primitive = (uint32_t)take_number();
        take("}");
    }
    take("}");
    for (m = 0; m < mesh_count && strcmp(meshes[m].name, name) != 0; ++m) {
    }
    if (m == mesh_count) fail("a case of a known mesh");
    for (i = 0; i < structure_count; ++i) {
        need(lib.scene_intersect(meshes[m].scenes[i], &ray, &hit));
        if (memcmp(&hit, &wanted, sizeof hit) == 0) continue;
        fprintf(stderr, "case %d on %s, structure %u: t %a instead of %a, primitive %u instead of %u\n", number, name,
                (unsigned)i, hit.t, wanted.t, (unsigned)hit.primitive, (unsigned)wanted.primitive);
        wrong = 1;
    }
    return wrong;
}

int main(int count, char **arguments) {
    FILE *file;
    char *text;
    long size;
    int cases = 0, wrong = 0;
    size_t m;
    uint32_t i;
    if (count != 3) return 2;
    load_library(arguments[1]);
    need(lib.structure_count(&structure_count));
    if (structure_count > MOST_STRUCTURES) return 1;

    file = fopen(arguments[2], "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0 || (size = ftell(file)) <= 0) return 1;
    rewind(file);
    text = (char *)malloc((size_t)size + 1);
    if (text == NULL || fread(text, 1, (size_t)size, file) != (size_t)size) return 1;
    fclose(file);
    text[size] = '\0';
    at = text;

    take("{\"meshes\":[");
    do {
        read_mesh();
    } while (take_if(","));
    take("],\"cases\":[");
    do {
        wrong += check_case(cases++);
    } while (take_if(","));
    take("]}");
    for (m = 0; m < mesh_count; ++m) {
        for (i = 0; i < structure_count; ++i) need(lib.scene_release(meshes[m].scenes[i]));
    }
    free(text);
    printf("%d cases on %d meshes and %u structures, %d wrong\n", cases, (int)mesh_count, (unsigned)structure_count,
           wrong);
    return wrong == 0 && cases >= 100 ? 0 : 1;
}
