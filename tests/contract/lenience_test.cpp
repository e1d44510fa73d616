// What is allowed to libraries that promise less than exact arithmetic, and what is not.
#include "contract/check_answers.h"
#include "contract/run_cases.h"

#include <gtest/gtest.h>

namespace raywise::contract {
namespace {

// A square of two triangles in the plane z = 0 that share the diagonal from (0, 0) to (4, 4), and a wall that stands on its
// lower side.
const std::vector<Mesh>& square_and_wall() {
    static const std::vector<Mesh> meshes = [] {
        Mesh mesh;
        mesh.vertices = {{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 4.0, 0.0}, {0.0, 4.0, 0.0}, {2.0, 0.0, -4.0}};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}};
        return std::vector<Mesh>{mesh};
    }();
    return meshes;
}

Ray down_at(double x, double y) {
    Ray ray;
    ray.origin = {x, y, 8.0};
    ray.direction = {0.0, 0.0, -1.0};
    return ray;
}

Answer hit(double t, std::uint32_t primitive) {
    Answer answer;
    answer.hit = true;
    answer.t = t;
    answer.primitive = primitive;
    return answer;
}

Capabilities a_peer() {
    Capabilities capabilities;
    capabilities.orders_ties = false;
    capabilities.decides_exactly = false;
    capabilities.counts_crossings = false;
    capabilities.t_tolerance = 1e-5;
    return capabilities;
}

Capabilities exact_and_counting() {
    Capabilities capabilities;
    capabilities.t_tolerance = 1e-5;
    return capabilities;
}

bool meets(Expectation expectation, const Ray& ray, const std::vector<Answer>& all, const Capabilities& capabilities) {
    Answers answers;
    if (!all.empty()) answers.closest = all.front();
    answers.all = all;
    std::string why;
    return check(expectation, ray, answers, ExactScene(square_and_wall()), capabilities, why) == Verdict::met;
}

Expectation expected(Expected kind) {
    Expectation expectation;
    expectation.kind = kind;
    return expectation;
}

Expectation count(double number) {
    Expectation expectation = expected(Expected::count);
    expectation.numbers = {number};
    return expectation;
}

TEST(Lenience, BothTrianglesOfAnEdgeAreAListButNoCountOfCrossings) {
    const Ray on_the_diagonal = down_at(1.0, 1.0);
    const std::vector<Answer> both = {hit(8.0, 0), hit(8.0, 1)};
    for (const Expectation& expectation : {count(1), expected(Expected::odd), expected(Expected::exact)}) {
        EXPECT_TRUE(meets(expectation, on_the_diagonal, both, a_peer())) << text_of(expectation);
        EXPECT_FALSE(meets(expectation, on_the_diagonal, both, exact_and_counting())) << text_of(expectation);
    }
    EXPECT_TRUE(meets(count(1), on_the_diagonal, {hit(8.0, 1)}, a_peer()));
    EXPECT_TRUE(meets(count(1), on_the_diagonal, {hit(8.0, 1)}, exact_and_counting()));
}

TEST(Lenience, AListMayNeitherLeaveOutNorRepeatNorInvent) {
    const Ray inside = down_at(3.0, 1.0);
    EXPECT_TRUE(meets(count(1), inside, {hit(8.0, 0)}, a_peer()));
    EXPECT_FALSE(meets(count(1), inside, {}, a_peer()));
    EXPECT_FALSE(meets(count(1), inside, {hit(8.0, 0), hit(8.0, 0)}, a_peer()));
    EXPECT_FALSE(meets(count(1), inside, {hit(8.0, 0), hit(8.0, 1)}, a_peer()));
    EXPECT_FALSE(meets(count(1), inside, {hit(8.0, 0), hit(9.0, 1)}, a_peer()));
}

TEST(Lenience, ATriangleMetEdgeOnMayBeInTheList) {
    const Ray above_the_wall = down_at(2.0, 0.0);
    EXPECT_TRUE(meets(count(1), above_the_wall, {hit(8.0, 0)}, a_peer()));
    EXPECT_TRUE(meets(count(1), above_the_wall, {hit(8.0, 0), hit(8.0, 2)}, a_peer()));
    EXPECT_FALSE(meets(count(1), above_the_wall, {hit(7.0, 2), hit(8.0, 0)}, a_peer())) << "it is not there";
    EXPECT_FALSE(meets(count(1), above_the_wall, {hit(8.0, 0), hit(8.0, 2)}, exact_and_counting()));
    EXPECT_FALSE(meets(count(1), down_at(2.0, 1.0), {hit(8.0, 0), hit(8.0, 2)}, a_peer())) << "not in its plane";
}

