/* raywise: ray queries against triangle meshes, with a structure chosen by measurement.
 *
 * This header is the whole contract. It is C99, needs nothing but the standard library, and compiles
 * as C++ as well.
 *
 * The rules that hold everywhere and are not repeated below:
 *
 * - Status. Every function that can fail returns an int32_t status, RW_OK or one of the RW_ERROR_ and
 *   RW_PROFILE_ values, and hands results out through pointers. On an error nothing is written to the
 *   outputs unless the function says otherwise, and rw_last_error_message() names the argument and the
 *   element that was wrong. RW_ERROR_INVALID_ARGUMENT is returned for a pointer that is NULL where that is not
 *   allowed, an unknown constant, an impossible struct_size or a number out of range; RW_ERROR_OUT_OF_MEMORY when
 *   memory runs out; "Returns" lists the others.
 * - NULL. Pointers may be NULL only where it says so; options that may be stand for the defaults then.
 * - Structs. Option and result structs begin with `struct_size`: set it to sizeof the struct. All other
 *   bytes zero is the default. Later versions may add members at the end; a smaller struct_size
 *   from an older program stays valid. Members called `reserved` are 0, which is checked: RW_ERROR_RESERVED.
 * - Since. All is there since 0.2, the first version that was published; what comes later says so.
 * - Arrays are a pointer, an element type and byte strides (rw_array). No alignment, no padding and no
 *   readable byte beyond the last element is asked for. The caller's input is never written to. No byte may belong
 *   to two outputs, or to an output and to the rays, which is checked: RW_ERROR_SHARED_MEMORY. Outputs whose bytes
 *   alternate, such as members of one struct for each ray, are fine.
 * - Texts and files are the same in every locale: a decimal point is a point.
 * - Handles (rw_scene, rw_profile, rw_mesh) are counted: *_create, *_load, rw_scene_view and rw_scene_refit hand out
 *   one reference, *_retain adds one, *_release gives one back and the last one frees; releasing NULL does nothing.
 *   A workspace (rw_batch_workspace) has one owner: created once, released once.
 * - Threads. Functions may run at the same time in any number of threads. Those that take a handle which is not const
 *   (an rw_scene that is being filled and committed) need that handle alone.
 * - Threads of the library. The first commit, refit, view or batch that is worth it starts them: of 1,024 triangles,
 *   or 512 rays (32 where each is tested against 32,768 triangles), or more, with an option `threads` that is not 1
 *   and no parallel_for. They are oneTBB's, at most one fewer than processors the process may use, serve all calls,
 *   and stay, asleep while there is nothing to do. Single rays, smaller calls, and loading the library start none.
 *   Calls of several threads of the host do not wait for each other (only mesh files are read one at a time).
 * - Memory. What a call took is given back when it returns, whatever the number of calls before. Kept for the next one
 *   is the place in which threads meet: for each value of `threads` in use as many as there were calls at once, 7 kB
 *   each and 2 kB for each thread above two. Scenes that are refitted frame after frame keep more, and what more a
 *   program wants kept it says: see rw_scene_refit, rw_memory_keep and rw_batch_workspace.
 * - Fork. A child may go on with all that it inherits, except from within a callback. Where the parent had threads of
 *   the library, the child has none and its calls work in the calling thread alone, or in a parallel_for; otherwise it
 *   starts its own.
 * - Rays. t is measured in units of the direction's length. A hit counts when tmin <= t <= tmax. A ray
 *   with a NaN anywhere, a zero direction, an infinite origin or direction, or tmin > tmax is a miss.
 *   Components of a direction below 2^-500 of its largest, that one rounded down to a power of two, count as zero.
 * - Answers. Whether a ray's line meets a triangle is decided by exact arithmetic on the coordinates given; edges and
 *   corners belong to the triangle. A triangle seen edge-on, and one without area, is not met. t is accurate to 2^-37
 *   of the distance between the ray's origin and the farthest point of the scene, u and v to 2^-30, nearly always to
 *   all but the last bits. A hit that close to tmin or tmax counts as its rounded t says, alike everywhere; but where a
 *   ray starts is told exactly: t is 0 when the origin lies on the triangle, below 0 when it lies beyond it by however
 *   little. Where several triangles are hit at the same t the lowest (instance, geometry, primitive) wins. The bits of
 *   an answer do not depend on the structure, the call, the order, the number of threads or the processor.
 * - float32. A float32 ray is the float64 ray of the same numbers: nothing is lost. float32 answers are the float64
 *   answers, rounded to nearest. So t stays within the [tmin, tmax] of a float32 ray, but may be an end of it where the
 *   float64 answer is beside it; a t beyond float32's range is INFINITY, and a hit all the same, as `primitive` tells;
 *   u + v may be above 1 by rounding; and a ray that starts at a rounded t can meet the same surface again (`skip`).
 * - All hits. A ray exactly through an edge or a corner meets every triangle around it. Where all hits are asked for,
 *   such a ray counts as one beside it, moved by less than any number towards the inside of its first hit's triangle:
 *   each surface is then crossed once. The first of all hits is the closest hit, a ray that hits anything has at least
 *   one, and their number is even for a ray that starts outside a closed mesh and odd for one that starts inside.
 * - Epsilons. There are none: nothing is moved, widened or passed over but what tmin, tmax and skip lists say, and
 *   those leave nothing out unless they are set.
 */
#ifndef RAYWISE_RAYWISE_H
#define RAYWISE_RAYWISE_H

#include <stdint.h>

#if defined(RW_BUILDING_LIBRARY) && defined(__GNUC__)
#define RW_API __attribute__((visibility("default")))
#else
#define RW_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Versions
 * ------------------------------------------------------------------------------------------------ */

#define RW_VERSION_MAJOR 0
#define RW_VERSION_MINOR 2
#define RW_VERSION_PATCH 0

/* The major number of the binary interface; the 1 of libraywise.so.1. */
#define RW_ABI_VERSION 1

/* Does: tells the version of the library that was loaded, which may differ from the header's.
 * major, minor, patch: each may be NULL (not wanted).
 * Returns: RW_OK. */
RW_API int32_t rw_version(uint32_t *major, uint32_t *minor, uint32_t *patch);

/* Does: tells the binary interface of the library that was loaded; compare it with RW_ABI_VERSION after dlopen.
 * abi: receives the number.
 * Returns: RW_OK. */
RW_API int32_t rw_abi_version(uint32_t *abi);

/* ------------------------------------------------------------------------------------------------
 * Status and errors
 * ------------------------------------------------------------------------------------------------ */

