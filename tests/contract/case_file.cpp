#include "contract/case_file.h"

#include "contract/meshes.h"
#include "contract/numbers.h"
#include "contract/sweeps.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

namespace raywise::contract {
namespace {

constexpr double most_rays = 1e6;
constexpr double largest_index = 4294967294.0;

using Words = std::vector<std::string>;

std::string in_quotes(const std::string& text) { return "\"" + text + "\""; }

std::string one_of(const Words& choices) {
    std::string text;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
        text += choices[i];
    }
    return text;
}

template <class Rows, class Name>
std::string one_of(const Rows& rows, Name name) {
    Words names;
    for (const auto& row : rows) names.emplace_back(name(row));
    return one_of(names);
}

bool is_name(const std::string& text) {
    return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
}

class Parser {
public:
    explicit Parser(const std::string& file) { family_.file = file; }

    Family parse(const std::string& text) {
        std::istringstream lines(text);
        std::string line;
        while (std::getline(lines, line)) {
            ++line_;
            std::istringstream stream(line);
            words_.assign(std::istream_iterator<std::string>(stream), {});
            if (words_.empty() || words_[0][0] == '#') continue;
            const auto start = line.find(words_[0]) + words_[0].size();
            const auto first = line.find_first_not_of(" \t\r", start);
            const auto last = line.find_last_not_of(" \t\r");
            rest_ = first == std::string::npos ? "" : line.substr(first, last - first + 1);
            read_line();
        }
        ++line_;
        finish_case();
        if (family_.name.empty()) fail("expected \"family NAME\" before the end of the file");
        if (family_.cases.empty()) fail("expected at least one case before the end of the file");
        return std::move(family_);
    }

private:
    [[noreturn]] void fail(const std::string& text) const { throw CaseFileError(family_.file, line_, text); }
    [[noreturn]] void fail_at(int line, const std::string& text) const {
        throw CaseFileError(family_.file, line, text);
    }

    // The table of keywords: the only place that knows them.
    struct Keyword {
        const char* word;
        void (Parser::*read)();
        bool inside_case; // makes sense only there
    };
    static const std::vector<Keyword>& keywords() {
        static const std::vector<Keyword> all = {
            {"family", &Parser::read_family, false},
            {"about", &Parser::read_about, false},
            {"precision", &Parser::read_precision, false},
            {"case", &Parser::read_case, false},
            {"source", &Parser::read_source, true},
            {"convention", &Parser::read_convention, true},
            {"geometry", &Parser::read_geometry, true},
            {"v", &Parser::read_vertex, true},
            {"f", &Parser::read_triangle, true},
            {"mesh", &Parser::read_mesh, true},
            {"scale", &Parser::read_change, true},
            {"move", &Parser::read_change, true},
            {"grid", &Parser::read_change, true},
            {"ray", &Parser::read_ray, true},
            {"rays", &Parser::read_rays, true},
            {"expect", &Parser::read_expect, true},
        };
        return all;
    }

    void read_line() {
        const auto& all = keywords();
        const auto found = std::find_if(all.begin(), all.end(), [&](const Keyword& k) { return k.word == words_[0]; });
        if (found == all.end()) {
            fail("expected " + one_of(all, [](const Keyword& k) { return k.word; }) + ", got " + in_quotes(words_[0]));
        }
        if (family_.name.empty() && words_[0] != "family")
            fail("expected \"family NAME\" first, got " + in_quotes(words_[0]));
        if (found->inside_case && !in_case_) fail("expected \"case NAME\" before " + in_quotes(words_[0]));
        (this->*found->read)();
    }

    // ---- words of a line

