/* Mesh files of every format with everything that can be wrong with them: the status the header promises, and a message that
 * names the file and the element. */
#include "errors_testing.h"

/* A PLY file's header, for the rows of the table below. */
#define PLY "ply\nformat ascii 1.0\n"
#define BINARY_PLY "ply\nformat binary_little_endian 1.0\n"
#define VERTEX_3 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define FACE_1 "element face 1\nproperty list uchar int vertex_indices\n"
#define ROWS "0 0 0\n1 0 0\n0 1 0\n"
#define FACET "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"

static const struct wrong_file {
    const char *name;
    const char *content;
    int32_t status;
    const char *parts; /* of the message, beside the name */
} wrong_files[] = {
    {"a.stp", "ISO-10303-21;", RW_ERROR_FILE_FORMAT, ".stp|.obj"},
    {"noending", "v 0 0 0\n", RW_ERROR_FILE_FORMAT, ".obj"},
    {"a.obj", "", RW_ERROR_FILE_FORMAT, "empty"},

    {"a.obj", "hello there\n", RW_ERROR_FILE_FORMAT, "no line of an OBJ file"},
    {"a.obj", "v 0 0 0\n", RW_ERROR_NO_FACES, "no faces"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", RW_ERROR_BAD_POLYGON, "face 0 has 2 corners"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", RW_ERROR_INDEX_OUT_OF_RANGE, "face 0|index 3|2 vertices"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 0 2\n", RW_ERROR_INDEX_OUT_OF_RANGE, "face 0|index 0"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 -3 2\n", RW_ERROR_INDEX_OUT_OF_RANGE, "face 0|index -3"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 three\n", RW_ERROR_FILE_FORMAT, "face 0|line 4|three"},
    {"a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", RW_ERROR_FILE_FORMAT, "vertex 1|line 2|too few coordinates"},
    {"a.obj", "v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n", RW_ERROR_FILE_FORMAT, "vertex 1|x|no number"},
    {"a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", RW_ERROR_NOT_FINITE, "vertex 1"},
    {"a.obj", "v 0 0 0\nv 1 0 1e309\nv 0 1 0\nf 1 2 3\n", RW_ERROR_NOT_FINITE, "vertex 1|1e309|line 2"},

    {"a.off", "COFF BINARY\n", RW_ERROR_FILE_FORMAT, "binary OFF"},
    {"a.off", "OF\n", RW_ERROR_FILE_FORMAT, "does not begin with OFF"},
    {"a.off", "4OFF\n", RW_ERROR_FILE_FORMAT, "3 dimensions"},
    {"a.off", "# a comment\nNOFF\n", RW_ERROR_FILE_FORMAT, "counts are missing|line 2"},
    {"a.off", "OFFSET\n3 1 0\n", RW_ERROR_FILE_FORMAT, "OFFSET|no keyword|line 1"},
    {"a.off", "nOFF\n4\n3 1 0\n", RW_ERROR_FILE_FORMAT, "3 dimensions|line 2"},
    {"a.off", "OFF\n-1 1 0\n", RW_ERROR_FILE_FORMAT, "number of vertices|-1|line 2"},
    {"a.off", "OFF\n2147483648 1 0\n", RW_ERROR_TOO_MANY, "vertices|line 2"},
    {"a.off", "OFF\n", RW_ERROR_FILE_FORMAT, "truncated|counts"},
    {"a.off", "OFF\nmany 1 0\n", RW_ERROR_FILE_FORMAT, "number of vertices"},
    {"a.off", "OFF\n3 1 none\n", RW_ERROR_FILE_FORMAT, "line|three counts"},
    {"a.off", "OFF\n5000000000 1 0\n", RW_ERROR_TOO_MANY, "vertices"},
    {"a.off", "OFF\n3 5000000000 0\n", RW_ERROR_TOO_MANY, "faces"},
    {"a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", RW_ERROR_NO_FACES, "no faces"},
    {"a.off", "OFF\n3 1 0\n0 0 0\n", RW_ERROR_FILE_FORMAT, "truncated|vertex 1"},
    {"a.off", "OFF\n3 1 0\n" ROWS, RW_ERROR_FILE_FORMAT, "truncated|face 0"},
    {"a.off", "OFF\n3 1 0\n" ROWS "x\n", RW_ERROR_FILE_FORMAT, "face 0|number of corners"},
    {"a.off", "OFF\n3 1 0\n" ROWS "2 0 1\n", RW_ERROR_BAD_POLYGON, "face 0 has 2 corners"},
    {"a.off", "OFF\n3 1 0\n" ROWS "3 0 1\n", RW_ERROR_FILE_FORMAT, "face 0|too few corners"},
    {"a.off", "OFF\n3 1 0\n" ROWS "3 0 1 z\n", RW_ERROR_FILE_FORMAT, "face 0|z|no index"},
    {"a.off", "OFF\n3 1 0\n" ROWS "3 0 1 3\n", RW_ERROR_INDEX_OUT_OF_RANGE, "face 0|index 3|3 vertices"},
    {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", RW_ERROR_NOT_FINITE, "vertex 1"},
    {"a.off", "STOFF\n3 1 0\n" ROWS "3 0 1 2\n", RW_ERROR_FILE_FORMAT, "vertex 0 has 3 numbers|5|line 3"},

    {"a.ply", "solid", RW_ERROR_FILE_FORMAT, "does not begin with ply"},
    {"a.ply", PLY, RW_ERROR_FILE_FORMAT, "truncated|header"},
    {"a.ply", "ply\nformat ebcdic 1.0\nend_header\n", RW_ERROR_FILE_FORMAT, "unknown format|ebcdic"},
    {"a.ply", "ply\n" VERTEX_3 FACE_1 "end_header\n", RW_ERROR_FILE_FORMAT, "does not name the format"},
    {"a.ply", PLY "element vertex\nend_header\n", RW_ERROR_FILE_FORMAT, "how many of element \"vertex\""},
    {"a.ply", PLY "property float x\nend_header\n", RW_ERROR_FILE_FORMAT, "before the first element"},
    {"a.ply", PLY "nonsense\nend_header\n", RW_ERROR_FILE_FORMAT, "unknown word|nonsense"},
    {"a.ply", PLY "element vertex 3\nproperty half x\nend_header\n", RW_ERROR_FILE_FORMAT, "unknown type|half"},
    {"a.ply", PLY "element vertex 3\nproperty float\nend_header\n", RW_ERROR_FILE_FORMAT, "without a name"},
    {"a.ply", PLY "element vertex -1\nend_header\n", RW_ERROR_FILE_FORMAT, "how many|-1|line 3"},
    {"a.ply", PLY "element vertex 2147483648\n" FACE_1 "end_header\n", RW_ERROR_TOO_MANY, "vertices"},
    {"a.ply", PLY VERTEX_3 "element face 1\nproperty list float int vertex_indices\nend_header\n", RW_ERROR_FILE_FORMAT,
     "counts a list with floats"},
    {"a.ply", PLY VERTEX_3 "element face 1\nproperty list uchar float vertex_indices\nend_header\n",
     RW_ERROR_FILE_FORMAT, "integers"},
    {"a.ply", PLY FACE_1 "end_header\n", RW_ERROR_FILE_FORMAT, "no element vertex"},
    {"a.ply", PLY VERTEX_3 VERTEX_3 FACE_1 "end_header\n", RW_ERROR_FILE_FORMAT, "two elements vertex"},
    {"a.ply", PLY VERTEX_3 "end_header\n" ROWS, RW_ERROR_NO_FACES, "no faces"},
    {"a.ply", PLY "element vertex 3\nproperty float x\nproperty float y\n" FACE_1 "end_header\n", RW_ERROR_FILE_FORMAT,
     "x, y and z"},
    {"a.ply", PLY VERTEX_3 "element face 1\nproperty int color\nend_header\n", RW_ERROR_FILE_FORMAT,
     "element face|vertex indices"},
    {"a.ply",
     PLY "element vertex 5000000000\nproperty float x\nproperty float y\nproperty float z\n" FACE_1 "end_header\n",
     RW_ERROR_TOO_MANY, "vertices"},
    {"a.ply", PLY VERTEX_3 "element face 5000000000\nproperty list uchar int vertex_indices\nend_header\n",
     RW_ERROR_TOO_MANY, "faces"},
    {"a.ply", PLY VERTEX_3 FACE_1 "end_header\n0 0 0\n1 0", RW_ERROR_FILE_FORMAT, "truncated"},
    {"a.ply", PLY VERTEX_3 FACE_1 "end_header\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", RW_ERROR_NOT_FINITE, "vertex 1"},
    {"a.ply", PLY VERTEX_3 FACE_1 "end_header\n" ROWS "2 0 1\n", RW_ERROR_BAD_POLYGON, "face 0 has 2 corners"},
    {"a.ply", PLY VERTEX_3 FACE_1 "end_header\n" ROWS "3 0 1 x\n", RW_ERROR_FILE_FORMAT, "face 0|x|no integer"},
    {"a.ply", PLY VERTEX_3 FACE_1 "end_header\n" ROWS "3 0 1 3\n", RW_ERROR_INDEX_OUT_OF_RANGE,
     "face 0|index 3|3 vertices"},
    {"a.ply", PLY VERTEX_3 "property list int int other\n" FACE_1 "end_header\n0 0 0 -1\n", RW_ERROR_FILE_FORMAT,
     "vertex 0|negative length"},
    {"a.ply", PLY VERTEX_3 "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" ROWS "2 0 1\n",
     RW_ERROR_NO_FACES, "no faces"},
    {"a.ply", BINARY_PLY VERTEX_3 FACE_1 "end_header\n0123456789", RW_ERROR_FILE_FORMAT, "truncated"},

    {"a.stl", "short", RW_ERROR_FILE_FORMAT, "too short"},
    {"a.stl", "solid x\nendsolid x\n", RW_ERROR_NO_FACES, "no faces"},
    {"a.stl", "solid x\nhello\n", RW_ERROR_FILE_FORMAT, "face 0|hello"},
    {"a.stl", "solid x\nfacet abnormal 0 0 1\n", RW_ERROR_FILE_FORMAT, "face 0|abnormal|instead of normal"},
    {"a.stl", "solid x\nfacet normal 0 0 1\n", RW_ERROR_FILE_FORMAT, "face 0|truncated|outer"},
    {"a.stl", "solid x\n" FACET, RW_ERROR_FILE_FORMAT, "face 0|truncated"},
    {"a.stl", "solid x\n" FACET "vertex 0 1 0\nendlop\n", RW_ERROR_FILE_FORMAT, "face 0|endlop"},
    {"a.stl", "solid x\n" FACET "endloop\nendfacet\nendsolid x\n", RW_ERROR_BAD_POLYGON, "face 0 has 2 corners"},
    {"a.stl", "solid x\n" FACET "vertex 0 1 0\nvertex 1 1 0\nendloop\n", RW_ERROR_FILE_FORMAT, "face 0|4 corners"},
    {"a.stl", "solid x\n" FACET "vertex 0 1 q\n", RW_ERROR_FILE_FORMAT, "face 0|q|no number"},
    {"a.stl", "solid x\n" FACET "vertex 0 1 inf\n", RW_ERROR_NOT_FINITE, "face 0"},
    {"a.stl", "solid x\n" FACET "vertex 0 1 0\nendloop\nendfacet\n", RW_ERROR_FILE_FORMAT, "endsolid is missing"},
};

static void wrong_content(void) {
    size_t i;
    rw_mesh *none = NULL;
    for (i = 0; i < sizeof wrong_files / sizeof wrong_files[0]; ++i) {
        const struct wrong_file *f = &wrong_files[i];
        const int before = failures;
        char parts[200];
        snprintf(parts, sizeof parts, "%s|%s", f->name, f->parts);
        CHECK_ERROR(rw_mesh_load(file_with(f->name, f->content), &none), f->status, parts);
        if (failures != before) fprintf(stderr, "    content: %s\n", f->content);
    }
    CHECK(none == NULL);
}

static void binary_content(void) {
    static const char head[] = BINARY_PLY VERTEX_3 FACE_1 "end_header\n";
    unsigned char ply[sizeof head - 1 + 36 + 13], stl[84 + 50];
    const float nan = NAN;
    rw_mesh *none = NULL;
    memset(ply, 0, sizeof ply);
    memcpy(ply, head, sizeof head - 1);
    ply[sizeof ply - 13] = 3;
    memcpy(ply + sizeof head - 1 + 4 * 5, &nan, sizeof nan);
    CHECK_ERROR(rw_mesh_load(file_of("b.ply", ply, sizeof ply), &none), RW_ERROR_NOT_FINITE,
                "vertex 1|coordinate z|NaN");
    memset(stl, 0, sizeof stl);
    stl[80] = 2; /* facets, of which there is one */
    CHECK_ERROR(rw_mesh_load(file_of("b.stl", stl, sizeof stl), &none), RW_ERROR_FILE_FORMAT, "truncated|2 facets");
    stl[80] = 1;
    memcpy(stl + 84 + 12 + 4 * 4, &nan, sizeof nan);
    CHECK_ERROR(rw_mesh_load(file_of("b.stl", stl, sizeof stl), &none), RW_ERROR_NOT_FINITE,
                "face 0|coordinate y|corner 1|NaN");
    CHECK_ERROR(rw_mesh_load(file_of("b.obj", "v 0 0 0\n\0 1", 11), &none), RW_ERROR_FILE_FORMAT, "no text|line 2");
    CHECK_ERROR(rw_mesh_load(file_of("b.off", "OFF\n\0 1", 7), &none), RW_ERROR_FILE_FORMAT, "no text|line 2");
    CHECK(none == NULL);
}

static void no_content(void) {
    rw_mesh *none = NULL;
    char path[600];
    CHECK_ERROR(rw_mesh_load("/nowhere/at/all.obj", &none), RW_ERROR_FILE_NOT_FOUND, "/nowhere/at/all.obj");
    CHECK_ERROR(rw_mesh_load("", &none), RW_ERROR_FILE_NOT_FOUND, "");
    snprintf(path, sizeof path, "%s/folder.obj", folder);
    if (mkdir(path, 0700) != 0) exit(1);
    CHECK_ERROR(rw_mesh_load(path, &none), RW_ERROR_FILE_UNREADABLE, "folder.obj");
    rmdir(path);
    if (mkfifo(path, 0600) != 0) exit(1);
    CHECK_ERROR(rw_mesh_load(path, &none), RW_ERROR_FILE_UNREADABLE, "folder.obj");
    remove(path);
    /* A plain file by its looks, whose first page cannot be read. */
    if (symlink("/proc/self/mem", path) != 0) exit(1);
    CHECK_ERROR(rw_mesh_load(path, &none), RW_ERROR_FILE_UNREADABLE, "folder.obj|read to its end");
    remove(path);
    if (geteuid() != 0) { /* root may read everything */
        const char *secret = file_with("secret.obj", "v 0 0 0\n");
        if (chmod(secret, 0) != 0) exit(1);
        CHECK_ERROR(rw_mesh_load(secret, &none), RW_ERROR_FILE_UNREADABLE, "secret.obj|opened");
    }
    CHECK(none == NULL);
}

int main(void) {
    set_up();
    wrong_content();
    binary_content();
    no_content();
    return tear_down("errors of mesh files");
}
