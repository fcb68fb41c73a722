// Whole files: read into memory, written so that a half-written file never has the final name.
// Knows nothing about what the bytes mean; "-" for stdin and stdout is the caller's business.
#pragma once

#include "base/function_ref.h"
#include "base/parallel.h"
#include "base/raw_vector.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// FileText: the text of a file, and behind its end a zero, as readers expect. Its memory is not
// zeroed before it is read into, so that each thread is the first to touch what it reads.
class FileText {
public:
    FileText() = default;
    FileText(std::string_view text) {
        resize(text.size());
        std::copy(text.begin(), text.end(), data());
    }
    FileText(const std::string& text) : FileText(std::string_view(text)) {}
    FileText(const char* text) : FileText(std::string_view(text)) {}
    FileText(const FileText& other) : FileText(std::string_view(other)) {}
    FileText(FileText&& other) noexcept { swap(other); }
    FileText& operator=(FileText other) noexcept {
        swap(other);
        return *this;
    }
    ~FileText() = default;

    // Bytes that are new are to be written, all of them, through data().
    void resize(std::size_t size) {
        bytes_.reserve(size + 1);
        bytes_.resize(size);
        bytes_.push_back('\0');
        first_ = bytes_.data(), size_ = size;
    }

    char* data() { return bytes_.data(); }
    const char* data() const { return first_; }
    std::size_t size() const { return size_; }
    operator std::string_view() const { return {first_, size_}; }

    bool empty() const { return size_ == 0; }
    const char* begin() const { return first_; }
    const char* end() const { return first_ + size_; }
    bool starts_with(std::string_view start) const {
        return std::string_view(*this).starts_with(start);
    }

private:
    void swap(FileText& other) noexcept {
        bytes_.swap(other.bytes_);
        std::swap(first_, other.first_), std::swap(size_, other.size_);
    }
    RawVector<char> bytes_; // with the zero; nothing where there is no text
    const char* first_ = "";
    std::size_t size_ = 0;
};

// All bytes of a regular file or pipe. Fails with ErrorKind::Input: the name and the system's
// reason.
std::vector<std::uint8_t> readWholeFile(const std::string& fileName);
// Returns them as text, read by several threads where it is long (0: as many as the machine has).
FileText readWholeText(const std::string& fileName, int threads = 1);

// Writes a temporary file in the same folder and renames it; an existing file keeps its content
// until then. What is no regular file (/dev/null, a pipe) is written to directly. One write at a
// time: threads wait for each other. Fails with ErrorKind::Output and leaves no temporary file.
void writeFileAtomically(const std::string& fileName, std::span<const std::uint8_t> bytes);
// Writes bytes that are made meanwhile: produce(write) gives them to `write` one piece after
// the other, from any thread.
using ByteSource = FunctionRef<void(ByteSink write)>;
void writeFileAtomically(const std::string& fileName, ByteSource produce);

// The temporary file that exists right now, nullptr when there is none. Safe in a signal handler,
// which may remove it before the program ends.
const char* pendingTemporaryFile();