    std::string text(const std::string& what) const {
        if (rest_.empty()) fail("expected " + what + " after " + in_quotes(words_[0]));
        return rest_;
    }
    std::string name() const {
        if (words_.size() != 2 || !is_name(words_[1])) {
            fail("expected one name of small letters, digits and \"-\" after " + in_quotes(words_[0]) + ", got " +
                 in_quotes(rest_));
        }
        return words_[1];
    }
    double number(std::size_t i, const std::string& what) const {
        if (i >= words_.size()) fail("expected a number for " + what + ", got the end of the line");
        const std::optional<double> value = number_of(words_[i]);
        if (!value) fail("expected a number for " + what + ", got " + in_quotes(words_[i]));
        return *value;
    }
    // One that has to be in the case's precision.
    double coordinate(std::size_t i, const std::string& what, bool float32) const {
        const double value = number(i, what);
        if (float32 && !is_float32(value)) {
            fail("expected a number that float32 holds exactly for " + what + ", got " + in_quotes(words_[i]) +
                 "; the nearest is " + text_of(static_cast<double>(static_cast<float>(value))));
        }
        return value;
    }
    double number_in(std::size_t i, const Parameter& parameter) const {
        const double value = number(i, parameter.name);
        const bool fits =
            value >= parameter.lowest && value <= parameter.highest && (!parameter.whole || value == std::floor(value));
        if (!fits) {
            fail("expected " + std::string(parameter.whole ? "a whole number" : "a number") + " from " +
                 text_of(parameter.lowest) + " to " + text_of(parameter.highest) + " for " + parameter.name + ", got " +
                 in_quotes(words_[i]));
        }
        return value;
    }
    void end_of_line(std::size_t i) const {
        if (i < words_.size()) fail("expected the end of the line, got " + in_quotes(words_[i]));
    }
    std::vector<double> parameters_from(std::size_t first, const std::vector<Parameter>& parameters) const {
        std::vector<double> numbers;
        for (std::size_t i = 0; i < parameters.size(); ++i) numbers.push_back(number_in(first + i, parameters[i]));
        end_of_line(first + parameters.size());
        return numbers;
    }

    // ---- family and case

    void read_family() {
        if (!family_.name.empty()) fail("expected one \"family\" line, this is the second");
        family_.name = name();
    }

    void read_about() {
        std::string& about = in_case_ ? case_.about : family_.about;
        if (!about.empty()) about += " ";
        about += text("a sentence");
    }

    void read_precision() {
        const std::string precision = text("a precision");
        if (precision != "float32" && precision != "float64")
            fail("expected float32 or float64, got " + in_quotes(precision));
        if (!in_case_) {
            default_float32_ = precision == "float32";
            return;
        }
        if (!case_.geometries.empty() || !case_.rays.empty()) fail("expected \"precision\" before meshes and rays");
        case_.float32 = precision == "float32";
    }

    void read_case() {
        finish_case();
        case_ = {};
        case_.name = name();
        case_.line = line_;
        case_.float32 = default_float32_;
        for (const Case& other : family_.cases) {
            if (other.name == case_.name)
                fail("expected a new name, " + case_.name + " is the case of line " + std::to_string(other.line));
        }
        in_case_ = true;
        after_expect_ = true;
        block_ = 0;
    }

    void read_source() {
        case_.source = text("a URL");
        if (words_.size() != 2 || case_.source.rfind("https://", 0) != 0)
            fail("expected a URL that begins with https://, got " + in_quotes(case_.source));
    }

    void read_convention() { case_.convention = text("a sentence"); }

    void finish_case() {
        if (!in_case_) return;
        check_expectations_given();
        if (case_.about.empty()) fail_at(case_.line, "expected an \"about\" line in the case " + case_.name);
        if (case_.rays.empty() && case_.refusal.empty())
            fail_at(case_.line, "expected a ray, or \"expect error\", in the case " + case_.name);
        check_triangles();
        family_.cases.push_back(std::move(case_));
        in_case_ = false;
    }

    // Only where all vertices are written out; generators check themselves.
    void check_triangles() const {
        if (case_.refusal == "index-range") return;
        for (const GeometryLines& geometry : case_.geometries) {
            double vertices = 0;
            bool generated = false;
            for (const MeshStep& step : geometry.steps) {
                if (step.verb == "v") ++vertices;
                if (generator_named(step.verb) != nullptr) generated = true;
            }
            if (generated || geometry.skip_invalid) continue;
            for (const MeshStep& step : geometry.steps) {
                if (step.verb != "f") continue;
                for (const double index : step.numbers) {
                    if (index >= vertices) {
                        fail_at(step.line, "expected a vertex below " + text_of(vertices) +
                                               ", as many as the geometry has, got " + text_of(index));
                    }
                }
            }
        }
    }

    // ---- meshes

    void read_geometry() {
        before_rays();
        GeometryLines geometry;
        geometry.float32 = case_.float32;
        for (std::size_t i = 1; i < words_.size(); ++i) {
            if (words_[i] == "float32") {
                geometry.float32 = true;
            } else if (words_[i] == "float64") {
                if (case_.float32) fail("expected no float64 geometry in a case of precision float32");
            } else if (words_[i] == "skip-invalid") {
                geometry.skip_invalid = true;
            } else {
                fail("expected float32, float64, skip-invalid or the end of the line, got " + in_quotes(words_[i]));
            }
        }
        case_.geometries.push_back(geometry);
    }

