/* The part of raywise that the demo uses, as a table of function pointers.
 *
 * Nothing here is linked: the library is opened at run time, so that one program can be tried with several builds of it
 * (--library) and so that the demo shows that the C interface alone is enough. */
#ifndef DEMO_API_H
#define DEMO_API_H

#include <raywise/raywise.h>

#include <stdbool.h>

/* X(result, name without rw_, arguments). To use one more function, add one line. */
#define API_FUNCTIONS(X)                                                                                               \
    X(int32_t, version, (uint32_t *, uint32_t *, uint32_t *))                                                          \
    X(int32_t, abi_version, (uint32_t *))                                                                              \
    X(const char *, status_text, (int32_t))                                                                            \
    X(const char *, last_error_message, (void))                                                                        \
    X(int32_t, profile_load, (const char *, rw_profile **))                                                            \
    X(int32_t, profile_release, (const rw_profile *))                                                                  \
    X(int32_t, profile_inspect, (const rw_profile *, rw_profile_info *))                                               \
    X(int32_t, mesh_load, (const char *, rw_mesh **))                                                                  \
    X(int32_t, mesh_release, (const rw_mesh *))                                                                        \
    X(int32_t, mesh_triangles, (const rw_mesh *, rw_triangles *))                                                      \
    X(int32_t, structure_count, (uint32_t *))                                                                          \
    X(int32_t, structure_name, (uint32_t, const char **))                                                              \
    X(int32_t, scene_create, (const rw_profile *, rw_scene **))                                                        \
    X(int32_t, scene_release, (const rw_scene *))                                                                      \
    X(int32_t, scene_add_triangles, (rw_scene *, const rw_triangles *, uint32_t *))                                    \
    X(int32_t, scene_set_expected_rays, (rw_scene *, const rw_expected_rays *))                                        \
    X(int32_t, scene_set_structure, (rw_scene *, const char *))                                                        \
    X(int32_t, scene_commit, (rw_scene *, const rw_commit_options *))                                                  \
    X(int32_t, scene_bounds, (const rw_scene *, double *, double *))                                                   \
    X(int32_t, scene_get_statistics, (const rw_scene *, rw_scene_statistics *))                                        \
    X(int32_t, scene_intersect_batch, (const rw_scene *, const rw_rays *, const rw_hits *, const rw_query_options *))  \
    X(int32_t, scene_occluded_batch, (const rw_scene *, const rw_rays *, const rw_output *, const rw_query_options *)) \
    X(int32_t, scene_candidate_count, (const rw_scene *, uint32_t *))                                                  \
    X(int32_t, scene_get_candidate, (const rw_scene *, uint32_t, rw_candidate *))                                      \
    X(int32_t, scene_explain, (const rw_scene *, int32_t, char *, uint64_t, uint64_t *))                               \
    X(int32_t, scene_view, (const rw_scene *, const rw_view_options *, const rw_commit_options *, rw_scene **))

struct api {
    void *library;
#define API_MEMBER(result, name, arguments) result(*name) arguments;
    API_FUNCTIONS(API_MEMBER)
#undef API_MEMBER
};

/* Opens the library and fills the table. On failure says why on stderr and returns false; nothing is left open. */
bool api_open(struct api *api, const char *path);

/* Closes what api_open opened; harmless on a zeroed table. */
void api_close(struct api *api);

/* True when status is RW_OK; otherwise says on stderr which call failed and why. */
bool api_ok(const struct api *api, int32_t status, const char *call);

#endif
