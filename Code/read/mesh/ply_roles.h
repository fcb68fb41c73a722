// What the properties of a vertex of a PLY file are to us.
#pragma once

#include "read/mesh/ply_header.h"

#include <array>
#include <cstddef>
#include <vector>

enum class PlyRole { X, Y, Z, NormalX, NormalY, NormalZ, U, V, None };
inline constexpr std::size_t kPlyRoleCount = static_cast<std::size_t>(PlyRole::None);

struct VertexRoles {
    std::vector<PlyRole> roles; // per property
    std::array<bool, kPlyRoleCount> has{};
    bool hasRole(PlyRole role) const { return has[static_cast<std::size_t>(role)]; }
};
// Of several names for the same the first ones known.
VertexRoles rolesOf(const PlyElement& vertex);
