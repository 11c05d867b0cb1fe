#pragma once

#include "report/section.hpp"

namespace examples {

report_section bake_section();
report_section growth_section();
report_section image_section();
report_section normals_section();
report_section encoding_section();
report_section codebook_section();
report_section triangle_section();
report_section ssbump_section();

}  // namespace examples
