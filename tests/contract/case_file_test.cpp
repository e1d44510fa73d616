#include "contract/case_file.h"

#include "contract/meshes.h"
#include "contract/numbers.h"
#include "contract/sweeps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace raywise::contract {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const char* const start = "family some-family\ncase one\nabout It.\n"; // three lines

std::string error_of(const std::string& text) {
    try {
        parse_cases(text, "file.txt");
    } catch (const CaseFileError& error) {
        return error.what();
    }
    return "no error";
}

TEST(CaseFile, ReadsEverything) {
    const Family family = parse_cases(
        "# A comment.\n"
        "family some-family\n"
        "about First,\n"
        "about second.\n"
        "precision float32\n"
        "\n"
        "case first\n"
        "about What it is.\n"
        "source https://example.org/1\n"
        "convention A rule.\n"
        "v 0 -0x1.8p-3 1e3\n"
        "v 0 1 0\n"
        "v 1 0 0\n"
        "  f 0 1 2   \r\n"
        "mesh box 1 2 3\n"
        "scale 2\n"
        "scale 1 2 4\n"
        "move 0 0 1\n"
        "grid 0.5\n"
        "geometry skip-invalid\n"
        "mesh icosphere 1\n"
        "ray 1 2 3 4 5 6\n"
        "ray 1 2 3 nan 5 6 -inf inf\n"
        "expect hit\n"
        "expect t 0.1\n"
        "expect primitive 3 1:4\n"
        "rays cone 10 7 0 0 0 0 0 1 0.5\n"
        "rays vertices-from-point all 0 1 2 3\n"
        "expect count 2\n"
        "case second\n"
        "about Refused.\n"
        "precision float64\n"
        "geometry float32\n"
        "v nan 0 0\n"
        "expect error not-finite vertex 0: x\n",
        "file.txt");
    EXPECT_EQ(family.name, "some-family");
    EXPECT_EQ(family.about, "First, second.");
    ASSERT_EQ(family.cases.size(), 2u);

    const Case& first = family.cases[0];
    EXPECT_EQ(first.name, "first");
    EXPECT_EQ(first.about, "What it is.");
    EXPECT_EQ(first.source, "https://example.org/1");
    EXPECT_EQ(first.convention, "A rule.");
    EXPECT_TRUE(first.float32);
    ASSERT_EQ(first.geometries.size(), 2u);
    EXPECT_TRUE(first.geometries[0].float32);
    EXPECT_FALSE(first.geometries[0].skip_invalid);
    EXPECT_TRUE(first.geometries[1].float32 && first.geometries[1].skip_invalid);
    const std::vector<MeshStep>& steps = first.geometries[0].steps;
    ASSERT_EQ(steps.size(), 9u);
    EXPECT_EQ(steps[0].numbers, (std::vector<double>{0, -0.1875, 1000}));
    EXPECT_EQ(steps[3].verb, "f");
    EXPECT_EQ(steps[3].numbers, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(steps[4].verb, "box");
    EXPECT_EQ(steps[6].numbers, (std::vector<double>{1, 2, 4}));

    ASSERT_EQ(first.rays.size(), 4u);
    EXPECT_EQ(first.rays[0].ray.origin, Vec3(1, 2, 3));
    EXPECT_EQ(first.rays[0].ray.direction, Vec3(4, 5, 6));
    EXPECT_EQ(first.rays[0].ray.tmin, 0.0);
    EXPECT_EQ(first.rays[0].ray.tmax, infinity);
    EXPECT_TRUE(std::isnan(first.rays[1].ray.direction.x));
    EXPECT_EQ(first.rays[1].ray.tmin, -infinity);
    // Expectations belong to all ray lines right above them.
    for (const std::size_t i : {0u, 1u}) {
        ASSERT_EQ(first.rays[i].expectations.size(), 3u);
        EXPECT_EQ(text_of(first.rays[i].expectations[0]), "hit");
        EXPECT_EQ(text_of(first.rays[i].expectations[1]), "t 0.1");
        EXPECT_EQ(text_of(first.rays[i].expectations[2]), "primitive 3 1:4");
    }
    EXPECT_EQ(first.rays[2].sweep, "cone");
    EXPECT_EQ(first.rays[2].count, 10u);
    EXPECT_EQ(first.rays[2].seed, 7u);
    EXPECT_EQ(first.rays[2].numbers, (std::vector<double>{0, 0, 0, 0, 0, 1, 0.5}));
    EXPECT_EQ(first.rays[3].count, 0u);
    EXPECT_EQ(text_of(first.rays[3].expectations.at(0)), "count 2");

    const Case& second = family.cases[1];
    EXPECT_FALSE(second.float32);
    EXPECT_TRUE(second.geometries.at(0).float32);
    EXPECT_EQ(second.refusal, "not-finite");
    EXPECT_EQ(second.mention, "vertex 0: x");
}

struct Bad {
    std::string text;
    const char* error;
};

class BadCaseFile : public testing::TestWithParam<Bad> {};

TEST_P(BadCaseFile, IsRefusedByFileLineAndWhatWasExpected) { EXPECT_EQ(error_of(GetParam().text), GetParam().error); }

INSTANTIATE_TEST_SUITE_P(
    All, BadCaseFile,
    testing::Values(
        Bad{"", "file.txt:1: expected \"family NAME\" before the end of the file"},
        Bad{"family a\n", "file.txt:2: expected at least one case before the end of the file"},
        Bad{"case a\n", "file.txt:1: expected \"family NAME\" first, got \"case\""},
        Bad{"family a\nfamily b\n", "file.txt:2: expected one \"family\" line, this is the second"},
        Bad{"family A b\n",
            "file.txt:1: expected one name of small letters, digits and \"-\" after \"family\", got \"A b\""},
        Bad{"family a\n\nray 1 2 3 4 5 6\n", "file.txt:3: expected \"case NAME\" before \"ray\""},
        Bad{"family a\nabout\n", "file.txt:2: expected a sentence after \"about\""},
        Bad{"family a\nprecision half\n", "file.txt:2: expected float32 or float64, got \"half\""},
        Bad{"family a\nwhat is this\n",
            "file.txt:2: expected family, about, precision, case, source, convention, geometry, v, f, mesh, scale, "
            "move, grid, ray, rays or expect, got \"what\""},
        Bad{"family a\ncase b\nray 0 0 0 0 0 1\nexpect miss\n", "file.txt:2: expected an \"about\" line in the case b"},
        Bad{std::string(start) + "case one\nabout B.\n",
            "file.txt:2: expected a ray, or \"expect error\", in the case one"},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect miss\ncase one\n",
            "file.txt:6: expected a new name, one is the case of line 2"},
        Bad{std::string(start) + "source ftp://x\n",
            "file.txt:4: expected a URL that begins with https://, got \"ftp://x\""},
        Bad{std::string(start) + "v 1 2\n", "file.txt:4: expected a number for z, got the end of the line"},
        Bad{std::string(start) + "v 1 2 3 4\n", "file.txt:4: expected the end of the line, got \"4\""},
        Bad{std::string(start) + "v 1 2 abc\n", "file.txt:4: expected a number for z, got \"abc\""},
        Bad{std::string(start) + "v 1 2 1e999\n", "file.txt:4: expected a number for z, got \"1e999\""},
        Bad{std::string(start) + "v 1 2 1e-999\n", "file.txt:4: expected a number for z, got \"1e-999\""},
        Bad{std::string(start) + "v 1 2 3x\n", "file.txt:4: expected a number for z, got \"3x\""},
        Bad{std::string(start) + "precision float32\nv 1 0.1 2\n",
            "file.txt:5: expected a number that float32 holds exactly for y, got \"0.1\"; the nearest is "
            "0.10000000149011612"},
        Bad{std::string(start) + "precision float32\nray 0 0 0 0 0 1e39\n",
            "file.txt:5: expected a number that float32 holds exactly for direction z, got \"1e39\"; the nearest is "
            "inf"},
        Bad{std::string(start) + "precision float32\ngeometry float64\n",
            "file.txt:5: expected no float64 geometry in a case of precision float32"},
        Bad{std::string(start) + "v 0 0 0\nprecision float32\n",
            "file.txt:5: expected \"precision\" before meshes and rays"},
        Bad{std::string(start) + "geometry big\n",
            "file.txt:4: expected float32, float64, skip-invalid or the end of the line, got \"big\""},
        Bad{std::string(start) + "f 0 1\n", "file.txt:4: expected a number for a corner, got the end of the line"},
        Bad{std::string(start) + "f 0 1 1.5\n",
            "file.txt:4: expected a whole number from 0 to 4294967294 for a corner, got \"1.5\""},
        Bad{std::string(start) + "v 0 0 0\nf 0 0 1\nray 0 0 0 0 0 1\nexpect miss\n",
            "file.txt:5: expected a vertex below 1, as many as the geometry has, got 1"},
        Bad{std::string(start) + "mesh sphere 3\n",
            "file.txt:4: expected a mesh (box, grid-box, tetrahedron, icosphere, uv-sphere, cylinder, torus, terrain, "
            "flat, stack, soup, slivers, strips, duplicates, degenerates or file), got \"sphere 3\""},
        Bad{std::string(start) + "mesh box 1 2\n", "file.txt:4: expected a number for z, got the end of the line"},
        Bad{std::string(start) + "mesh icosphere 8\n",
            "file.txt:4: expected a whole number from 0 to 7 for subdivisions, got \"8\""},
        Bad{std::string(start) + "mesh file a/b.obj\n",
            "file.txt:4: expected one name without a folder after \"mesh file\""},
        Bad{std::string(start) + "scale 1 2\n", "file.txt:4: expected a number for z, got the end of the line"},
        Bad{std::string(start) + "grid 0\n",
            "file.txt:4: expected a number from 5e-324 to 1.7976931348623157e+308 for step, got \"0\""},
        Bad{std::string(start) + "ray 0 0 0 0 0\n",
            "file.txt:4: expected a number for direction z, got the end of the line"},
        Bad{std::string(start) + "ray 0 0 0 0 0 1 2\n",
            "file.txt:4: expected a number for tmax, got the end of the line"},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nv 0 0 0\n",
            "file.txt:5: expected meshes before rays and expectations, got \"v\""},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\n", "file.txt:4: expected an \"expect\" line after the ray"},
        Bad{std::string(start) + "rays sideways 1 1\n",
            "file.txt:4: expected a kind of rays (vertices-from-point, edges-from-point, near-edges-from-point, "
            "vertices-from-outside, edges-from-outside, along-edges, in-plane, axis-grid, on-surface, leaving, "
            "back-to-vertices, random, from-ball, points-in-ball, points-beyond-ball, cone or from-afar), got "
            "\"sideways\""},
        Bad{std::string(start) + "rays random all 1\n",
            "file.txt:4: expected a number of rays, \"all\" has no meaning for random"},
        Bad{std::string(start) + "rays random 0 1\n",
            "file.txt:4: expected a whole number from 1 to 1000000 for the number of rays, got \"0\""},
        Bad{std::string(start) + "rays axis-grid 3 1 3\n",
            "file.txt:4: expected a whole number from 0 to 2 for axis, got \"3\""},
        Bad{std::string(start) + "expect hit\n", "file.txt:4: expected a ray before what is expected of it"},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect maybe\n",
            "file.txt:5: expected error, hit, miss, t, primitive, lowest, count, even, odd, inside, outside, all-t, "
            "exact, plane, same-as-batch or repeatable, got \"maybe\""},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect hit 1\n",
            "file.txt:5: expected the end of the line, got \"1\""},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect t\n",
            "file.txt:5: expected a number for t, got the end of the line"},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect count 1.5\n",
            "file.txt:5: expected a whole number from 0 to 1000000 for the number, got \"1.5\""},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect all-t 2 1\n",
            "file.txt:5: expected numbers in ascending order, got \"all-t 2 1\""},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect primitive\n",
            "file.txt:5: expected a triangle as PRIMITIVE or GEOMETRY:PRIMITIVE, got the end of the line"},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect primitive 1:\n",
            "file.txt:5: expected a triangle as PRIMITIVE or GEOMETRY:PRIMITIVE, got \"1:\""},
        Bad{std::string(start) + "rays random 5 1\nexpect all-t 1\n",
            "file.txt:5: expected something that can hold for every ray of a sweep, got \"all-t\""},
        Bad{std::string(start) + "expect error sad\n",
            "file.txt:4: expected not-finite, coordinate-range or index-range after \"expect error\", got \"sad\""},
        Bad{std::string(start) + "expect error not-finite\nray 0 0 0 0 0 1\n",
            "file.txt:5: expected no rays in a case that expects an error"},
        Bad{std::string(start) + "ray 0 0 0 0 0 1\nexpect error not-finite\n",
            "file.txt:5: expected no rays in a case that expects an error"},
        Bad{std::string(start) + "expect error not-finite\nexpect error not-finite\n",
            "file.txt:5: expected one \"expect error\" line, this is the second"}));

