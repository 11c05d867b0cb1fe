#include "report/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <utility>
#include <vector>

#include "common/report_text.hpp"
#include "common/tool.hpp"

namespace examples {
namespace {

// Pixels, from the lower left. The axes stand on the left; on the right are the families and the members of the front.
constexpr double width = 1120.0, left = 78.0, right = 690.0, bottom = 62.0, top = 62.0, least_height = 620.0;
constexpr double list_left = right + 26.0, key_line = 20.0, list_line = 15.0;
constexpr std::size_t letters_a_line = 62;

// Okabe and Ito's colors (2008), which are told apart with any kind of color vision, without their yellow.
constexpr std::array<const char*, 7> colors{"0072B2", "D55E00", "009E73", "CC79A7", "E69F00", "56B4E9", "555555"};
constexpr std::array<int, 10> shapes{7, 5, 9, 11, 13, 6, 4, 8, 10, 12};

std::string in_quotes(const std::string& text) {
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("''") : std::string(1, c);
    return word + '\'';
}

// Lines of at most letters_a_line, broken at blanks.
std::vector<std::string> wrapped(const std::string& text) {
    std::vector<std::string> lines;
    std::string rest = text;
    while (rest.size() > letters_a_line) {
        std::size_t end = rest.rfind(' ', letters_a_line);
        if (end == std::string::npos || end == 0) end = letters_a_line;
        lines.push_back(rest.substr(0, end));
        rest.erase(0, rest[end] == ' ' ? end + 1 : end);
    }
    lines.push_back(rest);
    return lines;
}

// What the list and the numbers beside the points say. A member that goes by one name at several x has one number.
struct member {
    std::size_t number = 1;
    plot_point point;
    bool is_first = true;  // with this number
};

std::vector<member> members_of(const plot& p) {
    std::vector<member> members;
    std::size_t last = 0;
    for (const plot_point& point : p.front) {
        const auto same =
            std::find_if(members.begin(), members.end(), [&](const member& m) { return m.point.name == point.name; });
        if (same == members.end())
            members.push_back({++last, point, true});
        else
            members.push_back({same->number, point, false});
    }
    return members;
}

// Transparency is for points: two hexadecimal digits.
std::string style_of(const plot_series& series, const std::string& transparency = "") {
    return format("pointtype %d linecolor '#%s%s'", shapes[series.style % shapes.size()], transparency.c_str(),
                  colors[series.style % colors.size()]);
}

struct text_line {
    std::string text;
    bool is_title = false;
};

std::vector<text_line> list_of(const plot& p, const std::vector<member>& members) {
    std::vector<text_line> lines;
    if (members.empty()) return lines;
    lines.push_back({p.front_title, true});
    for (const member& m : members) {
        if (!m.is_first) continue;
        std::string text = m.point.name;
        if (!p.y.holds(m.point.y)) text += " (0, below the axis)";
        if (!p.x.holds(m.point.x)) text += " (dotted: costs 0)";
        const std::vector<std::string> wrapped_lines = wrapped(text);
        for (std::size_t i = 0; i < wrapped_lines.size(); ++i)
            lines.push_back({(i == 0 ? format("%2zu  ", m.number) : std::string("      ")) + wrapped_lines[i]});
    }
    return lines;
}

struct frame {
    double height = least_height;

