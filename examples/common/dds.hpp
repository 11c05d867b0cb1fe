#pragma once

#include <bumpshadow/texture.hpp>

#include "common/file.hpp"

namespace examples {

// Writes a texture with all its levels as a DDS file; the caller commits. Flat, cube and volume textures get the header
// of D3D9, which everything reads (r8 as L8, r16 as L16, bc4 as BC4U); arrays need the extended one of D3D10.
// Throws failure.
void write_dds(output_file& file, const bumpshadow::const_texture& picture);

}  // namespace examples
