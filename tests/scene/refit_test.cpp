// What is planned for a scene whose meshes have moved.
#include "scene/explain.h"
#include "scene/scene.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

namespace raywise {
namespace {

using namespace testing;

std::shared_ptr<const Profile> generic() { return std::make_shared<const Profile>(generic_profile()); }

std::shared_ptr<Scene> refit(const Scene& scene, const Soup& soup, RefitPolicy policy = RefitPolicy::where_it_pays) {
    Progress progress;
    return scene.refitted({{soup.arrays(), true, false, "meshes[0]."}}, policy, Parallel(2), progress);
}

std::shared_ptr<Scene> forced(const Soup& soup, Structure structure, std::uint64_t memory_limit = 0) {
    return make_scene(soup, generic(), [&](Scene& scene) {
        scene.set_structure(structure);
        scene.set_memory_limit(memory_limit);
    });
}

template <class Move>
Soup moved(Soup soup, const Move& move) {
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) soup.vertices[i] = move(soup.vertices[i], i);
    return soup;
}

// Each triangle by itself, far from its neighbours.
Soup exploded(const Soup& soup) {
    return moved(soup, [](float x, std::size_t i) {
        const auto triangle = static_cast<std::uint32_t>(i / 9);
        const auto axis = static_cast<std::uint32_t>(i % 3);
        return x + 30.0f * static_cast<float>((triangle * 2654435761u + axis * 97u) % 1009u) / 1009.0f;
    });
}

// The first `count` triangles become points.
Soup collapsed(const Soup& soup, std::size_t count) {
    return moved(soup, [&](float x, std::size_t i) { return i < 9 * count ? soup.vertices[i / 9 * 9 + i % 3] : x; });
}

void expect_same_answers(const Scene& scene, const Soup& soup) {
    const auto judge = forced(soup, Structure::linear_scan);
    for (const Ray& ray : make_chords(500))
        ASSERT_TRUE(same_bits(scene.tracer().closest(ray), judge->tracer().closest(ray)));
}

TEST(Refit, NeedsACommittedSceneAndTheSameNumbers) {
    const Soup soup = make_soup(10);
    Progress progress;
    const auto status_of = [&](const Scene& scene, const std::vector<MovedMesh>& meshes) {
        try {
            scene.refitted(meshes, RefitPolicy::where_it_pays, Parallel(1), progress);
        } catch (const Error& error) {
            return error.status();
        }
        return Status::OK;
    };
    const MovedMesh mesh{soup.arrays(), true, false, "meshes[0]."};
    const MovedMesh other{make_soup(11).arrays(), true, false, "meshes[0]."};
    EXPECT_EQ(status_of(Scene(generic()), {}), Status::ERROR_NOT_COMMITTED);
    const auto scene = forced(soup, Structure::bvh);
    EXPECT_EQ(status_of(*scene, {mesh}), Status::OK);
    EXPECT_EQ(status_of(*scene, {}), Status::ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(status_of(*scene, {mesh, mesh}), Status::ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(status_of(*scene, {other}), Status::ERROR_INVALID_ARGUMENT);
}

TEST(Refit, IsCommitted) {
    const Soup soup = make_soup(100);
    const auto scene = refit(*forced(soup, Structure::bvh), soup);
    EXPECT_TRUE(scene->is_committed());
    EXPECT_THROW(scene->set_memory_limit(0), Error);
    EXPECT_EQ(scene->plan().chosen, Structure::bvh);
    EXPECT_TRUE(scene->plan().forced);
    ASSERT_TRUE(scene->plan().refit.has_value());
    EXPECT_EQ(scene->plan().refit->refits, 1u);
}

// The more rays are coming, the less may they lose.
TEST(Refit, BuildsAnewWhereThatPaysForTheRaysExpected) {
    const Soup soup = make_soup(3000);
    const Soup apart = exploded(soup);
    const auto refitted = [&](std::optional<std::uint64_t> rays, const Soup& to) {
        const auto scene = make_scene(soup, generic(), [&](Scene& s) {
            s.set_structure(Structure::bvh);
            if (rays) s.set_expected({*rays, RayKind::random}, {});
        });
        return refit(*scene, to);
    };
    EXPECT_EQ(refitted(1, apart)->plan().refit->refits, 1u);
    EXPECT_EQ(refitted(1000000000, apart)->plan().refit->refits, 0u);
    EXPECT_EQ(refitted(std::nullopt, apart)->plan().refit->refits, 0u);
    EXPECT_GT(refitted(std::nullopt, apart)->plan().refit->cost, 2.0);
    const Soup turned = moved(soup, [&](float, std::size_t i) {
        const std::size_t vertex = i / 3 * 3;
        return i % 3 == 0 ? -soup.vertices[vertex + 1] : i % 3 == 1 ? soup.vertices[vertex] : soup.vertices[i];
    });
    EXPECT_EQ(refitted(std::nullopt, turned)->plan().refit->refits, 1u);
    for (const std::uint64_t rays : {std::uint64_t{1}, std::uint64_t{1000000000}})
        expect_same_answers(*refitted(rays, apart), apart);
}

TEST(Refit, KeepsWhatWasChosenAndItsFigures) {
    const Soup soup = make_soup(500);
    const auto profile = make_profile([](MachineConstants& m) {
        for (const Structure structure : all_structures()) m.structures[structure].build_ns.fixed = 1e5;
        m.structures[Structure::kd_tree].build_ns = {1e3, 0.0, 0.0};
    });
    const auto scene = make_scene(soup, profile, [](Scene& s) { s.set_expected({100, RayKind::random}, {}); });
    ASSERT_EQ(scene->plan().chosen, Structure::kd_tree);
    const auto next = refit(*scene, exploded(soup));
    EXPECT_EQ(next->plan().chosen, Structure::kd_tree);
    EXPECT_FALSE(next->plan().forced);
    EXPECT_EQ(next->plan().refit->refits, 0u);
    EXPECT_STREQ(next->plan().refit->obstacle, "the structure cannot be refitted");
    for (const Structure structure : all_structures()) {
        EXPECT_EQ(next->plan().candidate(structure).predicted.build_ns,
                  scene->plan().candidate(structure).predicted.build_ns);
    }
    EXPECT_GT(next->plan().build_ns, 0.0);
    EXPECT_GT(next->plan().bytes, 0u);
    expect_same_answers(*next, exploded(soup));
}

// Measuring takes many builds; it was done once.
TEST(Refit, DoesNotMeasureAgain) {
    const Soup soup = make_soup(500);
    const auto scene =
        make_scene(soup, generic(), [](Scene& s) { s.set_effort(Effort::measure, Rule::smallest_total, 0.0); });
    int stages = 0;
    Progress progress([&](double, const char* stage) {
        stages += std::strcmp(stage, "measuring") == 0 ? 1 : 0;
        return false;
    });
    const auto next = scene->refitted({{soup.arrays(), true, false, "meshes[0]."}}, RefitPolicy::where_it_pays,
                                      Parallel(1), progress);
    EXPECT_EQ(stages, 0);
    EXPECT_EQ(next->plan().chosen, scene->plan().chosen);
    EXPECT_EQ(next->plan().effort, Effort::measure);
}

// What is best for a few triangles is not for many.
TEST(Refit, ChoosesAnewWhenTheSceneHasGrownOrShrunkMoreThanTwofold) {
    const Soup soup = make_soup(2000);
    const auto profile = make_profile([](MachineConstants& m) {
        for (const Structure structure : all_structures()) m.structures[structure].build_ns.fixed = 1e5;
        m.structures[Structure::linear_scan].build_ns = {};
        for (LinearCost& ray : m.structures[Structure::linear_scan].ray_ns) ray.per_unit[0] = 10.0;
    });
    const auto scene = make_scene(collapsed(soup, 1999), profile, [](Scene& s) {
        s.set_expected({1000, RayKind::random}, {});
    });
    ASSERT_EQ(scene->plan().chosen, Structure::linear_scan);
    const auto grown = refit(*scene, soup);
    EXPECT_NE(grown->plan().chosen, Structure::linear_scan);
    EXPECT_EQ(grown->plan().refit->refits, 0u);
    EXPECT_NE(std::string(grown->plan().refit->obstacle).find("number of triangles"), std::string::npos);
    expect_same_answers(*grown, soup);
    EXPECT_EQ(refit(*grown, collapsed(soup, 500))->plan().chosen, grown->plan().chosen);
    EXPECT_EQ(refit(*grown, collapsed(soup, 1999))->plan().chosen, Structure::linear_scan);
    // A structure that is forced stays, and a tree that holds them all goes with them.
    const auto tree = refit(*forced(soup, Structure::bvh), collapsed(soup, 1500));
    EXPECT_EQ(tree->plan().refit->refits, 1u);
    expect_same_answers(*tree, collapsed(soup, 1500));
}

TEST(Refit, KeepsTheMemoryLimit) {
    // Of the one about half as many triangles can be hit, and a tree of them has no place for the others.
    const Soup large = make_soup(2000);
    const Soup small = collapsed(large, 900);
    const std::uint64_t of_small = forced(small, Structure::bvh)->plan().bytes;
    const std::uint64_t of_large = forced(large, Structure::bvh)->plan().bytes;
    ASSERT_GT(of_large, of_small + 1000) << "the limit below has to be between them";
    const std::uint64_t limit = of_small + 500;

    const auto must = forced(small, Structure::bvh, limit);
    try {
        refit(*must, large);
        FAIL() << "the tree is too large";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), Status::ERROR_MEMORY_LIMIT);
        EXPECT_NE(std::string(error.what()).find("bvh"), std::string::npos) << error.what();
    }
    const auto profile = make_profile([](MachineConstants& m) {
        for (const Structure structure : all_structures()) m.structures[structure].build_ns.fixed = 1e5;
        m.structures[Structure::bvh].build_ns.fixed = 1e3;
    });
    const auto may = make_scene(small, profile, [&](Scene& s) {
        s.set_expected({100, RayKind::random}, {});
        s.set_memory_limit(limit);
    });
    ASSERT_EQ(may->plan().chosen, Structure::bvh);
    const auto other = refit(*may, large);
    EXPECT_NE(other->plan().chosen, Structure::bvh);
    EXPECT_LE(other->plan().bytes, limit);
    EXPECT_NE(std::string(other->plan().refit->obstacle).find("memory limit"), std::string::npos);
    EXPECT_TRUE(other->plan().candidate(Structure::bvh).over_limit);
    expect_same_answers(*other, large);
}

TEST(Refit, ProgressEndsAtItsEnd) {
    const Soup soup = make_soup(5000);
    for (const Structure structure : all_structures()) {
        const auto scene = forced(soup, structure);
        double last = -1.0;
        Progress progress(expect_within_ends(last));
        scene->refitted({{soup.arrays(), true, false, ""}}, RefitPolicy::where_it_pays, Parallel(2), progress);
        EXPECT_EQ(last, 1.0) << name_of(structure);
        Progress stop([](double, const char*) { return true; });
        EXPECT_THROW(scene->refitted({{soup.arrays(), true, false, ""}}, RefitPolicy::where_it_pays, Parallel(2), stop),
                     Error);
    }
}

TEST(Refit, IsExplainedInOneLineThatFits) {
    const Soup soup = make_soup(1000);
    const auto scene = forced(soup, Structure::bvh);
    const auto text_of = [](const Scene& s) { return explain_text(s.plan(), s.tracer(), *s.profile()); };
    EXPECT_EQ(text_of(*scene).find("refit"), std::string::npos);
    for (const auto& each :
         {refit(*scene, soup), refit(*scene, exploded(soup)), refit(*forced(soup, Structure::kd_tree), soup)}) {
        const std::string text = text_of(*each);
        const std::size_t begin =
            text.find("\n" + std::string(each->plan().refit->refits > 0 ? "refitted: 1 times" : "not refitted"));
        ASSERT_NE(begin, std::string::npos) << text;
        EXPECT_LE(text.find('\n', begin + 1) - begin - 1, 100u) << text;
    }
}

} // namespace
} // namespace raywise
