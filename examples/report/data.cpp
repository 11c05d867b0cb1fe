#include <cmath>
#include <cstddef>

#include "common/report_text.hpp"
#include "report/columns.hpp"
#include "report/growth.hpp"
#include "report/writers.hpp"

namespace examples {
namespace {

std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

// JSON has no infinite numbers.
std::string number_json(const record& r, column c) {
    return std::isinf(r[c]) ? quoted(number_of(r, c)) : number_of(r, c);
}

// Members of an object or array, one a line.
class list {
public:
    explicit list(char open) : text_(1, open), close_(open == '{' ? '}' : ']') {}
    void add(const std::string& member) {
        text_ += text_.size() == 1 ? "\n" : ",\n";
        text_ += member;
    }
    [[nodiscard]] std::string text() const { return text_ + '\n' + close_; }

private:
    std::string text_;
    char close_;
};

std::string pair(const char* key, const std::string& value) { return quoted(key) + ':' + quoted(value); }

std::string run_json(const findings& all, const plot_outcome& outcome) {
    const run_facts& run = all.run;
    std::string json = build_json() + ',' + pair("flags", run.flags) + ',' + pair("machine", run.machine) +
                       format(",\"cores\":%d,\"seed\":%u,\"repeats\":%d,\"quick\":%s,", run.cores, run.seed,
                              run.repeats, run.quick ? "true" : "false");
    json += pair("date", run.date) + ",\"complete\":" + (run.partial.empty() ? "true" : "false");
    if (!run.partial.empty()) json.append(",").append(pair("partial", run.partial));
    return json + ',' + pair("gpu", run.gpu) + ',' + pair("plots", outcome.about) + '}';
}

std::string maps_json(const findings& all) {
    list maps('[');
    for (const map_facts& m : all.maps)
        maps.add('{' + pair("name", m.name) + ',' + pair("source", m.source) +
                 format(",\"width\":%d,\"height\":%d,\"height_scale\":%.9g,\"texel_size\":[%.9g,%.9g],", m.extent.x,
                        m.extent.y, m.height_scale, m.texel_size.x, m.texel_size.y) +
                 pair("edge", m.edge) + '}');
    return maps.text();
}

std::string columns_json() {
    list columns('[');
    for (const text_column& c : text_columns())
        columns.add('{' + pair("name", c.name) + ",\"unit\":\"\"," + pair("kind", "text") + ',' +
                    pair("meaning", c.meaning) + '}');
    for (std::size_t i = 0; i < column_count; ++i) {
        const column_info& c = about(column(i));
        columns.add('{' + pair("name", c.name) + ',' + pair("unit", c.unit) + ',' + pair("kind", word_of(c.kind)) +
                    ',' + pair("meaning", c.meaning) + '}');
    }
    return columns.text();
}

std::string record_json(const record& r) {
    std::string json = "{";
    for (const text_column& c : text_columns()) {
        const std::string& text = r.*c.member;
        if (!text.empty()) json.append(json.size() == 1 ? "" : ",").append(pair(c.name, text));
    }
    for (std::size_t i = 0; i < column_count; ++i)
        if (r.has(column(i)))
            json.append(",").append(quoted(about(column(i)).name)).append(":").append(number_json(r, column(i)));
    return json + '}';
}

std::string front_json(const plot& p) {
    list members('[');
    for (const plot_point& m : p.front)
        members.add('{' + pair("name", m.name) + ',' + pair("family", m.family) +
                    format(",\"x\":%.6g,\"y\":%.6g}", m.x, m.y));
    return '{' + pair("plot", p.name) + ',' + pair("title", p.title) + ',' + pair("x", p.x.label) + ',' +
           pair("y", p.y.label) + ',' + pair("drawn_for", p.subtitle) + ",\"members\":" + members.text() + '}';
}

}  // namespace

std::string csv_of(const findings& all) {
    std::string text = all.run.partial.empty() ? "" : "# partial: " + all.run.partial + '\n';
    for (const text_column& c : text_columns()) text.append(&c == text_columns().data() ? "" : ",").append(c.name);
    for (std::size_t i = 0; i < column_count; ++i) text.append(",").append(about(column(i)).name);
    text += '\n';
    for (const record& r : all.records) {
        for (const text_column& c : text_columns())
            text.append(&c == text_columns().data() ? "" : ",").append(cell(r.*c.member));
        for (std::size_t i = 0; i < column_count; ++i) text.append(",").append(number_of(r, column(i)));
        text += '\n';
    }
    return text;
}

std::string json_of(const findings& all, const plot_outcome& outcome) {
    list json('{');
    json.add("\"schema\":{" + pair("name", schema_name) + format(",\"version\":%d}", schema_version));
    json.add("\"run\":" + run_json(all, outcome));
    json.add("\"maps\":" + maps_json(all));
    list skipped('['), sections('['), records('['), fronts('[');
    for (const skipped_map& m : all.skipped)
        skipped.add('{' + pair("source", m.source) + ',' + pair("reason", m.reason) + '}');
    for (const section_facts& s : all.sections)
        sections.add('{' + pair("name", s.name) + ',' + pair("title", s.title) + ',' + pair("state", s.state) + '}');
    for (const record& r : all.records) records.add(record_json(r));
    for (const plot& p : outcome.plots)
        if (!p.front.empty()) fronts.add(front_json(p));
    json.add("\"skipped_maps\":" + skipped.text());
    json.add("\"sections\":" + sections.text());
    json.add("\"columns\":" + columns_json());
    json.add("\"records\":" + records.text());
    json.add("\"fronts\":" + fronts.text());
    list checks('[');
    for (const growth_check& c : checks_of_growth(all.records))
        checks.add('{' + pair("check", c.what) +
                   format(",\"value\":%.6g,\"held\":%s}", c.value, c.held() ? "true" : "false"));
    json.add("\"checks\":" + checks.text());
    return json.text() + '\n';
}

}  // namespace examples
