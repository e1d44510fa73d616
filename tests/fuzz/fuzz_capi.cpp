// Sequences of calls of the C API, made of the input's bytes: every answer of every structure and view is the linear scan's, and
// every status one that the header allows for that call.
#include "fuzz/failure.h"
#include "fuzz/input.h"
#include "fuzz/world.h"

#include <cstdlib>

extern "C" int LLVMFuzzerInitialize(int*, char***);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    setenv("RAYWISE_CALIBRATION", "builtin", 1); // whatever this machine's calibration is, the calls are the same
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    raywise::fuzz::Input input(data, size);
    raywise::fuzz::World world(input);
    raywise::fuzz::set_context([&] { world.describe(); });
    world.run();
    raywise::fuzz::set_context({});
    return 0;
}