#define RW_OK 0
#define RW_ERROR_INVALID_ARGUMENT 1   /* NULL, an unknown constant, an impossible struct_size, a number out of range */
#define RW_ERROR_OUT_OF_MEMORY 2      /* an allocation failed; nothing was changed but a batch's outputs */
#define RW_ERROR_NOT_FINITE 3         /* a vertex has a NaN or infinite coordinate */
#define RW_ERROR_COORDINATE_RANGE 4   /* a float64 vertex lies beyond what a float32 box can hold */
#define RW_ERROR_INDEX_OUT_OF_RANGE 5 /* an index or id names a vertex, geometry or triangle that is not there */
#define RW_ERROR_TOO_MANY 6           /* more vertices, triangles or rays than there may be */
#define RW_ERROR_ALREADY_COMMITTED 7  /* a committed scene cannot be changed */
#define RW_ERROR_NOT_COMMITTED 8      /* the scene has to be committed first */
#define RW_ERROR_UNKNOWN_STRUCTURE 9  /* no structure has that name */
#define RW_ERROR_WRONG_STRUCTURE 10   /* the question has no meaning for the structure in use */
#define RW_ERROR_RAY_COUNT 11         /* an expected ray count of zero, or above RW_RAYS_LIMIT */
#define RW_ERROR_CAPACITY 12          /* the output is too small; `needed` says how large it has to be */
#define RW_ERROR_CANCELLED 13         /* a callback or flag asked to stop; nothing was changed but a batch's outputs */
#define RW_ERROR_MEMORY_LIMIT 14      /* no candidate fits the memory limit */
#define RW_ERROR_FILE_NOT_FOUND 15    /* there is no such file */
#define RW_ERROR_FILE_UNREADABLE 16   /* the file is there but cannot be opened or read */
#define RW_ERROR_FILE_FORMAT 17       /* the file's kind is unknown or its content is not of that kind */
#define RW_ERROR_NO_FACES 18          /* a mesh file without a single face */
#define RW_ERROR_BAD_POLYGON 19       /* a face with fewer than three corners */
#define RW_ERROR_HOST_PARALLEL 20     /* the caller's parallel-for left a task out or ran one twice */
#define RW_ERROR_INTERNAL 21          /* an unexpected failure; please report it */

/* Why a calibration profile was passed over. What is used instead, the next valid file or the generic constants that
 * are compiled in, is told by rw_profile_info. */
#define RW_PROFILE_NOT_FOUND 22  /* there is no file at that path */
#define RW_PROFILE_UNREADABLE 23 /* it cannot be opened, is not a plain file, or is over 1 MiB */
#define RW_PROFILE_MALFORMED 24  /* truncated, not JSON, or a member is missing or of the wrong type */
#define RW_PROFILE_SCHEMA 25     /* written in another format version */
#define RW_PROFILE_EPOCH 26      /* measured on kernels that have changed since */
#define RW_PROFILE_MACHINE 27    /* measured on another machine, or with another instruction set on this one */
#define RW_PROFILE_RANGE 28      /* a constant is negative, not finite or beyond belief */

#define RW_ERROR_RESERVED 29      /* a reserved member is not zero */
#define RW_ERROR_OVERLAP 30       /* the strides of an output let its elements overlap, or repeat one */
#define RW_ERROR_SHARED_MEMORY 31 /* a byte belongs to two outputs, or to an output and to the rays */
#define RW_ERROR_IN_USE 32        /* a workspace serves one batch at a time */

#define RW_STATUS_COUNT 33

/* Does: puts a status into words.
 * status: any value.
 * Returns: a constant English sentence, never NULL; an unknown status has a text as well.
 * Owner: the library; valid for ever. */
RW_API const char *rw_status_text(int32_t status);

/* Does: tells what went wrong in the calling thread's latest raywise call that did not return RW_OK,
 * naming the argument and the element, e.g. "triangle 17: index 9000 is out of range, the mesh has 507
 * vertices".
 * Returns: a text, never NULL; empty before the first error. Calls that return RW_OK leave it as it was.
 * Owner: the library; valid until the thread's next raywise call that does not return RW_OK. Threads: each has its
 * own. */
RW_API const char *rw_last_error_message(void);

/* ------------------------------------------------------------------------------------------------
 * Arrays
 * ------------------------------------------------------------------------------------------------ */

/* Element types. 0 stands for the usual one of the place: float32 for coordinates, t, u, v and normals,
 * uint32 for indices and ids, uint8 for flags. */
#define RW_TYPE_DEFAULT 0
#define RW_FLOAT32 1
#define RW_FLOAT64 2
#define RW_UINT8 3
#define RW_UINT32 4
#define RW_UINT64 5

/* A stride that repeats one element for every ray, e.g. one origin for a whole batch. */
#define RW_REPEAT (-9223372036854775807LL - 1)

/* Input of n elements with one, two or three components each. Component c of element i is at
 * (const char *)data + i * stride + c * component_stride. Strides may be negative. A stride of 0 means
 * packed; component_stride 0 is the size of the type. So AoS and SoA are the same struct with other strides. */
typedef struct rw_array {
    const void *data;         /* NULL: absent, where the place allows it */
    int64_t stride;           /* bytes from element to element; 0: packed; RW_REPEAT: the same one */
    int64_t component_stride; /* bytes from x to y and from y to z; 0: size of the type */
    int32_t type;             /* RW_FLOAT32 ... or RW_TYPE_DEFAULT */
    int32_t reserved;         /* 0 */
} rw_array;

/* Output, laid out as rw_array. data NULL: not wanted. RW_REPEAT is an error here, as are elements that overlap
 * (RW_ERROR_OVERLAP) and outputs that share a byte (RW_ERROR_SHARED_MEMORY). */
typedef struct rw_output {
    void *data;
    int64_t stride;
    int64_t component_stride;
    int32_t type;
    int32_t reserved; /* 0 */
} rw_output;

/* ------------------------------------------------------------------------------------------------
 * Threads of the host
 * ------------------------------------------------------------------------------------------------ */

/* One piece of work: call it once for every index below the count that was asked for. */
typedef void (*rw_task)(void *task_data, uint64_t index);

/* A parallel-for of the host program: it calls task(task_data, i) exactly once for each i in [0, count), in
 * any order and from any threads, and returns when all calls have returned.
 * user: the pointer given beside the function. */
typedef void (*rw_parallel_for)(void *user, uint64_t count, rw_task task, void *task_data);

/* ------------------------------------------------------------------------------------------------
 * Calibration profiles
 * ------------------------------------------------------------------------------------------------ */

/* What building and asking each structure costs on this machine; written by raywise-calibrate. It may change how
 * long things take, never an answer. */
typedef struct rw_profile rw_profile;

/* Where a profile came from. */
#define RW_PROFILE_SOURCE_GENERIC 0 /* compiled in */
#define RW_PROFILE_SOURCE_PATH 1    /* the path given */
#define RW_PROFILE_SOURCE_ENV 2     /* RAYWISE_CALIBRATION */
#define RW_PROFILE_SOURCE_USER 3    /* the user's cache folder */
#define RW_PROFILE_SOURCE_SYSTEM 4  /* the system's folder */

