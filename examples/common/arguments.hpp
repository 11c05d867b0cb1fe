#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/heights.hpp"

namespace examples {

// Checks of one number on the command line; CLI11 puts the option's name before the message.
[[nodiscard]] CLI::Validator finite_number();
[[nodiscard]] CLI::Validator positive_number();  // finite and above zero
[[nodiscard]] CLI::Validator positive_or_infinite_number();
[[nodiscard]] CLI::Validator whole_number(int least, int most);

// An option that takes one of a few words. `value` holds the default and receives the choice.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        std::vector<std::pair<std::string, Value>> words, const std::string& help) {
    std::string list, initial;
    for (const auto& [word, meaning] : words) {
        list += (list.empty() ? "" : ", ") + word;
        if (meaning == value) initial = word;
    }
    const auto find = [words = std::move(words)](const std::string& text) -> const Value* {
        for (const auto& [word, meaning] : words)
            if (word == text) return &meaning;
        return nullptr;
    };
    return app
        .add_option_function<std::string>(
            name, [find, &value](const std::string& text) { value = *find(text); },
            help + ": " + list + " (default " + initial + ")")
        ->check(CLI::Validator(
            [find, list](std::string& text) {
                return find(text) != nullptr ? std::string() : text + " is none of " + list;
            },
            ""));
}

// The options that say what a height map means, the same in every program: --height-scale --texel-size --edge
// --channel --raw --no-data. `scale_help` says what the scale is where none is given.
void add_height_options(CLI::App& app, height_source& source, const std::string& scale_help);

// Reads the command line, runs `work` and turns what is thrown into one line on stderr.
// Exit code: 0, 1 where the work failed, 2 where the command line is wrong.
[[nodiscard]] int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& work);

// Throws failure where something could not be written to standard output.
void flush_stdout();

}  // namespace examples
