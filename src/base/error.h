// Errors inside the library: an exception that carries a status and a message. capi/guard.h turns it into a return value.
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <utility>

namespace raywise {

enum class Status : std::int32_t {
#define RW_STATUS(name, value, text) name = value,
#include "base/status_list.def"
#undef RW_STATUS
};

class Error : public std::exception {
public:
    Error(Status status, std::string message) : status_(status), message_(std::move(message)) {}

    Status status() const noexcept { return status_; }
    const char* what() const noexcept override { return message_.c_str(); }

private:
    Status status_;
    std::string message_;
};

} // namespace raywise
