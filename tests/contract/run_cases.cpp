#include "contract/run_cases.h"

#include "contract/check_answers.h"
#include "contract/exact_hits.h"
#include "contract/expand.h"
#include "contract/meshes.h"

#include <algorithm>
#include <exception>
#include <memory>

namespace raywise::contract {
namespace {

// Keeps so many rays of a sweep, at even distances.
void thin(RayGroup& group, std::uint64_t most) {
    const std::uint64_t count = group.rays.size();
    if (most == 0 || count <= most || group.lines->sweep.empty()) return;
    for (std::uint64_t i = 0; i < most; ++i) group.rays[i] = group.rays[i * count / most];
    group.rays.resize(most);
}

class CaseRun {
public:
    CaseRun(Library& library, const Family& family, const Case& source)
        : library_(library), capabilities_(library.capabilities()), file_(family.file), case_(source) {
        result_.family = family.name;
        result_.name = source.name;
        result_.convention = source.convention;
    }

    CaseResult run(const RunOptions& options) {
        try {
            if (!case_.refusal.empty() && !capabilities_.refuses_bad_meshes) return skip("does not check its meshes");
            if (case_.geometries.size() > 1 && !capabilities_.many_geometries)
                return skip("takes one geometry per scene");
            ExpandedCase expanded = expand(case_, options.sweep_factor);
            for (RayGroup& group : expanded.groups) thin(group, options.most_sweep_rays);
            if (!case_.refusal.empty()) {
                expect_refusal(expanded);
            } else {
                ask_everything(expanded);
            }
        } catch (const MeshFileAbsent& absent) {
            return skip(absent.what());
        } catch (const Inexpressible& inexpressible) {
            return skip(inexpressible.what());
        } catch (const Refusal& refusal) {
            fail("mesh", std::string("the mesh was refused: ") + refusal.what());
        } catch (const std::exception& error) {
            fail("library", std::string("the library failed: ") + error.what());
        }
        if (result_.outcome == Outcome::passed && checked_ == 0)
            return skip(inexpressible_.empty() ? "has no call for what is expected" : inexpressible_);
        return result_;
    }

private:
    CaseResult skip(const std::string& reason) {
        result_.outcome = Outcome::skipped;
        result_.reason = reason;
        return result_;
    }

    void fail(const char* question, const std::string& reason) {
        if (result_.outcome != Outcome::failed) result_.reason = reason;
        result_.outcome = Outcome::failed;
        result_.failed_questions.insert(question);
    }
    void fail(const char* question, const RayGroup& group, const Ray& ray, const std::string& why) {
        fail(question, file_ + ":" + std::to_string(group.lines->line) + ": " + why + "; " + text_of(ray));
    }

    void expect_refusal(const ExpandedCase& expanded) {
        ++checked_;
        try {
            library_.build(expanded.meshes);
            fail("mesh", "expected the mesh to be refused as " + case_.refusal + ", it was taken");
        } catch (const Refusal& refusal) {
            const std::string text = refusal.what();
            if (refusal.kind != case_.refusal)
                fail("mesh",
                     "expected the mesh to be refused as " + case_.refusal + ", got " + refusal.kind + ": " + text);
            else if (text.find(case_.mention) == std::string::npos)
                fail("mesh", "expected an error that mentions \"" + case_.mention + "\", got: " + text);
        }
    }

    void ask_everything(const ExpandedCase& expanded) {
        const ExactScene exact(expanded.meshes);
        const std::unique_ptr<Scene> scene = library_.build(expanded.meshes);
        for (const RayGroup& group : expanded.groups) {
            std::vector<Answer> closest;
            for (const Ray& ray : group.rays) {
                try {
                    const Answers answers = ask(*scene, ray, capabilities_);
                    closest.push_back(answers.closest);
                    check_ray(group, ray, answers, exact);
                } catch (const Inexpressible& inexpressible) {
                    inexpressible_ = inexpressible.what();
                }
            }
            if (closest.size() < group.rays.size()) continue; // what follows is about all of them
            for (const Expectation& expectation : group.lines->expectations) {
                if (expectation.kind == Expected::batch && capabilities_.has_batch) check_batch(*scene, group, closest);
                if (expectation.kind == Expected::repeatable)
                    check_repeatable(*scene, group, closest, static_cast<int>(expectation.numbers[0]));
            }
        }
    }