    [[nodiscard]] std::string at(double x, double y) const { return format("screen %.5f,%.5f", x / width, y / height); }
};

double place(const plot_axis& axis, double value, double first, double last) {
    const double t = axis.is_logarithmic ? std::log(value / axis.low) / std::log(axis.high / axis.low)
                                         : (value - axis.low) / (axis.high - axis.low);
    return first + t * (last - first);
}

// Numbers to the lower left of the points, where a front has nothing. Those that would overlap share one text.
std::string numbers_of(const plot& p, const std::vector<member>& members, const frame& screen) {
    struct label {
        double x, y;
        std::size_t first, last;
    };
    std::vector<label> labels;
    for (const member& m : members) {
        if (!p.x.holds(m.point.x) || !p.y.holds(m.point.y)) continue;
        if (!labels.empty() && labels.back().last == m.number) continue;
        const double x = place(p.x, m.point.x, left, right) - 6.0;
        const double y = place(p.y, m.point.y, bottom, screen.height - top) - 9.0;
        const auto close = [&](const label& l) { return std::abs(l.x - x) < 22.0 && std::abs(l.y - y) < 12.0; };
        const auto at = std::find_if(labels.begin(), labels.end(), close);
        if (at != labels.end() && at->last + 1 == m.number)
            at->last = m.number;
        else
            labels.push_back({x, y, m.number, m.number});
    }
    std::string script;
    for (const label& l : labels) {
        std::string text = std::to_string(l.first);
        if (l.last != l.first) text.append(l.last == l.first + 1 ? "," : "-").append(std::to_string(l.last));
        script += "set label " + in_quotes(text) + " at " + screen.at(l.x, l.y) + " right font ',11' front\n";
    }
    return script;
}

std::string axis_of(const char* name, const plot_axis& axis) {
    std::string script = format("set %srange [%.6g:%.6g]\n", name, axis.low, axis.high);
    if (axis.is_logarithmic) script += format("set logscale %s\n", name);
    if (axis.marks.empty()) return script;
    script += format("set %stics (", name);
    for (const double& mark : axis.marks) {
        const double inverse = 1.0 / mark;
        const bool is_fraction = inverse > 1.0 && axis.are_marks_binary;
        script += &mark == axis.marks.data() ? "" : ", ";
        script += is_fraction ? format("'1/%g' %.6g", inverse, mark) : format("'%g' %.6g", mark, mark);
    }
    return script + ")\n";
}

bool is_drawn(const plot& p, const plot_point& point) { return p.x.holds(point.x) && p.y.holds(point.y); }

bool is_member(const plot& p, const plot_point& point) {
    return std::any_of(p.front.begin(), p.front.end(), [&](const plot_point& m) {
        return m.family == point.family && m.name == point.name && m.x == point.x && m.y == point.y;
    });
}

std::string block(const plot& p, const std::string& title, const std::vector<plot_point>& points, bool members_only) {
    std::string text = "# " + title + '\n';
    bool is_empty = true;
    for (const plot_point& point : points) {
        if (!is_drawn(p, point) || (members_only && !is_member(p, point))) continue;
        text += format("%.6g %.6g \"", point.x, point.y) + point.name + "\"\n";
        is_empty = false;
    }
    return text + (is_empty ? "NaN NaN \"\"\n\n\n" : "\n\n");
}

}  // namespace

std::string data_of(const plot& p) {
    std::string text = "# x: " + p.x.label + "\n# y: " + p.y.label + '\n';
    for (const plot_series& s : p.series) text += block(p, s.family, s.points, false);
    for (const plot_series& s : p.series) text += block(p, s.family + ", on the front", s.points, true);
    return text + block(p, "the front", p.front, false);
}

std::string script_of(const plot& p) {
    const std::vector<member> members = members_of(p);
    const std::vector<text_line> list = list_of(p, members);
    frame screen;
    std::vector<const plot_series*> drawn;
    for (const plot_series& s : p.series)
        if (std::any_of(s.points.begin(), s.points.end(), [&](const plot_point& point) { return is_drawn(p, point); }))
            drawn.push_back(&s);
    screen.height = std::max(least_height, top + key_line * double(drawn.size()) + list_line * double(list.size() + 3));

    std::string script = "# gnuplot " + p.name + ".gp\nif (!exists('output')) output = '" + p.name + ".svg'\n";
    script += format("set terminal svg size %g,%g font 'sans-serif,13' noenhanced background '#ffffff'\n", width,
                     screen.height);
    script += "set output output\nset encoding utf8\nunset key\n";
    script += format("set lmargin at screen %.5f\nset rmargin at screen %.5f\n", left / width, right / width);
    script += format("set bmargin at screen %.5f\nset tmargin at screen %.5f\n", bottom / screen.height,
                     1.0 - top / screen.height);
    script += "set border 3 linecolor '#888888'\nset tics nomirror out scale 0.6 textcolor '#333333'\n";
    script += "set grid linetype 1 linecolor '#e4e4e4' linewidth 0.8\n";
    script += axis_of("x", p.x) + axis_of("y", p.y);
    script += "set xlabel " + in_quotes(p.x.label) + '\n';
    // gnuplot's own place for it depends on the width of the numbers.
    script += "set label " + in_quotes(p.y.label) + " at " + screen.at(22.0, (bottom + screen.height - top) / 2.0) +
              " center rotate\n";
    script += "set label " + in_quotes(p.title) + " at " + screen.at(left, screen.height - 24.0) + " font ',17'\n";
    script += "set label " + in_quotes(p.subtitle) + " at " + screen.at(left, screen.height - 45.0) +
              " textcolor '#666666'\n";
    double y = screen.height - top;
    for (const plot_series* s : drawn) {
        script += "set label " + in_quotes(s->family) + " at " + screen.at(list_left + 6.0, y) + " point " +
                  style_of(*s) + " pointsize 0.9 offset character 1.2,-0.25\n";
        y -= key_line;
    }
    y -= 14.0;
    for (const text_line& line : list) {
        script += "set label " + in_quotes(line.text) + " at " + screen.at(list_left, y) +
                  (line.is_title ? " font ',12'\n" : " font ',11' textcolor '#333333'\n");
        y -= line.is_title ? 18.0 : list_line;
    }
    script += numbers_of(p, members, screen);
    if (p.nothing && p.y.holds(p.nothing->y))
        script += format(
            "set arrow from graph 0, first %.6g to graph 1, first %.6g nohead dashtype 3 linewidth 1.5 "
            "linecolor '#555555'\n",
            p.nothing->y, p.nothing->y);

    script += "plot \\\n";
    const std::string data = in_quotes(p.name + ".dat");
    const std::size_t count = p.series.size();
    std::size_t points = 0;
    for (const plot_series& s : p.series) points += s.points.size();
    const bool few = points < 60;
    if (!p.front.empty())
        script += data + format(" index %zu using 1:2 with ", 2 * count) +
                  (p.has_lines ? "lines linewidth 8 linecolor '#dddddd'" : "steps linewidth 1.4 linecolor '#999999'");
    for (std::size_t i = 0; i < count; ++i) {
        const char* separator = i == 0 && p.front.empty() ? "" : ", \\\n";
        if (p.has_lines) {
            script += separator + data +
                      format(" index %zu using 1:2 with linespoints linewidth 1.6 pointsize 0.6 ", i) +
                      style_of(p.series[i]);
            continue;
        }
        script += separator + data + format(" index %zu using 1:2 with points pointsize %s ", i, few ? "0.9" : "0.6") +
                  style_of(p.series[i], few ? "40" : "70");
        script += ", \\\n" + data + format(" index %zu using 1:2 with points pointsize 0.9 ", count + i) +
                  style_of(p.series[i]);
    }
    return script + '\n';
}

bool draw(const std::string& gnuplot, const std::filesystem::path& folder, const plot& p) {
    std::error_code error;
    const std::filesystem::path here = std::filesystem::absolute(folder, error);
    const std::filesystem::path picture = here / (p.name + ".svg"), part = here / (p.name + ".svg.part");
    const std::string before = "cd " + in_quotes(here.string()) + "; output = " + in_quotes(part.filename().string());
    const bool is_drawn = run_tool(gnuplot, {"-d", "-e", before, (here / (p.name + ".gp")).string()}) &&
                          std::filesystem::file_size(part, error) > 0 && !error;
    if (is_drawn) std::filesystem::rename(part, picture, error);
    if (is_drawn && !error) return true;
    std::filesystem::remove(part, error);
    std::filesystem::remove(picture, error);
    return false;
}

}  // namespace examples