/* Text formats of the *_text and *_explain functions. */
#define RW_FORMAT_TEXT 0
#define RW_FORMAT_JSON 1

/* Does: hands out a profile. With a path: reads that file, anew with each call. With NULL: the first valid one of the
 * file named by the environment variable RAYWISE_CALIBRATION ("builtin" there means the generic constants), the
 * user's cache folder ($XDG_CACHE_HOME or ~/.cache, then raywise/<machine key>.json) and the system's folder
 * (/etc/raywise/<machine key>.json). The machine key names the processor, the instruction set that the library uses
 * on it, the last cache's size and the number of usable threads; `raywise-calibrate --help` prints these paths.
 * These places are looked at once in a process, by the first call that needs a profile and is given none; it is kept,
 * and what files and environment say later goes unseen. A profile written since can be loaded by its path.
 * path: UTF-8, or NULL.
 * profile: receives a profile the caller must release.
 * Returns: RW_OK when the file was used, or when path is NULL and there was no file at all. An RW_PROFILE_ status
 * when a file was passed over (that of the first): *profile is then set all the same, with a path to the generic
 * constants, with NULL to the next valid file's or the generic constants. RW_ERROR_INVALID_ARGUMENT and
 * RW_ERROR_OUT_OF_MEMORY set nothing. */
RW_API int32_t rw_profile_load(const char *path, rw_profile **profile);

/* Does: adds a reference. Returns: RW_OK. */
RW_API int32_t rw_profile_retain(const rw_profile *profile);

/* Does: gives a reference back; the last one frees. profile: may be NULL. Returns: RW_OK. */
RW_API int32_t rw_profile_release(const rw_profile *profile);

typedef struct rw_profile_info {
    uint32_t struct_size;
    int32_t source;      /* RW_PROFILE_SOURCE_ */
    int32_t status;      /* RW_OK, or why a file was passed over that comes before `source`: the first of them */
    uint32_t epoch;      /* calibration epoch of the constants */
    const char *path;    /* of the file in use; empty for the generic constants */
    const char *machine; /* key of the machine it was measured on; "generic" */
    const char *date;    /* when it was measured, ISO 8601 */
    const char *tool;    /* the program and version that measured it */
    double spread;       /* relative spread of repeated timings, 0.05 = 5 % */
    uint32_t threads;    /* threads the machine offered when it was measured */
    uint32_t reserved;   /* receives 0 */
} rw_profile_info;

/* Does: tells where a profile came from.
 * info: struct_size set; receives the facts. Texts belong to the profile.
 * Returns: RW_OK. */
RW_API int32_t rw_profile_inspect(const rw_profile *profile, rw_profile_info *info);

/* Does: writes the whole profile, every constant with its unit, as text for people or as JSON.
 * format: RW_FORMAT_TEXT or RW_FORMAT_JSON.
 * buffer: of capacity bytes, or NULL with capacity 0 to ask for the size only.
 * needed: receives the bytes it takes, the final zero included; may be NULL.
 * Returns: RW_OK; RW_ERROR_CAPACITY when buffer is too small (it then holds the beginning, zero-terminated). Asking
 * for the size only is RW_OK. */
RW_API int32_t rw_profile_text(const rw_profile *profile, int32_t format, char *buffer, uint64_t capacity,
                               uint64_t *needed);

/* ------------------------------------------------------------------------------------------------
 * Meshes
 * ------------------------------------------------------------------------------------------------ */

/* The scene reads the arrays in place for as long as it lives instead of copying them: they must stay as they are. */
#define RW_TRIANGLES_SHARED 1u
/* Triangles with a NaN, infinite or out-of-range vertex or an index out of range are never hit, instead of an error.
 * Ids do not shift. */
#define RW_TRIANGLES_SKIP_INVALID 2u

/* A triangle mesh in the caller's memory. Hits name a triangle by its position in `indices`. Degenerate
 * triangles (no area) are legal and are never hit. */
typedef struct rw_triangles {
    uint32_t struct_size;
    uint32_t flags;          /* RW_TRIANGLES_ */
    uint64_t vertex_count;   /* below 2^32 */
    rw_array vertices;       /* vertex_count elements of 3 components, float32 or float64 */
    uint64_t triangle_count; /* below 2^32 - 1; may be 0 */
    rw_array indices;        /* triangle_count elements of 3 components, uint32 or uint64; data NULL: triangle i has
                                the vertices 3i, 3i+1, 3i+2, and vertex_count has to be 3 * triangle_count */
} rw_triangles;

/* A mesh read from a file. */
typedef struct rw_mesh rw_mesh;

/* Does: reads an OBJ, PLY, OFF or STL file. A face of n corners becomes n - 2 triangles of its corners, faces in the
 * order of the file. A convex face becomes the fan about its first corner: (0, 1, 2), (0, 2, 3) and so on. Any other
 * is cut ear by ear, as seen in the coordinate plane where its area is largest, on exact signs: the corners are
 * looked at in the order 1, 2 ... n - 1, 0, each one is cut off where the triangle with its neighbours holds nothing
 * else of the outline, and then those next to a cut, in the order of the cuts. Each triangle has its corners in the
 * order of the face, beginning with the lowest position. The triangles cover the inside once and nothing else, also
 * with holes that are joined to the outline by lines there and back, and where the outline touches itself; some have
 * no area where corners are in line or repeated. A face whose outline crosses itself, or without area, still becomes
 * n - 2 triangles of its corners, always the same ones and none beyond its convex hull. Once no ear is left, corners
 * in line with their neighbours are cut off, then any that turns the way the face does, then any. Vertices and faces
 * are those of the file, in its order. Coordinates are as written: all float64 where float32 would change any, else
 * all float32. What is wrong with a file is said with the line (of text) or byte where it is. docs/mesh-files.md has
 * more.
 * path: UTF-8, or whatever bytes the system names the file by; the ending tells the format.
 * mesh: receives a mesh the caller must release.
 * Returns: RW_OK, RW_ERROR_FILE_NOT_FOUND, RW_ERROR_FILE_UNREADABLE, RW_ERROR_FILE_FORMAT, RW_ERROR_NO_FACES,
 * RW_ERROR_BAD_POLYGON, RW_ERROR_INDEX_OUT_OF_RANGE, RW_ERROR_NOT_FINITE, RW_ERROR_TOO_MANY. */
RW_API int32_t rw_mesh_load(const char *path, rw_mesh **mesh);

/* Does: adds a reference. Returns: RW_OK. */
RW_API int32_t rw_mesh_retain(const rw_mesh *mesh);

