// A program of our own at the other end of two pipes, which may crash or hang without taking us with it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/types.h>

namespace raywise::contract {

// The child is gone or did not answer in time; what() says which, in words for a report.
class ChildLost : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class ChildProcess {
public:
    using Deadline = std::chrono::steady_clock::time_point;

    // Starts a program; its first argument is its path, or a name to be found on PATH. What it writes to standard
    // error goes to the file at `log`, at its end. most_memory: bytes of address space; 0: no limit.
    ChildProcess(const std::vector<std::string>& command, const std::string& log, std::uint64_t most_memory);
    ~ChildProcess(); // kills it
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // Both throw ChildLost, having killed the child when it was too slow.
    void write(const void* data, std::size_t bytes, Deadline deadline);
    void read(void* data, std::size_t bytes, Deadline deadline);

private:
    void wait_until_ready(int descriptor, short event, Deadline deadline);
    [[noreturn]] void lost(const std::string& reason);
    std::string last_words() const;
    std::string end(); // waits for the child, and tells how it ended

    std::string log_;
    off_t log_begins_ = 0; // where this child's part of the log does
    pid_t pid_ = -1;
    int to_child_ = -1;
    int from_child_ = -1;
};

} // namespace raywise::contract
