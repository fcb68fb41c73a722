#include "render/waves/texture_lanes.h"

#include "accel/kernels/kernels.h"

#include <string_view>

#define TEXTURE_COLORS(isa)                                                                        \
    namespace kernels::isa {                                                                       \
    void textureColors(const ByteTexture&, TextureBlock&, std::size_t);                            \
    }
TEXTURE_COLORS(sse)
TEXTURE_COLORS(avx2)
TEXTURE_COLORS(avx512)
#undef TEXTURE_COLORS

TextureColorsFn textureColors([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr struct {
        std::string_view name;
        TextureColorsFn fn;
    } kTable[] = {
        {"avx512", kernels::avx512::textureColors},
        {"avx2", kernels::avx2::textureColors},
        {"sse", kernels::sse::textureColors},
    };
    for (const auto& row : kTable)
        if (row.name == kernel.name) return row.fn;
#endif
    return nullptr;
}
