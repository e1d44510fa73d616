// Frame after frame: scenes made from moved or changed meshes take the memory of those before, and answer as any other scene.
#include "base/page_pool.h"
#include "scene/scene.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace raywise {
namespace {

using namespace testing;

// Of so many triangles vertices, nodes and references are pooled arrays, and none of them is near the length from which arrays are.
constexpr std::uint32_t triangles = 18000;
constexpr int frames_to_settle = 6;
constexpr int frames_to_settle_where_lengths_vary = 12; // lists that grow are of more lengths

std::shared_ptr<const Profile> generic() {
    static const auto profile = std::make_shared<const Profile>(generic_profile());
    return profile;
}

Soup moved(Soup soup, int frame) {
    const float by = 0.02f * std::sin(static_cast<float>(frame));
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) soup.vertices[i] += by * static_cast<float>(i % 7);
    return soup;
}

std::vector<MovedMesh> meshes_of(const Soup& soup) { return {{soup.arrays(), true, false, "meshes[0]."}}; }

std::shared_ptr<Scene> next_frame(const Scene& scene, const Soup& soup, RefitPolicy policy) {
    Progress progress;
    return scene.refitted(meshes_of(soup), policy, Parallel(1), progress);
}

std::shared_ptr<Scene> committed(const Soup& soup, Structure structure) {
    return make_scene(soup, generic(), [&](Scene& scene) { scene.set_structure(structure); });
}

void expect_same_answers(const Scene& scene, const Soup& soup, std::size_t rays = 40) {
    const auto judge = committed(soup, Structure::linear_scan);
    for (const Ray& ray : make_chords(rays))
        ASSERT_TRUE(same_bits(scene.tracer().closest(ray), judge->tracer().closest(ray)));
}

std::uint64_t fresh_blocks() { return page_pool_figures().fresh_blocks; }

// Where triangles lie decides how many cells or parts of triangles there are.
bool lengths_vary(Structure structure) {
    return structure == Structure::uniform_grid || structure == Structure::two_level_grid ||
           structure == Structure::kd_tree;
}

class Frames : public ::testing::Test {
protected:
    void SetUp() override { keep_pages(0); }
    // Whatever was done, all is given back with the last scene.
    void TearDown() override {
        keep_pages(0);
        EXPECT_EQ(page_pool_figures().in_use, 0u);
        EXPECT_EQ(page_pool_figures().kept, 0u);
    }
};

TEST_F(Frames, TakeNothingFromTheSystemInSteadyState) {
    const Soup soup = make_soup(triangles);
    for (const RefitPolicy policy : {RefitPolicy::never, RefitPolicy::where_possible, RefitPolicy::where_it_pays}) {
        for (const Structure structure : all_structures()) {
            auto scene = committed(soup, structure);
            const int settles = lengths_vary(structure) ? frames_to_settle_where_lengths_vary : frames_to_settle;
            std::uint64_t settled = 0;
            for (int frame = 0; frame < settles + 5; ++frame) {
                if (frame == settles) settled = fresh_blocks();
                scene = next_frame(*scene, moved(soup, frame), policy);
            }
            // An array that is longer than any before finds no block that will do.
            const std::uint64_t longer = lengths_vary(structure) ? 2 : 0;
            EXPECT_LE(fresh_blocks(), settled + longer)
                << name_of(structure) << ", policy " << static_cast<int>(policy);
            EXPECT_GT(page_pool_figures().kept, 0u);
            const std::uint64_t refits = scene->plan().refit->refits;
            EXPECT_EQ(refits > 0,
                      policy != RefitPolicy::never && std::string(name_of(structure)).substr(0, 3) == "bvh");
            expect_same_answers(*scene, moved(soup, settles + 4));
            scene.reset();
            EXPECT_EQ(page_pool_figures().kept, 0u) << name_of(structure);
        }
    }
}

TEST_F(Frames, OfTheStructureThatWasChosenAreSoToo) {
    const Soup soup = make_soup(triangles);
    for (const std::uint64_t rays : {1u, 1000u, 1000000u}) {
        auto scene = make_scene(soup, generic(), [&](Scene& s) { s.set_expected({rays, RayKind::random}, {}); });
        const Structure chosen = scene->plan().chosen;
        std::uint64_t settled = 0;
        for (int frame = 0; frame < frames_to_settle + 4; ++frame) {
            if (frame == frames_to_settle) settled = fresh_blocks();
            // Where it is reckoned whether a refit pays, the first frame that is built anew may come at any time.
            scene = next_frame(*scene, moved(soup, frame), RefitPolicy::never);
            EXPECT_EQ(scene->plan().chosen, chosen);
        }
        EXPECT_EQ(fresh_blocks(), settled) << rays;
    }
}

TEST_F(Frames, OnceIsNotOften) {
    const Soup soup = make_soup(triangles);
    auto scene = committed(soup, Structure::bvh);
    scene = next_frame(*scene, moved(soup, 1), RefitPolicy::never);
    EXPECT_EQ(page_pool_figures().kept, 0u);
    scene = next_frame(*scene, moved(soup, 2), RefitPolicy::never);
    EXPECT_GT(page_pool_figures().kept, 0u);
}

