#include "bench/library.h"

#include <cstring>
#include <stdexcept>
#include <utility>

#include <dlfcn.h>

namespace raywise::bench {
namespace {

std::string linker_message() {
    const char* message = ::dlerror();
    return message != nullptr ? message : "unknown error of the dynamic linker";
}

} // namespace

Library::Library(std::string name, const std::string& path) : name_(std::move(name)) {
    // RTLD_LOCAL: each library finds its own functions, and not those of the one loaded first.
    void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw std::runtime_error(linker_message());
    const auto find = [&](const char* function) {
        void* const address = ::dlsym(handle, function);
        if (address == nullptr) throw std::runtime_error(path + ": " + linker_message());
        return address;
    };
#define RW_BENCH_FIND(function)                                 \
    {                                                           \
        void* const address = find(#function);                  \
        std::memcpy(&this->function, &address, sizeof address); \
    }
    RW_BENCH_FUNCTIONS(RW_BENCH_FIND)
#undef RW_BENCH_FIND
}

void Library::check(std::int32_t status) const {
    if (status != RW_OK) throw std::runtime_error(name_ + ": " + this->rw_last_error_message());
}

} // namespace raywise::bench
