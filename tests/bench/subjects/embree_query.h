// Rays for Embree: single calls and packets of eight. Calls: Embree3Calls or Embree4Calls.
#pragma once

#include "bench/subjects/chunks.h"
#include "bench/subjects/copy_vectors.h"
#include "bench/subjects/embree_calls.h"
#include "bench/subjects/subject.h"

#include <algorithm>
#include <limits>

namespace raywise::bench {

// What a ray is handed over with that has met nothing yet.
inline RTCHit hit_of_nothing() {
    RTCHit hit{};
    hit.primID = hit.geomID = hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return hit;
}

// Embree sets an occluded ray's tfar to minus infinity.
inline bool is_occluded(float tfar) { return tfar < -std::numeric_limits<float>::max(); }

template <class Calls>
class EmbreeSingleQuery : public Query {
public:
    EmbreeSingleQuery(const Calls& calls, const QueryRequest& request)
        : calls_(calls),
          rays_(request.rays.size()),
          question_(request.question),
          threads_(request.threads),
          answers_(request.answers) {
        const RaySet& from = request.rays;
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            RTCRay& ray = rays_[i];
            ray = {};
            ray.org_x = from.origin[3 * i];
            ray.org_y = from.origin[3 * i + 1];
            ray.org_z = from.origin[3 * i + 2];
            ray.dir_x = from.direction[3 * i];
            ray.dir_y = from.direction[3 * i + 1];
            ray.dir_z = from.direction[3 * i + 2];
            ray.tnear = from.tmin[i];
            ray.tfar = from.tmax[i];
            ray.mask = ~0u;
        }
        if (answers_ != nullptr) answers_->make_room(rays_.size(), question_);
    }

    std::uint64_t ask(std::size_t first, std::size_t last) override {
        return ask_in_chunks(first, last, threads_, [this](std::size_t begin, std::size_t end) {
            return question_ == Question::any ? any(begin, end) : closest(begin, end);
        });
    }

private:
    std::uint64_t closest(std::size_t first, std::size_t last) const {
        typename Calls::Context context(calls_);
        const RTCHit no_hit = hit_of_nothing();
        typename Calls::RayHit query;
        std::uint64_t hits = 0;
        for (std::size_t i = first; i < last; ++i) {
            copy_by_four(query.ray, rays_[i]);
            copy_by_four(query.hit, no_hit);
            context.intersect(query);
            const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
            hits += hit ? 1 : 0;
            if (answers_ == nullptr) continue;
            answers_->t[i] = query.ray.tfar;
            answers_->uv[2 * i] = query.hit.u;
            answers_->uv[2 * i + 1] = query.hit.v;
            answers_->primitive[i] = hit ? query.hit.primID : RTC_INVALID_GEOMETRY_ID;
        }
        return hits;
    }

    std::uint64_t any(std::size_t first, std::size_t last) const {
        typename Calls::Context context(calls_);
        std::uint64_t hits = 0;
        RTCRay ray;
        for (std::size_t i = first; i < last; ++i) {
            copy_by_four(ray, rays_[i]);
            context.occluded(ray);
            const bool hit = is_occluded(ray.tfar);
            hits += hit ? 1 : 0;
            if (answers_ != nullptr) answers_->occluded[i] = hit ? 1 : 0;
        }
        return hits;
    }

    Calls calls_;
    std::vector<RTCRay> rays_;
    Question question_;
    unsigned threads_;
    Answers* answers_;
};

template <class Calls>
class EmbreePacketQuery : public Query {
public:
    EmbreePacketQuery(const Calls& calls, const QueryRequest& request)
        : calls_(calls),
          count_(request.rays.size()),
          packets_((request.rays.size() + width - 1) / width),
          question_(request.question),
          threads_(request.threads),
          answers_(request.answers) {
        const RaySet& from = request.rays;
        for (std::size_t i = 0; i < packets_.size() * width; ++i) {
            const std::size_t k = std::min(i, count_ - 1);
            RTCRay8& packet = packets_[i / width];
            const std::size_t lane = i % width;
            packet.org_x[lane] = from.origin[3 * k];
            packet.org_y[lane] = from.origin[3 * k + 1];
            packet.org_z[lane] = from.origin[3 * k + 2];
            packet.dir_x[lane] = from.direction[3 * k];
            packet.dir_y[lane] = from.direction[3 * k + 1];
            packet.dir_z[lane] = from.direction[3 * k + 2];
            packet.tnear[lane] = from.tmin[k];
            packet.tfar[lane] = from.tmax[k];
            packet.time[lane] = 0.0f;
            packet.mask[lane] = ~0u;
            packet.id[lane] = packet.flags[lane] = 0;
        }
        if (answers_ != nullptr) answers_->make_room(count_, question_);
    }

    std::uint64_t ask(std::size_t first, std::size_t last) override {
        return ask_in_chunks(first, last, threads_, [this](std::size_t begin, std::size_t end) {
            return question_ == Question::any ? any(begin, end) : closest(begin, end);
        });
    }

private:
    static constexpr std::size_t width = 8;

    // Lanes of the last packet that stand for no ray are switched off.
    static std::size_t lanes(std::size_t first, std::size_t last) { return std::min(width, last - first); }
    static void set_valid(int (&valid)[width], std::size_t lanes) {
        for (std::size_t lane = 0; lane < width; ++lane) valid[lane] = lane < lanes ? -1 : 0;
    }

    std::uint64_t closest(std::size_t first, std::size_t last) const {
        typename Calls::Context context(calls_);
        typename Calls::RayHit8 query;
        alignas(32) int valid[width];
        std::uint64_t hits = 0;
        for (std::size_t i = first; i < last; i += width) {
            const std::size_t rays = lanes(i, last);
            set_valid(valid, rays);
            copy_by_eight(query.ray, packets_[i / width]);
            std::fill_n(query.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
            std::fill_n(query.hit.instID[0], width, RTC_INVALID_GEOMETRY_ID);
            context.intersect(valid, query);
            for (std::size_t lane = 0; lane < rays; ++lane) {
                const bool hit = query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
                hits += hit ? 1 : 0;
                if (answers_ == nullptr) continue;
                answers_->t[i + lane] = query.ray.tfar[lane];
                answers_->uv[2 * (i + lane)] = query.hit.u[lane];
                answers_->uv[2 * (i + lane) + 1] = query.hit.v[lane];
                answers_->primitive[i + lane] = hit ? query.hit.primID[lane] : RTC_INVALID_GEOMETRY_ID;
            }
        }
        return hits;
    }

    std::uint64_t any(std::size_t first, std::size_t last) const {
        typename Calls::Context context(calls_);
        RTCRay8 query;
        alignas(32) int valid[width];
        std::uint64_t hits = 0;
        for (std::size_t i = first; i < last; i += width) {
            const std::size_t rays = lanes(i, last);
            set_valid(valid, rays);
            copy_by_eight(query, packets_[i / width]);
            context.occluded(valid, query);
            for (std::size_t lane = 0; lane < rays; ++lane) {
                const bool hit = is_occluded(query.tfar[lane]);
                hits += hit ? 1 : 0;
                if (answers_ != nullptr) answers_->occluded[i + lane] = hit ? 1 : 0;
            }
        }
        return hits;
    }

    Calls calls_;
    std::size_t count_;
    std::vector<RTCRay8> packets_;
    Question question_;
    unsigned threads_;
    Answers* answers_;
};

} // namespace raywise::bench