/* Does: gives a reference back; the last one frees. mesh: may be NULL. Returns: RW_OK. */
RW_API int32_t rw_mesh_release(const rw_mesh *mesh);

/* Does: describes the arrays of a mesh, ready for rw_scene_add_triangles.
 * triangles: struct_size set; receives pointers into the mesh. vertices.type is RW_FLOAT32 or RW_FLOAT64, which
 * depends on the file (see rw_mesh_load); indices.type is RW_UINT32.
 * Owner: the arrays belong to the mesh and live as long as it does; a scene that shares them (RW_TRIANGLES_SHARED)
 * needs the mesh to be kept. Returns: RW_OK. */
RW_API int32_t rw_mesh_triangles(const rw_mesh *mesh, rw_triangles *triangles);

/* Does: tells which face of the file each triangle was cut from.
 * face_of_triangle: receives a pointer to one uint32 per triangle, owned by the mesh.
 * face_count: receives the faces in the file; may be NULL.
 * Returns: RW_OK. */
RW_API int32_t rw_mesh_faces(const rw_mesh *mesh, const uint32_t **face_of_triangle, uint64_t *face_count);

/* ------------------------------------------------------------------------------------------------
 * Rays and hits
 * ------------------------------------------------------------------------------------------------ */

/* The id of nothing. */
#define RW_INVALID_ID 0xFFFFFFFFu

/* One ray. */
typedef struct rw_ray {
    double origin[3];
    double tmin; /* 0 for a ray that starts at its origin */
    double direction[3];
    double tmax; /* INFINITY for a ray without an end */
} rw_ray;

typedef struct rw_ray_f32 {
    float origin[3];
    float tmin;
    float direction[3];
    float tmax;
} rw_ray_f32;

/* A triangle by its ids: the last three of a rw_hit, in the same order. */
typedef struct rw_primitive_id {
    uint32_t instance;  /* RW_INVALID_ID while the scene has no instances */
    uint32_t geometry;  /* below the number of meshes */
    uint32_t primitive; /* below the mesh's triangle_count; RW_INVALID_ID: the entry stands for nothing */
} rw_primitive_id;

/* What else there is to say of one ray. */
typedef struct rw_ray_options {
    uint32_t struct_size;
    uint32_t skip_count;
    /* skip_count triangles that the ray passes through without a hit, in any order, repeats allowed; NULL when
     * skip_count is 0. */
    const rw_primitive_id *skip;
} rw_ray_options;

/* One answer. The point hit is origin + t * direction = (1 - u - v) * v0 + u * v1 + v * v2. The normal is asked for
 * where it is wanted: rw_scene_normal.
 * A miss has t = INFINITY, u = v = 0 and RW_INVALID_ID in all ids. */
typedef struct rw_hit {
    double t;
    double u, v;
    uint32_t instance;  /* RW_INVALID_ID while the scene has no instances */
    uint32_t geometry;  /* as given by rw_scene_add_triangles */
    uint32_t primitive; /* position of the triangle in its mesh */
    uint32_t reserved;  /* receives 0 */
} rw_hit;

typedef struct rw_hit_f32 {
    float t;
    float u, v;
    uint32_t instance;
    uint32_t geometry;
    uint32_t primitive;
} rw_hit_f32;

/* Many rays. */
typedef struct rw_rays {
    uint32_t struct_size;
    uint32_t flags; /* 0 */
    uint64_t count;
    rw_array origin;    /* 3 components, float32 or float64 */
    rw_array direction; /* 3 components, float32 or float64 */
    rw_array tmin;      /* 1 component, float32 or float64; data NULL: 0 */
    rw_array tmax;      /* 1 component, float32 or float64; data NULL: INFINITY */
    /* Triangles that single rays pass through without a hit: the one a ray starts on, say, or those it has met before.
     * Entry k is the pair skip_geometry[k], skip_primitive[k]; ids as hits carry them, so that outputs of one batch can
     * be the input of the next. A primitive with all bits set (RW_INVALID_ID, 2^64 - 1) stands for nothing.
     * skip_offsets: count + 1 numbers that never fall: ray i has the entries skip_offsets[i] up to, but without,
     * skip_offsets[i + 1]; NULL: entry i alone is for ray i. */
    const uint64_t *skip_offsets;
    rw_array skip_geometry;  /* 1 component, uint32 or uint64; data NULL: geometry 0 for all */
    rw_array skip_primitive; /* 1 component, uint32 or uint64; data NULL: nothing is skipped */
} rw_rays;

/* Where the answers to many rays go, in the order of the rays: those of rw_hit, rounded to the output's type. */
typedef struct rw_hits {
    uint32_t struct_size;
    uint32_t flags;      /* 0 */
    rw_output t;         /* float32 or float64 */
    rw_output uv;        /* 2 components, float32 or float64 */
    rw_output normal;    /* 3 components, float32 or float64: as rw_scene_normal; zero for a miss */
    rw_output instance;  /* uint32 or uint64 (a missing id is then 2^64 - 1) */
    rw_output geometry;  /* uint32 or uint64 */
    rw_output primitive; /* uint32 or uint64 */
} rw_hits;

/* A progress callback: user as given, fraction from 0 to 1, stage a constant text. Not 0 asks to stop. It is called at
 * least once per commit, refit, view and batch, never from two threads at once. Commits, refits and views call it
 * from any of the threads at work. Batches call it from the thread that asked, about every ten milliseconds; with a
 * parallel_for from any of the host's threads at work. */
typedef int32_t (*rw_progress)(void *user, double fraction, const char *stage);

/* The memory that batches take while they run, kept from one to the next: a batch like the one before then takes none
 * from the system, but for what oneTBB or a parallel_for may take. For hosts that ask in a loop; of use to any scene. It
 * grows to what the largest of its batches took: 48 bytes a ray, 80 where not all of the rays' numbers are float32, for at
 * most 2^20 rays, and 1 MiB for each thread; for all hits 24 bytes a ray and 32 a hit besides. */
typedef struct rw_batch_workspace rw_batch_workspace;

/* Does: makes a workspace, which is empty until it is used. workspace: receives it; the caller must release it.
 * Returns: RW_OK. */
RW_API int32_t rw_batch_workspace_create(rw_batch_workspace **workspace);

/* Does: frees a workspace. workspace: may be NULL; no batch may be using it. Returns: RW_OK. */
RW_API int32_t rw_batch_workspace_release(rw_batch_workspace *workspace);

/* How to run a batch. Whether to stop is looked at by every thread at work, every few milliseconds, and more seldom
 * only where a single ray takes longer. The batch then returns RW_ERROR_CANCELLED: outputs that were written are
 * right, others are as they were, and offsets, needed and invalid_rays are not written. */
