#include "bench/subjects/subject.h"

#include <algorithm>

namespace raywise::bench {

const char* name_of(Question question) { return question == Question::any ? "any" : "closest"; }

const char* name_of(Call call) {
    switch (call) {
        case Call::single:
            return "single";
        case Call::packet:
            return "packet8";
        case Call::batch:
            break;
    }
    return "batch";
}

void Answers::make_room(std::size_t rays, Question question) {
    if (question == Question::any) {
        occluded.resize(rays);
    } else {
        t.resize(rays);
        uv.resize(2 * rays);
        primitive.resize(rays);
    }
}

bool Subject::has(Call call) const {
    return std::find(traits_.calls.begin(), traits_.calls.end(), call) != traits_.calls.end();
}

} // namespace raywise::bench
