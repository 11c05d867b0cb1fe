#pragma once

#include <string>
#include <vector>

namespace examples {

// What the page says; all of it plain text.
struct page_facts {
    std::string map;   // name of the height map
    std::string bake;  // one sentence each
    std::string error;
    bool magnified = false;    // show texels as squares: the map is tiny
    std::string side_by_side;  // file names from here on, relative to the page
    std::vector<std::string> stills;
    std::vector<std::string> still_captions;
    std::vector<std::string> frames;
    std::string contact_sheet;
    std::string heights;
    std::string slices;
};

// index.html: pictures with captions; needs nothing but the files named above.
[[nodiscard]] std::string make_page(const page_facts& facts);

}  // namespace examples