    void before_rays() const {
        if (!case_.rays.empty() || !case_.refusal.empty())
            fail("expected meshes before rays and expectations, got " + in_quotes(words_[0]));
    }

    GeometryLines& geometry() {
        before_rays();
        if (case_.geometries.empty()) {
            case_.geometries.emplace_back();
            case_.geometries.back().float32 = case_.float32;
        }
        return case_.geometries.back();
    }

    void read_vertex() {
        GeometryLines& lines = geometry();
        MeshStep step{words_[0], {}, "", line_};
        const char* const names[] = {"x", "y", "z"};
        for (std::size_t i = 0; i < 3; ++i) step.numbers.push_back(coordinate(1 + i, names[i], lines.float32));
        end_of_line(4);
        lines.steps.push_back(std::move(step));
    }

    void read_triangle() {
        const Parameter corner{"a corner", 0, largest_index, true};
        GeometryLines& lines = geometry();
        lines.steps.push_back({words_[0], parameters_from(1, {corner, corner, corner}), "", line_});
    }

    void read_mesh() {
        GeometryLines& lines = geometry();
        const Generator* generator = words_.size() > 1 ? generator_named(words_[1]) : nullptr;
        if (generator == nullptr) {
            fail("expected a mesh (" + one_of(generators(), [](const Generator& g) { return g.name; }) + "), got " +
                 in_quotes(rest_));
        }
        MeshStep step{words_[1], {}, "", line_};
        if (generator->takes_text) {
            if (words_.size() != 3 || words_[2].find('/') != std::string::npos)
                fail("expected one name without a folder after \"mesh " + words_[1] + "\"");
            step.text = words_[2];
        } else {
            step.numbers = parameters_from(2, generator->parameters);
        }
        lines.steps.push_back(std::move(step));
    }

    void read_change() {
        GeometryLines& lines = geometry();
        const Change* change = change_named(words_[0]);
        // One number for all axes, or all of them.
        std::vector<Parameter> parameters = change->parameters;
        if (words_.size() - 1 == change->fewest) parameters.resize(change->fewest);
        lines.steps.push_back({words_[0], parameters_from(1, parameters), "", line_});
    }

    // ---- rays

    // Expectations belong to the ray and rays lines right above them.
    void begin_ray() {
        if (!case_.refusal.empty()) fail("expected no rays in a case that expects an error");
        if (after_expect_) block_ = case_.rays.size();
        after_expect_ = false;
    }

    void read_ray() {
        begin_ray();
        RayLines lines;
        lines.line = line_;
        const char* const names[] = {"origin x",    "origin y",    "origin z", "direction x",
                                     "direction y", "direction z", "tmin",     "tmax"};
        double* const places[] = {&lines.ray.origin.x,    &lines.ray.origin.y,    &lines.ray.origin.z,
                                  &lines.ray.direction.x, &lines.ray.direction.y, &lines.ray.direction.z,
                                  &lines.ray.tmin,        &lines.ray.tmax};
        const std::size_t count = words_.size() > 7 ? 8 : 6;
        for (std::size_t i = 0; i < count; ++i) *places[i] = coordinate(1 + i, names[i], case_.float32);
        end_of_line(1 + count);
        case_.rays.push_back(std::move(lines));
    }

    void read_rays() {
        begin_ray();
        RayLines lines;
        lines.line = line_;
        const SweepKind* kind = words_.size() > 1 ? sweep_kind_named(words_[1]) : nullptr;
        if (kind == nullptr) {
            fail("expected a kind of rays (" + one_of(sweep_kinds(), [](const SweepKind& k) { return k.name; }) +
                 "), got " + in_quotes(words_.size() > 1 ? words_[1] : ""));
        }
        lines.sweep = words_[1];
        if (words_.size() > 2 && words_[2] == "all") {
            if (!kind->can_do_all) fail("expected a number of rays, \"all\" has no meaning for " + lines.sweep);
        } else {
            lines.count = static_cast<std::uint64_t>(number_in(2, {"the number of rays", 1, most_rays, true}));
        }
        lines.seed = static_cast<std::uint64_t>(number_in(3, {"the seed", 0, 4294967295.0, true}));
        lines.numbers = parameters_from(4, kind->parameters);
        case_.rays.push_back(std::move(lines));
    }

    void check_expectations_given() const {
        if (!case_.rays.empty() && case_.rays.back().expectations.empty())
            fail_at(case_.rays.back().line, "expected an \"expect\" line after the ray");
    }

    // ---- expectations

