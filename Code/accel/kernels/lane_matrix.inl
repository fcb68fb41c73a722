// Bits of 8 rows of 8, asked for by columns. Included like solids.inl, by the kernels of 8 lanes.
class LaneMatrix {
public:
    void set(int row, unsigned columns) { rows_ |= std::uint64_t{columns} << 8 * row; }
    // The factor brings bit 0 of byte k to bit 56 + k, and no two products meet.
    unsigned column(int i) const {
        return static_cast<unsigned>((rows_ >> i & 0x0101010101010101u) * 0x0102040810204080u >>
                                     56);
    }

private:
    std::uint64_t rows_ = 0;
};
