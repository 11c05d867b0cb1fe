#include "report/gpu.hpp"

#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

#include "common/file.hpp"
#include "common/tool.hpp"

namespace examples {
namespace {

// The text between the quotes that follow `key`; `at` moves behind it.
std::string text_after(std::string_view json, std::string_view key, std::size_t& at) {
    const std::size_t first = json.find(key, at);
    if (first == std::string_view::npos) return {};
    const std::size_t start = first + key.size(), end = json.find('"', start);
    if (end == std::string_view::npos) return {};
    at = end;
    return std::string(json.substr(start, end - start));
}

// shader_cost writes one shader a line, always in this form; its names hold no quotes.
std::map<std::string, double> read_costs(std::string_view json) {
    std::map<std::string, double> costs;
    constexpr std::string_view group = "{\"group\":\"", figure = "\"inverse_throughput\":";
    for (std::size_t at = json.find(group); at != std::string_view::npos; at = json.find(group, at)) {
        std::string name = text_after(json, group, at);
        name.append(", ").append(text_after(json, "\"name\":\"", at));
        const std::size_t family = json.find("\"navi21\":", at), value = json.find(figure, family);
        if (family == std::string_view::npos || value == std::string_view::npos) break;
        costs[name] = std::atof(std::string(json.substr(value + figure.size(), 16)).c_str());
    }
    return costs;
}

}  // namespace

gpu_costs measure_gpu_costs(const std::filesystem::path& program, const std::filesystem::path& json) {
    std::error_code ignored;
    std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    if (self.empty()) self = program;
    const std::filesystem::path tool = self.parent_path() / "shader_cost";
    if (!std::filesystem::is_regular_file(tool, ignored))
        return {{}, "not measured: the program shader_cost does not lie beside this one"};
    if (!run_tool(tool.string(), {"--json", json.string()})) return {{}, "not measured: shader_cost failed"};
    const std::vector<unsigned char> bytes = read_file(json);
    gpu_costs costs{read_costs({reinterpret_cast<const char*>(bytes.data()), bytes.size()}), {}};
    costs.about = costs.cycles.empty() ? "not measured: shader_cost printed no costs"
                                       : "by shader_cost, all figures in shader_cost.json";
    return costs;
}

}  // namespace examples