typedef struct rw_query_options {
    uint32_t struct_size;
    uint32_t threads;             /* at most so many; 0: as many as the process may use */
    rw_parallel_for parallel_for; /* NULL: the library's own threads */
    void *parallel_user;          /* handed to parallel_for */
    uint64_t *invalid_rays;       /* receives how many rays held a NaN; NULL: not wanted */
    rw_progress progress;         /* NULL: none */
    void *progress_user;          /* handed to progress */
    /* Not 0 asks to stop; NULL: none. Read with relaxed atomic loads, so any thread may set it at any time by an atomic
     * store (_Atomic int32_t, std::atomic<int32_t>), and a signal handler by a plain one. Aligned to 4 bytes; only
     * read, and no byte of it may belong to an output. */
    const volatile int32_t *cancel;
    /* NULL: memory of the batch's own. It serves one batch at a time: RW_ERROR_IN_USE, and nothing is written, while
     * another one is at it, be it of another scene or thread or the one whose callback asks. */
    rw_batch_workspace *workspace;
} rw_query_options;

/* ------------------------------------------------------------------------------------------------
 * Structures
 * ------------------------------------------------------------------------------------------------ */

/* Does: counts the structures the library can choose from.
 * Returns: RW_OK. */
RW_API int32_t rw_structure_count(uint32_t *count);

/* Does: names a structure: "linear_scan", "uniform_grid", "kd_tree", "bvh", "projected_bvh", "bvh_quality",
 * "bvh_morton", "two_level_grid". Names stay, and so does their order; more may follow.
 * index: below the count. name: receives a constant text.
 * Returns: RW_OK. */
RW_API int32_t rw_structure_name(uint32_t index, const char **name);

/* ------------------------------------------------------------------------------------------------
 * Scenes: filling and committing
 * ------------------------------------------------------------------------------------------------ */

/* Geometry with the structure chosen for it. Fill it, say what is expected of it, commit it; from then on it never
 * changes. A view of a scene (rw_scene_view) is a scene as well. */
typedef struct rw_scene rw_scene;

/* Does: makes an empty scene.
 * profile: the constants to decide with; retained by the scene. NULL: the one that rw_profile_load(NULL) gives,
 * looked up once in a process.
 * scene: receives a scene the caller must release.
 * Returns: RW_OK. */
RW_API int32_t rw_scene_create(const rw_profile *profile, rw_scene **scene);

/* Does: adds a reference. Returns: RW_OK. */
RW_API int32_t rw_scene_retain(const rw_scene *scene);

/* Does: gives a reference back; the last one frees. scene: may be NULL. Returns: RW_OK. */
RW_API int32_t rw_scene_release(const rw_scene *scene);

/* Does: adds a mesh. Every vertex and index is checked here.
 * triangles: struct_size set. Copied unless RW_TRIANGLES_SHARED.
 * geometry: receives the mesh's id: 0, 1, 2 ... in the order of adding; may be NULL.
 * Returns: RW_OK, RW_ERROR_NOT_FINITE, RW_ERROR_COORDINATE_RANGE,
 * RW_ERROR_INDEX_OUT_OF_RANGE, RW_ERROR_TOO_MANY, RW_ERROR_ALREADY_COMMITTED, RW_ERROR_RESERVED.
 * On an error the scene is as it was. */
RW_API int32_t rw_scene_add_triangles(rw_scene *scene, const rw_triangles *triangles, uint32_t *geometry);

/* Kinds of rays: how they are spread, which decides what they cost. */
#define RW_RAYS_ANY_KIND 0 /* not known: reckoned as random */
#define RW_RAYS_RANDOM 1   /* no order at all: chords through the scene */
#define RW_RAYS_CAMERA 2   /* from one eye, in the order of an image */
#define RW_RAYS_SHADOW 3   /* towards one light, any hit */
#define RW_RAYS_DIFFUSE 4  /* from surfaces, in all directions */

/* Nobody knows how many rays will come. */
#define RW_RAYS_UNKNOWN 0xFFFFFFFFFFFFFFFFull
/* More rays than this is taken for a mistake. */
#define RW_RAYS_LIMIT 1000000000000000ull

/* What the scene will be asked. A wrong word here costs time, never an answer. */
typedef struct rw_expected_rays {
    uint32_t struct_size;
    int32_t kind;   /* RW_RAYS_ kind */
    uint64_t count; /* 1 ... RW_RAYS_LIMIT, or RW_RAYS_UNKNOWN; 0 is an error, so that a forgotten count shows */
    /* Some of the caller's rays, for RW_EFFORT_PROBE and RW_EFFORT_MEASURE and RW_RULE_HAPALA; copied, at most the
     * first 1,000, without their skip lists; NULL: rays of that kind are made up. */
    const rw_rays *sample;
} rw_expected_rays;

/* Does: says how many rays of which kind are coming. A scene that is not told reckons with RW_RAYS_UNKNOWN.
 * expected: struct_size set.
 * Returns: RW_OK, RW_ERROR_RAY_COUNT, RW_ERROR_TOO_MANY (a sample above RW_RAYS_LIMIT),
 * RW_ERROR_ALREADY_COMMITTED, RW_ERROR_RESERVED (the sample). */
RW_API int32_t rw_scene_set_expected_rays(rw_scene *scene, const rw_expected_rays *expected);

/* Does: bounds the memory that the structure may take, the caller's own arrays not counted.
 * bytes: 0: no limit.
 * Returns: RW_OK, RW_ERROR_ALREADY_COMMITTED. */
RW_API int32_t rw_scene_set_memory_limit(rw_scene *scene, uint64_t bytes);

/* Does: forces a structure by name. Every structure can be forced on every scene; projected_bvh, which is meant for
 * views, then works as a hierarchy without projections.
 * name: one of rw_structure_name; NULL: the library chooses again.
 * Returns: RW_OK, RW_ERROR_UNKNOWN_STRUCTURE, RW_ERROR_ALREADY_COMMITTED. */
RW_API int32_t rw_scene_set_structure(rw_scene *scene, const char *name);

/* How hard to think before choosing. */
#define RW_EFFORT_ESTIMATE 0 /* formulas only */
#define RW_EFFORT_PROBE 1    /* build the grid and time a sample of rays on it */
#define RW_EFFORT_MEASURE 2  /* build every candidate that fits and time the sample on each */

/* By which rule. */
#define RW_RULE_SMALLEST_TOTAL 0 /* build + rays, the smallest predicted total of all candidates */
#define RW_RULE_HAPALA 1         /* grid or kd-tree by the critical ray count (Hapala, Karlik, Havran 2011) */

/* Does: sets effort and rule of the choice.
 * effort: RW_EFFORT_. rule: RW_RULE_.
 * time_limit_seconds: RW_EFFORT_MEASURE starts no further build after so long; 0: no limit.
 * Returns: RW_OK, RW_ERROR_ALREADY_COMMITTED. */
