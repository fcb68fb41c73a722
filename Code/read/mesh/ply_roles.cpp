#include "read/mesh/ply_roles.h"

#include <string_view>

namespace {

// Groups of properties that count only together, in the order of preference: of several names for
// the same the first ones.
struct Group {
    PlyRole first;
    std::array<std::string_view, 3> names; // the last one may be empty
};
constexpr auto kGroups = std::to_array<Group>({
    {PlyRole::X, {"x", "y", "z"}},
    {PlyRole::NormalX, {"nx", "ny", "nz"}},
    {PlyRole::U, {"s", "t"}},
    {PlyRole::U, {"u", "v"}},
    {PlyRole::U, {"texture_u", "texture_v"}},
    {PlyRole::U, {"texture_s", "texture_t"}},
});

} // namespace

VertexRoles rolesOf(const PlyElement& vertex) {
    VertexRoles out;
    out.roles.assign(vertex.properties.size(), PlyRole::None);
    for (const Group& group : kGroups) {
        auto role = static_cast<std::size_t>(group.first);
        std::vector<std::size_t> found;
        bool isComplete = !out.has[role];
        for (const std::string_view name : group.names) {
            if (name.empty()) continue;
            const PlyProperty* const p = vertex.property(name);
            isComplete = isComplete && p && !p->countType;
            if (isComplete) found.push_back(static_cast<std::size_t>(p - vertex.properties.data()));
        }
        if (!isComplete) continue;
        for (const std::size_t i : found) {
            out.roles[i] = static_cast<PlyRole>(role);
            out.has[role++] = true;
        }
    }
    return out;
}
