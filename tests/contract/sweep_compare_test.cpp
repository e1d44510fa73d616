// The sweep has to see what is wrong: every test here puts a wrong answer before it.
#include "contract/sweep_compare.h"

#include "contract/sweep_agreement.h"
#include "contract/sweep_layout.h"
#include "contract/sweep_rays.h"
#include "contract/sweep_watertight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace raywise::sweep {
namespace {

struct Sample {
    SweepScene scene = with_views("test", oracle::soup(60, 3));
    Subject reference = reference_of(scene);
    std::vector<rw_ray> rays;
    std::vector<rw_hit> closest;
    std::vector<std::uint8_t> any;
    AllHits all;
    std::size_t hit = 0;     // a ray that hits something
    std::size_t crosses = 0; // one with at least two hits

    Sample() {
        Random random{1};
        RayMaker maker(scene, random);
        for (int i = 0; i < 500; ++i) rays.push_back(rounded_to_float32(maker.ordinary_or_hard()));
        ask_closest(reference, rays, Manner{}, closest);
        ask_any(reference, rays, Manner{}, any);
        ask_all(reference, rays, Manner{}, all);
        while (!is_hit(closest[hit])) ++hit;
        while (all.offsets[crosses + 1] - all.offsets[crosses] < 2) ++crosses;
    }
};

Subject subject_of(const oracle::Scene& mesh, const char* structure) {
    const LaidOutMesh laid_out(mesh, MeshLayout{});
    return {structure, committed_scene(laid_out.triangles(), structure)};
}

TEST(Compare, FindsNothingInTheSameAnswers) {
    const Sample sample;
    EXPECT_TRUE(compare_closest(sample.closest, sample.closest).empty());
    EXPECT_TRUE(compare_any(sample.closest, sample.any).empty());
    EXPECT_TRUE(compare_all(sample.all, sample.all).empty());
    const std::vector<Difference> first = compare_first(sample.closest, sample.all);
    EXPECT_TRUE(first.empty()) << first.front().text << "\n" << text_of(sample.rays[first.front().ray]);
}

TEST(Compare, FindsOneBitInAnyMemberOfAClosestHit) {
    const Sample sample;
    const std::function<void(rw_hit&)> doctors[] = {
        [](rw_hit& hit) { hit.t = std::nextafter(hit.t, HUGE_VAL); },
        [](rw_hit& hit) { hit.u = std::nextafter(hit.u, 1.0); },
        [](rw_hit& hit) { hit.v = std::nextafter(hit.v, 1.0); },
        [](rw_hit& hit) { hit.instance = 0; },
        [](rw_hit& hit) { ++hit.geometry; },
        [](rw_hit& hit) { ++hit.primitive; },
    };
    for (const auto& doctor : doctors) {
        std::vector<rw_hit> answers = sample.closest;
        doctor(answers[sample.hit]);
        const std::vector<Difference> differences = compare_closest(sample.closest, answers);
        ASSERT_EQ(differences.size(), 1u);
        EXPECT_EQ(differences[0].ray, sample.hit);
        EXPECT_NE(differences[0].text.find("primitive"), std::string::npos);
    }
}

TEST(Compare, FindsWrongAnyHits) {
    const Sample sample;
    for (const std::uint8_t wrong : {std::uint8_t{0}, std::uint8_t{7}}) {
        std::vector<std::uint8_t> answers = sample.any;
        answers[sample.hit] = wrong;
        EXPECT_EQ(compare_any(sample.closest, answers).size(), 1u);
    }
}

TEST(Compare, FindsLostRepeatedAndChangedHitsAmongAll) {
    const Sample sample;
    const auto first = static_cast<std::ptrdiff_t>(sample.all.offsets[sample.crosses]);
    AllHits lost = sample.all;
    lost.hits.erase(lost.hits.begin() + first);
    for (std::size_t i = sample.crosses + 1; i < lost.offsets.size(); ++i) --lost.offsets[i];
    EXPECT_EQ(compare_all(sample.all, lost).size(), 1u);

    AllHits swapped = sample.all;
    std::swap(swapped.hits[static_cast<std::size_t>(first)], swapped.hits[static_cast<std::size_t>(first) + 1]);
    ASSERT_EQ(compare_all(sample.all, swapped).size(), 1u);
    EXPECT_EQ(compare_all(sample.all, swapped)[0].ray, sample.crosses);
    EXPECT_EQ(compare_first(sample.closest, swapped).size(), 1u);
    EXPECT_EQ(compare_first(sample.closest, lost).size(), 1u);
}

TEST(Compare, TellsARayWithEveryBit) {
    const std::string text = text_of(ray_of(Vec3(0.1, -0.0, 1.0), Vec3(0x1p-1074, 1.0, 0.0)));
    EXPECT_NE(text.find("0x1.999999999999ap-4"), std::string::npos) << text;
    EXPECT_NE(text.find("-0x0p+0"), std::string::npos) << text;
    EXPECT_NE(text.find("0x0.0000000000001p-1022"), std::string::npos) << text;
}

TEST(Manners, NoneChangesAnAnswer) {
    const Sample sample;
    for (const auto call : {Manner::Call::batch, Manner::Call::host_batch, Manner::Call::single}) {
        for (const auto order : {Manner::Order::as_made, Manner::Order::reversed, Manner::Order::shuffled}) {
            for (const auto layout : {Manner::Layout::records, Manner::Layout::arrays, Manner::Layout::float32}) {
                const Manner manner{call, order, layout, 2, 5};
                std::vector<rw_hit> closest;
                std::vector<std::uint8_t> any;
                AllHits all;
                ask_closest(sample.reference, sample.rays, manner, closest);
                ask_any(sample.reference, sample.rays, manner, any);
                ask_all(sample.reference, sample.rays, manner, all);
                EXPECT_TRUE(compare_closest(sample.closest, closest).empty()) << manner.text();
                EXPECT_TRUE(compare_any(sample.closest, any).empty()) << manner.text();
                EXPECT_TRUE(compare_all(sample.all, all).empty()) << manner.text();
                EXPECT_EQ(all.offsets, sample.all.offsets);
            }
        }
    }
}

TEST(Layouts, NoneChangesAnAnswer) {
    const Sample sample;
    ASSERT_TRUE(sample.scene.float32);
    for (int bits = 0; bits < 16; ++bits) {
        const MeshLayout layout{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
        const LaidOutMesh mesh(sample.scene.mesh, layout);
        const Subject subject("kd_tree", committed_scene(mesh.triangles(), "kd_tree"));
        std::vector<rw_hit> closest;
        ask_closest(subject, sample.rays, Manner{}, closest);
        EXPECT_TRUE(compare_closest(sample.closest, closest).empty()) << bits;
    }
}

TEST(AgreementBlock, SeesAVertexMovedByOneUnitInTheLastPlace) {
    const Sample sample;
    std::vector<Subject> subjects;
    subjects.push_back(subject_of(sample.scene.mesh, "kd_tree"));
    const AgreementCount right = agreement_block(sample.scene, sample.reference, subjects, 1, 0);
    EXPECT_EQ(right.disagreements, 0u);
    EXPECT_EQ(right.comparisons, right.rays);
    EXPECT_GT(right.hits, right.rays / 4);
    EXPECT_GT(right.judge_rays, 0u);
    EXPECT_EQ(right.judge_disagreements, 0u);

    oracle::Scene moved = sample.scene.mesh;
    Vec3& vertex = moved.vertices[moved.triangles[sample.closest[sample.hit].primitive][0]];
    vertex.x = std::nextafter(vertex.x, 10.0);
    subjects.clear();
    subjects.push_back(subject_of(moved, "kd_tree"));
    const AgreementCount wrong = agreement_block(sample.scene, sample.reference, subjects, 1, 0);
    EXPECT_GT(wrong.disagreements, 0u);
    EXPECT_LT(wrong.disagreements, wrong.comparisons / 2);
    ASSERT_FALSE(wrong.faults.empty());
    for (const char* part : {"soup 60", "seed 1, block 0", "kd_tree", "ray origin {", "wanted", "answer"})
        EXPECT_NE(wrong.faults[0].find(part), std::string::npos) << wrong.faults[0];
}

TEST(AgreementScene, AsksEveryStructureAndView) {
    const SweepScene scene = with_views("test", oracle::icosphere(1));
    const Subject reference = reference_of(scene);
    const std::vector<Subject> subjects = subjects_of(scene, reference, 3);
    for (const std::string& name : structure_names()) {
        EXPECT_TRUE(std::any_of(subjects.begin(), subjects.end(), [&](const Subject& s) { return s.name() == name; }))
            << name;
    }
    std::size_t views = 0;
    for (const Subject& subject : subjects) views += subject.name().find("view") == 0 ? 1 : 0;
    EXPECT_GE(views, 4u);
}

TEST(AgreementScene, GivesTheSameBlockTwice) {
    AgreementScene scene(with_views("test", oracle::cube()), 0, 5);
    const AgreementCount once = scene.run(3);
    const AgreementCount again = scene.run(3);
    const AgreementCount other = scene.run(4);
    EXPECT_EQ(once.hits, again.hits);
    EXPECT_NE(once.hits, other.hits);
    EXPECT_EQ(once.comparisons, again.comparisons);
    EXPECT_EQ(once.disagreements, 0u);
}

TEST(WatertightBlock, SeesAMissingTriangleAndAnExtraOne) {
    const ClosedScene scene = closed_scene(oracle::icosphere(1));
    const WatertightCount tight = watertight_block(scene, subject_of(scene.mesh, "bvh"), 1, 0);
    EXPECT_EQ(tight.leaks, 0u) << tight.faults[0];
    EXPECT_EQ(tight.parity_errors, 0u) << tight.faults[0];
    EXPECT_GT(tight.rays, 1000u);
    EXPECT_GT(tight.parity_rays, 100u);

    oracle::Scene holed = scene.mesh;
    holed.triangles.pop_back();
    const WatertightCount leaky = watertight_block(scene, subject_of(holed, "bvh"), 1, 0);
    EXPECT_GT(leaky.leaks, 0u);
    EXPECT_LT(leaky.leaks, leaky.rays / 10);
    EXPECT_GT(leaky.parity_errors, 0u);
    ASSERT_FALSE(leaky.faults.empty());
    EXPECT_NE(leaky.faults[0].find("leak"), std::string::npos);

    // A wall inside: nothing leaks, but there is one crossing too many.
    oracle::Scene walled = scene.mesh;
    walled.triangles.push_back({walled.triangles[0][0], walled.triangles[30][1], walled.triangles[60][2]});
    const WatertightCount wall = watertight_block(scene, subject_of(walled, "bvh"), 1, 0);
    EXPECT_EQ(wall.leaks, 0u);
    EXPECT_GT(wall.parity_errors, 0u);
}

TEST(Crossings, AreJudgedByWhereTheRayStarts) {
    EXPECT_TRUE(crossings_are_right(1, true, true, true));
    EXPECT_FALSE(crossings_are_right(3, true, true, true));
    EXPECT_TRUE(crossings_are_right(3, true, true, false));
    EXPECT_FALSE(crossings_are_right(2, true, true, false));
    EXPECT_TRUE(crossings_are_right(2, true, false, false));
    EXPECT_TRUE(crossings_are_right(0, false, true, true));
    EXPECT_TRUE(crossings_are_right(4, false, true, false));
    EXPECT_FALSE(crossings_are_right(4, false, true, true));
    EXPECT_FALSE(crossings_are_right(1, false, true, false));
}

} // namespace
} // namespace raywise::sweep