// Whoever lets triangles come and go refits the scene that has them all, again and again.
TEST_F(Frames, MayAllBeMadeFromTheFirst) {
    const Soup soup = make_soup(triangles);
    for (const bool release_first : {true, false}) {
        const auto first = committed(soup, Structure::bvh);
        std::shared_ptr<Scene> scene;
        std::uint64_t settled = 0;
        for (int frame = 0; frame < frames_to_settle + 5; ++frame) {
            if (frame == frames_to_settle) settled = fresh_blocks();
            if (release_first) scene.reset();
            scene = next_frame(*first, moved(soup, frame), RefitPolicy::where_possible);
        }
        EXPECT_EQ(fresh_blocks(), settled);
        expect_same_answers(*scene, moved(soup, frames_to_settle + 4));
    }
}

TEST_F(Frames, WithOtherNumbersOfTrianglesAreBuiltAnew) {
    for (const Structure structure : all_structures()) {
        auto scene = committed(make_soup(triangles), structure);
        const std::uint64_t before = fresh_blocks();
        std::uint64_t blocks = 0;
        for (int frame = 0; frame < 16; ++frame) {
            const std::uint32_t count = triangles + static_cast<std::uint32_t>(frame * 7919 % 4000) - 2000;
            const Soup soup = make_soup(count, static_cast<unsigned>(frame));
            scene = next_frame(*scene, soup, RefitPolicy::never);
            EXPECT_EQ(scene->tracer().primitives().count(), count);
            EXPECT_EQ(scene->plan().chosen, structure);
            if (frame == 3) blocks = fresh_blocks() - before;
            if (frame % 8 == 7) expect_same_answers(*scene, soup, 10);
        }
        // Sizes differ by up to an eighth, which a block has room for.
        EXPECT_LE(fresh_blocks() - before, 3 * blocks) << name_of(structure);
    }
}

TEST_F(Frames, ThatBecomeSmallGiveMemoryBack) {
    auto scene = committed(make_soup(triangles), Structure::bvh);
    for (int frame = 0; frame < 4; ++frame)
        scene = next_frame(*scene, moved(make_soup(triangles), frame), RefitPolicy::never);
    EXPECT_GT(page_pool_figures().kept, 0u);
    for (std::size_t frame = 0; frame < builds_remembered + 2; ++frame)
        scene = next_frame(*scene, make_soup(100), RefitPolicy::never);
    EXPECT_EQ(page_pool_figures().kept, 0u);
    EXPECT_EQ(page_pool_figures().in_use, 0u);
    scene = next_frame(*scene, Soup{}, RefitPolicy::never);
    EXPECT_EQ(scene->tracer().primitives().count(), 0u);
    scene = next_frame(*scene, make_soup(triangles), RefitPolicy::never);
    expect_same_answers(*scene, make_soup(triangles));
}

TEST_F(Frames, ChooseAnewWhereNumbersChangeMoreThanTwofold) {
    const Soup few = make_soup(50), many = make_soup(2000);
    const auto scene = make_scene(few, generic());
    const auto next = next_frame(*scene, many, RefitPolicy::never);
    EXPECT_STREQ(next->plan().refit->obstacle, "the number of triangles that can be hit has changed");
    EXPECT_EQ(next->plan().chosen, make_scene(many, generic())->plan().chosen);
    const auto again = next_frame(*next, moved(many, 1), RefitPolicy::never);
    EXPECT_STREQ(again->plan().refit->obstacle, "it was to be built anew");
    EXPECT_EQ(again->plan().refit->refits, 0u);
}

TEST_F(Frames, MayHaveOtherNumbersOfMeshes) {
    const Soup one = make_soup(300, 1), two = make_soup(200, 2), three = make_soup(100, 3);
    Progress progress;
    const auto frame = [&](const Scene& scene, const std::vector<const Soup*>& soups) {
        std::vector<MovedMesh> meshes;
        for (const Soup* soup : soups) meshes.push_back({soup->arrays(), true, false, "meshes[0]."});
        return scene.refitted(meshes, RefitPolicy::never, Parallel(1), progress);
    };
    const auto first = committed(one, Structure::bvh);
    const auto more = frame(*first, {&two, &three, &one});
    EXPECT_EQ(more->tracer().primitives().count(), 600u);
    EXPECT_EQ(more->tracer().primitives().meshes().size(), 3u);
    const auto fewer = frame(*more, {&one});
    expect_same_answers(*fewer, one);
    EXPECT_EQ(frame(*fewer, {})->tracer().primitives().count(), 0u);
}

