#include "plan/proof.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <utility>

#include <bumpshadow/horizon_map.hpp>

#include "common/file.hpp"
#include "common/manifest.hpp"
#include "common/recipe.hpp"
#include "common/report_text.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

constexpr std::uint32_t measuring_seed = 20, plan_maps_side = 1024;

// Of the processor, so that other programs do not count.
double seconds() { return double(std::clock()) / double(CLOCKS_PER_SEC); }

struct proof_scene {
    const char* name;
    planned_scene lights;
};

std::vector<proof_scene> scenes_for(glm::ivec2 extent, glm::dvec2 texel_size) {
    const auto sun = [](double azimuth, double elevation) {
        const double a = azimuth * std::numbers::pi / 180.0, e = elevation * std::numbers::pi / 180.0;
        return glm::dvec3(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
    };
    std::vector<proof_scene> all;
    const auto add = [&](const char* name, double mismatch) -> planned_scene& {
        all.push_back({name, {}});
        all.back().lights.limits.mismatch = mismatch;
        return all.back().lights;
    };
    add("fixed sun", 0.005).lights = {sun(140.0, 35.0)};
    add("sun path", 0.015).limits.arc = {0.25, 0.75, 5.0, 60.0};
    add("free light", 0.015);
    add("free light", 0.03);
    const glm::dvec2 middle = 0.5 * glm::dvec2(extent) * texel_size;
    const double width = extent.x * texel_size.x;
    planned_scene& torch = add("torch", 0.02);
    for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(-1, 0), glm::dvec2(0, -1)})
        torch.positions.emplace_back(middle + 0.5 * width * way, 0.2 * width);
    add("distant view", 0.03).limits.texels_per_pixel = 8.0;
    return all;
}

set_up_figures figures_of(const encoded& map, const bs::recipe& r) {
    set_up_figures f;
    f.bytes = double(map.textures[0].bytes.size()) / (double(map.extent.x) * map.extent.y);
    f.gpu_cost = bs::gpu_cost_of(r.encoding, r.taps);
    f.fetches = fetches(r.encoding) * r.taps * r.taps;
    return f;
}

// What a map costs that nobody planned for.
struct usual_map {
    bs::recipe how;
    encoded map;
    set_up_figures figures;
    double sixteen_seconds = 0.0;

    usual_map(const height_samples& samples, const height_source& source) {
        how.encoding.slices.count = 16;
        how.directions = 16;
        double start = seconds();
        static_cast<void>(bake_for(samples, source, how, 1));
        sixteen_seconds = seconds() - start;
        how.directions = 64;
        start = seconds();
        recipe_horizons horizons = bake_for(samples, source, how, 1);
        const double bake = seconds() - start;
        how.encoding.scale.max_slope = bs::suggest_max_slope(horizons.map);
        start = seconds();
        map = pack_for(std::move(horizons), how, samples.extent, 1);
        const double pack = seconds() - start;
        figures = figures_of(map, how);
        figures.bake_seconds = bake;
        figures.pack_seconds = pack;
    }
};

std::string percent(double share) { return format("%.2f", 100.0 * share); }

std::vector<proof_line> lines_of(const std::vector<proof_row>& rows) {
    double bytes = 0.0, bake = 0.0, work = 0.0, slowest = 0.0, most = 0.0;
    const proof_row* worst = &rows.front();
    std::size_t agreeing = 0, given_up = 0;
    for (const proof_row& row : rows) {
        bytes += row.bytes_saved() / double(rows.size());
        bake += row.bake_saved() / double(rows.size());
        work += row.work_saved() / double(rows.size());
        agreeing += row.agrees() ? 1u : 0u;
        given_up += row.plan.how.obstacle != bs::plan_obstacle::none ? 1u : 0u;
        if (row.excess() > worst->excess()) worst = &row;
        if (row.extent != glm::ivec2(plan_maps_side)) continue;
        slowest = std::max(slowest, row.plan.plan_seconds);
        most = std::max(most, row.plan.plan_seconds / row.sixteen_seconds);
    }
    std::vector<proof_line> lines;
    lines.push_back({format("saves at least 60 %% of the bytes: %.1f %%", 100.0 * bytes), bytes >= 0.6});
    lines.push_back({format("saves at least 40 %% of the bake time: %.1f %% (of bake and packing: %.1f %%)",
                            100.0 * bake, 100.0 * work),
                     bake >= 0.4});
    lines.push_back({format("never exceeds the asked error by more than a tenth: at most by %.0f %% (%s, %s: %.2f "
                            "+- %.2f %%, asked %.2f %%; plan says it cannot meet it in %zu rows)",
                            100.0 * worst->excess(), worst->scene.c_str(), worst->map.c_str(),
                            100.0 * worst->plan.figures.error.mismatch, 100.0 * worst->plan.figures.error.interval,
                            100.0 * worst->asked, given_up),
                     worst->excess() <= 0.1});
    lines.push_back({format("predicted error within 20 %% or 0.1 percentage points of the measured one: in %zu of %zu "
                            "rows",
                            agreeing, rows.size()),
                     agreeing == rows.size()});
    lines.push_back(
        {format("plans for 1024 x 1024 texels in less than 0.5 s: at most %.2f s, %.1f times the bake of 16 "
                "bearings",
                slowest, most),
         slowest < 0.5});
    return lines;
}

