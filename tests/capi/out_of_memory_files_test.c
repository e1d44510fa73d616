/* Mesh files and profiles with one allocation after the other refused. Reading a file says out of memory and nothing else: not
 * that the file is missing, damaged or of another machine; and what could not be learnt then is learnt later.
 *
 * Some things are learnt once for the whole process, so attempts begin in a process of their own that has called nothing
 * yet; leaks are looked for where there were some already. */
#include "testing.h"

#include "refusing.h"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/raywise-memory-XXXXXX";

/* What processes share. */
static struct shared_memory {
    uint64_t result; /* of reading the file without refusals */
    long refused;    /* by the latest child */
} * shared;

static const char *path_of(const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const void *content, size_t size) {
    FILE *file = fopen(path_of(name), "wb");
    if (file == NULL || fwrite(content, 1, size, file) != size || fclose(file) != 0) exit(1);
}
static void write_text(const char *name, const char *content) { write_file(name, content, strlen(content)); }

/* ---- what is read --------------------------------------------------------------------------------- */

/* What a mesh or profile amounts to, as one number, so that a damaged one does not go unnoticed. */
static uint64_t digest(uint64_t sum, const void *memory, size_t size) {
    const unsigned char *bytes = (const unsigned char *)memory;
    size_t i;
    for (i = 0; i < size; ++i) sum = (sum ^ bytes[i]) * 1099511628211u;
    return sum;
}

/* Reads the file once. Writes what it amounts to when it could be read. */
typedef int32_t (*attempt)(const char *name, uint64_t *sum);

static int32_t read_mesh(const char *name, uint64_t *sum) {
    rw_mesh *mesh = NULL;
    rw_triangles t;
    const uint32_t *faces = NULL;
    uint64_t count = 0;
    const int32_t status = rw_mesh_load(path_of(name), &mesh);
    if (status != RW_OK) {
        CHECK(mesh == NULL);
        return status;
    }
    t.struct_size = sizeof t;
    CHECK_OK(rw_mesh_triangles(mesh, &t));
    CHECK_OK(rw_mesh_faces(mesh, &faces, &count));
    *sum = digest(count, t.vertices.data,
                  (size_t)t.vertex_count * 3 * (t.vertices.type == RW_FLOAT64 ? sizeof(double) : sizeof(float)));
    *sum = digest(*sum, t.indices.data, (size_t)t.triangle_count * 3 * sizeof(uint32_t));
    *sum = digest(*sum, faces, (size_t)t.triangle_count * sizeof(uint32_t));
    CHECK_OK(rw_mesh_release(mesh));
    return RW_OK;
}

/* The name of the profile that is found by the environment variable. */
#define FOUND "found"

/* Both a profile that is used and one that is passed over are results: the status counts as part of them. */
static int32_t read_profile(const char *name, uint64_t *sum) {
    rw_profile *profile = NULL;
    rw_profile_info info;
    int32_t status;
    status = rw_profile_load(strcmp(name, FOUND) == 0 ? NULL : path_of(name), &profile);
    if (status == RW_ERROR_OUT_OF_MEMORY) {
        CHECK(profile == NULL);
        return status;
    }
    info.struct_size = sizeof info;
    CHECK_OK(rw_profile_inspect(profile, &info));
    CHECK(info.status == status);
    *sum = digest((uint64_t)(uint32_t)status, &info.source, sizeof info.source);
    *sum = digest(*sum, info.machine, strlen(info.machine));
    if (status != RW_OK) *sum = digest(*sum, rw_last_error_message(), strlen(rw_last_error_message()));
    CHECK_OK(rw_profile_release(profile));
    return RW_OK;
}

/* ---- refusing ------------------------------------------------------------------------------------- */

