// The only try/catch of the C boundary: whatever is thrown inside becomes a status and the thread's last error message.
#pragma once

#include "base/error.h"
#include "raywise/raywise.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace raywise::capi {

// Keeps the message for rw_last_error_message; cuts it to the room there is, so that it cannot fail.
void set_last_error(const char* message) noexcept;

inline std::int32_t fail(Status status, const char* message) noexcept {
    set_last_error(message);
    return static_cast<std::int32_t>(status);
}

// Runs the body, which returns nothing (RW_OK) or a status of its own.
template <class Body>
std::int32_t guard(Body&& body) noexcept {
    try {
        if constexpr (std::is_void_v<decltype(body())>) {
            std::forward<Body>(body)();
            return RW_OK;
        } else {
            return static_cast<std::int32_t>(std::forward<Body>(body)());
        }
    } catch (const Error& error) {
        return fail(error.status(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(Status::ERROR_OUT_OF_MEMORY, "out of memory");
    } catch (const std::length_error&) { // a container asked for more than can be addressed
        return fail(Status::ERROR_OUT_OF_MEMORY, "out of memory: more was asked for than can be addressed");
    } catch (const std::exception& error) {
        return fail(Status::ERROR_INTERNAL, error.what());
    } catch (...) {
        return fail(Status::ERROR_INTERNAL, "an exception of an unknown type");
    }
}

} // namespace raywise::capi
