// How the judge talks with a library in another process. Numbers cross as they are, NaN and negative zero included; all
// are little-endian and packed. python_peers.py speaks the same.
//
// A message, in either direction:  uint32 kind, uint32 bytes, then so many bytes.
//
//   request          body                                                     body of an `ok` reply
//   describe         -                                                        JSON: name, version and what it has
//   build            uint32 meshes, then for each:                            -
//                    uint32 float32, skip_invalid, vertices, triangles;
//                    3 float64 per vertex; 3 uint32 per triangle
//   closest          ray: 8 float64: origin, direction, tmin, tmax            one answer
//   any              ray                                                      uint32, 0 or 1
//   all              ray                                                      answers, sorted by t
//   closest_batch    rays                                                     answers, one per ray
//
// An answer:  float64 t, u, v; uint32 hit, geometry, primitive, 0.
// Other replies have a text: `refusal` (the kind, a line feed, what the library said), `inexpressible`, `failure`.
#pragma once

#include "contract/library.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace raywise::contract {

enum class Request : std::uint32_t {
    describe,
    build,
    closest,
    any,
    all,
    closest_batch
};
enum class Reply : std::uint32_t {
    ok,
    refusal,
    inexpressible,
    failure
};

struct MessageHead {
    std::uint32_t kind;
    std::uint32_t bytes;
};

// The body of a message, written from its beginning.
class Packer {
public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_arithmetic_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void put(const Vec3& v);
    void put(const Ray& ray);
    void put(const Answer& answer);
    void put(const Mesh& mesh);
    void put_text(const std::string& text) { bytes_ += text; }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

// ... and read from its beginning. Throws std::runtime_error when the body is shorter than what is asked of it.
class Unpacker {
public:
    explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}

    template <class T>
    T get() {
        static_assert(std::is_arithmetic_v<T>);
        if (bytes_.size() - at_ < sizeof(T)) throw std::runtime_error("a message is too short");
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    Vec3 vector();
    Ray ray();
    Answer answer();
    Mesh mesh();
    std::string text(); // all that is left
    bool done() const { return at_ == bytes_.size(); }

private:
    const std::string& bytes_;
    std::size_t at_ = 0;
};

} // namespace raywise::contract