// The structure of a refitted tree that nobody would keep is kept where that was asked for.
TEST_F(Frames, AreRefittedHoweverBoxesOverlapWhereThatIsAskedFor) {
    const Soup soup = make_soup(2000);
    Soup apart = soup;
    for (std::size_t i = 0; i < apart.vertices.size(); ++i)
        apart.vertices[i] += 30.0f * static_cast<float>((i / 9 * 2654435761u + i % 3 * 97u) % 1009u) / 1009.0f;
    const auto scene = committed(soup, Structure::bvh);
    EXPECT_EQ(next_frame(*scene, apart, RefitPolicy::where_it_pays)->plan().refit->refits, 0u);
    const auto kept = next_frame(*scene, apart, RefitPolicy::where_possible);
    EXPECT_EQ(kept->plan().refit->refits, 1u);
    EXPECT_GT(kept->plan().refit->cost, 2.0);
    expect_same_answers(*kept, apart);
}

TEST_F(Frames, OfAViewAreFramesToo) {
    const Soup soup = make_soup(triangles);
    ViewRequest request;
    request.frame.origin = {0.0, 0.0, 4.0};
    request.forced = Structure::projected_bvh;
    Progress progress;
    auto view = Scene::seen(committed(soup, Structure::bvh), request, Parallel(1), progress);
    std::uint64_t settled = 0;
    for (int frame = 0; frame < frames_to_settle + 4; ++frame) {
        if (frame == frames_to_settle) settled = fresh_blocks();
        view = next_frame(*view, moved(soup, frame), RefitPolicy::never);
    }
    EXPECT_EQ(fresh_blocks(), settled);
    EXPECT_EQ(view->plan().chosen, Structure::projected_bvh);
    expect_same_answers(*view, moved(soup, frames_to_settle + 3));
    const Soup other = make_soup(triangles / 2, 5);
    view = next_frame(*view, other, RefitPolicy::never);
    expect_same_answers(*view, other);
}

TEST_F(Frames, OfNewScenesTakeWhatIsKeptOnRequest) {
    const Soup soup = make_soup(triangles);
    keep_pages(std::uint64_t{1} << 30);
    std::uint64_t settled = 0;
    for (int frame = 0; frame < frames_to_settle + 4; ++frame) {
        if (frame == frames_to_settle) settled = fresh_blocks();
        const auto scene = committed(moved(soup, frame), Structure::bvh);
        if (frame == frames_to_settle) expect_same_answers(*scene, moved(soup, frame));
    }
    EXPECT_EQ(fresh_blocks(), settled);
    EXPECT_EQ(page_pool_figures().in_use, 0u);
    EXPECT_GT(page_pool_figures().kept, 0u);
}

TEST_F(Frames, OfSeveralThreadsAreTheirOwn) {
    const Soup soup = make_soup(triangles / 2);
    const auto shared = committed(soup, Structure::bvh);
    const auto frames_of = [&](unsigned thread) {
        std::shared_ptr<const Scene> scene = shared;
        Progress progress;
        for (int frame = 0; frame < 6; ++frame) {
            const Soup there = moved(soup, frame + 10 * static_cast<int>(thread));
            const RefitPolicy policy = frame % 2 == 0 ? RefitPolicy::never : RefitPolicy::where_possible;
            // The first scene goes on being asked and moved by all.
            const Scene& from = frame % 3 == 0 ? *shared : *scene;
            scene = from.refitted(meshes_of(there), policy, Parallel(2), progress);
            expect_same_answers(*scene, there, 10);
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < 3; ++i) threads.emplace_back(frames_of, i);
    for (std::thread& thread : threads) thread.join();
    expect_same_answers(*shared, soup);
}

TEST_F(Frames, WithKeptIndicesNeedTheNumbersOfBefore) {
    const Soup soup = make_soup(10);
    std::vector<std::uint32_t> indices(30);
    for (std::uint32_t i = 0; i < 30; ++i) indices[i] = i;
    TriangleArrays arrays = soup.arrays();
    arrays.indices = {reinterpret_cast<const std::byte*>(indices.data()), 12, 4, Scalar::uint32};
    Scene scene(generic());
    scene.add_triangles(arrays, true, false);
    Progress progress;
    scene.commit(Parallel(1), progress);
    const Soup more = make_soup(11);
    const auto status_of = [&](TriangleArrays moved) {
        try {
            scene.refitted({{moved, true, false, "meshes[0]."}}, RefitPolicy::never, Parallel(1), progress);
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("meshes[0].triangle_count"), std::string::npos) << error.what();
            return error.status();
        }
        return Status::OK;
    };
    EXPECT_EQ(status_of(soup.arrays()), Status::OK);
    EXPECT_EQ(status_of(more.arrays()), Status::ERROR_INVALID_ARGUMENT);
    TriangleArrays fewer = soup.arrays();
    fewer.triangle_count = 9;
    EXPECT_EQ(status_of(fewer), Status::ERROR_INVALID_ARGUMENT);
    TriangleArrays whole = more.arrays();
    std::vector<std::uint32_t> others{0, 1, 2, 30, 31, 32};
    whole.indices = {reinterpret_cast<const std::byte*>(others.data()), 12, 4, Scalar::uint32};
    whole.triangle_count = 2;
    EXPECT_EQ(status_of(whole), Status::OK);
}

} // namespace
} // namespace raywise
