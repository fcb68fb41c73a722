void closestFromPoint(const WideMesh& mesh, const RaySpan& rays,
                      std::span<const std::uint32_t> order, TriangleHit* hits) {
    closest(mesh, rays, order, hits);
}
void anyFromPoint(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
                  std::uint8_t* hidden) {
    any(mesh, rays, order, hidden);
}
