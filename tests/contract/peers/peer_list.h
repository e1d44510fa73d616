// The libraries that are put before the hard cases. To add one: an adapter, and a row in peer_list.cpp.
#pragma once

#include "contract/library.h"

#include <memory>
#include <string>
#include <vector>

namespace raywise::contract {

struct Peer {
    const char* key;  // on the command line
    const char* note; // how it is asked, for the report
    const char* why;  // what lies behind most of its failures, found by looking into them
    // Both empty for those of Python, which python_peers.py knows by the same key.
    std::unique_ptr<Library> (*make)();
    std::string (*version)();

    bool in_python() const { return make == nullptr; }
};

const std::vector<Peer>& peers();
const Peer* peer_named(const std::string& key);

} // namespace raywise::contract