RW_API int32_t rw_scene_set_effort(rw_scene *scene, int32_t effort, int32_t rule, double time_limit_seconds);

/* What rw_scene_refit does with the old structure. */
#define RW_REFIT_WHERE_IT_PAYS 0  /* new boxes around it, where that is reckoned to pay by the rays expected */
#define RW_REFIT_WHERE_POSSIBLE 1 /* new boxes around it wherever it has such a form, however they overlap */
#define RW_REFIT_NEVER 2          /* built anew; numbers of triangles and meshes may change from frame to frame */

typedef struct rw_commit_options {
    uint32_t struct_size;
    uint32_t threads;             /* at most so many; 0: as many as the process may use */
    rw_progress progress;         /* NULL: none */
    void *progress_user;          /* handed to progress */
    rw_parallel_for parallel_for; /* NULL: the library's own threads */
    void *parallel_user;          /* handed to parallel_for */
    int32_t refit;                /* RW_REFIT_, for rw_scene_refit; of no effect elsewhere */
    int32_t reserved;             /* 0 */
} rw_commit_options;

/* Does: chooses a structure and builds it. An empty scene is legal: every ray misses.
 * options: struct_size set; NULL: the defaults.
 * Returns: RW_OK, RW_ERROR_CANCELLED, RW_ERROR_MEMORY_LIMIT, RW_ERROR_ALREADY_COMMITTED,
 * RW_ERROR_HOST_PARALLEL. On an error the scene is as it was and may be committed again. */
RW_API int32_t rw_scene_commit(rw_scene *scene, const rw_commit_options *options);

/* Does: makes a committed scene of the same triangles at new places: a mesh that deforms, from frame to frame. The
 * structure is the old one with new boxes where it has such a form ("bvh") and that pays, which takes a fraction of
 * building; else the same structure is built anew; options->refit says otherwise. It is chosen anew only when the
 * number of triangles that can be hit has changed more than twofold or it would be over the memory limit. Expectations,
 * effort, memory limit, profile and a forced structure are those of the old scene. Answers are those of any scene with
 * these meshes.
 * scene: committed; stays as it is, may be asked meanwhile, and may be released afterwards. Of a view, the scene it
 * is of is refitted as well: *refitted is then the same view of that, with what was said for the view.
 * meshes: all of the scene's, in the order of adding, all with the same struct_size; each with as many triangles as
 * before, unless options->refit is RW_REFIT_NEVER, and vertices, flags and types of its own. Every vertex and index is
 * checked. indices.data NULL: the mesh keeps the indices it has in the old scene (none, if it has none or is not
 * there), and then needs as many vertices and triangles as there; indices that the old scene reads in place
 * (RW_TRIANGLES_SHARED) are copied unless the flag is set here too. The old scene's vertices are not read: they may be
 * gone, or moved in place, as long as nobody asks the old scene any more.
 * mesh_count: as many as the scene has, unless options->refit is RW_REFIT_NEVER. options: struct_size set; NULL: the
 * defaults.
 * refitted: receives a scene the caller must release.
 * Memory: from the second refit on, what scenes made from each other release, and what building takes, is kept for the
 * next frame: with what is in use at most twice what was in use at once during the last 32 builds. It goes back to the
 * system with the last of these scenes. In steady state a frame takes no large array from the system:
 *
 *     rw_commit_options options = {sizeof options};
 *     options.refit = RW_REFIT_NEVER; // or leave it: then a "bvh" is refitted
 *     while (next_frame(&mesh)) {     // the same vertices moved, or another mesh with its indices
 *         rw_scene *next;
 *         if (rw_scene_refit(scene, &mesh, 1, &options, &next) != RW_OK) break;
 *         rw_scene_release(scene);
 *         scene = next;
 *         rw_scene_intersect_batch(scene, &rays, &hits, NULL);
 *     }
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_CANCELLED, RW_ERROR_MEMORY_LIMIT, RW_ERROR_HOST_PARALLEL,
 * RW_ERROR_NOT_FINITE, RW_ERROR_COORDINATE_RANGE, RW_ERROR_INDEX_OUT_OF_RANGE,
 * RW_ERROR_TOO_MANY, RW_ERROR_RESERVED, RW_ERROR_INVALID_ARGUMENT (also for numbers that differ). */
RW_API int32_t rw_scene_refit(const rw_scene *scene, const rw_triangles *meshes, uint32_t mesh_count,
                              const rw_commit_options *options, rw_scene **refitted);

/* Does: says how much memory of released scenes, and of builds that are done, the process keeps for scenes to come. A
 * program that makes a scene, asks it and releases it, over and over, need not wait for the system to clear the same
 * pages again; where scenes are refitted frame after frame that is so by itself. At first 0: nothing is kept. Arrays of
 * 256 KiB or more are, and with what is in use at most twice what was in use at once during the last 32 builds.
 * bytes: at most so many. What is kept beyond that goes back to the system at once, what refitted scenes keep included
 * (they keep it again from the next frame on); so 0 gives back all there is.
 * Returns: RW_OK. Threads: any. */
RW_API int32_t rw_memory_keep(uint64_t bytes);

/* Does: tells how much memory is kept right now, for frames of refitted scenes or because of rw_memory_keep.
 * bytes: receives it.
 * Returns: RW_OK. */
RW_API int32_t rw_memory_kept(uint64_t *bytes);

/* ------------------------------------------------------------------------------------------------
 * Scenes: facts
 * ------------------------------------------------------------------------------------------------ */

/* Does: tells the box around all triangles that can be hit.
 * lower, upper: 3 values each. An empty scene has lower = INFINITY and upper = -INFINITY.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_SHARED_MEMORY. */
RW_API int32_t rw_scene_bounds(const rw_scene *scene, double *lower, double *upper);

typedef struct rw_scene_statistics {
    uint32_t struct_size;
    uint32_t geometry_count;
    uint64_t triangle_count;       /* all, degenerate and invalid ones included */
    uint64_t degenerate_triangles; /* without area: never hit */
    uint64_t invalid_triangles;    /* skipped by RW_TRIANGLES_SKIP_INVALID: never hit */
    const char *structure;         /* the one in use */
    double decide_ns;              /* time spent on choosing */
    double build_ns;               /* time spent on building what is in use */
    uint64_t structure_bytes;      /* memory of the structure */
    uint64_t geometry_bytes;       /* memory of copied meshes, which a view has in common with its scene */
    uint64_t rays;                 /* answered in batches so far */
    uint64_t invalid_rays;         /* rays with a NaN so far, single calls included */
    double rays_ns;                /* wall time of those batches */
    uint64_t refits;               /* how often the structure was refitted since it was built. */
} rw_scene_statistics;

/* Does: tells what is in a scene and what it has cost.
 * statistics: struct_size set. Texts are constants.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED. */
