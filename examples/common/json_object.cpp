#include "common/json_object.hpp"

#include <cstddef>

namespace examples::json_file {

// A value as a message shows it: on one line, and not the whole file.
std::string shown(const json& value) {
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > 40) text.replace(37, std::string::npos, "...");
    return text;
}

// The text as a tree. A key that is there twice would count once, and silently. What is nested deeply would be shown by
// as many calls in each other.
json parse(const std::string& text, const std::string& name) {
    constexpr int most_depth = 64;
    std::vector<std::set<std::string>> open;
    std::string twice;
    bool deep = false;
    const auto look = [&](int depth, json::parse_event_t event, json& value) {
        deep = deep || depth > most_depth;
        if (event == json::parse_event_t::object_start) open.emplace_back();
        if (event == json::parse_event_t::object_end) open.pop_back();
        if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
            twice = value.get<std::string>();
        return true;
    };
    json all;
    try {
        all = json::parse(text, look);
    } catch (const json::exception& error) {
        std::string why = error.what();
        // What comes before says where the library found it, in its own words.
        if (const std::size_t at = why.find("] "); at != std::string::npos) why.erase(0, at + 2);
        for (char& c : why)
            if (c == '\n' || c == '\r') c = ' ';
        if (why.size() > 300) why.replace(297, std::string::npos, "...");
        throw failure(name + " is no JSON: " + why);
    }
    if (deep)
        throw failure(name + ": lists and objects in each other, more than " + std::to_string(most_depth) + " deep");
    if (!twice.empty()) throw failure(name + ": " + shown(twice) + " is there twice");
    return all;
}

void require(const bumpshadow::status& s, const std::string& name) {
    if (!s) throw failure(name + ": " + s.message().c_str());
}

}  // namespace examples::json_file
