#include "shade/sheets.hpp"

#include <span>

#include <bumpshadow/factor_cube.hpp>

#include "common/picture.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

constexpr int gap = 8;

image8 draw_cube() {
    const bs::factor_cube cube = bs::factor_cube_as_published();
    owned_texture t(layout_of(cube));
    if (const bs::status s = write_factor_cube(cube, t.view()); !s) throw failure(s.message().c_str());
    // The cross: +y above +z, -y below, -x +z +x -z in a row. Alpha has one of its own.
    constexpr int places[6][2] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};
    constexpr int zoom = 8;
    const int side = cube.size * zoom;
    std::vector<image8> crosses;
    for (const bool alpha : {false, true}) {
        image8 cross(glm::ivec2(4 * side, 3 * side), 3);
        for (int face = 0; face < 6; ++face) {
            const std::byte* const from = t.view().slice(face, 0);
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    for (int c = 0; c < 3; ++c)
                        cross.at(places[face][0] * side + x, places[face][1] * side + y)[c] =
                            std::to_integer<std::uint8_t>(
                                from[4 * (y / zoom * cube.size + x / zoom) + (alpha ? 3 : c)]);
        }
        crosses.push_back(std::move(cross));
    }
    return sheet(crosses, 2, gap);
}

}  // namespace

const std::vector<std::pair<std::string, sheet_kind>>& sheet_names() {
    static const std::vector<std::pair<std::string, sheet_kind>> names{{"bearings", sheet_kind::bearings},
                                                                       {"turning", sheet_kind::turning},
                                                                       {"cube", sheet_kind::cube},
                                                                       {"edges", sheet_kind::edges},
                                                                       {"emboss", sheet_kind::emboss}};
    return names;
}

image8 draw_sheet(sheet_kind kind, const scene& scene, const encoding_settings& settings, double azimuth,
                  double elevation, bool factor) {
    const glm::vec3 light = light_direction(azimuth, elevation);
    std::vector<image8> pictures;
    switch (kind) {
        case sheet_kind::bearings: {
            encoding_settings each = settings;
            each.kind = encoding_kind::tangent;
            for (const int bearings : {4, 8, 16, 32}) {
                each.bearings = bearings;
                pictures.push_back(draw(scene, prepare(scene, each), light, factor));
            }
            each.kind = encoding_kind::traced;
            pictures.push_back(draw(scene, prepare(scene, each), light, factor));
            return sheet(pictures, 5, gap);
        }
        case sheet_kind::turning: {
            const shown what = prepare(scene, settings);
            for (int i = -4; i <= 4; ++i)
                pictures.push_back(draw(scene, what, light_direction(azimuth + 15.0 * i, elevation), factor));
            return sheet(pictures, 3, gap);
        }
        case sheet_kind::edges: {
            const shown what = prepare(scene, settings);
            examples::scene each = scene;
            each.edge = bs::shadow_edge{};
            pictures.push_back(draw(each, what, light, factor));
            each.edge = bs::shadow_edge{8.0f, 1.0f};
            pictures.push_back(draw(each, what, light, factor));
            return sheet(pictures, 2, gap);
        }
        case sheet_kind::emboss: {
            encoding_settings each = settings;
            each.kind = encoding_kind::emboss;
            each.bits = stored_bits::eight;
            each.reduce = 1;
            return sheet(draw_emboss_figures(scene, *prepare(scene, each).map, light), 5, gap);
        }
        case sheet_kind::cube: break;
    }
    return draw_cube();
}

}  // namespace examples