TEST(CaseFile, ReadsNumbersOfAllKinds) {
    EXPECT_EQ(number_of("1.5"), 1.5);
    EXPECT_EQ(number_of("-.5"), -0.5);
    EXPECT_EQ(number_of("+2e3"), 2000.0);
    EXPECT_EQ(number_of("-0x1.8p1"), -3.0);
    EXPECT_EQ(number_of("0x1p-1074"), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(number_of("inf"), infinity);
    EXPECT_EQ(number_of("-inf"), -infinity);
    EXPECT_TRUE(std::isnan(number_of("nan").value()));
    EXPECT_TRUE(std::signbit(number_of("-0.0").value()));
    EXPECT_EQ(number_of("0"), 0.0);
    for (const char* text : {"", "-", "--1", "1 ", " 1", "infinity", "nan(1)", "NAN", "1e400", "1e-400", "1,5", "0x"})
        EXPECT_FALSE(number_of(text).has_value()) << text;
    for (const double x : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.0, 1e22})
        EXPECT_EQ(number_of(text_of(x)), x);
    EXPECT_TRUE(is_float32(0x1p-149) && is_float32(infinity) && is_float32(-0.25));
    EXPECT_FALSE(is_float32(0.1) || is_float32(0x1p-150) || is_float32(1e39));
}

