#include "batch/batch.h"

#include "model/policy.h"
#include "rays.h"
#include "records.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace raywise {
namespace {

using namespace testing;

std::shared_ptr<Scene> scene() {
    static const auto shared = make_scene(make_soup(1000), std::make_shared<const Profile>(generic_profile()));
    return shared;
}

std::vector<Ray> rays_with_faults(std::size_t count) {
    std::vector<Ray> rays = make_chords(count);
    for (std::size_t i = 0; i < rays.size(); i += 10) rays[i].origin.y = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 5; i < rays.size(); i += 10) rays[i].direction = Vec3(0.0);
    return rays;
}

bool is_hit_of(const Record& r, const Hit& hit) {
    const Vec3 normal = hit.is_hit()
                            ? unit_normal(scene()->tracer().primitives().meshes()[hit.geometry]->corners(hit.primitive))
                            : Vec3(0.0);
    return same_bits(hit, {r.t, r.uv[0], r.uv[1], r.instance, r.geometry, r.primitive}) &&
           std::memcmp(r.normal, &normal, sizeof normal) == 0;
}

constexpr RayOrdering orderings[] = {RayOrdering::where_it_pays, RayOrdering::always, RayOrdering::never};

TEST(Batch, GivesTheBitsOfSingleRaysByEveryStructureOnAnyNumberOfThreads) {
    BatchWorkspace workspace; // for one after the other
    for (const Structure structure : all_structures()) {
        SCOPED_TRACE(name_of(structure));
        const auto forced = make_scene(make_soup(1000), std::make_shared<const Profile>(generic_profile()),
                                       [&](Scene& s) { s.set_structure(structure); });
        for (const std::size_t count : {20u, 3000u, 20000u}) {
            const std::vector<Ray> rays = rays_with_faults(count);
            std::vector<Hit> expected;
            for (const Ray& ray : rays) expected.push_back(scene()->tracer().closest(ray));
            for (const RayOrdering ordering : orderings) {
                for (const unsigned threads : {1u, 2u, 5u}) {
                    std::vector<Record> records(rays.size());
                    const std::uint64_t invalid_before = forced->tracer().usage().invalid_rays;
                    EXPECT_EQ(intersect_batch(forced->tracer(), arrays_of(rays), outputs(records),
                                              options_of(threads, ordering, &workspace)),
                              count / 10);
                    EXPECT_EQ(forced->tracer().usage().invalid_rays - invalid_before, count / 10);
                    for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(is_hit_of(records[i], expected[i])) << i;
                }
            }
        }
    }
}

TEST(Batch, TellsOfAnyHitAsSingleRaysDo) {
    const std::vector<Ray> rays = rays_with_faults(20000);
    for (const RayOrdering ordering : orderings) {
        std::vector<std::uint8_t> occluded(rays.size(), 9);
        const OutputArray output{reinterpret_cast<std::byte*>(occluded.data()), 1, 1, Scalar::uint8};
        EXPECT_EQ(occluded_batch(scene()->tracer(), arrays_of(rays), output, options_of(2, ordering)), 2000u);
        for (std::size_t i = 0; i < rays.size(); ++i)
            ASSERT_EQ(occluded[i], scene()->tracer().any(rays[i]) ? 1 : 0) << i;
    }
}

// Each ray skips what it would hit.
TEST(Batch, SkipsWithEachRayWhatItIsToldTo) {
    const std::vector<Ray> rays = make_chords(20000);
    std::vector<std::uint32_t> skipped;
    for (const Ray& ray : rays) skipped.push_back(scene()->tracer().closest(ray).primitive);
    RayArrays arrays = arrays_of(rays);
    arrays.skip.primitive = {reinterpret_cast<const std::byte*>(skipped.data()), 4, 4, Scalar::uint32};
    for (const RayOrdering ordering : orderings) {
        std::vector<Record> records(rays.size());
        intersect_batch(scene()->tracer(), arrays, outputs(records), options_of(2, ordering));
        for (std::size_t i = 0; i < rays.size(); ++i) {
            std::vector<std::uint32_t> numbers;
            if (skipped[i] != invalid_id) numbers.push_back(skipped[i]);
            ASSERT_TRUE(is_hit_of(records[i], scene()->tracer().closest(rays[i], {sorted(numbers)}))) << i;
        }
    }
}

TEST(Batch, GoesOnAfterAFullWindow) {
    std::vector<Ray> rays = make_chords(1000);
    const std::size_t count = ordering_window + 5000;
    rays.reserve(count);
    while (rays.size() < count) rays.push_back(rays[rays.size() * 7 % 1000]);
    for (const RayOrdering ordering : {RayOrdering::where_it_pays, RayOrdering::always}) {
        std::vector<std::uint32_t> primitive(rays.size(), 7);
        HitArrays hits;
        hits.primitive = {reinterpret_cast<std::byte*>(primitive.data()), 4, 4, Scalar::uint32};
        intersect_batch(scene()->tracer(), arrays_of(rays), hits, options_of(2, ordering));
        for (std::size_t i = 0; i < 1000; ++i) ASSERT_EQ(primitive[i], scene()->tracer().closest(rays[i]).primitive);
        for (std::size_t i = 1000; i < count; ++i) ASSERT_EQ(primitive[i], primitive[i * 7 % 1000]) << i;
    }
}

