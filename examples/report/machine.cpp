#include "report/machine.hpp"

#include <array>
#include <cstddef>
#include <ctime>
#include <fstream>

#ifdef __APPLE__
#include <sys/sysctl.h>
#endif

namespace examples {

std::string processor_name() {
#ifdef __APPLE__
    std::array<char, 256> name{};
    std::size_t size = name.size() - 1;
    if (sysctlbyname("machdep.cpu.brand_string", name.data(), &size, nullptr, 0) == 0) return name.data();
#else
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
#endif
    return "processor not known";
}

std::string date_text() {
    const std::time_t now = std::time(nullptr);
    std::array<char, 32> text{};
    // No other thread asks for the time.
    const std::tm* const utc = std::gmtime(&now);
    return utc != nullptr && std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", utc) > 0 ? text.data() : "";
}

}  // namespace examples
