// One answer: the same bits from every structure, entry point, number of threads and order.
#include "testing.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace {

constexpr uint64_t count = 600;

struct Answers {
    std::vector<double> t = std::vector<double>(count), uv = std::vector<double>(2 * count),
                        normal = std::vector<double>(3 * count);
    std::vector<uint32_t> geometry = std::vector<uint32_t>(count), primitive = std::vector<uint32_t>(count);

    rw_hits describe() {
        rw_hits hits{};
        hits.struct_size = sizeof hits;
        hits.t.data = t.data();
        hits.uv.data = uv.data();
        hits.normal.data = normal.data();
        hits.t.type = hits.uv.type = hits.normal.type = RW_FLOAT64;
        hits.geometry.data = geometry.data();
        hits.primitive.data = primitive.data();
        return hits;
    }
    bool same_bits(const Answers& other) const {
        const auto same = [](const auto& a, const auto& b) {
            return memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
        };
        return same(t, other.t) && same(uv, other.uv) && same(normal, other.normal) && same(geometry, other.geometry) &&
               same(primitive, other.primitive);
    }
    bool same_bits(const rw_scene* scene, uint64_t i, const rw_hit& hit) const {
        const double weights[2] = {hit.u, hit.v};
        double of_hit[3] = {0.0, 0.0, 0.0};
        if (hit.primitive != RW_INVALID_ID) CHECK_OK(rw_scene_normal(scene, &hit, of_hit));
        return memcmp(&t[i], &hit.t, 8) == 0 && memcmp(&uv[2 * i], weights, 16) == 0 &&
               memcmp(&normal[3 * i], of_hit, 24) == 0 && geometry[i] == hit.geometry && primitive[i] == hit.primitive;
    }
};

std::vector<rw_ray> make_rays(const soup& s) {
    std::vector<rw_ray> rays;
    for (uint64_t i = 0; i < count; ++i) {
        rw_ray ray = random_ray();
        if (i % 3 == 1) { // exactly at a corner, along an axis
            for (int axis = 0; axis < 3; ++axis) {
                ray.origin[axis] =
                    static_cast<double>(s.vertices[9 * (i % s.triangles) + static_cast<uint64_t>(axis)]) -
                    (axis == 2 ? 4.0 : 0.0);
                ray.direction[axis] = axis == 2 ? 0.5 : 0.0;
            }
        } else if (i % 3 == 2) { // from one point
            for (int axis = 0; axis < 3; ++axis) ray.origin[axis] = axis == 0 ? 3.0 : 0.125;
            ray.direction[0] = -1.0;
        }
        if (i % 50 == 7) ray.direction[1] = NAN;
        rays.push_back(ray);
    }
    return rays;
}

rw_rays describe(const std::vector<rw_ray>& in) {
    rw_rays rays{};
    rays.struct_size = sizeof rays;
    rays.count = in.size();
    rays.origin.data = in[0].origin;
    rays.direction.data = in[0].direction;
    rays.tmin.data = &in[0].tmin;
    rays.tmax.data = &in[0].tmax;
    for (rw_array* array : {&rays.origin, &rays.direction, &rays.tmin, &rays.tmax}) {
        array->stride = sizeof(rw_ray);
        array->type = RW_FLOAT64;
    }
    return rays;
}

void check_scene(const rw_scene* scene, const std::vector<rw_ray>& in, const Answers& wanted) {
    const rw_rays rays = describe(in);
    for (const uint32_t threads : {0u, 1u, 2u, 7u, 64u}) {
        rw_query_options options{};
        options.struct_size = sizeof options;
        options.threads = threads;
        Answers answers;
        const rw_hits hits = answers.describe();
        CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, &options));
        CHECK(answers.same_bits(wanted));
    }
    std::vector<uint8_t> flags(count);
    rw_output occluded{};
    occluded.data = flags.data();
    CHECK_OK(rw_scene_occluded_batch(scene, &rays, &occluded, nullptr));
    for (uint64_t i = 0; i < count; ++i) {
        rw_hit hit;
        int32_t any = 9;
        uint64_t needed = 0;
        CHECK_OK(rw_scene_intersect(scene, &in[i], nullptr, &hit));
        CHECK(wanted.same_bits(scene, i, hit));
        CHECK_OK(rw_scene_occluded(scene, &in[i], nullptr, &any));
        CHECK(any == (hit.primitive != RW_INVALID_ID ? 1 : 0) && any == flags[i]);
        std::vector<rw_hit> all(2000);
        CHECK_OK(rw_scene_intersect_all(scene, &in[i], nullptr, all.data(), all.size(), &needed));
        CHECK((needed > 0) == (any == 1));
        if (needed > 0) CHECK(wanted.same_bits(scene, i, all[0]));
    }
}

