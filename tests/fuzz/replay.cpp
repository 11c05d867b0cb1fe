// Runs a fuzz target over all files of a folder and over random inputs: what every build tests.
//   fuzz_NAME_replay FOLDER_OR_FILE...

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

namespace fs = std::filesystem;

constexpr int random_inputs = 300;
constexpr int longest = 600;  // bytes

std::vector<fs::path> files_of(const fs::path& place) {
    if (!fs::is_directory(place)) return {place};
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(place)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

int main(int count, char** arguments) {
    std::size_t replayed = 0;
    for (int i = 1; i < count; ++i)
        for (const fs::path& path : files_of(arguments[i])) {
            std::ifstream file(path, std::ios::binary);
            if (!file) {
                std::fprintf(stderr, "cannot read %s\n", path.string().c_str());
                return 1;
            }
            const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
            // Said before, since a finding ends the program.
            std::printf("%s\n", path.filename().string().c_str());
            std::fflush(stdout);
            LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
            ++replayed;
        }
    std::mt19937 random(1);  // its numbers are the same everywhere
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < random_inputs; ++i) {
        std::printf("random input %d\n", i);
        std::fflush(stdout);
        bytes.resize(random() % longest);
        for (std::uint8_t& byte : bytes) byte = std::uint8_t(random() >> 24);
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
    std::printf("%zu files and %d random inputs without a finding\n", replayed, random_inputs);
    if (count > 1 && replayed == 0) {
        std::fprintf(stderr, "no files\n");
        return 1;
    }
    return 0;
}
