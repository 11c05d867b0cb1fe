#include "report/tables.hpp"

#include <algorithm>
#include <cstddef>

#include "common/report_text.hpp"
#include "report/columns.hpp"

namespace examples {
namespace {

table table_of(const std::vector<const record*>& records, const std::string& map) {
    table result{map, {}, {}, {}};
    std::vector<const record*> measured;
    for (const record* r : records) {
        if (r->skipped.empty())
            measured.push_back(r);
        else
            result.skipped.push_back(r->name + ": " + r->skipped);
    }
    if (measured.empty()) return result;

    std::vector<column> shown;
    for (std::size_t i = 0; i < column_count; ++i) {
        const column c = column(i);
        const std::string first = text_of(*measured.front(), c);
        const auto has = [&](const record* r) { return r->has(c); };
        const auto same = [&](const record* r) { return text_of(*r, c) == first; };
        if (std::none_of(measured.begin(), measured.end(), has)) continue;
        if (about(c).kind == column_kind::setup && measured.size() > 1 &&
            std::all_of(measured.begin(), measured.end(), same)) {
            result.throughout.append(result.throughout.empty() ? "Throughout: " : "; ");
            result.throughout.append(heading_of(c)).append(" ").append(first);
        } else {
            shown.push_back(c);
        }
    }
    if (!result.throughout.empty()) result.throughout += '.';

    result.rows.push_back({"set-up"});
    for (const column c : shown) result.rows.front().push_back(heading_of(c));
    for (const record* r : measured) {
        result.rows.push_back({r->name});
        for (const column c : shown) result.rows.back().push_back(r->has(c) ? text_of(*r, c) : "-");
    }
    return result;
}

// A page is for a person: of a long product of choices it shows the usual ones.
constexpr std::size_t most_rows = 200;

bool is_usual(const record& r) {
    return (r.fit.empty() || r.fit == "least squares") && (r.function.empty() || r.function == "cubic") &&
           (r.quantity.empty() || r.quantity == "slope" || r.format == "RGBA8");
}

}  // namespace

std::vector<table> tables_of(const findings& all, const std::string& section) {
    std::vector<std::string> maps;
    for (const record& r : all.records)
        if (r.section == section && std::find(maps.begin(), maps.end(), r.map) == maps.end()) maps.push_back(r.map);
    std::stable_partition(maps.begin(), maps.end(), [](const std::string& map) { return map == mean_map; });
    std::vector<table> tables;
    for (const std::string& map : maps) {
        std::vector<const record*> records;
        for (const record& r : all.records)
            if (r.section == section && r.map == map) records.push_back(&r);
        const std::size_t count = records.size();
        if (count > most_rows) std::erase_if(records, [](const record* r) { return !is_usual(*r); });
        tables.push_back(table_of(records, map));
        if (records.size() < count)
            tables.back().throughout += format(
                " Of %zu set-ups those fitted by least squares, of cubic bearings and slopes; report.csv has all.",
                count);
    }
    return tables;
}

std::string title_of(const findings& all, const std::string& map) {
    if (map.empty()) return "Not of a map";
    if (map != mean_map) return map;
    return "Mean of " + std::to_string(all.maps.size()) + " maps";
}

}  // namespace examples
