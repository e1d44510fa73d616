#include "scene/planner.h"

#include "scene/testing.h"

#include <gtest/gtest.h>

#include <random>

namespace raywise {
namespace {

using namespace testing;

constexpr auto L = Structure::linear_scan;
constexpr auto G = Structure::uniform_grid;
constexpr auto K = Structure::kd_tree;
constexpr auto B = Structure::bvh;

// Fixed costs for the structures; the others never win.
void set_costs(MachineConstants& constants, Structure structure, double build_ns, double ray_ns) {
    constants.structures[structure].build_ns.fixed = build_ns;
    for (auto& line : constants.structures[structure].ray_ns) line.fixed = ray_ns;
}

std::shared_ptr<const Profile> three_steps() {
    return make_profile([](MachineConstants& constants) {
        for (const Structure structure : all_structures()) set_costs(constants, structure, 1e9, 1e9);
        set_costs(constants, L, 0, 1000);
        set_costs(constants, G, 10'000, 100);
        set_costs(constants, K, 10'000'000, 50);
        set_costs(constants, B, 100'000, 10);
    });
}

Structure chosen_for(std::optional<std::uint64_t> rays) {
    const auto scene = make_scene(make_soup(100), three_steps(), [&](Scene& s) {
        s.set_expected({rays, RayKind::random}, {});
    });
    return scene->plan().chosen;
}

TEST(Planner, TakesTheSmallestPredictedTotal) {
    EXPECT_EQ(chosen_for(1), L);
    EXPECT_EQ(chosen_for(11), L);
    EXPECT_EQ(chosen_for(12), G);
    EXPECT_EQ(chosen_for(999), G);
    EXPECT_EQ(chosen_for(1001), B);
    EXPECT_EQ(chosen_for(100'000'000), B);
    // Never more than five times the best from a hundred rays on; the grid would take ten times the best at 10^8 rays, the scan 100 times.
    EXPECT_EQ(chosen_for(std::nullopt), B);
}

TEST(Planner, GivesTheSameAnswersWhateverIsChosen) {
    const Soup soup = make_soup(3000);
    const std::vector<Ray> rays = make_chords(500);
    const auto judge = make_scene(soup, three_steps(), [](Scene& s) { s.set_structure(L); });
    std::mt19937 random(11);
    std::exponential_distribution<double> cost(1e-4);
    for (int round = 0; round < 20; ++round) {
        const auto profile = make_profile([&](MachineConstants& constants) {
            for (const Structure structure : all_structures())
                set_costs(constants, structure, cost(random), cost(random));
        });
        const auto scene = make_scene(soup, profile, [&](Scene& s) {
            s.set_expected({1u + random() % 1000u, RayKind::any}, {});
        });
        for (const Ray& ray : rays) {
            ASSERT_TRUE(same_bits(scene->tracer().closest(ray), judge->tracer().closest(ray)))
                << name_of(scene->plan().chosen);
        }
    }
}

TEST(Planner, BuildsWhatIsForced) {
    for (const Structure structure : all_structures()) {
        const auto scene = make_scene(make_soup(100), three_steps(), [&](Scene& s) { s.set_structure(structure); });
        EXPECT_EQ(scene->plan().chosen, structure);
        EXPECT_TRUE(scene->plan().forced);
        EXPECT_GT(scene->plan().bytes, 0u);
    }
}

TEST(Planner, KeepsToTheMemoryLimit) {
    // Predicted to take no memory at all, so that only the built structure shows that it does not fit.
    const auto scene = make_scene(make_soup(1000), three_steps(), [&](Scene& s) {
        s.set_expected({1'000'000, RayKind::random}, {});
        s.set_memory_limit(2000);
    });
    EXPECT_EQ(scene->plan().chosen, L);
    EXPECT_TRUE(scene->plan().candidate(B).over_limit);
}

TEST(Planner, HasTheScanGatherForManyRaysOnly) {
    const auto bytes_for = [](std::optional<std::uint64_t> rays, std::uint64_t limit) {
        const auto scene = make_scene(make_soup(1000), three_steps(), [&](Scene& s) {
            s.set_expected({rays, RayKind::any}, {});
            s.set_structure(L);
            s.set_memory_limit(limit);
        });
        return scene->plan().bytes;
    };
    EXPECT_LT(bytes_for(1, 0), 1000u);
    EXPECT_GE(bytes_for(1000, 0), 36000u);
    EXPECT_GE(bytes_for(std::nullopt, 0), 36000u);
    EXPECT_LT(bytes_for(1000, 36000), 1000u) << "it can do without";
}

// Of all structures only the scan fits, and only as it reads the triangles in place.
TEST(Planner, KnowsThatTheScanCanDoWithoutMemory) {
    const auto profile = make_profile([](MachineConstants& constants) {
        for (const Structure structure : all_structures()) constants.structures[structure].bytes = {200, 36, 0.0};
    });
    const auto scene = make_scene(make_soup(1000), profile, [](Scene& s) {
        s.set_expected({1'000'000, RayKind::any}, {});
        s.set_memory_limit(2000);
    });
    EXPECT_EQ(scene->plan().chosen, L);
    EXPECT_FALSE(scene->plan().candidate(L).over_limit);
    EXPECT_LT(scene->plan().bytes, 2000u);
}

TEST(Planner, RefusesALimitThatNothingFits) {
    for (const bool forced : {false, true}) {
        try {
            make_scene(make_soup(1000), three_steps(), [&](Scene& s) {
                if (forced) s.set_structure(B);
                s.set_memory_limit(1);
            });
            FAIL() << "a structure of one byte";
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::ERROR_MEMORY_LIMIT);
            EXPECT_NE(std::string(error.what()).find("memory limit is 1"), std::string::npos) << error.what();
        }
    }
}

// One that is meant for views is not a candidate without one, and still has a size of its own.
TEST(Planner, TellsWhatAForcedStructureNeeds) {
    for (const Structure structure : all_structures()) {
        try {
            make_scene(make_soup(1000), three_steps(), [&](Scene& s) {
                s.set_structure(structure);
                s.set_memory_limit(1);
            });
            FAIL() << "a structure of one byte";
        } catch (const Error& error) {
            const std::string message = error.what();
            const std::size_t number = message.find("needs about ");
            ASSERT_NE(number, std::string::npos) << message;
            EXPECT_LT(std::stod(message.substr(number + 12)), 1e7) << message;
        }
    }
}

TEST(Planner, MeasuresEveryCandidateThatFits) {
    const auto scene = make_scene(make_soup(2000), three_steps(), [](Scene& s) {
        s.set_expected({1000, RayKind::random}, {});
        s.set_effort(Effort::measure, Rule::smallest_total, 0.0);
    });
    for (const Structure structure : {L, G, K, B}) {
        EXPECT_TRUE(scene->plan().candidate(structure).measured) << name_of(structure);
        EXPECT_GT(scene->plan().candidate(structure).actual_ray_ns, 0.0);
    }
    EXPECT_FALSE(scene->plan().candidate(Structure::projected_bvh).measured);
}

TEST(Planner, MeasuresAtLeastOneCandidateWithinATimeLimit) {
    const auto scene = make_scene(make_soup(2000), three_steps(),
                                  [](Scene& s) { s.set_effort(Effort::measure, Rule::smallest_total, 1e-9); });
    EXPECT_TRUE(scene->plan().candidate(scene->plan().chosen).measured);
}

TEST(Planner, ProbesTheGridWithTheCallersRays) {
    // The grid is predicted to be the best; rays that all miss make it better still, and it is kept.
    std::vector<Ray> sample(500);
    for (Ray& ray : sample) ray = {{100, 100, 100}, 0.0, {1, 0, 0}, 1.0};
    const auto scene = make_scene(make_soup(2000), three_steps(), [&](Scene& s) {
        s.set_expected({500, RayKind::random}, sample);
        s.set_effort(Effort::probe, Rule::smallest_total, 0.0);
    });
    EXPECT_TRUE(scene->plan().candidate(G).measured);
    EXPECT_FALSE(scene->plan().candidate(B).measured);
}

TEST(Planner, FollowsHapalasRule) {
    // A tree that costs a second to build and nothing to ask: kept from it by few rays, sent to it by many.
    const auto profile = make_profile([](MachineConstants& constants) {
        constants.hapala.build_ns_per_n_log_n = 1e9 / (2000.0 * std::log2(2000.0));
        constants.hapala.ray_ns_per_log_n = 1e-3;
    });
    const auto chosen = [&](std::uint64_t rays) {
        const auto scene = make_scene(make_soup(2000), profile, [&](Scene& s) {
            s.set_expected({rays, RayKind::random}, {});
            s.set_effort(Effort::estimate, Rule::hapala, 0.0);
        });
        EXPECT_TRUE(scene->plan().hapala.has_value());
        EXPECT_NEAR(scene->plan().hapala->tree_build_ns, 1e9, 1.0);
        return scene->plan().chosen;
    };
    EXPECT_EQ(chosen(10), G);
    EXPECT_EQ(chosen(1'000'000'000'000), K);
}

TEST(Planner, PlansAnEmptyScene) {
    for (const Effort effort : {Effort::estimate, Effort::probe, Effort::measure}) {
        for (const Rule rule : {Rule::smallest_total, Rule::hapala}) {
            Scene scene(three_steps());
            scene.set_effort(effort, rule, 0.0);
            Progress progress;
            scene.commit(Parallel(1), progress);
            EXPECT_TRUE(scene.is_committed());
        }
    }
}

} // namespace
} // namespace raywise
