// What is measured: raywise and its peers behind one interface, so that the sections walk a table of them.
#pragma once

#include "bench/ray_set.h"
#include "scenes/scenes.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace raywise::bench {

enum class Question {
    closest,
    any
};

// How rays are handed over.
enum class Call {
    single, // one call per ray
    packet, // eight rays per call, told to be coherent
    batch   // all rays in one call
};

const char* name_of(Question question);
const char* name_of(Call call);

// Where the answers of a batch go, in the order of the rays.
struct Answers {
    std::vector<float> t;
    std::vector<float> uv;                // two of each
    std::vector<std::uint32_t> primitive; // all bits set: a miss
    std::vector<std::uint8_t> occluded;   // of Question::any

    void make_room(std::size_t rays, Question question);
};

struct QueryRequest {
    const RaySet& rays; // copied
    Question question = Question::closest;
    Call call = Call::single;
    unsigned threads = 1;
    Answers* answers = nullptr; // nullptr: hits are only counted, in one thread
};

// Rays in the form that the subject takes them, ready to be asked again and again.
class Query {
public:
    virtual ~Query() = default;
    // Asks the rays from `first` up to `last`, and returns how many hit something. For Call::packet, multiples of 8 (but for
    // the end).
    virtual std::uint64_t ask(std::size_t first, std::size_t last) = 0;
};

// A scene, built and ready.
class Built {
public:
    virtual ~Built() = default;
    virtual std::unique_ptr<Query> query(const QueryRequest& request) const = 0;
    // What the subject itself says it keeps, the caller's arrays not counted. Negative: it does not tell.
    virtual double bytes() const { return -1.0; }
    // What the subject itself says it had at most while building. Negative: it does not tell.
    virtual double peak_bytes() const { return -1.0; }
    virtual std::string structure() const { return {}; }
};

struct BuildRequest {
    const workloads::Mesh& mesh; // used in place where the subject can; outlives the scene
    // Where the mesh lies for who takes float64; the others find it at the origin, as do all rays.
    Vec3 offset = Vec3(0.0);
    unsigned threads = 1;
    // For who chooses by it: the kind of ray (position in workloads::ray_distributions()), and how many are coming.
    std::size_t kind = 0;
    std::uint64_t count = 10000000;
};

// What a row of the subjects' table says.
struct Traits {
    std::string name;     // "raywise bvh", "Embree 3 MEDIUM"
    bool peer = true;     // not ours
    bool robust = false;  // asks for watertight tests
    bool chooses = false; // its structure depends on which and how many rays are expected
    bool slow = false;    // kept away from large scenes and long runs
    bool totals = false;  // takes part in the totals from cold
    bool batches = false; // and in the batches of many rays
    std::string
        instruction_set; // of its vectors, by Highway's names: "AVX3" (AVX-512), "AVX2", "SSE4" ...; empty: not known
    std::vector<Call> calls;
};

class Subject {
public:
    explicit Subject(Traits traits) : traits_(std::move(traits)) {}
    virtual ~Subject() = default;
    const Traits& traits() const { return traits_; }
    const std::string& name() const { return traits_.name; }
    bool has(Call call) const;
    virtual std::unique_ptr<Built> build(const BuildRequest& request) const = 0;

private:
    Traits traits_;
};

using Subjects = std::vector<std::unique_ptr<Subject>>;

} // namespace raywise::bench