TEST(Lenience, TheTriangleNextToTheEdgeIsNamedWithinTheTolerance) {
    const Ray just_beside = down_at(1.00001, 1.0);
    const Ray far_beside = down_at(1.01, 1.0);
    EXPECT_TRUE(meets(expected(Expected::exact), just_beside, {hit(8.0, 1)}, a_peer()));
    EXPECT_FALSE(meets(expected(Expected::exact), just_beside, {hit(8.0, 1)}, exact_and_counting()));
    EXPECT_FALSE(meets(expected(Expected::exact), far_beside, {hit(8.0, 1)}, a_peer()));

    Expectation first = expected(Expected::primitive);
    first.ids = {{0, 0}};
    EXPECT_TRUE(meets(first, just_beside, {hit(8.0, 1)}, a_peer()));
    EXPECT_FALSE(meets(first, just_beside, {hit(8.0, 1)}, exact_and_counting()));
    EXPECT_FALSE(meets(first, far_beside, {hit(8.0, 1)}, a_peer()));
}

TEST(Lenience, HitOrMissIsExactForAll) {
    const Ray outside = down_at(4.000001, 1.0);
    EXPECT_FALSE(meets(expected(Expected::exact), outside, {hit(8.0, 0)}, a_peer()));
    EXPECT_FALSE(meets(expected(Expected::miss), outside, {hit(8.0, 0)}, a_peer()));
    EXPECT_TRUE(meets(expected(Expected::miss), outside, {}, a_peer()));
}

// A library that finds every ray inexpressible, or only its any-hit, or its meshes.
class Speechless : public Library {
public:
    enum class About {
        nothing,
        closest,
        any,
        meshes
    };
    explicit Speechless(About about) : about_(about) {}
    std::string name() const override { return "speechless"; }
    Capabilities capabilities() const override { return a_peer(); }
    std::unique_ptr<Scene> build(const std::vector<Mesh>&) override {
        if (about_ == About::meshes) throw Inexpressible("no words for meshes");
        return std::make_unique<SpeechlessScene>(about_);
    }

private:
    class SpeechlessScene : public Scene {
    public:
        explicit SpeechlessScene(About about) : about_(about) {}
        Answer closest(const Ray& ray) override {
            if (about_ == About::closest && ray.tmin > 0.0) throw Inexpressible("no words for tmin");
            return {};
        }
        bool any(const Ray&) override {
            if (about_ == About::any) throw Inexpressible("no words for any");
            return true; // which contradicts a miss
        }
        void all(const Ray&, std::vector<Answer>& answers) override { answers.clear(); }
        void closest_batch(const std::vector<Ray>&, std::vector<Answer>&) override {}

    private:
        About about_;
    };
    About about_;
};

CaseResult result_of(Speechless::About about, const std::string& rays) {
    Speechless library(about);
    const Family family = parse_cases("family f\nabout f\ncase c\nabout c\nv 0 0 0\n" + rays, "f.txt");
    return run_cases(library, {family}).cases.at(0);
}

TEST(Inexpressible, WhatCannotBeAskedIsSkipped) {
    const CaseResult only = result_of(Speechless::About::closest, "ray 0 0 1 0 0 1 0.5 inf\nexpect miss\n");
    EXPECT_EQ(only.outcome, Outcome::skipped);
    EXPECT_EQ(only.reason, "no words for tmin");
    const CaseResult meshes = result_of(Speechless::About::meshes, "ray 0 0 1 0 0 1\nexpect miss\n");
    EXPECT_EQ(meshes.outcome, Outcome::skipped);
    EXPECT_EQ(meshes.reason, "no words for meshes");
}

TEST(Inexpressible, TheRestOfTheCaseCounts) {
    const std::string both = "ray 0 0 1 0 0 1 0.5 inf\nexpect miss\nray 0 0 1 0 0 1\nexpect miss\n";
    EXPECT_EQ(result_of(Speechless::About::closest, both).outcome, Outcome::failed);
    EXPECT_EQ(result_of(Speechless::About::any, both).outcome, Outcome::passed);
    EXPECT_EQ(result_of(Speechless::About::nothing, both).outcome, Outcome::failed);
}

TEST(SmokeRun, TakesFewerRaysOfSweepsAndAllOthers) {
    Speechless library(Speechless::About::any);
    const Family family = parse_cases(
        "family f\nabout f\ncase c\nabout c\nmesh box 2 2 2\n"
        "rays random 50 1\nexpect exact\nray 5 5 5 1 0 0\nexpect miss\n",
        "f.txt");
    RunOptions options;
    options.most_sweep_rays = 7;
    EXPECT_EQ(run_cases(library, {family}, options).cases.at(0).rays, 8u);
    EXPECT_EQ(run_cases(library, {family}).cases.at(0).rays, 51u);
}

} // namespace
} // namespace raywise::contract
