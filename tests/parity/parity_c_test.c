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
    int32_t (*scene_intersect)(const rw_scene *, const rw_ray *, const rw_ray_options *, rw_hit *);
    int32_t (*scene_occluded)(const rw_scene *, const rw_ray *, const rw_ray_options *, int32_t *);
    int32_t (*scene_intersect_all)(const rw_scene *, const rw_ray *, const rw_ray_options *, rw_hit *, uint64_t,
                                   uint64_t *);
    int32_t (*scene_normal)(const rw_scene *, const rw_hit *, double *);
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
    load_name(handle, "rw_scene_occluded", &lib.scene_occluded);
    load_name(handle, "rw_scene_intersect_all", &lib.scene_intersect_all);
    load_name(handle, "rw_scene_normal", &lib.scene_normal);
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

#define MOST_HITS 100

/* What a case holds, and what is asked for it: hits without those skipped. */
typedef struct question {
    char mesh[64];
    rw_ray ray;
    rw_primitive_id skip[MOST_HITS];
    rw_ray_options options;
    rw_hit hits[MOST_HITS];
    double normals[MOST_HITS][3];
    uint64_t hit_count;
} question;

static void read_skip(question *q) {
    memset(&q->options, 0, sizeof q->options);
    q->options.struct_size = sizeof q->options;
    take("[");
    if (take_if("]")) return;
    q->options.skip = q->skip;
    do {
        rw_primitive_id *id = &q->skip[q->options.skip_count++];
        if (q->options.skip_count == MOST_HITS) fail("fewer triangles to skip");
        id->instance = RW_INVALID_ID;
        take("[");
        id->geometry = (uint32_t)take_number();
        take(",");
        id->primitive = (uint32_t)take_number();
        take("]");
    } while (take_if(","));
    take("]");
}

static void read_hit(rw_hit *hit, double *normal) {
    int i;
    memset(hit, 0, sizeof *hit);
    hit->instance = RW_INVALID_ID;
    take("{\"t\":");
    hit->t = take_bits();
    take(",\"u\":");
    hit->u = take_bits();
    take(",\"v\":");
    hit->v = take_bits();
    take(",\"normal\":[");
    for (i = 0; i < 3; ++i) {
        if (i > 0) take(",");
        normal[i] = take_bits();
    }
    take("],\"geometry\":");
    hit->geometry = (uint32_t)take_number();
    take(",\"primitive\":");
    hit->primitive = (uint32_t)take_number();
    take("}");
}

static void read_question(question *q) {
    take("{\"mesh\":");
    take_name(q->mesh, sizeof q->mesh);
    take(",\"origin\":");
    take_vector(q->ray.origin);
    take(",\"direction\":");
    take_vector(q->ray.direction);
    take(",\"tmin\":");
    q->ray.tmin = take_number();
    take(",\"tmax\":");
    q->ray.tmax = take_if("\"inf\"") ? INFINITY : take_number();
    take(",\"skip\":");
    read_skip(q);
    take(",\"hits\":[");
    q->hit_count = 0;
    if (!take_if("]")) {
        do {
            if (q->hit_count == MOST_HITS) fail("fewer hits");
            read_hit(&q->hits[q->hit_count], q->normals[q->hit_count]);
            ++q->hit_count;
        } while (take_if(","));
        take("]");
    }
    take("}");
}

/* Whether closest, any and all hits are those stored. */
static int is_answer(const question *q, const rw_hit *closest, int32_t occluded, const rw_hit *all, uint64_t count) {
    rw_hit miss;
    memset(&miss, 0, sizeof miss);
    miss.t = INFINITY;
    miss.instance = miss.geometry = miss.primitive = RW_INVALID_ID;
    return memcmp(closest, q->hit_count > 0 ? &q->hits[0] : &miss, sizeof miss) == 0 &&
           occluded == (q->hit_count > 0) && count == q->hit_count &&
           memcmp(all, q->hits, (size_t)count * sizeof all[0]) == 0;
}

static int are_normals(const question *q, const rw_scene *scene) {
    uint64_t i;
    int right = 1;
    for (i = 0; i < q->hit_count; ++i) {
        double normal[3];
        need(lib.scene_normal(scene, &q->hits[i], normal));
        right = right && memcmp(normal, q->normals[i], sizeof normal) == 0;
    }
    return right;
}

static int check_case(int number) {
    static question q;
    static rw_hit all[MOST_HITS];
    rw_hit closest;
    int32_t occluded = -1;
    uint64_t count = 0;
    size_t m;
    uint32_t i;
    int wrong = 0;
    read_question(&q);
    for (m = 0; m < mesh_count && strcmp(meshes[m].name, q.mesh) != 0; ++m) {
    }
    if (m == mesh_count) fail("a case of a known mesh");
    for (i = 0; i < structure_count; ++i) {
        const rw_scene *scene = meshes[m].scenes[i];
        int right;
        need(lib.scene_intersect(scene, &q.ray, &q.options, &closest));
        need(lib.scene_occluded(scene, &q.ray, &q.options, &occluded));
        need(lib.scene_intersect_all(scene, &q.ray, &q.options, all, MOST_HITS, &count));
        right = is_answer(&q, &closest, occluded, all, count) && are_normals(&q, scene);
        if (q.options.skip_count == 0) {
            need(lib.scene_intersect(scene, &q.ray, NULL, &closest));
            need(lib.scene_occluded(scene, &q.ray, NULL, &occluded));
            need(lib.scene_intersect_all(scene, &q.ray, NULL, all, MOST_HITS, &count));
            right = right && is_answer(&q, &closest, occluded, all, count);
        }
        if (right) continue;
        fprintf(stderr, "case %d on %s, structure %u: %u hits instead of %u, the closest at t %a, primitive %u\n",
                number, q.mesh, (unsigned)i, (unsigned)count, (unsigned)q.hit_count, closest.t,
                (unsigned)closest.primitive);
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
