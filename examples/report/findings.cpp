#include "report/findings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "report/columns.hpp"

namespace examples {
namespace {

// What was measured stays if it was the same on all maps.
double joined(column c, const std::vector<const record*>& all) {
    const double first = (*all.front())[c];
    double sum = 0.0, squares = 0.0, largest = first;
    bool same = true;
    for (const record* r : all) {
        const double value = (*r)[c];
        same = same && value == first;
        sum += value;
        squares += value * value;
        largest = std::max(largest, value);
    }
    if (c == column::samples) return sum;
    if (about(c).kind == column_kind::setup) return same ? first : std::numeric_limits<double>::quiet_NaN();
    if (c == column::error_largest) return std::isnan(sum) ? sum : largest;
    if (c == column::error_interval || c == column::mismatch_interval) return std::sqrt(squares) / double(all.size());
    return sum / double(all.size());
}

}  // namespace

void add_means(findings& all) {
    if (all.maps.size() < 2) return;
    std::map<std::pair<std::string, std::string>, std::vector<const record*>> groups;
    std::vector<std::pair<std::string, std::string>> order;
    for (const record& r : all.records) {
        if (r.map.empty() || !r.skipped.empty()) continue;
        const std::pair key(r.section, r.name);
        if (!groups.contains(key)) order.push_back(key);
        groups[key].push_back(&r);
    }
    std::vector<record> means;
    for (const auto& key : order) {
        const std::vector<const record*>& group = groups[key];
        if (group.size() != all.maps.size()) continue;
        record& mean = means.emplace_back(*group.front());
        mean.map = mean_map;
        for (std::size_t c = 0; c < column_count; ++c) mean[column(c)] = joined(column(c), group);
    }
    all.records.insert(all.records.end(), means.begin(), means.end());
}

}  // namespace examples
