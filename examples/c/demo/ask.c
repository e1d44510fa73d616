#include "ask.h"

#include <string.h>

bool ask_batch(const struct target *target, const struct ray_list *list, uint64_t first, uint64_t count,
               const rw_hits *hits, uint8_t *occluded) {
    const struct api *api = target->api;
    const rw_rays rays = ray_list_batch(list, first, count);
    rw_query_options options;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.threads = target->threads;
    if (!target->any_hit)
        return api_ok(api, api->scene_intersect_batch(target->scene, &rays, hits, &options),
                      "rw_scene_intersect_batch");
    rw_output output;
    memset(&output, 0, sizeof output);
    output.data = occluded;
    return api_ok(api, api->scene_occluded_batch(target->scene, &rays, &output, &options), "rw_scene_occluded_batch");
}

static rw_output member(void *data, int32_t type) {
    rw_output output;
    memset(&output, 0, sizeof output);
    output.data = data;
    output.stride = sizeof(struct surface_hit);
    output.type = type;
    return output;
}

rw_hits ask_whole_hits(struct surface_hit *hits) {
    rw_hits outputs;
    memset(&outputs, 0, sizeof outputs);
    outputs.struct_size = sizeof outputs;
    outputs.t = member(&hits->hit.t, RW_FLOAT64);
    outputs.uv = member(&hits->hit.u, RW_FLOAT64);
    outputs.normal = member(hits->normal, RW_FLOAT64);
    outputs.instance = member(&hits->hit.instance, RW_UINT32);
    outputs.geometry = member(&hits->hit.geometry, RW_UINT32);
    outputs.primitive = member(&hits->hit.primitive, RW_UINT32);
    return outputs;
}
