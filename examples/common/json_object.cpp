#include "common/json_object.hpp"

#include <cstddef>

namespace examples::json_file {

// A value as a message shows it: on one line, and not the whole file.
std::string shown(const json& value) {
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > 40) text.replace(37, std::string::npos, "...");
    return text;
}

// The text as a tree. A key that is there twice would count once, and silently.
json parse(const std::string& text, const std::string& name) {
    std::vector<std::set<std::string>> open;
    std::string twice;
    const auto look = [&](int, json::parse_event_t event, json& value) {
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
        throw failure(name + " is no JSON: " + why);
    }
    if (!twice.empty()) throw failure(name + ": \"" + twice + "\" is there twice");
    return all;
}

void require(const bumpshadow::status& s, const std::string& name) {
    if (!s) throw failure(name + ": " + s.message().c_str());
}

}  // namespace examples::json_file
