#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace examples {

// What the RADV compiler says about a compute shader, waves of 64.
struct cost {
    int instructions = 0;
    int inverse_throughput = 0;  // cycles a wave, with as many waves in flight as registers allow
    int latency = 0;             // cycles of a wave alone
    int vgprs = 0, sgprs = 0;    // registers that a wave is given
};

// A family of GPUs, and its name in the driver.
struct family {
    std::string name, title;
};

// The RADV driver for a family, without hardware: RADV_FORCE_FAMILY makes it compile for a device that is not there.
class compiler {
public:
    // icd: manifest of the driver for the Vulkan loader. Throws failure where there is none.
    compiler(const family& target, const std::string& icd);
    ~compiler();
    compiler(const compiler&) = delete;
    compiler& operator=(const compiler&) = delete;

    // Seven textures at bindings 0 to 6, a buffer at 7, 128 bytes of push constants. Throws failure.
    [[nodiscard]] cost measure(std::span<const std::uint32_t> spirv) const;

private:
    struct state;
    std::unique_ptr<state> state_;
};

// The first manifest of RADV in the usual folders. Throws failure.
[[nodiscard]] std::string find_icd();

}  // namespace examples
