#include "encodings/report.hpp"

#include <cmath>

#include "common/report_text.hpp"

namespace examples {

std::string text_of(const table& t, std::span<const std::string> maps) {
    std::vector<std::vector<std::string>> lines{{t.title, "bytes", "fetches", "mean %", "to Lengyel's"}};
    lines.front().insert(lines.front().end(), maps.begin(), maps.end());
    for (const row& r : t.rows) {
        std::vector<std::string> line{r.name, format("%.3g", r.bytes), std::to_string(r.fetches)};
        if (r.skipped.empty()) {
            line.push_back(format("%.2f", r.mean));
            line.push_back(format("%.3f", r.ratio));
        } else {
            line.insert(line.end(), 2, "skipped");
        }
        for (std::size_t i = 0; i < maps.size(); ++i)
            line.push_back(r.skipped.empty() ? format("%.2f", r.mismatch[i]) : "-");
        lines.push_back(line);
    }
    return lined_up(lines);
}

std::string text_of(const grid& g) {
    std::vector<std::vector<std::string>> lines{{g.title}};
    lines.front().insert(lines.front().end(), g.columns.begin(), g.columns.end());
    for (const grid::line& l : g.lines) {
        lines.push_back({l.name});
        for (const double value : l.values) lines.back().push_back(std::isnan(value) ? "-" : format("%.3g", value));
    }
    return lined_up(lines);
}

std::string json_of(std::span<const std::string> maps, int texels, std::span<const table> tables,
                    std::span<const grid> grids, const speeds& speed, std::span<const check> checks) {
    std::string json = build_json() + format(",\"texels_a_map\":%d,\"maps\":[", texels);
    for (const std::string& map : maps) {
        json += &map == maps.data() ? "" : ",";
        json += quoted(map);
    }
    json += "],\"rows\":[";
    bool first = true;
    for (const table& t : tables)
        for (const row& r : t.rows) {
            json += first ? "" : ",";
            first = false;
            json += "{\"section\":" + quoted(t.title) + ",\"name\":" + quoted(r.name) +
                    format(",\"bytes\":%.6g,\"fetches\":%d", r.bytes, r.fetches);
            if (r.skipped.empty()) {
                json += format(",\"mean\":%.5f,\"ratio\":%.5f,\"mismatch\":[", r.mean, r.ratio);
                for (std::size_t i = 0; i < r.mismatch.size(); ++i)
                    json += format(i == 0 ? "%.5f" : ",%.5f", r.mismatch[i]);
                json += "]}";
            } else {
                json += ",\"skipped\":" + quoted(r.skipped) + "}";
            }
        }
    json += "],\"grids\":[";
    for (const grid& g : grids) {
        json += (&g == grids.data() ? "{\"title\":" : ",{\"title\":") + quoted(g.title) + ",\"columns\":[";
        for (std::size_t i = 0; i < g.columns.size(); ++i) json.append(i == 0 ? "" : ",").append(quoted(g.columns[i]));
        json += "],\"lines\":[";
        for (std::size_t k = 0; k < g.lines.size(); ++k) {
            json += (k == 0 ? "{\"name\":" : ",{\"name\":") + quoted(g.lines[k].name) + ",\"values\":[";
            for (std::size_t i = 0; i < g.lines[k].values.size(); ++i) {
                const double value = g.lines[k].values[i];
                json.append(i == 0 ? "" : ",").append(std::isnan(value) ? std::string("null") : format("%.5g", value));
            }
            json += "]}";
        }
        json += "]}";
    }
    json += "],\"speed\":[";
    for (const figure& f : speed.figures) {
        json += &f == speed.figures.data() ? "" : ",";
        json += "{\"what\":" + quoted(f.what) + format(",\"value\":%.5g}", f.value);
    }
    json += "],\"checks\":[";
    for (const check& c : checks) {
        json += &c == checks.data() ? "" : ",";
        json +=
            "{\"check\":" + quoted(c.what) + format(",\"value\":%.5g,\"held\":%s}", c.value, c.held ? "true" : "false");
    }
    return json + "]}\n";
}

}  // namespace examples
