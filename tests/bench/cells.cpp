#include "bench/cells.h"

namespace raywise::bench {

const Value* Cell::of(const std::string& subject) const {
    for (const Value& value : values) {
        if (value.subject == subject) return &value;
    }
    return nullptr;
}

const Value* Cell::best_peer(const std::function<bool(const Value&)>& among) const {
    const Value* best = nullptr;
    for (const Value& value : values) {
        if (!value.peer || (among && !among(value))) continue;
        if (best == nullptr || ratio(value, *best) > 1.0) best = &value;
    }
    return best;
}

double Cell::ratio(const Value& ours, const Value& other) const {
    return higher_is_better ? ours.value / other.value : other.value / ours.value;
}

nlohmann::ordered_json rows_of(const Cells& cells) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Cell& cell : cells) {
        const Value* const best = cell.best_peer();
        for (const Value& ours : cell.values) {
            if (ours.peer) continue;
            nlohmann::ordered_json row = {
                {"section", cell.section}, {"scene", cell.scene},   {"triangles", cell.triangles},
                {"rays", cell.rays},       {"query", cell.query},   {"count", cell.count},
                {"threads", cell.threads}, {"unit", cell.unit},     {"subject", ours.subject},
                {"value", ours.value},     {"spread", ours.spread}, {"repetitions", ours.repetitions},
            };
            if (!ours.structure.empty()) row["structure"] = ours.structure;
            if (!ours.instruction_set.empty()) row["instruction_set"] = ours.instruction_set;
            if (ours.hit_rate >= 0.0) row["hit_rate"] = ours.hit_rate;
            if (ours.extrapolated) row["extrapolated"] = true;
            if (ours.told >= 0.0) row["told"] = ours.told;
            if (best == nullptr) {
                row["peer"] = row["peer_value"] = row["ratio"] = nullptr;
                rows.push_back(row);
                continue;
            }
            for (const Value& peer : cell.values) {
                if (!peer.peer) continue;
                nlohmann::ordered_json pair = row;
                pair["peer"] = peer.subject;
                pair["peer_value"] = peer.value;
                pair["peer_spread"] = peer.spread;
                if (!peer.instruction_set.empty()) pair["peer_instruction_set"] = peer.instruction_set;
                if (peer.extrapolated) pair["peer_extrapolated"] = true;
                if (peer.told >= 0.0) pair["peer_told"] = peer.told;
                pair["ratio"] = cell.ratio(ours, peer);
                pair["best_peer"] = &peer == best;
                rows.push_back(pair);
            }
        }
    }
    return rows;
}

} // namespace raywise::bench