TEST(Batch, WritesNothingBeyondItsElements) {
    const std::vector<Ray> rays = make_chords(100);
    std::vector<Record> records(102, Record{-7, {-7, -7}, {-7, -7, -7}, 7, 7, 7, 7});
    HitArrays out = outputs(records);
    for (OutputArray* field : {&out.t, &out.uv, &out.normal, &out.instance, &out.geometry, &out.primitive})
        field->data += sizeof(Record);
    intersect_batch(scene()->tracer(), arrays_of(rays), out, options_of(2));
    for (const Record& r : {records.front(), records.back()}) {
        EXPECT_EQ(r.t, -7);
        EXPECT_EQ(r.primitive, 7u);
    }
    for (const Record& r : records) EXPECT_EQ(r.filler, 7u);
}

TEST(Batch, ConvertsToTheOutputsTypes) {
    const std::vector<Ray> rays = make_chords(200);
    std::vector<float> t(rays.size());
    std::vector<std::uint64_t> primitive(rays.size());
    HitArrays out;
    out.t = {reinterpret_cast<std::byte*>(t.data()), 4, 4, Scalar::float32};
    out.primitive = {reinterpret_cast<std::byte*>(primitive.data()), 8, 8, Scalar::uint64};
    intersect_batch(scene()->tracer(), arrays_of(rays), out, options_of(1));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit hit = scene()->tracer().closest(rays[i]);
        EXPECT_EQ(t[i], static_cast<float>(hit.t));
        EXPECT_EQ(primitive[i],
                  hit.primitive == invalid_id ? std::numeric_limits<std::uint64_t>::max() : hit.primitive);
    }
}

TEST(Batch, RefusesAWorkspaceThatIsInUse) {
    const std::vector<Ray> rays = make_chords(300);
    BatchWorkspace workspace;
    std::vector<Record> records(rays.size());
    BatchOptions options = options_of(1, RayOrdering::where_it_pays, &workspace);
    int refusals = 0;
    options.watch.progress = [&](double, const char*) {
        std::vector<Record> others(rays.size());
        try {
            intersect_batch(scene()->tracer(), arrays_of(rays), outputs(others),
                            options_of(1, RayOrdering::never, &workspace));
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::ERROR_IN_USE);
            EXPECT_STREQ(error.what(), "options.workspace: another batch is using it");
            ++refusals;
        }
        return false;
    };
    intersect_batch(scene()->tracer(), arrays_of(rays), outputs(records), options);
    EXPECT_GE(refusals, 2); // the first look and the last
    for (std::size_t i = 0; i < rays.size(); ++i)
        ASSERT_TRUE(is_hit_of(records[i], scene()->tracer().closest(rays[i])));
    // Free again, even after a batch that was stopped.
    options.watch.progress = [](double, const char*) { return true; };
    EXPECT_THROW(intersect_batch(scene()->tracer(), arrays_of(rays), outputs(records), options), Error);
    options.watch.progress = {};
    intersect_batch(scene()->tracer(), arrays_of(rays), outputs(records), options);
}

TEST(Batch, FindsAllHitsInOrder) {
    for (const RayOrdering ordering : orderings) {
        const std::vector<Ray> rays = rays_with_faults(300);
        std::vector<std::uint64_t> offsets(rays.size() + 1);
        std::uint64_t needed = 0;
        EXPECT_EQ(intersect_all_batch(scene()->tracer(), arrays_of(rays), offsets.data(), {}, 0, needed,
                                      options_of(2, ordering)),
                  rays.size() / 10);
        ASSERT_GT(needed, 0u);
        EXPECT_EQ(offsets.back(), needed);
        std::vector<Record> records(needed);
        intersect_all_batch(scene()->tracer(), arrays_of(rays), offsets.data(), outputs(records), needed, needed,
                            options_of(2));
        std::vector<Hit> expected;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            scene()->tracer().all(rays[i], expected);
            ASSERT_EQ(offsets[i + 1] - offsets[i], expected.size());
            for (std::size_t k = 0; k < expected.size(); ++k) {
                EXPECT_TRUE(is_hit_of(records[offsets[i] + k], expected[k]));
                if (k > 0) {
                    EXPECT_LE(expected[k - 1].t, expected[k].t);
                }
            }
        }
    }
}

TEST(Batch, OfNoRaysIsNoTrouble) {
    std::vector<std::uint64_t> offsets(1, 99);
    std::uint64_t needed = 99;
    EXPECT_EQ(intersect_batch(scene()->tracer(), {}, {}, options_of(2)), 0u);
    intersect_all_batch(scene()->tracer(), {}, offsets.data(), {}, 0, needed, options_of(2));
    EXPECT_EQ(needed, 0u);
    EXPECT_EQ(offsets[0], 0u);
}

} // namespace
} // namespace raywise