    void read_expect() {
        if (words_.size() > 1 && words_[1] == "error") return read_refusal();
        const auto& kinds = expectation_kinds();
        const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const ExpectationKind& k) {
            return words_.size() > 1 && k.word == words_[1];
        });
        if (kind == kinds.end()) {
            fail("expected error, " + one_of(kinds, [](const ExpectationKind& k) { return k.word; }) + ", got " +
                 in_quotes(words_.size() > 1 ? words_[1] : ""));
        }
        if (case_.rays.empty()) fail("expected a ray before what is expected of it");
        const Expectation expectation = read_expectation(*kind);
        after_expect_ = true;
        for (std::size_t i = block_; i < case_.rays.size(); ++i) {
            RayLines& lines = case_.rays[i];
            if (!kind->for_sweeps && !lines.sweep.empty())
                fail("expected something that can hold for every ray of a sweep, got " + in_quotes(kind->word));
            lines.expectations.push_back(expectation);
        }
    }

    Expectation read_expectation(const ExpectationKind& kind) const {
        using Takes = ExpectationKind::Takes;
        Expectation expectation{kind.kind, {}, {}, line_};
        switch (kind.takes) {
            case Takes::nothing:
                end_of_line(2);
                break;
            case Takes::one_number:
                expectation.numbers.push_back(number(2, kind.word));
                end_of_line(3);
                break;
            case Takes::count:
                expectation.numbers = parameters_from(2, {{"the number", 0, most_rays, true}});
                break;
            case Takes::numbers:
                for (std::size_t i = 2; i == 2 || i < words_.size(); ++i)
                    expectation.numbers.push_back(number(i, kind.word));
                if (!std::is_sorted(expectation.numbers.begin(), expectation.numbers.end()))
                    fail("expected numbers in ascending order, got " + in_quotes(rest_));
                break;
            case Takes::ids:
                for (std::size_t i = 2; i == 2 || i < words_.size(); ++i) expectation.ids.push_back(id(i));
                break;
            case Takes::one_id:
                expectation.ids.push_back(id(2));
                end_of_line(3);
                break;
        }
        return expectation;
    }

    // "7", or "2:7" for triangle 7 of geometry 2.
    PrimitiveId id(std::size_t i) const {
        const std::string word = i < words_.size() ? words_[i] : "";
        const auto colon = word.find(':');
        const auto part = [&](const std::string& digits) {
            if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) {
                fail("expected a triangle as PRIMITIVE or GEOMETRY:PRIMITIVE, got " +
                     (word.empty() ? "the end of the line" : in_quotes(word)));
            }
            return static_cast<std::uint32_t>(std::stoul(digits));
        };
        if (colon == std::string::npos) return {0, part(word)};
        return {part(word.substr(0, colon)), part(word.substr(colon + 1))};
    }

    void read_refusal() {
        const auto& kinds = refusal_kinds();
        if (words_.size() < 3 || std::find(kinds.begin(), kinds.end(), words_[2]) == kinds.end()) {
            fail("expected " + one_of(kinds) + " after \"expect error\", got " +
                 in_quotes(words_.size() > 2 ? words_[2] : ""));
        }
        if (!case_.refusal.empty()) fail("expected one \"expect error\" line, this is the second");
        if (!case_.rays.empty()) fail("expected no rays in a case that expects an error");
        case_.refusal = words_[2];
        for (std::size_t i = 3; i < words_.size(); ++i) case_.mention += (i > 3 ? " " : "") + words_[i];
    }

    Family family_;
    Case case_;
    bool in_case_ = false;
    bool default_float32_ = false;
    bool after_expect_ = true;
    std::size_t block_ = 0; // first of the ray lines that the next expectation belongs to
    int line_ = 0;
    Words words_;
    std::string rest_; // the line after its first word
};

} // namespace

const std::vector<std::string>& refusal_kinds() {
    static const std::vector<std::string> kinds = {"not-finite", "coordinate-range", "index-range"};
    return kinds;
}

Family parse_cases(const std::string& text, const std::string& file) { return Parser(file).parse(text); }

Family read_case_file(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw std::runtime_error(path.string() + ": cannot be opened");
    std::ostringstream text;
    text << stream.rdbuf();
    return parse_cases(text.str(), path.filename().string());
}

std::vector<Family> read_case_folder(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".txt") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<Family> families;
    for (const auto& path : paths) families.push_back(read_case_file(path));
    return families;
}

std::filesystem::path case_folder() {
    return std::filesystem::path(RAYWISE_SOURCE_DIR) / "tests" / "contract" / "cases";
}

} // namespace raywise::contract
