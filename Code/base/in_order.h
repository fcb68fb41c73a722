// InOrder: numbered pieces that are made on several threads in any order, and used in theirs.
#pragma once

#include "base/function_ref.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

using ByteSink = FunctionRef<void(std::span<const std::uint8_t>)>;

class InOrder {
public:
    using Bytes = std::vector<std::uint8_t>;

    InOrder(std::size_t pieces, ByteSink use);
    ~InOrder();
    InOrder(const InOrder&) = delete;
    InOrder& operator=(const InOrder&) = delete;

    // A buffer of any content that a piece can be made in.
    Bytes buffer();
    // Piece `number`, from 0. Nobody waits: if it is its turn, this thread uses it and those behind
    // it that are there; else whoever brings what is missing does. What use() throws arrives
    // here, and then no more is used.
    void put(std::size_t number, Bytes piece);

private:
    struct State;
    State* state_;
};
