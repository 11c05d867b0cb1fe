#pragma once

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <bumpshadow/status.hpp>

#include "common/file.hpp"

// Files of JSON, read so that whatever does not belong there is named. For the sources that read them.

namespace examples::json_file {

using nlohmann::json;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// A value as a message shows it: on one line, and not the whole file.
[[nodiscard]] std::string shown(const json& value);

// The text as a tree. Throws failure, also where an object has a key twice.
[[nodiscard]] json parse(const std::string& text, const std::string& name);

// What a file says that the library refuses.
void require(const bumpshadow::status& s, const std::string& name);

// An object of the file, and what is taken from it. Members throw failure.
class object {
public:
    object(const json& value, std::string file, std::string path)
        : value_(value), file_(std::move(file)), path_(std::move(path)) {
        if (!value.is_object()) throw failure(where() + " has to be an object {...}, not " + shown(value));
    }

    [[nodiscard]] bool has(const char* key) {
        known_.insert(key);
        return value_.contains(key);
    }
    [[nodiscard]] const json& at(const char* key) {
        if (!has(key)) throw failure(where() + " has no \"" + key + "\"");
        return value_[key];
    }
    [[nodiscard]] object inside(const char* key) { return {at(key), file_, path_of(key)}; }

    // A number; infinite where null may stand for it.
    [[nodiscard]] double number(const char* key, bool or_null = false) {
        const json& v = at(key);
        if (or_null && v.is_null()) return infinity;
        if (!v.is_number()) refuse(key, or_null ? "a number or null" : "a number");
        const double n = v.get<double>();
        if (!std::isfinite(n)) refuse(key, "finite");
        return n;
    }
    [[nodiscard]] int whole(const char* key, int least, int most) {
        const json& v = at(key);
        if (!v.is_number_integer() || v.get<double>() < least || v.get<double>() > most) {
            std::string what = "a whole number from ";
            what += std::to_string(least);
            what += " to ";
            what += std::to_string(most);
            refuse(key, what);
        }
        return v.get<int>();
    }
    [[nodiscard]] bool truth(const char* key) {
        const json& v = at(key);
        if (!v.is_boolean()) refuse(key, "true or false");
        return v.get<bool>();
    }
    [[nodiscard]] std::string word(const char* key) {
        const json& v = at(key);
        if (!v.is_string()) refuse(key, "a text");
        return v.get<std::string>();
    }
    template <class Value>
    [[nodiscard]] Value choice(const char* key, const std::vector<std::pair<std::string, Value>>& words) {
        std::string all;
        for (const auto& [name, meaning] : words) {
            all += all.empty() ? "one of " : ", ";
            all += name;
            if (at(key).is_string() && at(key).get<std::string>() == name) return meaning;
        }
        refuse(key, all);
    }
    // A list that is not empty.
    [[nodiscard]] const json& list(const char* key) {
        const json& v = at(key);
        if (!v.is_array()) refuse(key, "a list [...]");
        if (v.empty()) refuse(key, "a list with something in it");
        return v;
    }
    [[nodiscard]] std::pair<double, double> range(const char* key) {
        const json& v = at(key);
        if (!v.is_array() || v.size() != 2 || !v[0].is_number() || !v[1].is_number()) refuse(key, "two numbers [a, b]");
        return {v[0].get<double>(), v[1].get<double>()};
    }

    // Refuses keys that were not asked for.
    void end() const {
        for (const auto& [key, value] : value_.items())
            if (!known_.contains(key))
                throw failure(where() + " has an unknown key " + shown(key) + ": " + shown(value));
    }
    [[noreturn]] void refuse(const char* key, const std::string& wanted) {
        throw failure(file_ + ": " + path_of(key) + " is " + shown(at(key)) + ", but has to be " + wanted);
    }
    [[nodiscard]] std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

private:
    [[nodiscard]] std::string where() const { return path_.empty() ? file_ : file_ + ": " + path_; }

    const json& value_;
    std::string file_, path_;
    std::set<std::string> known_;
};

}  // namespace examples::json_file
