#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// What shader text defines, and what it uses: a scan that knows nothing of the tool that wrote the text.
namespace scan {

// GLSL or HLSL without its comments.
[[nodiscard]] inline std::string without_comments(std::string_view text) {
    std::string code;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.substr(i, 2) == "//") i = std::min(text.find('\n', i), text.size());
        if (i < text.size()) code += text[i];
    }
    return code;
}

[[nodiscard]] inline bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Words, numbers included, and every other character but white space for itself.
[[nodiscard]] inline std::vector<std::string> tokens_of(std::string_view code) {
    std::vector<std::string> tokens;
    for (std::size_t i = 0; i < code.size();) {
        std::size_t end = i + 1;
        if (in_word(code[i]))
            while (end < code.size() && in_word(code[end])) ++end;
        if (std::isspace(static_cast<unsigned char>(code[i])) == 0) tokens.emplace_back(code.substr(i, end - i));
        i = end;
    }
    return tokens;
}

enum class kind : unsigned char { macro, function, structure, variable, block };

struct definition {
    kind what;
    std::string name;
    std::vector<std::string> tokens;  // all of it
};

// What text defines outside of functions, in its order; all branches of #if count. What a block of GLSL or a cbuffer
// holds counts as variables.
[[nodiscard]] inline std::vector<definition> definitions_of(std::string_view text) {
    std::vector<definition> found;
    std::string code;
    const std::string stripped = without_comments(text);
    for (std::size_t i = 0; i < stripped.size();) {
        const std::size_t end = std::min(stripped.find('\n', i), stripped.size() - 1) + 1;
        const std::string line = stripped.substr(i, end - i);
        const std::size_t first = line.find_first_not_of(" \t");
        if (first == std::string::npos || line[first] != '#') {
            code += line;
        } else {
            std::vector<std::string> tokens = tokens_of(line);
            if (tokens.size() > 2 && tokens[1] == "define") found.push_back({kind::macro, tokens[2], tokens});
        }
        i = end;
    }
    int depth = 0;
    std::vector<std::string> statement;
    const auto close = [&] {
        const auto at = [&](const char* token) { return std::find(statement.begin(), statement.end(), token); };
        // What is said about what follows: layout(...), [...].
        while (!statement.empty() && (statement[0] == "layout" || statement[0] == "["))
            statement.erase(statement.begin(), at(statement[0] == "[" ? "]" : ")") + 1);
        const auto open = at("{");
        if (statement.size() < 2 || statement[0] == "precision" || statement[0] == "in") {
            // Nothing that has a name; the semicolon after a structure.
        } else if (statement[0] == "struct") {
            found.push_back({kind::structure, statement[1], statement});
        } else if (statement[0] == "cbuffer" || (open < at("(") && open < at("="))) {
            found.push_back({kind::block, statement[0] == "cbuffer" ? statement[1] : *(open - 1), statement});
            for (auto i = open + 1; i < statement.end(); ++i)
                if ((*i == ";" || *i == "," || *i == "[") && *(i - 1) != "]")
                    found.push_back({kind::variable, *(i - 1), {*(i - 1)}});
        } else if (at("{") != statement.end() && at("(") < at("{")) {
            found.push_back({kind::function, *(at("(") - 1), statement});
        } else {
            const auto end = std::min({at("="), at("["), at(":"), at(";")});
            found.push_back({kind::variable, *(end - 1), statement});
        }
        statement.clear();
    };
    for (const std::string& token : tokens_of(code)) {
        statement.push_back(token);
        if (token == "{") ++depth;
        if (token == "}") --depth;
        if (depth == 0 && (token == ";" || token == "}")) close();
    }
    return found;
}

// Definitions that `roots` do not reach, by name.
[[nodiscard]] inline std::vector<std::string> not_called(const std::vector<definition>& all,
                                                         const std::vector<std::string>& roots) {
    std::vector<std::string> reached = roots, rest;
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const definition& d : all)
            if (d.name == reached[i])
                for (const std::string& token : d.tokens)
                    if (std::find(reached.begin(), reached.end(), token) == reached.end()) reached.push_back(token);
    for (const definition& d : all)
        if (std::find(reached.begin(), reached.end(), d.name) == reached.end()) rest.push_back(d.name);
    return rest;
}

}  // namespace scan