// Nothing in the tables that no case would notice breaking.
TEST(CaseFolder, UsesAllOfTheFormat) {
    std::set<std::string> used;
    for (const Family& family : read_case_folder(case_folder())) {
        EXPECT_EQ(family.name + ".txt", family.file);
        EXPECT_FALSE(family.about.empty()) << family.name;
        EXPECT_GE(family.cases.size(), 3u) << family.name;
        for (const Case& source : family.cases) {
            for (const GeometryLines& geometry : source.geometries) {
                for (const MeshStep& step : geometry.steps) used.insert(step.verb);
            }
            for (const RayLines& lines : source.rays) {
                used.insert(lines.sweep);
                for (const Expectation& expectation : lines.expectations) used.insert(describe(expectation.kind).word);
            }
            used.insert(source.refusal);
        }
    }
    for (const Generator& generator : generators()) EXPECT_EQ(used.count(generator.name), 1u) << generator.name;
    for (const Change& change : changes()) EXPECT_EQ(used.count(change.name), 1u) << change.name;
    for (const SweepKind& kind : sweep_kinds()) EXPECT_EQ(used.count(kind.name), 1u) << kind.name;
    for (const ExpectationKind& kind : expectation_kinds()) EXPECT_EQ(used.count(kind.word), 1u) << kind.word;
    for (const std::string& kind : refusal_kinds()) EXPECT_EQ(used.count(kind), 1u) << kind;
}

// Each of the nineteen issues that trimesh's own tests are named after.
TEST(CaseFolder, HasEveryTrimeshIssue) {
    std::set<std::string> sources;
    for (const Family& family : read_case_folder(case_folder())) {
        for (const Case& source : family.cases) sources.insert(source.source);
    }
    for (const int issue :
         {2504, 2324, 1496, 2317, 1362, 1898, 306, 93, 181, 242, 545, 48, 331, 72, 457, 1919, 1180, 1786, 2462}) {
        const std::string url = "https://github.com/mikedh/trimesh/issues/" + std::to_string(issue);
        EXPECT_EQ(sources.count(url), 1u) << url;
    }
}

TEST(CaseFolder, SaysWhichFileCannotBeOpened) {
    try {
        read_case_file("/nowhere/at-all.txt");
        FAIL() << "opened";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "/nowhere/at-all.txt: cannot be opened");
    }
}

} // namespace
} // namespace raywise::contract
