#pragma once

#include <cstddef>
#include <exception>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

#include "encodings/sample.hpp"

namespace examples {

// work(i) for i from 0 to count - 1 on all cores; what is thrown there is thrown here.
template <class Work>
void on_all_cores(std::size_t count, const Work& work) {
    std::vector<std::exception_ptr> errors(count);
    bumpshadow::threads()(count, [&](std::size_t i) {
        try {
            work(i);
        } catch (...) {
            errors[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
}

// One map an item on all cores, work(map); what is thrown there is thrown here.
template <class Work>
auto each_map(std::span<const sample_map> maps, const Work& work) {
    std::vector<std::invoke_result_t<const Work&, const sample_map&>> results(maps.size());
    std::vector<std::string> errors(maps.size());
    bumpshadow::threads()(maps.size(), [&](std::size_t i) {
        try {
            results[i] = work(maps[i]);
        } catch (const std::exception& error) {
            errors[i] = maps[i].name + ": " + error.what();
        }
    });
    for (const std::string& error : errors)
        if (!error.empty()) throw failure(error);
    return results;
}

// A texture and its bytes.
struct stored {
    std::vector<std::byte> bytes;
    bumpshadow::texture_layout layout;

    explicit stored(const bumpshadow::texture_layout& l) : bytes(l.required_size()), layout(l) {}
    [[nodiscard]] bumpshadow::texture view() { return {bytes, layout}; }
    [[nodiscard]] bumpshadow::const_texture view() const { return {bytes, layout}; }
};

// What filtering gives at the center of every texel of a map of that extent, for a layer of an array or a slice of a
// volume.
[[nodiscard]] std::vector<glm::vec4> texel_centers(const stored& texture, int index, glm::ivec2 extent);

// The shader's bearing of a direction.
[[nodiscard]] float shader_bearing(bumpshadow::bearing_function function, glm::dvec2 direction);

// For the table: "slope", and ", to 4" where something but infinity stands for 1.
[[nodiscard]] const char* name_of(bumpshadow::quantity stored);
[[nodiscard]] std::string name_of_limit(const bumpshadow::horizon_scale& scale);

}  // namespace examples
