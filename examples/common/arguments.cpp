#include "common/arguments.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <utility>

#ifdef _WIN32
#include <windows.h>

#include <shellapi.h>
#endif

namespace examples {
namespace {

void parse(CLI::App& app, [[maybe_unused]] int argc, [[maybe_unused]] char** argv) {
#ifdef _WIN32
    app.allow_windows_style_options(false);  // /heights.png is a file here, too
    // argv has lost what the code page of the machine lacks; paths of the standard library are made from UTF-8.
    wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &argc);
    std::vector<std::string> arguments;  // the last one first, which is how CLI11 wants them
    for (int i = argc; --i > 0;) {
        const int size = WideCharToMultiByte(CP_UTF8, 0, words[i], -1, nullptr, 0, nullptr, nullptr);
        std::string word(std::size_t(size), '\0');
        WideCharToMultiByte(CP_UTF8, 0, words[i], -1, word.data(), size, nullptr, nullptr);
        word.pop_back();
        arguments.push_back(word);
    }
    LocalFree(words);
    SetConsoleOutputCP(CP_UTF8);
    app.parse(std::move(arguments));
#else
    app.parse(argc, argv);
#endif
}

// What a script whose variable is not set gives: no option is left out without a word.
void refuse_empty(const CLI::App& app) {
    for (const CLI::Option* const option : app.get_options())
        for (const std::string& text : option->results())
            if (text.empty()) throw CLI::ValidationError(option->get_name(), "'' is given, which is empty");
}

int run_work(const char* name, const std::function<void()>& work) {
    try {
        work();
        return 0;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: not enough memory\n", name);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
    }
    return 1;
}

// The whole text as a number, or false.
bool to_number(const std::string& text, double& number) {
    char* end = nullptr;
    number = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0';
}

template <class Test>
CLI::Validator number_that(const char* need, Test test) {
    return {[need, test](std::string& text) {
                double number = 0.0;
                if (!to_number(text, number)) return "'" + text + "' is not a number";
                return test(number) ? std::string() : text + " is given, but it has to be " + need;
            },
            ""};
}

}  // namespace

CLI::Validator finite_number() {
    return number_that("finite", [](double v) { return std::isfinite(v); });
}

CLI::Validator positive_number() {
    return number_that("positive and finite", [](double v) { return std::isfinite(v) && v > 0.0; });
}

CLI::Validator positive_or_infinite_number() {
    return number_that("positive", [](double v) { return v > 0.0; });
}

CLI::Validator whole_number(int least, int most) {
    return {[least, most](std::string& text) {
                double number = 0.0;
                if (!to_number(text, number) || number != std::floor(number))
                    return "'" + text + "' is not a whole number";
                if (number < least || number > most)
                    return text + " is given, but it has to be from " + std::to_string(least) + " to " +
                           std::to_string(most);
                text = std::to_string(int(number));
                return std::string();
            },
            ""};
}

void add_height_options(CLI::App& app, height_source& source, const std::string& scale_help) {
    using bumpshadow::edge_mode;
    app.add_option("--height-scale", source.height_scale,
                   "height of the largest sample value (raw: of sample value 1), in the unit of --texel-size; "
                   "negative turns a depth map over; " +
                       scale_help)
        ->check(finite_number())
        ->type_name("S");
    app.add_option_function<std::pair<double, double>>(
           "--texel-size",
           [&source](const auto& size) {
               source.texel_size = {size.first, size.second};
           },
           "distance of texels along x and y (default 1 1)")
        ->check(positive_number())
        ->type_name("X Y");
    add_choice<edge_mode>(app, "--edge", source.edge,
                          {{"repeat", edge_mode::repeat},
                           {"clamp", edge_mode::clamp},
                           {"mirror", edge_mode::mirror},
                           {"open", edge_mode::open}},
                          "what lies beyond the border")
        ->type_name("EDGE");
    CLI::Option* from =
        add_choice<channel>(app, "--channel", source.from,
                            {{"luminance", channel::luminance},
                             {"red", channel::red},
                             {"green", channel::green},
                             {"blue", channel::blue},
                             {"alpha", channel::alpha}},
                            "channel of a color image that is the height (luminance has Rec. 709 weights)")
            ->type_name("CHANNEL");
    app.add_option_function<std::pair<int, int>>(
           "--raw", [&source](const auto& extent) { source.raw = glm::ivec2(extent.first, extent.second); },
           "HEIGHTS is W x H bare little-endian float32 values, row by row")
        ->check(whole_number(1, 1 << 24))
        ->excludes(from)
        ->type_name("W H");
    app.add_option("--no-data", source.no_data, "sample value (or nan) that marks a hole in the map")
        ->check(number_that("a number", [](double) { return true; }))
        ->type_name("VALUE");
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& work) {
    const char* name = app.get_name().c_str();
    try {
        parse(app, argc, argv);
        refuse_empty(app);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            app.exit(error);
            return run_work(name, flush_stdout);
        }
        std::fprintf(stderr, "%s: %s (%s --help lists the options)\n", name, error.what(), name);
        return 2;
    }
    return run_work(name, work);
}

void flush_stdout() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw failure("cannot write to standard output");
}

}  // namespace examples
