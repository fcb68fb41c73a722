// Which samples of their pixels the slots of a chunk are, whatever the chunk before it was.
#include "check.h"
#include "integrate/batch.h"

namespace test_sample_numbers {

TEST(sample_numbers_follow_each_other_in_each_pixel) {
    struct Chunk {
        std::uint32_t first, count, pixels;
    };
    SampleNumbers numbers;
    for (const Chunk c : {Chunk{0, 3, 5}, Chunk{0, 3, 9}, Chunk{0, 3, 2}, Chunk{3, 3, 9},
                          Chunk{3, 2, 9}, Chunk{0, 1, 40}, Chunk{0, 1, 64}, Chunk{7, 1, 64}}) {
        const std::uint32_t slots = c.count * c.pixels;
        numbers.set(c.first, c.count, slots);
        for (std::uint32_t slot = 0; slot < slots; ++slot)
            CHECK_INFO(numbers[slot] == c.first + slot % c.count,
                       "samples " << c.first << " + " << c.count << ", slot " << slot);
    }
}

} // namespace test_sample_numbers