    void check_ray(const RayGroup& group, const Ray& ray, const Answers& answers, const ExactScene& exact) {
        ++result_.rays;
        bool good = true;
        const double reach = exact.reach(ray);
        const char* in_doubt = "";
        std::string why =
            disagreement(answers, std::isfinite(reach) ? capabilities_.t_tolerance * reach : 0.0, in_doubt);
        if (!why.empty()) {
            good = false;
            fail(in_doubt, group, ray, why);
        }
        for (const Expectation& expectation : group.lines->expectations) {
            if (expectation.kind == Expected::batch || expectation.kind == Expected::repeatable) continue;
            const Verdict verdict = check(expectation, ray, answers, exact, capabilities_, why);
            if (verdict != Verdict::cannot_say) ++checked_;
            if (verdict != Verdict::not_met) continue;
            good = false;
            fail(describe(expectation.kind).needs_all ? "all" : "closest", group, ray, why);
        }
        if (!good) ++result_.failed_rays;
    }

    // Forwards, backwards, and in two halves.
    void check_batch(Scene& scene, const RayGroup& group, const std::vector<Answer>& single) {
        ++checked_;
        const auto compare = [&](std::vector<Ray> rays, std::vector<Answer> expected, const char* how) {
            std::vector<Answer> answers;
            scene.closest_batch(rays, answers);
            if (answers.size() != rays.size())
                return fail("batch", "a batch of " + std::to_string(rays.size()) + " rays has " +
                                         std::to_string(answers.size()) + " answers");
            for (std::size_t i = 0; i < rays.size(); ++i) {
                if (same_bits(answers[i], expected[i])) continue;
                ++result_.failed_rays;
                fail("batch", group, rays[i],
                     std::string(how) + " " + text_of(answers[i]) + ", alone " + text_of(expected[i]));
            }
        };
        const auto half = static_cast<std::ptrdiff_t>(single.size() / 2);
        compare(group.rays, single, "in a batch");
        compare({group.rays.rbegin(), group.rays.rend()}, {single.rbegin(), single.rend()}, "in a backward batch");
        compare({group.rays.begin() + half, group.rays.end()}, {single.begin() + half, single.end()},
                "in half a batch");
    }

    void check_repeatable(Scene& scene, const RayGroup& group, const std::vector<Answer>& first, int times) {
        for (int time = 0; time < times; ++time) {
            ++checked_;
            for (std::size_t i = 0; i < first.size(); ++i) {
                const Answers again = ask(scene, group.rays[i], capabilities_);
                if (same_bits(again.closest, first[i])) continue;
                ++result_.failed_rays;
                fail("again", group, group.rays[i],
                     "asked again " + text_of(again.closest) + ", before " + text_of(first[i]));
            }
        }
    }

    Library& library_;
    const Capabilities capabilities_;
    const std::string file_;
    const Case& case_;
    CaseResult result_;
    std::string inexpressible_; // why a ray could not be asked
    std::uint64_t checked_ = 0; // expectations that the library has a call for
};

} // namespace

std::uint64_t LibraryResult::count(Outcome outcome) const {
    return static_cast<std::uint64_t>(
        std::count_if(cases.begin(), cases.end(), [=](const CaseResult& result) { return result.outcome == outcome; }));
}

std::uint64_t LibraryResult::passed_by_closest() const {
    return static_cast<std::uint64_t>(std::count_if(cases.begin(), cases.end(), [](const CaseResult& result) {
        const auto& failed = result.failed_questions;
        return result.outcome != Outcome::skipped && failed.count("closest") + failed.count("mesh") == 0 &&
               failed.count("library") == 0;
    }));
}

LibraryResult run_cases(Library& library, const std::vector<Family>& families, const RunOptions& options) {
    LibraryResult result{library.name(), {}};
    for (const Family& family : families) {
        if (options.begins) options.begins(family.name);
        for (const Case& source : family.cases) result.cases.push_back(CaseRun(library, family, source).run(options));
    }
    return result;
}

} // namespace raywise::contract
