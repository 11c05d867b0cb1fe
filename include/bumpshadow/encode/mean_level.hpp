#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <bumpshadow/config.hpp>
#include <bumpshadow/glm.hpp>

namespace bumpshadow::mean_detail {

// Where a texel of a smaller level lies on the larger one, along an axis: the first texel, how many it touches, and the
// share of the mean that each has. Exact also for odd extents, where halves do not meet the texels' borders.
struct span {
    int first, count;
    double begin, end;

    span(int i, int source, int target)
        : first(int(double(i) * source / target)),
          begin(double(i) * source / target),
          end(double(i + 1) * source / target) {
        count = (std::min)(int(std::ceil(end)), source) - first;
    }
    [[nodiscard]] float share(int i) const {
        return float(((std::min)(end, double(i + 1)) - (std::max)(begin, double(i))) / (end - begin));
    }
};

// Means over the area of each texel of row y of a level with extent `to`: write(x, value) of what read(x, y) gives on
// the level with extent `from`. Value: float or a vector.
template <class Value, class Read, class Write>
void mean_row(glm::ivec2 from, glm::ivec2 to, int y, const Read& read, const Write& write) {
    const span v(y, from.y, to.y);
    for (int x = 0; x < to.x; ++x) {
        const span u(x, from.x, to.x);
        Value mean(0.0f);
        for (int j = v.first; j < v.first + v.count; ++j)
            for (int i = u.first; i < u.first + u.count; ++i) mean += v.share(j) * u.share(i) * read(i, j);
        write(x, mean);
    }
}

}  // namespace bumpshadow::mean_detail