RW_API int32_t rw_scene_get_statistics(const rw_scene *scene, rw_scene_statistics *statistics);

/* Statistics over the t cells of a uniform grid, of which cell i has n_i references: Hapala, Karlik, Havran 2011, eq.
 * 1 to 6. */
typedef struct rw_grid_statistics {
    uint32_t struct_size;
    uint32_t resolution[3];
    uint64_t cells;
    uint64_t empty_cells;
    uint64_t references;
    uint64_t max_references;   /* eq. 2 */
    double sparseness;         /* eq. 1: empty cells / cells */
    double mean;               /* eq. 3: references per cell */
    double variance;           /* eq. 4: sum of (n_i - mean)^2 / (t - 1); 0 for a single cell */
    double standard_deviation; /* square root of the variance */
    double skewness;           /* eq. 5: sum of (n_i - mean)^3 / t / standard_deviation^3; 0 when the variance is 0 */
    double kurtosis; /* eq. 6: sum of (n_i - mean)^4 / t / variance^2, minus 3, so that it is about 0 for a normal
                        distribution (excess kurtosis); 0 when the variance is 0 */
} rw_grid_statistics;

/* Does: tells the statistics of the grid in use.
 * statistics: struct_size set.
 * Returns: RW_OK, RW_ERROR_WRONG_STRUCTURE when the structure is not uniform_grid, RW_ERROR_NOT_COMMITTED. */
RW_API int32_t rw_scene_get_grid_statistics(const rw_scene *scene, rw_grid_statistics *statistics);

/* ------------------------------------------------------------------------------------------------
 * Scenes: questions
 * ------------------------------------------------------------------------------------------------ */

/* Does: finds the closest hit of one ray.
 * options: struct_size set; may be NULL. hit: receives the answer, a miss included.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_INDEX_OUT_OF_RANGE (an id to skip that is not there). */
RW_API int32_t rw_scene_intersect(const rw_scene *scene, const rw_ray *ray, const rw_ray_options *options, rw_hit *hit);

/* Does: tells whether a ray hits anything.
 * options: as rw_scene_intersect. occluded: receives 1 or 0.
 * Returns: as rw_scene_intersect. */
RW_API int32_t rw_scene_occluded(const rw_scene *scene, const rw_ray *ray, const rw_ray_options *options,
                                 int32_t *occluded);

/* Does: finds every hit of one ray, sorted by t, then by (instance, geometry, primitive); a surface crossed at an
 * edge or a corner counts once (see "All hits" at the top).
 * options: as rw_scene_intersect. hits: room for capacity answers, or NULL with capacity 0 to ask for the number only.
 * needed: receives the number of hits there are.
 * Returns: as rw_scene_intersect, and RW_ERROR_CAPACITY when there are more than capacity (the closest ones are then
 * written). Asking for the number only is RW_OK. */
RW_API int32_t rw_scene_intersect_all(const rw_scene *scene, const rw_ray *ray, const rw_ray_options *options,
                                      rw_hit *hits, uint64_t capacity, uint64_t *needed);

/* Does: as the three above, for a float32 ray: their answers, rounded (see "float32" at the top). Hits are sorted by
 * what t is before it is rounded. */
RW_API int32_t rw_scene_intersect_f32(const rw_scene *scene, const rw_ray_f32 *ray, const rw_ray_options *options,
                                      rw_hit_f32 *hit);
RW_API int32_t rw_scene_occluded_f32(const rw_scene *scene, const rw_ray_f32 *ray, const rw_ray_options *options,
                                     int32_t *occluded);
RW_API int32_t rw_scene_intersect_all_f32(const rw_scene *scene, const rw_ray_f32 *ray, const rw_ray_options *options,
                                          rw_hit_f32 *hits, uint64_t capacity, uint64_t *needed);

/* Does: tells the normal of the triangle that was hit: (v1 - v0) x (v2 - v0), the right-hand rule, of unit length.
 * hit: of which only the ids are looked at. normal: receives three numbers.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_INDEX_OUT_OF_RANGE (an id that is not there),
 * RW_ERROR_INVALID_ARGUMENT also for a miss, and for a triangle that cannot be hit: one without area, or an invalid
 * one. */
RW_API int32_t rw_scene_normal(const rw_scene *scene, const rw_hit *hit, double *normal);
RW_API int32_t rw_scene_normal_f32(const rw_scene *scene, const rw_hit_f32 *hit, float *normal);

/* Does: finds the closest hit of many rays; the same bits as rw_scene_intersect for each.
 * rays: struct_size set. hits: struct_size set; the outputs it names are written to and may share memory
 * neither with each other and invalid_rays nor with the rays. That they leave alone meshes that are read in place is
 * not checked.
 * options: struct_size set; NULL: the defaults.
 * Rays may come in any order: many are traced in one that suits the structure, which takes 48 bytes a ray, 80 where not
 * all of their numbers are float32, of at most 2^20 rays, while the call lasts or for as long as the workspace does.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_HOST_PARALLEL and RW_ERROR_OUT_OF_MEMORY (the outputs are then
 * partly written), RW_ERROR_CANCELLED (see rw_query_options), RW_ERROR_INDEX_OUT_OF_RANGE (a skip list),
 * RW_ERROR_TOO_MANY (above RW_RAYS_LIMIT), RW_ERROR_RESERVED, RW_ERROR_OVERLAP, RW_ERROR_SHARED_MEMORY,
 * RW_ERROR_IN_USE. */
RW_API int32_t rw_scene_intersect_batch(const rw_scene *scene, const rw_rays *rays, const rw_hits *hits,
                                        const rw_query_options *options);

/* Does: tells for many rays whether they hit anything.
 * occluded: uint8, uint32 or uint64, 1 or 0 for each ray; data not NULL.
 * Otherwise as rw_scene_intersect_batch. */
RW_API int32_t rw_scene_occluded_batch(const rw_scene *scene, const rw_rays *rays, const rw_output *occluded,
                                       const rw_query_options *options);

/* Does: finds every hit of many rays. The hits of ray i are the elements offsets[i] up to offsets[i + 1] of the
 * outputs, sorted as in rw_scene_intersect_all.
 * offsets: room for rays->count + 1 numbers; written in full, RW_ERROR_CAPACITY or not.
 * hits: outputs with room for capacity answers; NULL with capacity 0 to ask for the offsets only.
 * needed: receives the number of all hits, offsets[rays->count]; may be NULL. It and offsets are outputs that may
 * share no memory.
 * Memory: 24 bytes a ray and 32 a hit, while the call lasts or for as long as the workspace does, beside what rays in
 * another order take.
 * Returns: RW_OK; RW_ERROR_CAPACITY when there are more than capacity (no hit is then written, offsets and needed are);
 * otherwise as rw_scene_intersect_batch. */
