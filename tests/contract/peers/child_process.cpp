#include "contract/peers/child_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace raywise::contract {
namespace {

[[noreturn]] void system_failure(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

void make_pipe(int (&ends)[2]) {
    if (pipe2(ends, O_CLOEXEC) != 0) system_failure("pipe2");
}

void limit(int resource, rlim_t value) {
    const rlimit both{value, value};
    setrlimit(resource, &both);
}

// Between fork and exec: only what POSIX allows there.
[[noreturn]] void become(const std::vector<char*>& arguments, int standard_in, int standard_out, int standard_error,
                         std::uint64_t most_memory) {
    dup2(standard_in, STDIN_FILENO);
    dup2(standard_out, STDOUT_FILENO);
    dup2(standard_error, STDERR_FILENO);
    if (most_memory > 0) limit(RLIMIT_AS, most_memory);
    limit(RLIMIT_CORE, 0);
    signal(SIGPIPE, SIG_DFL);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

void close_descriptor(int& descriptor) {
    if (descriptor >= 0) close(descriptor);
    descriptor = -1;
}

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& log, std::uint64_t most_memory)
    : log_(log) {
    // Writing to a child that has died should be an error of that write.
    signal(SIGPIPE, SIG_IGN);

    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    int log_file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (log_file < 0) system_failure(log.c_str());
    log_begins_ = lseek(log_file, 0, SEEK_END);
    int in[2];
    int out[2];
    make_pipe(in);
    make_pipe(out);
    pid_ = fork();
    if (pid_ == 0) become(arguments, in[0], out[1], log_file, most_memory);
    close_descriptor(in[0]);
    close_descriptor(out[1]);
    close_descriptor(log_file);
    to_child_ = in[1];
    from_child_ = out[0];
    if (pid_ < 0) {
        close_descriptor(to_child_);
        close_descriptor(from_child_);
        system_failure("fork");
    }
    fcntl(to_child_, F_SETFL, O_NONBLOCK);
    fcntl(from_child_, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) kill(pid_, SIGKILL);
    end();
}

void ChildProcess::write(const void* data, std::size_t bytes, Deadline deadline) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        wait_until_ready(to_child_, POLLOUT, deadline);
        const ssize_t done = ::write(to_child_, from, bytes);
        if (done < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (done < 0) lost("");
        from += done;
        bytes -= static_cast<std::size_t>(done);
    }
}

void ChildProcess::read(void* data, std::size_t bytes, Deadline deadline) {
    char* to = static_cast<char*>(data);
    while (bytes > 0) {
        wait_until_ready(from_child_, POLLIN, deadline);
        const ssize_t done = ::read(from_child_, to, bytes);
        if (done < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (done <= 0) lost("");
        to += done;
        bytes -= static_cast<std::size_t>(done);
    }
}

void ChildProcess::wait_until_ready(int descriptor, short event, Deadline deadline) {
    if (descriptor < 0) throw ChildLost("the process has ended");
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        pollfd waiting{descriptor, event, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::clamp<long long>(left.count(), 0, 1'000'000)));
        if (ready > 0) return; // an error or a hang-up shows in the read or write that follows
        if (ready < 0 && errno != EINTR) system_failure("poll");
        if (ready == 0 && left.count() <= 0) {
            kill(pid_, SIGKILL);
            lost("no answer within the time limit");
        }
    }
}

void ChildProcess::lost(const std::string& reason) {
    const std::string ending = end();
    throw ChildLost(reason.empty() ? ending : reason);
}

// The failed assertion, or else the last line, that the child has written: " (...)", or nothing.
std::string ChildProcess::last_words() const {
    constexpr std::size_t enough = 160;
    std::ifstream log(log_, std::ios::binary);
    log.seekg(log_begins_);
    std::string last;
    for (std::string line; std::getline(log, line);)
        if (!line.empty()) last = line;
    if (const auto assertion = last.find("Assertion `"); assertion != std::string::npos) last.erase(0, assertion);
    if (last.size() > enough) last.resize(enough);
    return last.empty() ? "" : " (" + last + ")";
}

std::string ChildProcess::end() {
    close_descriptor(to_child_);
    close_descriptor(from_child_);
    if (pid_ <= 0) return "the process has ended";
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    if (WIFSIGNALED(status)) return std::string("crashed: ") + strsignal(WTERMSIG(status)) + last_words();
    return "the process ended with status " + std::to_string(WEXITSTATUS(status));
}

} // namespace raywise::contract
