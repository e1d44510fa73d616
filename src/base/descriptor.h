// A file descriptor that is closed with its scope.
#pragma once

#include <unistd.h>

namespace raywise {

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {} // below 0: none
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }

private:
    int number_;
};

} // namespace raywise
