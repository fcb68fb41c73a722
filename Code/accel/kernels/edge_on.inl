// Which rays may see a triangle edge-on, TrianglePlane::isEdgeOn(): a direction is at most sqrt(3)
// dz long, and the bound in float is 2^-10 larger than it has to be, and where floats underflow by
// more than they lose.
// Included by the file of each instruction set inside its namespace, behind a simd_*.inl.

// For triangles with these normals.
[[gnu::always_inline]] inline Floats edgeOnBound(const Doubles& nx, const Doubles& ny,
                                                 const Doubles& nz) {
    const Doubles n2 = (nx * nx + ny * ny) + nz * nz;
    const Floats perSteep(1.7338f / static_cast<float>(TrianglePlane::kSteep));
    return fma(sqrt(n2).toFloats(), perSteep, Floats(0x1p-126f));
}
[[gnu::always_inline]] inline unsigned edgeOnLanes(const Doubles& along, Floats bound, Floats dz) {
    return bits(notGreater(abs(along.toFloats()), fma(bound, dz, Floats(0x1p-126f))));
}