std::string json_of(const set_up_figures& f) {
    return format(
        "{\"mismatch\":%.9g,\"interval\":%.9g,\"bytes\":%.9g,\"bake_seconds\":%.6f,\"pack_seconds\":%.6f,"
        "\"gpu_cost\":%.9g,\"fetches\":%d}",
        f.error.mismatch, f.error.interval, f.bytes, f.bake_seconds, f.pack_seconds, f.gpu_cost, f.fetches);
}

}  // namespace

bool proof_row::agrees() const {
    const double measured = plan.figures.error.mismatch;
    return std::abs(plan.how.predicted.mismatch - measured) <= std::max(0.001, 0.2 * measured);
}

double proof_row::work_saved() const {
    return 1.0 - (plan.figures.bake_seconds + plan.figures.pack_seconds) / (usual.bake_seconds + usual.pack_seconds);
}

planned_map plan_map(const height_samples& samples, const height_source& source, const bs::scene& wanted,
                     const lit_pixels* measure) {
    planned_map one;
    double start = seconds();
    one.how = plan_for(samples, source, wanted);
    one.plan_seconds = seconds() - start;
    if (measure == nullptr) return one;
    if (!one.how.shadows) {
        one.figures.error = measure->without_shadows();
        return one;
    }
    start = seconds();
    recipe_horizons horizons = bake_for(samples, source, one.how, 1);
    const double bake = seconds() - start;
    start = seconds();
    const encoded map = pack_for(std::move(horizons), one.how, samples.extent, 1);
    const double pack = seconds() - start;
    one.figures = figures_of(map, one.how);
    one.figures.bake_seconds = bake;
    one.figures.pack_seconds = pack;
    one.figures.error = measure->of(map, one.how.edge, one.how.taps);
    return one;
}

proof run_proof() {
    std::vector<height_source> maps = known_maps({"acg_Bricks059", "acg_RoofingTiles013A", "dx_stones", "dx_rocks",
                                                  "pk01_floor01", "ogre_Rock20", "dem_jacksboro"});
    if (maps.empty())
        throw failure("--proof needs the height maps: BUMPSHADOW_HEIGHT_MAPS has to name a folder with MANIFEST.tsv");
    proof all;
    for (const height_source& source : maps) {
        const height_samples samples = read_heights(source);
        const usual_map usual(samples, source);
        const bool terrain = &source == &maps.back();
        for (proof_scene& scene : scenes_for(samples.extent, source.texel_size)) {
            if (terrain && scene.name != std::string("sun path")) continue;
            if (terrain) scene.lights.limits.mismatch = 0.01;
            const bs::scene wanted = scene.lights.view();
            const lit_pixels pixels(samples, source, wanted, measuring_seed);
            proof_row row{terrain ? "terrain" : scene.name,
                          name_of(source),
                          samples.extent,
                          wanted.mismatch,
                          {},
                          {},
                          usual.sixteen_seconds};
            row.plan = plan_map(samples, source, wanted, &pixels);
            row.usual = usual.figures;
            row.usual.error = pixels.of(usual.map, {});
            all.rows.push_back(std::move(row));
        }
    }
    // Scene by scene, the maps in their order.
    const auto rank = [](const proof_row& row) {
        constexpr const char* order[] = {"fixed sun", "sun path", "free light", "torch", "distant view", "terrain"};
        const auto* at =
            std::find_if(std::begin(order), std::end(order), [&](const char* n) { return row.scene == n; });
        return std::pair(at - std::begin(order), row.asked);
    };
    std::stable_sort(all.rows.begin(), all.rows.end(),
                     [&](const proof_row& a, const proof_row& b) { return rank(a) < rank(b); });
    all.lines = lines_of(all.rows);
    return all;
}

