// ErrorList: errors that need not stop at the first one, thrown together as one Error.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"

#include <cstddef>
#include <string>
#include <vector>

class ErrorList {
public:
    explicit ErrorList(const SourceFile& source) : source_(source) {}

    // The text is made only when it will be shown: a file can hold a million errors.
    template <class MakeText> void add(SourceLoc loc, MakeText&& makeText) {
        if (hasRoom())
            addComplete(locatedAt(loc, makeText(), "error"));
        else
            ++count_;
    }
    void addComplete(std::string message);
    // Those of another list behind these.
    void append(const ErrorList& other) {
        for (const std::string& message : other.messages_)
            if (hasRoom()) messages_.push_back(message);
        count_ += other.count_;
    }
    std::size_t count() const { return count_; }
    const std::vector<std::string>& messages() const { return messages_; } // the first ones
    void throwIfAny() const;
    // located(), or only the file where the place is not known.
    std::string locatedAt(SourceLoc loc, std::string_view what, std::string_view severity) const;

private:
    static constexpr std::size_t kShown = 20;
    bool hasRoom() const { return messages_.size() < kShown; }

    const SourceFile& source_;
    std::vector<std::string> messages_;
    std::size_t count_ = 0;
};
