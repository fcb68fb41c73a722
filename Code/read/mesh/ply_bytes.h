// The data of a binary PLY file as numbers. The same steps as PlyText: one loop reads both.
// Messages point to the line of the element in the header, and name the byte.
#pragma once

#include "read/mesh/ply_rows.h"

#include <algorithm>
#include <bit>
#include <type_traits>
#include <utility>
#include <vector>

class PlyBytes : public PlyInput {
public:
    PlyBytes(const SourceFile& source, std::size_t offset, PlyFormat format)
        : PlyInput(source, offset), isBigEndian_(format == PlyFormat::BigEndian) {}

    void begin(const PlyElement& element) {
        std::size_t rowBytes = 0; // at least: lists may be empty
        for (const PlyProperty& p : element.properties)
            rowBytes += sizeOf(p.countType.value_or(p.type));
        PlyInput::begin(element, rowBytes, bytesLeft());
    }
    const char* rowEnd() const { return p_; }
    // The rows of the element that has begun in parts, if all are as long as the first one.
    std::vector<RowChunk> chunks(int) const {
        constexpr std::size_t kChunkBytes = std::size_t{1} << 17;
        PlyBytes firstRow = *this;
        for (const PlyProperty& p : element_->properties) {
            if (p.countType)
                firstRow.skipList(p);
            else
                firstRow.skip(p.type);
        }
        const auto rowBytes = static_cast<std::size_t>(firstRow.p_ - p_);
        const std::size_t rows = std::min<std::size_t>(element_->count, bytesLeft() / rowBytes),
                          most = std::max<std::size_t>(1, kChunkBytes / rowBytes);
        std::vector<RowChunk> out;
        for (std::size_t row = 0; row < rows; row += most)
            out.push_back({p_ + row * rowBytes, row, std::min(most, rows - row)});
        return out;
    }
    void beginRow() {}
    void endRow() { ++row_; }

    double number(PlyType type) {
        double value = 0;
        withType(type, [&]<class T>() { value = static_cast<double>(load<T>(take(sizeof(T)))); });
        return value;
    }
    void skip(PlyType type) { take(sizeOf(type)); }

    // Items of a list of a whole type; negative ones wrap around. Fails above `most` items.
    void list(const PlyProperty& property, std::size_t most, std::vector<std::uint32_t>& items) {
        const std::size_t count = listCount(property, most);
        items.resize(count);
        withType(property.type, [&]<class T>() {
            listStart_ = take(count * sizeof(T));
            for (std::size_t i = 0; i < count; ++i)
                // NOLINTNEXTLINE(bugprone-signed-char-misuse): a negative one is too large then
                items[i] = static_cast<std::uint32_t>(load<T>(listStart_ + i * sizeof(T)));
        });
    }
    // Reads a list of numbers of any type.
    void numbers(const PlyProperty& property, std::size_t most, std::vector<double>& items) {
        items.resize(listCount(property, most));
        for (double& item : items) item = number(property.type);
    }
    void skipList(const PlyProperty& property) {
        take(listCount(property, bytesLeft()) * sizeOf(property.type));
    }

    [[noreturn]] void fail(std::string_view what) const { failAtByte(last_, what); }
    [[noreturn]] void failAtItem(const PlyProperty& property, std::size_t i,
                                 std::string_view what) const {
        failAtByte(listStart_ + i * sizeOf(property.type), what);
    }
    // What is behind the last element, if it should be told.
    std::optional<std::pair<std::size_t, std::string>> rest() const {
        if (p_ == end_) return {};
        return std::pair(element_ ? element_->offset : 0,
                         cat(bytesLeft(), " bytes follow the last element and were not read"));
    }

private:
    const char* take(std::size_t size) {
        last_ = p_;
        if (size > bytesLeft()) fail("the file ends in the middle of the data");
        p_ += size;
        return last_;
    }

    std::size_t listCount(const PlyProperty& property, std::size_t most) {
        const auto count = static_cast<std::int64_t>(number(*property.countType));
        const std::size_t possible = std::min(most, bytesLeft() / sizeOf(property.type));
        if (count < 0 || static_cast<std::uint64_t>(count) > possible)
            fail(tooManyItems(property, std::to_string(count), possible, most));
        return static_cast<std::size_t>(count);
    }

    // Written as shifts, whatever the machine's own order is: compilers make one load of it.
    template <class T> T load(const char* p) const {
        const auto bitsBy = [&]<std::size_t... k>(std::index_sequence<k...>) {
            const auto byte = [&](std::size_t at) {
                return std::uint64_t{static_cast<unsigned char>(p[at])};
            };
            return isBigEndian_ ? ((byte(sizeof(T) - 1 - k) << (8 * k)) | ...)
                                : ((byte(k) << (8 * k)) | ...);
        };
        const std::uint64_t bits = bitsBy(std::make_index_sequence<sizeof(T)>());
        if constexpr (std::is_same_v<T, float>)
            return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        else if constexpr (std::is_same_v<T, double>)
            return std::bit_cast<double>(bits);
        else
            return static_cast<T>(bits);
    }

    template <class Call> static void withType(PlyType type, Call&& call) {
        switch (type) {
        case PlyType::Int8: return call.template operator()<std::int8_t>();
        case PlyType::Uint8: return call.template operator()<std::uint8_t>();
        case PlyType::Int16: return call.template operator()<std::int16_t>();
        case PlyType::Uint16: return call.template operator()<std::uint16_t>();
        case PlyType::Int32: return call.template operator()<std::int32_t>();
        case PlyType::Uint32: return call.template operator()<std::uint32_t>();
        case PlyType::Float32: return call.template operator()<float>();
        case PlyType::Float64: return call.template operator()<double>();
        }
    }

    [[noreturn]] void failAtByte(const char* p, std::string_view what) const {
        failAt(*source_, element_->offset,
               cat("byte ", p - source_->text.data(), ", row ", row_, " of '",
                   shown(element_->name), "': ", what));
    }

    bool isBigEndian_;
};