std::string table_of(const proof& all) {
    std::vector<std::vector<std::string>> rows{{"scene, map", "asked %", "predicted %", "measured %", "agree", "bytes",
                                                "of", "bake s", "of", "pack s", "of", "cycles", "of", "fetches",
                                                "plan s", "plan / 16", "unplanned %"}};
    for (const proof_row& row : all.rows) {
        const set_up_figures &f = row.plan.figures, &u = row.usual;
        const bs::plan_figures& p = row.plan.how.predicted;
        std::string name = row.scene;
        name += ", ";
        name += row.map;
        if (row.plan.how.obstacle != bs::plan_obstacle::none) name += format(" (%s!)", name_of(row.plan.how.obstacle));
        rows.push_back({name, percent(row.asked), percent(p.mismatch) + " +- " + percent(p.interval),
                        percent(f.error.mismatch) + " +- " + percent(f.error.interval), row.agrees() ? "yes" : "no",
                        format("%.4g", f.bytes), format("%.4g", u.bytes), format("%.4f", f.bake_seconds),
                        format("%.3f", u.bake_seconds), format("%.4f", f.pack_seconds), format("%.3f", u.pack_seconds),
                        format("%.0f", f.gpu_cost), format("%.0f", u.gpu_cost), format("%d", f.fetches),
                        format("%.2f", row.plan.plan_seconds),
                        format("%.1f", row.plan.plan_seconds / row.sixteen_seconds),
                        percent(u.error.mismatch) + " +- " + percent(u.error.interval)});
    }
    std::string text = lined_up(rows);
    text +=
        "\nmeasured: the whole map, baked and packed, in exact light: 3000 texels of another seed in 16 bearings, "
        "48000 of a fixed sun, 12000 of the torch;\nof distant views 1000 squares of 8 x 8 texels, in as many places "
        "as the plan says, unplanned in one. With the 95 % confidence interval.\n"
        "seconds: of the processor, one thread; plan / 16: over the bake of 16 bearings.\n"
        "of, unplanned: 16 slices of 8 bits at full size, fitted to 64 directions. torch: four point lights, half a "
        "map's width from its\nmiddle along +x, +y, -x and -y, a fifth of the width high.\n\n";
    for (const proof_line& line : all.lines) {
        text += line.held ? "held: " : "NOT held: ";
        text += line.text;
        text += '\n';
    }
    return text;
}

std::string json_of(const planned_map& one, bool measured) {
    std::string text = format("{\"plan_seconds\":%.6f,\"recipe\":", one.plan_seconds);
    text += json_of(one.how);
    if (measured) text += ",\"measured\":" + json_of(one.figures);
    return text + "}";
}

std::string json_of(const proof& all) {
    std::string text = build_json() + ",\"rows\":[";
    for (const proof_row& row : all.rows) {
        if (&row != all.rows.data()) text += ',';
        text += "\n{\"scene\":" + quoted(row.scene) + ",\"map\":" + quoted(row.map) +
                format(",\"width\":%d,\"height\":%d,\"asked\":%.9g,\"agrees\":%s,\"plan\":", row.extent.x, row.extent.y,
                       row.asked, row.agrees() ? "true" : "false");
        text += json_of(row.plan, true) + ",\"unplanned\":" + json_of(row.usual) + "}";
    }
    text += "],\"lines\":[";
    for (const proof_line& line : all.lines) {
        if (&line != all.lines.data()) text += ',';
        text += "\n{\"text\":" + quoted(line.text) + ",\"held\":" + (line.held ? "true" : "false") + "}";
    }
    return text + "]}\n";
}

}  // namespace examples
