// Pause: how long not to try what did not pay. It follows what a thread met before; no answer
// depends on it.
#pragma once

#include <algorithm>
#include <cstddef>

class Pause {
public:
    explicit Pause(std::size_t longest) : longest_(longest) {}

    // Are the next `count` to be left out? If so, they are done with.
    bool passes(std::size_t count = 1) {
        if (left_ < count) return false;
        left_ -= count;
        return true;
    }
    // The next one is tried.
    void end() { left_ = 0; }
    // Twice as long every time that the next try fails too.
    void learn(bool pays) {
        last_ = pays ? last_ / 2 : std::min(2 * last_ + 1, longest_);
        left_ = pays ? 0 : last_;
    }

private:
    std::size_t longest_, left_ = 0, last_ = 0;
};
