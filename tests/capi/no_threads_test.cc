// A library that was not asked for threads starts none.
#include "calls.h"

#include "process.h"

#include <thread>

namespace {

void make_all(const CallFiles& files, Caller& caller, uint32_t threads) {
    for (const Call& call : all_calls(files)) {
        CHECK(call.make(caller, threads));
        if (!CHECK(process_threads() == 1)) fprintf(stderr, "    %s\n", call.name.c_str());
    }
}

} // namespace

int main() {
    CHECK(process_threads() == 1);
    const CallFiles files;
    {
        Caller large(files, 5000, 20000);
        make_all(files, large, 1);
    }
    // Too small to be worth a thread.
    Caller small(files, 1023, 511);
    make_all(files, small, 0);
    make_all(files, small, 8);

    // What is asked for comes, or nothing was shown above.
    Caller large(files, 1024, 512);
    CHECK(large.batch_closest(0));
    CHECK(std::thread::hardware_concurrency() == 1 || process_threads() > 1);
    return finish("no threads");
}
