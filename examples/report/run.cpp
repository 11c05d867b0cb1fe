#include "report/run.hpp"

#include <cctype>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "common/file.hpp"
#include "common/image.hpp"
#include "common/progress.hpp"
#include "report/bar.hpp"

namespace examples {
namespace {

// Part of a file name: letters, digits and hyphens.
std::string plain(const std::string& text) {
    std::string name;
    for (const char c : text) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (is_plain)
            name += c;
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    if (!name.empty() && name.back() == '-') name.pop_back();
    return name;
}

saved_picture save(const std::filesystem::path& folder, const report_picture& picture, std::size_t index) {
    const std::string name = std::to_string(index + 1) + '-' + plain(picture.map) + '-' + plain(picture.name) + '-' +
                             plain(picture.kind.substr(0, picture.kind.find_first_of(" ,:")));
    saved_picture saved{picture.map, picture.name, picture.kind, "pictures/" + name + ".png", picture.pixels.extent};
    output_file file(folder / saved.file);
    write_png(file, picture.pixels);
    file.commit();
    return saved;
}

}  // namespace

void run_sections(std::span<const report_section> sections, const std::vector<report_map>& maps,
                  const std::filesystem::path& folder, findings& all) {
    std::map<std::string, std::shared_ptr<const sample_map>> samples;
    report_context context{
        .maps = maps,
        .seed = all.run.seed,
        .repeats = all.run.repeats,
        .quick = all.run.quick,
        .samples = samples,
        .add = [&](record r) { all.records.push_back(std::move(r)); },
        .show = [&](const report_picture& p) { all.pictures.push_back(save(folder, p, all.pictures.size())); },
        .step = {}};
    double seconds = 0.0;
    for (const report_section& section : sections) seconds += section.seconds(context);
    progress_bar bar(seconds, stderr_is_terminal());
    context.step = [&](const std::string& what) {
        if (is_interrupted()) throw interrupted{};
        bar.step(what);
    };

    for (const report_section& section : sections) {
        section_facts& facts = all.sections.emplace_back(section_facts{section.name, section.title, "not run"});
        if (is_interrupted()) continue;
        bar.begin(section.name, section.seconds(context), section.steps(context));
        try {
            section.run(context);
            facts.state = "complete";
        } catch (const interrupted&) {
            facts.state = "partial: interrupted";
        } catch (const std::exception& error) {
            // A program that a section runs is ended by Ctrl-C, too.
            facts.state = is_interrupted() ? "partial: interrupted" : std::string("partial: ") + error.what();
            if (is_interrupted()) continue;
            bar.clear();
            std::fprintf(stderr, "report: section %s failed: %s\n", section.name.c_str(), error.what());
            all.run.partial = "section " + section.name + " failed";
        }
        bar.end();
    }
    if (is_interrupted()) all.run.partial = "interrupted";
}

}  // namespace examples
