#include "benchmark/report.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>

#include "common/report_text.hpp"

namespace examples {

std::vector<check> checks_of(const measurement& m) {
    std::vector<check> all;
    const auto at_least = [&](const std::string& what, double value, double limit) {
        all.push_back({m.name, what + format(" >= %g", limit), value, value >= limit});
    };
    const auto at_most = [&](const std::string& what, double value, double limit) {
        all.push_back({m.name, what + format(" <= %g", limit), value, value <= limit});
    };
    const int usual = bumpshadow::bake_options{}.steps;
    const figures& ready = m.row(method::cascade, usual, 1);
    const figures& fine = m.row(method::cascade, fine_steps, 1);
    at_least("default cascade: times as fast as the classic sweep", ready.ratio, 6.0);
    at_most("default cascade: mean error in degrees", ready.error.mean, 0.15);
    at_most("default cascade: 99th percentile in degrees", ready.error.percentile_99, 2.0);
    at_least("fine cascade: times as fast as the classic sweep", fine.ratio, 3.0);
    at_most("fine cascade: mean error in degrees", fine.error.mean, 0.03);
    at_most("fine cascade: 99th percentile in degrees", fine.error.percentile_99, 0.5);
    at_least("default cascade: times as fast with two threads", m.thread_speedup, 1.8);
    at_most("cascade: bytes of scratch for 32 bearings more than for 4", double(m.scratch_32) - double(m.scratch_4),
            0.0);
    return all;
}

std::string table_of(const measurement& m) {
    std::vector<std::vector<std::string>> rows{{m.name, "ns a sample", "times as fast", "million/s", "mean error",
                                                "99 %", "largest", "bias", "scratch bytes", "a texel"}};
    const double texels = double(m.extent.x) * double(m.extent.y);
    for (const figures& r : m.rows) {
        const bool reference = r.who.how == method::exact;
        const auto degrees = [&](double error) { return reference ? std::string("-") : format("%.3f", error); };
        rows.push_back({r.who.name, format("%.2f", r.nanoseconds), format(reference ? "%.3f" : "%.2f", r.ratio),
                        format("%.1f", 1e3 / r.nanoseconds), degrees(r.error.mean), degrees(r.error.percentile_99),
                        degrees(r.error.largest), degrees(r.error.bias), format("%zu", r.scratch),
                        format("%.1f", double(r.scratch) / texels)});
    }
    return lined_up(rows);
}

std::string json_of(std::span<const measurement> all, std::span<const check> checks) {
    std::string json = build_json() + ",\"maps\":[";
    for (const measurement& m : all) {
        json += &m == all.data() ? "" : ",";
        json += "{\"map\":" + quoted(m.name) +
                format(
                    ",\"width\":%d,\"height\":%d,\"error_samples\":%zu,\"thread_speedup\":%.4f,"
                    "\"scratch_4_bearings\":%zu,\"scratch_32_bearings\":%zu,\"rows\":[",
                    m.extent.x, m.extent.y, m.error_samples, m.thread_speedup, m.scratch_4, m.scratch_32);
        for (const figures& r : m.rows) {
            json += &r == m.rows.data() ? "" : ",";
            json += "{\"name\":" + quoted(r.who.name) +
                    format(",\"bearings\":%d,\"threads\":%d,\"ns_per_sample\":%.4f,\"ratio\":%.4f,\"scratch\":%zu",
                           r.who.bearings, r.who.threads, r.nanoseconds, r.ratio, r.scratch);
            if (r.who.how == method::cascade) json += format(",\"steps\":%d", r.who.steps);
            if (r.who.how != method::exact)
                json += format(",\"mean\":%.5f,\"percentile_99\":%.5f,\"largest\":%.5f,\"bias\":%.5f", r.error.mean,
                               r.error.percentile_99, r.error.largest, r.error.bias);
            json += "}";
        }
        json += "]}";
    }
    json += "],\"checks\":[";
    for (const check& c : checks) {
        json += &c == checks.data() ? "" : ",";
        json += "{\"map\":" + quoted(c.map) + ",\"check\":" + quoted(c.what) +
                format(",\"value\":%.5g,\"held\":%s}", c.value, c.held ? "true" : "false");
    }
    return json + "]}\n";
}

}  // namespace examples
