// FileText: the text of a file, and behind its end a zero, as readers expect. Its memory is not
// zeroed before it is read into, so that each thread is the first to touch what it reads.
#pragma once

#include "base/raw_vector.h"

#include <cstddef>
#include <string>
#include <string_view>

class FileText {
public:
    FileText() { bytes_.push_back('\0'); }
    FileText(std::string_view text) {
        bytes_.reserve(text.size() + 1);
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        bytes_.push_back('\0');
    }
    FileText(const std::string& text) : FileText(std::string_view(text)) {}
    FileText(const char* text) : FileText(std::string_view(text)) {}
    FileText(const FileText&) = default;
    FileText(FileText&& other) : FileText() { bytes_.swap(other.bytes_); } // which is empty then
    FileText& operator=(FileText other) {
        bytes_.swap(other.bytes_);
        return *this;
    }
    ~FileText() = default;

    // Bytes that are new are to be written, all of them, through data().
    void resize(std::size_t size) {
        bytes_.resize(size + 1);
        bytes_.back() = '\0';
    }

    char* data() { return bytes_.data(); }
    const char* data() const { return bytes_.data(); }
    std::size_t size() const { return bytes_.size() - 1; }
    operator std::string_view() const { return {data(), size()}; }

    bool empty() const { return size() == 0; }
    const char* begin() const { return data(); }
    const char* end() const { return data() + size(); }
    bool starts_with(std::string_view start) const {
        return std::string_view(*this).starts_with(start);
    }

private:
    RawVector<char> bytes_; // with the zero
};
