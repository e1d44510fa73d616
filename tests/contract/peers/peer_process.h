// A library in a process of its own: what it does to itself, by crash, by endless loop or by running out of memory, ends
// one case and not the run.
#pragma once

#include "contract/library.h"
#include "contract/peers/child_process.h"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace raywise::contract {

struct ProcessLimits {
    std::chrono::milliseconds patience; // for one answer
    std::uint64_t most_memory = 0;      // bytes of address space; 0: no limit
};

// The library reported an error where it should have answered.
class PeerFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Asking it throws Refusal and Inexpressible as the library itself does, PeerFailure for any other exception of its, and
// ChildLost when the process is gone or too slow. The next build() after that starts it again.
class PeerProcess : public Library {
public:
    // command: of a program that serves (see server.h). log: file for its standard error.
    PeerProcess(std::vector<std::string> command, ProcessLimits limits, std::string log);
    ~PeerProcess() override;

    std::string name() const override { return name_; }
    Capabilities capabilities() const override { return capabilities_; }
    std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) override;

    const std::string& version() const { return version_; }

    class Connection;

private:
    std::shared_ptr<Connection> connect() const;

    std::vector<std::string> command_;
    ProcessLimits limits_;
    std::string log_;
    std::string name_;
    std::string version_;
    Capabilities capabilities_;
    std::shared_ptr<Connection> connection_;
};

} // namespace raywise::contract