/* One attempt with refusals and one without. Tells how many were refused. */
static long refused_and_repeated(attempt read, const char *name, refusal which, long number, uint64_t wanted) {
    uint64_t sum = 0, again = 0;
    const int before = failures;
    int32_t status;
    long refused;
    refuse(which, number);
    status = read(name, &sum);
    refused = stop_refusing();
    if (status == RW_OK) {
        CHECK(sum == wanted); /* a refusal that did no harm */
    } else {
        CHECK_ERROR(status, RW_ERROR_OUT_OF_MEMORY, "memory");
        CHECK(refused > 0);
    }
    CHECK_OK(read(name, &again));
    CHECK(again == wanted);
    if (failures != before) fprintf(stderr, "    allocation %ld refused\n", number);
    return refused;
}

/* Runs body in a process of its own, which has called nothing yet, and takes over what failed there. */
#define IN_A_PROCESS(body)                                                \
    do {                                                                  \
        const pid_t child = fork();                                       \
        int end = 1;                                                      \
        if (child == 0) {                                                 \
            failures = 0;                                                 \
            body;                                                         \
            fflush(NULL);                                                 \
            _exit(failures != 0);                                         \
        }                                                                 \
        if (child < 0 || waitpid(child, &end, 0) != child) exit(1);       \
        check_that(end == 0, "a process of its own", __FILE__, __LINE__); \
    } while (0)

/* Every attempt is the first of its process. */
static void refuse_each_at_first(attempt read, const char *name) {
    long number;
    shared->refused = 1;
    for (number = 0; shared->refused > 0 && failures < 5; ++number)
        IN_A_PROCESS(shared->refused = refused_and_repeated(read, name, REFUSE_ONE, number, shared->result));
    CHECK(number > 3);
    printf("%s, at first, one refused: %ld allocations\n", name, number - 1);
}

/* All in one process: nothing is left behind. least: allocations that one attempt makes at least. */
static void refuse_each_later(attempt read, const char *name, long least) {
    refusal which;
    for (which = REFUSE_ONE; which <= REFUSE_FROM_ON; ++which) {
        long number, refused = 1;
        refused_and_repeated(read, name, which, 5, shared->result); /* what stays for good is there from here on */
        for (number = 0; refused > 0 && failures < 5; ++number) {
            const long live = live_allocations();
            refused = refused_and_repeated(read, name, which, number, shared->result);
            CHECK(live_allocations() == live);
        }
        CHECK(number > least);
        printf("%s, later, %s: %ld allocations\n", name, which == REFUSE_ONE ? "one refused" : "refused from one on",
               number - 1);
    }
}

static void refuse_each(attempt read, const char *name) {
    IN_A_PROCESS(CHECK_OK(read(name, &shared->result)));
    refuse_each_at_first(read, name);
    IN_A_PROCESS(refuse_each_later(read, name, 3));
}

/* ---- the files ------------------------------------------------------------------------------------ */

static void put_float(unsigned char *at, float value) { memcpy(at, &value, sizeof value); }
static void put_number(unsigned char *at, uint32_t value) { memcpy(at, &value, sizeof value); }

/* Binary files as written by a little-endian machine. */
static void write_binary_meshes(void) {
    static const char head[] =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    unsigned char ply[sizeof head - 1 + 36 + 13], stl[84 + 2 * 50];
    unsigned char *at = ply + sizeof head - 1;
    uint32_t i;
    memcpy(ply, head, sizeof head - 1);
    for (i = 0; i < 9; ++i) put_float(at + 4 * i, (float)(i * i % 5));
    at[36] = 3;
    for (i = 0; i < 3; ++i) put_number(at + 37 + 4 * i, i);
    write_file("binary.ply", ply, sizeof ply);
    memset(stl, 0, sizeof stl);
    put_number(stl + 80, 2);
    for (i = 0; i < 18; ++i) put_float(stl + 84 + 50 * (i / 9) + 12 + 4 * (i % 9), (float)(i * i % 7));
    write_file("binary.stl", stl, sizeof stl);
}

