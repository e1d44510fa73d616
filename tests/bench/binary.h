// Arrays in files of our own: a count of 64 bits, then the values as they are in memory.
#pragma once

#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <vector>

namespace raywise::bench {

template <class T>
void write_values(std::ostream& out, const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    out.write(reinterpret_cast<const char*>(&count), sizeof count);
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

// With room for a few more, see make_scene.
template <class T>
std::vector<T> read_values(std::istream& in) {
    std::uint64_t count = 0;
    in.read(reinterpret_cast<char*>(&count), sizeof count);
    if (!in) throw std::runtime_error("the file breaks off");
    std::vector<T> values;
    values.reserve(count + 4);
    values.resize(count);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    if (!in) throw std::runtime_error("the file breaks off");
    return values;
}

} // namespace raywise::bench
