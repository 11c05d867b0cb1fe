#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace examples {

// What the program shader_cost says: inverse throughput on RDNA2, less the empty shader, by "group, name".
struct gpu_costs {
    std::map<std::string, double> cycles;
    std::string about;  // for a reader: where they are from, or why there are none
};

// Runs the shader_cost that lies beside this program; its figures stay in `json`.
[[nodiscard]] gpu_costs measure_gpu_costs(const std::filesystem::path& program, const std::filesystem::path& json);

}  // namespace examples