void check_views(const rw_scene* scene, const std::vector<rw_ray>& in, const Answers& wanted) {
    const rw_rays rays = describe(in);
    uint32_t structures = 0;
    NEED_OK(rw_structure_count(&structures));
    for (uint32_t i = 0; i <= structures; ++i) {
        const char* name = nullptr;
        if (i < structures) NEED_OK(rw_structure_name(i, &name));
        for (int kind = 0; kind < 3; ++kind) {
            rw_view_options options{};
            options.struct_size = sizeof options;
            options.count = 1000000;
            options.structure = name;
            options.kind = kind == 2 ? RW_VIEW_DIRECTION : RW_VIEW_POINT;
            options.origin[0] = 3.0;
            options.origin[1] = options.origin[2] = 0.125;
            if (kind == 1) options.direction[0] = -1.0;
            if (kind == 2) options.direction[2] = 1.0;
            rw_scene* view = nullptr;
            if (!CHECK_OK(rw_scene_view(scene, &options, nullptr, &view))) continue;
            Answers answers;
            const rw_hits hits = answers.describe();
            CHECK_OK(rw_scene_intersect_batch(view, &rays, &hits, nullptr));
            CHECK(answers.same_bits(wanted));
            std::vector<uint8_t> flags(count);
            rw_output occluded{};
            occluded.data = flags.data();
            CHECK_OK(rw_scene_occluded_batch(view, &rays, &occluded, nullptr));
            for (uint64_t r = 0; r < count; r += 7) {
                rw_hit hit;
                int32_t any = 9;
                uint64_t needed = 0, of_scene = 1;
                CHECK_OK(rw_scene_intersect(view, &in[r], nullptr, &hit));
                CHECK(wanted.same_bits(view, r, hit));
                CHECK_OK(rw_scene_occluded(view, &in[r], nullptr, &any));
                CHECK(any == flags[r] && any == (hit.primitive != RW_INVALID_ID ? 1 : 0));
                CHECK_OK(rw_scene_intersect_all(view, &in[r], nullptr, nullptr, 0, &needed));
                CHECK_OK(rw_scene_intersect_all(scene, &in[r], nullptr, nullptr, 0, &of_scene));
                CHECK(needed == of_scene);
            }
            rw_scene_release(view);
        }
    }
}

} // namespace

int main() {
    use_all_helpers();
    soup s = make_soup(700);
    soup small = make_soup(40);
    const std::vector<rw_ray> in = make_rays(s);
    const rw_rays rays = describe(in);
    const rw_triangles meshes[2] = {triangles_of(&s), triangles_of(&small)};
    Answers wanted;
    uint32_t structures = 0;
    NEED_OK(rw_structure_count(&structures));
    for (uint32_t i = 0; i < structures + 4; ++i) {
        rw_scene* scene = nullptr;
        const char* name = nullptr;
        NEED_OK(rw_scene_create(nullptr, &scene));
        for (const rw_triangles& mesh : meshes) NEED_OK(rw_scene_add_triangles(scene, &mesh, nullptr));
        if (i < structures) {
            NEED_OK(rw_structure_name(i, &name));
            NEED_OK(rw_scene_set_structure(scene, name));
        } else { // the library's own choices
            rw_expected_rays expected{};
            expected.struct_size = sizeof expected;
            expected.count = i % 2 == 0 ? 1 : 100000000;
            expected.kind = RW_RAYS_DIFFUSE;
            expected.sample = &rays;
            NEED_OK(rw_scene_set_expected_rays(scene, &expected));
            NEED_OK(rw_scene_set_effort(scene, static_cast<int32_t>(i - structures) % 3,
                                        i % 2 == 0 ? RW_RULE_SMALLEST_TOTAL : RW_RULE_HAPALA, 1.0));
        }
        NEED_OK(rw_scene_commit(scene, nullptr));
        if (i == 0) {
            const rw_hits hits = wanted.describe();
            NEED_OK(rw_scene_intersect_batch(scene, &rays, &hits, nullptr));
        }
        check_scene(scene, in, wanted);
        if (i < 2) check_views(scene, in, wanted);
        rw_scene_release(scene);

        rw_once_options once{};
        once.struct_size = sizeof once;
        once.structure = name;
        Answers answers;
        const rw_hits hits = answers.describe();
        CHECK_OK(rw_once_intersect(meshes, 2, &rays, &hits, i == structures ? nullptr : &once));
        CHECK(answers.same_bits(wanted));
        std::vector<uint8_t> flags(count);
        rw_output occluded{};
        occluded.data = flags.data();
        CHECK_OK(rw_once_occluded(meshes, 2, &rays, &occluded, &once));
        for (uint64_t r = 0; r < count; ++r) CHECK(flags[r] == (wanted.primitive[r] != RW_INVALID_ID ? 1 : 0));
    }

    // Another order of the rays, and the arrays shared instead of copied.
    std::vector<rw_ray> reversed(in.rbegin(), in.rend());
    const rw_rays backwards = describe(reversed);
    rw_scene* shared = nullptr;
    NEED_OK(rw_scene_create(nullptr, &shared));
    for (rw_triangles mesh : meshes) {
        mesh.flags = RW_TRIANGLES_SHARED;
        NEED_OK(rw_scene_add_triangles(shared, &mesh, nullptr));
    }
    NEED_OK(rw_scene_commit(shared, nullptr));
    Answers answers;
    const rw_hits hits = answers.describe();
    CHECK_OK(rw_scene_intersect_batch(shared, &backwards, &hits, nullptr));
    for (uint64_t i = 0; i < count; ++i) CHECK(memcmp(&answers.t[count - 1 - i], &wanted.t[i], 8) == 0);
    check_scene(shared, in, wanted);
    rw_scene_release(shared);
    free_soup(&s);
    free_soup(&small);
    return finish("same answers");
}