RW_API int32_t rw_scene_intersect_all_batch(const rw_scene *scene, const rw_rays *rays, uint64_t *offsets,
                                            const rw_hits *hits, uint64_t capacity, uint64_t *needed,
                                            const rw_query_options *options);

/* ------------------------------------------------------------------------------------------------
 * Scenes: why this structure
 * ------------------------------------------------------------------------------------------------ */

#define RW_CANDIDATE_CHOSEN 1u          /* the one in use */
#define RW_CANDIDATE_FORCED 2u          /* chosen because the caller named it */
#define RW_CANDIDATE_OVER_LIMIT 4u      /* would not fit the memory limit */
#define RW_CANDIDATE_MEASURED 8u        /* built and timed while choosing */
#define RW_CANDIDATE_NOT_APPLICABLE 16u /* has no meaning here: no view, or outside the rule */

/* One structure as the decision saw it. NaN stands for a figure that is not known. */
typedef struct rw_candidate {
    uint32_t struct_size;
    uint32_t flags;        /* RW_CANDIDATE_ */
    const char *structure; /* a constant text */
    double predicted_build_ns;
    double predicted_ray_ns;   /* per ray of the expected kind */
    double predicted_error;    /* relative residual of the calibration, 0.2 = 20 % */
    double predicted_total_ns; /* build + expected rays; NaN when their number is unknown */
    double break_even_rays; /* from so many rays on it beats the chosen one; INFINITY: never; NaN for the chosen one */
    uint64_t predicted_bytes;
    uint64_t actual_bytes; /* 0: not known */
    double actual_build_ns;
    double actual_ray_ns; /* of the batches so far, or of the sample while choosing */
} rw_candidate;

/* Does: counts the candidates of the decision; one per structure.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED. */
RW_API int32_t rw_scene_candidate_count(const rw_scene *scene, uint32_t *count);

/* Does: tells one candidate, in the order of rw_structure_name.
 * index: below the count. candidate: struct_size set.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED. */
RW_API int32_t rw_scene_get_candidate(const rw_scene *scene, uint32_t index, rw_candidate *candidate);

/* Does: explains the choice: scene, type of its vertices, profile, each candidate with predicted and actual build
 * time, ns per ray and bytes.
 * Arguments and results as rw_profile_text, and RW_ERROR_NOT_COMMITTED. */
RW_API int32_t rw_scene_explain(const rw_scene *scene, int32_t format, char *buffer, uint64_t capacity,
                                uint64_t *needed);

/* ------------------------------------------------------------------------------------------------
 * Scenes: views, for rays that share an origin or a direction
 * ------------------------------------------------------------------------------------------------ */

#define RW_VIEW_POINT 0     /* rays start at, or aim at, one point */
#define RW_VIEW_DIRECTION 1 /* rays run along one direction, forwards or backwards */

typedef struct rw_view_options {
    uint32_t struct_size;
    int32_t kind;        /* RW_VIEW_ */
    double origin[3];    /* RW_VIEW_POINT: the point */
    double direction[3]; /* RW_VIEW_DIRECTION: the direction, any length but zero. RW_VIEW_POINT: where the view looks;
                              all zero: all around, a cube of six planes */
    double half_angle;   /* RW_VIEW_POINT with a direction: radians from the direction to the farthest ray, below pi/2;
                              0: pi/4. Rays outside are answered as by the scene. */
    uint64_t count;      /* expected rays: 1 ... RW_RAYS_LIMIT or RW_RAYS_UNKNOWN; 0 is an error */
    int32_t ray_kind;    /* RW_RAYS_ kind, as a rule RW_RAYS_CAMERA or RW_RAYS_SHADOW; 0: camera */
    int32_t reserved;    /* 0 */
    const char *structure; /* forces a structure by name; NULL: the library chooses, the scene's own one included */
} rw_view_options;

/* Does: makes a scene of a scene's geometry, seen from a point (camera, point light) or along a direction (sun), and
 * builds a structure for it when that pays. Rays that do start at the point, or do run along the direction, can be
 * answered faster by it; all others are answered as by the scene. Either way with the same bits. It is a committed
 * scene in all that can be asked of one; its statistics are its own.
 * scene: committed; kept, with the meshes it shares (RW_TRIANGLES_SHARED), for as long as the view lives. Its memory
 * limit holds for the view's structure as well. A view of a view is one of the scene that the first is of.
 * options: struct_size set. commit: threads, progress and parallel-for of the build; may be NULL.
 * view: receives a scene the caller must release.
 * Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_RAY_COUNT, RW_ERROR_UNKNOWN_STRUCTURE, RW_ERROR_NOT_FINITE (origin
 * or direction), RW_ERROR_MEMORY_LIMIT, RW_ERROR_CANCELLED, RW_ERROR_HOST_PARALLEL, RW_ERROR_RESERVED. */
RW_API int32_t rw_scene_view(const rw_scene *scene, const rw_view_options *options, const rw_commit_options *commit,
                             rw_scene **view);

/* ------------------------------------------------------------------------------------------------
 * One shot: the number of rays is known and nothing is kept
 * ------------------------------------------------------------------------------------------------ */

typedef struct rw_once_options {
    uint32_t struct_size;
    int32_t kind;                  /* RW_RAYS_ kind of the rays */
    const rw_profile *profile;     /* NULL: the one that rw_profile_load(NULL) gives, looked up once in a process */
    const char *structure;         /* forces a structure by name; NULL: the library chooses */
    uint64_t memory_limit;         /* bytes of the structure; 0: no limit */
    const rw_query_options *query; /* NULL: the defaults */
} rw_once_options;

/* Does: answers a batch against meshes that are used in place and forgotten afterwards. The structure is chosen for
 * exactly rays->count rays.
 * meshes: mesh_count of them, all with the same struct_size; read in place, during the call only. Hits name mesh i as
 * geometry i.
 * rays, hits: as rw_scene_intersect_batch. options: struct_size set; NULL: the defaults. Building is watched by the
 * progress and cancel of options->query as well.
 * Returns: RW_OK, or what rw_scene_add_triangles, rw_scene_commit and rw_scene_intersect_batch may return. */
RW_API int32_t rw_once_intersect(const rw_triangles *meshes, uint32_t mesh_count, const rw_rays *rays,
                                 const rw_hits *hits, const rw_once_options *options);

/* Does: as rw_once_intersect, for the question whether anything is hit. occluded: as rw_scene_occluded_batch. */
RW_API int32_t rw_once_occluded(const rw_triangles *meshes, uint32_t mesh_count, const rw_rays *rays,
                                const rw_output *occluded, const rw_once_options *options);

#ifdef __cplusplus
}
#endif

#endif /* RAYWISE_RAYWISE_H */
