#include "render/waves/texture_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void textureColors(const ByteTexture&, TextureBlock&, std::size_t);                            \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa) kernels::isa::textureColors

TextureColorsFn textureColors(const Kernel& kernel) {
    static constexpr ByKernel<TextureColorsFn> kTable = BY_KERNEL(ROW);
    const TextureColorsFn* const function = kTable.of(kernel);
    return function ? *function : nullptr;
}