static void write_meshes(void) {
    write_text("square.obj",
               "# a square and a triangle\no square\nv 0.123456789012345 0 0\nv 1 0 0.25\nv 1 1e-3 0\n"
               "v 0 1.0000000001 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 1 3 4\n");
    write_text("square.off",
               "OFF\n4 2 0\n0.123456789012345 0 0\n1 0 0.25\n1 1e-3 0\n0 1.0000000001 0\n"
               "4 0 1 2 3\n3 0 2 3\n");
    write_text("normals.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0.123456789012345 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
    write_text("square.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
               "0.123456789012345 0 0\n1 0 0.25\n1 1e-3 0\n0 1.0000000001 0\n4 0 1 2 3\n3 0 2 3\n");
    write_text("text.stl",
               "solid a name\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0.123456789012345\n"
               "vertex 0 1 0\nendloop\nendfacet\nendsolid a name\n");
    write_binary_meshes();
}

/* Puts what this machine has in the place of what the profile has, as the message tells it. */
static int adapt(char *text, size_t room, const char *message) {
    char key[64], *value, *end, rest[65536];
    const char *member = strstr(message, "machine."), *here = strstr(message, "this machine ");
    const char *colon = member == NULL ? NULL : strchr(member, ':');
    if (colon == NULL || here == NULL) return 0;
    snprintf(key, sizeof key, "\"%.*s\":", (int)(colon - member - 8), member + 8);
    value = strstr(text, "\"machine\"");
    value = value == NULL ? NULL : strstr(value, key);
    if (value == NULL) return 0;
    value += strlen(key);
    end = value + strcspn(value, ",\n}");
    snprintf(rest, sizeof rest, "%s", end);
    snprintf(value, room - (size_t)(value - text), " %s%s", here + strlen("this machine "), rest);
    return 1;
}

static void write_profiles(void) {
    static char text[65536];
    rw_profile *profile = NULL;
    uint64_t needed = 0;
    int member;
    NEED_OK(rw_profile_load(NULL, &profile));
    NEED_OK(rw_profile_text(profile, RW_FORMAT_JSON, text, sizeof text, &needed));
    NEED_OK(rw_profile_release(profile));
    write_text("foreign.json", text);
    write_text("broken.json", "{\"schema\": 1, \"epoch\": ");
    for (member = 0; member < 20; ++member) {
        int32_t status;
        write_text("fitting.json", text);
        status = rw_profile_load(path_of("fitting.json"), &profile);
        rw_profile_release(profile);
        if (status == RW_OK) return;
        if (!CHECK(status == RW_PROFILE_MACHINE && adapt(text, sizeof text, rw_last_error_message()))) exit(1);
    }
    exit(1);
}

int main(void) {
    static const char *const meshes[] = {"square.obj", "square.off", "normals.off", "square.ply",
                                         "binary.ply", "text.stl",   "binary.stl"};
    static const char *const others[] = {"foreign.json", "broken.json", "missing.json"};
    char command[600];
    size_t i;
    use_all_helpers();
    setvbuf(stdout, NULL, _IOLBF, 0); /* nothing is to be written twice by a child */
    shared =
        (struct shared_memory *)mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if ((void *)shared == MAP_FAILED || mkdtemp(folder) == NULL) return 1;
    write_meshes();
    IN_A_PROCESS(write_profiles());
    setenv("RAYWISE_CALIBRATION", path_of("fitting.json"), 1); /* what is found */
    for (i = 0; i < sizeof meshes / sizeof meshes[0]; ++i) refuse_each(read_mesh, meshes[i]);
    refuse_each(read_profile, "fitting.json");
    for (i = 0; i < sizeof others / sizeof others[0]; ++i) {
        IN_A_PROCESS(CHECK_OK(read_profile(others[i], &shared->result)));
        IN_A_PROCESS(refuse_each_later(read_profile, others[i], 3));
    }
    /* Looked up once in a process and kept, unless memory ran out meanwhile; afterwards only a handle is made. */
    IN_A_PROCESS(CHECK_OK(read_profile(FOUND, &shared->result)));
    refuse_each_at_first(read_profile, FOUND);
    IN_A_PROCESS(refuse_each_later(read_profile, FOUND, 1));
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0) return 1;
    return finish("out of memory, files");
}
