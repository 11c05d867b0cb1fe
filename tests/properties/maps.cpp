#include "properties/maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <ostream>
#include <utility>

#include "support/shapes.hpp"

namespace properties {
namespace {

namespace bs = bumpshadow;

constexpr int side = 64;  // features lie within so many texels, and repeat

float height_of(const feature& f, glm::ivec2 extent, int x, int y) {
    const int u = x % side, v = y % side;
    const float h = float(f.height) / 8.0f;
    switch (f.kind) {
        case shape::step: return f.size.x * (u - f.at.x) + f.size.y * (v - f.at.y) >= 0 ? h : 0.0f;
        case shape::wall: return (f.size.x % 2 == 0 ? u == f.at.x : v == f.at.y) ? h : 0.0f;
        case shape::needle: return u == f.at.x && v == f.at.y ? 8.0f * h : 0.0f;
        case shape::plateau:
            return u >= f.at.x && v >= f.at.y && u < f.at.x + f.size.x && v < f.at.y + f.size.y ? h : 0.0f;
        case shape::ramp: return float((f.size.x - 8) * x + (f.size.y - 8) * y) * h / 64.0f;
        case shape::rough: {
            shapes::noise random(std::uint64_t(x) << 40 ^ std::uint64_t(y) << 20 ^ std::uint64_t(f.at.x));
            return std::floor(float(random.uniform()) * 1024.0f) / 1024.0f * h;
        }
        case shape::checkers: return (x + y) % 2 == 0 ? h : 0.0f;
        case shape::waves: {
            const double turn = 2.0 * std::numbers::pi;
            const double angle = turn * (f.size.x * x / double(extent.x) + f.size.y * y / double(extent.y));
            return std::floor(float(std::sin(angle)) * 1024.0f) / 1024.0f * h;
        }
        case shape::hole: break;
    }
    return 0.0f;
}

const char* const shape_names[] = {"step", "wall", "needle", "plateau", "ramp", "rough", "checkers", "waves", "hole"};
const char* const edge_names[] = {"repeat", "clamp", "mirror", "open"};

rc::Gen<feature> any_feature(bool holes) {
    const auto place = [] { return rc::gen::noShrink(rc::gen::inRange(0, 24)); };
    return rc::gen::apply(
        [](int kind, int x, int y, int w, int h, int height) {
            return feature{shape(kind), {x, y}, {w, h}, height};
        },
        rc::gen::resize(100, rc::gen::inRange(0, holes ? 9 : 8)), place(), place(), rc::gen::inRange(1, 16),
        rc::gen::inRange(1, 16), rc::gen::resize(100, rc::gen::inRange(-64, 65)));
}

}  // namespace

const char* name_of(method which) {
    const char* const names[] = {"exact", "cascade", "cascade, 48 steps", "sweep", "sweep-classic", "neighborhood"};
    return names[int(which)];
}

bs::height_map<float> world::view() const {
    bs::height_map<float> map = bs::tight_height_map(samples.data(), extent);
    map.edge = edge;
    map.texel_size = texel_size;
    if (std::find(samples.begin(), samples.end(), hole) != samples.end()) map.no_data = hole;
    return map;
}

void draw(world& w) {
    w.samples.assign(std::size_t(w.extent.x) * std::size_t(w.extent.y), 0.0f);
    for (const feature& f : w.features)
        for (int y = 0; y < w.extent.y; ++y)
            for (int x = 0; x < w.extent.x; ++x)
                if (f.kind != shape::hole)
                    w.at(x, y) += height_of(f, w.extent, x, y);
                else if (x % side == f.at.x && y % side >= f.at.y && y % side < f.at.y + f.size.y)
                    w.at(x, y) = hole;
    // What was added to a hole afterwards.
    for (float& h : w.samples)
        if (h < -4000.0f) h = hole;
}

void showValue(const feature& f, std::ostream& out) {
    out << shape_names[int(f.kind)] << " at " << f.at.x << ' ' << f.at.y << " size " << f.size.x << ' ' << f.size.y
        << " height " << f.height << "/8";
}

void showValue(const world& w, std::ostream& out) {
    out << w.extent.x << " x " << w.extent.y << ' ' << edge_names[int(w.edge)] << " texels " << w.texel_size.x << ' '
        << w.texel_size.y;
    for (const feature& f : w.features) {
        out << "\n  ";
        showValue(f, out);
    }
}

rc::Gen<world> any_world(const limits& of) {
    const std::vector<bs::edge_mode> edges = of.endless ? std::vector{bs::edge_mode::repeat, bs::edge_mode::clamp,
                                                                      bs::edge_mode::mirror, bs::edge_mode::open}
                                                        : std::vector{bs::edge_mode::clamp, bs::edge_mode::open};
    const std::vector<glm::dvec2> sizes =
        of.square ? std::vector<glm::dvec2>{{1.0, 1.0}}
                  : std::vector<glm::dvec2>{{1.0, 1.0}, {0.915, 1.319}, {3.0, 1.0}, {0.125, 0.5}};
    const auto any_of = [](std::size_t count) { return rc::gen::resize(100, rc::gen::inRange<std::size_t>(0, count)); };
    return rc::gen::apply(
        [edges, sizes](int width, int height, const std::vector<feature>& features, std::size_t edge,
                       std::size_t size) {
            world w{{width, height}, features, edges[edge], sizes[size], {}};
            draw(w);
            return w;
        },
        rc::gen::inRange(1, of.extent.x + 1), rc::gen::inRange(1, of.extent.y + 1),
        rc::gen::resize(8, rc::gen::container<std::vector<feature>>(rc::gen::resize(100, any_feature(of.holes)))),
        any_of(edges.size()), any_of(sizes.size()));
}

rc::Gen<list> any_directions(std::size_t count, bool whole_numbers) {
    const auto number = [] { return rc::gen::resize(100, rc::gen::inRange(-9, 10)); };
    const auto one = rc::gen::apply(
        [whole_numbers](int kind, int x, int y) {
            glm::dvec2 d(x, y);
            if (x == 0 && y == 0) d = {1.0, 0.0};
            if (whole_numbers || kind < 3) return d;
            if (kind == 3) return glm::dvec2(d.x + 1e-7 * d.y, d.y);
            return shapes::direction((x + 9) * 0.0525 + (y + 9) * 0.00271);
        },
        rc::gen::inRange(0, 5), number(), number());
    return rc::gen::container<list>(count, one);
}

void* filling::do_allocate(std::size_t bytes, std::size_t alignment) {
    void* const block = std::pmr::new_delete_resource()->allocate(bytes, alignment);
    std::memset(block, value_, bytes);
    return block;
}
void filling::do_deallocate(void* block, std::size_t bytes, std::size_t alignment) {
    std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
}

bs::bake_options allowed(method which, bs::bake_options options) {
    if (which == method::fine) options.steps = 48;
    if (which == method::exact || which == method::cascade || which == method::fine) return options;
    options.curvature = {0.0, 0.0};
    if (which != method::neighborhood) options.radius = bs::bake_options{}.radius;
    return options;
}

std::size_t differing(const slopes& a, const slopes& b) {
    RC_ASSERT(a.size() == b.size());
    std::size_t count = 0;
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bit for bit
    for (std::size_t i = 0; i < a.size(); ++i) count += std::memcmp(&a[i], &b[i], sizeof(float)) != 0 ? 1 : 0;
    return count;
}

double degrees(float slope) { return std::atan(double(slope)) * 180.0 / std::numbers::pi; }

bool holds(const std::string& name, const std::function<void()>& property) { return rc::check(name, property); }

}  // namespace properties
